"""A surface over a rectangular grid: bilinear, or bicubic with monotone slopes and continuous gradient."""

from __future__ import annotations

import math
from bisect import bisect_right
from collections.abc import Sequence

from cardan.models.curve import pchip_slopes

# Hermite basis: rows value(0), slope(0), value(1), slope(1); columns powers of s
_HERMITE = ((1.0, 0.0, -3.0, 2.0), (0.0, 1.0, -2.0, 1.0), (0.0, 0.0, 3.0, -2.0), (0.0, 0.0, -1.0, 1.0))


class Surface:
    """Interpolant z(x, y) of values on a grid, continued beyond its edges with the edge's value.

    Parameters
    ----------
    x : sequence of float, shape (n,), n >= 2
        Strictly increasing.
    y : sequence of float, shape (m,), m >= 2
        Strictly increasing.
    z : sequence of sequences, shape (m, n)
        One row per y.
    smooth : bool
        True: bicubic Hermite patches with Fritsch-Butland slopes along both axes; False: bilinear.
    """

    def __init__(self, x: Sequence[float], y: Sequence[float], z: Sequence[Sequence[float]], smooth: bool) -> None:
        self.x, self.y = tuple(x), tuple(y)
        n, m = len(x), len(y)
        if n < 2 or m < 2 or len(z) != m or any(len(row) != n for row in z):
            raise ValueError(f"a surface over {n} by {m} points needs {m} rows of {n} values, at least 2 by 2")
        for name, points in (("x", x), ("y", y)):
            if any(b <= a for a, b in zip(points, points[1:])):
                raise ValueError(f"abscissae {name} of a surface must increase")
        self._patches: list[list[tuple[float, ...]]] = []
        if smooth:
            zx = [pchip_slopes(x, row) for row in z]
            columns = [pchip_slopes(y, [row[i] for row in z]) for i in range(n)]
            twist = [pchip_slopes(y, [row[i] for row in zx]) for i in range(n)]
        for j in range(m - 1):
            row: list[tuple[float, ...]] = []
            k = y[j + 1] - y[j]
            for i in range(n - 1):
                h = x[i + 1] - x[i]
                if smooth:
                    corner = [[(z[b][a], h * zx[b][a], k * columns[a][b], h * k * twist[a][b]) for b in (j, j + 1)]
                              for a in (i, i + 1)]
                    row.append(_bicubic(corner))
                else:
                    a, b, c, d = z[j][i], z[j][i + 1], z[j + 1][i], z[j + 1][i + 1]
                    row.append((a, b - a, 0.0, 0.0, c - a, d - c - b + a, *(0.0,) * 10))
            self._patches.append(row)
        self._last: tuple[float, ...] = (math.nan,) * 12

    def __call__(self, x: float, y: float) -> tuple[float, float, float]:
        """Return z and its partial derivatives by x and y (zero across an edge that was passed)."""
        # The cuts of the surface at the last y are kept: most calls come with the same throttle and a near speed.
        at, low, high, h, a0, a1, a2, a3, b0, b1, b2, b3 = self._last
        inside = 1.0
        if y != at or not low <= x < high:
            xs = self.x
            if x <= xs[0]:
                inside, x = float(x == xs[0]), xs[0]
            elif x >= xs[-1]:
                inside, x = float(x == xs[-1]), xs[-1]
            _, low, _, h, a0, a1, a2, a3, b0, b1, b2, b3 = self._last = self._cut(x, y)
        s = (x - low) / h
        return (a0 + s * (a1 + s * (a2 + s * a3)), inside * (a1 + s * (2.0 * a2 + 3.0 * s * a3)) / h,
                b0 + s * (b1 + s * (b2 + s * b3)))

    def _cut(self, x: float, y: float) -> tuple[float, ...]:
        """Return y, the range of x and its length, and the cubics of z and of its slope by y over that range."""
        xs, ys = self.x, self.y
        i = min(bisect_right(xs, x), len(xs) - 1) - 1
        inside, v = 1.0, y
        if y <= ys[0]:
            inside, v = float(y == ys[0]), ys[0]
        elif y >= ys[-1]:
            inside, v = float(y == ys[-1]), ys[-1]
        j = min(bisect_right(ys, v), len(ys) - 1) - 1
        k = ys[j + 1] - ys[j]
        u = (v - ys[j]) / k
        c0, c1, c2, c3, d0, d1, d2, d3, e0, e1, e2, e3, f0, f1, f2, f3 = self._patches[j][i]
        inside /= k
        w, q = 2.0 * u, 3.0 * u * u
        return (y, xs[i], xs[i + 1], xs[i + 1] - xs[i],
                c0 + u * (d0 + u * (e0 + u * f0)), c1 + u * (d1 + u * (e1 + u * f1)),
                c2 + u * (d2 + u * (e2 + u * f2)), c3 + u * (d3 + u * (e3 + u * f3)),
                inside * (d0 + w * e0 + q * f0), inside * (d1 + w * e1 + q * f1),
                inside * (d2 + w * e2 + q * f2), inside * (d3 + w * e3 + q * f3))


def _bicubic(corner: list[list[tuple[float, float, float, float]]]) -> tuple[float, ...]:
    """Return the 16 coefficients c[4 q + p] of s^p u^q from value, z_s, z_u, z_su at corners [s][u]."""
    coefficients = [0.0] * 16
    for a in (0, 1):
        for b in (0, 1):
            value, by_s, by_u, both = corner[a][b]
            for q in range(4):
                for p in range(4):
                    coefficients[4 * q + p] += (
                        value * _HERMITE[2 * a][p] * _HERMITE[2 * b][q]
                        + by_s * _HERMITE[2 * a + 1][p] * _HERMITE[2 * b][q]
                        + by_u * _HERMITE[2 * a][p] * _HERMITE[2 * b + 1][q]
                        + both * _HERMITE[2 * a + 1][p] * _HERMITE[2 * b + 1][q])
    return tuple(coefficients)
