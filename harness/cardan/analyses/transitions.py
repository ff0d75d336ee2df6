"""Regions of parametric instability: their borders over the speed, by root finding on the return map.

The rotation number of twist perturbations falls with the speed; region n is where it rests at n half turns per half
turn of the shaft, at a speed of about w_n/n. There the multipliers leave the unit circle through (-1)^n, and
det(M - (-1)^n) changes its sign at the borders. Regions are looked for by their rotation number, so none is missed
because it is narrow; borders are roots of the determinant (Brent's method), growth is maximized between them.
"""

from __future__ import annotations

import contextlib
import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from cardan.analyses.borders import Evaluate, Known, border, crossing, largest_growth, lowest, outside
from cardan.analyses.periodic import NoSteadyState
from cardan.analyses.section import Section

LEAST_GROWTH = 1e-10  # per turn: what is weaker is not told from none
TYPES = ("", "principal", "higher")


@dataclass(frozen=True)
class Transition:
    """One region of instability at one joint angle.

    Attributes
    ----------
    angle : float
        Joint angle, rad.
    region : int
        1 principal, 2, .. higher; 0 where it is none of these (`type` says what).
    type : str
        ``principal``, ``higher``, ``sum`` (a pair of multipliers off the real axis) or ``drift`` (the mean speed).
    speed_low, speed_high : float
        Borders, rad/s; NaN where the region goes on beyond where it was followed.
    growth_per_turn : float
        Largest in the region: perturbations go as exp(growth * turns of the input shaft).
    speed_worst : float
        Where, rad/s.
    """

    angle: float
    region: int
    type: str
    speed_low: float
    speed_high: float
    growth_per_turn: float
    speed_worst: float

    def summary(self) -> dict[str, Any]:
        """Return the figures, ready for JSON."""
        return {key: (None if isinstance(value, float) and not math.isfinite(value) else value)
                for key, value in vars(self).items()}


@dataclass(frozen=True)
class Resonance:
    """A speed at which the motion itself resonates with the joints.

    Attributes
    ----------
    angle : float
        Joint angle, rad.
    order : int
        Order of the shaft speed that excites it.
    speed : float
        rad/s.
    """

    angle: float
    order: int
    speed: float


def find_regions(evaluate: Evaluate, speeds: list[float], sections: list[Section | None], angle: float,
                 period_angle: float = math.pi) -> tuple[list[Transition], list[Resonance]]:
    """Find the regions that the range of speeds meets.

    Parameters
    ----------
    evaluate : callable
        Speed (rad/s) -> `Section`.
    speeds : list of float
        A grid over the range, increasing, rad/s.
    sections : list of Section or None
        The return maps there; None where there is no motion.
    angle : float
        Joint angle, rad, for the result.
    period_angle : float
        Turn of the shaft over one period, rad.
    """
    known = [(s, x) for s, x in zip(speeds, sections) if x is not None and x.matrix.size]
    if not known:
        return [], []
    numbers = [x.rotation / math.pi for _, x in known]
    regions: list[Transition] = []
    resonances: list[Resonance] = []
    for n in range(max(1, math.ceil(min(numbers) - 1e-9)), math.floor(max(numbers) + 1e-9) + 1):
        found, passing = _region(evaluate, known, n, angle)
        if found is not None:
            regions.append(found)
        elif n % 2 == 0 and math.isfinite(passing) and _forced(known, passing):
            resonances.append(Resonance(angle, round(n * math.pi / period_angle), passing))
    regions += _others(evaluate, known, angle, regions)
    return sorted(regions, key=lambda r: (r.speed_low if math.isfinite(r.speed_low) else r.speed_worst)), resonances


def _region(evaluate: Evaluate, known: Known, n: int, angle: float) -> tuple[Transition | None, float]:
    """Find region n; else the speed where the rotation number passes n half turns."""
    sign = -1.0 if n % 2 else 1.0
    seen = dict(known)

    def at(speed: float) -> Section:
        if speed not in seen:
            seen[speed] = evaluate(speed)
        return seen[speed]

    def distance(speed: float) -> float:
        return at(speed).distance(sign)

    def half_turns(speed: float) -> float:
        return at(speed).rotation / math.pi

    left, right = outside(half_turns, known, n, -1), outside(half_turns, known, n, +1)
    if left is None and right is None:
        return None, math.nan
    inside = [s for s, x in known if x.distance(sign) < 0.0 and abs(x.rotation / math.pi - n) < 0.5]
    low, high = left if left is not None else known[0][0], right if right is not None else known[-1][0]
    with contextlib.suppress(NoSteadyState):
        centre = min(inside, key=distance) if inside else lowest(distance, half_turns, low, high, n)
        if centre is not None and distance(centre) < 0.0:
            border_low, border_high = border(distance, left, centre), border(distance, centre, right)
            growth, worst = largest_growth(at, border_low if math.isfinite(border_low) else low,
                                            border_high if math.isfinite(border_high) else high, centre)
            if growth >= LEAST_GROWTH:
                return Transition(angle, n, TYPES[min(n, 2)], border_low, border_high, growth, worst), math.nan
    return None, math.nan if n % 2 else crossing(half_turns, low, high, n)


def _forced(known: Known, speed: float) -> bool:
    """Whether the motion near a speed twists at all: without that nothing resonates."""
    near = min(known, key=lambda pair: abs(pair[0] - speed))
    return near[1].swing > 1e-9


def _others(evaluate: Evaluate, known: Known, angle: float,
            regions: list[Transition]) -> list[Transition]:
    """Group unstable points of the grid that belong to none of the regions."""
    from scipy.optimize import brentq

    def growth(speed: float) -> float:
        return evaluate(speed).growth - 1e-12

    def covered(speed: float) -> bool:
        return any((not r.speed_low > speed) and (not r.speed_high < speed) for r in regions)

    found = []
    i = 0
    while i < len(known):
        if known[i][1].growth <= 1e-9 or covered(known[i][0]):
            i += 1
            continue
        start = i
        while i + 1 < len(known) and known[i + 1][1].growth > 1e-9 and not covered(known[i + 1][0]):
            i += 1
        borders = []
        for inner, outer in ((start, start - 1), (i, i + 1)):
            found_border = math.nan
            if 0 <= outer < len(known) and known[outer][1].growth <= 0.0:
                a, b = sorted((known[inner][0], known[outer][0]))
                with contextlib.suppress(NoSteadyState, ValueError):
                    found_border = float(brentq(growth, a, b, xtol=1e-12 * b))
            borders.append(found_border)
        worst = max(known[start:i + 1], key=lambda pair: pair[1].growth_per_turn)
        largest = worst[1].multipliers[int(np.argmax(np.abs(worst[1].multipliers)))]
        kind = "sum" if abs(largest.imag) > 1e-9 else "drift"
        found.append(Transition(angle, 0, kind, borders[0], borders[1], worst[1].growth_per_turn, worst[0]))
        i += 1
    return found
