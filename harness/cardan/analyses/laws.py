"""Engine and load of a scene as laws with partial derivatives, evaluated at the points of a period.

Their torques come with exact derivatives by the shaft speed; derivatives by own states, and those of the own
states' rates, are central differences of fourth order (about 1e-11 relative).
"""

from __future__ import annotations

import dataclasses
import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from cardan.analyses.own_states import difference, settle
from cardan.errors import InputError
from cardan.models.base import Bus, Model, Shaft

Array = NDArray[np.float64]

LATE = 1e9  # s: laws are taken as they are when everything timed is over
CONTROLLERS = ("dyno", "idle")  # kinds with a speed to hold


@dataclass
class Outside:
    """Torques and own states at N points, k own states.

    Attributes
    ----------
    engine, engine_by_speed, engine_by_angle, load, load_by_speed : ndarray, shape (N,)
    engine_by_own, load_by_own : ndarray, shape (N, k)
    rates, rates_by_input_speed, rates_by_output_speed, rates_by_angle : ndarray, shape (N, k)
    rates_by_own : ndarray, shape (N, k, k)
    """

    engine: Array
    engine_by_speed: Array
    engine_by_angle: Array
    load: Array
    load_by_speed: Array
    engine_by_own: Array
    load_by_own: Array
    rates: Array
    rates_by_input_speed: Array
    rates_by_output_speed: Array
    rates_by_angle: Array
    rates_by_own: Array

    @classmethod
    def empty(cls, count: int, k: int) -> Outside:
        """Make it with zeros for N points and k own states."""
        shapes = {name: (count, k) for name in cls.__annotations__}
        shapes |= {name: (count,) for name in list(cls.__annotations__)[:5]}  # type: ignore[misc]
        return cls(**{name: np.zeros(shape) for name, shape in shapes.items()} | {
            "rates_by_own": np.zeros((count, k, k))})


class Surrounding:
    """Engine and load of a scene, the driver left out.

    Attributes
    ----------
    engine, load : Model
    states : tuple of str
        Own states of the engine, then of the load.
    turns : bool
        Whether the engine's torque depends on the shaft angle.
    """

    def __init__(self, scenario: Any) -> None:
        self.engine: Model = scenario.engine
        self.load: Model = scenario.load
        _check_timeless(self.engine, self.load)
        self.states = tuple(self.engine.states) + tuple(self.load.states)
        self.split = len(self.engine.states)
        self.turns = bool(getattr(self.engine, "turns", False))
        self.bus = Bus(throttle=float(getattr(self.engine, "throttle", 0.0) or 0.0))
        self.bus.discrete = self.engine.start_discrete(0.0, Shaft(0.0, 0.0, 0.0))
        self._settled: list[float] = []

    @property
    def target(self) -> float | None:
        """Speed (rad/s) that an integral controller of engine or load holds; None where there is none."""
        for model in (self.load, self.engine):
            if model.kind in CONTROLLERS and getattr(model, "integral_gain", 0.0) > 0.0:
                final = getattr(model, "final_speed", None)
                return float(model.speed if final is None else final)  # type: ignore[attr-defined]
        return None

    def aim(self, speed: float) -> None:
        """Give that controller another speed (rad/s) to hold."""
        for side in ("load", "engine"):
            model = getattr(self, side)
            if model.kind in CONTROLLERS and getattr(model, "integral_gain", 0.0) > 0.0:
                changes = {"final_speed": None} if hasattr(model, "final_speed") else {}
                setattr(self, side, dataclasses.replace(model, speed=speed, **changes))
                return

    def start(self, speed: float) -> list[float]:
        """Return the own states at rest for a constant shaft speed (rad/s), from the models' own start values."""
        shaft = Shaft(0.0, speed, 0.0)
        x = self._settled or (self.engine.start(LATE, shaft, self.bus) + self.load.start(LATE, shaft, self.bus))
        if x:
            x = self._settled = settle(lambda y: self.rates(y, shaft, shaft), x, self._time_scale())
        return list(x)

    def rates(self, x: list[float], shaft_in: Shaft, shaft_out: Shaft) -> list[float]:
        """Return the time derivatives of the own states."""
        m = self.split
        return (self.engine.derivative(LATE, x[:m], shaft_in, self.bus)
                + self.load.derivative(LATE, x[m:], shaft_out, self.bus))

    def balance(self, speed: float) -> float:
        """Return mean engine torque less load at a constant speed with settled own states, N.m."""
        x = self.start(speed)
        m = self.split
        angles = [2.0 * math.tau * i / 96 for i in range(96)] if self.turns else [0.0]
        drive = [self.engine.value(LATE, x[:m], Shaft(a, speed, 0.0), self.bus) for a in angles]
        return sum(drive) / len(drive) - self.load.value(LATE, x[m:], Shaft(0.0, speed, 0.0), self.bus)

    def _time_scale(self) -> float:
        return min(self.engine.time_scale(), self.load.time_scale())

    def evaluate(self, kernel_states: Array, own: Array, output_speeds: Array) -> Outside:
        """Evaluate at N points: kernel states (N, 4), own states (N, k), output speeds (N,)."""
        count, k = own.shape
        m = self.split
        out = Outside.empty(count, k)
        for i in range(count):
            x = [float(v) for v in own[i]]
            angle, speed, output = float(kernel_states[i, 0]), float(kernel_states[i, 2]), float(output_speeds[i])
            shaft_in, shaft_out = Shaft(angle, speed, 0.0), Shaft(0.0, output, 0.0)
            drive = self.engine.torque(LATE, x[:m], shaft_in, self.bus)
            load = self.load.torque(LATE, x[m:], shaft_out, self.bus)
            out.engine[i], out.engine_by_speed[i] = drive.value, drive.by_speed
            out.load[i], out.load_by_speed[i] = load.value, load.by_speed
            if k:
                self._own(out, i, x, shaft_in, shaft_out)
            if self.turns and speed != 0.0:
                moved = float(out.engine_by_own[i, :m] @ out.rates[i, :m]) if k else 0.0
                out.engine_by_angle[i] = (drive.rate - moved) / speed
        return out

    def _own(self, out: Outside, i: int, x: list[float], shaft_in: Shaft, shaft_out: Shaft) -> None:
        m, bus = self.split, self.bus
        out.rates[i] = self.rates(x, shaft_in, shaft_out)
        for j in range(len(x)):
            def torques(value: float, j: int = j) -> list[float]:
                y = [*x[:j], value, *x[j + 1:]]
                return [self.engine.value(LATE, y[:m], shaft_in, bus) if j < m else 0.0,
                        self.load.value(LATE, y[m:], shaft_out, bus) if j >= m else 0.0,
                        *self.rates(y, shaft_in, shaft_out)]

            slope = difference(torques, x[j])
            out.engine_by_own[i, j], out.load_by_own[i, j] = slope[0], slope[1]
            out.rates_by_own[i, :, j] = slope[2:]
        out.rates_by_input_speed[i, :m] = difference(
            lambda w: self.engine.derivative(LATE, x[:m], shaft_in._replace(speed=w), bus), shaft_in.speed)
        out.rates_by_output_speed[i, m:] = difference(
            lambda w: self.load.derivative(LATE, x[m:], shaft_out._replace(speed=w), bus), shaft_out.speed)


def angle_period(surrounding: Surrounding) -> float:
    """Return the turn (rad) after which joints and engine repeat: half a turn, or more with an engine's ripple."""
    if not surrounding.turns:
        return math.pi
    if any("angle" in name for name in surrounding.engine.states):
        raise InputError("[engine]: ripple behind a gearbox follows the engine's own angle, so the motion never "
                         "repeats with the shaft; leave the gearbox or the ripple out for this analysis")
    x = surrounding.start(100.0)[:surrounding.split]

    def torque(angle: float) -> float:
        return surrounding.engine.value(LATE, x, Shaft(angle, 100.0, 0.0), surrounding.bus)

    angles = [0.37 + 0.29 * i for i in range(44)]
    values = [torque(a) for a in angles]
    size = max(1.0, *(abs(v) for v in values))
    for period in (math.pi, 2.0 * math.pi, 4.0 * math.pi):
        if all(abs(torque(a + period) - v) <= 1e-9 * size for a, v in zip(angles, values)):
            return period
    raise InputError("[engine]: its torque does not repeat within two turns of the shaft, so there is no periodic "
                     "motion")


def _check_timeless(engine: Model, load: Model) -> None:
    problems = [f"[{side}] type = 'csv': a torque over time has no steady state; use a torque by speed, such as "
                f"type = 'constant', for this analysis"
                for side, model in (("engine", engine), ("load", load)) if model.kind == "csv"]
    if problems:
        raise InputError(problems)
