"""Engine, launch clutch and gearbox in front of the driveline."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import ClassVar

from cardan.models.base import Bus, Discrete, Model, Shaft, State, Torque
from cardan.models.clutch import Clutch
from cardan.models.parameters import ParameterError, integer, quantities, quantity, table
from cardan.models.shift import Gear, ShiftSchedule


@dataclass(frozen=True, eq=False)
class Gearbox(Model):
    """An engine with its own speed, driving the input shaft through a clutch and one of several ratios.

    ``J w_e' = T_engine - T_c``, ``T_c`` from `Clutch` with the turbine speed ``i w_in``; on the shaft
    ``T = i (T_c - (1 - efficiency) (sqrt(T_c^2 + T_0^2) - T_0))``, a loss in both directions of power (for forward
    rotation), rounded over T_0 = 5 N.m. The throttle follows the closure of the clutch during a shift. The crank
    angle is a state where the engine has ripple, whose orders so follow the engine.
    """

    kind: ClassVar[str] = "gearbox"
    ROUNDING: ClassVar[float] = 5.0  # N.m, T_0
    source: Model
    ratios: tuple[float, ...] = quantities("1", "ratio (engine by output speed) of each gear, from first", minimum=1e-6)
    engine_inertia: float = quantity("kg.m2", "crank, flywheel and driving half of the clutch", minimum=1e-6)
    initial_speed: float = quantity("rad/s", "engine speed at start", minimum=0.0)
    clutch: Clutch = table(Clutch, "launch and shift clutch")
    shift: ShiftSchedule = table(ShiftSchedule, "shift schedule")
    efficiency: float = quantity("1", "of the gears", 1.0, above=0.0, maximum=1.0)
    initial_gear: int = integer("gear at start", 1, minimum=1)
    _turns: bool = field(init=False, repr=False)
    throttle: float = field(init=False, repr=False)

    def prepare(self) -> None:
        if self.clutch is None or self.shift is None:
            missing = "clutch" if self.clutch is None else "shift"
            raise ParameterError(missing, None, "missing", f"a table [engine.gearbox.{missing}]")
        if not self.ratios:
            raise ParameterError("ratios", self.ratios, "needs at least one ratio")
        if any(b >= a for a, b in zip(self.ratios, self.ratios[1:])):
            raise ParameterError("ratios", self.ratios, "must decrease from first gear up")
        if self.initial_gear > len(self.ratios):
            raise ParameterError("initial_gear", self.initial_gear, "no such gear", f"[1, {len(self.ratios)}]")
        self.shift.check(self.ratios)
        turns = bool(getattr(self.source, "turns", False))
        crank = ("engine.speed [rad/s]", "engine.angle [rad]") if turns else ("engine.speed [rad/s]",)
        self.put(_turns=turns, states=crank + self.source.states, throttle=getattr(self.source, "throttle", 0.0),
                 signals={"engine.speed": "rad/s", "engine.torque": "N.m", "gearbox.gear": "1", "clutch.torque": "N.m",
                          "clutch.slip": "rad/s", **self.source.signals})

    def start(self, t: float, shaft: Shaft, bus: Bus) -> list[float]:
        crank = [self.initial_speed, 0.0] if self._turns else [self.initial_speed]
        return crank + self.source.start(t, Shaft(0.0, self.initial_speed, 0.0), bus)

    def start_discrete(self, t: float, shaft: Shaft) -> Discrete:
        return Gear(self.initial_gear, self.initial_gear, -math.inf, self.shift.sample_at(t) + 1)

    def _engine(self, t: float, x: State, bus: Bus, closure: float, rate: float) -> tuple[State, Shaft, Bus]:
        """Return what the engine sees: its own states, its crank and the throttle that it is given."""
        if self._turns:
            own, crank = x[2:], Shaft(x[1], x[0], 0.0)
        else:
            own, crank = x[1:], Shaft(0.0, x[0], 0.0)
        if closure < 1.0:
            bus = Bus(closure * bus.throttle, closure * bus.throttle_rate + rate * bus.throttle, bus.brake,
                      bus.brake_rate)
        return own, crank, bus

    def derivative(self, t: float, x: State, shaft: Shaft, bus: Bus) -> list[float]:
        number, closure, rate = self.shift.closure(t, bus.discrete)  # type: ignore[arg-type]
        own, crank, pedals = self._engine(t, x, bus, closure, rate)
        transmitted = self.clutch.value(x[0], self.ratios[number - 1] * shaft.speed, closure)
        head = [(self.source.value(t, own, crank, pedals) - transmitted) / self.engine_inertia]
        if self._turns:
            head.append(x[0])
        return head + self.source.derivative(t, own, crank, pedals)

    def torque(self, t: float, x: State, shaft: Shaft, bus: Bus) -> Torque:
        number, closure, rate = self.shift.closure(t, bus.discrete)  # type: ignore[arg-type]
        own, crank, pedals = self._engine(t, x, bus, closure, rate)
        ratio = self.ratios[number - 1]
        value, by_engine, by_turbine, by_closure = self.clutch.torque(x[0], ratio * shaft.speed, closure)
        acceleration = (self.source.value(t, own, crank, pedals) - value) / self.engine_inertia
        root = math.sqrt(value * value + self.ROUNDING * self.ROUNDING)
        share = ratio * (1.0 - (1.0 - self.efficiency) * value / root)
        return Torque(ratio * (value - (1.0 - self.efficiency) * (root - self.ROUNDING)),
                      share * (by_engine * acceleration + by_closure * rate), share * ratio * by_turbine)

    def takes_throttle(self) -> bool:
        return self.source.takes_throttle()

    def time_scale(self) -> float:
        # half the clutch's time constant: RK4 is then accurate to 3e-4 of a transient that dies within a few steps
        return min(0.5 * self.engine_inertia / self.clutch.damping(), self.source.time_scale())

    def next_event(self, t: float) -> float:
        return self.source.next_event(t)

    def next_sample(self, t: float) -> float:
        return (self.shift.sample_at(t) + 1) * self.shift.sample_time

    def decide(self, t: float, x: State, shaft: Shaft, bus: Bus, discrete: Discrete) -> tuple[Discrete, bool]:
        before = Gear(*discrete)
        after = self.shift.select(t, shaft.speed, self.ratios, bus.throttle, before)
        return after, after.gear != before.gear

    def observe(self, t: float, x: State, shaft: Shaft, bus: Bus, discrete: Discrete) -> dict[str, float]:
        gear = Gear(*discrete)
        number, closure, rate = self.shift.closure(t, gear)
        own, crank, pedals = self._engine(t, x, bus, closure, rate)
        turbine = self.ratios[number - 1] * shaft.speed
        return {"engine.speed": x[0], "engine.torque": self.source.value(t, own, crank, pedals),
                "gearbox.gear": float(gear.gear), "clutch.torque": self.clutch.value(x[0], turbine, closure),
                "clutch.slip": x[0] - turbine, **self.source.observe(t, own, crank, pedals, ())}
