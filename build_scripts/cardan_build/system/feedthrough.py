"""Which inputs of a part act on which output at once, found by trying."""

from __future__ import annotations

import itertools
import math
from pathlib import Path
from typing import Any

from .part.part import Part

SPEEDS = (0.0, -3.0, 40.0, 120.0, 350.0, 1000.0)  # rad/s
ANGLES = (0.0, 0.7)  # rad
PEDALS = (0.0, 0.3, 1.0)
STEP = 1e-3  # s


def find(data: dict[str, Any], folder: Path) -> dict[str, tuple[str, ...]]:
    """Return output -> inputs that act on it without a step between.

    At many points, before and after a step and when a decision is due, each input is replaced by another value and by
    NaN: a torque that does not use an input stays the same number with both. Branches of a law that hide an input at
    one point show it at another.

    Parameters
    ----------
    data : dict
        Content of ``part.json``.
    folder : Path
        Where its files are.
    """
    names = {kind: [each["name"] for each in data["variables"] if each["causality"] == kind]
             for kind in ("input", "output")}
    found: dict[str, set[str]] = {name: set() for name in names["output"]}
    part = Part(data, folder)
    fresh = part.get_state()
    for point in _points(names["input"]):
        part.set_state(fresh)
        part.setup_experiment(0.0)
        part.enter_initialization_mode()
        for name, value in point.items():
            part.set(name, value)
        part.exit_initialization_mode()
        time = 0.0
        for end in (0.0, STEP, part.next_sample(STEP)):  # decisions follow the inputs of their moment
            if end > time and not (end < math.inf and part.do_step(time, end - time)):
                continue
            time = end
            before = {name: part.get(name) for name in names["output"]}
            for name in names["input"]:
                for other in (point[name] * 1.3 + 0.01, math.nan):
                    part.set(name, other)
                    for output, value in before.items():
                        if part.get(output) != value:
                            found[output].add(name)
                part.set(name, point[name])
    return {output: tuple(name for name in names["input"] if name in those) for output, those in found.items()}


def _points(names: list[str]) -> list[dict[str, float]]:
    def choices(name: str) -> tuple[float, ...]:
        if name == "shaft.speed":
            return SPEEDS
        return ANGLES if name == "shaft.angle" else PEDALS if not name.endswith(".der1") else (0.4,)

    return [dict(zip(names, values)) for values in itertools.product(*map(choices, names))]
