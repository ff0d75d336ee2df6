"""An engine or a load that is an FMU already: it goes into the package as it is."""

from __future__ import annotations

from dataclasses import dataclass

from cardan.description import Variable, read_description
from cardan.models.foreign import ForeignFmu

from .structure import DRIVELINE, Connection, Port, Value

_PEDALS = {"throttle": "driver.throttle", "brake": "driver.brake"}


@dataclass(frozen=True)
class ForeignPart:
    """A foreign FMU as a component.

    Attributes
    ----------
    name : str
        Element of the system: ``engine`` or ``load``.
    content : bytes
        The FMU.
    ports : list of Port
        The connectors that the scene's mapping uses.
    values : list of Value
        The start values that the scene gives.
    """

    name: str
    content: bytes
    ports: list[Port]
    values: list[Value]


def foreign_part(name: str, model: ForeignFmu) -> ForeignPart:
    """Return the component of a foreign FMU."""
    about = read_description(model.fmu)
    used = [its for _, its, _ in (*model.inputs, *model.outputs)] + [its for _, its in model.recorded]
    ports = [_port(about[its]) for its in dict.fromkeys(used)]
    values = [Value(its, about[its].type, value, "") for its, value in model.settings.items()]
    return ForeignPart(name, model.fmu.read_bytes(), ports, values)


def foreign_connections(name: str, model: ForeignFmu, end: str, *, pedals: bool) -> list[Connection]:
    """Return its connections: values in its own units, the torque with the factor of the scene.

    Parameters
    ----------
    name : str
        Element of the system.
    model : ForeignFmu
        The scene's model of it.
    end : str
        ``input`` or ``output`` end of the driveline.
    pedals : bool
        Whether a driver is there to give throttle and brake.
    """
    found = []
    for ours, its, unit in model.inputs:
        if ours in _PEDALS:
            if pedals:
                found.append(Connection("driver", _PEDALS[ours], name, its, 1.0 / unit))
        else:
            found.append(Connection(DRIVELINE, f"{end}.{ours}", name, its, 1.0 / unit))
    torque, unit = next((its, unit) for ours, its, unit in model.outputs if ours == "torque")
    return [*found, Connection(name, torque, DRIVELINE, f"{end}.torque", model.factor * unit)]


def _port(variable: Variable) -> Port:
    # Units of other authors need not be ones that the package can define.
    return Port(variable.name, "input" if variable.causality == "input" else "output", variable.type, "")
