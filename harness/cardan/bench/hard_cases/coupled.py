"""A stiff spring outside the FMU: what each coupling does to a vibration that it does not damp."""

from __future__ import annotations

import math
from collections.abc import Iterator

from .outcome import Outcome, hard_case, start, step

FREQUENCY = 100.0  # rad/s of a flywheel of 1 kg.m2 on a spring outside
WHEEL = {"model.fidelity": 1, "input.inertia": 1.0, "output.inertia": 0.0, "shaft.inertia_a": 0.0,
         "shaft.inertia_b": 0.0, "initial.angle": 1.0}
START_UP = (1 / 64, 1 / 64, 1 / 32, 1 / 16, 1 / 8, 1 / 4, 1 / 2)


def growth(ratio: float, degree: int, slopes: bool, settle: int = 20, count: int = 60) -> float:
    """Growth rate of the amplitude (1/s) with h = ratio / w_n.

    Two solutions span an area of the phase plane; half the growth of its logarithm is the growth of the amplitude,
    without the ripple that the amplitude itself shows.
    """
    areas = [vibration(ratio, degree, slopes, angle, settle, count) for angle in (0.0, 1.0)]
    (a0, a1), (b0, b1) = areas
    before = abs(a0[0] * b0[1] - a0[1] * b0[0])
    after = abs(a1[0] * b1[1] - a1[1] * b1[0])
    return math.log(after / before) / (2.0 * count * ratio / FREQUENCY)


Point = tuple[float, float]


def vibration(ratio: float, degree: int, slopes: bool, angle: float, settle: int, count: int) -> tuple[Point, Point]:
    """Angle and speed of the wheel after `settle` and after `count` more steps, from a start at `angle` (rad)."""
    h = ratio / FREQUENCY
    driveline = start({**WHEEL, "hold.degree": degree, "initial.angle": angle,
                       "initial.speed": FREQUENCY * (1.0 - angle)}, 1e-12)
    lengths = [h * part for part in START_UP] if degree > 1 else [h]
    lengths += [h] * (settle + count - 1)
    points: list[Point] = []
    t = 0.0
    for length in lengths:
        driveline.set("input.torque", -FREQUENCY**2 * driveline.get("input.angle"))
        if slopes:
            driveline.set("input.torque.der1", -FREQUENCY**2 * driveline.get("input.speed"))
        step(driveline, t, length)
        t += length
        points.append((driveline.get("input.angle"), driveline.get("input.speed") / FREQUENCY))
    return points[-1 - count], points[-1]


@hard_case(13, "stiff spring outside the FMU, w_n h = 0.1 to 2")
def stiff_coupling() -> Iterator[Outcome]:
    """Held torques add negative damping w_n^2 h / 4 (PHYSICS.md 6); exactly ln(1 + (w_n h)^2 / 2) / (2 h)."""
    for ratio in (0.1, 0.2, 0.4, 1.0, 2.0):
        h = ratio / FREQUENCY
        rate = growth(ratio, 0, False)
        exact = math.log(1.0 + 0.5 * ratio**2) / (2.0 * h)
        yield Outcome(abs(rate / exact - 1.0), 1e-6, "1", f"held, w_n h = {ratio:g}: growth against the exact map's")
        if ratio < 0.45:
            yield Outcome(abs(rate / (FREQUENCY**2 * h / 4.0) - 1.0), 0.05, "1",
                          f"held, w_n h = {ratio:g}: growth against w_n^2 h / 4")
    held = FREQUENCY**2 / 4.0
    for name, degree, limits in (("slope", 1, {0.1: 0.002, 0.4: 0.03}), ("hermite3", 3, {0.1: 0.0, 0.4: 0.0, 1.0: 0.0}),
                                 ("hermite5", 5, {0.1: 1e-7, 0.4: 1e-4})):
        for ratio, limit in limits.items():
            yield Outcome(growth(ratio, degree, True) / (held * ratio / FREQUENCY), limit, "1",
                          f"{name}, w_n h = {ratio:g}: growth over the held scheme's (negative: decays)")
