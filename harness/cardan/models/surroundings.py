"""Driver, engine and load of a scene, as the one counterpart of the FMU that the master deals with."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

from cardan.models.base import INFINITY, Bus, Discrete, Model, Shaft, Torque
from cardan.models.driver import Driver
from cardan.models.stepping import MOST, REACH, controlled, equal_steps, too_many

Motion = Callable[[float], Shaft]  # s in [0, h] since the start of the step -> motion of a shaft end


class Saved(NamedTuple):
    """Everything that moves in the surroundings: continuous states and the discrete state."""

    x: tuple[float, ...]
    discrete: Discrete
    steps: tuple[float, ...]  # proposed sub-step and sizes of the states


class Surroundings:
    """Owns the states of driver, engine and load.

    Parameters
    ----------
    scenario
        Any object with the attributes ``engine``, ``load`` (`Model`) and ``driver`` (`Driver` or None).
    refine : int
        Divides the sub-steps of the models' own states further (accuracy studies).
    tolerance : float
        Relative error of one sub-step of the models' own states; 0 for sub-steps of fixed length.

    Attributes
    ----------
    x : list of float
        Continuous states: driver, engine, load.
    states : tuple of str
        Their names with units.
    discrete : tuple
        Discrete state of the engine.
    drive : int
        1 where the engine prescribes the input speed (`speed_command`), 0 where it gives a torque.
    signals : dict
        Names and units of what `observe` returns.
    """

    def __init__(self, scenario: Any, refine: int = 1, tolerance: float = 0.0) -> None:
        self.engine: Model = scenario.engine
        self.load: Model = scenario.load
        self.driver: Driver | None = scenario.driver
        driver_states = self.driver.states if self.driver is not None else ()
        self._a = len(driver_states)
        self._b = self._a + len(self.engine.states)
        self.states: tuple[str, ...] = (*driver_states, *self.engine.states, *self.load.states)
        self.x: list[float] = [0.0] * len(self.states)
        self.bus = Bus(throttle=getattr(self.engine, "throttle", 0.0))
        self.drive: int = self.engine.drive
        self._members: list[Model] = [m for m in (self.driver, self.engine, self.load) if m is not None]
        self.step: float = min(m.time_scale() for m in self._members) / refine
        self.tolerance = tolerance
        # of the scene: a coupling that cuts it into ever shorter ones would come round the limit of each
        self._whole: float = getattr(scenario, "communication_step", 0.0)
        self._scales = [1e-3] * len(self.states)
        self._next = self.step
        self.signals: dict[str, str] = {}
        for member in self._members:
            self.signals.update(member.signals)
        self._eventful = [m for m in self._members if type(m).next_event is not Model.next_event]
        self._deciding = type(self.engine).decide is not Model.decide

    @property
    def discrete(self) -> Discrete:
        """Discrete state of the engine."""
        return self.bus.discrete

    def start(self, t: float, shaft_in: Shaft, shaft_out: Shaft) -> None:
        """Set the initial states of all models."""
        x: list[float] = []
        if self.driver is not None:
            x += self.driver.start(t, shaft_out, self.bus)
            self.driver.fill(t, x, shaft_out, self.bus)
        x += self.engine.start(t, shaft_in, self.bus)
        x += self.load.start(t, shaft_out, self.bus)
        self.x = x
        self.bus.discrete = self.engine.start_discrete(t, shaft_in)

    def torques(self, t: float, shaft_in: Shaft, shaft_out: Shaft) -> tuple[Torque, Torque]:
        """Return the torques of engine and load at time t with the present states."""
        x, bus = self.x, self.bus
        if not x:
            return self.engine.torque(t, x, shaft_in, bus), self.load.torque(t, x, shaft_out, bus)
        a, b = self._a, self._b
        if self.driver is not None:
            self.driver.fill(t, x[:a], shaft_out, bus)
        return self.engine.torque(t, x[a:b], shaft_in, bus), self.load.torque(t, x[b:], shaft_out, bus)

    def speed_command(self, t: float) -> tuple[float, float, float]:
        """Return the prescribed input speed and its first two time derivatives (rad/s, rad/s2, rad/s3)."""
        return self.engine.command(t)

    def advance(self, t: float, h: float, motion_in: Motion, motion_out: Motion) -> None:
        """Integrate all own states from t to t + h along given shaft motions.

        Where a `tolerance` is set, with error control; else in equal steps no longer than the smallest time scale.

        Parameters
        ----------
        t, h : float
            Start and length of the step, s.
        motion_in, motion_out : callable
            s in [0, h] -> `Shaft`, motion of the input and of the output end.

        Raises
        ------
        ArithmeticError
            If the own states need more sub-steps than `cardan.models.stepping.MOST`.
        """
        if not self.x:
            return
        if self._whole > REACH * MOST * self.step:
            raise too_many(self.step, self._whole)

        def derivative(s: float, x: list[float]) -> list[float]:
            return self._derivative(t + s, x, motion_in(s), motion_out(s))

        if self.tolerance > 0.0:
            self.x, self._next = controlled(derivative, h, self.x, self._scales, self.tolerance, self._next)
        else:
            self.x = equal_steps(derivative, h, self.x, self.step)

    def _derivative(self, t: float, x: list[float], shaft_in: Shaft, shaft_out: Shaft) -> list[float]:
        a, b, bus = self._a, self._b, self.bus
        rates: list[float] = []
        if self.driver is not None:
            rates += self.driver.fill(t, x[:a], shaft_out, bus)
        if b > a:
            rates += self.engine.derivative(t, x[a:b], shaft_in, bus)
        if b < len(x):
            rates += self.load.derivative(t, x[b:], shaft_out, bus)
        return rates

    def save(self) -> Saved:
        """Return a copy of the states, for `restore`."""
        return Saved(tuple(self.x), self.bus.discrete, (self._next, *self._scales))

    def restore(self, saved: Saved) -> None:
        """Go back to saved states."""
        self.x = list(saved.x)
        self.bus.discrete = saved.discrete
        self._next, *self._scales = saved.steps

    def next_event(self, t: float) -> float:
        """Return the first known time after t where a torque or its slope jumps, s (inf: none)."""
        if not self._eventful:
            return INFINITY
        events: list[float] = [m.next_event(t) for m in self._eventful]
        return min(events)

    def next_sample(self, t: float) -> float:
        """Return the first time after t at which `decide` may change the discrete state, s (inf: never)."""
        return self.engine.next_sample(t) if self._deciding else INFINITY

    def decide(self, t: float, shaft_in: Shaft, shaft_out: Shaft) -> bool:
        """Take the decisions that are due at a communication point; return whether the torque's law changed."""
        if not self._deciding:
            return False
        bus, a, b = self.bus, self._a, self._b
        if self.driver is not None:
            self.driver.fill(t, self.x[:a], shaft_out, bus)
        bus.discrete, jumped = self.engine.decide(t, self.x[a:b], shaft_in, bus, bus.discrete)
        return jumped

    def observe(self, t: float, shaft_in: Shaft, shaft_out: Shaft) -> dict[str, float]:
        """Return the extra recorded quantities, named and in the units of `signals`."""
        x, bus, a, b = self.x, self.bus, self._a, self._b
        seen: dict[str, float] = {}
        if self.driver is not None:
            self.driver.fill(t, x[:a], shaft_out, bus)
            seen.update(self.driver.observe(t, x[:a], shaft_out, bus, ()))
        seen.update(self.engine.observe(t, x[a:b], shaft_in, bus, bus.discrete))
        seen.update(self.load.observe(t, x[b:], shaft_out, bus, ()))
        return seen
