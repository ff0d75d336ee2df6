"""A driver who follows a speed schedule with throttle and brake."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import ClassVar

from cardan.models.base import Bus, Discrete, Model, Shaft, State, Torque
from cardan.models.curve import Curve
from cardan.models.parameters import ParameterError, choice, file, quantity, words
from cardan.models.series import read_columns
from cardan.models.smooth import clamp, positive, rise


@dataclass(frozen=True, eq=False)
class Driver(Model):
    """Speed PI with feed-forward, anti-windup and a foot of finite speed.

    With the schedule r(t), looked at `preview` ahead, and e = r - v::

        u  = gain e + i + feed_forward r' - hold_brake s     s = 1 at a scheduled standstill, 0 above hold_speed
        u' = clamp(u, -1, 1)
        i' = integral_gain (e + (u' - u) / gain) - s i integral_gain / gain
        p' = (u' - p) / pedal_lag

    The pedal state p gives the throttle max(p, 0) and the brake max(-p, 0), both rounded over `rounding`. The
    schedule is piecewise linear: its corners (seen `preview` early) are events.
    """

    kind: ClassVar[str] = "schedule"
    file: Path = file("CSV file with a header line")
    column: str = words("name of the speed column, m/s unless its heading has a unit: v [km/h]", "speed")
    time_column: str = words("name of the time column, s unless its heading has a unit; the first if empty", "")
    interpolation: str = choice(("linear", "pchip"), "of the schedule between its rows", "linear")
    gain: float = quantity("s/m", "pedal per speed error", 0.3, minimum=1e-6)
    integral_gain: float = quantity("1/m", "pedal per time integral of the speed error", 0.05, above=0.0)
    feed_forward: float = quantity("s2/m", "pedal per scheduled acceleration", 0.0, minimum=0.0)
    preview: float = quantity("s", "how far the driver looks ahead", 0.0, minimum=0.0, maximum=10.0)
    pedal_lag: float = quantity("s", "time constant of the foot", 0.15, minimum=1e-6)
    hold_brake: float = quantity("1", "brake at a scheduled standstill", 0.3, minimum=0.0, maximum=1.0)
    hold_speed: float = quantity("m/s", "scheduled speed at which that brake is gone", 0.5, minimum=1e-6)
    rounding: float = quantity("1", "pedal over which limits and zero are rounded", 0.02, minimum=1e-6, maximum=0.5)
    travel: float = 1.0  # m of road per rad of output shaft, from the load
    _curve: Curve = field(init=False, repr=False)
    _ahead: Curve = field(init=False, repr=False)  # the same, seen `preview` early

    def prepare(self) -> None:
        times, speeds = read_columns(self.file, self.time_column, self.column, "m/s")
        if min(speeds) < 0.0:
            raise ParameterError("column", self.column, f"has a negative speed ({min(speeds):g} m/s)", ">= 0 m/s")
        smooth = self.interpolation == "pchip"
        self.put(_curve=Curve(times, speeds, smooth), _ahead=Curve([t - self.preview for t in times], speeds, smooth),
                 states=("driver.integral [1]", "driver.pedal [1]"),
                 signals={"driver.target_speed": "m/s", "driver.throttle": "1", "driver.brake": "1"})

    def target(self, t: float) -> tuple[float, float]:
        """Return the scheduled speed (m/s) and its slope (m/s2) at time t, without preview."""
        return self._curve(t)

    def start(self, t: float, shaft: Shaft, bus: Bus) -> list[float]:
        share, _ = rise(self._ahead(t)[0] / self.hold_speed)
        return [0.0, -self.hold_brake * (1.0 - share)]

    def derivative(self, t: float, x: State, shaft: Shaft, bus: Bus) -> list[float]:
        reference, slope = self._ahead(t)
        standing = 1.0 - rise(reference / self.hold_speed)[0]
        error = reference - shaft.speed * self.travel
        wanted = self.gain * error + x[0] + self.feed_forward * slope - self.hold_brake * standing
        given, _ = clamp(wanted, -1.0, 1.0, self.rounding)
        return [self.integral_gain * (error + (given - wanted - standing * x[0]) / self.gain),
                (given - x[1]) / self.pedal_lag]

    def fill(self, t: float, x: State, shaft: Shaft, bus: Bus) -> list[float]:
        """Put throttle and brake with their rates on the bus; return the derivatives of the states."""
        derivative = self.derivative(t, x, shaft, bus)
        pedal, rate = x[1], derivative[1]
        throttle, slope = positive(pedal, self.rounding)
        bus.throttle, bus.throttle_rate = throttle, slope * rate
        brake, slope = positive(-pedal, self.rounding)
        bus.brake, bus.brake_rate = brake, -slope * rate
        return derivative

    def torque(self, t: float, x: State, shaft: Shaft, bus: Bus) -> Torque:
        raise NotImplementedError("a driver acts through the bus, not on a shaft")

    def time_scale(self) -> float:
        return min(0.3 * self.pedal_lag, 0.2 * self.gain / self.integral_gain)

    def next_event(self, t: float) -> float:
        return self._ahead.next_corner(t)

    def observe(self, t: float, x: State, shaft: Shaft, bus: Bus, discrete: Discrete) -> dict[str, float]:
        return {"driver.target_speed": self._curve(t)[0], "driver.throttle": bus.throttle, "driver.brake": bus.brake}
