"""The driveline with its engine and its load as one system of equations, as a user of scipy writes it.

Written from docs/PHYSICS.md sections 2 and 3 without the kernel, in plain floats, which is the fastest that Python
alone offers (docs/NUMERICS.md: numpy on four numbers is six times slower). It is what the peers integrate, and the
independent reference for the error of everything else.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from math import atan2, cos, pi, sin
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
EngineLaw = Callable[[float, float], float]  # angle in rad, speed in rad/s -> N.m
LoadLaw = Callable[[float], float]  # speed in rad/s -> N.m

SIZES = np.array([1.0, 1e-2, 300.0, 300.0])  # of the states, for absolute tolerances: rad, rad, rad/s, rad/s
FINEST = 2.5e-14  # relative tolerance, the smallest that scipy takes


@dataclass(frozen=True)
class Monolith:
    """A compliant double joint between an engine and a load.

    Parameters
    ----------
    engine, load : callable
        Torque of the engine by input angle and speed, of the load by output speed.
    beta1, beta2 : float
        Joint angles, rad.
    speed : float
        Input speed at the start, rad/s; the input angle is zero there.
    twist : float
        Twist of the shaft at the start, rad.
    j1, j2a, j2b, j3, k, d : float
        Inertias, kg.m2, stiffness, N.m/rad, and damping, N.m.s/rad, of docs/PHYSICS.md section 3.
    """

    engine: EngineLaw
    load: LoadLaw
    beta1: float
    beta2: float
    speed: float
    twist: float = 0.0
    j1: float = 0.2
    j2a: float = 0.0044
    j2b: float = 0.0044
    j3: float = 1.5
    k: float = 2e4
    d: float = 2.0

    def start(self) -> list[float]:
        """Return the states at time 0: input angle, twist (rad), input speed, speed of half b (rad/s)."""
        return [0.0, self.twist, self.speed, self.speed / cos(self.beta1)]

    def right_hand_side(self) -> Callable[[float, Any], tuple[float, float, float, float]]:
        """Return the time derivatives of the states as a function of time and states."""
        engine, load = self.engine, self.load
        c1, s1, c2, s2 = cos(self.beta1), sin(self.beta1) ** 2, cos(self.beta2), sin(self.beta2) ** 2
        j1, j2a, j2b, j3, k, d = self.j1, self.j2a, self.j2b, self.j3, self.k, self.d
        quarter = 0.5 * pi

        def rates(t: float, states: Any) -> tuple[float, float, float, float]:
            p, twist, w1, wy = states.tolist()
            sp, cp = sin(p), cos(p)
            d1 = 1.0 - s1 * cp * cp
            r1 = c1 / d1
            slope1 = -2.0 * c1 * s1 * sp * cp / (d1 * d1)
            x = p + atan2((1.0 - c1) * sp * cp, c1 * cp * cp + sp * sp) - twist + quarter
            sx, cx = sin(x), cos(x)
            d2 = 1.0 - s2 * cx * cx
            r2 = c2 / d2
            slope2 = -2.0 * c2 * s2 * sx * cx / (d2 * d2)
            slip = r1 * w1 - wy
            shaft = k * twist + d * slip
            a1 = (engine(p, w1) - r1 * shaft - j2a * r1 * slope1 * w1 * w1) / (j1 + j2a * r1 * r1)
            ay = (shaft - r2 * load(r2 * wy) - j3 * r2 * slope2 * wy * wy) / (j2b + j3 * r2 * r2)
            return w1, slip, a1, ay

        return rates

    def speeds(self, states: Array) -> Array:
        """Return input and output speed, rad/s, shape (2, n), of states of shape (4, n)."""
        p, twist, w1, wy = states
        c1, c2 = cos(self.beta1), cos(self.beta2)
        x = p + np.arctan2((1.0 - c1) * np.sin(p) * np.cos(p), c1 * np.cos(p) ** 2 + np.sin(p) ** 2) - twist
        speeds: Array = np.array([w1, c2 / (1.0 - (sin(self.beta2) * np.sin(x)) ** 2) * wy])
        return speeds

    def reference(self, times: Sequence[float] | Array) -> Array:
        """Return input and output speed at times from 0 on, shape (2, n), by DOP853 at its smallest tolerance."""
        from scipy.integrate import solve_ivp

        solution = solve_ivp(self.right_hand_side(), (0.0, float(times[-1])), self.start(), method="DOP853",
                             t_eval=times, rtol=FINEST, atol=FINEST * SIZES)
        return self.speeds(solution.y)


def speed_error(speeds: Array, reference: Array) -> float:
    """Return the largest error of both speeds over all points, each by its largest value; inf for what is no number."""
    if speeds.shape != reference.shape or not np.isfinite(speeds).all():
        return float("inf")
    largest = np.abs(reference).max(axis=1, keepdims=True)
    return float((np.abs(speeds - reference) / largest).max())
