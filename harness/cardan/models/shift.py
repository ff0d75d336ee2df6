"""When a gearbox shifts, and how its clutch opens and closes around the change of ratio."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

from cardan.models.parameters import ParameterError, check_ranges, quantity
from cardan.models.smooth import rise


class Gear(NamedTuple):
    """Discrete state of a gearbox.

    Attributes
    ----------
    gear, before : int
        Selected gear and the one before it, from 1.
    since : float
        Time of the last selection, s (-inf: never).
    sample : int
        Number of the next decision; decision n is due at n * sample_time.
    """

    gear: int
    before: int
    since: float
    sample: int


@dataclass(frozen=True, eq=False)
class ShiftSchedule:
    """Thresholds on the gearbox input speed in the present gear, linear in throttle, with hysteresis.

    A decision is taken every `sample_time` at fixed times. A selected gear opens the clutch within `open_time`,
    changes the ratio at the moment the clutch transmits nothing, and closes it within `close_time`; both ramps are
    quintics, so the torque and its slope stay continuous. No further decision for `dwell` after a selection.
    """

    up: float = quantity("rad/s", "shift up above this speed at throttle 0", above=0.0)
    up_full: float = quantity("rad/s", "shift up above this speed at throttle 1", above=0.0)
    down: float = quantity("rad/s", "shift down below this speed at throttle 0", minimum=0.0)
    down_full: float = quantity("rad/s", "shift down below this speed at throttle 1", minimum=0.0)
    sample_time: float = quantity("s", "time between decisions", 0.1, above=0.0)
    dwell: float = quantity("s", "shortest time between selections", 1.0, minimum=0.0)
    open_time: float = quantity("s", "time for opening the clutch", 0.2, above=0.0)
    close_time: float = quantity("s", "time for closing the clutch", 0.4, above=0.0)

    def __post_init__(self) -> None:
        check_ranges(self)

    def check(self, ratios: tuple[float, ...]) -> None:
        """Raise `ParameterError` where the thresholds leave no hysteresis between two gears."""
        for low, high in zip(ratios, ratios[1:]):
            for up, down, key in ((self.up, self.down, "down"), (self.up_full, self.down_full, "down_full")):
                limit = up * high / low
                if down >= limit:
                    raise ParameterError(f"shift.{key}", down, f"no hysteresis between ratios {low:g} and {high:g}: "
                                         "a shift up would be followed by one down", f"< {limit:g} rad/s")

    def sample_at(self, t: float) -> int:
        """Return the number of the last decision due at or before t."""
        return math.floor(t / self.sample_time + 1e-9)

    def select(self, t: float, speed: float, ratios: tuple[float, ...], throttle: float, now: Gear) -> Gear:
        """Take the decision at time t from the gearbox output speed (rad/s) and the throttle."""
        sample = self.sample_at(t)
        if sample < now.sample:
            return now
        now = now._replace(sample=sample + 1)
        if t - now.since < max(self.dwell, self.open_time + self.close_time):
            return now
        turbine = speed * ratios[now.gear - 1]
        if now.gear < len(ratios) and turbine > self.up + (self.up_full - self.up) * throttle:
            return now._replace(gear=now.gear + 1, before=now.gear, since=t)
        if now.gear > 1 and turbine < self.down + (self.down_full - self.down) * throttle:
            return now._replace(gear=now.gear - 1, before=now.gear, since=t)
        return now

    def closure(self, t: float, now: Gear) -> tuple[int, float, float]:
        """Return the gear whose ratio acts, the closure of the clutch (0..1) and its rate (1/s)."""
        since = t - now.since
        if since >= self.open_time + self.close_time:
            return now.gear, 1.0, 0.0
        if since < self.open_time:
            share, slope = rise(since / self.open_time)
            return now.before, 1.0 - share, -slope / self.open_time
        share, slope = rise((since - self.open_time) / self.close_time)
        return now.gear, share, slope / self.close_time
