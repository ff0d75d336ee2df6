"""A prescribed speed over time: constant, or one ramp."""

from __future__ import annotations

import math

from cardan.models.smooth import rise


class SpeedProgram:
    """Speed w(t): `first` until `start`, then to `last` within `duration`.

    Parameters
    ----------
    first, last : float
        rad/s.
    start, duration : float
        s; a duration of 0 means constant `first`.
    smooth : bool
        True: quintic with continuous acceleration; False: straight, with two corners.
    """

    def __init__(self, first: float, last: float, start: float, duration: float, smooth: bool) -> None:
        self.first, self.change, self.start, self.duration = first, last - first, start, duration
        self.smooth = smooth
        self.corners = () if smooth or duration == 0.0 or last == first else (start, start + duration)

    def __call__(self, t: float) -> tuple[float, float, float]:
        """Return speed, its first and its second time derivative (rad/s, rad/s2, rad/s3), from the right."""
        if self.duration == 0.0 or t < self.start:
            return self.first, 0.0, 0.0
        if t >= self.start + self.duration:
            return self.first + self.change, 0.0, 0.0
        s = (t - self.start) / self.duration
        if not self.smooth:
            return self.first + self.change * s, self.change / self.duration, 0.0
        share, slope = rise(s)
        bend = 60.0 * s * (1.0 - s) * (1.0 - 2.0 * s)
        return (self.first + self.change * share, self.change * slope / self.duration,
                self.change * bend / (self.duration * self.duration))

    def next_corner(self, t: float) -> float:
        """Return the first corner after t, s (inf: none)."""
        return next((corner for corner in self.corners if corner > t), math.inf)
