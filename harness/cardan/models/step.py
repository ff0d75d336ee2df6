"""A torque that steps once, in a jump or smoothly, for either end."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from cardan.models.base import INFINITY, Bus, Model, Shaft, State, Torque
from cardan.models.parameters import quantity
from cardan.models.smooth import rise


@dataclass(frozen=True, eq=False)
class StepTorque(Model):
    """T = before for t < time, after for t >= time + width, a quintic between (width 0: a jump, an event)."""

    kind: ClassVar[str] = "step"
    after: float = quantity("N.m", "torque after the step")
    time: float = quantity("s", "time of the step")
    before: float = quantity("N.m", "torque before the step", 0.0)
    width: float = quantity("s", "duration of the step", 0.0, minimum=0.0)

    def torque(self, t: float, x: State, shaft: Shaft, bus: Bus) -> Torque:
        if t < self.time:
            return Torque(self.before, 0.0, 0.0)
        if t >= self.time + self.width:
            return Torque(self.after, 0.0, 0.0)
        share, slope = rise((t - self.time) / self.width)
        change = self.after - self.before
        return Torque(self.before + change * share, change * slope / self.width, 0.0)

    def next_event(self, t: float) -> float:
        return self.time if self.width == 0.0 and t < self.time else INFINITY
