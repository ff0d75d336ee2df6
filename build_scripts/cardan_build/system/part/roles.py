"""What the parts of a scene compute: explicit states, outputs as functions of states and inputs.

Between two communication points the inputs are held, the shaft turns on at the speed of the start, and the pedals
move with their rates. Outputs hold for the present inputs: an importer that sets inputs and then reads outputs gets
the torque at that speed, as ``cardan simulate`` with ``coupling = "held"`` does.
"""

from __future__ import annotations

from collections.abc import Sequence
from types import SimpleNamespace
from typing import Any, ClassVar

from cardan.models.base import INFINITY, Bus, Discrete, Model, Shaft
from cardan.models.constant import ConstantTorque
from cardan.models.surroundings import Surroundings

Inputs = dict[str, float]
Moving = tuple[list[float], Discrete]  # continuous states, discrete state
SNAP = 1e-9  # of the step: a jump this close to a communication point is at it


class Role:
    """A part without states.

    Attributes
    ----------
    states : tuple of str
        Continuous states with units.
    """

    states: tuple[str, ...] = ()

    def start(self, t: float, inputs: Inputs) -> Moving:
        """Return the initial states for the inputs at the start time, s."""
        return [], ()

    def settle(self, t: float, h: float, moving: Moving, inputs: Inputs) -> Moving:
        """Return the states after the decisions that are due at time t, s, h being the length of the step to it, s."""
        return moving

    def advance(self, t: float, h: float, moving: Moving, inputs: Inputs) -> Moving:
        """Return the states at t + h for inputs held from t on."""
        return moving

    def outputs(self, t: float, h: float, moving: Moving, inputs: Inputs) -> dict[str, float]:
        """Return the outputs at time t by name, decisions taken."""
        raise NotImplementedError

    def next_sample(self, t: float) -> float:
        """Return the first time after t, s, at which `settle` may change something (inf: never)."""
        return INFINITY

    def discrete(self, values: Sequence[Any]) -> Discrete:
        """Return a discrete state from its values, as a stored state has them."""
        return tuple(values)


class Bending(Role):
    """Joint angles that move by themselves: value + rate s + acceleration s^2 / 2, s since the start of the run."""

    states = ("begin [s]",)

    def __init__(self, courses: Sequence[Sequence[Any]]) -> None:
        self.courses = courses

    def start(self, t: float, inputs: Inputs) -> Moving:
        return [t], ()

    def outputs(self, t: float, h: float, moving: Moving, inputs: Inputs) -> dict[str, float]:
        s = t - moving[0][0]
        found = {}
        for name, value, rate, acceleration in self.courses:
            found[name] = value + s * (rate + 0.5 * s * acceleration)
            found[name + ".der1"] = rate + s * acceleration
        return found


class Pedals:
    """A driver who is somewhere else: throttle and brake as they came, moving on with their rates."""

    states: tuple[str, ...] = ()
    signals: ClassVar[dict[str, str]] = {}

    def __init__(self, t: float, inputs: Inputs) -> None:
        self.t, self.inputs = t, inputs

    def fill(self, t: float, x: Any, shaft: Shaft, bus: Bus) -> list[float]:
        """Put throttle and brake at time t on the bus."""
        s, inputs = t - self.t, self.inputs
        bus.throttle_rate = inputs.get("driver.throttle.der1", 0.0)
        bus.throttle = inputs.get("driver.throttle", 0.0) + s * bus.throttle_rate
        bus.brake_rate = inputs.get("driver.brake.der1", 0.0)
        bus.brake = inputs.get("driver.brake", 0.0) + s * bus.brake_rate
        return []

    def time_scale(self) -> float:
        """Return no limit for sub-steps."""
        return INFINITY

    next_event = Model.next_event


class OnShaft(Role):
    """A model of ``cardan.models`` that acts on a shaft or, as a driver, looks at one.

    Parameters
    ----------
    model : Model
        Engine, load or driver.
    side : str
        ``engine``, ``load`` or ``driver``.
    step : float
        Longest sub-step of the whole scene's states, s: all parts take it, as they do in one process.
    pedals : bool
        Whether throttle and brake come from a driver.
    """

    def __init__(self, model: Any, side: str, step: float, pedals: bool) -> None:
        self.model, self.side, self.step, self.pedals = model, side, step, pedals
        self.states = model.states

    def _bus(self, t: float, discrete: Discrete, inputs: Inputs) -> Bus:
        bus = Bus(throttle=getattr(self.model, "throttle", 0.0), discrete=discrete)
        if self.pedals:
            Pedals(t, inputs).fill(t, (), Shaft(0.0, 0.0, 0.0), bus)
        return bus

    def moment(self, t: float, h: float) -> float:
        """Return t, or the time of a known jump that rounding has put just behind it."""
        event: float = self.model.next_event(t)
        while event <= t + SNAP * h:
            t, event = event, self.model.next_event(event)
        return t

    def start(self, t: float, inputs: Inputs) -> Moving:
        shaft = _shaft(inputs)
        discrete = self.model.start_discrete(t, shaft)
        return list(self.model.start(t, shaft, self._bus(t, discrete, inputs))), discrete

    def settle(self, t: float, h: float, moving: Moving, inputs: Inputs) -> Moving:
        x, discrete = moving
        bus = self._bus(t, discrete, inputs)
        return x, self.model.decide(self.moment(t, h), x, _shaft(inputs), bus, discrete)[0]

    def advance(self, t: float, h: float, moving: Moving, inputs: Inputs) -> Moving:
        x, discrete = moving
        if not x:
            return moving
        members: dict[str, Any] = {"engine": _NOTHING, "load": _NOTHING, "driver": None}
        if self.pedals:
            members["driver"] = Pedals(t, inputs)
        members[self.side] = self.model
        world = Surroundings(SimpleNamespace(**members))
        world.x, world.bus.discrete, world.step = list(x), discrete, min(world.step, self.step)
        angle, speed, acceleration = _shaft(inputs)

        def motion(s: float) -> Shaft:
            return Shaft(angle + speed * s, speed, acceleration)

        world.advance(t, h, motion, motion)
        return world.x, discrete

    def outputs(self, t: float, h: float, moving: Moving, inputs: Inputs) -> dict[str, float]:
        x, discrete = moving
        model, shaft, bus = self.model, _shaft(inputs), self._bus(t, discrete, inputs)
        moment = self.moment(t, h)
        found: dict[str, float] = {}
        if self.side == "driver":
            model.fill(moment, x, shaft, bus)
            found = {"driver.throttle.der1": bus.throttle_rate, "driver.brake.der1": bus.brake_rate}
        elif model.drive == 1:
            value, rate, bend = model.command(moment)
            found = {"shaft.speed_command": value, "shaft.speed_command.der1": rate, "shaft.speed_command.der2": bend}
        else:
            found = {"shaft.torque": model.torque(moment, x, shaft, bus).value}
        found.update(model.observe(t, x, shaft, bus, discrete))
        return found

    def next_sample(self, t: float) -> float:
        sample: float = self.model.next_sample(t)
        return sample

    def discrete(self, values: Sequence[Any]) -> Discrete:
        if not values:  # before the start
            return ()
        kind = type(self.model.start_discrete(0.0, Shaft(0.0, 0.0, 0.0)))
        return kind(*values) if hasattr(kind, "_fields") else tuple(values)


_NOTHING = ConstantTorque(torque_=0.0)


def _shaft(inputs: Inputs) -> Shaft:
    return Shaft(inputs.get("shaft.angle", 0.0), inputs.get("shaft.speed", 0.0), 0.0)
