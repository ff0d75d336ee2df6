"""Trigonometric polynomials through values at equidistant points of a period; odd numbers of points throughout."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def differentiation(count: int) -> Array:
    """Return the matrix (count, count; count odd) that differentiates a 2 pi periodic function at equidistant points.

    Fornberg, A Practical Guide to Pseudospectral Methods, Cambridge 1996, section 3.2 (odd number of points).
    """
    steps = np.arange(1, count)
    first = np.zeros(count)
    first[1:] = 0.5 * (-1.0) ** steps / np.sin(math.pi * steps / count)
    i = np.arange(count)
    return np.asarray(first[(i[None, :] - i[:, None]) % count] * -1.0)


def resample(x: Array, count: int) -> Array:
    """Return a trigonometric polynomial at another (odd) number of points."""
    if len(x) == count:
        return x
    spectrum = np.fft.rfft(x, axis=0) * (count / len(x))
    full = np.zeros((count // 2 + 1, x.shape[1]), dtype=complex)
    keep = min(len(full), len(spectrum))
    full[:keep] = spectrum[:keep]
    return np.asarray(np.fft.irfft(full, count, axis=0), dtype=float)


def interpolate(values: Array, places: Array) -> Array:
    """Return a trigonometric polynomial at any places.

    Parameters
    ----------
    values : ndarray, shape (N, ...)
        At the places 0, 1/N, .. of the period.
    places : ndarray, shape (M,)
        In periods.

    Returns
    -------
    ndarray, shape (M, ...)
    """
    count = len(values)
    spectrum = np.fft.fft(values.reshape(count, -1), axis=0) / count
    phase: Any = np.exp(2j * math.pi * np.outer(places, np.fft.fftfreq(count, 1.0 / count)))
    found: Array = (phase @ spectrum).real
    return found.reshape(len(places), *values.shape[1:])
