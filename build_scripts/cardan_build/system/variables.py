"""The variables of a part: parameters of its model, what it is told, what it tells."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any

from .encode import Parameter

TEXTS = {
    "shaft.angle": ("rad", "angle of the shaft that the model acts on"),
    "shaft.speed": ("rad/s", "speed of that shaft"),
    "shaft.torque": ("N.m", "torque on the shaft: of an engine it drives, of a load it resists positive speed"),
    "shaft.speed_command": ("rad/s", "prescribed speed of the shaft"),
    "shaft.speed_command.der1": ("rad/s2", "its time derivative"),
    "shaft.speed_command.der2": ("rad/s3", "its second time derivative"),
    "driver.throttle": ("1", "throttle, 0 to 1"),
    "driver.throttle.der1": ("1/s", "its time derivative"),
    "driver.brake": ("1", "brake, 0 to 1"),
    "driver.brake.der1": ("1/s", "its time derivative"),
}
_KINDS = {"real": "Real", "integer": "Integer", "boolean": "Boolean"}


@dataclass(frozen=True)
class PartVariable:
    """One variable of a part's FMU; its value reference is its place in the list.

    Attributes
    ----------
    name, type, causality, unit, description : str
        As in a model description of FMI 2.0; unit empty for other than Real.
    start : float, int, bool or None
        Start value; None for outputs.
    minimum, maximum : float or None
        Allowed range.
    """

    name: str
    type: str
    causality: str
    unit: str
    description: str
    start: Any = None
    minimum: float | None = None
    maximum: float | None = None

    @property
    def variability(self) -> str:
        """Of FMI 2.0: parameters are fixed, the rest is continuous."""
        return "fixed" if self.causality == "parameter" else "continuous"


def of_parameters(parameters: Iterable[Parameter]) -> list[PartVariable]:
    """Return the variables for open parameters."""
    found = []
    for each in parameters:
        kind = _KINDS[each.key.kind]
        unit = (each.key.unit or "1") if kind == "Real" else ""
        found.append(PartVariable(each.name, kind, "parameter", unit, each.key.text, each.value, each.key.minimum,
                                  each.key.maximum))
    return found


def of_inputs(values: Mapping[str, float]) -> list[PartVariable]:
    """Return the variables for inputs, with start values by name."""
    return [PartVariable(name, "Real", "input", *TEXTS[name], start=float(value)) for name, value in values.items()]


def of_outputs(names: Iterable[str], signals: Mapping[str, str]) -> list[PartVariable]:
    """Return the variables for outputs; units of those without an entry in `TEXTS` come from `signals`."""
    found = []
    for name in names:
        unit, text = TEXTS.get(name) or (signals[name] or "1", f"{name} as in the results of cardan simulate")
        found.append(PartVariable(name, "Real", "output", unit, text))
    return found
