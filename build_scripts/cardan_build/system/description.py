"""The model description of a part's FMU."""

from __future__ import annotations

import hashlib
from collections.abc import Mapping, Sequence
from xml.etree.ElementTree import Element, SubElement, indent, tostring

from cardan.units import parse_unit

from ..description import CATEGORIES, date
from .variables import PartVariable

CAPABILITIES = {
    "needsExecutionTool": "true",
    "canHandleVariableCommunicationStepSize": "true",
    "canNotUseMemoryManagementFunctions": "true",
    "canGetAndSetFMUstate": "true",
    "canSerializeFMUstate": "true",
}


def base_unit(unit: str) -> dict[str, str]:
    """Return the attributes of a ``BaseUnit`` element, of FMI and of SSP alike."""
    parsed = parse_unit(unit)
    found = {name: str(power) for name, power in zip(("kg", "m", "s", "rad"), parsed.exponents) if power}
    return found if parsed.factor == 1.0 else {**found, "factor": repr(parsed.factor)}


def describe(name: str, text: str, variables: Sequence[PartVariable], feeds: Mapping[str, Sequence[str]], *,
             version: str, digest: str, stop_time: float, step: float) -> bytes:
    """Write the model description.

    Parameters
    ----------
    name, text : str
        Model name (the library's too) and one line about it.
    variables : sequence of PartVariable
        Parameters, inputs, outputs.
    feeds : mapping
        Output -> inputs that act on it without a step between.
    version, digest : str
        Version of the project, hash of the content that the GUID is made of.
    stop_time, step : float
        Of the scene, s.

    Returns
    -------
    bytes
        XML in UTF-8; the same arguments give the same bytes.
    """
    root = Element("fmiModelDescription", {
        "fmiVersion": "2.0", "modelName": name, "guid": "", "description": text, "version": version, "license": "MIT",
        "generationTool": f"cardan_build {version} with PythonFMU", "generationDateAndTime": "",
        "variableNamingConvention": "structured",
    })
    SubElement(root, "CoSimulation", {"modelIdentifier": name, **CAPABILITIES})
    units = SubElement(root, "UnitDefinitions")
    for unit in sorted({variable.unit for variable in variables} - {""}):
        SubElement(SubElement(units, "Unit", name=unit), "BaseUnit", base_unit(unit))
    categories = SubElement(root, "LogCategories")
    for category, meaning in CATEGORIES.items():
        SubElement(categories, "Category", name=category, description=meaning)
    SubElement(root, "DefaultExperiment", startTime="0", stopTime=repr(stop_time), stepSize=repr(step))
    table = SubElement(root, "ModelVariables")
    for reference, variable in enumerate(variables):
        _variable(table, reference, variable)
    _structure(SubElement(root, "ModelStructure"), variables, feeds)
    root.set("guid", guid(tostring(root) + digest.encode()))
    root.set("generationDateAndTime", date())
    indent(root)
    made: bytes = tostring(root, encoding="utf-8")
    return b'<?xml version="1.0" encoding="UTF-8"?>\n' + made + b"\n"


def guid(content: bytes) -> str:
    """Return a GUID made from content."""
    half = hashlib.sha256(content).hexdigest()[:32]
    return "{" + "-".join((half[:8], half[8:12], half[12:16], half[16:20], half[20:])) + "}"


def number(kind: str, value: float) -> str:
    """Return a value as text that reads back as the same value."""
    if kind == "Boolean":
        return "true" if value else "false"
    return str(int(value)) if kind == "Integer" else repr(float(value))


def _variable(parent: Element, reference: int, variable: PartVariable) -> None:
    element = SubElement(parent, "ScalarVariable", name=variable.name, valueReference=str(reference),
                         description=variable.description, causality=variable.causality,
                         variability=variable.variability)
    if variable.causality != "input":
        element.set("initial", "exact" if variable.causality == "parameter" else "calculated")
    typed = SubElement(element, variable.type)
    if variable.unit:
        typed.set("unit", variable.unit)
    if variable.type != "Boolean":
        for attribute, value in (("min", variable.minimum), ("max", variable.maximum)):
            if value is not None:
                typed.set(attribute, number(variable.type, value))
    if variable.start is not None:
        typed.set("start", number(variable.type, variable.start))


def _structure(parent: Element, variables: Sequence[PartVariable], feeds: Mapping[str, Sequence[str]]) -> None:
    index = {variable.name: str(place + 1) for place, variable in enumerate(variables)}
    fixed = [index[variable.name] for variable in variables if variable.causality == "parameter"]
    outputs, initial = SubElement(parent, "Outputs"), SubElement(parent, "InitialUnknowns")
    for variable in variables:
        if variable.causality == "output":
            direct = [index[name] for name in feeds[variable.name]]
            SubElement(outputs, "Unknown", index=index[variable.name], dependencies=" ".join(direct))
            # States start from the inputs, so at the start any input may act.
            inputs = [index[each.name] for each in variables if each.causality == "input"]
            SubElement(initial, "Unknown", index=index[variable.name], dependencies=" ".join(fixed + inputs))
