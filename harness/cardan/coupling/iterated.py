"""Predict, step, roll back, correct."""

from __future__ import annotations

from cardan.coupling.base import Scheme, Torques
from cardan.coupling.hermite import START_UP
from cardan.coupling.master import Master
from cardan.coupling.motion import chord
from cardan.models.base import Shaft, Torque

# The last part of a corrected step is done with the end's own torque: what the FMU puts out there belongs to it.
CLOSING = 2.0**-10


class Iterated(Scheme):
    """Each step is done twice or more: with extrapolated torques, and again with interpolated ones.

    The torque over the step is the cubic through values and slopes at both ends. The FMU's inputs take a line, so it
    gets the line that is nearest to the cubic in the mean square: their difference is orthogonal to every line and
    reaches the motion at the end of the step only with the fifth power of its length. With the derivative by speed
    given, the FMU adds ``K w(s)`` itself.

    Order 4. Cost per step: `sweeps` + 1 FMU steps and `sweeps` short ones, one save and `sweeps` restores of the FMU's
    state, `sweeps` + 2 evaluations of the models.

    Source: docs/NUMERICS.md, "Coupling engine and load outside the FMU"; the projected torque is as accurate at the
    end as collocation is, Hairer, Norsett and Wanner, Solving Ordinary Differential Equations I, section II.7.

    Parameters
    ----------
    sweeps : int
        Most corrections per step, at least 1.
    tolerance : float
        Corrections end where the torques at the end of the step change by less than this, relative; 0 does all.
    """

    name = "iterated"
    order = 4
    slopes = True
    degree = 1
    splits = True
    accelerates = True
    rolls_back = True
    listens = True
    share = 1 / 5

    def __init__(self, sweeps: int = 1, tolerance: float = 0.0) -> None:
        self.sweeps, self.tolerance = sweeps, tolerance

    def step(self, master: Master, t: float, end: float) -> None:
        """Do one communication step from t to end, s; in short steps after the start and after a jump.

        The order does not need them, but a steep load whose slope is not yet known at rest does.
        """
        if master.restart:
            h, done = end - t, 0.0
            for part in START_UP[:-1]:
                done += part
                self._correct(master, master.time, t + done * h)
        self._correct(master, master.time, end)

    def _correct(self, master: Master, t: float, end: float) -> None:
        h = end - t
        point = master.save()
        try:
            first = point.torques, point.motion
            self._go(master, t, end)
            found = master.torques_before(end)
            for _ in range(self.sweeps):
                last = found, (master.shaft_in, master.shaft_out)
                master.restore(point)
                master.put((_line(h, 0, first, last), _line(h, 1, first, last)))
                near = end - CLOSING * h
                self._go(master, t, near)
                master.put((_back(CLOSING * h, 0, last), _back(CLOSING * h, 1, last)))
                self._go(master, near, end)
                found = master.torques_before(end)
                if _change(last[0], found) <= self.tolerance:
                    break
        finally:
            master.forget(point)
        master.send(end)

    def _go(self, master: Master, t: float, end: float) -> None:
        before_in, before_out = master.shaft_in, master.shaft_out
        master.step(t, end)
        if master.moving:
            h = end - t
            master.move_models(t, end, chord(before_in, master.shaft_in, h), chord(before_out, master.shaft_out, h))


End = tuple[Torques, tuple[Shaft, Shaft]]


def _line(h: float, side: int, first: End, last: End) -> Torque:
    """Line nearest to the cubic through a torque's values and slopes at both ends.

    Nearest in the mean square over the part of the step that is done with it. What is a line and a cubic is the rest
    T - K w with the derivative by speed K of the start.
    """
    (value0, rate0, slope), shaft0 = first[0][side], first[1][side]
    (value1, rate1, slope1), shaft1 = last[0][side], last[1][side]
    r0 = value0 - slope * shaft0[1]
    r1 = value1 - slope * shaft1[1]
    d0 = rate0
    d1 = rate1 + (slope1 - slope) * shaft1[2]
    # cubic r0 + d0 s + q s^2 + c s^3; over the length l, s^2 -> l s - l^2/6 and s^3 -> 9/10 l^2 s - l^3/5
    mean = (r1 - r0) / h
    q = (3.0 * mean - 2.0 * d0 - d1) / h
    c = (d0 + d1 - 2.0 * mean) / (h * h)
    length = h - CLOSING * h
    constant = r0 - length * length * (q / 6.0 + c * length / 5.0)
    rate = d0 + length * (q + 0.9 * c * length)
    return Torque(constant + slope * shaft0[1], rate, slope)


def _back(s: float, side: int, end: End) -> Torque:
    """Torque a short time `s` before the end."""
    value, rate, slope = end[0][side]
    return Torque(value - s * (rate + slope * end[1][side][2]), rate, slope)


def _change(before: Torques, after: Torques) -> float:
    """Largest relative change of the two torques."""
    return max(abs(a[0] - b[0]) / max(abs(a[0]), abs(b[0]), 1e-300) for a, b in zip(before, after))
