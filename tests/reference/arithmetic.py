"""Two arithmetics for one model: Python's decimal (fast) and mpmath (any function), at any precision.

The driveline model in :mod:`tests.reference.model` is written once, over numbers of either kind. Trajectories
are integrated in ``decimal`` (libmpdec runs ten times faster than mpmath here); Jacobians and Hill determinants
take mpmath. Both give the same values to the digits asked for, which a test checks.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from decimal import Decimal, getcontext
from typing import Any, NamedTuple

import mpmath

Number = Any
"""A number of the arithmetic in use: ``mpmath.mpf`` or ``decimal.Decimal``."""

_GRID = 256
"""Tabulated angles stand 1/256 rad apart, so series start from an argument below 1/512."""


class Arithmetic(NamedTuple):
    """The constructor, the constant and the elementary functions that the model needs."""

    name: str
    number: Callable[[float], Number]
    pi: Number
    cos_sin: Callable[[Number], tuple[Number, Number]]
    sqrt: Callable[[Number], Number]
    atan: Callable[[Number], Number]


def multiple_precision() -> Arithmetic:
    """Return mpmath at the working precision in force; a float becomes exactly its binary value."""
    context = mpmath.mp
    return Arithmetic("mpmath", context.mpf, +context.pi, context.cos_sin, context.sqrt, context.atan)


def decimal_arithmetic(digits: int) -> Arithmetic:
    """Return ``decimal`` with `digits` digits, and set this thread's decimal context to them.

    Constructing a number from a float is exact. Angles enter the functions below 1e6 rad.
    """
    getcontext().prec = digits
    functions = _DecimalFunctions(digits)
    return Arithmetic(f"decimal, {digits} digits", Decimal, functions.pi, functions.cos_sin, Decimal.sqrt,
                      functions.atan)


class _DecimalFunctions:
    """Cosine, sine and arctangent by a table of grid points, taken from mpmath, and a short Taylor series."""

    def __init__(self, digits: int) -> None:
        self.digits = digits
        self.terms = 3
        while math.lgamma(self.terms + 1) / math.log(10) + self.terms * math.log10(2 * _GRID) < digits + 3:
            self.terms += 1
        self.atan_terms = int((digits + 3) / math.log10(2 * _GRID)) + 1
        self.factorials = [Decimal(1) / Decimal(math.factorial(n)) for n in range(self.terms + 2)]
        self.table: dict[int, tuple[Decimal, Decimal]] = {}
        with mpmath.workdps(digits + 10):
            self.pi = Decimal(mpmath.nstr(+mpmath.pi, digits + 8))
        self.turn = 2 * self.pi

    def _grid(self, index: int) -> tuple[Decimal, Decimal]:
        entry = self.table.get(index)
        if entry is None:
            with mpmath.workdps(self.digits + 10):
                entry = self.table[index] = tuple(  # type: ignore[assignment]
                    Decimal(mpmath.nstr(x, self.digits + 8)) for x in mpmath.cos_sin(mpmath.mpf(index) / _GRID))
        assert entry is not None
        return entry

    def cos_sin(self, angle: Decimal) -> tuple[Decimal, Decimal]:
        """Return cosine and sine of an angle in rad."""
        angle = angle - round(float(angle) / math.tau) * self.turn
        index = round(float(angle) * _GRID)
        grid_cos, grid_sin = self._grid(index)
        x = angle - Decimal(index) / _GRID
        square = x * x
        top = self.terms - self.terms % 2                       # even
        cos, sin = self.factorials[top], self.factorials[top + 1]
        for n in range(top - 2, -1, -2):
            cos = self.factorials[n] - square * cos
            sin = self.factorials[n + 1] - square * sin
        sin *= x
        return grid_cos * cos - grid_sin * sin, grid_sin * cos + grid_cos * sin

    def atan(self, tangent: Decimal) -> Decimal:
        """Return the arctangent in rad."""
        index = round(math.atan(float(tangent)) * _GRID)
        grid_cos, grid_sin = self._grid(index)
        x = (tangent * grid_cos - grid_sin) / (grid_cos + tangent * grid_sin)
        square = x * x
        total = Decimal(0)
        for n in range(self.atan_terms - 1 + self.atan_terms % 2, 0, -2):   # odd powers, largest first
            total = Decimal(1) / n - square * total
        return Decimal(index) / _GRID + x * total
