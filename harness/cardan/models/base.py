"""What an engine, a load and a driver offer to the master.

Everything outside the FMU is explicit state: a model is a stateless function of time, its own continuous
states, the shaft it acts on and the bus, so that a rollback is the copy of a list.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Sequence
from typing import Any, ClassVar, NamedTuple

from cardan.models.parameters import check_ranges

INFINITY = math.inf

State = Sequence[float]
Discrete = tuple[Any, ...]


class Shaft(NamedTuple):
    """Motion of one end of the driveline: angle in rad, speed in rad/s, acceleration in rad/s2."""

    angle: float
    speed: float
    acceleration: float


class Torque(NamedTuple):
    """A torque with its exact derivatives.

    Attributes
    ----------
    value : float
        N.m. Of an engine, positive drives the input shaft; of a load, positive resists positive speed.
    rate : float
        N.m/s, time derivative at constant shaft speed: time, angle, own states and bus moving.
    by_speed : float
        N.m.s/rad, partial derivative by the speed of the shaft it acts on. The total time derivative is
        ``rate + by_speed * acceleration``.
    """

    value: float
    rate: float
    by_speed: float


class Bus:
    """Signals from the driver to engine and load, and the discrete state of the engine.

    Attributes
    ----------
    throttle, brake : float
        Pedal positions, 0 to 1.
    throttle_rate, brake_rate : float
        Their time derivatives, 1/s.
    discrete : tuple
        Discrete state of the engine (gear and shift of a gearbox; empty otherwise).
    """

    __slots__ = ("throttle", "throttle_rate", "brake", "brake_rate", "discrete")

    def __init__(self, throttle: float = 0.0, throttle_rate: float = 0.0, brake: float = 0.0,
                 brake_rate: float = 0.0, discrete: Discrete = ()) -> None:
        self.throttle = throttle
        self.throttle_rate = throttle_rate
        self.brake = brake
        self.brake_rate = brake_rate
        self.discrete = discrete


@dataclasses.dataclass(frozen=True, eq=False)
class Model:
    """Base of engines and loads: no states, no torque, no events.

    Subclasses are frozen dataclasses whose fields are the keys of the scene file, declared with
    `cardan.models.parameters.quantity` and its kin (unit, limits, meaning); values are SI numbers.
    Values that follow from the keys are computed in `prepare`.

    Attributes
    ----------
    kind : str
        The ``type`` of the scene file.
    drive : int
        1 where the model prescribes the input speed (`command`) instead of a torque.
    states : tuple of str
        Continuous states with units, such as ``"engine.speed [rad/s]"``.
    signals : dict
        Units of the quantities of `observe`.
    """

    kind: ClassVar[str] = ""
    drive: ClassVar[int] = 0
    states: tuple[str, ...] = dataclasses.field(default=(), init=False, repr=False)
    signals: dict[str, str] = dataclasses.field(default_factory=dict, init=False, repr=False)

    def __post_init__(self) -> None:
        check_ranges(self)
        self.prepare()

    def prepare(self) -> None:
        """Compute what follows from the parameters; raise `ParameterError` where they do not fit together."""

    def put(self, **values: Any) -> None:
        """Store derived values while the model is being made (the dataclass is frozen)."""
        for name, value in values.items():
            object.__setattr__(self, name, value)

    def start(self, t: float, shaft: Shaft, bus: Bus) -> list[float]:
        """Return the initial continuous states."""
        return []

    def start_discrete(self, t: float, shaft: Shaft) -> Discrete:
        """Return the initial discrete state."""
        return ()

    def derivative(self, t: float, x: State, shaft: Shaft, bus: Bus) -> list[float]:
        """Return the time derivatives of the continuous states."""
        return []

    def torque(self, t: float, x: State, shaft: Shaft, bus: Bus) -> Torque:
        """Return the torque on the shaft with its derivatives."""
        raise NotImplementedError

    def value(self, t: float, x: State, shaft: Shaft, bus: Bus) -> float:
        """Return the torque alone, N.m: what a gearbox needs of its engine between communication points."""
        return self.torque(t, x, shaft, bus).value

    def command(self, t: float) -> tuple[float, float, float]:
        """Return the prescribed input speed (rad/s) and its first and second time derivative (drive = 1)."""
        raise NotImplementedError(f"model {self.kind!r} prescribes no speed")

    def takes_throttle(self) -> bool:
        """Return whether the torque depends on the throttle, so that a driver can act through it."""
        return False

    def time_scale(self) -> float:
        """Return the longest admissible sub-step of the model's own states, s."""
        return INFINITY

    def next_event(self, t: float) -> float:
        """Return the first known time after t where the torque or its slope jumps, s (inf: none).

        At the event itself the value is the one from the right; ``math.nextafter(t, -inf)`` gives the left one.
        """
        return INFINITY

    def next_sample(self, t: float) -> float:
        """Return the first time after t at which `decide` may change the discrete state, s (inf: never)."""
        return INFINITY

    def decide(self, t: float, x: State, shaft: Shaft, bus: Bus, discrete: Discrete) -> tuple[Discrete, bool]:
        """Return the discrete state after a communication point, and whether the law of the torque changed."""
        return discrete, False

    def observe(self, t: float, x: State, shaft: Shaft, bus: Bus, discrete: Discrete) -> dict[str, float]:
        """Return the extra recorded quantities, named and in the units of `signals`."""
        return {}
