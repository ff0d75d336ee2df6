"""A dynamometer that holds or ramps the output speed."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import ClassVar

from cardan.models.base import Bus, Discrete, Model, Shaft, State, Torque
from cardan.models.parameters import choice, quantity
from cardan.models.program import SpeedProgram
from cardan.models.smooth import clamp


@dataclass(frozen=True, eq=False)
class Dyno(Model):
    """T = clamp(u), u = kp (w - w_set(t)) + i, di/dt = ki (w - w_set) + (T - u) ki / kp, within +-torque_limit."""

    kind: ClassVar[str] = "dyno"
    speed: float = quantity("rad/s", "speed to hold (before a ramp)")
    gain: float = quantity("N.m.s/rad", "kp, torque per speed error", minimum=1e-6)
    integral_gain: float = quantity("N.m/rad", "ki, torque per time integral of the speed error", minimum=0.0)
    torque_limit: float = quantity("N.m", "largest torque in either direction", minimum=1e-6)
    rounding: float = quantity("N.m", "torque over which the limits are rounded", 2.0, minimum=1e-6)
    final_speed: float | None = quantity("rad/s", "speed after a ramp", None)
    ramp_start: float = quantity("s", "start of the ramp", 0.0)
    ramp_time: float = quantity("s", "duration of the ramp", 1.0, minimum=1e-6)
    shape: str = choice(("linear", "smooth"), "straight ramp, or quintic with continuous acceleration", "linear")
    initial_torque: float = quantity("N.m", "integral part at start", 0.0)
    _program: SpeedProgram = field(init=False, repr=False)

    def prepare(self) -> None:
        last = self.speed if self.final_speed is None else self.final_speed
        duration = 0.0 if self.final_speed is None else self.ramp_time
        self.put(_program=SpeedProgram(self.speed, last, self.ramp_start, duration, self.shape == "smooth"),
                 states=("dyno.integral [N.m]",), signals={"dyno.target_speed": "rad/s"})

    def start(self, t: float, shaft: Shaft, bus: Bus) -> list[float]:
        return [self.initial_torque]

    def derivative(self, t: float, x: State, shaft: Shaft, bus: Bus) -> list[float]:
        error = shaft.speed - self._program(t)[0]
        wanted = self.gain * error + x[0]
        given, _ = clamp(wanted, -self.torque_limit, self.torque_limit, self.rounding)
        return [self.integral_gain * (error + (given - wanted) / self.gain)]

    def torque(self, t: float, x: State, shaft: Shaft, bus: Bus) -> Torque:
        target, target_rate, _ = self._program(t)
        error = shaft.speed - target
        wanted = self.gain * error + x[0]
        given, slope = clamp(wanted, -self.torque_limit, self.torque_limit, self.rounding)
        rate = self.integral_gain * (error + (given - wanted) / self.gain) - self.gain * target_rate
        return Torque(given, slope * rate, self.gain * slope)

    def time_scale(self) -> float:
        if self.integral_gain == 0.0:
            return super().time_scale()
        return 0.2 * self.gain / self.integral_gain

    def next_event(self, t: float) -> float:
        return self._program.next_corner(t)

    def observe(self, t: float, x: State, shaft: Shaft, bus: Bus, discrete: Discrete) -> dict[str, float]:
        return {"dyno.target_speed": self._program(t)[0]}
