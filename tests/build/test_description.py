"""modelDescription.xml says what the kernel's table says, and its dependencies are the physics'."""

from __future__ import annotations

import re
import zipfile
from pathlib import Path
from typing import Any
from xml.etree.ElementTree import Element, fromstring

import cardan_kernel
import pytest
from cardan_build import dependencies, description
from cardan_kernel import UNITS, VARIABLES


@pytest.fixture(scope="session")
def root(fmu: Path) -> Element:
    with zipfile.ZipFile(fmu) as archive:
        return fromstring(archive.read("modelDescription.xml"))


@pytest.fixture(scope="session")
def found() -> dependencies.Dependencies:
    return dependencies.find(cardan_kernel.Driveline, VARIABLES)


def test_every_variable_reads_back_as_in_the_table(root: Element) -> None:
    described = list(root.iter("ScalarVariable"))
    assert len(described) == len(VARIABLES)
    for place, (element, variable) in enumerate(zip(described, VARIABLES)):
        typed = element.find(variable.type)
        assert typed is not None, variable.name
        assert element.attrib["name"] == variable.name
        assert element.attrib["valueReference"] == str(place)
        assert element.attrib["causality"] == variable.causality
        assert element.attrib["variability"] == variable.variability
        assert element.attrib["description"] == variable.description
        assert typed.get("unit", "") == variable.unit
        assert typed.get("displayUnit", "") == variable.display
        for attribute, value in (("min", variable.minimum), ("max", variable.maximum), ("nominal", variable.nominal)):
            assert number(typed.get(attribute)) == value, (variable.name, attribute)
        if variable.type == "Boolean":
            assert typed.get("start") == str(variable.start).lower()
        else:
            assert number(typed.get("start")) == variable.start, variable.name


def number(text: str | None) -> float | None:
    return None if text is None else float(text)


def test_every_real_has_a_unit_with_its_si_exponents(root: Element) -> None:
    units = {element.attrib["name"]: element for element in root.iter("Unit")}
    for variable in VARIABLES:
        if variable.type == "Real":
            base = units[variable.unit].find("BaseUnit")
            assert base is not None
            assert {key: int(value) for key, value in base.attrib.items()} == UNITS[variable.unit].exponents
    display = {each.attrib["name"]: float(each.attrib["factor"]) for each in units["rad/s"].iter("DisplayUnit")}
    assert display["rpm"] == pytest.approx(60.0 / 6.283185307179586, rel=1e-15)


def test_head_and_capabilities(root: Element) -> None:
    assert root.attrib["fmiVersion"] == "2.0"
    assert root.attrib["version"] == cardan_kernel.__version__
    assert re.fullmatch(r"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ", root.attrib["generationDateAndTime"])
    assert re.fullmatch(r"\{[0-9a-f]{8}(-[0-9a-f]{4}){3}-[0-9a-f]{12}\}", root.attrib["guid"])
    simulation = root.find("CoSimulation")
    assert simulation is not None
    for capability in ("canGetAndSetFMUstate", "canSerializeFMUstate", "canHandleVariableCommunicationStepSize"):
        assert simulation.attrib[capability] == "true"
    source = root.find("VendorAnnotations/Tool/source")
    assert source is not None
    assert re.fullmatch(r"[0-9a-f]{64}", source.attrib["sha256"])


def test_date_follows_source_date_epoch(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("SOURCE_DATE_EPOCH", "86400")
    assert description.date() == "1970-01-02T00:00:00Z"
    monkeypatch.delenv("SOURCE_DATE_EPOCH")
    assert description.date() == description.INTERFACE_DATE


def test_guid_follows_content_and_not_the_date(
    found: dependencies.Dependencies, monkeypatch: pytest.MonkeyPatch
) -> None:
    def guid(digest: str = "a", variables: Any = VARIABLES) -> str:
        xml = description.describe(variables, UNITS, found, version="1", digest=digest, binaries=[])
        return fromstring(xml).attrib["guid"]

    first = guid()
    monkeypatch.setenv("SOURCE_DATE_EPOCH", "86400")
    assert guid() == first
    assert guid(digest="b") != first
    changed = VARIABLES[0]._replace(description="another")
    assert guid(variables=(changed, *VARIABLES[1:])) != first


def test_structure_lists_every_output_with_its_dependencies(root: Element) -> None:
    outputs = [str(place + 1) for place, each in enumerate(VARIABLES) if each.causality == "output"]
    for group in ("Outputs", "InitialUnknowns"):
        unknowns = list(root.iterfind(f"ModelStructure/{group}/Unknown"))
        assert [each.attrib["index"] for each in unknowns] == outputs
        for each in unknowns:
            names = [VARIABLES[int(index) - 1] for index in each.attrib["dependencies"].split()]
            assert all(variable.causality != "output" for variable in names)


# By the equations of docs/PHYSICS.md, sections 1, 3 and 4.
KNOWN = {
    "input.angle": {"initial.angle"},
    "input.speed": {"model.drive", "initial.speed", "input.speed_command"},
    "shaft.twist": {"model.fidelity", "initial.twist"},
    "joint1.ratio": {"initial.angle", "joint1.angle"},
    "layout.nonuniformity": {"shaft.yoke_phase", "shaft.plane_twist", "joint1.angle", "joint2.angle"},
    "layout.equivalent_angle": {"shaft.yoke_phase", "shaft.plane_twist", "joint1.angle", "joint2.angle"},
    "energy.strain": {"model.fidelity", "shaft.stiffness", "initial.twist"},
    "solver.steps": set(),
}


@pytest.mark.parametrize("output", KNOWN)
def test_initial_dependencies_are_those_of_the_equations(output: str, found: dependencies.Dependencies) -> None:
    assert set(found.initial[output]) == KNOWN[output]


def test_what_cannot_act_at_the_start_is_not_listed(found: dependencies.Dependencies) -> None:
    listed = {name for names in found.initial.values() for name in names}
    idle = {"model.tolerance", "hold.degree", "hold.restart", "input.torque.der1", "input.torque.by_speed",
            "output.torque.der1", "output.torque.by_speed", "input.speed_command.der2"}
    assert not listed & idle
    assert listed == {each.name for each in VARIABLES if each.causality != "output"} - idle


def test_outputs_hold_the_end_of_the_step_so_nothing_feeds_through(found: dependencies.Dependencies) -> None:
    assert not any(found.running.values())


def test_dependencies_find_a_feed_through_and_are_reproducible(found: dependencies.Dependencies) -> None:
    class Leaky(cardan_kernel.Interpreted):  # type: ignore[misc, valid-type]
        def get(self, name: str) -> Any:
            value = super().get(name)
            return value + 1e-3 * super().get("output.torque") if name == "ratio" else value

    leaky = dependencies.find(Leaky, VARIABLES)
    assert leaky.running["ratio"] == ("output.torque",)
    assert "output.torque" in leaky.initial["ratio"]
    leaky.running["ratio"] = ()
    leaky.initial["ratio"] = found.initial["ratio"]
    assert leaky == found
