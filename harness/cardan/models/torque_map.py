"""Engine torque over speed and throttle, with a linear lag."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import ClassVar

from cardan.models.base import Bus, Model, Shaft, State, Torque
from cardan.models.parameters import ParameterError, choice, grid, quantities, quantity
from cardan.models.surface import Surface


@dataclass(frozen=True, eq=False)
class TorqueMap(Model):
    """T_map(w, throttle) on a grid; with a lag, tau dT/dt = T_map - T and T is a state.

    ``smooth`` uses bicubic patches with monotone slopes (continuous gradient), ``linear`` bilinear ones. Beyond the
    grid the value at the edge holds.
    """

    kind: ClassVar[str] = "map"
    speeds: tuple[float, ...] = quantities("rad/s", "engine speeds of the columns, increasing")
    throttles: tuple[float, ...] = quantities("1", "throttle positions of the rows, increasing", minimum=0.0,
                                              maximum=1.0)
    torques: tuple[tuple[float, ...], ...] = grid("N.m", "one row of torques per throttle position")
    lag: float = quantity("s", "tau, time constant of the torque", 0.0, minimum=0.0)
    throttle: float = quantity("1", "throttle where no driver sets it", 1.0, minimum=0.0, maximum=1.0)
    interpolation: str = choice(("smooth", "linear"), "between the grid points", "smooth")
    _surface: Surface = field(init=False, repr=False)

    def prepare(self) -> None:
        for key, points in (("speeds", self.speeds), ("throttles", self.throttles)):
            if len(points) < 2 or any(b <= a for a, b in zip(points, points[1:])):
                raise ParameterError(key, points, "must be at least two increasing numbers")
        if len(self.torques) != len(self.throttles) or any(len(row) != len(self.speeds) for row in self.torques):
            raise ParameterError("torques", f"{len(self.torques)} rows", "does not fit speeds and throttles",
                                 f"{len(self.throttles)} rows of {len(self.speeds)} torques")
        self.put(_surface=Surface(self.speeds, self.throttles, self.torques, self.interpolation == "smooth"),
                 states=("engine.torque [N.m]",) if self.lag > 0.0 else ())

    def start(self, t: float, shaft: Shaft, bus: Bus) -> list[float]:
        return [self._surface(shaft.speed, bus.throttle)[0]] if self.lag > 0.0 else []

    def derivative(self, t: float, x: State, shaft: Shaft, bus: Bus) -> list[float]:
        return [(self._surface(shaft.speed, bus.throttle)[0] - x[0]) / self.lag] if self.lag > 0.0 else []

    def torque(self, t: float, x: State, shaft: Shaft, bus: Bus) -> Torque:
        value, by_speed, by_throttle = self._surface(shaft.speed, bus.throttle)
        if self.lag > 0.0:
            return Torque(x[0], (value - x[0]) / self.lag, 0.0)
        return Torque(value, by_throttle * bus.throttle_rate, by_speed)

    def value(self, t: float, x: State, shaft: Shaft, bus: Bus) -> float:
        return x[0] if self.lag > 0.0 else self._surface(shaft.speed, bus.throttle)[0]

    def takes_throttle(self) -> bool:
        return True

    def time_scale(self) -> float:
        return 0.2 * self.lag if self.lag > 0.0 else super().time_scale()
