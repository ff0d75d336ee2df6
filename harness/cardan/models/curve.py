"""A curve through points: piecewise linear, or cubic with monotone slopes (PCHIP)."""

from __future__ import annotations

import math
from bisect import bisect_right
from collections.abc import Sequence


def pchip_slopes(x: Sequence[float], y: Sequence[float]) -> list[float]:
    """Return slopes that make the cubic Hermite interpolant monotone where the data are.

    Parameters
    ----------
    x, y : sequence of float, shape (n,), n >= 2
        Increasing abscissae and values.

    Notes
    -----
    F. N. Fritsch and J. Butland, SIAM J. Sci. Stat. Comput. 5 (1984) 300: weighted harmonic mean of the
    neighbouring secants, zero at a local extremum; one-sided three-point slopes at the ends.
    """
    n = len(x)
    step = [x[i + 1] - x[i] for i in range(n - 1)]
    secant = [(y[i + 1] - y[i]) / step[i] for i in range(n - 1)]
    if n == 2:
        return [secant[0], secant[0]]
    slopes = [0.0] * n
    for i in range(1, n - 1):
        left, right = secant[i - 1], secant[i]
        if left * right > 0.0:
            a, b = 2.0 * step[i] + step[i - 1], step[i] + 2.0 * step[i - 1]
            slopes[i] = (a + b) / (a / left + b / right)
    slopes[0] = _end_slope(step[0], step[1], secant[0], secant[1])
    slopes[-1] = _end_slope(step[-1], step[-2], secant[-1], secant[-2])
    return slopes


def _end_slope(near: float, far: float, first: float, second: float) -> float:
    slope = ((2.0 * near + far) * first - near * second) / (near + far)
    if slope * first <= 0.0:
        return 0.0
    if first * second <= 0.0 and abs(slope) > 3.0 * abs(first):
        return 3.0 * first
    return slope


class Curve:
    """Interpolant of points (x_i, y_i), constant outside them.

    Parameters
    ----------
    x, y : sequence of float, shape (n,), n >= 1
        Strictly increasing abscissae and values.
    smooth : bool
        True: monotone cubic with continuous slope; False: straight lines.

    Attributes
    ----------
    corners : tuple of float
        Abscissae where the slope jumps: all points of straight lines, the two ends of a cubic.
    """

    def __init__(self, x: Sequence[float], y: Sequence[float], smooth: bool) -> None:
        if len(x) != len(y) or not x:
            raise ValueError("a curve needs as many values as abscissae, at least one")
        if any(b <= a for a, b in zip(x, x[1:])):
            raise ValueError("abscissae of a curve must increase")
        self.x, self.y = tuple(x), tuple(y)
        self._pieces: list[tuple[float, float, float, float]] = []
        if len(x) == 1:
            self.corners: tuple[float, ...] = ()
            return
        slopes = pchip_slopes(x, y) if smooth else []
        for i in range(len(x) - 1):
            h = x[i + 1] - x[i]
            secant = (y[i + 1] - y[i]) / h
            if smooth:
                a, b = slopes[i], slopes[i + 1]
                self._pieces.append((y[i], a, (3.0 * secant - 2.0 * a - b) / h, (a + b - 2.0 * secant) / (h * h)))
            else:
                self._pieces.append((y[i], secant, 0.0, 0.0))
        self.corners = (self.x[0], self.x[-1]) if smooth else self.x

    def __call__(self, x: float) -> tuple[float, float]:
        """Return value and slope at x; at a corner the slope from the right."""
        points = self.x
        if x < points[0]:
            return self.y[0], 0.0
        if x >= points[-1]:
            return self.y[-1], 0.0
        i = bisect_right(points, x) - 1
        a, b, c, d = self._pieces[i]
        s = x - points[i]
        return a + s * (b + s * (c + s * d)), b + s * (2.0 * c + 3.0 * d * s)

    def next_corner(self, x: float) -> float:
        """Return the first corner after x (inf: none)."""
        i = bisect_right(self.corners, x)
        return self.corners[i] if i < len(self.corners) else math.inf

    def integral(self, x: float) -> float:
        """Return the integral from the first point to x."""
        total = 0.0
        for i, (a, b, c, d) in enumerate(self._pieces):
            if x <= self.x[i]:
                return total
            s = min(x, self.x[i + 1]) - self.x[i]
            total += s * (a + s * (b / 2.0 + s * (c / 3.0 + s * d / 4.0)))
        return total + max(0.0, x - self.x[-1]) * self.y[-1]
