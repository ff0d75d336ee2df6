"""Smooth stand-ins for steps, corners and signs, each with its derivative."""

from __future__ import annotations

import math


def rise(s: float) -> tuple[float, float]:
    """Return a step from 0 (s <= 0) to 1 (s >= 1) with continuous second derivative, and its slope.

    The quintic ``6 s^5 - 15 s^4 + 10 s^3``.
    """
    if s <= 0.0:
        return 0.0, 0.0
    if s >= 1.0:
        return 1.0, 0.0
    return s * s * s * (s * (6.0 * s - 15.0) + 10.0), 30.0 * s * s * (1.0 - s) * (1.0 - s)


def positive(x: float, width: float) -> tuple[float, float]:
    """Return max(x, 0) rounded over `width`, and its slope: ``(x + sqrt(x^2 + width^2)) / 2``."""
    root = math.sqrt(x * x + width * width)
    return 0.5 * (x + root), 0.5 * (1.0 + x / root)


def clamp(x: float, low: float, high: float, width: float) -> tuple[float, float]:
    """Return x limited to [low, high] with corners rounded over `width`, and its slope.

    Exactly inside (low, high), infinitely smooth and strictly increasing; far inside it differs from x by
    ``width^2 / 4 (1/(x - low) - 1/(high - x))``.
    """
    a, b = x - low, x - high
    c = width * width
    p, q = math.sqrt(a * a + c), math.sqrt(b * b + c)
    return 0.5 * (low + high + p - q), 0.5 * (a / p - b / q)


def sign(x: float, width: float) -> tuple[float, float]:
    """Return ``tanh(x / width)`` and its slope: a friction sign that passes smoothly through standstill."""
    y = math.tanh(x / width)
    return y, (1.0 - y * y) / width


def magnitude(x: float, width: float) -> tuple[float, float]:
    """Return ``sqrt(x^2 + width^2) - width`` (abs x, rounded, zero at zero) and its slope."""
    root = math.sqrt(x * x + width * width)
    return root - width, x / root
