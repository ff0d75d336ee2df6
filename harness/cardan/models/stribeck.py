"""Dry friction with a breakaway hump: the load behind stick-slip."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

from cardan.models.base import Bus, Model, Shaft, State, Torque
from cardan.models.parameters import ParameterError, quantity
from cardan.models.smooth import sign


@dataclass(frozen=True, eq=False)
class StribeckLoad(Model):
    """T = [Tc + (Ts - Tc) exp(-(w/ws)^2)] tanh(w/w0) + b w.

    Stribeck's curve in the exponential form of Armstrong-Helouvry, Dupont and Canudas de Wit, Automatica 30
    (1994) 1083, with exponent 2; the sign is smoothed over `smoothing`, so that "sticking" is a creep below
    that speed.
    """

    kind: ClassVar[str] = "stribeck"
    sliding: float = quantity("N.m", "Tc, torque of sliding friction", minimum=0.0)
    breakaway: float = quantity("N.m", "Ts, torque at breakaway", minimum=0.0)
    stribeck_speed: float = quantity("rad/s", "ws, width of the hump", 1.0, minimum=1e-6)
    viscous: float = quantity("N.m.s/rad", "b, viscous part", 0.0, minimum=0.0)
    smoothing: float = quantity("rad/s", "w0, speed over which the sign is smoothed", 0.01, minimum=1e-6)

    def prepare(self) -> None:
        if self.breakaway < self.sliding:
            raise ParameterError("breakaway", self.breakaway, "below the sliding friction", f">= {self.sliding:g} N.m")

    def torque(self, t: float, x: State, shaft: Shaft, bus: Bus) -> Torque:
        w = shaft.speed
        ratio = w / self.stribeck_speed
        hump = (self.breakaway - self.sliding) * math.exp(-ratio * ratio)
        side, slope = sign(w, self.smoothing)
        level = self.sliding + hump
        by_speed = level * slope - 2.0 * ratio / self.stribeck_speed * hump * side + self.viscous
        return Torque(level * side + self.viscous * w, 0.0, by_speed)
