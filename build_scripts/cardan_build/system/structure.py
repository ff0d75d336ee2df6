"""The system structure description (SystemStructure.ssd of SSP 1.0) and its parameter sets."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import NamedTuple
from xml.etree.ElementTree import Element, SubElement, indent, tostring

from ..description import date
from .description import base_unit, number

SSP = "http://ssp-standard.org/SSP1/SystemStructure"
OSP = "http://opensimulationplatform.com/SSP/OSPAnnotations"
DRIVELINE = "driveline"  # the element that all others are connected to
PARAMETER_SET = "scene"  # its name: importers ask for it by that


@dataclass(frozen=True)
class Port:
    """A connector: name, ``input`` or ``output``, type of FMI 2.0, unit (empty: none)."""

    name: str
    kind: str
    type: str
    unit: str


class Connection(NamedTuple):
    """A value on its way: element and connector that give, element and connector that take, and the factor between."""

    giver: str
    given: str
    taker: str
    taken: str
    factor: float = 1.0


@dataclass(frozen=True)
class Value:
    """A value of a parameter set: name, type of FMI 2.0, value, unit (empty: none)."""

    name: str
    type: str
    value: float | int | bool | str
    unit: str


def structure(name: str, title: str, ports: Mapping[str, Sequence[Port]],
              connections: Iterable[Connection], *, version: str, stop_time: float,
              step: float) -> bytes:
    """Write the structure.

    Only what Ecos, libcosim and FMPy read alike is used: prefixes ``ssd`` and ``ssc``, connectors of components alone,
    every input connector connected, one parameter set per component in a file of its own.

    Parameters
    ----------
    name, title : str
        Name of the system and one line about it.
    ports : mapping
        Component -> its connectors; its FMU is ``resources/<component>.fmu``.
    connections : iterable of Connection
        What goes where.
    version : str
        Of the project.
    stop_time, step : float
        Default experiment, s. SSP 1.0 has no place for the step; libcosim reads it from an annotation.
    """
    root = _root("ssd", "SystemStructureDescription", name, version)
    root.set("xmlns:ssc", f"{SSP}Common")
    system = SubElement(root, "ssd:System", name=name, description=title)
    elements = SubElement(system, "ssd:Elements")
    for component, its in ports.items():
        element = SubElement(elements, "ssd:Component", name=component, type="application/x-fmu-sharedlibrary",
                             source=f"resources/{component}.fmu", implementation="CoSimulation")
        connectors = SubElement(element, "ssd:Connectors")
        for port in its:
            connector = SubElement(connectors, "ssd:Connector", name=port.name, kind=port.kind)
            SubElement(connector, f"ssc:{port.type}", {"unit": port.unit} if port.unit else {})
        bindings = SubElement(element, "ssd:ParameterBindings")
        SubElement(bindings, "ssd:ParameterBinding", type="application/x-ssp-parameter-set",
                   source=f"resources/{component}.ssv")
    group = SubElement(system, "ssd:Connections")
    for each in connections:
        element = SubElement(group, "ssd:Connection", startElement=each.giver, startConnector=each.given,
                             endElement=each.taker, endConnector=each.taken)
        if each.factor != 1.0:
            SubElement(element, "ssc:LinearTransformation", factor=repr(each.factor), offset="0.0")
    _units(root, "ssd:Units", (port.unit for its in ports.values() for port in its))
    experiment = SubElement(root, "ssd:DefaultExperiment", startTime="0", stopTime=repr(stop_time))
    annotation = SubElement(SubElement(experiment, "ssd:Annotations"), "ssc:Annotation",
                            type="com.opensimulationplatform")
    # libcosim takes an attribute of osp:Algorithm, and be it its namespace, for an algorithm: that stands at the root.
    root.set("xmlns:osp", OSP)
    SubElement(SubElement(annotation, "osp:Algorithm"), "osp:FixedStepAlgorithm", baseStepSize=repr(step))
    return _text(root)


def parameter_set(values: Iterable[Value], version: str) -> bytes:
    """Write a parameter set (SSV) named `PARAMETER_SET`."""
    root = _root("ssv", "ParameterSet", PARAMETER_SET, version)
    root.set("xmlns:ssc", f"{SSP}Common")
    found = list(values)
    group = SubElement(root, "ssv:Parameters")
    for each in found:
        typed = SubElement(SubElement(group, "ssv:Parameter", name=each.name), f"ssv:{each.type}",
                           value=each.value if isinstance(each.value, str) else number(each.type, each.value))
        if each.unit:
            typed.set("unit", each.unit)
    _units(root, "ssv:Units", (each.unit for each in found))
    return _text(root)


def _root(prefix: str, kind: str, name: str, version: str) -> Element:
    space = {"ssd": "Description", "ssv": "ParameterValues"}[prefix]
    return Element(f"{prefix}:{kind}", {f"xmlns:{prefix}": SSP + space, "version": "1.0", "name": name,
                                        "generationTool": f"cardan_build {version}", "generationDateAndTime": date()})


def _units(root: Element, tag: str, units: Iterable[str]) -> None:
    used = sorted(set(units) - {""})
    if used:
        group = SubElement(root, tag)
        for unit in used:
            SubElement(SubElement(group, "ssc:Unit", name=unit), "ssc:BaseUnit", base_unit(unit))


def _text(root: Element) -> bytes:
    indent(root)
    text: bytes = tostring(root, encoding="utf-8")
    return b'<?xml version="1.0" encoding="UTF-8"?>\n' + text + b"\n"
