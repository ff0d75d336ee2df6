"""The values that everything in a scene has at its start, exchanged between FMU and models."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from cardan.models.base import Shaft
from cardan.models.surroundings import Surroundings

from .. import BuildError


@dataclass(frozen=True)
class Beginning:
    """Start of a scene.

    Attributes
    ----------
    shaft_in, shaft_out : Shaft
        Motion of the ends.
    torque_in, torque_out : float
        N.m.
    command : tuple of float
        Prescribed input speed with its two time derivatives (zeros where a torque is given).
    pedals : dict
        Throttle and brake with their rates, by name.
    step : float
        Longest sub-step of all models' states, s.
    """

    shaft_in: Shaft
    shaft_out: Shaft
    torque_in: float
    torque_out: float
    command: tuple[float, float, float]
    pedals: dict[str, float]
    step: float


def beginning(scenario: Any, settings: dict[str, Any]) -> Beginning:
    """Find the start of a scene, in the order of `cardan.coupling.Master.begin`.

    Parameters
    ----------
    scenario : Scenario
        The scene.
    settings : dict
        Start values of the driveline by name.

    Raises
    ------
    BuildError
        If the driveline refuses them; the text is its own.
    """
    from cardan_kernel import Driveline

    world = Surroundings(scenario)
    command = world.speed_command(0.0) if world.drive else (0.0, 0.0, 0.0)
    core = Driveline()
    for name, value in settings.items():
        core.set(name, value)
    if world.drive:
        core.set("input.speed_command", command[0])
    core.setup_experiment(0.0, scenario.stop_time, scenario.tolerance)
    core.enter_initialization_mode()
    shaft_in, shaft_out = (Shaft(*(float(core.get(f"{side}.{what}")) for what in ("angle", "speed", "acceleration")))
                           for side in ("input", "output"))
    core.exit_initialization_mode()  # judges all values
    if core.last_error:
        raise BuildError(f"the scene {scenario.name} cannot start: {core.last_error}")
    world.start(0.0, shaft_in, shaft_out)
    engine, load = world.torques(0.0, shaft_in, shaft_out)
    bus = world.bus
    pedals = {"driver.throttle": bus.throttle, "driver.throttle.der1": bus.throttle_rate, "driver.brake": bus.brake,
              "driver.brake.der1": bus.brake_rate}
    return Beginning(shaft_in, shaft_out, engine.value, load.value, command, pedals, world.step)
