"""Results of different steps and tolerances, and how far they are from each other."""

from __future__ import annotations

import math
import random
from collections.abc import Sequence
from typing import Any

from cardan.check.excitation import Excitation
from cardan.check.quantities import attribute
from cardan.check.rig import Rig
from cardan.check.subject import Subject
from cardan.check.trajectory import run

MEET = 4  # even steps after which uneven ones come to the same point
Values = list[float]


def watched(subject: Subject) -> list[Any]:
    """Return the continuous Real outputs: what converges when steps or tolerances get smaller."""
    return [each for each in subject.outputs if each.type == "Real" and each.variability == "continuous"]


def results(subject: Subject, times: Sequence[float], tolerance: float | None = None) -> list[Values]:
    """Run a fresh instance with inputs at rest; one row of the watched outputs per communication point."""
    rig = Rig(subject)
    rows = run(rig, times, Excitation(subject).held, watched(subject), tolerance=tolerance)
    rig.free()
    return [[float(value) for value in row] for row in rows]


def scales(subject: Subject, rows: Sequence[Values]) -> Values:
    """Return the size of each output: its largest absolute value in a run, at least its nominal value if given.

    An output that is zero but for rounding has no size of its own; the nominal value gives it one.
    """
    sizes = []
    for place, variable in enumerate(watched(subject)):
        seen = max((abs(row[place]) for row in rows if math.isfinite(row[place])), default=0.0)
        sizes.append(max(seen, attribute(variable, "nominal") or 0.0, 1e-300))
    return sizes


def distance(one: Values, other: Values, sizes: Values) -> float:
    """Return the largest difference of two rows in parts of the sizes."""
    return max((abs(a - b) / size for a, b, size in zip(one, other, sizes)), default=0.0)


def farthest(subject: Subject, one: Values, other: Values, sizes: Values) -> str:
    """Return the name of the output for which `distance` is largest."""
    parts = [abs(a - b) / size for a, b, size in zip(one, other, sizes)]
    return str(watched(subject)[parts.index(max(parts))].name)


def uneven(start: float, step: float, count: int, seed: int = 1) -> list[float]:
    """Return communication points with steps from a fifth to twice `step` that meet every `MEET`-th even one.

    Parameters
    ----------
    start, step : float
        Of the even points, s.
    count : int
        Number of even steps, a multiple of `MEET`.
    """
    chance = random.Random(seed)
    times = [start]
    for block in range(MEET, count + 1, MEET):
        end = start + block * step
        while end - times[-1] > 2.2 * step:
            times.append(times[-1] + step * chance.uniform(0.2, 2.0))
        times.append(end)
    return times
