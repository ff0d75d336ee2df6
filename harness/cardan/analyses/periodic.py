"""Periodic motions by harmonic balance, as collocation at equidistant times with the exact Jacobians.

The states over one period are trigonometric polynomials through N (odd) points; Newton's method solves for all
points at once, with one further unknown (the torque that holds a given mean speed, or the mean speed that given
torques hold) and the phase condition p(0) = 0. N doubles until the highest harmonics vanish.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from cardan.analyses.plant import TWIST, W1, WY, Fields, P, Plant
from cardan.analyses.trigonometric import differentiation, resample
from cardan.errors import CardanError

Array = NDArray[np.float64]

SIZES = (33, 65, 129, 257, 385)
LARGEST_TWIST = 3.0  # rad
FAR = (0.3, 3.0)  # of the guessed speed: a search beyond is lost
HOW_TO = "give a load that rises with speed, or damping (output.damping, shaft.damping), or another speed"


class NoSteadyState(CardanError):
    """There is no periodic motion, or none was found; the text says why."""


@dataclass(frozen=True)
class Motion:
    """A periodic motion at N equidistant times.

    Attributes
    ----------
    plant : Plant
    speed : float
        Mean input speed, rad/s.
    period : float
        Time after which everything repeats, s.
    states : ndarray, shape (N, 4)
        Kernel states; p grows by ``plant.period_angle`` over the period.
    own : ndarray, shape (N, k)
        Own states of engine and load.
    added : float
        Torque added to the engine's to hold the speed, N.m.
    fields : Fields
        Equations and Jacobians at the points.
    residual : float
        Largest defect of the equations at the points, by the size of their terms.
    """

    plant: Plant
    speed: float
    period: float
    states: Array
    own: Array
    added: float
    fields: Fields
    residual: float

    @property
    def fundamental(self) -> float:
        """Angular frequency of the motion's fundamental, rad/s."""
        return 2.0 * math.pi / self.period

    @property
    def mean_torque(self) -> float:
        """Mean torque of the drive over time, N.m (the reaction where the speed is prescribed)."""
        return float(self.fields.outputs[:, 3].mean())

    @property
    def times(self) -> Array:
        """The N times, s."""
        count = len(self.states)
        return np.asarray(np.arange(count) * (self.period / count), dtype=float)


def periodic_motion(plant: Plant, speed: float, hold: bool = True, guess: Motion | None = None) -> Motion:
    """Find the periodic motion.

    Parameters
    ----------
    plant : Plant
        What turns.
    speed : float
        Mean input speed, rad/s; prescribed (``plant.driven``), held by an added torque (`hold`), or a first guess.
    hold : bool
        Whether the mean speed is given and a torque is added that holds it.
    guess : Motion, optional
        A motion nearby.

    Raises
    ------
    NoSteadyState
        If Newton's method does not arrive, with the reason as far as it is known.
    """
    solver = _Balance(plant, hold)
    x, unknown = solver.first(speed, guess)
    for size in SIZES:
        x = resample(x, size)
        x, unknown, fields, residual = solver.solve(x, unknown, speed)
        if _tail(x, fields) < plant.noise or size == SIZES[-1]:
            break
    if _tail(x, fields) > 1e-7:
        raise NoSteadyState(f"the motion needs more than {SIZES[-1] // 2} harmonics ({_where(plant, speed)}): the "
                            "joint is too steep or the speed too near a resonance for harmonic balance")
    states, own = solver.full(x, unknown, speed)
    mean = solver.speed(unknown, speed)
    return Motion(plant, mean, plant.period_angle / mean, states, own, solver.added(unknown), fields, residual)


class _Balance:
    """The equations of collocation; the unknowns are the deviations from uniform rotation."""

    def __init__(self, plant: Plant, hold: bool) -> None:
        self.plant = plant
        self.free = not plant.driven
        self.hold = hold
        self.n = len(plant.active)
        self.k = len(plant.own)

    def speed(self, unknown: float, speed: float) -> float:
        return unknown if self.free and not self.hold else speed

    def added(self, unknown: float) -> float:
        return unknown if self.free and self.hold else 0.0

    def first(self, speed: float, guess: Motion | None) -> tuple[Array, float]:
        """Return deviations at the fewest points, and the unknown."""
        plant, count = self.plant, SIZES[0]
        if guess is not None:
            states = guess.states.copy()
            states[:, P] -= plant.period_angle * np.arange(len(states)) / len(states)
            x = np.concatenate([states[:, plant.active], guess.own], axis=1)
            return x, guess.added if self.hold else guess.speed
        if speed <= 0.0 or not math.isfinite(speed):
            raise NoSteadyState(f"a mean input speed of {speed:g} rad/s is no rotation: give a speed above 0")
        balance = plant.surrounding.balance(speed) if self.free else 0.0
        drag = plant.values["input.damping"] + plant.values["output.damping"]
        x = np.zeros((count, self.n + self.k))
        columns = dict(zip(plant.active, range(self.n), strict=True))
        if W1 in columns:
            x[:, columns[W1]] = speed
        states = np.zeros((count, 4))
        states[:, P] = plant.period_angle * np.arange(count) / count
        states[:, W1] = states[:, WY] = speed
        own = np.tile(plant.surrounding.start(speed), (count, 1))
        x[:, self.n:] = own
        if WY in columns:
            straight = plant.fields(states, own)
            x[:, columns[WY]] = straight.outputs[:, 9]  # speed of half a
            load = float(straight.torques[:, 1].mean()) + plant.values["output.damping"] * speed
            if plant.values["shaft.stiffness"] > 0.0:
                x[:, columns[TWIST]] = load / plant.values["shaft.stiffness"]
        return x, (drag * speed - balance) if self.hold else speed

    def full(self, x: Array, unknown: float, speed: float) -> tuple[Array, Array]:
        """Return all four kernel states and the own states at the points."""
        plant, count = self.plant, len(x)
        states = np.zeros((count, 4))
        states[:, W1] = self.speed(unknown, speed)
        states[:, plant.active] = x[:, :self.n]
        states[:, P] += plant.period_angle * np.arange(count) / count
        return states, x[:, self.n:]

    def solve(self, x: Array, unknown: float, speed: float) -> tuple[Array, float, Fields, float]:
        """Newton's method at the points of `x`."""
        count, n = x.shape
        derivative = differentiation(count)
        best = math.inf
        for _ in range(40):
            states, own = self.full(x, unknown, speed)
            fields = self.plant.fields(states, own, self.added(unknown))
            mean = self.speed(unknown, speed)
            base = 2.0 * math.pi * mean / self.plant.period_angle
            moving = base * (derivative @ x)
            if P in self.plant.active:
                moving[:, 0] += mean
            defect = moving - fields.rates
            size = np.abs(moving).max(axis=0) + np.abs(fields.rates).max(axis=0)
            size = np.maximum(size, base * np.maximum(np.abs(x).max(axis=0), 1e-3))
            residual = float((np.abs(defect) / size).max()) if n else 0.0
            if not math.isfinite(residual):
                raise NoSteadyState(self._lost(speed))
            if n == 0 or residual < 1e-15 or (residual < 1e-11 and residual > 0.3 * best):
                return x, unknown, fields, residual
            best = min(best, residual)
            step = self._newton(derivative, base, mean, fields, x, defect)
            scale = min(1.0, LARGEST_TWIST / max(1e-300, float(np.abs(step[:count * n].reshape(count, n)
                                                                      [:, self._angles()]).max(initial=0.0))))
            x = x + scale * step[:count * n].reshape(count, n)
            if self.free:
                unknown += scale * float(step[-1])
                if not self.hold and not FAR[0] * speed < unknown < FAR[1] * speed:
                    raise NoSteadyState(self._lost(speed))
        if best < 1e-9:
            return x, unknown, fields, residual
        raise NoSteadyState(self._lost(speed))

    def _angles(self) -> list[int]:
        return [i for i, state in enumerate(self.plant.active) if state in (P, TWIST)]

    def _newton(self, derivative: Array, base: float, mean: float, fields: Fields, x: Array, defect: Array) -> Array:
        count, n = x.shape
        size = count * n + (1 if self.free else 0)
        matrix = np.zeros((size, size))
        block = matrix[:count * n, :count * n].reshape(count, n, count, n)
        for j in range(n):
            block[:, j, :, j] = base * derivative
        for i in range(count):
            block[i, :, i, :] -= fields.a[i]
        right = np.zeros(size)
        right[:count * n] = -defect.ravel()
        if self.free:
            if self.hold:
                matrix[:-1, -1] = -fields.b[:, :, 0].ravel()
            else:
                column = (base / mean) * (derivative @ x)
                column[:, 0] += 1.0
                matrix[:-1, -1] = column.ravel()
            matrix[-1, 0] = 1.0  # p(0) = 0
            right[-1] = -x[0, 0]
        try:
            solution: Array = np.linalg.solve(matrix, right)
        except np.linalg.LinAlgError:
            raise NoSteadyState(self._singular(mean)) from None
        return solution

    def _singular(self, speed: float) -> str:
        return f"no single steady state exists ({_where(self.plant, speed)}): nothing fixes speed or torque; {HOW_TO}"

    def _lost(self, speed: float) -> str:
        return (f"no steady state was found ({_where(self.plant, speed)}): near a resonance without damping the motion "
                f"grows without bound; {HOW_TO}")


def _tail(x: Array, fields: Fields) -> float:
    """Return the size of the highest harmonics of states, kernel outputs and Jacobian by their largest."""
    n = fields.kernel
    values = np.concatenate([x, fields.outputs[:, 5:8], fields.a[:, :n, :n].reshape(len(x), -1)], axis=1)
    spectrum = np.abs(np.fft.rfft(values, axis=0)) / len(x)
    size = spectrum.max(axis=0)
    # differences and cancellation leave noise in quantities that vanish or hardly matter
    size = np.maximum(size, 1e-3 if not n else 1e-6 * size.max())
    top = spectrum[-max(2, len(spectrum) // 8):].max(axis=0)
    return float((top / size).max())


def _where(plant: Plant, speed: float) -> str:
    one, two = (math.degrees(angle) for angle in plant.joints())
    return f"{speed * 30.0 / math.pi:.6g} rpm, joints {one:.4g} and {two:.4g} deg"
