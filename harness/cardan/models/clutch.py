"""Law of a slipping launch clutch whose capacity rises with engine speed."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar, NamedTuple

from cardan.models.parameters import ParameterError, check_ranges, quantity
from cardan.models.smooth import rise


class ClutchTorque(NamedTuple):
    """Torque (N.m) with its derivatives by engine and turbine speed (N.m.s/rad) and by closure (N.m)."""

    value: float
    by_engine: float
    by_turbine: float
    by_closure: float


_OPEN = ClutchTorque(0.0, 0.0, 0.0, 0.0)


@dataclass(frozen=True, eq=False)
class Clutch:
    """T = closure C(w) tanh((w_e - w_t) / slip_speed), w the faster of engine w_e and turbine w_t.

    The capacity C rises from 0 at `engage_speed` to `capacity` at `full_speed` (a centrifugal clutch, or a converter
    with slip control). Below `engage_speed` nothing is transmitted, so an idling engine cannot be stalled; a rolling
    vehicle can drive the engine, never stop it. The faster speed is ``(w_e + w_t + sqrt((w_e - w_t)^2 + q^2)) / 2``,
    rounded over q = 4 rad/s. A closed clutch transmits T at a slip of about ``slip_speed T / C``; its damping
    C / slip_speed at zero slip and the engine's inertia set the shortest time constant of the gearbox.
    """

    ROUNDING: ClassVar[float] = 4.0  # rad/s, q

    capacity: float = quantity("N.m", "largest torque, on the engine side", above=0.0)
    engage_speed: float = quantity("rad/s", "engine speed at which the capacity leaves zero", minimum=0.0)
    full_speed: float = quantity("rad/s", "engine speed at which the capacity is full", above=0.0)
    slip_speed: float = quantity("rad/s", "slip over which the torque builds up", 20.0, minimum=1e-6)

    def __post_init__(self) -> None:
        check_ranges(self)
        if self.full_speed <= self.engage_speed:
            raise ParameterError("full_speed", self.full_speed, "not above engage_speed",
                                 f"> {self.engage_speed:g} rad/s")

    def torque(self, engine: float, turbine: float, closure: float) -> ClutchTorque:
        """Return the torque at two speeds (rad/s); closure in [0, 1] opens the clutch for a shift."""
        slip = engine - turbine
        root = math.sqrt(slip * slip + self.ROUNDING * self.ROUNDING)
        width = self.full_speed - self.engage_speed
        share, slope = rise((0.5 * (engine + turbine + root) - self.engage_speed) / width)
        if share == 0.0:
            return _OPEN
        y = math.tanh(slip / self.slip_speed)
        by_slip = closure * self.capacity * share * (1.0 - y * y) / self.slip_speed
        by_faster = 0.5 * closure * self.capacity * slope / width * y
        return ClutchTorque(closure * self.capacity * share * y, by_slip + by_faster * (1.0 + slip / root),
                            by_faster * (1.0 - slip / root) - by_slip, self.capacity * share * y)

    def value(self, engine: float, turbine: float, closure: float) -> float:
        """Return the torque alone, N.m."""
        slip = engine - turbine
        faster = 0.5 * (engine + turbine + math.sqrt(slip * slip + self.ROUNDING * self.ROUNDING))
        share = (faster - self.engage_speed) / (self.full_speed - self.engage_speed)
        if share <= 0.0:
            return 0.0
        return closure * self.capacity * rise(share)[0] * math.tanh(slip / self.slip_speed)

    def damping(self) -> float:
        """Return the largest torque per slip, N.m.s/rad."""
        return self.capacity / self.slip_speed
