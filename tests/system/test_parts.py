"""The FMUs of engine, load and driver: the same rules as the driveline's (docs/FMI.md)."""

from __future__ import annotations

import contextlib
import json
import re
import subprocess
import sys
import zipfile
from collections.abc import Iterator
from pathlib import Path

import pytest
from cardan import Instance
from cardan.description import read_description
from cardan.errors import FmiError, StepRefused
from cardan_build.system.assembly import unpack_fmus
from hosts.pythons import interpreter
from system.conftest import Packaged

VERSIONS = [f"3.{minor}" for minor in range(9, 16)]


@pytest.fixture(scope="module")
def fmus(packaged: Packaged, tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    """Driveline, engine with gearbox and governor, and dynamometer."""
    return unpack_fmus(packaged("gearbox")[0], tmp_path_factory.mktemp("fmus"))


@pytest.fixture
def engine(fmus: dict[str, Path]) -> Iterator[Instance]:
    with Instance(fmus["engine"], "engine") as instance:
        yield instance


def begin(instance: Instance) -> None:
    instance.setup(0.0)
    instance.initialize()


def drive(instance: Instance, first: int, count: int) -> list[tuple[float, ...]]:
    """Step with a shaft that speeds up; outputs after each step."""
    rows = []
    for i in range(first, first + count):
        instance.set("shaft.speed", 30.0 + 0.1 * i)
        instance.set("shaft.angle", 0.03 * i)
        instance.step(1e-3 * i, 1e-3)
        rows.append(tuple(instance.get(name) for name in ("shaft.torque", "engine.speed", "gearbox.gear")))
    return rows


def test_state_is_complete_and_a_repeated_run_equal_to_the_last_bit(engine: Instance, fmus: dict[str, Path]) -> None:
    begin(engine)
    drive(engine, 0, 150)
    state, stored = engine.get_state(), engine.serialize()
    first = drive(engine, 150, 150)
    assert len({row[2] for row in first}) == 2  # a shift is under way
    engine.set_state(state)
    assert drive(engine, 150, 150) == first
    with Instance(fmus["engine"], "another") as other:
        begin(other)
        other.deserialize(stored)
        assert drive(other, 150, 150) == first


def test_state_before_initialization_and_reset_bring_back_the_start(engine: Instance) -> None:
    fresh = engine.get_state()
    begin(engine)
    first = drive(engine, 0, 120)
    engine.set_state(fresh)
    begin(engine)
    assert drive(engine, 0, 120) == first
    engine.reset()
    assert engine.get("shaft.speed") == 30.0  # the scene's initial speed
    begin(engine)
    assert drive(engine, 0, 120) == first


@pytest.mark.parametrize("value", [float("nan"), float("inf")])
def test_a_bad_input_is_named_and_leaves_the_state(value: float, engine: Instance) -> None:
    begin(engine)
    drive(engine, 0, 10)
    before = engine.get_state()
    engine.set("shaft.speed", value)
    with pytest.raises(StepRefused, match=rf"shaft\.speed = {value} is not finite"):
        engine.step(0.01, 1e-3)
    engine.set("shaft.speed", 31.0)
    again = drive(engine, 10, 5)
    engine.set_state(before)
    assert drive(engine, 10, 5) == again


def test_a_parameter_that_fits_no_model_is_named_until_it_is_mended(engine: Instance) -> None:
    engine.set("gearbox.clutch.full_speed", 10.0)
    with pytest.raises(FmiError, match=r"full_speed = 10\.0: not above engage_speed; allowed: > 80 rad/s"):
        begin(engine)
    with pytest.raises(StepRefused, match="full_speed"):
        engine.step(0.0, 1e-3)
    engine.reset()
    engine.set("gearbox.clutch.full_speed", 120.0)
    begin(engine)
    engine.step(0.0, 1e-3)


def test_a_parameter_acts(fmus: dict[str, Path]) -> None:
    found = []
    for inertia in (0.3, 0.6):
        with Instance(fmus["engine"], "engine") as instance:
            instance.set("gearbox.engine_inertia", inertia)
            begin(instance)
            drive(instance, 0, 20)
            found.append(float(instance.get("engine.speed")) - 90.0)
    assert found[0] == pytest.approx(2.0 * found[1], rel=0.05)  # speed gained from the same torque, clutch still open


def test_a_parameter_set_back_in_initialization_mode_gives_the_first_values_again(engine: Instance) -> None:
    engine.setup(0.0)
    before = engine.get("governor.torque")
    engine.set("governor.speed", 95.0)
    assert engine.get("governor.torque") != before
    engine.set("governor.speed", 50.0)
    assert engine.get("governor.torque") == before


@pytest.mark.parametrize(("calls", "text"), [
    ("initialize", "exit_initialization_mode is refused while the instance is instantiated"),
    ("setup initialize setup", "setup_experiment is refused while the instance is stepping"),
    ("terminate", "terminate is refused while the instance is instantiated"),
    ("setup initialize terminate terminate", "terminate is refused while the instance is terminated"),
])
def test_calls_out_of_order_are_told(calls: str, text: str, engine: Instance) -> None:
    with contextlib.suppress(FmiError):
        for call in calls.split():
            getattr(engine, call)()
    assert any(text in message.text for message in engine.messages)


def test_wrong_calls_are_refused_and_told(engine: Instance) -> None:
    with pytest.raises(StepRefused, match="initialize it first"):
        engine.step(0.0, 1e-3)
    begin(engine)
    for size in (0.0, -1e-3, float("nan")):
        with pytest.raises(StepRefused, match="length must be above 0 s"):
            engine.step(0.0, size)
    engine.set("governor.gain", 3.0)
    with pytest.raises(StepRefused, match=r"governor\.gain is a fixed parameter"):
        engine.step(0.0, 1e-3)
    assert engine.get("governor.gain") == 2.0
    engine.step(0.0, 1e-3)


def test_modules_have_names_of_their_own_in_each_part(fmus: dict[str, Path]) -> None:
    tags = []
    for name in ("engine", "load"):
        with zipfile.ZipFile(fmus[name]) as archive:
            slave = archive.read("resources/slavemodule.txt").decode()
            texts = {each: archive.read(each).decode() for each in archive.namelist() if each.endswith(".py")}
        tags.append(slave.removeprefix("cardan_part_slave_"))
        assert re.fullmatch(r"[0-9a-f]{12}", tags[-1])
        for each, text in texts.items():
            imported = re.findall(r"^\s*(?:from|import)\s+(cardan\w*|pythonfmu\w*)", text, re.MULTILINE)
            assert all(module.endswith(f"_{tags[-1]}") for module in imported), each
    assert tags[0] != tags[1]


def test_parts_run_after_the_folder_of_another_is_gone(fmus: dict[str, Path]) -> None:
    with Instance(fmus["load"], "load") as load:
        begin(load)
    with Instance(fmus["engine"], "engine") as engine, Instance(fmus["load"], "load") as load:
        begin(engine)
        begin(load)
        load.set("shaft.speed", 60.0)
        assert load.get("shaft.torque") > 0.0
        drive(engine, 0, 3)


@pytest.mark.skipif(sys.platform != "linux", reason="this host is written for Linux")
@pytest.mark.parametrize("name", ["driveline", "engine"])
def test_instances_can_be_made_again_and_again(name: str, fmus: dict[str, Path], tmp_path: Path) -> None:
    # The exporter releases a borrowed reference with each: with a leaner class the process would die here.
    about = read_description(fmus[name])
    with zipfile.ZipFile(fmus[name]) as archive:
        archive.extractall(tmp_path)
    values = [each for each in about.variables.values() if each.type == "Real"]
    job = {"library": str(tmp_path / f"binaries/linux64/{about.identifier}.so"), "guid": about.guid, "starts": [],
           "resources": (tmp_path / "resources").as_uri(), "mode": "cycles", "count": 300,
           "inputs": [each.reference for each in values if each.causality == "input"][:2],
           "outputs": [each.reference for each in values if each.causality == "output"][:3]}
    host = Path(__file__).resolve().parents[1] / "hosts" / "ctypes_host.py"
    done = subprocess.run([sys.executable, "-I", "-S", "-B", str(host)], input=json.dumps(job), capture_output=True,
                          text=True, check=False)
    assert done.returncode == 0, done.stderr
    memory = json.loads(done.stdout)["memory"]
    assert (memory[-1] - memory[4]) / 150 < 22.0  # kB; docs/FMI.md, trap 10


@pytest.fixture(scope="module")
def resources(fmus: dict[str, Path], tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("bare")
    with zipfile.ZipFile(fmus["engine"]) as archive:
        archive.extractall(folder)
    return folder / "resources"


@pytest.mark.parametrize("version", VERSIONS)
def test_a_part_runs_under_this_python_with_the_standard_library_alone(version: str, resources: Path) -> None:
    names = [each["name"] for each in json.loads((resources / "part.json").read_text())["variables"]]
    job = {"resources": str(resources), "count": 60, "inputs": [names.index(f"shaft.{x}") for x in ("angle", "speed")],
           "outputs": [names.index("shaft.torque"), names.index("engine.speed")]}
    python = interpreter(version)
    if python is None:
        pytest.skip(f"no Python {version} is installed here")
    found = []
    for each in (sys.executable, python):
        done = subprocess.run([each, "-I", "-S", "-B", str(Path(__file__).with_name("bare_part.py"))],
                              input=json.dumps(job), capture_output=True, text=True, check=False)
        assert done.returncode == 0, done.stderr
        found.append(json.loads(done.stdout))
    assert found[1] == found[0]
    assert all(row[0] for row in found[0]["rows"])
    assert found[0]["messages"] == []
    assert not found[0]["path"]
