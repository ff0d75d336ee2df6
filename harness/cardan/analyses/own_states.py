"""Own states of engine and load: their derivatives by differences, and where they come to rest."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

STEP = 1e-3  # of a quantity's size, for differences


def difference(function: Callable[[float], list[float]], at: float) -> Array:
    """Return the derivative of a vector function of one number by central differences of fourth order."""
    h = STEP * max(1.0, abs(at))
    values = [np.asarray(function(at + s * h), dtype=float) for s in (1.0, -1.0, 2.0, -2.0)]
    slope: Array = (8.0 * (values[0] - values[1]) - (values[2] - values[3])) / (12.0 * h)
    return slope


def settle(rates: Callable[[list[float]], list[float]], start: list[float], scale: float) -> list[float]:
    """Return the rest of own states: Newton's method, from the start or from where they have moved to meanwhile.

    Parameters
    ----------
    rates : callable
        States -> their time derivatives.
    start : list of float
    scale : float
        Longest step with which they may be integrated, s.

    Returns
    -------
    list of float
        Where Newton's method does not arrive, the states after 4000 steps.
    """
    x = np.array(start, dtype=float)
    step = scale if math.isfinite(scale) else 0.1
    for count in (0, 500, 1500, 2000):
        x = _advanced(rates, x, step, count)
        found = _rest(rates, x)
        if found is not None:
            return [float(v) for v in found]
    return [float(v) for v in x]


def _advanced(rates: Callable[[list[float]], list[float]], x: Array, h: float, count: int) -> Array:
    """Integrate own states by Runge's method."""
    for _ in range(count):
        k1 = np.asarray(rates(list(x)))
        k2 = np.asarray(rates(list(x + 0.5 * h * k1)))
        k3 = np.asarray(rates(list(x + 0.5 * h * k2)))
        k4 = np.asarray(rates(list(x + h * k3)))
        x = x + h / 6.0 * (k1 + 2.0 * (k2 + k3) + k4)
    return x


def _rest(rates: Callable[[list[float]], list[float]], x: Array) -> Array | None:
    """Return where all rates vanish, by Newton's method with a line search; None where it does not arrive."""
    f = np.asarray(rates(list(x)), dtype=float)
    for _ in range(40):
        jacobian = np.empty((len(x), len(x)))
        for j in range(len(x)):
            def one(value: float, j: int = j, x: Array = x) -> list[float]:
                return rates([*x[:j], value, *x[j + 1:]])

            jacobian[:, j] = difference(one, float(x[j]))
        if not np.all(np.isfinite(jacobian)):
            return None
        move = -np.linalg.lstsq(jacobian, f, rcond=1e-14)[0]
        for _ in range(8):
            there = x + move
            g = np.asarray(rates(list(there)), dtype=float)
            if np.linalg.norm(g) < np.linalg.norm(f) or np.linalg.norm(f) == 0.0:
                break
            move = 0.5 * move
        else:
            return x if np.all(np.abs(move) <= 1e-9 * (1.0 + np.abs(x))) else None
        x, f = there, g
        if np.all(np.abs(move) <= 1e-13 * (1.0 + np.abs(x))):
            return x
    return None
