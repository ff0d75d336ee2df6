"""Bad scenes: everything that is wrong is reported at once, with file, key, value, reason, range and nearest name."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import pytest
from cardan.models.base import Model
from cardan.models.catalog import DRIVERS, ENGINES, LOADS
from cardan.models.clutch import Clutch
from cardan.models.cylinder import Cylinder
from cardan.models.gearbox import Gearbox
from cardan.models.governor import IdleGovernor
from cardan.models.parameters import Key, key_name, keys_of
from cardan.models.shift import ShiftSchedule
from cardan.scenario import COUPLINGS, Problem, Scenario, ScenarioError
from cardan.scenario.tables import SceneTable
from cardan_kernel.variables import VARIABLES

GOOD: dict[str, Any] = {"scene": {"stop_time": 1.0}, "engine": {"type": "constant", "torque": 1.0},
                        "load": {"type": "constant", "torque": 1.0}}


def problems(**changes: Any) -> tuple[Problem, ...]:
    tables = {**GOOD, **{name: {**GOOD.get(name, {}), **table} if isinstance(table, dict) else table
                         for name, table in changes.items()}}
    with pytest.raises(ScenarioError) as caught:
        Scenario.from_dict({name: table for name, table in tables.items() if table is not None}, file="bad.toml")
    assert all(problem.file == "bad.toml" for problem in caught.value.problems)
    assert str(caught.value) == "\n".join(map(str, caught.value.problems))
    return caught.value.problems


def one(**changes: Any) -> Problem:
    found = problems(**changes)
    assert len(found) == 1, found
    return found[0]


def test_everything_is_reported_at_once(tmp_path: Path) -> None:
    path = tmp_path / "bad.toml"
    path.write_text("""
[scene]
stop_tme = "2 s"
communication_step = "-1 ms"
coupling = "gaus-seidel"
tolerance = 0
[driveline]
joint1.angel = "10 deg"
joint2.angle = "90 deg"
input.inertia = "-1 kg.m2"
shaft.stiffness = "8000 N.m"
shaft.damping = nan
[engine]
type = "constant"
torqe = "80 N.m"
[load]
type = "quadratik"
[diver]
file = "x"
""")
    with pytest.raises(ScenarioError) as caught:
        Scenario.load(path)
    found = {p.key: p for p in caught.value.problems}
    assert len(found) == len(caught.value.problems) == 14
    expected = {
        "diver": ("", "driver"), "scene.stop_tme": ("'2 s'", "stop_time"), "scene.stop_time": ("", ""),
        "scene.communication_step": ("'-1 ms'", ""), "scene.coupling": ("'gaus-seidel'", "gauss-seidel"),
        "scene.tolerance": ("0", ""), "driveline.joint1.angel": ("'10 deg'", "joint1.angle"),
        "driveline.joint2.angle": ("'90 deg'", ""), "driveline.input.inertia": ("'-1 kg.m2'", ""),
        "driveline.shaft.stiffness": ("'8000 N.m'", ""), "driveline.shaft.damping": ("nan", ""),
        "engine.torqe": ("'80 N.m'", "torque"), "engine.torque": ("", ""), "load.type": ("'quadratik'", "quadratic")}
    assert {key: (p.value, p.nearest) for key, p in found.items()} == expected
    assert found["driveline.joint2.angle"].allowed == "[0, 1.570796327) rad = [0, 90) deg"
    assert found["driveline.input.inertia"].allowed == ">= 0 kg.m2"
    assert found["scene.tolerance"].allowed == "[1e-13, 0.1]"
    assert "expected unit N.m/rad, for example '8000 N.m/rad'" in found["driveline.shaft.stiffness"].why
    text = str(caught.value)
    assert text.count(str(path)) == 14
    assert f"{path}: engine.torqe = '80 N.m': unknown key of [engine] 'torqe'; did you mean 'torque'?" in text


def test_missing_file_names_the_shipped_scenes() -> None:
    with pytest.raises(ScenarioError, match="no such scene file") as caught:
        Scenario.load("pickup_uds")
    assert caught.value.problems[0].nearest == "pickup_udds"
    assert "fligiel" in caught.value.problems[0].allowed


def test_a_folder_and_broken_toml_and_bytes(tmp_path: Path) -> None:
    with pytest.raises(ScenarioError, match="is a folder"):
        Scenario.load(tmp_path)
    path = tmp_path / "a.toml"
    path.write_text("[scene]\nstop_time = \n")
    with pytest.raises(ScenarioError, match=r"no valid TOML.*line 2"):
        Scenario.load(path)
    path.write_text('[driveline]\njoint1.angle = 1\njoint1.angle.der1 = 2\n')
    with pytest.raises(ScenarioError, match="no valid TOML"):
        Scenario.load(path)
    path.write_bytes(b"\xff\xfe\x00")
    with pytest.raises(ScenarioError, match="cannot be read"):
        Scenario.load(path)


@pytest.mark.parametrize(("table", "key"), [
    ({"stop_time": 0}, "stop_time"), ({"stop_time": "inf s"}, "stop_time"), ({"stop_time": math.nan}, "stop_time"),
    ({"stop_time": -1}, "stop_time"), ({"stop_time": "1 m"}, "stop_time"), ({"stop_time": True}, "stop_time"),
    ({"stop_time": [1]}, "stop_time"), ({"communication_step": 0}, "communication_step"),
    ({"communication_step": 2.0}, "communication_step"), ({"communication_step": "1 kg"}, "communication_step"),
    ({"tolerance": 0.2}, "tolerance"), ({"tolerance": 1e-14}, "tolerance"), ({"tolerance": "fine"}, "tolerance"),
    ({"coupling": "euler"}, "coupling"), ({"coupling": 3}, "coupling"), ({"title": 3}, "title"),
    ({"outputs": []}, "outputs"), ({"outputs": 3}, "outputs"), ({"outputs": [3]}, "outputs"),
    ({"outputs": ["output.sped"]}, "outputs"), ({"outputs": ["ratio", "ratio"]}, "outputs"),
    ({"outputs": ["input.inertia"]}, "outputs"), ({"outputs": ["engine.speed"]}, "outputs"), ({"step": 1}, "step"),
])
def test_scene_table(table: dict[str, Any], key: str) -> None:
    assert one(scene=table).key == f"scene.{key}"


def test_messages_say_the_choices_and_the_nearest() -> None:
    coupling = one(scene={"coupling": "hermit3"})
    assert coupling.nearest == "hermite3" and coupling.allowed == ", ".join(COUPLINGS)
    assert one(scene={"outputs": ["output.sped"]}).nearest == "output.speed"
    assert one(scene={"communication_step": 2.0}).allowed == "(0, 1] s"
    assert one(engine={"type": "fourstroke", "torque": 1}).nearest == "four_stroke"
    assert one(load={"type": ["constant"]}).key == "load.type"
    assert one(engine=None).allowed == "type = one of " + ", ".join(ENGINES)


@pytest.mark.parametrize("table", [3, "constant", [1]])
@pytest.mark.parametrize("name", ["scene", "driveline", "engine", "load", "driver"])
def test_a_table_must_be_a_table(name: str, table: Any) -> None:
    assert any(p.key == name and "must be a table" in p.why for p in problems(**{name: table}))


@pytest.mark.parametrize("variable", [v for v in VARIABLES if v.causality != "output"], ids=lambda v: v.name)
def test_each_driveline_variable(variable: Any) -> None:
    """Not finite, wrong type, wrong unit, below and above its range: each is refused by name. What another table
    decides cannot be set here at all."""
    bad: list[Any] = [math.nan, math.inf, "many", True, [1.0], "3 kg/h"]
    if variable.minimum is not None:
        bad.append(variable.minimum - 1)
    if variable.maximum is not None:
        bad.append(variable.maximum + 1)
    for value in bad:
        problem = one(driveline={variable.name: value})
        assert problem.key == f"driveline.{variable.name}" and problem.value == repr(value)
    elsewhere = variable.name.startswith(("input.torque", "output.torque", "input.speed_command", "hold.")) or \
        variable.name in ("model.drive", "model.tolerance")
    assert elsewhere == ("cannot be set here" in one(driveline={variable.name: math.nan}).why)


def test_outputs_cannot_be_set_and_names_not_twice() -> None:
    assert "output of the FMU" in one(driveline={"output.speed": 1.0}).why
    assert "twice" in one(driveline={"joint1.angle": 0.1, "joint1": {"angle": 0.1}}).why


NESTED: dict[str, tuple[type, tuple[str, ...]]] = {
    "engine.governor": (IdleGovernor, ("governor",)), "engine.gearbox": (Gearbox, ("gearbox",)),
    "engine.gearbox.clutch": (Clutch, ("gearbox", "clutch")),
    "engine.gearbox.shift": (ShiftSchedule, ("gearbox", "shift")),
    "engine.cylinder": (Cylinder, ("cylinder",))}


def declared() -> list[tuple[str, str, str, Key]]:
    """Return (table, type, key, declaration) of every key of every model, nested tables included."""
    found = [("scene", "", key_name(f), key) for f, (key, _) in keys_of(SceneTable).items()]
    for path, kinds in (("engine", ENGINES), ("load", LOADS), ("driver", DRIVERS)):
        for kind, model in kinds.items():
            found += [(path, kind, key_name(f), key) for f, (key, _) in keys_of(model).items()]
    for path, (nested, _) in NESTED.items():
        found += [(path, "four_stroke", key_name(f), key) for f, (key, _) in keys_of(nested).items()]
    return found


def wrong(key: Key) -> list[Any]:
    values: list[Any] = {"text": [3], "file": [3, "none.csv"], "choice": ["nonsense", 3], "table": [3],
                         "grid": [3, [3], [["x"]]], "boolean": ["x", 3]}.get(key.kind, ["nonsense"])
    if key.kind in ("real", "reals", "integer"):
        numbers: list[Any] = [math.nan, math.inf, "1 kg.s3"]
        if key.minimum is not None:
            numbers += [key.minimum - 1] + ([key.minimum] if key.above else [])
        if key.maximum is not None:
            numbers += [key.maximum + 1] + ([key.maximum] if key.below else [])
        if key.kind == "integer":
            numbers.append(1.5)
        values = values + ([[n] for n in numbers] if key.kind == "reals" else numbers)
    return values


@pytest.mark.parametrize(("path", "kind", "name", "key"), declared(), ids=lambda v: v if isinstance(v, str) else "")
def test_each_key_of_each_model(path: str, kind: str, name: str, key: Key) -> None:
    """Every wrong value of every key is reported under that key (other keys may be missing as well)."""
    for value in wrong(key):
        table: Any = {name: value}
        if path in NESTED:
            for part in reversed(NESTED[path][1]):
                table = {part: table}
        head = path.partition(".")[0]
        if kind:
            table = {"type": kind, **table}
        with pytest.raises(ScenarioError) as caught:
            Scenario.from_dict({**GOOD, head: table, **({"load": {"type": "road", "mass": 1, "wheel_radius": 1}}
                                                       if head == "driver" else {})})
        keys = [p.key for p in caught.value.problems]
        assert any(k == f"{path}.{name}" or k.startswith(f"{path}.{name}[") for k in keys), (value, keys)


@pytest.mark.parametrize(("path", "kind"), [("engine", kind) for kind in ENGINES] + [("load", kind) for kind in LOADS])
def test_each_model_names_its_missing_and_its_unknown_keys(path: str, kind: str) -> None:
    model: type[Model] = (ENGINES if path == "engine" else LOADS)[kind]
    required = {f"{path}.{key_name(f)}" for f, (_, needed) in keys_of(model).items() if needed}
    with pytest.raises(ScenarioError) as caught:
        Scenario.from_dict({**GOOD, path: {"type": kind, "colour": "red"}})
    assert {p.key for p in caught.value.problems} == required | {f"{path}.colour"}
    assert next(p for p in caught.value.problems if p.key == f"{path}.colour").nearest


def test_problems_between_keys_carry_their_key() -> None:
    assert one(load={"type": "stribeck", "torque": None, "sliding": 3, "breakaway": 2}).key != ""
    found = problems(load=None, engine={"type": "four_stroke", "orders": [2], "amplitudes": [1, 2]})
    assert [p.key for p in found] == ["engine.amplitudes"]


def test_a_driver_needs_a_road_and_a_speed_engine_takes_no_gearbox() -> None:
    assert "road" in one(driver={"file": "x.csv"}).why
    found = problems(engine={"type": "speed", "speed": 1.0, "gearbox": {}, "torque": 1.0})
    assert {p.key for p in found} == {"engine.gearbox", "engine.torque"}


def test_problems_of_engine_and_gearbox_come_together() -> None:
    found = problems(engine={"type": "constant", "torque": "x", "gearbox": {"ratios": [1], "clutch": {"capacity": -1}}})
    keys = {p.key for p in found}
    assert {"engine.torque", "engine.gearbox.clutch.capacity", "engine.gearbox.engine_inertia"} <= keys


def test_csv_files_and_columns(tmp_path: Path) -> None:
    (tmp_path / "m.csv").write_text("t,torque\n0,1\n1,2\n")
    scene = {**GOOD, "engine": {"type": "csv", "file": "n.csv", "column": "torque"}}
    with pytest.raises(ScenarioError) as caught:
        Scenario.from_dict(scene, base=tmp_path)
    assert (caught.value.problems[0].key, caught.value.problems[0].nearest) == ("engine.file", "m.csv")
    scene["engine"] = {"type": "csv", "file": "m.csv", "column": "torqe"}
    with pytest.raises(ScenarioError, match="nearest: torque") as caught:
        Scenario.from_dict(scene, base=tmp_path)
    assert caught.value.problems[0].key == "engine.column"


def test_overrides_are_checked_like_the_file() -> None:
    with pytest.raises(ScenarioError) as caught:
        Scenario.load("fligiel").with_overrides({"driveline.joint1.angle": "91 deg", "scene.stop": 1, "engin.x": 2})
    assert {p.key for p in caught.value.problems} == {"driveline.joint1.angle", "scene.stop", "engin"}


def test_empty_tables_in_the_driveline_are_reported() -> None:
    assert one(driveline={"joint1.angle": {}}).key == "driveline.joint1.angle"
    found = one(driveline={"joint1": {"angel": {}}})
    assert (found.key, found.nearest) == ("driveline.joint1.angel", "joint1.angle")


def test_the_inertia_of_a_road_vehicle_is_not_given_twice() -> None:
    with pytest.raises(ScenarioError, match="leave one out") as caught:
        Scenario.from_dict({**GOOD, "load": {"type": "road", "mass": 1000, "wheel_radius": 0.3},
                            "driveline": {"output.inertia": 1}})
    assert [p.key for p in caught.value.problems] == ["driveline.output.inertia"]


@pytest.mark.parametrize("value", [10**400, -10**5000, "1 km999", "\u00b2", "\u0663"],
                         ids=["large", "huge", "power", "square", "arabic"])
def test_numbers_that_python_cannot_take_are_reported(value: Any) -> None:
    assert one(scene={"stop_time": value}).key == "scene.stop_time"
    assert one(scene={"sweeps": value}).key == "scene.sweeps"
    assert one(driveline={"joint1.angle": value}).key == "driveline.joint1.angle"
    assert one(driveline={"model.fidelity": value}).key == "driveline.model.fidelity"
    assert [p.value for p in problems(scene={"sweeps": value})] != [""]


def test_driveline_variables_outside_their_table() -> None:
    for name, hint in (("joint1.angle", "joint1.angle"), ("joint1.angel", "joint1.angle")):
        with pytest.raises(ScenarioError, match=f"did you mean 'driveline.{hint}'") as caught:
            Scenario.from_dict(GOOD).with_overrides({name: "10 deg"})
        assert [p.key for p in caught.value.problems] == [name]


def test_a_driver_needs_an_engine_with_a_throttle(tmp_path: Path) -> None:
    (tmp_path / "s.csv").write_text("t,speed [km/h]\n0,0\n10,36\n")
    scene: dict[str, Any] = {"scene": {"stop_time": 1.0}, "load": {"type": "road", "mass": 1000, "wheel_radius": 0.3},
                             "driver": {"file": "s.csv"}, "engine": {"type": "constant", "torque": 1.0}}
    with pytest.raises(ScenarioError, match="throttle"):
        Scenario.from_dict(scene, tmp_path)
    scene["engine"] = {"type": "map", "speeds": [0, 1], "throttles": [0, 1], "torques": [[0, 0], [1, 1]]}
    driver = Scenario.from_dict(scene, tmp_path).driver
    assert driver is not None and driver.target(5.0)[0] == pytest.approx(5.0)


def test_what_is_no_table_of_texts() -> None:
    with pytest.raises(TypeError, match="dictionary of tables"):
        Scenario.from_dict(None)  # type: ignore[arg-type]
    assert one(scene={1: 2}).key == "scene.1"
    with pytest.raises(TypeError, match="override"):
        Scenario.from_dict(GOOD).with_overrides({1: 2})  # type: ignore[dict-item]


@pytest.mark.parametrize(("load", "key"), [
    ({"type": "power", "coefficient": 1, "exponent": 2, "reference": 1e-300}, "load.reference"),
    ({"type": "road", "mass": 1, "wheel_radius": 1, "wheel_inertia": 1, "axle_ratio": 1e-300}, "load.axle_ratio"),
    ({"type": "road", "mass": 1, "wheel_radius": 1e200}, "load"),
    ({"type": "dyno", "speed": 1, "gain": 1, "integral_gain": 1, "torque_limit": 1, "rounding": 1e-300},
     "load.rounding"),
])
def test_values_that_leave_the_range_of_numbers_are_reported(load: dict[str, Any], key: str) -> None:
    with pytest.raises(ScenarioError) as caught:
        Scenario.from_dict({**GOOD, "load": load})
    assert [p.key for p in caught.value.problems] == [key]
