"""Loads that depend on speed alone: linear, quadratic and any power."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from cardan.models.base import Bus, Model, Shaft, State, Torque
from cardan.models.parameters import quantity


@dataclass(frozen=True, eq=False)
class LinearLoad(Model):
    """T = torque + coefficient w."""

    kind: ClassVar[str] = "linear"
    coefficient: float = quantity("N.m.s/rad", "torque per speed")
    torque_: float = quantity("N.m", "constant part", 0.0)

    def torque(self, t: float, x: State, shaft: Shaft, bus: Bus) -> Torque:
        return Torque(self.torque_ + self.coefficient * shaft.speed, 0.0, self.coefficient)


@dataclass(frozen=True, eq=False)
class QuadraticLoad(Model):
    """T = coefficient w abs(w), as of a fan or a propeller."""

    kind: ClassVar[str] = "quadratic"
    coefficient: float = quantity("N.m.s2/rad2", "torque per speed squared")

    def torque(self, t: float, x: State, shaft: Shaft, bus: Bus) -> Torque:
        slope = self.coefficient * abs(shaft.speed)
        return Torque(slope * shaft.speed, 0.0, 2.0 * slope)


@dataclass(frozen=True, eq=False)
class PowerLoad(Model):
    """T = coefficient abs(w / reference)^exponent sign(w)."""

    kind: ClassVar[str] = "power"
    coefficient: float = quantity("N.m", "torque at the reference speed")
    exponent: float = quantity("1", "exponent of the speed", minimum=1.0, maximum=12.0)
    reference: float = quantity("rad/s", "reference speed", 1.0, minimum=1e-6)

    def torque(self, t: float, x: State, shaft: Shaft, bus: Bus) -> Torque:
        speed = shaft.speed / self.reference
        slope = self.coefficient * abs(speed) ** (self.exponent - 1.0)
        return Torque(slope * speed, 0.0, self.exponent * slope / self.reference)
