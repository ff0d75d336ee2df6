"""A surface over a rectangular grid: bilinear, or bicubic with monotone slopes and continuous gradient."""

from __future__ import annotations

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
                    row.append((a, b - a, c - a, d - c - b + a))
            self._patches.append(row)
        self._smooth = smooth

    def __call__(self, x: float, y: float) -> tuple[float, float, float]:
        """Return z and its partial derivatives by x and y (zero across an edge that was passed)."""
        xs, ys = self.x, self.y
        inside_x = inside_y = 1.0
        if x <= xs[0]:
            inside_x, x = float(x == xs[0]), xs[0]
        elif x >= xs[-1]:
            inside_x, x = float(x == xs[-1]), xs[-1]
        if y <= ys[0]:
            inside_y, y = float(y == ys[0]), ys[0]
        elif y >= ys[-1]:
            inside_y, y = float(y == ys[-1]), ys[-1]
        i = min(bisect_right(xs, x), len(xs) - 1) - 1
        j = min(bisect_right(ys, y), len(ys) - 1) - 1
        h, k = xs[i + 1] - xs[i], ys[j + 1] - ys[j]
        s, u = (x - xs[i]) / h, (y - ys[j]) / k
        c = self._patches[j][i]
        if not self._smooth:
            return (c[0] + c[1] * s + c[2] * u + c[3] * s * u, inside_x * (c[1] + c[3] * u) / h,
                    inside_y * (c[2] + c[3] * s) / k)
        p0 = c[0] + s * (c[1] + s * (c[2] + s * c[3]))
        p1 = c[4] + s * (c[5] + s * (c[6] + s * c[7]))
        p2 = c[8] + s * (c[9] + s * (c[10] + s * c[11]))
        p3 = c[12] + s * (c[13] + s * (c[14] + s * c[15]))
        d0 = c[1] + s * (2.0 * c[2] + 3.0 * s * c[3])
        d1 = c[5] + s * (2.0 * c[6] + 3.0 * s * c[7])
        d2 = c[9] + s * (2.0 * c[10] + 3.0 * s * c[11])
        d3 = c[13] + s * (2.0 * c[14] + 3.0 * s * c[15])
        return (p0 + u * (p1 + u * (p2 + u * p3)), inside_x * (d0 + u * (d1 + u * (d2 + u * d3))) / h,
                inside_y * (p1 + u * (2.0 * p2 + 3.0 * u * p3)) / k)


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
