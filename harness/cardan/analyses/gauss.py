"""Monodromy matrix of a periodic linear system that is known at equidistant times, by a Gauss method of order 10."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from cardan.analyses.trigonometric import interpolate

Array = NDArray[np.float64]


def gauss_monodromy(a: Array, period: float, watched: int = -1, tolerance: float = 1e-13) -> tuple[Array, float]:
    """Integrate X' = A(t) X over a period by the Gauss method of order 10, steps doubled until they agree.

    Hairer, Norsett, Wanner, Solving Ordinary Differential Equations I, section II.7.

    Parameters
    ----------
    a : ndarray, shape (N, n, n), N odd
        Periodic matrix at equidistant times.
    period : float
        s.
    watched : int
        State whose perturbation is followed for the angle that it turns through; -1 for none.
    tolerance : float
        On the change of the result between steps and half steps.

    Returns
    -------
    matrix : ndarray, shape (n, n)
    turned : float
        As in `Floquet`.
    """
    steps = max(8, int(np.ceil(np.abs(np.linalg.eigvals(a)).max() * period / 2.0)))
    parts = _gauss(a, period, steps)
    last = _product(parts)
    for _ in range(6):
        steps *= 2
        parts = _gauss(a, period, steps)
        result = _product(parts)
        if np.abs(result - last).max() <= tolerance * max(1.0, float(np.abs(result).max())):
            break
        last = result
    return result, _turned(a, parts, watched) if watched >= 0 else 0.0


def _gauss(a: Array, period: float, steps: int) -> Array:
    """Matrices of all steps, shape (steps, n, n)."""
    n = a.shape[1]
    roots, _ = np.polynomial.legendre.leggauss(5)
    nodes = 0.5 * (1.0 + roots)
    # Integrate the Lagrange polynomials of the nodes for the weights of the method.
    powers = np.vander(nodes, 5, increasing=True)
    k = np.arange(1, 6)
    weights = np.linalg.solve(powers.T, (nodes[:, None] ** k / k).T).T
    last = np.linalg.solve(powers.T, 1.0 / k)
    places = (np.arange(steps)[:, None] + nodes) / steps
    there = interpolate(a, places.ravel()).reshape(steps, 5, n, n)
    h = period / steps
    # k_i - h A_i sum_j w_ij k_j = A_i x: stage derivatives for unit x, then the matrix of each step
    coupled = np.eye(5 * n) - h * np.einsum("ij,siab->siajb", weights, there).reshape(steps, 5 * n, 5 * n)
    slopes = np.linalg.solve(coupled, there.reshape(steps, 5 * n, n)).reshape(steps, 5, n, n)
    return np.asarray(np.eye(n) + h * np.einsum("i,siab->sab", last, slopes))


def _product(parts: Array) -> Array:
    result = np.eye(parts.shape[1])
    for part in parts:
        result = part @ result
    return result


def _turned(a: Array, parts: Array, watched: int) -> float:
    steps, n = parts.shape[:2]
    rows = interpolate(a[:, watched], np.arange(steps + 1) / steps)
    fast = float(np.abs(np.linalg.eigvals(a)).max())
    x = np.eye(n)[watched]
    total, before = 0.0, complex(fast * x[watched], rows[0] @ x)
    for i, part in enumerate(parts):
        x = part @ x
        after = complex(fast * x[watched], rows[i + 1] @ x)
        total -= math.atan2((before.conjugate() * after).imag, (before.conjugate() * after).real)
        before = after
    return total
