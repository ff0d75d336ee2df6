"""A four-stroke engine with torque ripple."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import ClassVar

from cardan.models.base import Bus, Model, Shaft, State, Torque
from cardan.models.cylinder import Cylinder
from cardan.models.parameters import ParameterError, integer, quantities, quantity, table
from cardan.models.ripple import Ripple
from cardan.models.torque_map import TorqueMap


@dataclass(frozen=True, eq=False)
class FourStroke(Model):
    """T = T_mean + sum of orders k (A_k cos k p + B_k sin k p), p = shaft angle + phase.

    The mean torque is constant (`torque`) or a map (`map`). The orders come from lists (``amplitude cos(k p -
    phase)``, of gas torque in N.m or relative to the mean torque) or from the geometry of the cylinders (`cylinder`:
    gas torque with its motoring and firing parts, and inertia torque), or both, added. p = 0 is firing top dead
    centre of cylinder 1; `phase` is p where the input trunnion lies in the plane of joint 1.
    """

    kind: ClassVar[str] = "four_stroke"
    turns: ClassVar[bool] = True  # needs the crank angle
    cylinders: int = integer("number of cylinders, firing evenly", 4, minimum=1, maximum=24)
    torque_: float | None = quantity("N.m", "constant mean torque", None)
    map: TorqueMap | None = table(TorqueMap, "mean torque as a map, instead of `torque`")
    cylinder: Cylinder | None = table(Cylinder, "geometry from which the orders are computed")
    orders: tuple[float, ...] = quantities("1", "orders of the crank speed, multiples of 0.5", (), above=0.0)
    amplitudes: tuple[float, ...] = quantities("N.m", "fixed amplitude of each order", ())
    relative_amplitudes: tuple[float, ...] = quantities("1", "amplitude of each order by mean torque", ())
    phases: tuple[float, ...] = quantities("rad", "phase of each order", ())
    phase: float = quantity("rad", "crank angle at input angle zero", 0.0)
    friction: float = quantity("N.m", "friction torque added to the mean torque to scale the firing orders", 0.0,
                               minimum=0.0)
    throttle: float = quantity("1", "throttle where no driver sets it", 1.0, minimum=0.0, maximum=1.0)
    _ripple: Ripple = field(init=False, repr=False)
    _steady: Torque = field(init=False, repr=False)

    def prepare(self) -> None:
        if self.torque_ is not None and self.map is not None:
            raise ParameterError("torque", self.torque_, "given together with a map", "one of torque and map")
        if self.torque_ is None and self.map is None and self.cylinder is None and not self.orders:
            raise ParameterError("torque", None, "missing: the engine would give no torque at all",
                                 "one of torque and map; orders or cylinder for the ripple")
        fixed: dict[float, tuple[float, float]] = {}
        relative: dict[float, tuple[float, float]] = {}
        inertial: dict[float, tuple[float, float]] = {}
        if self.cylinder is not None:
            fixed, relative = self.cylinder.gas_orders(self.cylinders)
            inertial = self.cylinder.inertia_orders(self.cylinders)
        count = len(self.orders)
        for key in ("amplitudes", "relative_amplitudes", "phases"):
            given = getattr(self, key)
            if given and len(given) != count:
                raise ParameterError(key, given, f"has {len(given)} entries", f"{count}, one per order")
        if count and not (self.amplitudes or self.relative_amplitudes):
            raise ParameterError("orders", self.orders, "given without amplitudes",
                                 f"amplitudes or relative_amplitudes with {count} entries")
        if len(set(self.orders)) != count or any(2.0 * k != round(2.0 * k) for k in self.orders):
            raise ParameterError("orders", self.orders, "must be different multiples of 0.5 (four strokes)")
        for given, into in ((self.amplitudes, fixed), (self.relative_amplitudes, relative)):
            for k, amplitude, phase in zip(self.orders, given, self.phases or (0.0,) * count):
                a, b = into.get(k, (0.0, 0.0))
                into[k] = (a + amplitude * math.cos(phase), b + amplitude * math.sin(phase))
        self.put(_ripple=Ripple(fixed, relative, inertial), _steady=Torque(self.torque_ or 0.0, 0.0, 0.0),
                 states=self.map.states if self.map else (), signals={"engine.mean_torque": "N.m"})

    def _mean(self, t: float, x: State, shaft: Shaft, bus: Bus) -> Torque:
        return self._steady if self.map is None else self.map.torque(t, x, shaft, bus)

    def start(self, t: float, shaft: Shaft, bus: Bus) -> list[float]:
        return self.map.start(t, shaft, bus) if self.map is not None else []

    def derivative(self, t: float, x: State, shaft: Shaft, bus: Bus) -> list[float]:
        return self.map.derivative(t, x, shaft, bus) if self.map is not None else []

    def torque(self, t: float, x: State, shaft: Shaft, bus: Bus) -> Torque:
        mean, rate, by_speed = self._mean(t, x, shaft, bus)
        angle, speed, _ = shaft
        ripple, by_angle, own, by_mean = self._ripple(angle + self.phase, speed, mean + self.friction)
        share = 1.0 + by_mean
        return Torque(mean + ripple, share * rate + by_angle * speed, share * by_speed + own)

    def takes_throttle(self) -> bool:
        return self.map is not None

    def time_scale(self) -> float:
        return self.map.time_scale() if self.map is not None else super().time_scale()

    def observe(self, t: float, x: State, shaft: Shaft, bus: Bus, discrete: tuple[object, ...]) -> dict[str, float]:
        return {"engine.mean_torque": self._mean(t, x, shaft, bus).value}
