"""`cardan.simulate`: what is recorded, when, and what is kept when a run ends early."""

from __future__ import annotations

import hashlib
import math
import re
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from cardan import Scenario, simulate
from cardan.errors import FmiError, FmuError, InputError
from cardan.models.base import Torque

Make = Callable[..., Scenario]


@pytest.mark.parametrize(("step", "stop", "points"), [(0.1, 0.3, 4), (0.1, 0.7, 8), (0.3, 1.0, 5), (1e-3, 0.05, 51)])
def test_communication_points(step: float, stop: float, points: int, shaft_scene: Make, fmu: Path) -> None:
    """t0 + i h, never accumulated, the last exactly on the stop time."""
    result = simulate(shaft_scene("held", step, stop), fmu=fmu)
    assert result.time.tolist() == [*(i * step for i in range(points - 1)), stop]
    np.testing.assert_allclose(result["output.speed"], 200.0 * result.time, rtol=1e-12)
    assert result.info.completed
    assert (result.info.steps, result.info.reached_time) == (points - 1, stop)


def test_only_the_listed_outputs_are_recorded_in_their_order(shaft_scene: Make, fmu: Path) -> None:
    outputs = ("output.speed", "input.torque", "solver.steps", "hold.restart", "input.torque.der1", "input.angle")
    result = simulate(shaft_scene("held", outputs=outputs), fmu=fmu)
    assert tuple(result.columns) == outputs
    assert result.units["input.torque.der1"] == "N.m/s"
    assert result.units["solver.steps"] == "1"
    assert np.all(result["input.torque"] == 100.0)
    assert np.all(np.diff(result["solver.steps"]) >= 1.0)
    assert not result["hold.restart"].any()


def test_inputs_are_recorded_as_they_act_from_each_point_on(shaft_scene: Make, fmu: Path) -> None:
    engine = {"type": "step", "after": 100.0, "time": 0.5}
    result = simulate(shaft_scene("held", 0.25, engine=engine, outputs=("input.torque",)), fmu=fmu)
    assert result["input.torque"].tolist() == [0.0, 0.0, 100.0, 100.0, 100.0]


def test_outputs_at_the_start_belong_to_the_first_torques(shaft_scene: Make, fmu: Path) -> None:
    result = simulate(shaft_scene("held", outputs=("input.acceleration",)), fmu=fmu)
    np.testing.assert_allclose(result["input.acceleration"], 200.0, rtol=1e-12)


def test_signals_of_the_models_are_recorded(shaft_scene: Make, fmu: Path) -> None:
    load = {"type": "dyno", "speed": 20.0, "gain": 1.0, "integral_gain": 10.0, "torque_limit": 1e3}
    result = simulate(shaft_scene("slope", load=load, outputs=("dyno.target_speed", "output.speed")), fmu=fmu)
    assert result.units == {"dyno.target_speed": "rad/s", "output.speed": "rad/s"}
    assert np.all(result["dyno.target_speed"] == 20.0)


def test_where_it_comes_from(shaft_scene: Make, fmu: Path) -> None:
    scenario = shaft_scene()
    info = simulate(scenario, fmu=fmu).info
    assert info.fmu["sha256"] == hashlib.sha256(fmu.read_bytes()).hexdigest()
    assert info.kernel in ("compiled", "interpreted")
    assert {"cardan", "fmpy", "pythonfmu", "python"} <= set(info.versions)
    assert Scenario.from_dict(info.scene).driveline == scenario.driveline
    assert info.real_time_factor == pytest.approx(1.0 / info.wall_time)


def test_a_refused_step_keeps_what_was_recorded(shaft_scene: Make, fmu: Path) -> None:
    """The joint angle passes 90 deg at 0.5 s: 1.2 + 0.74 t = pi/2."""
    moving = {"joint1.angle": 1.2, "joint1.angle.der1": 0.74}
    result = simulate(shaft_scene("held", 0.01, outputs=("joint1.angle",), **moving), fmu=fmu)
    info = result.info
    assert not info.completed
    assert info.message.startswith("fmi2DoStep returned discard (step of 0.01 s at t = 0.5 s): joint1.angle reaches")
    assert (len(result), info.reached_time, info.steps) == (51, 0.5, 50)
    assert result["joint1.angle"][-1] == pytest.approx(1.57, rel=1e-12)


@pytest.mark.parametrize(("failure", "said", "rows"), [
    (OverflowError("too large"), "the models outside the FMU failed after t = 0.5 s: too large", 6),
    (None, r"output\.torque = inf", 7),
])
def test_a_load_that_leaves_the_numbers_ends_the_run(failure: Exception | None, said: str, rows: int,
                                                     shaft_scene: Make, fmu: Path,
                                                     monkeypatch: pytest.MonkeyPatch) -> None:
    def torque(self: object, t: float, *rest: object) -> Torque:
        if t > 0.55 and failure is not None:
            raise failure
        return Torque(0.0 if t < 0.55 else math.inf, 0.0, 0.0)

    scenario = shaft_scene("held", 0.1, load={"type": "quadratic", "coefficient": 0.0})
    monkeypatch.setattr(type(scenario.load), "torque", torque)
    result = simulate(scenario, fmu=fmu)
    assert not result.info.completed
    assert re.search(said, result.info.message)
    assert len(result) == rows


def test_values_that_do_not_fit_together_end_before_the_run(shaft_scene: Make, fmu: Path) -> None:
    none = {"input.inertia": 0.0, "shaft.inertia_a": 0.0, "shaft.inertia_b": 0.0, "output.inertia": 0.0}
    with pytest.raises(FmiError, match="inertia"):
        simulate(shaft_scene(**none), fmu=fmu)


def test_too_many_points_are_refused(shaft_scene: Make, fmu: Path) -> None:
    with pytest.raises(InputError, match=r"1000000000000 steps need 3\.2e.04 GB"):
        simulate(shaft_scene("held", 1e-6, 1e6), fmu=fmu)


def test_a_missing_fmu_is_told(shaft_scene: Make, tmp_path: Path) -> None:
    with pytest.raises(FmuError, match="cardan build"):
        simulate(shaft_scene(), fmu=tmp_path / "none.fmu")


def test_progress_and_announcement(shaft_scene: Make, fmu: Path) -> None:
    fractions: list[float] = []
    lines: list[str] = []
    simulate(shaft_scene("held", 1e-4), fmu=fmu, progress=fractions.append, announce=lines.append)
    assert fractions == sorted(fractions)
    assert fractions[-1] == 1.0
    assert len(fractions) > 1
    assert len(lines) == 1
    assert "kernel" in lines[0]


def test_runs_repeat_bit_for_bit(shaft_scene: Make, fmu: Path) -> None:
    scenario = shaft_scene("slope", load={"type": "quadratic", "coefficient": 0.01}, **{"joint1.angle": 0.4})
    first, second = simulate(scenario, fmu=fmu), simulate(scenario, fmu=fmu)
    assert first["output.speed"].tobytes() == second["output.speed"].tobytes()
    assert first.info.energy_residual == second.info.energy_residual != 0.0
    assert math.isfinite(first.info.energy_residual)
