"""Driver, engine and load as one: integration order, rollback, events, and the cost of having no states."""

from __future__ import annotations

import math
import time
from types import SimpleNamespace
from typing import Any

import pytest
from cardan.models.base import Model, Shaft
from cardan.models.clutch import Clutch
from cardan.models.constant import ConstantTorque
from cardan.models.dyno import Dyno
from cardan.models.gearbox import Gearbox
from cardan.models.governor import IdleGovernor
from cardan.models.shift import ShiftSchedule
from cardan.models.speed_laws import QuadraticLoad
from cardan.models.step import StepTorque
from cardan.models.surroundings import Surroundings
from cardan.models.torque_map import TorqueMap

REST = Shaft(0.0, 0.0, 0.0)


def scene(engine: Model, load: Model, driver: Any = None) -> Any:
    return SimpleNamespace(engine=engine, load=load, driver=driver)


def gearbox() -> Gearbox:
    return Gearbox(ConstantTorque(torque_=120.0), ratios=(4.0, 2.4), engine_inertia=0.3, initial_speed=150.0,
                   clutch=Clutch(capacity=600.0, engage_speed=90.0, full_speed=180.0, slip_speed=30.0),
                   shift=ShiftSchedule(up=200.0, up_full=350.0, down=100.0, down_full=180.0))


def lag_error(h: float) -> float:
    """tau T' = a w(t) - T along w = w0 + b t: T = a (w - b tau) + c exp(-t/tau), over 0.2 s."""
    tau, a, w0, b = 0.1, 0.5, 100.0, 300.0
    row = (0.0, 1000.0 * a)
    engine = TorqueMap((0.0, 1000.0), (0.0, 1.0), (row, row), lag=tau, interpolation="linear")
    models = Surroundings(scene(engine, ConstantTorque(torque_=0.0)))
    models.step = math.inf  # the order of the method itself, one sub-step per step
    models.start(0.0, Shaft(0.0, w0, b), REST)
    assert models.x == [pytest.approx(a * w0)]
    steps = round(0.2 / h)
    for i in range(steps):
        t = i * h
        models.advance(t, h, lambda s, t=t: Shaft(0.0, w0 + b * (t + s), b), lambda s: REST)
    exact = a * (w0 + b * 0.2 - b * tau) + a * b * tau * math.exp(-0.2 / tau)
    return abs(models.x[0] - exact)


def test_own_states_are_integrated_with_order_four() -> None:
    errors = [lag_error(h) for h in (0.05, 0.025, 0.0125, 0.00625)]
    slopes = [math.log2(a / b) for a, b in zip(errors, errors[1:])]
    assert slopes[-1] == pytest.approx(4.0, abs=0.1)


def test_sub_steps_respect_the_time_scale_and_the_order_of_states() -> None:
    dyno = Dyno(speed=50.0, gain=2.0, integral_gain=40.0, torque_limit=1e3)
    models = Surroundings(scene(gearbox(), dyno))
    assert models.states == ("engine.speed [rad/s]", "dyno.integral [N.m]")
    assert models.step == pytest.approx(min(0.2 * 2.0 / 40.0, 0.5 * 0.3 / 20.0))
    visited: list[float] = []
    models.start(0.0, REST, REST)
    models.advance(0.0, 0.02, lambda s: visited.append(s) or REST, lambda s: REST)  # type: ignore[func-returns-value]
    assert visited[-1] == 0.02 and max(b - a for a, b in zip(visited, visited[1:])) <= 0.5 * models.step * (1 + 1e-12)


def test_rate_is_the_slope_along_the_integrated_motion() -> None:
    """Total dT/dt of a gearbox while its own state, the shaft and a gear change move together."""
    models = Surroundings(scene(gearbox(), ConstantTorque(torque_=0.0)))
    motion = lambda t: Shaft(0.0, 30.0 + 8.0 * math.sin(3.0 * t), 24.0 * math.cos(3.0 * t))  # noqa: E731
    models.start(0.0, motion(0.0), REST)
    models.bus.discrete = models.bus.discrete._replace(gear=2, since=0.0)  # type: ignore[attr-defined]
    h, values, rates = 5e-4, [], []
    for i in range(801):
        t = i * h
        torque, _ = models.torques(t, motion(t), REST)
        values.append(torque.value)
        rates.append(torque.rate + torque.by_speed * motion(t).acceleration)
        models.advance(t, h, lambda s, t=t: motion(t + s), lambda s: REST)
    for i in (100, 300, 500, 790):  # opening, at the change, closing, closed
        slope = (8.0 * (values[i + 1] - values[i - 1]) - (values[i + 2] - values[i - 2])) / (12.0 * h)
        assert rates[i] == pytest.approx(slope, rel=1e-6, abs=1e-3)


def test_rollback_repeats_to_the_last_bit() -> None:
    models = Surroundings(scene(gearbox(), Dyno(speed=50.0, gain=2.0, integral_gain=40.0, torque_limit=1e3)))
    models.start(0.0, Shaft(0.0, 55.0, 0.0), REST)

    def go() -> tuple[Any, ...]:
        for i in range(50):
            models.advance(0.01 * i, 0.01, lambda s: Shaft(0.0, 55.0 + s, 1.0), lambda s: Shaft(0.0, 40.0, 0.0))
            models.decide(0.01 * (i + 1), Shaft(0.0, 55.0, 0.0), Shaft(0.0, 40.0, 0.0))
        return models.save(), models.torques(0.5, Shaft(0.0, 55.0, 0.0), Shaft(0.0, 40.0, 0.0))

    saved = models.save()
    first = go()
    assert first[0].discrete.gear == 2
    models.restore(saved)
    assert models.save() == saved
    assert go() == first


def test_an_idle_governor_holds_the_speed_against_a_load() -> None:
    """J w' = T_governor - 20 N.m from 60 rad/s: the integral action leaves no error at the end."""
    governor = IdleGovernor(speed=80.0, gain=2.0, integral_gain=4.0, torque_high=100.0)
    models = Surroundings(scene(governor, ConstantTorque(torque_=20.0)))
    shaft, h = Shaft(0.0, 60.0, 0.0), 0.01
    models.start(0.0, shaft, shaft)
    for i in range(1500):
        engine, load = models.torques(i * h, shaft, shaft)
        acceleration = (engine.value - load.value) / 0.3
        rate = (engine.rate + engine.by_speed * acceleration) / 0.3
        after = Shaft(0.0, shaft.speed + h * (acceleration + 0.5 * h * rate), 0.0)
        models.advance(i * h, h, lambda s, w=shaft.speed, v=after.speed: Shaft(0.0, w + (v - w) * s / h, 0.0),
                       lambda s: REST)
        shaft = after
    assert shaft.speed == pytest.approx(80.0, abs=0.05)  # the clamp's rounding, width^2 / 4 T / gain, is the rest
    assert models.torques(15.0, shaft, shaft)[0].value == pytest.approx(20.0, abs=1e-3)


def test_events_of_all_models_in_order() -> None:
    models = Surroundings(scene(StepTorque(after=1.0, time=0.2), StepTorque(after=1.0, time=0.1)))
    assert [models.next_event(t) for t in (0.0, 0.1, 0.2)] == [0.1, 0.2, math.inf]
    assert models.next_sample(0.0) == math.inf and models.decide(0.1, REST, REST) is False
    plain = Surroundings(scene(ConstantTorque(torque_=1.0), QuadraticLoad(coefficient=1.0)))
    assert plain.next_event(0.0) == math.inf


def test_signals_are_what_observe_returns() -> None:
    models = Surroundings(scene(gearbox(), Dyno(speed=50.0, gain=2.0, integral_gain=40.0, torque_limit=1e3)))
    models.start(0.0, REST, REST)
    assert set(models.observe(0.0, REST, REST)) == set(models.signals)
    assert models.signals["engine.speed"] == "rad/s"


def test_without_states_the_models_cost_next_to_nothing() -> None:
    """At most 30 times a function call that makes two tuples: no hidden copying, slicing or searching."""
    models = Surroundings(scene(ConstantTorque(torque_=1.0), QuadraticLoad(coefficient=1.0)))
    models.start(0.0, REST, REST)
    shaft = Shaft(0.0, 10.0, 0.0)

    def reference() -> tuple[tuple[float, ...], tuple[float, ...]]:
        return (1.0, 2.0, 3.0), (1.0, shaft.speed, 3.0)

    def cost(call: Any) -> float:
        best = math.inf
        for _ in range(20):
            clock = time.perf_counter()
            for _ in range(1000):
                call()
            best = min(best, time.perf_counter() - clock)
        return best

    assert cost(lambda: models.torques(0.0, shaft, shaft)) < 30.0 * cost(reference)
    before = models.x
    models.advance(0.0, 1.0, None, None)  # type: ignore[arg-type]
    assert models.x is before


@pytest.mark.parametrize("tolerance", [0.0, 1e-8])
def test_states_that_are_much_too_fast_end_the_run(tolerance: float,
                                                   monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("cardan.models.stepping.MOST", 2000)  # the real limit takes ten seconds
    engine = TorqueMap(speeds=(0.0, 100.0), throttles=(0.0, 1.0), torques=((0.0, 0.0), (50.0, 100.0)), lag=1e-9)
    world = Surroundings(scene(engine, QuadraticLoad(coefficient=0.0)), tolerance=tolerance)
    world.start(0.0, Shaft(0.0, 10.0, 0.0), Shaft(0.0, 10.0, 0.0))

    def motion(s: float) -> Shaft:
        return Shaft(0.0, 10.0 + 100.0 * s, 100.0)

    with pytest.raises(ArithmeticError, match=r"more than 2000 sub-steps of .* s in a communication step of 0\.01 s"):
        world.advance(0.0, 0.01, motion, motion)


def test_a_coupling_with_short_steps_does_not_come_round_that_limit() -> None:
    engine = TorqueMap(speeds=(0.0, 100.0), throttles=(0.0, 1.0), torques=((0.0, 0.0), (50.0, 100.0)), lag=1e-9)
    load = QuadraticLoad(coefficient=0.0)
    made = SimpleNamespace(engine=engine, load=load, driver=None, communication_step=1e-3)
    world = Surroundings(made, tolerance=1e-8)
    still = Shaft(0.0, 0.0, 0.0)
    world.start(0.0, still, still)
    with pytest.raises(ArithmeticError, match=r"communication step of 0\.001 s"):
        world.advance(0.0, 1e-7, lambda s: still, lambda s: still)
