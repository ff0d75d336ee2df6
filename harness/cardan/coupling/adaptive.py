"""Communication steps as long as the torques allow."""

from __future__ import annotations

from typing import NamedTuple

from cardan.coupling.hermite import Hermite5
from cardan.coupling.master import Master

# Share of the kinetic energy that the interface may lose or make in a second, over the tolerance.
PER_SECOND = 0.3
SAFETY = 0.8
LARGEST_GROWTH = 2.0  # the quintic is not stretched further
LARGEST_CUT = 0.2
FIRST = 1 / 64  # of the step before, after a jump
FLOOR = 1e-6  # shortest step, as a part of the scene's communication step
STILL = 1e-2  # kinetic energy is taken as at least this part of its largest so far, and as the work of both torques
SWING = 1e-2  # over this angle, rad: a start from rest has a scale too


class Steps(NamedTuple):
    """What an adaptive run has done: accepted and rejected steps, and steps at the floor with their error above 1."""

    accepted: int
    rejected: int
    at_floor: int


class Adaptive(Hermite5):
    """``hermite5`` with steps that follow the error.

    The FMU's continuation of the torques is the predictor, the models' torques at the end of the step are the
    corrector; the energy of their difference over the step is the error, compared with the kinetic energy. A PI
    controller finds the next step from it; a step whose error is too large is rolled back and done again, shorter. No
    step is longer than the scene's communication step, whose points are all hit, nor shorter than 1e-6 of it. After a
    jump the step begins short and doubles.

    Order 6, between 2 and 6 while the history grows after a jump. Cost per step: one FMU step, one save and one free of
    its state, one evaluation of the models; a rejected step costs the same and a restore.

    Source: Sadjina, Kyllingstad, Skjong and Pedersen, Engineering with Computers 33 (2017), for the error; Gustafsson's
    PI control as in Hairer and Wanner, Solving Ordinary Differential Equations II, section IV.2.

    Parameters
    ----------
    tolerance : float
        Wanted relative accuracy of the motion.
    shortest : float or None
        Floor of the step, s; None for 1e-6 of the scene's communication step. A step at the floor is taken whatever its
        error, and counted.
    """

    name = "adaptive"
    rolls_back = True
    energetic = True

    def __init__(self, tolerance: float = 1e-6, shortest: float | None = None) -> None:
        super().__init__()
        self.tolerance, self.shortest = tolerance, shortest
        self.steps = Steps(0, 0, 0)
        self._h = 0.0
        self._last_error = 1.0
        self._most = 0.0
        self._points = 0

    def advance(self, master: Master, t: float, end: float) -> None:
        """Go from one communication point of the scene to the next, in as many steps as the error asks for."""
        longest = end - t
        if self._h == 0.0:
            self._h = longest
        floor = FLOOR * longest if self.shortest is None else min(self.shortest, longest)
        accepted, rejected, at_floor = self.steps
        while True:
            now = master.time if accepted else t
            stop = min(end, master.event) if master.event < end - master.snap else end
            left = stop - now
            restart = master.restart
            if restart:
                self._h = max(min(self._h, left) * FIRST, floor)
                self._points = 0
            h = min(self._h, left)
            if h < left < 2.0 * h:
                h = 0.5 * left
            target = stop if h >= left else now + h
            point = master.save()
            bent = self._bent
            self.go(master, now, target)
            error = self._error(master, target - now)
            if error > 1.0 and h > 1.000001 * floor:
                master.restore(point)
                master.forget(point)
                master.restart, self._bent = restart, bent
                rejected += 1
                self._h = max(h * max(LARGEST_CUT, SAFETY * error ** (-1.0 / self._power())), floor)
                continue
            master.forget(point)
            accepted += 1
            at_floor += error > 1.0
            self._points = min(self._points + 1, 3)
            self._grow(h, error, h < self._h)
            self._h = max(self._h, floor)
            if target == end:
                break
        self.steps = Steps(accepted, rejected, at_floor)

    def _power(self) -> float:
        """Power of the step in the error per unit time: 2, 4 or 6 with the points of the history, and one."""
        return (2.0, 4.0, 6.0, 6.0)[self._points]

    def _error(self, master: Master, h: float) -> float:
        energy = master.kinetic_energy
        self._most = max(self._most, energy)
        engine, load = master.torques
        scale = max(energy, STILL * self._most, SWING * (abs(engine[0]) + abs(load[0])), 1e-12)
        return master.energy.step / (PER_SECOND * self.tolerance * h * scale)

    def _grow(self, h: float, error: float, shortened: bool) -> None:
        power = self._power()
        error = max(error, 1e-8)
        factor = SAFETY * error ** (-0.7 / power) * self._last_error ** (0.3 / power)
        factor = min(LARGEST_GROWTH, max(LARGEST_CUT, factor))
        self._last_error = error
        grown = h * factor
        if not shortened or grown > self._h or error > 0.5:
            self._h = grown
