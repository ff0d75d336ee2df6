"""What a system package holds, and how it refuses to be made."""

from __future__ import annotations

import io
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest
from cardan import Instance
from cardan.description import read_description
from cardan_build import BuildError
from cardan_build.system import package
from cardan_build.system.assembly import unpack_fmus
from fmpy.ssp.ssd import read_ssd, read_ssv
from system import scenes
from system.conftest import Packaged
from system.in_order import connections


def cardan(*arguments: str, cwd: Path) -> subprocess.CompletedProcess[str]:
    return subprocess.run([sys.executable, "-c", "from cardan.cli import main; main()", *arguments], cwd=cwd,
                          capture_output=True, text=True, check=False)


def test_the_structure_is_valid_and_names_scene_step_and_stop_time(packaged: Packaged) -> None:
    ssp, scenario, _ = packaged("driven")
    read = read_ssd(str(ssp), validate=True)
    assert read.version == "1.0"
    assert read.system.name == "driven"
    assert {each.name for each in read.system.elements} == {"driveline", "engine", "load", "driver"}
    with zipfile.ZipFile(ssp) as archive:
        text = archive.read("SystemStructure.ssd").decode()
    assert f'stopTime="{scenario.stop_time!r}"' in text
    assert f'baseStepSize="{scenario.communication_step!r}"' in text


def test_connections_carry_shafts_torques_and_pedals(packaged: Packaged) -> None:
    assert set(connections(packaged("driven")[0])) == {
        ("driveline", "input.angle", "engine", "shaft.angle"), ("driveline", "input.speed", "engine", "shaft.speed"),
        ("engine", "shaft.torque", "driveline", "input.torque"),
        ("driveline", "output.angle", "load", "shaft.angle"), ("driveline", "output.speed", "load", "shaft.speed"),
        ("load", "shaft.torque", "driveline", "output.torque"),
        ("driveline", "output.speed", "driver", "shaft.speed"),
        ("driver", "driver.throttle", "engine", "driver.throttle"),
        ("driver", "driver.throttle.der1", "engine", "driver.throttle.der1"),
        ("driver", "driver.brake", "load", "driver.brake"),
        ("driver", "driver.brake.der1", "load", "driver.brake.der1"),
    }


@pytest.mark.parametrize("name", ["driven", "gearbox", "moving_joints"])
def test_parameter_sets_and_start_values_both_hold_the_scene(name: str, packaged: Packaged, tmp_path: Path) -> None:
    ssp, scenario, _ = packaged(name)
    taken = {(taker, variable) for _, _, taker, variable in connections(ssp)}
    for component, path in unpack_fmus(ssp, tmp_path).items():
        values = read_ssv(str(ssp), f"resources/{component}.ssv", validate=True)
        assert values.name == "scene"
        with Instance(path, component) as instance:
            for each in values.parameters:
                assert (component, each.name) not in taken
                assert float(instance.get(each.name)) == float(each.value), f"{component}.{each.name}"
            if component == "driveline":
                for key, value in scenario.driveline.items():
                    assert instance.get(key) == value, key
                    assert float(instance.description[key].start) == value
                assert instance.get("model.tolerance") == scenario.tolerance
                assert instance.get("hold.degree") == 0
                assert "solver" not in {each.name for each in values.parameters}


def test_units_of_parts_convert_to_si(packaged: Packaged, tmp_path: Path) -> None:
    engine = read_description(unpack_fmus(packaged("gearbox")[0], tmp_path)["engine"])
    units = {name: variable.unit for name, variable in engine.variables.items()}
    assert units["lag"] == "s"
    assert units["governor.integral_gain"] == "N.m/rad"
    assert units["gearbox.clutch.capacity"] == units["shaft.torque"] == "N.m"
    assert units["gearbox.shift.up"] == units["engine.speed"] == "rad/s"
    assert units["throttle"] == "1"


def test_same_scene_same_bytes(packaged: Packaged, tmp_path: Path) -> None:
    ssp, scenario, _ = packaged("driven")
    again = package(scenario, tmp_path / "other name.ssp")
    assert again.read_bytes() == ssp.read_bytes()


def test_the_package_carries_the_files_of_the_scene(packaged: Packaged) -> None:
    with zipfile.ZipFile(packaged("driven")[0]) as archive:
        driver = zipfile.ZipFile(io.BytesIO(archive.read("resources/driver.fmu")))
    assert "resources/data/0_schedule.csv" in driver.namelist()
    assert {"documentation/licenses/license.txt", "documentation/licenses/pythonfmu.txt"} < set(driver.namelist())


def test_command_line(tmp_path: Path) -> None:
    done = cardan("package", "fligiel", "-o", "system.ssp", "--set", "scene.stop_time=0.01", cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    assert "parameter set scene" in done.stdout
    assert read_ssd(str(tmp_path / "system.ssp")).system.name == "fligiel"


@pytest.mark.parametrize(("arguments", "text"), [
    (["no_such_scene"], "no such scene file"),
    (["fligiel", "--set", "engine.speed=3 kg", "--set", "scene.stop"], "--set scene.stop"),
    (["fligiel", "-o", "system.zip"], "must end with .ssp"),
    (["fligiel", "-o", "folder.ssp"], "is a directory"),
    (["fligiel", "-o", "file.txt/system.ssp"], "cannot be written"),
    (["fligiel", "--fmu", "file.txt"], "file.txt"),
])
def test_bad_input_is_told_and_nothing_is_written(arguments: list[str], text: str, tmp_path: Path) -> None:
    (tmp_path / "file.txt").write_text("no archive")
    (tmp_path / "folder.ssp").mkdir()
    done = cardan("package", *arguments, cwd=tmp_path)
    assert done.returncode == 2
    assert done.stderr.startswith("error: ")
    assert text in done.stderr
    assert sorted(path.name for path in tmp_path.iterdir()) == ["file.txt", "folder.ssp"]


def test_an_fmu_that_is_no_driveline_is_refused(packaged: Packaged, tmp_path: Path) -> None:
    ssp, scenario, _ = packaged("gearbox")
    engine = unpack_fmus(ssp, tmp_path)["engine"]
    with pytest.raises(BuildError, match="no driveline FMU of this project"):
        package(scenario, tmp_path / "system.ssp", engine)


def test_a_scene_that_cannot_start_is_refused_by_the_driveline(tmp_path: Path) -> None:
    scenario = scenes.scenario("feedthrough", tmp_path).with_overrides({"driveline.output.inertia": "0 kg.m2",
                                                                       "driveline.model.fidelity": "compliant",
                                                                       "driveline.shaft.inertia_b": "0 kg.m2"})
    with pytest.raises(BuildError, match="cannot start"):
        package(scenario, tmp_path / "system.ssp")
