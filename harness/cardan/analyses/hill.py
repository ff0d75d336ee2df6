"""The harmonic (Hill) lift: frequency response of a linear time-periodic system.

With A(t) = sum of A_k e^(j k W t) and x(t) = sum of x_k e^((s + j k W) t) the periodic system becomes

    (s + j k W) x_k = sum over l of A_(k-l) x_l + B_k u,    y_k = sum over l of C_(k-l) x_l + D_k u,

kept for abs(k) <= h: y_0 = G_0(s) u at the frequency of the input, y_k = G_k(s) u at the line k fundamentals above.
Wereley, Analysis and control of linear periodically time varying systems, MIT 1991, chapter 3; docs/PHYSICS.md 7.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]

MOST_HARMONICS = 60
CHUNK = 64  # frequencies solved together
POLE_TOLERANCE = 1e-11  # of the fundamental
MORE_FOR_POLES = 12  # harmonics at most, after that rounding decides


@dataclass(frozen=True)
class Periodic:
    """A linear time-periodic system at N (odd) equidistant times of its period.

    Attributes
    ----------
    a, b, c, d : ndarray, shapes (N, n, n), (N, n, m), (N, p, n), (N, p, m)
    fundamental : float
        2 pi by the period, rad/s.
    """

    a: Array
    b: Array
    c: Array
    d: Array
    fundamental: float


@dataclass(frozen=True)
class Lift:
    """A periodic system lifted to harmonics -h .. h, which is time-invariant.

    Attributes
    ----------
    a, b : ndarray of complex, shapes (K n, K n), (K n, m), K = 2 h + 1
        Blocks in the order k = -h .. h.
    c, d : ndarray of complex, shapes (K p, K n), (K p, m)
    harmonics : int
        h.
    fundamental : float
        rad/s.
    """

    a: Complex
    b: Complex
    c: Complex
    d: Complex
    harmonics: int
    fundamental: float

    def response(self, omega: Array) -> Complex:
        """Return G_k(j omega) for all k, shape (len(omega), K, p, m).

        Parameters
        ----------
        omega : ndarray
            Frequencies of the input, rad/s.
        """
        size, m = self.b.shape
        outputs = len(self.c) // (2 * self.harmonics + 1)
        found = np.empty((len(omega), len(self.c), m), dtype=complex)
        for start in range(0, len(omega), CHUNK):
            part = omega[start:start + CHUNK]
            matrix = np.broadcast_to(-self.a, (len(part), size, size)).copy()
            matrix[:, range(size), range(size)] += 1j * part[:, None]
            states = np.linalg.solve(matrix, np.broadcast_to(self.b, (len(part), size, m)))
            found[start:start + CHUNK] = self.c @ states + self.d
        return found.reshape(len(omega), 2 * self.harmonics + 1, outputs, m)

    def real(self) -> tuple[Array, Array, Array, Array]:
        """Return the lift in real coordinates x_0, x_1c, x_1s, x_2c, ...: x = x_0 + sum of x_kc cos + x_ks sin.

        The outputs come in the same order: mean, then cosine and sine part of each sideband pair, so that
        ``G_k = (Y_kc - j Y_ks) / 2`` and ``G_-k = (Y_kc + j Y_ks) / 2``.
        """
        h = self.harmonics
        n = len(self.a) // (2 * h + 1)
        outputs = len(self.c) // (2 * h + 1)
        to_x, from_x = _turn(h, n)
        to_y, _ = _turn(h, outputs)
        return ((to_x @ self.a @ from_x).real, (to_x @ self.b).real, (to_y @ self.c @ from_x).real,
                (to_y @ self.d).real)

    def poles(self) -> Complex:
        """Return the poles in the middle strip, imaginary parts within half the fundamental: the Floquet exponents.

        Of the copies that the lift has of each exponent, those are taken whose motion is centred on k = 0.
        """
        if not len(self.a):
            return np.zeros(0, dtype=complex)
        values, vectors = np.linalg.eig(self.a)
        h = self.harmonics
        n = len(self.a) // (2 * h + 1)
        weights = (np.abs(vectors.reshape(2 * h + 1, n, -1)) ** 2).sum(axis=1)
        centre = np.abs((np.arange(-h, h + 1)[:, None] * weights).sum(axis=0) / weights.sum(axis=0))
        half = 0.5 * self.fundamental
        near = 2e-6 * half
        # Exponents of negative multipliers stand on both edges of the strip; the upper one counts.
        inside = np.flatnonzero((values.imag <= half + near) & (values.imag > -half + near))
        best = inside[np.argsort(centre[inside], kind="stable")][:n]
        return np.asarray(values[best[np.argsort(-values[best].real, kind="stable")]])


def lift(system: Periodic, harmonics: int) -> Lift:
    """Lift a periodic system to the harmonics -h .. h."""
    h = harmonics
    k = np.arange(-h, h + 1)
    size, n = 2 * h + 1, system.a.shape[1]
    a = _toeplitz(system.a, h)
    turning = 1j * system.fundamental * np.repeat(k, n)
    a[range(size * n), range(size * n)] -= turning
    return Lift(a, _column(system.b, h), _toeplitz(system.c, h), _column(system.d, h), h, system.fundamental)


def lift_to_tolerance(system: Periodic, omega: Array, tolerance: float,
                      exponents: Complex | None = None) -> tuple[Lift, float]:
    """Lift with as many harmonics as G_0 and the poles need.

    Parameters
    ----------
    omega : ndarray
        Frequencies where G_0 is looked at, rad/s.
    tolerance : float
        Largest change of G_0, relative at each frequency, that three more harmonics may make.
    exponents : ndarray of complex, optional
        Floquet exponents that the poles have to meet within ``POLE_TOLERANCE`` of the fundamental.

    Returns
    -------
    lift : Lift
    error : float
        That change.
    """
    harmonics, error, enough = 2, np.inf, MOST_HARMONICS
    made = lift(system, harmonics)
    now = made.response(omega)[:, harmonics]
    while True:
        more = lift(system, harmonics + 3)
        finer = more.response(omega)[:, harmonics + 3]
        size = np.maximum(np.abs(finer), 1e-9 * np.abs(finer).max(axis=0))
        error = float((np.abs(finer - now) / np.where(size > 0.0, size, 1.0)).max(initial=0.0))
        if error <= tolerance:
            if _meets(made, exponents) or harmonics >= enough:
                return made, error
            enough = min(enough, harmonics + MORE_FOR_POLES)
        if harmonics + 3 > MOST_HARMONICS:
            return made, error
        made, now, harmonics = more, finer, harmonics + 3


def _meets(made: Lift, exponents: Complex | None) -> bool:
    if exponents is None or not len(exponents):
        return True
    poles = made.poles()
    apart = poles[None, :] - exponents[:, None]
    apart = apart - 1j * made.fundamental * np.round(apart.imag / made.fundamental)
    return len(poles) > 0 and bool(np.abs(apart).min(axis=1).max() <= POLE_TOLERANCE * made.fundamental)


def _toeplitz(values: Array, h: int) -> Complex:
    """Block Toeplitz matrix of the Fourier coefficients of a periodic matrix."""
    count, rows, columns = values.shape
    coefficient = np.fft.fft(values, axis=0) / count
    k = np.arange(-h, h + 1)
    order = k[:, None] - k[None, :]
    blocks = np.where((np.abs(order) <= count // 2)[:, :, None, None], coefficient[order % count], 0.0)
    return np.asarray(blocks.transpose(0, 2, 1, 3).reshape(len(k) * rows, len(k) * columns))


def _column(values: Array, h: int) -> Complex:
    count, rows, columns = values.shape
    coefficient = np.fft.fft(values, axis=0) / count
    k = np.arange(-h, h + 1)
    blocks = np.where((np.abs(k) <= count // 2)[:, None, None], coefficient[k % count], 0.0)
    return np.asarray(blocks.reshape(len(k) * rows, columns))


def _turn(h: int, n: int) -> tuple[Any, Any]:
    """Matrices from exponential to real coordinates and back, for blocks of size n."""
    size = 2 * h + 1
    to = np.zeros((size, size), dtype=complex)
    back = np.zeros((size, size), dtype=complex)
    to[0, h] = back[h, 0] = 1.0
    for k in range(1, h + 1):
        c, s = 2 * k - 1, 2 * k
        to[c, h + k] = to[c, h - k] = 1.0
        to[s, h + k], to[s, h - k] = 1j, -1j
        back[h + k, c] = back[h - k, c] = 0.5
        back[h + k, s], back[h - k, s] = -0.5j, 0.5j
    eye = np.eye(n)
    return np.kron(to, eye), np.kron(back, eye)
