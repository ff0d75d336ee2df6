"""Two engines on one shaft, such as a torque map and its idle governor."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import ClassVar

from cardan.models.base import Bus, Discrete, Model, Shaft, State, Torque


@dataclass(frozen=True, eq=False)
class Combined(Model):
    """T = T_first + T_second. Neither takes discrete decisions."""

    kind: ClassVar[str] = "combined"
    first: Model
    second: Model
    turns: bool = field(init=False, repr=False)
    throttle: float = field(init=False, repr=False)
    _split: int = field(init=False, repr=False)

    def prepare(self) -> None:
        self.put(_split=len(self.first.states), states=self.first.states + self.second.states,
                 signals={**self.first.signals, **self.second.signals},
                 turns=getattr(self.first, "turns", False) or getattr(self.second, "turns", False),
                 throttle=getattr(self.first, "throttle", 0.0))

    def start(self, t: float, shaft: Shaft, bus: Bus) -> list[float]:
        return self.first.start(t, shaft, bus) + self.second.start(t, shaft, bus)

    def derivative(self, t: float, x: State, shaft: Shaft, bus: Bus) -> list[float]:
        n = self._split
        return self.first.derivative(t, x[:n], shaft, bus) + self.second.derivative(t, x[n:], shaft, bus)

    def torque(self, t: float, x: State, shaft: Shaft, bus: Bus) -> Torque:
        n = self._split
        a, b, c = self.first.torque(t, x[:n], shaft, bus)
        d, e, f = self.second.torque(t, x[n:], shaft, bus)
        return Torque(a + d, b + e, c + f)

    def value(self, t: float, x: State, shaft: Shaft, bus: Bus) -> float:
        n = self._split
        return self.first.value(t, x[:n], shaft, bus) + self.second.value(t, x[n:], shaft, bus)

    def takes_throttle(self) -> bool:
        return self.first.takes_throttle() or self.second.takes_throttle()

    def time_scale(self) -> float:
        return min(self.first.time_scale(), self.second.time_scale())

    def next_event(self, t: float) -> float:
        return min(self.first.next_event(t), self.second.next_event(t))

    def observe(self, t: float, x: State, shaft: Shaft, bus: Bus, discrete: Discrete) -> dict[str, float]:
        n = self._split
        return {**self.first.observe(t, x[:n], shaft, bus, discrete),
                **self.second.observe(t, x[n:], shaft, bus, discrete)}
