"""Clutch, shift schedule and gearbox."""

from __future__ import annotations

import math

import pytest
from cardan.models.base import Bus, Shaft
from cardan.models.clutch import Clutch
from cardan.models.constant import ConstantTorque
from cardan.models.four_stroke import FourStroke
from cardan.models.gearbox import Gearbox
from cardan.models.parameters import ParameterError
from cardan.models.shift import Gear, ShiftSchedule
from hypothesis import given
from hypothesis import strategies as st

RATIOS = (4.0, 2.4, 1.5)
CLUTCH = Clutch(capacity=600.0, engage_speed=90.0, full_speed=180.0, slip_speed=15.0)
SHIFT = ShiftSchedule(up=200.0, up_full=350.0, down=100.0, down_full=180.0, sample_time=0.1, dwell=1.0, open_time=0.2,
                      close_time=0.4)


def box(**changes: object) -> Gearbox:
    given = dict(ratios=RATIOS, engine_inertia=0.3, initial_speed=85.0, clutch=CLUTCH, shift=SHIFT)
    return Gearbox(ConstantTorque(torque_=120.0), **{**given, **changes})  # type: ignore[arg-type]


@given(st.floats(0.0, 600.0), st.floats(-50.0, 600.0))
def test_clutch_never_drags_the_engine_below_its_engagement_speed(engine: float, turbine: float) -> None:
    """It never exceeds its capacity, acts against the slip, and transmits nothing where both sides are slow: no
    stalling."""
    found = CLUTCH.torque(engine, turbine, 1.0)
    assert abs(found.value) <= 600.0
    assert found.value * (engine - turbine) >= 0.0
    assert CLUTCH.value(engine, turbine, 1.0) == pytest.approx(found.value, abs=1e-12)
    if engine < 88.0 and turbine < 80.0:  # the rounded larger speed is then below 90 rad/s
        assert found.value == 0.0


def test_clutch_torque_is_smooth_in_closure_and_slip() -> None:
    values = [CLUTCH.value(200.0, 200.0 - 0.1 * i, 1.0) for i in range(-1000, 1001)]
    steps = [b - a for a, b in zip(values, values[1:])]
    assert min(steps) >= 0.0 and max(steps) <= 600.0 / 15.0 * 0.1 * (1 + 1e-9)


def test_shift_changes_the_ratio_where_the_clutch_transmits_nothing() -> None:
    now = Gear(2, 1, 10.0, 0)
    assert SHIFT.closure(10.0, now) == (1, 1.0, pytest.approx(0.0))
    assert SHIFT.closure(math.nextafter(10.2, 0.0), now)[:2] == (1, pytest.approx(0.0, abs=1e-12))
    assert SHIFT.closure(10.2 + 1e-9, now)[:2] == (2, pytest.approx(0.0, abs=1e-12))
    assert SHIFT.closure(10.6, now) == (2, pytest.approx(1.0), pytest.approx(0.0, abs=1e-12))
    torques = [box().value(10.0 + 1e-3 * i, [180.0], Shaft(0.0, 60.0, 0.0), Bus(discrete=now)) for i in range(700)]
    assert max(abs(b - a) for a, b in zip(torques, torques[1:])) < 0.02 * max(map(abs, torques))


def test_gears_follow_speed_with_hysteresis() -> None:
    """Slowly up and down again: every gear is used, and each shift down comes below the speed of the shift up."""
    now = Gear(1, 1, -math.inf, 0)
    history: list[tuple[float, int]] = []
    for i in range(4000):
        t = 0.1 * i
        speed = 200.0 - abs(i - 2000) * 0.1
        after = SHIFT.select(t, speed, RATIOS, 0.0, now)
        if after.gear != now.gear:
            history.append((speed, after.gear))
        now = after
    assert [gear for _, gear in history] == [2, 3, 2, 1]
    up1, up2, down2, down1 = (speed for speed, _ in history)
    assert up1 == pytest.approx(200.0 / 4.0, abs=0.2) and up2 == pytest.approx(200.0 / 2.4, abs=0.2)
    assert down2 == pytest.approx(100.0 / 1.5, abs=0.2) and down1 == pytest.approx(100.0 / 2.4, abs=0.2)


def test_full_throttle_shifts_later() -> None:
    now = Gear(1, 1, -math.inf, 0)
    assert SHIFT.select(0.0, 60.0, RATIOS, 0.0, now).gear == 2
    assert SHIFT.select(0.0, 60.0, RATIOS, 1.0, now).gear == 1


def test_decisions_fall_on_their_own_times_whatever_the_steps_are() -> None:
    """Fine and coarse communication points give the same gear at the same time; asking twice changes nothing."""
    for h in (0.01, 0.025, 0.05):
        now = Gear(1, 1, -math.inf, SHIFT.sample_at(0.0) + 1)
        for i in range(1, round(1.0 / h) + 1):
            now = SHIFT.select(i * h, 20.0 + 60.0 * i * h, RATIOS, 0.0, now)
            assert SHIFT.select(i * h, 999.0, RATIOS, 0.0, now) == now
        assert (now.gear, now.since) == (2, pytest.approx(0.6))  # 50 rad/s is passed at 0.5 s
    gearbox = box()
    assert gearbox.next_sample(0.0) == pytest.approx(0.1) and gearbox.next_sample(0.34) == pytest.approx(0.4)
    start = gearbox.start_discrete(0.0, Shaft(0.0, 0.0, 0.0))
    assert gearbox.decide(0.05, [85.0], Shaft(0.0, 300.0, 0.0), Bus(discrete=start), start) == (start, False)
    after, jumped = gearbox.decide(0.1, [85.0], Shaft(0.0, 300.0, 0.0), Bus(discrete=start), start)
    assert jumped and after == Gear(2, 1, 0.1, 2)


def test_dwell_keeps_the_gear() -> None:
    now = SHIFT.select(0.0, 60.0, RATIOS, 0.0, Gear(1, 1, -math.inf, 0))
    for i in range(1, 10):
        now = SHIFT.select(0.1 * i, 10.0, RATIOS, 0.0, now)
        assert now.gear == 2
    assert SHIFT.select(1.0, 10.0, RATIOS, 0.0, now).gear == 1


def test_torque_on_the_shaft_is_the_ratio_times_the_clutch_less_the_loss() -> None:
    """Ideal gears transmit i T_c; with 96 % a large torque arrives as 0.96 i T_c forward and 1.04 i T_c backward."""
    for speed, share in ((50.0, 0.96), (100.0, 1.04)):
        bus = Bus(discrete=Gear(2, 2, -math.inf, 0))
        clutch = CLUTCH.value(180.0, 2.4 * speed, 1.0)
        ideal = box().value(0.0, [180.0], Shaft(0.0, speed, 0.0), bus)
        lossy = box(efficiency=0.96).value(0.0, [180.0], Shaft(0.0, speed, 0.0), bus)
        assert ideal == pytest.approx(2.4 * clutch, rel=1e-14)
        assert lossy == pytest.approx(share * 2.4 * clutch, rel=1e-3)  # the loss is rounded over 5 N.m
        assert box().derivative(0.0, [180.0], Shaft(0.0, speed, 0.0), bus) == [pytest.approx((120.0 - clutch) / 0.3)]


def test_ripple_follows_the_crank() -> None:
    """With a four-stroke engine the crank angle is a state and moves with the engine, not with the shaft."""
    engine = FourStroke(torque_=100.0, orders=(2.0,), amplitudes=(80.0,))
    gearbox = Gearbox(engine, ratios=RATIOS, engine_inertia=0.3, initial_speed=85.0, clutch=CLUTCH, shift=SHIFT)
    assert gearbox.states[:2] == ("engine.speed [rad/s]", "engine.angle [rad]")
    bus = Bus(discrete=Gear(1, 1, -math.inf, 0))
    rates = [gearbox.derivative(0.0, [85.0, angle], Shaft(shaft, 0.0, 0.0), bus) for angle, shaft in
             ((0.0, 0.0), (0.0, 1.0), (math.pi / 2, 0.0))]
    assert rates[0] == rates[1] == [pytest.approx(180.0 / 0.3), 85.0]
    assert rates[2] == [pytest.approx(20.0 / 0.3), 85.0]


@pytest.mark.parametrize(("changes", "key"), [
    ({"ratios": (2.0, 3.0)}, "ratios"), ({"ratios": ()}, "ratios"), ({"initial_gear": 4}, "initial_gear"),
    ({"efficiency": 1.1}, "efficiency"), ({"engine_inertia": 0.0}, "engine_inertia"), ({"clutch": None}, "clutch"),
    ({"shift": ShiftSchedule(up=200.0, up_full=350.0, down=130.0, down_full=180.0)}, "shift.down"),
])
def test_what_does_not_fit_is_named(changes: dict[str, object], key: str) -> None:
    with pytest.raises(ParameterError) as caught:
        box(**changes)
    assert caught.value.key == key
