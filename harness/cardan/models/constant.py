"""Constant torque, for either end."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import ClassVar

from cardan.models.base import Bus, Model, Shaft, State, Torque
from cardan.models.parameters import quantity


@dataclass(frozen=True, eq=False)
class ConstantTorque(Model):
    """T = const."""

    kind: ClassVar[str] = "constant"
    torque_: float = quantity("N.m", "torque")
    _always: Torque = field(init=False, repr=False)

    def prepare(self) -> None:
        self.put(_always=Torque(float(self.torque_), 0.0, 0.0))

    def torque(self, t: float, x: State, shaft: Shaft, bus: Bus) -> Torque:
        return self._always
