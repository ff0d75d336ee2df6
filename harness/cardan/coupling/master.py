"""The FMU and its surroundings at communication points, and the moves that schemes are made of."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from typing import Any, NamedTuple

from cardan.coupling.base import Scheme, Torques
from cardan.coupling.energy import EnergyMeter
from cardan.coupling.interface import ENERGY, POWERS, REACTION, courses, receiving, sending
from cardan.coupling.motion import Motion
from cardan.errors import FmuError, InputError
from cardan.instance import Instance, State
from cardan.models.base import Shaft
from cardan.models.surroundings import Saved, Surroundings

SNAP = 1e-9  # of a communication step: a jump this close to a communication point is at it

Settings = Mapping[str, float | int | bool]
Command = tuple[float, float, float]


class Checkpoint(NamedTuple):
    """Everything that `Master.restore` needs to go back to a communication point."""

    time: float
    fmu: State
    models: Saved
    motion: tuple[Shaft, Shaft]
    torques: Torques
    command: Command
    event: float
    energy: Any


class Master:
    """Owns one run: instance, models, and what was exchanged last.

    Parameters
    ----------
    instance : Instance
        The FMU.
    surroundings : Surroundings
        Driver, engine and load.
    scheme : Scheme
        How they are coupled.
    step : float
        Longest communication step, s.
    settings : mapping, optional
        Start values of the FMU by name, SI; joint angles with rates are moved along.
    outputs : iterable of str, optional
        Further Real variables of the FMU to have at hand at every point.

    Attributes
    ----------
    shaft_in, shaft_out : Shaft
        Motion of the ends at the present point; accelerations are NaN where nobody needs them.
    torques : tuple of Torque
        Torques of engine and load sent for the present point.
    inputs, outputs : Plan
        What is sent and what is read at each point, with the present values.
    moving : bool
        Whether the models have states of their own.
    event, snap : float
        Next known jump of the models, s; closer than this to a point it counts as being there, s.
    restart : bool
        Whether the torques' law has jumped at the present point.
    energy : EnergyMeter
        Interface energy so far.
    steps : int
        FMU steps done.

    Raises
    ------
    FmuError
        If the FMU lacks what the scheme needs.
    InputError
        If a setting or an output does not exist, or contradicts the engine.
    """

    def __init__(self, instance: Instance, surroundings: Surroundings, scheme: Scheme, step: float,
                 settings: Settings | None = None, outputs: Iterable[str] = ()) -> None:
        if scheme.rolls_back and not instance.description.can_get_set_state:
            raise FmuError(f"coupling = {scheme.name!r} needs an FMU that saves and restores its state, which"
                           f" {instance.description.path.name} does not; coupling = 'slope' needs none")
        self.instance, self.surroundings, self.scheme = instance, surroundings, scheme
        self.snap = SNAP * step
        self._drive, self._slopes = surroundings.drive, scheme.slopes
        drive = self._drive
        if settings and settings.get("model.drive", drive) != drive:
            raise InputError(f"model.drive = {settings['model.drive']} contradicts the engine, which needs {drive};"
                             " leave it out")
        # An FMU without these variables holds torques, which is what their zeros say.
        own = {"hold.degree": scheme.degree, "model.drive": drive}
        known = instance.description.variables
        self.settings = {name: value for name, value in own.items() if value or name in known} | dict(settings or {})
        self._courses = courses(self.settings)
        self.inputs = sending(instance, drive, scheme.slopes, self._courses)
        self.moving = bool(surroundings.states)
        self._accelerated = scheme.accelerates or (self.moving and scheme.interpolates)
        wanted = [*((ENERGY,) if scheme.energetic else ()), *outputs]
        self.outputs = receiving(instance, self._accelerated, scheme.listens and not drive, drive,
                                 (name for name in wanted if name not in self.inputs.names))
        names = self.outputs.names
        self._powers = names.index(POWERS[0]) if scheme.listens and not drive else 0
        self._energy = names.index(ENERGY) if scheme.energetic else 0
        self._shapes = type(scheme).sent is not Scheme.sent
        self.energy = EnergyMeter()
        self.restart = True
        self.steps = 0
        self.time = 0.0
        self._command: Command = (0.0, 0.0, 0.0)

    def begin(self, start: float, stop: float, tolerance: float | None) -> None:
        """Initialize FMU and models at the start time: inputs for it are sent, outputs read.

        Parameters
        ----------
        start, stop : float
            Times of the run, s.
        tolerance : float or None
            Relative tolerance for the FMU.
        """
        instance, models = self.instance, self.surroundings
        for name, value in self.settings.items():
            instance.set(name, value)
        if models.drive:  # the initial speed is the prescribed one
            instance.set("input.speed_command", models.speed_command(start)[0])
        instance.setup(start, stop, tolerance)
        self.time = self._start = start
        self.event = models.next_event(start)
        self._deciding = models.next_sample(start) < math.inf
        self._look()
        models.start(start, self.shaft_in, self.shaft_out)
        self.torques = models.torques(start, self.shaft_in, self.shaft_out)
        self._write(start, start)
        instance.initialize()
        self._look()
        self.energy.begin(self.shaft_in.speed, self.shaft_out.speed)

    def step(self, t: float, end: float) -> None:
        """Let the FMU do the step from t to end, s, and read its outputs."""
        self.instance.step(t, end - t)
        self.steps += 1
        self._look()

    def move_models(self, t: float, end: float, motion_in: Motion, motion_out: Motion) -> None:
        """Let the models' own states follow given shaft motions from t to end, s."""
        self.surroundings.advance(t, end - t, motion_in, motion_out)

    def send(self, t: float) -> None:
        """Take the models' decisions and torques at time t, s, count the energy of the step, set the inputs."""
        models, shaft_in, shaft_out = self.surroundings, self.shaft_in, self.shaft_out
        if self._deciding or self.event <= t + self.snap:
            moment, before = self._pass_jumps(t)
            torques = models.torques(moment, shaft_in, shaft_out)
        else:
            moment, before = t, None
            self.restart = False
            torques = models.torques(t, shaft_in, shaft_out)
        h = t - self.time
        received = None
        if self._powers:
            values, at = self.outputs.values, self._powers
            received = values[at], values[at + 1]
        self.energy.count(h, self.torques, before or torques, shaft_in[1], shaft_out[1], self._slopes,
                          self.scheme.share, received)
        if self._drive:
            self._count_drive(t, h)
        self.torques = self.scheme.sent(self, t, torques) if self._shapes else torques
        self.time = t
        self._write(t, moment)

    @property
    def kinetic_energy(self) -> float:
        """Kinetic energy of the driveline at the present point, J; for schemes that are `energetic`."""
        return self.outputs.values[self._energy]

    def put(self, torques: Torques) -> None:
        """Send torques for the present point without asking the models."""
        self.torques = torques
        self._write(self.time, self.time)

    def torques_before(self, t: float) -> Torques:
        """Return the models' torques at time t, s, before any jump there; nothing is decided or sent."""
        moment = math.nextafter(self.event, -math.inf) if self.event <= t + self.snap else t
        return self.surroundings.torques(moment, self.shaft_in, self.shaft_out)

    def _pass_jumps(self, t: float) -> tuple[float, Torques | None]:
        """Pass the jumps that are due at t; return when the models are to be asked, and the torques just before."""
        models, shaft_in, shaft_out = self.surroundings, self.shaft_in, self.shaft_out
        moment = t
        before = None  # the torques that belong to the step that ends here
        self.restart = False
        if self.event <= t + self.snap:
            before = models.torques(math.nextafter(self.event, -math.inf), shaft_in, shaft_out)
            while self.event <= t + self.snap:
                # A communication point can miss the time of the jump by rounding: the models see the jump done.
                moment = max(moment, self.event)
                self.event = models.next_event(moment)
            self.restart = True
        if self._deciding:
            discrete = models.discrete
            if models.decide(moment, shaft_in, shaft_out):
                self.restart = True
                if before is None:
                    decided, models.bus.discrete = models.discrete, discrete
                    before = models.torques(t, shaft_in, shaft_out)
                    models.bus.discrete = decided
        return moment, before

    def save(self) -> Checkpoint:
        """Return the present point, for `restore`; the FMU's part is freed with the instance or `forget`."""
        return Checkpoint(self.time, self.instance.get_state(), self.surroundings.save(),
                          (self.shaft_in, self.shaft_out), self.torques, self._command, self.event, self.energy.save())

    def restore(self, point: Checkpoint) -> None:
        """Go back to a saved point: FMU (with its inputs), models, energies."""
        self.instance.set_state(point.fmu)
        self.surroundings.restore(point.models)
        self.shaft_in, self.shaft_out = point.motion
        self.torques = point.torques
        self.time, self._command, self.event = point.time, point.command, point.event
        self.energy.restore(point.energy)
        self.outputs.read()
        self.inputs.read()

    def forget(self, point: Checkpoint) -> None:
        """Give back the memory of a saved point."""
        self.instance.free_state(point.fmu)

    def _look(self) -> None:
        values = self.outputs.read()
        acceleration_in, acceleration_out = (values[4], values[5]) if self._accelerated else (math.nan, math.nan)
        # tuple.__new__ instead of Shaft(...): half the time, and this runs twice per step
        self.shaft_in = tuple.__new__(Shaft, (values[0], values[1], acceleration_in))
        self.shaft_out = tuple.__new__(Shaft, (values[2], values[3], acceleration_out))

    def _write(self, t: float, moment: float) -> None:
        values = self.inputs.values
        torque_in, torque_out = self.torques
        at = 0
        if self._drive:
            self._command = values[0], values[1], values[2] = self.surroundings.speed_command(moment)
            at = 3
        if self._slopes:
            if at == 0:
                values[0], values[1], values[2] = torque_in
            values[3], values[4], values[5] = torque_out
            at = 6
        else:
            if at == 0:
                values[0] = torque_in[0]
                at = 1
            values[at] = torque_out[0]
            at += 1
        if self._courses:
            for course in self._courses:
                values[at], values[at + 1] = course.at(t - self._start)
                at += 2
        self.inputs.write()

    def _count_drive(self, t: float, h: float) -> None:
        speed, rate, acceleration = self._command
        wanted = self.surroundings.speed_command(math.nextafter(t, -math.inf))[0]
        gap = wanted - (speed + h * (rate + 0.5 * h * acceleration))
        self.energy.count_drive(h, self.outputs.values[self.outputs.names.index(REACTION)], self.shaft_in.speed, gap)
