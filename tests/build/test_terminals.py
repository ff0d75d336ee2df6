"""The FMU's ports: valid by FMI 3.0's schema, made of variables that are there, with pictures."""

from __future__ import annotations

import struct
import zipfile
from pathlib import Path
from xml.etree import ElementTree

import fmpy
import pytest
from cardan_build import BuildError, terminals
from cardan_kernel.variables import VARIABLES

SCHEMA = Path(fmpy.__file__).parent / "schema" / "fmi3" / "fmi3TerminalsAndIcons.xsd"
NAMES = [each.name for each in VARIABLES]
BY_NAME = {each.name: each for each in VARIABLES}


def ports() -> dict[str, ElementTree.Element]:
    root = ElementTree.fromstring(terminals.describe(NAMES))
    return {each.attrib["name"]: each for each in root.iterfind("Terminals/Terminal")}


def test_description_is_valid_by_the_schema(fmu: Path) -> None:
    etree = pytest.importorskip("lxml.etree")
    schema = etree.XMLSchema(etree.parse(str(SCHEMA)))
    with zipfile.ZipFile(fmu) as opened:
        content = opened.read("terminalsAndIcons/terminalsAndIcons.xml")
    assert schema.validate(etree.fromstring(content)), schema.error_log
    assert content == terminals.describe(NAMES)
    assert content.startswith(b'<?xml version="1.0" encoding="UTF-8"?>\n')
    broken = content.replace(b' variableKind="signal"', b"", 1)
    assert not schema.validate(etree.fromstring(broken)), "the schema lets everything pass"


def test_members_are_variables_with_the_causality_of_a_flange() -> None:
    found = ports()
    assert set(found) == {"input", "output"}
    for name, port in found.items():
        members = {each.attrib["memberName"]: each.attrib["variableName"]
                   for each in port.iterfind("TerminalMemberVariable")}
        assert len(members) == len(port.findall("TerminalMemberVariable")), "FMI 3.0: unique within a terminal"
        expected = {"phi": "angle", "w": "speed", "a": "acceleration", "tau": "torque", "tau_der1": "torque.der1",
                    "tau_by_speed": "torque.by_speed"}
        assert members == {member: f"{name}.{variable}" for member, variable in expected.items()}
        for member, variable in members.items():
            assert BY_NAME[variable].causality == ("input" if member.startswith("tau") else "output")
        units = {member: BY_NAME[variable].unit for member, variable in members.items()}
        assert units == {"phi": "rad", "w": "rad/s", "a": "rad/s2", "tau": "N.m", "tau_der1": "N.m/s",
                         "tau_by_speed": "N.m.s/rad"}


def test_torque_flows_in_at_the_input_and_out_at_the_output() -> None:
    """docs/PHYSICS.md section 3: T_engine drives, T_load resists; so an outflow meets the load's inflow."""
    for name, direction in (("input", "inflow"), ("output", "outflow")):
        kinds = {each.attrib["memberName"]: each.attrib["variableKind"]
                 for each in ports()[name].iterfind("TerminalMemberVariable")}
        assert {member for member, kind in kinds.items() if kind == direction} == {"tau", "tau_der1", "tau_by_speed"}
        assert {member for member, kind in kinds.items() if kind == "signal"} == {"phi", "w", "a"}


def test_pictures_are_there(fmu: Path) -> None:
    with zipfile.ZipFile(fmu) as opened:
        inside = {name: opened.read(name) for name in opened.namelist() if name.startswith("terminalsAndIcons/")}
        model = opened.read("model.png")
    assert inside == terminals.files(NAMES)
    named = {each.attrib["iconBaseName"] for port in ports().values()
             for each in port.iterfind("TerminalGraphicalRepresentation")}
    for name in (*named, "icon"):
        width, height = size(inside[f"terminalsAndIcons/{name}.png"])
        assert width == height, "the coordinate system is square"
    assert size(model) == (400, 200)
    assert ElementTree.fromstring(inside["terminalsAndIcons/icon.svg"]).tag.endswith("svg")


def size(png: bytes) -> tuple[int, int]:
    assert png.startswith(b"\x89PNG\r\n\x1a\n")
    width, height = struct.unpack(">II", png[16:24])
    return int(width), int(height)


def test_port_of_a_variable_that_is_not_there_is_refused() -> None:
    with pytest.raises(BuildError, match=r"port output names the variable output\.torque, which"):
        terminals.describe(name for name in NAMES if name != "output.torque")
