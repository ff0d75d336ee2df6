"""Idle governor: a PI controller that keeps an engine running at its idle speed."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from cardan.models.base import Bus, Model, Shaft, State, Torque
from cardan.models.parameters import ParameterError, quantity
from cardan.models.smooth import clamp


@dataclass(frozen=True, eq=False)
class IdleGovernor(Model):
    """T = clamp(u), u = kp (w_set - w) + i, di/dt = ki (w_set - w) + (T - u) ki / kp.

    The last term (back-calculation with the integral time) stops the integral from winding up while the torque is
    limited. The corners of the clamp are rounded over `rounding`.
    """

    kind: ClassVar[str] = "idle"
    speed: float = quantity("rad/s", "idle speed")
    gain: float = quantity("N.m.s/rad", "kp, torque per speed error", minimum=1e-6)
    integral_gain: float = quantity("N.m/rad", "ki, torque per time integral of the speed error", minimum=0.0)
    torque_high: float = quantity("N.m", "largest torque")
    torque_low: float = quantity("N.m", "smallest torque", 0.0)
    rounding: float = quantity("N.m", "torque over which the limits are rounded", 2.0, minimum=1e-6)
    initial_torque: float = quantity("N.m", "integral part at start", 0.0)

    def prepare(self) -> None:
        if self.torque_high <= self.torque_low:
            raise ParameterError("torque_high", self.torque_high, "not above torque_low", f"> {self.torque_low:g} N.m")
        self.put(states=("governor.integral [N.m]",), signals={"governor.torque": "N.m"})

    def start(self, t: float, shaft: Shaft, bus: Bus) -> list[float]:
        return [self.initial_torque]

    def derivative(self, t: float, x: State, shaft: Shaft, bus: Bus) -> list[float]:
        error = self.speed - shaft.speed
        wanted = self.gain * error + x[0]
        given, _ = clamp(wanted, self.torque_low, self.torque_high, self.rounding)
        return [self.integral_gain * (error + (given - wanted) / self.gain)]

    def torque(self, t: float, x: State, shaft: Shaft, bus: Bus) -> Torque:
        error = self.speed - shaft.speed
        wanted = self.gain * error + x[0]
        given, slope = clamp(wanted, self.torque_low, self.torque_high, self.rounding)
        rate = self.integral_gain * (error + (given - wanted) / self.gain)
        return Torque(given, slope * rate, -self.gain * slope)

    def value(self, t: float, x: State, shaft: Shaft, bus: Bus) -> float:
        return clamp(self.gain * (self.speed - shaft.speed) + x[0], self.torque_low, self.torque_high, self.rounding)[0]

    def time_scale(self) -> float:
        if self.integral_gain == 0.0:
            return super().time_scale()
        return 0.2 * self.gain / self.integral_gain

    def observe(self, t: float, x: State, shaft: Shaft, bus: Bus, discrete: tuple[object, ...]) -> dict[str, float]:
        return {"governor.torque": self.value(t, x, shaft, bus)}
