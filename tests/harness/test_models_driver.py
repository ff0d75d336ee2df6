"""The driver, and the shipped pickup driven by him over a rigid driveline."""

from __future__ import annotations

import math
from pathlib import Path
from typing import NamedTuple

import pytest
from cardan.models.base import Bus, Shaft
from cardan.models.driver import Driver
from cardan.models.surroundings import Surroundings
from cardan.scenario import Scenario


def schedule(tmp_path: Path, text: str = "t,v\n0,0\n10,0\n20,8\n30,8\n") -> Path:
    path = tmp_path / "cycle.csv"
    path.write_text(text)
    return path


def test_pi_controller_with_anti_windup(tmp_path: Path) -> None:
    """u = gain e + i within (-1, 1); beyond, the integral is driven back with the rate integral_gain/gain (u' - u)."""
    driver = Driver(file=schedule(tmp_path), column="v", gain=0.3, integral_gain=0.06, travel=0.1, rounding=1e-6)
    x = [0.1, 0.2]
    rates = driver.derivative(25.0, x, Shaft(0.0, 70.0, 0.0), Bus())  # 8 m/s wanted, 7 driven
    assert rates == [pytest.approx(0.06, rel=1e-9), pytest.approx((0.3 + 0.1 - 0.2) / 0.15, rel=1e-9)]
    rates = driver.derivative(25.0, [5.0, 1.0], Shaft(0.0, 70.0, 0.0), Bus())
    assert rates[0] == pytest.approx(0.06 * (1.0 + (1.0 - 5.3) / 0.3), rel=1e-6)
    bus = Bus()
    driver.fill(25.0, [0.1, -0.4], Shaft(0.0, 70.0, 0.0), bus)
    assert (bus.throttle, bus.brake) == (pytest.approx(0.0, abs=1e-9), pytest.approx(0.4))


def test_standstill_holds_the_brake_and_forgets_the_integral(tmp_path: Path) -> None:
    driver = Driver(file=schedule(tmp_path), column="v", hold_brake=0.3)
    assert driver.start(0.0, Shaft(0, 0, 0), Bus()) == [0.0, -0.3]
    rates = driver.derivative(5.0, [0.2, -0.3], Shaft(0, 0, 0), Bus())
    assert rates[0] < 0.0


def test_corners_of_the_schedule_are_events_seen_early_by_the_preview(tmp_path: Path) -> None:
    driver = Driver(file=schedule(tmp_path), column="v", preview=0.3)
    t, events = -1.0, []
    while (t := driver.next_event(t)) < math.inf:
        events.append(t)
    assert events == pytest.approx([-0.3, 9.7, 19.7, 29.7])
    assert driver.target(15.0) == (pytest.approx(4.0), pytest.approx(0.8))


class Drive(NamedTuple):
    """What a drive over a rigid driveline showed, every 0.1 s."""

    time: list[float]
    seen: dict[str, list[float]]


def drive(stop: float, h: float) -> Drive:
    """Drive the shipped pickup with one rigid inertia J in place of the FMU.

    ``J w' = T_in - T_out`` with both torques as the slope coupling sends them, T + rate s + K (w - w0), is linear over
    a step and solved exactly.
    """
    scene = Scenario.load("pickup_udds")
    models = Surroundings(scene)
    inertia = scene.driveline["output.inertia"] + scene.driveline["input.inertia"]
    shaft = Shaft(0.0, 0.0, 0.0)
    models.start(0.0, shaft, shaft)
    time: list[float] = []
    seen: dict[str, list[float]] = {name: [] for name in models.signals}
    for i in range(round(stop / h)):
        t = i * h
        engine, load = models.torques(t, shaft, shaft)
        a, b, c = ((e - r) / inertia for e, r in zip(engine, load))

        def motion(s: float, w: float = shaft.speed, a: float = a, b: float = b, c: float = c) -> Shaft:
            if abs(c * s) < 1e-6:
                rise = s * (a + 0.5 * s * (b + c * a))
            else:
                rise = a * math.expm1(c * s) / c + b * (math.expm1(c * s) - c * s) / (c * c)
            return Shaft(0.0, w + rise, a + b * s + c * rise)

        models.advance(t, h, motion, motion)
        shaft = motion(h)
        models.decide((i + 1) * h, shaft, shaft)
        if (i + 1) % round(0.1 / h) == 0:
            time.append((i + 1) * h)
            for name, value in models.observe((i + 1) * h, shaft, shaft).items():
                seen[name].append(value)
    return Drive(time, seen)


@pytest.fixture(scope="module")
def pickup() -> Drive:
    return drive(200.0, 0.005)


def test_pickup_follows_the_schedule(pickup: Drive) -> None:
    """EPA's tolerance for a driver is +-2 mph (0.9 m/s) within a second (40 CFR 1066.425)."""
    errors = [v - r for v, r in zip(pickup.seen["vehicle.speed"], pickup.seen["driver.target_speed"])]
    assert math.sqrt(sum(e * e for e in errors) / len(errors)) < 0.25
    assert max(map(abs, errors)) < 0.9


def test_pickup_shifts_through_its_gears_without_hunting(pickup: Drive) -> None:
    gears = pickup.seen["gearbox.gear"]
    assert {1.0, 2.0, 3.0, 4.0} == set(gears)
    changes = [t for t, a, b in zip(pickup.time[1:], gears, gears[1:]) if a != b]
    assert 6 <= len(changes) <= 24
    assert min(b - a for a, b in zip(changes, changes[1:])) >= 0.99  # the dwell


def test_engine_never_stalls_and_idles_when_the_pickup_stands(pickup: Drive) -> None:
    rpm = [w * 30.0 / math.pi for w in pickup.seen["engine.speed"]]
    assert min(rpm) > 650.0 and max(rpm) < 4000.0
    standing = [n for t, n in zip(pickup.time, rpm) if 130.0 < t < 160.0]
    assert standing == pytest.approx([780.0] * len(standing), abs=10.0)


def test_pickup_stands_still_without_chatter(pickup: Drive) -> None:
    standing = [i for i, t in enumerate(pickup.time) if 127.0 < t < 162.0]
    speeds = [pickup.seen["vehicle.speed"][i] for i in standing]
    assert max(map(abs, speeds)) < 1e-3
    assert all(abs(b) <= abs(a) + 1e-9 for a, b in zip(speeds, speeds[1:]))  # it only ever settles
    brakes = [pickup.seen["driver.brake"][i] for i in standing]
    assert min(brakes) > 0.25 and max(brakes) - min(brakes) < 0.05


def test_smaller_steps_change_little() -> None:
    coarse, fine = (drive(60.0, h).seen["vehicle.speed"] for h in (0.01, 0.0025))
    assert max(abs(a - b) for a, b in zip(coarse, fine)) < 5e-3
