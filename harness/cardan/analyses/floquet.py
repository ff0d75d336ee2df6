"""Floquet multipliers and exponents of a periodic motion.

The monodromy matrix comes from the kernel (`cardan_kernel.analysis.Variation`: the variational equations integrated
by DOP853 with the exact Jacobian). A law of engine or load that is no polynomial in the speed enters it as its
linearization along the motion, R(p) + K(p) w. Engines and loads with states of their own are not in the kernel: their
monodromy matrix is integrated here, by a Gauss method of order 10 on the Jacobians of the harmonic balance.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from cardan.analyses.gauss import gauss_monodromy
from cardan.analyses.periodic import Motion
from cardan.analyses.plant import W1, WY, P

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]

MARGIN = 1e-9  # a multiplier is told from 1 in size by this much


@dataclass(frozen=True)
class Floquet:
    """Stability of a periodic motion.

    Attributes
    ----------
    monodromy : ndarray, shape (n, n)
        Derivative of the states after one period by those at its start.
    multipliers : ndarray of complex
        Its eigenvalues, the largest first. A free-running driveline has one at 1, its phase, which is left out here:
        they are those of the return map at a given shaft angle.
    period : float
        s.
    free_phase : bool
        Whether there is a neutral multiplier of the phase.
    turned : float
        Angle (rad) through which a perturbation of the twist has turned in the plane of twist and twist rate.
    """

    monodromy: Array
    multipliers: Complex
    period: float
    free_phase: bool
    turned: float = 0.0

    @property
    def exponents(self) -> Complex:
        """log(multiplier) / period, 1/s; 0 for the phase at the end; imaginary parts within half the fundamental."""
        found = np.log(self.multipliers) / self.period
        return np.append(found, 0.0 + 0.0j) if self.free_phase else np.asarray(found)

    @property
    def growth_rate(self) -> float:
        """Largest real part of the exponents, the phase left out, 1/s."""
        size = float(np.abs(self.multipliers).max(initial=0.0))
        return math.log(size) / self.period if size > 0.0 else -math.inf

    @property
    def stable(self) -> bool:
        """Whether no perturbation grows."""
        return bool(np.abs(self.multipliers).max(initial=0.0) <= 1.0 + MARGIN)


def floquet(motion: Motion) -> Floquet:
    """Return multipliers and exponents of a periodic motion."""
    plant = motion.plant
    free = not plant.driven
    if not plant.states:
        return Floquet(np.zeros((0, 0)), np.zeros(0, dtype=complex), motion.period, False)
    if _in_kernel(motion):
        matrix, turned = kernel_monodromy(motion)
    else:
        watched = motion.plant.states.index("shaft.twist") if not plant.rigid else -1
        matrix, turned = gauss_monodromy(motion.fields.a, motion.period, watched)
    section = return_map(matrix, motion.fields.rates[0]) if free else matrix
    multipliers = np.linalg.eigvals(section).astype(complex)
    return Floquet(matrix, multipliers[np.argsort(-np.abs(multipliers), kind="stable")], motion.period, free, turned)


def return_map(monodromy: Array, rates: Array) -> Array:
    """Return the derivative of the map from a shaft angle to the same angle one period on.

    Parameters
    ----------
    monodromy : ndarray, shape (n, n)
        Over one period of a motion; the first state is the shaft angle.
    rates : ndarray, shape (n,)
        Time derivatives of the states at its start.
    """
    result: Array = monodromy[1:, 1:] - np.outer(rates[1:] / rates[0], monodromy[0, 1:])
    return result


def _in_kernel(motion: Motion) -> bool:
    from cardan_kernel.analysis import MOST_HARMONICS

    return not motion.plant.own and len(motion.states) // 3 < MOST_HARMONICS


def kernel_monodromy(motion: Motion) -> tuple[Array, float]:
    """Integrate the variational equations in the kernel.

    Returns
    -------
    matrix : ndarray, shape (n, n)
        Over the moving kernel states.
    turned : float
        As in `Floquet`.
    """
    from cardan_kernel.analysis import Bundle, Variation

    plant, fields = motion.plant, motion.fields
    bundle = Bundle(plant.bundle_state())
    order = 2.0 * math.pi / plant.period_angle
    outside = plant.surrounding.evaluate(motion.states, motion.own, fields.outputs[:, 5])
    _load(bundle, False, order, motion.states, fields.outputs[:, 1], outside.engine + motion.added,
          outside.engine_by_speed)
    _load(bundle, True, order, motion.states, fields.outputs[:, 5], outside.load, outside.load_by_speed)
    variation = Variation(bundle)
    p, twist, w1, _ = (float(v) for v in motion.states[0])
    variation.start(p, twist, w1, float(motion.states[0, WY]), list(plant.active))
    result = variation.run(motion.period)
    if result != 0:
        raise ArithmeticError(f"the variational equations could not be integrated (result {result})")
    n = len(plant.active)
    columns = np.array(variation.values()[4:]).reshape(n, 4)
    return columns[:, plant.active].T, float(variation.rotation)


def _load(bundle: Any, output: bool, order: float, states: Array, speeds: Array, torque: Array,
          by_speed: Array) -> None:
    """Give the kernel a law: constant and linear parts directly, the rest as Fourier series in the input angle."""
    rest = torque - by_speed * speeds
    even = np.abs(rest - rest[0]).max() <= 1e-13 * max(1.0, float(np.abs(torque).max()))
    flat = np.abs(by_speed - by_speed[0]).max() <= 1e-14 * max(1e-3, float(np.abs(by_speed).max()))
    if even and flat:
        bundle.load(output, float(rest[0]), float(by_speed[0]), 0.0)
        bundle.load_series(output, order, [], [])
        return
    bundle.load(output, 0.0, 0.0, 0.0)
    rates = 2.0 * math.pi * states[:, W1] / float(states[:, W1].mean())
    series = [angle_series(order * states[:, P], rates, values) for values in (rest, by_speed)]
    most = max(len(values) for values in series)
    rest_series, gain_series = (values + [0.0] * (most - len(values)) for values in series)
    bundle.load_series(output, order, rest_series, gain_series)


def angle_series(angles: Array, rates: Array, values: Array) -> list[float]:
    """Return mean, then cosine and sine amplitudes over the angle, of values given at equidistant times of a turn.

    The Fourier integrals over the angle become sums over the times, which converge as fast as the series does.

    Parameters
    ----------
    angles : ndarray, shape (N,), N odd
        Increasing over one turn (2 pi), rad.
    rates : ndarray, shape (N,)
        Derivative of the angles by the fraction of the turn's time, rad.
    values : ndarray, shape (N,)
    """
    count = len(angles)
    weights = rates / (2.0 * math.pi * count)
    size = float(np.abs(values).max(initial=0.0))
    found = [float(weights @ values)]
    for n in range(1, count // 3):
        found += [float(2.0 * (weights * values) @ wave(n * angles)) for wave in (np.cos, np.sin)]
    while len(found) > 1 and max(abs(found[-1]), abs(found[-2])) <= 1e-15 * size:
        del found[-2:]
    return found
