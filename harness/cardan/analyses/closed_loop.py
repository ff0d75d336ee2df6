"""An FMU stepped in closed loop with its engine and load, accurately enough to measure small signals.

Between communication points the FMU takes torques as lines. What is sent is the best line (least squares) through the
torque over the step: for the excitation exactly, for engine and load through the cubic of their values and slopes at
both ends of the step, which is done once for the end values and once again (state saved and restored) with the line.
The part that follows the shaft speed is left to the FMU (``by_speed``). Both give fourth order in the step.
"""

from __future__ import annotations

import cmath
import os
from types import SimpleNamespace, TracebackType
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from cardan.analyses.laws import LATE
from cardan.analyses.plant import KERNEL_STATES, TWIST, W1, WY, P, Plant
from cardan.analyses.signals import output_units
from cardan.coupling.motion import interpolated
from cardan.errors import FmuError
from cardan.instance import Instance
from cardan.models.base import Shaft, Torque
from cardan.models.surroundings import Surroundings

Array = NDArray[np.float64]

TOLERANCE = 1e-12
SAME = 1e-12  # a rest that changes less over a step needs no second step


class Sine(NamedTuple):
    """Excitation ``amplitude cos(omega t)`` on one input: 0 drive torque or acceleration, 1 load torque."""

    place: int
    amplitude: float
    omega: float

    def line(self, t: float, h: float) -> tuple[float, float]:
        """Return value at the start and slope of the best line over a step.

        The lines of all steps together have a part cos(omega t) that is smaller than 1 by about (omega h)^4 / 720.
        """
        mean, moment = _moments(1j * self.omega * h)
        turned = cmath.exp(1j * self.omega * t)
        rise = 12.0 * (turned * moment).real
        return self.amplitude * ((turned * mean).real - 0.5 * rise), self.amplitude * rise / h

    def value(self, t: float) -> float:
        """Return the excitation itself."""
        return self.amplitude * cmath.exp(1j * self.omega * t).real


def _moments(z: complex) -> tuple[complex, complex]:
    """Return the integrals over u from 0 to 1 of e^(z u) and of e^(z u) (u - 1/2)."""
    if abs(z) < 0.5:
        mean = moment = 0.0 + 0.0j
        term = 1.0 + 0.0j
        for n in range(18):
            mean += term / (n + 1)
            moment += term * (1.0 / (n + 2) - 0.5 / (n + 1))
            term *= z / (n + 1)
        return mean, moment
    grown = cmath.exp(z)
    mean = (grown - 1.0) / z
    return mean, grown / z - mean / z - 0.5 * mean


class ClosedLoop:
    """One FMU with the engine and load of a plant.

    Use as a context manager.

    Parameters
    ----------
    plant : Plant
        Its values and models are taken.
    fmu : path-like
        An FMU of this interface.
    added : float
        Torque added to the engine's, N.m.
    """

    def __init__(self, plant: Plant, fmu: str | os.PathLike[str], added: float) -> None:
        self.plant, self.added = plant, added
        around = plant.surrounding
        self.models = Surroundings(SimpleNamespace(engine=around.engine, load=around.load, driver=None))
        self.models.bus.discrete = around.bus.discrete
        self.instance = Instance(fmu)
        try:
            self._open()
        except BaseException:
            self.instance.close()
            raise

    def __enter__(self) -> ClosedLoop:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None,
                 trace: TracebackType | None) -> None:
        self.instance.close()

    def _open(self) -> None:
        fmu = self.instance
        about = fmu.description
        if not about.can_get_set_state:
            raise FmuError(f"{about.path.name} cannot save and restore its state, which measuring needs")
        sent = ["input.torque", "input.torque.der1", "input.torque.by_speed", "output.torque", "output.torque.der1",
                "output.torque.by_speed", "input.speed_command", "input.speed_command.der1", "input.speed_command.der2"]
        first = ["initial.angle", "initial.speed", "initial.twist", "initial.twist_rate"]
        missing = [n for n in (*sent, *first, *output_units(), "shaft.speed_a") if n not in about.variables]
        if missing:
            raise FmuError(f"{about.path.name} is no FMU of this interface: it lacks {', '.join(missing)}")
        for name, value in self.plant.values.items():
            if name in about.variables and name not in sent and name not in first:
                fmu.set(name, int(value) if about[name].type in ("Integer", "Enumeration") else value)
        fmu.setup(0.0, None, TOLERANCE)
        self._sent, self._first = fmu.plan(sent), fmu.plan(first)
        self._speed_a = fmu.plan(["shaft.speed_a"])
        self._outputs = fmu.plan(list(output_units()))
        self._open_state = fmu.get_state()

    def run(self, state: Array, own: Array, h: float, count: int, sine: Sine | None, through: Array) -> Array:
        """Step from a state and return the outputs at the ends of all steps, shape (count, 15).

        Parameters
        ----------
        state, own : ndarray
            The four kernel states, own states of the models.
        h : float
            Step, s.
        sine : Sine or None
            Excitation on top of the models' torques.
        through : ndarray, shape (n, 15, 2)
            Direct effect of both torques on the outputs at the ends of the steps of one period, for the difference
            of a torque and its line at a communication point.
        """
        self._begin(state, own, sine)
        found = np.empty((count, len(self._outputs.values)))
        shafts = self._look()
        for i in range(count):
            shafts, rest = self._step(i * h, h, shafts, sine)
            found[i] = self._outputs.values
            found[i] += through[(i + 1) % len(through)] @ rest
        return found

    def final(self) -> Array:
        """Return the four kernel states after the last step of `run`."""
        values = self._outputs.values
        names = list(output_units())
        return np.array([values[names.index(name)] for name in KERNEL_STATES])

    def _begin(self, state: Array, own: Array, sine: Sine | None) -> None:
        fmu = self.instance
        fmu.set_state(self._open_state)
        first = self._first.values
        first[0], first[1], first[2], first[3] = state[P], state[W1], state[TWIST], 0.0
        self._sent.values[:] = type(self._sent.values)("d", [0.0] * 9)
        self._speed = float(state[W1])
        self._sent.values[6] = self._speed
        self._sent.write()
        self._first.write()
        if not self.plant.rigid:
            first[3] = self._speed_a.read()[0] - state[WY]
            self._first.write()
        self.models.x = [float(v) for v in own]
        shafts = self._look()
        drive, load = self._torques(*shafts)
        extra = sine.value(0.0) if sine is not None else 0.0
        self._sent.values[0] = drive.value + (extra if sine is not None and sine.place == 0 else 0.0)
        self._sent.values[3] = load.value + (extra if sine is not None and sine.place == 1 else 0.0)
        self._sent.write()
        fmu.initialize()

    def _look(self) -> tuple[Shaft, Shaft]:
        v = self._outputs.read()
        return Shaft(v[0], v[1], v[2]), Shaft(v[4], v[5], v[6])

    def _torques(self, shaft_in: Shaft, shaft_out: Shaft) -> tuple[Torque, Torque]:
        drive, load = self.models.torques(LATE, shaft_in, shaft_out)
        return Torque(drive.value + self.added, drive.rate, drive.by_speed), load

    def _step(self, t: float, h: float, shafts: tuple[Shaft, Shaft], sine: Sine | None) -> tuple[tuple[Shaft, Shaft],
                                                                                                Array]:
        """Do one step; return the shafts at its end and how far both torques are from their lines there."""
        fmu = self.instance
        begin = self._torques(*shafts)
        speeds = shafts[0].speed, shafts[1].speed
        rest = [u.value - u.by_speed * w for u, w in zip(begin, speeds)]
        lines = [(r, u.rate) for r, u in zip(rest, begin)]
        saved = fmu.get_state()
        x = list(self.models.x)
        for attempt in range(2):
            self._send(t, h, lines, begin, speeds, sine)
            fmu.step(t, h)
            end = self._look()
            if x:
                self.models.x = list(x)
                self.models.advance(LATE, h, interpolated(shafts[0], end[0], h), interpolated(shafts[1], end[1], h))
            after = self._torques(*end)
            ends = [u.value - b.by_speed * s.speed for u, b, s in zip(after, begin, end)]
            slopes = [u.rate + (u.by_speed - b.by_speed) * s.acceleration for u, b, s in zip(after, begin, end)]
            if attempt == 1 or all(abs(e - r) + h * (abs(m) + abs(b.rate)) <= SAME * max(1.0, abs(u.value))
                                   for e, r, m, b, u in zip(ends, rest, slopes, begin, after)):
                break
            lines = [_best_line(r, b.rate, e, m, h) for r, b, e, m in zip(rest, begin, ends, slopes)]
            fmu.set_state(saved)
        fmu.free_state(saved)
        gap = np.array([e - (line[0] + h * line[1]) for e, line in zip(ends, lines)])
        if sine is not None:
            value, slope = sine.line(t, h)
            gap[sine.place] += sine.value(t + h) - (value + h * slope)
        return end, gap

    def _send(self, t: float, h: float, lines: list[tuple[float, float]], torques: tuple[Torque, Torque],
              speeds: tuple[float, float], sine: Sine | None) -> None:
        values = self._sent.values
        for side in range(2):
            start, slope = lines[side]
            if sine is not None and sine.place == side and not (side == 0 and self.plant.driven):
                more, steeper = sine.line(t, h)
                start, slope = start + more, slope + steeper
            k = torques[side].by_speed
            values[3 * side], values[3 * side + 1], values[3 * side + 2] = start + k * speeds[side], slope, k
        if self.plant.driven:
            values[6], values[7], values[8] = speeds[0], 0.0, 0.0
            if sine is not None and sine.place == 0:
                values[7], values[8] = sine.line(t, h)
        self._sent.write()


def _best_line(r0: float, m0: float, r1: float, m1: float, h: float) -> tuple[float, float]:
    """Return value at the start and slope of the least-squares line through the cubic with these ends."""
    mean = 0.5 * (r0 + r1) + h * (m0 - m1) / 12.0
    rise = 1.2 * (r1 - r0) - 0.1 * h * (m0 + m1)
    return mean - 0.5 * rise, rise / h
