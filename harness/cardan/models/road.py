"""A vehicle on a road as the load of the output shaft."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import ClassVar

from cardan.models.base import Bus, Discrete, Model, Shaft, State, Torque
from cardan.models.parameters import integer, quantity
from cardan.models.smooth import sign

GRAVITY = 9.80665  # m/s2


@dataclass(frozen=True, eq=False)
class RoadLoad(Model):
    """F = (A + rolling m g cos a + brake brake_force) tanh(v/v0) + B v + (C + rho cd A_f / 2) v abs(v) + m g sin a.

    v = w R / axle_ratio and T = F R / axle_ratio. Rolling resistance and friction brake are smoothed over
    `standstill_speed` v0, so a braked vehicle on a slope creeps at a small fraction of it instead of chattering.
    The vehicle's inertia at the output shaft is `inertia`; a scene puts it into ``output.inertia``.
    """

    kind: ClassVar[str] = "road"
    mass: float = quantity("kg", "vehicle mass", minimum=1e-6)
    wheel_radius: float = quantity("m", "rolling radius R", minimum=1e-6)
    axle_ratio: float = quantity("1", "output shaft speed by wheel speed", 1.0, minimum=1e-6)
    wheel_inertia: float = quantity("kg.m2", "of one wheel", 0.0, minimum=0.0)
    wheels: int = integer("number of wheels", 4, minimum=0, maximum=40)
    rolling: float = quantity("1", "rolling resistance by weight", 0.0, minimum=0.0)
    drag_coefficient: float = quantity("1", "cd", 0.0, minimum=0.0)
    frontal_area: float = quantity("m2", "A_f", 0.0, minimum=0.0)
    air_density: float = quantity("kg/m3", "rho", 1.2, minimum=0.0)
    a: float = quantity("N", "A, coast-down force at standstill", 0.0, minimum=0.0)
    b: float = quantity("N.s/m", "B, coast-down force by speed", 0.0)
    c: float = quantity("N.s2/m2", "C, coast-down force by speed squared", 0.0)
    grade: float = quantity("1", "slope of the road, positive uphill", 0.0, minimum=-1.0, maximum=1.0)
    brake_force: float = quantity("N", "largest force of the friction brakes", 0.0, minimum=0.0)
    standstill_speed: float = quantity("m/s", "v0, smoothing of friction at standstill", 0.1, minimum=1e-6)
    travel: float = field(init=False, repr=False)  # m of road per rad of output shaft
    inertia: float = field(init=False, repr=False)  # kg.m2 at the output shaft
    _dry: float = field(init=False, repr=False)
    _drag: float = field(init=False, repr=False)
    _slope: float = field(init=False, repr=False)

    def prepare(self) -> None:
        weight, length = self.mass * GRAVITY, math.hypot(1.0, self.grade)
        travel = self.wheel_radius / self.axle_ratio
        self.put(travel=travel, inertia=self.mass * travel**2 + self.wheels * self.wheel_inertia / self.axle_ratio**2,
                 _dry=self.a + self.rolling * weight / length,
                 _drag=self.c + 0.5 * self.air_density * self.drag_coefficient * self.frontal_area,
                 _slope=weight * self.grade / length, signals={"vehicle.speed": "m/s"})

    def torque(self, t: float, x: State, shaft: Shaft, bus: Bus) -> Torque:
        travel = self.travel
        v = shaft.speed * travel
        side, slope = sign(v, self.standstill_speed)
        dry = self._dry + bus.brake * self.brake_force
        drag = self._drag * abs(v)
        return Torque(travel * (dry * side + (self.b + drag) * v + self._slope),
                      travel * bus.brake_rate * self.brake_force * side,
                      travel * travel * (dry * slope + self.b + 2.0 * drag))

    def observe(self, t: float, x: State, shaft: Shaft, bus: Bus, discrete: Discrete) -> dict[str, float]:
        return {"vehicle.speed": shaft.speed * self.travel}
