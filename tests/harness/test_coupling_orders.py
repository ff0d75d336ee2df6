"""Orders of all coupling schemes on a driveline with ripple; steep loads; runs that control their own error.

The double joint 20/15 deg at 3000 rpm on a compliant shaft, engine 200 + 80 cos(2 phi) N.m and quadratic load outside
the FMU (docs/NUMERICS.md). Errors are the largest over the run, against ``hermite5`` at a tenth of the smallest step.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import cache
from typing import Any

import numpy as np
import pytest
from cardan import Instance, Result, Scenario, simulate
from cardan.coupling import FALLBACK, SCHEMES, Adaptive, scheme_of
from cardan.coupling.hermite import START_UP
from cardan.models.stepping import controlled, equal_steps

STOP = 0.2
ENGINE = {"type": "four_stroke", "torque": 200.0, "orders": [2], "amplitudes": [80.0]}
MAP = {"type": "four_stroke", "orders": [2], "amplitudes": [80.0],
       "map": {"speeds": "1000, 5000 rpm", "throttles": [0.0, 1.0], "torques": ["0, -40 N.m", "260, 120 N.m"]}}


def scene(coupling: str, step: float, engine: dict[str, Any] | None = None, load: dict[str, Any] | None = None,
          **keys: Any) -> Scenario:
    return Scenario.from_dict({
        "scene": {"stop_time": STOP, "communication_step": step, "coupling": coupling, "tolerance": 1e-12,
                  "outputs": ["input.speed", "output.speed", "shaft.torque", "input.acceleration"], **keys},
        "driveline": {"joint1.angle": "20 deg", "joint2.angle": "15 deg", "initial.speed": "3000 rpm"},
        "engine": engine or ENGINE, "load": load or {"type": "quadratic", "coefficient": 2e-3}})


@cache
def reference(mapped: bool) -> Result:
    return simulate(scene("hermite5", 5e-5, MAP if mapped else ENGINE))


def largest_error(result: Result, name: str = "input.speed", mapped: bool = False) -> float:
    """Largest error at the points of `result`, relative to the largest value."""
    exact = reference(mapped)
    every = round((result.time[1] - result.time[0]) / 5e-5)
    difference = result[name] - exact[name][::every]
    return float(np.abs(difference).max() / np.abs(exact[name]).max())


@pytest.mark.parametrize("mapped", [False, True], ids=["constant mean", "map"])
@pytest.mark.parametrize("name", [name for name, kind in SCHEMES.items() if not issubclass(kind, Adaptive)])
def test_order(name: str, mapped: bool) -> None:
    """held 1, linear and slope 2, hermite3 and iterated 4, hermite5 6, each within 0.2."""
    engine = MAP if mapped else ENGINE
    errors = [largest_error(simulate(scene(name, step, engine)), mapped=mapped) for step in (1e-3, 5e-4)]
    assert math.log2(errors[0] / errors[1]) == pytest.approx(SCHEMES[name].order, abs=0.2)


def test_accelerations_belong_to_the_true_torques() -> None:
    """What is put out at the end of an iterated step is as accurate as the states (its last part is done with T)."""
    errors = [largest_error(simulate(scene("iterated", step)), "input.acceleration") for step in (1e-3, 5e-4)]
    assert errors[1] < 5e-6  # held or of first order it would be 1e-2
    assert math.log2(errors[0] / errors[1]) > 3.5


def test_iterated_ends_its_sweeps_at_the_tolerance() -> None:
    one, many, until = (simulate(scene("iterated", 1e-3, sweeps=sweeps, sweep_tolerance=tolerance))
                        for sweeps, tolerance in ((1, 0.0), (4, 0.0), (4, 1e-6)))
    assert one.info.steps < until.info.steps < many.info.steps
    np.testing.assert_allclose(until["output.speed"], many["output.speed"], rtol=1e-8)


@pytest.mark.parametrize("name", ["slope", "hermite3", "hermite5", "iterated", "auto"])
def test_steep_load_at_ten_milliseconds(name: str, shaft_scene: Callable[..., Scenario]) -> None:
    """T = 3000 w^4: with dT/dw given the run settles at w = (100/3000)^(1/4)."""
    load = {"type": "power", "coefficient": 3000.0, "exponent": 4.0}
    changes = {"scene.tolerance": 1e-6} if name == "auto" else {}
    result = simulate(shaft_scene(name, 0.01, 0.5, load=load).with_overrides(changes))
    assert result.info.completed
    assert result["output.speed"][-1] == pytest.approx((100 / 3000) ** 0.25, rel=1e-6)


def test_steep_load_explodes_under_held_torques_and_says_so(shaft_scene: Callable[..., Scenario]) -> None:
    load = {"type": "linear", "coefficient": 200.0}
    result = simulate(shaft_scene("held", 0.01, 0.12, load=load))
    assert "of the energy exchanged: inaccurate or unstable" in result.info.note
    assert simulate(shaft_scene("slope", 0.01, 0.12, load=load)).info.note == ""


def test_start_up_steps_are_a_communication_step() -> None:
    assert sum(START_UP) == 1.0
    result = simulate(scene("hermite5", 1e-3))
    assert result.info.steps == 200 + len(START_UP) - 1


def test_a_jump_restarts_the_history(shaft_scene: Callable[..., Scenario]) -> None:
    """A torque step inside a communication interval: exact before and after, no ringing."""
    engine = {"type": "step", "after": 100.0, "time": 0.123}
    for name in ("linear", "hermite3", "hermite5", "adaptive", "iterated"):
        result = simulate(shaft_scene(name, 0.05, engine=engine).with_overrides({"scene.tolerance": 1e-10}))
        np.testing.assert_allclose(result["output.speed"], 200.0 * np.maximum(0.0, result.time - 0.123), atol=1e-9)


@pytest.mark.parametrize("tolerance", [1e-3, 1e-5, 1e-7])
def test_auto_delivers_the_tolerance(tolerance: float) -> None:
    """Every output within ten times the tolerance of the largest value, with few rejected steps."""
    scenario = scene("auto", 1e-2, MAP, tolerance=tolerance)
    result = simulate(scenario)
    for name in ("input.speed", "output.speed", "shaft.torque", "input.acceleration"):
        assert largest_error(result, name, mapped=True) < 10.0 * tolerance, name


def test_adaptive_steps_follow_the_motion() -> None:
    """Calm parts take long steps: a ripple that dies out in the first tenth costs most of the steps there."""
    method = Adaptive(1e-6)
    calm = scene("adaptive", 1e-2, {"type": "constant", "torque": 100.0}, tolerance=1e-6)
    lively = scene("adaptive", 1e-2, tolerance=1e-6)
    assert simulate(calm).info.steps < 0.3 * simulate(lively).info.steps
    assert method.steps == (0, 0, 0)


def test_adaptive_never_goes_below_its_floor() -> None:
    """With a floor of 2 ms the steps are at it, whatever their error; the run is told to be complete."""
    coarse = simulate(scene("adaptive", 1e-2, tolerance=1e-9, shortest_step=2e-3))
    assert coarse.info.completed
    assert coarse.info.steps <= 2 * STOP / 2e-3 + 20
    assert largest_error(coarse) > 1e-6
    method = scheme_of(scene("adaptive", 1e-2, tolerance=1e-4))
    assert isinstance(method, Adaptive)
    assert method.tolerance == 1e-4


def test_the_stop_time_is_hit_exactly() -> None:
    result = simulate(scene("auto", 7e-3, tolerance=1e-6))
    assert result.time[-1] == STOP
    assert result.info.reached_time == STOP


def test_without_state_support_another_scheme_runs_and_says_so(monkeypatch: pytest.MonkeyPatch) -> None:
    said: list[str] = []
    original = Instance.__init__

    def without(self: Instance, *arguments: Any, **options: Any) -> None:
        original(self, *arguments, **options)
        object.__setattr__(self.description, "can_get_set_state", False)

    monkeypatch.setattr(Instance, "__init__", without)
    result = simulate(scene("auto", 1e-3, tolerance=1e-6), announce=said.append)
    assert result.info.coupling == FALLBACK
    assert "saves and restores its state" in result.info.note
    assert any(FALLBACK in line for line in said)


def test_own_states_are_integrated_to_tolerance() -> None:
    """x'' = -x over one step of ten periods: error control against the exact solution, and the fixed steps' order."""

    def rates(s: float, x: list[float]) -> list[float]:
        return [x[1], -x[0]]

    span = 20.0 * math.pi
    for tolerance in (1e-5, 1e-8, 1e-11):
        x, proposed = controlled(rates, span, [1.0, 0.0], [1e-3, 1e-3], tolerance, 0.1)
        assert abs(x[0] - 1.0) < 300 * tolerance
        assert 0.0 < proposed < 2.0
    errors = [abs(equal_steps(rates, 1.0, [1.0, 0.0], d)[0] - math.cos(1.0)) for d in (0.1, 0.05)]
    assert math.log2(errors[0] / errors[1]) == pytest.approx(4, abs=0.1)
