"""Reading scenes: forms of names and numbers, defaults, overrides, the record, the shipped scenes."""

from __future__ import annotations

import dataclasses
import json
import math
import pickle
from pathlib import Path

import numpy as np
import pytest
from cardan.models.combined import Combined
from cardan.models.gearbox import Gearbox
from cardan.models.road import RoadLoad
from cardan.scenario import COUPLINGS, Scenario
from cardan_kernel.variables import INDEX, VARIABLES

SCENE = """
[scene]
stop_time = "2 s"

[driveline]
joint1.angle = "20 deg"
"joint2.angle" = "15 deg"
"joint2.angle.der1" = "1 deg/s"
model.fidelity = "rigid"
shaft.stiffness = "8000 N.m/rad"
input.inertia = 0.3

[engine]
type = "constant"
torque = "80 N.m"

[load]
type = "quadratic"
coefficient = "0.01 N.m.s2/rad2"
"""


@pytest.fixture
def file(tmp_path: Path) -> Path:
    path = tmp_path / "car.toml"
    path.write_text(SCENE)
    return path


def test_names_nested_and_quoted_and_units(file: Path) -> None:
    scene = Scenario.load(file)
    assert dict(scene.driveline) == {
        "joint1.angle": pytest.approx(math.radians(20)), "joint2.angle": pytest.approx(math.radians(15)),
        "joint2.angle.der1": pytest.approx(math.radians(1)), "model.fidelity": 1, "shaft.stiffness": 8000.0,
        "input.inertia": 0.3}
    assert isinstance(scene.driveline["model.fidelity"], int)
    assert scene.engine.torque_ == 80.0  # type: ignore[attr-defined]
    assert scene.load.kind == "quadratic" and scene.driver is None
    assert (scene.name, scene.source) == ("car", SCENE)


def test_defaults(file: Path) -> None:
    scene = Scenario.load(file)
    assert (scene.title, scene.stop_time, scene.communication_step) == ("car", 2.0, 1e-3)
    assert (scene.coupling, scene.tolerance) == ("gauss-seidel", 1e-9)
    assert set(scene.outputs) <= set(INDEX) and "output.speed" in scene.outputs
    bare = Scenario.from_dict({"scene": {"stop_time": 1}, "engine": {"type": "speed", "speed": "3000 rpm"}})
    assert bare.load.kind == "constant" and bare.driveline == {"model.drive": 1}


def test_a_scene_is_immutable(file: Path) -> None:
    scene = Scenario.load(file)
    with pytest.raises(dataclasses.FrozenInstanceError):
        scene.stop_time = 3.0  # type: ignore[misc]
    with pytest.raises(TypeError):
        scene.driveline["joint1.angle"] = 0.0  # type: ignore[index]
    with pytest.raises(dataclasses.FrozenInstanceError):
        scene.engine.torque_ = 3.0  # type: ignore[attr-defined]
    scene.to_dict()["driveline"]["joint1"]["angle"] = "40 deg"
    assert Scenario.from_dict(scene.to_dict()).driveline["joint1.angle"] == pytest.approx(math.radians(20))


def test_a_scene_goes_to_other_processes() -> None:
    scene = Scenario.load("pickup_udds").with_overrides({"driveline.joint1.angle": "3 deg"})
    copy = pickle.loads(pickle.dumps(scene))
    assert (copy.driveline, copy.source, copy.overrides) == (scene.driveline, scene.source, scene.overrides)
    assert copy.to_dict() == scene.to_dict() and copy.driver.file == scene.driver.file  # type: ignore[union-attr]
    assert json.loads(json.dumps(scene.to_dict())) == scene.to_dict()


@pytest.mark.parametrize("coupling", COUPLINGS)
def test_every_coupling_is_accepted(file: Path, coupling: str) -> None:
    assert Scenario.load(file).with_overrides({"scene.coupling": coupling}).coupling == coupling


def test_overrides(file: Path) -> None:
    scene = Scenario.load(file)
    other = scene.with_overrides({
        "driveline.joint1.angle": "10 deg", "driveline.joint1.angle.der2": 0.1, "scene.stop_time": "5 s",
        "scene.outputs": "output.speed, ratio", "engine": {"type": "speed", "speed": "10 rpm"},
        "load.coefficient": None, "load.type": "constant", "load.torque": 3, "driveline.model.fidelity": "2"})
    assert other.driveline["joint1.angle"] == pytest.approx(math.radians(10))
    assert other.driveline["joint1.angle.der2"] == 0.1 and other.driveline["model.fidelity"] == 2
    assert other.driveline["joint2.angle"] == scene.driveline["joint2.angle"]
    assert (other.stop_time, other.outputs) == (5.0, ("output.speed", "ratio"))
    assert other.engine.drive == 1 and other.driveline["model.drive"] == 1
    assert other.load.kind == "constant"
    assert scene.stop_time == 2.0 and scene.engine.kind == "constant"  # the original stays
    again = Scenario.from_dict(other.to_dict(), base=other.base)
    assert again.driveline == other.driveline and again.to_dict() == other.to_dict()
    assert other.source == SCENE and other.overrides["scene.stop_time"] == "5 s"
    assert set(other.with_overrides({"scene.title": "x"}).overrides) == {*other.overrides, "scene.title"}


def test_files_are_relative_to_the_scene(tmp_path: Path, file: Path) -> None:
    (tmp_path / "data").mkdir()
    (tmp_path / "data" / "m.csv").write_text("t,M\n0,1\n1,2\n")
    file.write_text(SCENE.replace('type = "constant"\ntorque = "80 N.m"',
                                  'type = "csv"\nfile = "data/m.csv"\ncolumn = "M"'))
    assert Scenario.load(file).engine.next_event(0.0) == 1.0


def test_a_governor_and_a_gearbox_wrap_the_engine() -> None:
    scene = Scenario.load("pickup_udds")
    assert isinstance(scene.engine, Gearbox) and isinstance(scene.engine.source, Combined)
    assert isinstance(scene.load, RoadLoad) and scene.driver is not None
    assert scene.driver.travel == scene.load.travel
    assert scene.driveline["output.inertia"] == scene.load.inertia


def test_lists_share_the_unit_at_their_end() -> None:
    engine = {"type": "map", "speeds": "0, 3000 rpm", "throttles": [0, "100 %"],
              "torques": ["1, 2 N.m", ["3 N.m", "0.004 kN.m"]]}
    made = Scenario.from_dict({"scene": {"stop_time": 1}, "engine": engine}).engine
    assert made.speeds == (0.0, pytest.approx(100 * math.pi))  # type: ignore[attr-defined]
    assert made.throttles == (0.0, 1.0)  # type: ignore[attr-defined]
    assert made.torques == ((1.0, 2.0), (3.0, 4.0))  # type: ignore[attr-defined]


def test_shipped_scenes_are_the_promised_ones_and_all_load() -> None:
    assert set(Scenario.shipped()) == {"pickup_udds", "pickup_udds_full", "fligiel", "brezetic", "engine_start",
                                       "propshaft_highspeed"}
    for name in Scenario.shipped():
        scene = Scenario.load(name)
        assert scene.title != name and scene.source.startswith("#")  # a comment says where the numbers come from
        assert str(scene).startswith(name)
        inputs = {v.name for v in VARIABLES if v.causality != "output"}
        assert set(scene.driveline) <= inputs
    assert Scenario.load("fligiel.toml").name == "fligiel"


def test_the_long_pickup_scene_differs_only_in_its_length() -> None:
    short, full = (Scenario.load(name).to_dict() for name in ("pickup_udds", "pickup_udds_full"))
    assert (short["scene"].pop("stop_time"), full["scene"].pop("stop_time")) == ("200 s", "1369 s")
    del short["scene"]["title"], full["scene"]["title"]
    assert short == full


def test_shipped_numbers_are_those_of_their_sources() -> None:
    """FASTSim's pickup (scenes/data/README.md, vehicle figures) and Fligiel's tube: J = pi rho L (D^4 - d^4) / 32."""
    pickup = Scenario.load("pickup_udds").load
    assert isinstance(pickup, RoadLoad)
    assert (pickup.mass, pickup.drag_coefficient, pickup.frontal_area, pickup.rolling) == (2325.0, 0.4, 2.88, 0.009)
    assert (pickup.wheel_radius, pickup.wheel_inertia, pickup.wheels) == (0.4064, 2.38, 4)
    inertia = math.pi * 7860.0 * 1.5 * (0.08**4 - 0.076**4) / 32.0
    assert Scenario.load("fligiel").driveline["output.inertia"] == pytest.approx(inertia, abs=5e-7)
    engine = Scenario.load("pickup_udds").engine.source.first  # type: ignore[attr-defined]
    full = dict(zip(engine.speeds, engine.torques[-1]))
    assert max(w * torque for w, torque in full.items()) == pytest.approx(135e3, rel=0.005)
    assert max(full.values()) == 500.0


def test_numpy_numbers_are_numbers() -> None:
    made = Scenario.from_dict({
        "scene": {"stop_time": np.float32(2.0), "sweeps": np.int64(2)}, "driveline": {"model.fidelity": np.int64(2)},
        "engine": {"type": "map", "speeds": np.array([0.0, 1.0]), "throttles": [np.int64(0), np.float64(1.0)],
                   "torques": np.ones((2, 2))}})
    assert (made.stop_time, made.sweeps, made.driveline["model.fidelity"]) == (2.0, 2, 2)
    json.dumps(made.to_dict())
