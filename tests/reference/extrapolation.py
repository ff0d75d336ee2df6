"""Gragg-Bulirsch-Stoer extrapolation with step control, in any arithmetic.

The explicit midpoint rule has an error expansion in h^2; Aitken-Neville over the step numbers 2, 4, 6, ..
eliminates one power per column. Hairer, Norsett, Wanner, Solving Ordinary Differential Equations I, II.9.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator

from tests.reference.arithmetic import Number

Derivative = Callable[[Number, list[Number]], list[Number]]


def extrapolated_step(f: Derivative, t: Number, x: list[Number], slope: list[Number], h: Number,
                      columns: int) -> tuple[list[Number], list[Number]]:
    """Return the state after one step of order ``2 columns`` and its difference to the column before."""
    table: list[list[list[Number]]] = []
    for row in range(columns):
        n = 2 * (row + 1)
        part = h / n
        before, here = x, [a + part * b for a, b in zip(x, slope, strict=True)]
        for i in range(1, n):
            rate = f(t + i * part, here)
            before, here = here, [a + 2 * part * b for a, b in zip(before, rate, strict=True)]
        entries = [here]
        for column in range(row):
            weight = (n * n) / type(h)((2 * (row - column)) ** 2) - 1
            entries.append([a + (a - b) / weight for a, b in zip(entries[column], table[row - 1][column], strict=True)])
        table.append(entries)
    best, other = table[-1][-1], table[-1][-2]
    return best, [a - b for a, b in zip(best, other, strict=True)]


def integrate(f: Derivative, times: list[Number], x: list[Number], scale: list[float], tolerance: float,
              columns: int, first: float = 1e-4) -> Iterator[list[Number]]:
    """Yield the state at each of `times`, the first being the start.

    Parameters
    ----------
    f : callable
        ``f(t, x)`` gives the derivative.
    times : list of Number
        Increasing times in s; steps end exactly on them.
    x : list of Number
        State at ``times[0]``.
    scale : list of float
        Size of each component against which `tolerance` is taken; infinity leaves a component out.
    tolerance : float
        Bound of the difference between the last two columns per step, relative to `scale`. The step's own
        error is about two orders of h^2 smaller.
    columns : int
        Rows of the extrapolation table.
    first : float
        First step tried, in s.
    """
    yield x
    h = first
    order = 2 * columns - 1
    for start, end in zip(times, times[1:], strict=False):
        t = start
        while t < end:
            left = end - t
            last = h >= float(left)
            step = left if last else type(left)(h)
            slope = f(t, x)
            while True:
                new, difference = extrapolated_step(f, t, x, slope, step, columns)
                error = max(abs(float(d)) / s for d, s in zip(difference, scale, strict=True)) / tolerance
                factor = min(3.0, max(0.1, 0.9 * (error + 1e-30) ** (-1.0 / order)))
                if error <= 1.0:
                    break
                last = False
                h = float(step) * factor
                step = type(left)(h)
            x, t = new, (end if last else t + step)
            if not last or factor < 1.0:
                h = float(step) * factor
        yield x
