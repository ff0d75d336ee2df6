"""Millions of turns behind it: torques must be as sharp as in the first turn."""

from __future__ import annotations

import math
from collections.abc import Iterator

from .outcome import Outcome, hard_case, start, step


def torque_after(turns: float, k: float = 1e7) -> list[float]:
    """Shaft torque over a turn, starting `turns` whole turns on; twist dynamics at constant drive."""
    driveline = start({"joint1.angle": 0.3, "joint2.angle": 0.25, "shaft.stiffness": k, "shaft.damping": 50.0,
                       "initial.angle": 2.0 * math.pi * turns, "initial.speed": 300.0, "input.torque": 100.0,
                       "output.torque": 80.0})
    torques = []
    for i in range(50):
        step(driveline, i * 4e-4, 4e-4)
        torques.append(driveline.get("shaft.torque"))
    return torques


@hard_case(4, "1e6 and 1e7 turns behind it")
def many_turns() -> Iterator[Outcome]:
    """The states are the reduced angle and the twist, so the torque does not know the turns (PHYSICS.md 3).

    The start angle itself is a double: 2 pi n is off by up to half its last digit, which is what the
    reduced angle then starts with; that shift times the torque's slope is the whole difference.
    """
    first = torque_after(0.0)
    for turns in (1e6, 1e7):
        later = torque_after(turns)
        shift = math.ulp(2.0 * math.pi * turns)
        slope = max(abs(b - a) for a, b in zip(first, first[1:])) / (4e-4 * 300.0)
        worst = max(abs(a - b) for a, b in zip(first, later))
        yield Outcome(worst, 20.0 * slope * shift + 1e-6, "N.m", f"shaft torque after {turns:g} turns against turn 0, "
                      f"k = 1e7 N.m/rad")
        absolute = 1e7 * shift
        yield Outcome(worst / absolute, 0.05, "1",
                      f"the same over what absolute angles would give ({absolute:.1e} N.m)")
