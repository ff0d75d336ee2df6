"""Loads against their equations."""

from __future__ import annotations

import math

import pytest
from cardan.models.base import Bus, Shaft
from cardan.models.constant import ConstantTorque
from cardan.models.dyno import Dyno
from cardan.models.parameters import ParameterError
from cardan.models.road import GRAVITY, RoadLoad
from cardan.models.speed_laws import LinearLoad, PowerLoad, QuadraticLoad
from cardan.models.step import StepTorque
from cardan.models.stribeck import StribeckLoad


def at(speed: float) -> Shaft:
    return Shaft(0.7, speed, 3.0)


@pytest.mark.parametrize("speed", [-30.0, 0.0, 55.0])
def test_laws_of_speed(speed: float) -> None:
    assert ConstantTorque(torque_=80.0).torque(0.0, [], at(speed), Bus()) == (80.0, 0.0, 0.0)
    assert LinearLoad(coefficient=0.5, torque_=3.0).torque(0.0, [], at(speed), Bus()) == (3.0 + 0.5 * speed, 0.0, 0.5)
    assert QuadraticLoad(coefficient=0.01).torque(0.0, [], at(speed), Bus()) == (
        pytest.approx(0.01 * speed * abs(speed)), 0.0, pytest.approx(0.02 * abs(speed)))
    fourth = PowerLoad(coefficient=3000.0, exponent=4.0, reference=100.0).torque(0.0, [], at(speed), Bus())
    assert fourth.value == pytest.approx(3000.0 * abs(speed / 100.0) ** 4 * math.copysign(1.0, speed))


def test_road_is_the_sum_of_its_resistances() -> None:
    """F = rolling m g cos a + A + B v + (C + rho cd A_f/2) v^2 + m g sin a; T = F R / i; J = (m R^2 + n J_w) / i^2."""
    road = RoadLoad(mass=2325.0, wheel_radius=0.4064, axle_ratio=3.42, wheel_inertia=2.38, rolling=0.009,
                    drag_coefficient=0.4, frontal_area=2.88, air_density=1.2, a=10.0, b=2.0, c=0.05, grade=0.05)
    v = 20.0
    slope = math.atan(0.05)
    force = (0.009 * 2325.0 * GRAVITY * math.cos(slope) + 10.0 + 2.0 * v + (0.05 + 0.6 * 0.4 * 2.88) * v * v
             + 2325.0 * GRAVITY * math.sin(slope))
    shaft = at(v * 3.42 / 0.4064)
    assert road.value(0.0, [], shaft, Bus()) == pytest.approx(force * 0.4064 / 3.42, rel=1e-13)
    assert road.inertia == pytest.approx((2325.0 * 0.4064**2 + 4 * 2.38) / 3.42**2, rel=1e-14)
    assert road.observe(0.0, [], shaft, Bus(), ()) == {"vehicle.speed": pytest.approx(20.0)}


def test_road_brakes_against_the_motion_and_vanishes_at_standstill() -> None:
    road = RoadLoad(mass=1000.0, wheel_radius=0.3, brake_force=8e3)
    for speed in (10.0, -10.0):
        braked = road.torque(0.0, [], at(speed), Bus(brake=0.5))
        assert braked.value == pytest.approx(math.copysign(0.5 * 8e3 * 0.3, speed))
    assert road.value(0.0, [], at(0.0), Bus(brake=1.0)) == 0.0
    assert road.torque(0.0, [], at(0.0), Bus(brake=1.0)).by_speed > 0.0


def test_stribeck_hump_and_tail() -> None:
    load = StribeckLoad(sliding=30.0, breakaway=50.0, stribeck_speed=2.0, viscous=0.1, smoothing=0.001)
    assert load.value(0.0, [], at(0.02), Bus()) == pytest.approx(50.0, rel=1e-3)
    assert load.value(0.0, [], at(-20.0), Bus()) == pytest.approx(-32.0, rel=1e-12)
    assert load.torque(0.0, [], at(1.0), Bus()).by_speed < 0.0  # the falling branch that makes stick-slip
    with pytest.raises(ParameterError, match="breakaway"):
        StribeckLoad(sliding=30.0, breakaway=20.0)


def test_step_is_an_event_or_smooth() -> None:
    jump = StepTorque(after=100.0, time=0.3, before=20.0)
    assert jump.next_event(0.0) == 0.3 and jump.next_event(0.3) == math.inf
    values = [jump.value(t, [], at(1.0), Bus()) for t in (math.nextafter(0.3, 0.0), 0.3)]
    assert values == [20.0, 100.0]
    smooth = StepTorque(after=100.0, time=0.3, before=20.0, width=0.2)
    assert smooth.next_event(0.0) == math.inf
    assert smooth.torque(0.4, [], at(1.0), Bus()) == (pytest.approx(60.0), pytest.approx(80.0 * 1.875 / 0.2), 0.0)


def test_dyno_holds_a_speed_within_its_torque() -> None:
    """Inside the limits a PI controller, u = kp e + i; outside the limit holds and the integral comes back."""
    dyno = Dyno(speed=100.0, gain=5.0, integral_gain=10.0, torque_limit=300.0, rounding=1e-3)
    assert dyno.torque(0.0, [40.0], at(110.0), Bus()).value == pytest.approx(5.0 * 10.0 + 40.0, abs=1e-6)
    assert dyno.derivative(0.0, [40.0], at(110.0), Bus()) == [pytest.approx(100.0, abs=1e-4)]
    assert dyno.value(0.0, [0.0], at(900.0), Bus()) == pytest.approx(300.0, abs=1e-6)
    assert dyno.value(0.0, [0.0], at(-900.0), Bus()) == pytest.approx(-300.0, abs=1e-6)
    assert dyno.derivative(0.0, [500.0], at(100.0), Bus())[0] < 0.0
    ramp = Dyno(speed=0.0, gain=5.0, integral_gain=1.0, torque_limit=300.0, final_speed=50.0, ramp_time=2.0)
    assert ramp.observe(1.0, [0.0], at(0.0), Bus(), ()) == {"dyno.target_speed": 25.0}
    assert ramp.next_event(0.5) == 2.0
