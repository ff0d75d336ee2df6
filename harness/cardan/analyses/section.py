"""The return map of a periodic motion at one shaft angle, and what it says about perturbations of the twist."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]


@dataclass(frozen=True)
class Section:
    """The return map at one speed.

    Attributes
    ----------
    speed : float
        Mean input speed, rad/s.
    period : float
        s.
    matrix : ndarray
        Derivative of the return map (at the shaft angle 0) over the states but the angle.
    multipliers : ndarray of complex
        Its eigenvalues.
    rotation : float
        Angle (rad) through which perturbations of the twist turn in a period: their rotation number.
    swing : float
        Size of the motion's own twisting: twist (rad) and twist rate (by the speed) at the start of the period.
    others : ndarray of complex
        The multipliers that are not the twist's: of the mean speed, of engine and load.
    conserved : ndarray or None
        Gradient of the energy where it is conserved: a left eigenvector with multiplier 1.
    """

    speed: float
    period: float
    matrix: Array
    multipliers: Complex
    rotation: float
    swing: float
    others: Complex
    conserved: Array | None = field(default=None, repr=False)

    def distance(self, sign: float) -> float:
        """Return (m1 - sign) (m2 - sign) of the twist's two multipliers: negative inside a region, positive outside.

        It is taken from the small entries of M - sign, the other multipliers divided out, and not from the trace, so
        that narrow regions keep their accuracy.
        """
        matrix, others = self.matrix, self.others
        if self.conserved is not None:
            # M on the level of the energy, whose multiplier is 1
            basis = np.linalg.svd(self.conserved[None, :])[2][1:].T
            matrix, others = basis.T @ matrix @ basis, others[:0]
        small = matrix - sign * np.eye(len(matrix))
        if len(small) == 2:
            return float(small[0, 0] * small[1, 1] - small[0, 1] * small[1, 0])
        return float(np.linalg.det(small) / np.prod(others - sign).real)

    @property
    def growth(self) -> float:
        """Logarithm of the largest multiplier."""
        size = float(np.abs(self.multipliers).max(initial=0.0))
        return math.log(size) if size > 0.0 else -math.inf

    @property
    def growth_per_turn(self) -> float:
        """Growth over one turn of the input shaft: a perturbation goes as exp(growth * turns)."""
        return self.growth * 2.0 * math.pi / (self.speed * self.period)


def twist_pair(multipliers: Complex, vectors: Array, slip: Array) -> list[int]:
    """Return the places of the two multipliers that belong to the twist.

    Parameters
    ----------
    multipliers, vectors : ndarray
        Of the return map.
    slip : ndarray
        Row that gives the twist rate of a perturbation.
    """
    share = np.abs(slip @ vectors) / np.linalg.norm(vectors, axis=0)
    first = int(np.argmax(share))
    if multipliers[first].imag != 0.0:
        second = int(np.argmin(np.abs(multipliers - multipliers[first].conjugate())))
        return [first, second]
    share[first] = -1.0
    share[multipliers.imag != 0.0] = -1.0
    return [first, int(np.argmax(share))]


def rotation_number(multipliers: Complex, vectors: Array, slip: Array, turned: float) -> float:
    """Return the rotation number (rad per period) of the twist's perturbations.

    Parameters
    ----------
    multipliers, vectors : ndarray
        The twist's two, as in `twist_pair`; the first state is the twist.
    slip : ndarray
        Row that gives the twist rate of a perturbation.
    turned : float
        Angle through which one solution has turned: within half a turn of the rotation number.
    """
    place = int(np.argmax(multipliers.imag))
    value = multipliers[place]
    if value.imag <= 0.0:
        # real: perturbations keep their direction; a whole number of half turns, odd where the sign changes
        odd = 1.0 if value.real < 0.0 else 0.0
        return math.pi * (2.0 * round((turned / math.pi - odd) / 2.0) + odd)
    vector = vectors[:, place]
    angle = math.atan2(value.imag, value.real)
    if (np.conj(vector[0]) * (slip @ vector)).imag < 0.0:
        angle = 2.0 * math.pi - angle
    return angle + 2.0 * math.pi * round((turned - angle) / (2.0 * math.pi))
