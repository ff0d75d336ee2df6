"""The systems that are measured: the ordinary driveline, and three couplings with engine and load outside the FMU."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from math import pi, radians
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

from cardan.bench.monolithic import Monolith

if TYPE_CHECKING:
    from cardan.scenario import Scenario

BETA1, BETA2 = radians(20), radians(15)
SPEED = 100.0 * pi  # rad/s, 3000 rpm
TORQUE, RESISTANCE = 200.0, 197.0  # N.m, constant: what engine and load have in the ordinary driveline

ORDINARY: Mapping[str, float] = MappingProxyType(
    {"joint1.angle": BETA1, "joint2.angle": BETA2, "initial.speed": SPEED})


def ordinary() -> Monolith:
    """Return the ordinary driveline, 20/15 deg at 3000 rpm under constant torques, as one system."""
    return Monolith(lambda angle, speed: TORQUE, lambda speed: RESISTANCE, BETA1, BETA2, SPEED)


@dataclass(frozen=True)
class Coupled:
    """A driveline with engine and load outside the FMU.

    Attributes
    ----------
    name, title : str
        What it is called in tables and under figures.
    speed, twist : float
        Input speed, rad/s, and twist of the shaft, rad, at the start.
    stop_time : float
        s.
    engine, load : mapping
        Tables of the scene file.
    rates : tuple of int
        Communication steps per simulated second of the study, from long to short steps.
    """

    name: str
    title: str
    speed: float
    twist: float
    stop_time: float
    engine: Mapping[str, Any]
    load: Mapping[str, Any]
    rates: tuple[int, ...]

    def scenario(self, coupling: str, step: float, tolerance: float) -> Scenario:
        """Return the scene for a coupling, a communication step in s and a tolerance."""
        from cardan.scenario import Scenario

        return Scenario.from_dict({
            "scene": {"title": self.title, "stop_time": self.stop_time, "communication_step": step,
                      "coupling": coupling, "tolerance": tolerance, "outputs": ["input.speed", "output.speed"]},
            "driveline": {**ORDINARY, "initial.speed": self.speed, "initial.twist": self.twist},
            "engine": dict(self.engine), "load": dict(self.load)})

    def monolith(self) -> Monolith:
        """Return the same as one system, with the torques that the scene's own models compute."""
        from cardan.models.base import Bus, Shaft

        scenario = self.scenario("slope", self.stop_time, 1e-9)
        bus = Bus(throttle=getattr(scenario.engine, "throttle", 0.0))
        drive, resist = scenario.engine.torque, scenario.load_model.torque

        def engine(angle: float, speed: float) -> float:
            return drive(0.0, (), Shaft(angle, speed, 0.0), bus)[0]

        def load(speed: float) -> float:
            return resist(0.0, (), Shaft(0.0, speed, 0.0), bus)[0]

        return Monolith(engine, load, BETA1, BETA2, self.speed, self.twist)


# Within one patch of its grid, the torque map is smooth to every order.
_MAP = {"type": "map", "speeds": [0.0, 200.0, 400.0, 600.0], "throttles": [0.0, 1.0],
        "torques": [[10.0, -10.0, -25.0, -40.0], [150.0, 215.0, 190.0, 120.0]]}

SMOOTH = Coupled("smooth", "torque map, quadratic load", 100.0, 0.0, 1.0, _MAP,
                 {"type": "quadratic", "coefficient": 2e-2}, (125, 250, 500, 1000, 2000, 4000))
RIPPLE = Coupled("ripple", "map with 80 N.m ripple", SPEED, 0.0, 1.0,
                 {"type": "four_stroke", "map": {key: value for key, value in _MAP.items() if key != "type"},
                  "orders": [2], "amplitudes": [80.0]},
                 {"type": "quadratic", "coefficient": 2e-3}, (250, 500, 1000, 1250, 2000, 4000))
# Twist and speed fit the torques at the start, so that the load is what is hard and not a transient before it.
STEEP = Coupled("steep", "load of 3000 w^4", 0.54, 0.014, 1.0,
                {"type": "four_stroke", "torque": 200.0, "orders": [2], "amplitudes": [80.0]},
                {"type": "power", "coefficient": 3000.0, "exponent": 4.0}, (100, 250, 500, 1000, 2000, 4000))
COUPLED = (SMOOTH, RIPPLE, STEEP)
