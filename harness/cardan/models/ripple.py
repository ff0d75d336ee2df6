"""Torque ripple by orders of the crank angle."""

from __future__ import annotations

from collections.abc import Mapping
from math import cos, sin

Pair = tuple[float, float]  # cosine and sine amplitude of one order


class Ripple:
    """Sum over orders k of (A_k cos k p + B_k sin k p), p the crank angle.

    Each amplitude has a fixed part (N.m), a part per mean torque (1) and a part per speed squared (N.m.s2/rad2,
    inertia torque).

    Parameters
    ----------
    fixed, relative, inertial : mapping of float to (float, float)
        order -> (cosine amplitude, sine amplitude).
    """

    def __init__(self, fixed: Mapping[float, Pair], relative: Mapping[float, Pair],
                 inertial: Mapping[float, Pair]) -> None:
        none = (0.0, 0.0)
        self.terms = tuple((k, *fixed.get(k, none), *relative.get(k, none), *inertial.get(k, none))
                           for k in sorted({*fixed, *relative, *inertial}))
        # Amplitudes that never change need half the arithmetic, and this runs at every communication point.
        self._fixed = None if relative or inertial else tuple((k, *fixed[k]) for k in sorted(fixed))

    def __call__(self, angle: float, speed: float, mean: float) -> tuple[float, float, float, float]:
        """Return the ripple torque (N.m) and its derivatives by angle, speed and mean torque."""
        value = by_angle = by_speed = by_mean = 0.0
        if self._fixed is not None:
            for k, a, b in self._fixed:
                c, s = cos(k * angle), sin(k * angle)
                value += a * c + b * s
                by_angle += k * (b * c - a * s)
            return value, by_angle, 0.0, 0.0
        square = speed * speed
        for k, a0, b0, a1, b1, a2, b2 in self.terms:
            c, s = cos(k * angle), sin(k * angle)
            a, b = a0 + a1 * mean + a2 * square, b0 + b1 * mean + b2 * square
            value += a * c + b * s
            by_angle += k * (b * c - a * s)
            by_speed += a2 * c + b2 * s
            by_mean += a1 * c + b1 * s
        return value, by_angle, 2.0 * speed * by_speed, by_mean
