"""An engine strong enough to prescribe the input speed."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import ClassVar

from cardan.models.base import Bus, Model, Shaft, State, Torque
from cardan.models.parameters import choice, quantity
from cardan.models.program import SpeedProgram


@dataclass(frozen=True, eq=False)
class PrescribedSpeed(Model):
    """w_in(t) given: constant, or a ramp to `final_speed`. The FMU runs with ``model.drive = 1``.

    The torque on the shaft is what the FMU reports as ``input.reaction_torque``; `torque` is zero.
    """

    kind: ClassVar[str] = "speed"
    drive: ClassVar[int] = 1
    speed: float = quantity("rad/s", "input speed (before a ramp)")
    final_speed: float | None = quantity("rad/s", "input speed after a ramp", None)
    ramp_start: float = quantity("s", "start of the ramp", 0.0)
    ramp_time: float = quantity("s", "duration of the ramp", 1.0, minimum=1e-6)
    shape: str = choice(("linear", "smooth"), "straight ramp, or quintic with continuous acceleration", "linear")
    _program: SpeedProgram = field(init=False, repr=False)

    def prepare(self) -> None:
        last = self.speed if self.final_speed is None else self.final_speed
        duration = 0.0 if self.final_speed is None else self.ramp_time
        self.put(_program=SpeedProgram(self.speed, last, self.ramp_start, duration, self.shape == "smooth"))

    def torque(self, t: float, x: State, shaft: Shaft, bus: Bus) -> Torque:
        return Torque(0.0, 0.0, 0.0)

    def command(self, t: float) -> tuple[float, float, float]:
        return self._program(t)

    def next_event(self, t: float) -> float:
        return self._program.next_corner(t)
