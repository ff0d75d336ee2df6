"""Searches over the speed for one region of instability: beside it, inside it, its borders, its largest growth."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from cardan.analyses.periodic import NoSteadyState
from cardan.analyses.section import Section

Evaluate = Callable[[float], Section]
Number = Callable[[float], float]
Known = list[tuple[float, Section]]

FINEST = 1e-13  # of the speed
WIDER = 12  # steps of 6 % beyond the range in which a border is looked for


def outside(half_turns: Number, known: Known, n: int, side: int) -> float | None:
    """Return a speed left (-1) or right (+1) of region n and within half a turn of rotation of it."""
    def beyond(number: float) -> bool:
        return number > n + 1e-9 if side < 0 else number < n - 1e-9

    def near(number: float) -> bool:
        return beyond(number) and abs(number - n) < 0.999

    numbers = [(s, x.rotation / math.pi) for s, x in known]
    candidates = [s for s, number in numbers if near(number)]
    if candidates:
        return max(candidates) if side < 0 else min(candidates)
    far = [s for s, number in numbers if beyond(number)]
    rest = [s for s, number in numbers if not beyond(number)]
    if far and rest:
        a, b = (max(far), min(rest)) if side < 0 else (min(far), max(rest))
        for _ in range(60):
            middle = 0.5 * (a + b)
            number = half_turns(middle)
            if near(number):
                return middle
            if beyond(number):
                a = middle
            else:
                b = middle
        return None
    # the whole range is on or past the region: look further out
    speed = known[0][0] if side < 0 else known[-1][0]
    for _ in range(WIDER):
        speed *= 0.94 if side < 0 else 1.0 / 0.94
        try:
            number = half_turns(speed)
        except NoSteadyState:
            return None
        if near(number):
            return speed
    return None


def lowest(distance: Number, half_turns: Number, low: float, high: float, n: int) -> float | None:
    """Return a speed inside region n, or the one where the determinant is least."""
    from scipy.optimize import minimize_scalar

    a, b = low, high
    for _ in range(50):
        middle = 0.5 * (a + b)
        if distance(middle) < 0.0:
            return middle
        number = half_turns(middle)
        if abs(number - n) < 1e-9 or b - a < 1e-4 * b:
            break
        if number > n:
            a = middle
        else:
            b = middle
    best: list[float] = []

    def watched(speed: float) -> float:
        value = distance(speed)
        if value < 0.0:
            best.append(speed)
            raise _Found
        return value

    try:
        found = minimize_scalar(watched, bounds=(a, b), method="bounded", options={"xatol": FINEST * b, "maxiter": 80})
    except _Found:
        return best[-1]
    return float(found.x)


class _Found(Exception):
    """A point inside a region was met; nothing more is to be minimized."""


def border(distance: Number, one: float | None, other: float | None) -> float:
    from scipy.optimize import brentq

    if one is None or other is None or distance(one) * distance(other) > 0.0:
        return math.nan
    return float(brentq(distance, one, other, xtol=FINEST * abs(other), rtol=4.0 * np.finfo(float).eps, maxiter=200))


def largest_growth(at: Evaluate, low: float, high: float, centre: float) -> tuple[float, float]:
    """Return the largest growth per turn between two speeds, and where."""
    from scipy.optimize import minimize_scalar

    if high <= low:
        return at(centre).growth_per_turn, centre
    found = minimize_scalar(lambda s: -at(s).growth_per_turn, bounds=(low, high), method="bounded",
                            options={"xatol": 1e-6 * (high - low), "maxiter": 60})
    candidates = [(at(s).growth_per_turn, s) for s in (float(found.x), centre)]
    return max(candidates)


def crossing(half_turns: Number, low: float, high: float, n: int) -> float:
    """Return the speed where the rotation number passes n half turns.

    It is interpolated from speeds some per cent away, as at the crossing itself an undamped motion is infinite:
    rotation number by period, the frequency of the perturbations, hardly changes with the speed.
    """
    a, b = low, high
    while b - a > 2e-2 * b:
        middle = 0.5 * (a + b)
        try:
            number = half_turns(middle)
        except NoSteadyState:
            break
        a, b = (middle, b) if number > n else (a, middle)
    centre = 0.5 * (a + b)
    for _ in range(3):
        steps = np.array([-0.03, -0.02, -0.01, 0.01, 0.02, 0.03])
        try:
            frequencies = np.array([half_turns(centre * (1.0 + step)) * (1.0 + step) for step in steps])
        except NoSteadyState:
            return math.nan
        centre *= float(np.polynomial.polynomial.polyfit(steps, frequencies, 2)[0]) / n
    return centre
