"""From a scene to its parts: what each is, and how they are connected."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from cardan.models.base import Model
from cardan.models.foreign import ForeignFmu

from .beginning import Beginning
from .encode import encode, parameters
from .foreign_part import ForeignPart, foreign_connections, foreign_part
from .structure import DRIVELINE, Connection, Port, Value
from .variables import PartVariable, of_inputs, of_outputs, of_parameters

_TITLES = {"engine": "Engine", "load": "Load", "driver": "Driver", "bending": "Moving joints"}


@dataclass(frozen=True)
class ScenePart:
    """A part of a scene that becomes an FMU.

    Attributes
    ----------
    name : str
        Element of the system: ``engine``, ``load``, ``driver`` or ``bending``.
    text : str
        One line.
    data : dict
        Content of its ``part.json``.
    files : dict
        Content of its files by name.
    variables : list of PartVariable
        Its variables, in the order of their references.
    """

    name: str
    text: str
    data: dict[str, Any]
    variables: list[PartVariable]
    files: dict[str, bytes] = field(default_factory=dict)

    @property
    def model_name(self) -> str:
        """Name of the model and of its library."""
        return f"Cardan{self.name.capitalize()}"

    @property
    def ports(self) -> list[Port]:
        """Its connectors."""
        return [Port(each.name, each.causality, each.type, each.unit) for each in self.variables
                if each.causality in ("input", "output")]

    @property
    def values(self) -> list[Value]:
        """Its parameters with the values of the scene."""
        return [Value(each.name, each.type, each.start, each.unit) for each in self.variables
                if each.causality == "parameter"]


def split(scenario: Any, start: Beginning) -> tuple[list[ScenePart | ForeignPart], list[Connection]]:
    """Return the parts of a scene and all connections, those with the driveline included.

    Parameters
    ----------
    scenario : Scenario
        The scene.
    start : Beginning
        Its start.
    """
    driver = scenario.driver
    pedals = start.pedals if driver is not None else {}
    parts: list[ScenePart | ForeignPart] = []
    connections: list[Connection] = []
    for name, model, end, shaft, pedal in (("engine", scenario.engine, "input", start.shaft_in, "driver.throttle"),
                                           ("load", scenario.load, "output", start.shaft_out, "driver.brake")):
        if isinstance(model, ForeignFmu):
            parts.append(foreign_part(name, model))
            connections += foreign_connections(name, model, end, pedals=driver is not None)
            continue
        inputs = {"shaft.angle": shaft.angle, "shaft.speed": shaft.speed, **_only(pedals, pedal)}
        outputs = ["shaft.torque"]
        if model.drive == 1:
            inputs, outputs = {}, [f"shaft.speed_command{tail}" for tail in ("", ".der1", ".der2")]
        parts.append(_part(name, model, inputs, outputs, start.step, scenario))
        for each in inputs:
            element = "driver" if each.startswith("driver.") else DRIVELINE
            connections.append(Connection(element, each.replace("shaft.", f"{end}."), name, each))
        connections += [Connection(name, each, DRIVELINE, each.replace("shaft.", f"{end}.")) for each in outputs]
    if driver is not None:
        speed = {"shaft.speed": start.shaft_out.speed}
        parts.append(_part("driver", driver, speed, list(pedals), start.step, scenario))
        connections.append(Connection(DRIVELINE, "output.speed", "driver", "shaft.speed"))
    courses = _courses(scenario.driveline)
    if courses:
        names = [f"{course[0]}{tail}" for course in courses for tail in ("", ".der1")]
        parts.append(_bending(courses, names))
        connections += [Connection("bending", name, DRIVELINE, name) for name in names]
    return parts, connections


def _only(values: Mapping[str, float], prefix: str) -> dict[str, float]:
    return {name: value for name, value in values.items() if name.startswith(prefix)}


def _part(name: str, model: Model, inputs: dict[str, float], outputs: list[str], step: float,
          scenario: Any) -> ScenePart:
    files: dict[str, bytes] = {}
    tree = encode(model, files)
    open_ones = list(parameters(model))
    signals = [signal for signal in model.signals if signal not in outputs]
    variables = [*of_parameters(open_ones), *of_inputs(inputs), *of_outputs([*outputs, *signals], model.signals)]
    data = {"role": name, "model": tree, "places": {each.name: list(each.place) for each in open_ones}, "step": step,
            "pedals": any(each.startswith("driver.") for each in inputs), "variables": _table(variables)}
    return ScenePart(name, f"{_TITLES[name]} of the scene {scenario.name}: {model.kind}", data, variables, files)


def _bending(courses: list[tuple[str, float, float, float]], names: list[str]) -> ScenePart:
    units = {name: "rad/s" if name.endswith(".der1") else "rad" for name in names}
    variables = of_outputs(names, units)
    data = {"role": "bending", "courses": courses, "variables": _table(variables)}
    return ScenePart("bending", "Joint angles that move during the run", data, variables)


def _table(variables: list[PartVariable]) -> list[dict[str, Any]]:
    return [{"name": each.name, "type": each.type, "causality": each.causality, "start": each.start}
            for each in variables]


def _courses(settings: Mapping[str, Any]) -> list[tuple[str, float, float, float]]:
    """Joint angles that move: as `cardan.coupling.interface.courses`."""
    moving = []
    for name in ("joint1.angle", "joint2.angle"):
        value, rate, bend = (float(settings.get(name + tail, 0.0)) for tail in ("", ".der1", ".der2"))
        if rate or bend:
            moving.append((name, value, rate, bend))
    return moving
