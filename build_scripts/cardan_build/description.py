"""The model description (modelDescription.xml of FMI 2.0) from the kernel's table of variables."""

from __future__ import annotations

import hashlib
import os
from collections.abc import Sequence
from datetime import UTC, datetime
from typing import Any
from xml.etree.ElementTree import Element, SubElement, indent, tostring

from .dependencies import Dependencies

MODEL = "CardanDriveline"
TEXT = "Driveline with one or two universal joints: rigid or compliant, torque or speed driven, moving joint angles"
# Same source, same bytes: without SOURCE_DATE_EPOCH the date is that of the interface, not of the build.
INTERFACE_DATE = "2026-01-01T00:00:00Z"

CAPABILITIES = {
    "modelIdentifier": MODEL,
    "needsExecutionTool": "true",  # the importing process needs a Python: the one it runs in, or libpython loaded
    "canHandleVariableCommunicationStepSize": "true",
    "canNotUseMemoryManagementFunctions": "true",
    "canGetAndSetFMUstate": "true",
    "canSerializeFMUstate": "true",
}
CATEGORIES = {
    "logAll": "Which kernel runs",
    "logStatusWarning": "Accepted, but probably not meant",
    "logStatusDiscard": "Refused: the variable, its value and the allowed range; the state is unchanged",
    "logStatusError": "Failures",
    "logStatusFatal": "Failures of the exporter",
}


def describe(variables: Sequence[Any], units: dict[str, Any], found: Dependencies, *, version: str, digest: str,
             binaries: Sequence[str]) -> bytes:
    """Write the model description.

    Parameters
    ----------
    variables, units
        ``VARIABLES`` and ``UNITS`` of ``cardan_kernel.variables``.
    found : Dependencies
        What acts on the outputs.
    version : str
        Version of the kernel.
    digest : str
        Hash of the FMU's content, of which the GUID is made.
    binaries : sequence of str
        Compiled kernels inside.

    Returns
    -------
    bytes
        XML in UTF-8; the same arguments give the same bytes.
    """
    root = Element("fmiModelDescription", _head(version))
    SubElement(root, "CoSimulation", CAPABILITIES)
    _units(SubElement(root, "UnitDefinitions"), variables, units)
    categories = SubElement(root, "LogCategories")
    for name, text in CATEGORIES.items():
        SubElement(categories, "Category", name=name, description=text)
    # No tolerance: importers hand it over as the master's, and it would win over model.tolerance unasked.
    SubElement(root, "DefaultExperiment", startTime="0", stopTime="1", stepSize="0.001")
    vendor = SubElement(SubElement(root, "VendorAnnotations"), "Tool", name="cardan-driveline")
    SubElement(vendor, "source", sha256=digest, compiledKernels=" ".join(binaries))
    table = SubElement(root, "ModelVariables")
    for reference, variable in enumerate(variables):
        _variable(table, reference, variable)
    _structure(SubElement(root, "ModelStructure"), variables, found)
    root.set("guid", _guid(tostring(root), digest))
    root.set("generationDateAndTime", date())
    indent(root)
    body: bytes = tostring(root, encoding="utf-8")
    return b'<?xml version="1.0" encoding="UTF-8"?>\n' + body + b"\n"


def date() -> str:
    """Generation date in UTC with ``Z``: SOURCE_DATE_EPOCH where that is set."""
    epoch = os.environ.get("SOURCE_DATE_EPOCH", "")
    if not epoch.isdecimal():
        return INTERFACE_DATE
    return datetime.fromtimestamp(int(epoch), UTC).strftime("%Y-%m-%dT%H:%M:%SZ")


def _head(version: str) -> dict[str, str]:
    return {
        "fmiVersion": "2.0",
        "modelName": MODEL,
        "guid": "",
        "description": TEXT,
        "author": "cardan-driveline contributors",
        "version": version,
        "copyright": "cardan-driveline contributors",
        "license": "MIT",
        "generationTool": f"cardan_build {version} with PythonFMU",
        "generationDateAndTime": "",
        "variableNamingConvention": "structured",
    }


def _guid(text: bytes, digest: str) -> str:
    half = hashlib.sha256(text + digest.encode()).hexdigest()[:32]
    return "{" + "-".join((half[:8], half[8:12], half[12:16], half[16:20], half[20:])) + "}"


def _units(parent: Element, variables: Sequence[Any], units: dict[str, Any]) -> None:
    used = {variable.unit for variable in variables}
    for name, unit in units.items():
        if name in used:
            element = SubElement(parent, "Unit", name=name)
            SubElement(element, "BaseUnit", {base: str(power) for base, power in unit.exponents.items()})
            for display, factor in unit.displays:
                SubElement(element, "DisplayUnit", name=display, factor=repr(float(factor)))


def _variable(parent: Element, reference: int, variable: Any) -> None:
    element = SubElement(parent, "ScalarVariable", name=variable.name, valueReference=str(reference),
                         description=variable.description, causality=variable.causality,
                         variability=variable.variability)
    if variable.causality != "input":  # FMI 2.0 section 2.2.7: an input's is given by its causality
        element.set("initial", "exact" if variable.causality == "parameter" else "calculated")
    typed = SubElement(element, variable.type)
    if variable.unit:
        typed.set("unit", variable.unit)
    if variable.display:
        typed.set("displayUnit", variable.display)
    for attribute, value in (("min", variable.minimum), ("max", variable.maximum), ("nominal", variable.nominal),
                             ("start", variable.start)):
        if value is not None:
            typed.set(attribute, _number(variable.type, value))


def _number(kind: str, value: float) -> str:
    """Text that reads back as the same value; 17 digits where they are needed."""
    if kind == "Boolean":
        return "true" if value else "false"
    return str(int(value)) if kind == "Integer" else repr(float(value))


def _structure(parent: Element, variables: Sequence[Any], found: Dependencies) -> None:
    index = {variable.name: str(place + 1) for place, variable in enumerate(variables)}
    for name, table in (("Outputs", found.running), ("InitialUnknowns", found.initial)):
        group = SubElement(parent, name)
        for output, names in table.items():
            # present but empty says: depends on nothing; absent would say: on everything
            SubElement(group, "Unknown", index=index[output], dependencies=" ".join(index[each] for each in names))
