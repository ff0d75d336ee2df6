"""Integration of the models' own states over one communication step."""

from __future__ import annotations

import math
from collections.abc import Callable

Derivative = Callable[[float, list[float]], list[float]]  # s since the start of the step, states -> rates

# Dormand and Prince 5(4): Hairer, Norsett and Wanner, Solving Ordinary Differential Equations I, table II.5.2.
NODES = (0.0, 1 / 5, 3 / 10, 4 / 5, 8 / 9, 1.0)
ROWS = ((), (1 / 5,), (3 / 40, 9 / 40), (44 / 45, -56 / 15, 32 / 9),
        (19372 / 6561, -25360 / 2187, 64448 / 6561, -212 / 729),
        (9017 / 3168, -355 / 33, 46732 / 5247, 49 / 176, -5103 / 18656))
RESULT = (35 / 384, 0.0, 500 / 1113, 125 / 192, -2187 / 6784, 11 / 84)
ERROR = (71 / 57600, 0.0, -71 / 16695, 71 / 1920, -17253 / 339200, 22 / 525, -1 / 40)

SMALLEST = 1e-9  # of a communication step: below it the step is taken as it is
MOST = 100_000  # sub-steps per communication step: a run that needs more would seem to hang
REACH = 16.0  # a decay whose time scale is 0.2 tau lets the method with error control take steps of 3.3 tau


def too_many(step: float, span: float) -> ArithmeticError:
    """Return the error for sub-steps of `step` (s) in a communication step of `span` (s)."""
    return ArithmeticError(f"the models' own states need more than {MOST} sub-steps of {step:.3g} s in a communication "
                           f"step of {span:.3g} s: look at lag, engine_inertia, slip_speed, pedal_lag and the gains of "
                           f"the models, or take a shorter communication_step")


def controlled(derivative: Derivative, span: float, x: list[float], scales: list[float], tolerance: float,
               h: float) -> tuple[list[float], float]:
    """Integrate with error control.

    Parameters
    ----------
    derivative : callable
        Rates of the states.
    span : float
        Length of the communication step, s.
    x : list of float
        States at its start.
    scales : list of float
        Size of each state, enlarged where a state grows beyond it.
    tolerance : float
        Error of one step over the scales.
    h : float
        Step to begin with, s.

    Returns
    -------
    list of float, float
        States at the end, and the step to begin the next communication step with.

    Raises
    ------
    ArithmeticError
        If more than `MOST` steps are needed.
    """
    s = d = 0.0
    first = derivative(0.0, x)
    for _ in range(MOST):
        left = span - s
        last = h >= left * (1.0 - 1e-12)
        d = left if last else (0.5 * left if 2.0 * h > left else h)
        rates = [first]
        for node, row in zip(NODES[1:], ROWS[1:]):
            at = [u + d * math.fsum(a * k[i] for a, k in zip(row, rates)) for i, u in enumerate(x)]
            rates.append(derivative(s + node * d, at))
        end = [u + d * math.fsum(b * k[i] for b, k in zip(RESULT, rates)) for i, u in enumerate(x)]
        rates.append(derivative(s + d, end))
        error = 0.0
        for i, u in enumerate(end):
            scales[i] = max(scales[i], abs(u))
            error = max(error, abs(d * math.fsum(e * k[i] for e, k in zip(ERROR, rates))) / scales[i])
        error /= tolerance
        factor = min(5.0, max(0.2, 0.9 * max(error, 1e-10) ** -0.2))
        if error > 1.0 and d > SMALLEST * span:
            h = d * factor
            continue
        # A step that was cut to fit says nothing against a longer one.
        if not (last and factor >= 1.0 and d * factor < h):
            h = d * factor
        x, first = end, rates[-1]
        if last:
            return x, h
        s += d
    raise too_many(d, span)


def equal_steps(derivative: Derivative, span: float, x: list[float], longest: float) -> list[float]:
    """Integrate with the classic Runge-Kutta method of order 4 in equal steps no longer than `longest` (s)."""
    if span > MOST * longest:
        raise too_many(longest, span)
    count = max(1, math.ceil(span / longest * (1.0 - 1e-12)))
    d = span / count
    for i in range(count):
        s, end = i * span / count, (i + 1) * span / count
        middle = 0.5 * (s + end)
        k1 = derivative(s, x)
        k2 = derivative(middle, [u + 0.5 * d * v for u, v in zip(x, k1)])
        k3 = derivative(middle, [u + 0.5 * d * v for u, v in zip(x, k2)])
        k4 = derivative(end, [u + d * v for u, v in zip(x, k3)])
        x = [u + d / 6.0 * (p + 2.0 * (q + r) + w) for u, p, q, r, w in zip(x, k1, k2, k3, k4)]
    return x
