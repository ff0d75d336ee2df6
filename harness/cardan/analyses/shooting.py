"""Periodic motions by shooting in the kernel, fast enough for charts.

Where engine and load have no states of their own and their torques are c0 + c1 w + c2 w |w| over the speeds that
matter, the kernel integrates the motion with its fundamental matrix itself, and Newton's method closes the period from
the shaft angle 0 on. Other scenes take the harmonic balance of `cardan.analyses.periodic`, some hundred times slower.
"""

from __future__ import annotations

import contextlib
import math

import numpy as np
from numpy.typing import NDArray

from cardan.analyses.floquet import floquet, return_map
from cardan.analyses.periodic import Motion, NoSteadyState, periodic_motion
from cardan.analyses.plant import TWIST, W1, WY, Plant
from cardan.analyses.polynomials import polynomials
from cardan.analyses.section import Section, rotation_number, twist_pair

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]

CLOSED = 1e-12
LARGEST_TWIST = 0.5  # rad, of a Newton step where twists enter through a bent joint
LARGEST_CHANGE = 0.2  # of the speed
NEAR = 0.2  # of the speed: a motion this near is the first guess
MOST_STEPS = 20000.0


class Shooter:
    """Return maps of a plant at any speed.

    Parameters
    ----------
    plant : Plant
        With a compliant shaft.
    low, high : float
        Speeds (rad/s) between which motions are wanted: the torques are polynomials there, or not.
    """

    def __init__(self, plant: Plant, low: float = 10.0, high: float = 1000.0) -> None:
        from cardan_kernel.analysis import Variation

        self.plant = plant
        self.laws = None if plant.own or plant.surrounding.turns else polynomials(plant, 0.3 * low, 3.0 * high)
        self.variation = Variation(plant.bundle)
        self.variation.most_steps = MOST_STEPS
        self.evaluations = 0
        self._guess: Motion | None = None
        self._last: tuple[float, Array, float] | None = None
        self._turns = round(plant.period_angle / math.pi)

    @property
    def _ratio(self) -> float:
        """Speed ratio of joint 1 at the angle 0, where a period starts."""
        return 1.0 / math.cos(self.plant.joints()[0])

    @property
    def fast(self) -> bool:
        """Whether the kernel does it alone."""
        return self.laws is not None

    def section(self, speed: float) -> Section:
        """Return the return map of the periodic motion at a mean speed.

        Raises
        ------
        NoSteadyState
            If the motion is not found.
        """
        self.evaluations += 1
        if self.laws is None:
            return self._balanced(speed)
        solve = self._driven if self.plant.driven else self._free
        near = self._last
        if near is not None and abs(speed / near[0] - 1.0) < NEAR:
            with contextlib.suppress(NoSteadyState):
                return solve(speed, near)
        return solve(speed, None)

    def _driven(self, speed: float, near: tuple[float, Array, float] | None) -> Section:
        variation = self.variation
        period = self.plant.period_angle / speed
        self._load(0.0)
        x = np.array([self._static_twist(speed), self._ratio * speed])
        if near is not None:
            x = near[1] * np.array([1.0, speed / near[0]])
        for _ in range(20):
            variation.start(0.0, x[0], speed, x[1], (1, 3))
            if variation.run(period) != 0:
                raise NoSteadyState(self._lost(speed))
            y = variation.values()
            matrix = np.array([[y[5], y[9]], [y[7], y[11]]])
            gap = np.array([y[1], y[3]]) - x
            if self._closed(gap, speed):
                self._last = speed, x, 0.0
                swing = abs(x[0]) + abs(x[1] / speed - self._ratio)
                return self._made(speed, period, matrix, np.array([0.0, -1.0]), variation.rotation, swing)
            x = x + self._step(matrix - np.eye(2), gap, speed)
        raise NoSteadyState(self._lost(speed))

    def _free(self, speed: float, near: tuple[float, Array, float] | None) -> Section:
        plant, variation = self.plant, self.variation
        period = plant.period_angle / speed
        x = np.array([self._static_twist(speed), speed, self._ratio * speed])
        added = self._mean_torque(speed)
        if near is not None:
            x = near[1] * np.array([1.0, speed / near[0], speed / near[0]])
            added += near[2]
        for _ in range(30):
            self._load(added)
            variation.start(0.0, x[0], x[1], x[2], (0, 1, 2, 3, 4))
            rates = np.array(variation.rates()[:4])
            if variation.run(period) != 0:
                raise NoSteadyState(self._lost(speed))
            y = np.array(variation.values())
            grown = y[4:].reshape(5, 4).T
            gap = y[:4] - np.array([plant.period_angle, *x])
            if self._closed(gap[1:], speed) and abs(gap[0]) < CLOSED:
                self._last = speed, x, added - self._mean_torque(speed)
                conserved = self._energy_gradient(np.array([0.0, *x])) if self._conservative() else None
                swing = abs(x[0]) + abs(self._ratio * x[1] - x[2]) / speed
                return self._made(speed, period, return_map(grown[:, :4], rates), np.array([0.0, self._ratio, -1.0]),
                                  variation.rotation, swing, conserved)
            jacobian = grown[:, 1:].copy()
            jacobian[1:, :3] -= np.eye(3)
            step = self._step(jacobian, gap, speed)
            x = x + step[:3]
            added += step[3]
        raise NoSteadyState(self._lost(speed))

    def _balanced(self, speed: float) -> Section:
        plant = self.plant
        hold = plant.surrounding.target is None
        if not hold:
            plant.surrounding.aim(speed)  # who controls the speed outside gets it as target
        guess = self._guess if hold else None
        try:
            motion = periodic_motion(plant, speed, hold, guess)
        except NoSteadyState:
            motion = periodic_motion(plant, speed, hold)
        self._guess = motion
        found = floquet(motion)
        matrix = return_map(found.monodromy, motion.fields.rates[0]) if found.free_phase else found.monodromy
        slip = np.delete(motion.fields.a[0, plant.states.index("shaft.twist")], 0 if found.free_phase else [])
        return self._made(speed, motion.period, matrix, slip, found.turned, float(np.ptp(motion.states[:, TWIST])))

    def _made(self, speed: float, period: float, matrix: Array, slip: Array, turned: float, swing: float,
              conserved: Array | None = None) -> Section:
        multipliers, vectors = np.linalg.eig(matrix)
        multipliers = multipliers.astype(complex)
        pair = twist_pair(multipliers, vectors, slip)
        rotation = rotation_number(multipliers[pair], vectors[:, pair], slip, turned)
        return Section(speed, period, matrix, multipliers, rotation, swing, np.delete(multipliers, pair), conserved)

    def _step(self, jacobian: Array, gap: Array, speed: float) -> Array:
        try:
            step: Array = np.asarray(-np.linalg.solve(jacobian, gap), dtype=float)
        except np.linalg.LinAlgError:
            raise NoSteadyState(self._lost(speed)) from None
        if not np.all(np.isfinite(step)):
            raise NoSteadyState(self._lost(speed))
        if self.plant.driven and self.plant.joints()[1] == 0.0:
            return step  # the equations are linear
        most = max(abs(float(step[0])) / LARGEST_TWIST, float(np.abs(step[1:3]).max()) / (LARGEST_CHANGE * speed))
        return np.asarray(step / max(1.0, most), dtype=float)

    def _closed(self, gap: Array, speed: float) -> bool:
        scale = np.full(len(gap), speed)
        scale[0] = 1.0
        return bool(np.all(np.abs(gap) <= CLOSED * scale))

    def _load(self, added: float) -> None:
        assert self.laws is not None
        engine, load = self.laws
        self.plant.bundle.load(False, engine[0] + added, engine[1], engine[2])
        self.plant.bundle.load(True, *load)

    def _static_twist(self, speed: float) -> float:
        assert self.laws is not None
        stiffness = self.plant.values["shaft.stiffness"]
        c0, c1, c2 = self.laws[1]
        load = c0 + (c1 + c2 * speed + self.plant.values["output.damping"]) * speed
        return load / stiffness if stiffness > 0.0 else 0.0

    def _mean_torque(self, speed: float) -> float:
        assert self.laws is not None
        values = self.plant.values
        (e0, e1, e2), (c0, c1, c2) = self.laws
        return (c0 - e0) + (c1 - e1 + (c2 - e2) * speed + values["output.damping"] + values["input.damping"]) * speed

    def _conservative(self) -> bool:
        assert self.laws is not None
        lossy = ("input.damping", "output.damping", "shaft.damping", "joint1.trunnion.damping_a",
                 "joint1.trunnion.damping_b", "joint1.trunnion.friction", "joint2.trunnion.damping_a",
                 "joint2.trunnion.damping_b", "joint2.trunnion.friction")
        values = self.plant.values
        return all(values[name] == 0.0 for name in lossy) and all(c == 0.0 for law in self.laws for c in law[1:])

    def _energy_gradient(self, full: Array) -> Array:
        """Derivatives of kinetic, strain and load's potential energy by twist, w1 and wy."""
        plant = self.plant
        assert self.laws is not None
        states = np.tile(full, (5, 1))
        shift = 1e-3
        states[1:, TWIST] += shift * np.array([1.0, -1.0, 2.0, -2.0])
        fields = plant.fields(states, np.zeros((5, 0)))
        behind = -fields.outputs[:, 5] / full[WY] / fields.b[:, 3, 1]  # r2 / (dwy'/dT) = -m2
        inertia = 1.0 / fields.b[0, 2, 0]
        slope = (8.0 * (behind[1] - behind[2]) - (behind[3] - behind[4])) / (12.0 * shift)
        ratio = fields.outputs[0, 5] / full[WY]
        by_twist = plant.values["shaft.stiffness"] * full[TWIST] + 0.5 * slope * full[WY] ** 2 - self.laws[1][0] * ratio
        return np.array([by_twist, inertia * full[W1], behind[0] * full[WY]])

    def _lost(self, speed: float) -> str:
        one, two = (math.degrees(angle) for angle in self.plant.joints())
        return (f"no periodic motion found at {speed * 30.0 / math.pi:.6g} rpm, joints {one:.4g} and {two:.4g} deg: "
                "near a resonance without damping it grows without bound")
