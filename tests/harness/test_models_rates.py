"""Every torque's rate and by_speed against eighth-order differences of its value.

``rate`` is the derivative along (t, angle, own states, pedals) moving with their own velocities at constant shaft
speed; ``by_speed`` the partial derivative by that speed. Differences of eighth order with step d have an error of
about d^8 f''''''''' / 630 and a rounding error of 1e-16 abs(T) / d, so 1e-8 relative is what they can show.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path

import pytest
from cardan.models.base import Bus, Discrete, Model, Shaft
from cardan.models.clutch import Clutch
from cardan.models.combined import Combined
from cardan.models.constant import ConstantTorque
from cardan.models.csv_torque import CsvTorque
from cardan.models.cylinder import Cylinder
from cardan.models.driver import Driver
from cardan.models.dyno import Dyno
from cardan.models.four_stroke import FourStroke
from cardan.models.gearbox import Gearbox
from cardan.models.governor import IdleGovernor
from cardan.models.road import RoadLoad
from cardan.models.shift import Gear, ShiftSchedule
from cardan.models.speed_laws import LinearLoad, PowerLoad, QuadraticLoad
from cardan.models.step import StepTorque
from cardan.models.stribeck import StribeckLoad
from cardan.models.torque_map import TorqueMap

WEIGHTS = (4 / 5, -1 / 5, 4 / 105, -1 / 280)


def slope(f: Callable[[float], float], d: float) -> float:
    return sum(c * (f(n * d) - f(-n * d)) for n, c in enumerate(WEIGHTS, start=1)) / d


def check(model: Model, t: float, x: list[float], shaft: Shaft, bus: Bus) -> None:
    found = model.torque(t, x, shaft, bus)
    xdot = model.derivative(t, x, shaft, bus)
    assert len(xdot) == len(x) == len(model.states)

    def along(s: float) -> float:
        moved = Bus(bus.throttle + s * bus.throttle_rate, bus.throttle_rate, bus.brake + s * bus.brake_rate,
                    bus.brake_rate, bus.discrete)
        return model.torque(t + s, [a + s * b for a, b in zip(x, xdot)],
                            Shaft(shaft.angle + s * shaft.speed, shaft.speed, shaft.acceleration), moved).value

    def faster(s: float) -> float:
        return model.torque(t, x, Shaft(shaft.angle, shaft.speed + s, shaft.acceleration), bus).value

    scale = abs(found.value) + 1.0
    step = 5e-3 / (1.0 + abs(shaft.speed))  # of the crank's motion: 4 steps are 0.02 rad
    assert found.rate == pytest.approx(slope(along, step), rel=1e-8, abs=1e-8 * scale)
    assert found.by_speed == pytest.approx(slope(faster, 1e-2), rel=1e-8, abs=1e-9 * scale)
    assert model.value(t, x, shaft, bus) == pytest.approx(found.value, rel=1e-14, abs=1e-14)


MAP = dict(speeds=(0.0, 90.0, 200.0, 330.0, 450.0), throttles=(0.0, 0.4, 1.0),
           torques=((-20.0, -30.0, -40.0, -55.0, -80.0), (60.0, 120.0, 140.0, 90.0, 10.0),
                    (90.0, 210.0, 260.0, 220.0, 60.0)))
CYLINDER = Cylinder(stroke=0.09, bore=0.085, rod=0.15, reciprocating_mass=0.6)
GOVERNOR = IdleGovernor(speed=85.0, gain=2.0, integral_gain=4.0, torque_high=110.0)
CLUTCH = Clutch(capacity=600.0, engage_speed=90.0, full_speed=180.0, slip_speed=15.0)
SHIFT = ShiftSchedule(up=200.0, up_full=350.0, down=100.0, down_full=180.0)


def gearbox(source: Model) -> Gearbox:
    return Gearbox(source, ratios=(4.0, 2.4, 1.5), engine_inertia=0.3, initial_speed=85.0, clutch=CLUTCH, shift=SHIFT,
                   efficiency=0.94)


@pytest.fixture
def series(tmp_path: Path) -> Path:
    path = tmp_path / "torque.csv"
    path.write_text("# measured\nt,M\n0,10\n1,40\n2,35\n3,-20\n4.5,5\n")
    return path


SHAFTS = [Shaft(0.3, 140.0, 50.0), Shaft(-7.1, 12.5, -80.0), Shaft(2.0, -3.0, 5.0)]
SIMPLE: list[tuple[Model, list[float]]] = [
    (ConstantTorque(torque_=80.0), []),
    (LinearLoad(coefficient=0.7, torque_=5.0), []),
    (QuadraticLoad(coefficient=0.01), []),
    (PowerLoad(coefficient=3.0, exponent=4.0, reference=50.0), []),
    (PowerLoad(coefficient=3.0, exponent=2.5, reference=50.0), []),
    (RoadLoad(mass=2000.0, wheel_radius=0.4, axle_ratio=3.4, rolling=0.01, drag_coefficient=0.4, frontal_area=2.8,
              a=20.0, b=3.0, c=0.1, grade=0.03, brake_force=15e3), []),
    (Dyno(speed=20.0, gain=4.0, integral_gain=9.0, torque_limit=400.0, final_speed=130.0, ramp_time=4.0), [17.0]),
    (Dyno(speed=20.0, gain=4.0, integral_gain=9.0, torque_limit=400.0, final_speed=130.0, ramp_time=4.0,
          shape="smooth"), [-30.0]),
    (StribeckLoad(sliding=30.0, breakaway=50.0, stribeck_speed=2.0, viscous=0.1, smoothing=0.5), []),
    (StepTorque(after=100.0, time=0.9, before=-5.0, width=1.0), []),
    (TorqueMap(**MAP), []),
    (TorqueMap(**MAP, interpolation="linear"), []),
    (TorqueMap(**MAP, lag=0.1), [77.0]),
    (GOVERNOR, [12.0]),
    (FourStroke(torque_=90.0, orders=(2.0, 4.0, 0.5), amplitudes=(70.0, 20.0, 3.0),
                relative_amplitudes=(0.5, 0.1, 0.0), phases=(0.3, -1.0, 2.0), phase=0.4, friction=15.0), []),
    (FourStroke(map=TorqueMap(**MAP), cylinder=CYLINDER, cylinders=4), []),
    (FourStroke(map=TorqueMap(**MAP, lag=0.1), cylinder=CYLINDER, cylinders=3), [60.0]),
    (Combined(TorqueMap(**MAP, lag=0.1), GOVERNOR), [50.0, 3.0]),
]


@pytest.mark.parametrize(("model", "x"), SIMPLE, ids=lambda m: m.kind if isinstance(m, Model) else "")
@pytest.mark.parametrize("shaft", SHAFTS)
def test_rates(model: Model, x: list[float], shaft: Shaft) -> None:
    check(model, 1.37, x, shaft, Bus(0.55, -0.8, 0.2, 0.5))


@pytest.mark.parametrize("interpolation", ["pchip", "linear"])
def test_rates_of_a_series(series: Path, interpolation: str) -> None:
    check(CsvTorque(file=series, column="M", interpolation=interpolation, factor=2.0), 1.37, [], SHAFTS[0], Bus())


@pytest.mark.parametrize("source", [TorqueMap(**MAP, lag=0.1), Combined(TorqueMap(**MAP), GOVERNOR),
                                    FourStroke(map=TorqueMap(**MAP, lag=0.2), cylinder=CYLINDER)])
@pytest.mark.parametrize("discrete", [
    Gear(2, 2, -math.inf, 9),
    Gear(2, 1, 1.3, 9),  # opening: still the ratio of first gear
    Gear(2, 3, 1.0, 9),  # closing on second gear
])
@pytest.mark.parametrize("shaft", [Shaft(0.3, 60.0, 5.0), Shaft(0.3, 45.0, 5.0), Shaft(0.3, 80.0, 5.0)])
def test_rates_of_a_gearbox(source: Model, discrete: Discrete, shaft: Shaft) -> None:
    box = gearbox(source)
    x = [143.0, 5.0][: 2 if getattr(source, "turns", False) else 1] + [40.0, 2.0][: len(source.states)]
    check(box, 1.37, x, shaft, Bus(0.55, -0.8, 0.0, 0.0, discrete))


def test_rates_of_the_pedals(series: Path) -> None:
    """throttle_rate and brake_rate against differences along the driver's own motion."""
    series.write_text("t,v\n0,0\n1,4\n2,3\n4,12\n")
    driver = Driver(file=series, column="v", preview=0.2, feed_forward=0.1, travel=0.1)
    for pedal in (-0.4, -0.01, 0.02, 0.6):
        x, bus = [0.05, pedal], Bus()
        rates = driver.fill(1.37, x, SHAFTS[1], bus)
        assert rates == driver.derivative(1.37, x, SHAFTS[1], bus)
        throttle_rate, brake_rate = bus.throttle_rate, bus.brake_rate

        def pedals(s: float, x: list[float] = x, rates: list[float] = rates) -> Bus:
            moved = Bus()
            driver.fill(1.37, [a + s * b for a, b in zip(x, rates)], SHAFTS[1], moved)
            return moved

        assert throttle_rate == pytest.approx(slope(lambda s: pedals(s).throttle, 1e-4), rel=1e-7, abs=1e-9)
        assert brake_rate == pytest.approx(slope(lambda s: pedals(s).brake, 1e-4), rel=1e-7, abs=1e-9)
