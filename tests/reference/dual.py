"""Dual numbers: a value and its derivative, carried through + - * / and square root.

The model differentiates nothing by hand: it writes velocities and inertias, and reads their derivatives off
the dual part. Signs and factors in the project's hand-written derivatives are thereby checked by other means.
"""

from __future__ import annotations

from typing import Any

from tests.reference.arithmetic import Arithmetic, Number


class Dual:
    """The number ``value + slope * epsilon`` with ``epsilon**2 = 0``.

    Parameters
    ----------
    value, slope : Number
        The value and its derivative by whatever the caller varies (time, or one angle).
    """

    __slots__ = ("slope", "value")

    def __init__(self, value: Number, slope: Number) -> None:
        self.value = value
        self.slope = slope

    def __add__(self, other: Dual) -> Dual:
        return Dual(self.value + other.value, self.slope + other.slope)

    def __sub__(self, other: Dual) -> Dual:
        return Dual(self.value - other.value, self.slope - other.slope)

    def __neg__(self) -> Dual:
        return Dual(-self.value, -self.slope)

    def __mul__(self, other: Dual | Any) -> Dual:
        if isinstance(other, Dual):
            return Dual(self.value * other.value, self.value * other.slope + self.slope * other.value)
        return Dual(self.value * other, self.slope * other)

    __rmul__ = __mul__

    def __truediv__(self, other: Dual) -> Dual:
        quotient = self.value / other.value
        return Dual(quotient, (self.slope - quotient * other.slope) / other.value)

    def square(self) -> Dual:
        """Return the square, with one multiplication less than ``x * x``."""
        return Dual(self.value * self.value, 2 * self.value * self.slope)


def cos_sin(angle: Dual, arithmetic: Arithmetic) -> tuple[Dual, Dual]:
    """Return the cosine and the sine of a dual angle in rad."""
    c, s = arithmetic.cos_sin(angle.value)
    return Dual(c, -s * angle.slope), Dual(s, c * angle.slope)
