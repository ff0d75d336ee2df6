"""Engine or load from an FMU of another author: other names, other units, other sign, no state saving."""

from __future__ import annotations

import math
import shutil
import subprocess
import sys
import zipfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from cardan import Scenario, simulate
from cardan.errors import FmuError
from cardan.models.base import Bus, Shaft
from cardan.models.foreign import ForeignFmu, Names
from cardan.scenario import ScenarioError
from cardan_build.system import package
from cardan_build.system.assembly import unpack_fmus
from numpy.typing import NDArray
from system import scenes
from system.conftest import Packaged

RPM = math.pi / 30.0
FAN = {"torque": "M", "speed": "n"}
PART = {"torque": "shaft.torque", "speed": "shaft.speed", "angle": "shaft.angle"}
Run = Callable[[str, Path, float, int, list[str]], NDArray[np.float64]]


@pytest.fixture(scope="module")
def fan(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The fan as a native FMU."""
    compiler = shutil.which("gcc") or shutil.which("cc")
    if compiler is None or sys.platform != "linux":
        pytest.skip("no C compiler for Linux is installed here")
    folder = tmp_path_factory.mktemp("fan")
    here = Path(__file__).parent
    subprocess.run([compiler, "-D_GNU_SOURCE", "-shared", "-fPIC", "-O2", "-Wall", "-Werror", "-o",
                    str(folder / "Fan.so"), str(here / "fan.c"), "-lm"], check=True)
    with zipfile.ZipFile(folder / "Fan.fmu", "w") as archive:
        archive.write(here / "fan.xml", "modelDescription.xml")
        archive.write(folder / "Fan.so", "binaries/linux64/Fan.so")
    return folder / "Fan.fmu"


def at_speed(load: dict[str, Any], coupling: str = "held") -> Scenario:
    """A straight rigid shaft turned at 1500 rpm."""
    scene = {"stop_time": 0.3, "communication_step": 1e-3, "coupling": coupling,
             "outputs": ["output.speed", "output.torque", "input.reaction_torque"]}
    return Scenario.from_dict({"scene": scene, "driveline": {"model.fidelity": 1}, "load": load,
                               "engine": {"type": "speed", "speed": "1500 rpm"}})


@pytest.mark.parametrize("coupling", ["held", "gauss-seidel", "slope"])
def test_units_sign_and_parameters_are_the_fmus_own(coupling: str, fan: Path) -> None:
    load = {"type": "fmu", "fmu": str(fan), "names": FAN, "factor": -1.0, "parameters": "k = 2e-5; tau = 0.05"}
    result = simulate(at_speed(load, coupling))
    assert result.info.completed
    # tau dM/dt = k n^2 - M at constant n, from rest: exact, for the fan solves it exactly
    exact = 2e-5 * 1500.0**2 * -np.expm1(-result.time / 0.05)
    assert np.abs(result["output.torque"] - exact).max() < 1e-11
    # what the drive has to supply at the end of a step is what was held over it
    if coupling != "slope":
        assert np.abs(result["input.reaction_torque"][1:] - exact[:-1]).max() < 1e-9


def test_recorded_outputs_keep_their_unit(fan: Path) -> None:
    load = {"type": "fmu", "fmu": str(fan), "names": FAN, "factor": -1.0, "record": "M"}
    scenario = at_speed(load).with_overrides({"scene.outputs": ["output.torque", "Fan.M"]})
    result = simulate(scenario)
    assert result.units["Fan.M"] == "N.m"
    assert np.array_equal(result["Fan.M"], -result["output.torque"])


def test_a_refused_step_ends_the_run_with_the_fmus_own_words(fan: Path) -> None:
    load = {"type": "fmu", "fmu": str(fan), "names": FAN, "factor": -1.0}
    scenario = at_speed(load).with_overrides({"engine.final_speed": "20000 rpm", "engine.ramp_time": "0.1 s"})
    result = simulate(scenario)
    assert not result.info.completed
    assert "rpm: the blades have left" in result.info.message
    assert 0.03 < result.info.reached_time < 0.05  # 9000 rpm are reached at 0.0405 s


def test_a_part_as_foreign_fmu_gives_what_the_model_gives(packaged: Packaged, tmp_path: Path) -> None:
    ssp, scenario, native = packaged("gearbox")
    fmus = unpack_fmus(ssp, tmp_path)
    foreign = {side: {"type": "fmu", "fmu": str(fmus[side]), "names": PART} for side in ("engine", "load")}
    result = simulate(scenario.with_overrides(foreign))
    for name in scenes.OUTPUTS:
        assert np.array_equal(result[name], native[name]), name


def test_a_gearbox_can_have_a_foreign_engine(packaged: Packaged, tmp_path: Path) -> None:
    # An engine without states, so that being stepped along makes no difference, and no shift, which would move the
    # throttle: that is a parameter of the packaged engine.
    scenario = packaged("gearbox")[1].with_overrides({
        "engine.lag": None, "engine.governor": None, "engine.gearbox.shift.up": 900,
        "engine.gearbox.shift.up_full": 900})
    engine = scenario.with_overrides({"engine.gearbox": None})
    fmu = unpack_fmus(package(engine, tmp_path / "engine.ssp"), tmp_path)["engine"]
    names = {name: each for name, each in PART.items() if name != "angle"}
    table = {"type": "fmu", "fmu": str(fmu), "names": names, "gearbox": scenario.to_dict()["engine"]["gearbox"]}
    native, foreign = simulate(scenario), simulate(scenario.with_overrides({"engine": table}))
    assert np.abs(foreign["input.speed"] - native["input.speed"]).max() < 1e-10


def at(speed: float) -> Shaft:
    return Shaft(0.0, speed, 0.0)


def test_without_saved_states_there_is_no_way_back(fan: Path) -> None:
    model = ForeignFmu(fmu=fan, names=Names(**FAN), factor=-1.0)
    assert model.stepped
    assert not model.rolls_back
    model.start(0.0, at(100.0), Bus())
    later = model.torque(0.01, (), at(100.0), Bus())
    assert later.value == pytest.approx(1e-4 * (100.0 / RPM) ** 2 * -math.expm1(-0.1), rel=1e-12)
    assert model.torque(0.01, (), at(300.0), Bus()) == later  # at the same time: no step
    with pytest.raises(FmuError, match=r"Fan\.fmu cannot go back in time .*coupling = 'held'"):
        model.torque(0.005, (), at(100.0), Bus())
    model.start(0.0, at(100.0), Bus())  # a new run
    assert model.torque(0.01, (), at(100.0), Bus()) == later


def test_with_saved_states_a_step_can_be_repeated(packaged: Packaged, tmp_path: Path) -> None:
    engine = unpack_fmus(packaged("gearbox")[0], tmp_path)["engine"]
    model = ForeignFmu(fmu=engine, names=Names(**PART))
    assert model.rolls_back
    model.start(0.0, at(30.0), Bus())
    points = [(1e-3 * i, 30.0 + 2.0 * i) for i in range(6)]
    first = [model.torque(t, (), at(speed), Bus()) for t, speed in points]
    for back in (5, 4, 3):
        again = [model.torque(t, (), at(speed), Bus()) for t, speed in points[back - 1:]]
        assert again == first[back - 1:]
    shorter = model.torque(4.5e-3, (), at(39.0), Bus())  # back to 4 ms, and half a step from there
    assert shorter != first[4]
    assert model.torque(5e-3, (), at(40.0), Bus()).value == pytest.approx(first[5].value, rel=1e-3)
    with pytest.raises(FmuError, match="keeps the last 4 states"):
        model.torque(0.0, (), at(30.0), Bus())


@pytest.mark.parametrize(("change", "text"), [
    ({"names": {"torque": "M", "speed": "nn"}}, "load.names.speed = 'nn': no such variable in Fan.fmu; nearest: n"),
    ({"names": {"torque": "n"}}, "load.names.torque = 'n': has causality input in Fan.fmu; allowed: output or local"),
    ({"names": {"torque": "M", "angle": "n"}},
     "load.names.angle = 'n': is in rpm; allowed: a unit that converts to rad"),
    ({"names": None}, "load.names: missing"),
    ({"parameters": "k"}, "load.parameters = 'k': is not of the form NAME = VALUE"),
    ({"parameters": "q = 1"}, "load.parameters = 'q': no such variable in Fan.fmu"),
    ({"parameters": "k = much"}, "load.parameters = 'k = much': is no value of type Real"),
    ({"record": "heat"}, "load.record = 'heat': no such variable in Fan.fmu"),
    ({"fmu": __file__}, "is not an FMU: it is no zip archive"),
    ({"fmu": "none.fmu"}, "load.fmu = 'none.fmu': no such file"),
])
def test_a_mapping_that_does_not_fit_is_told(change: dict[str, Any], text: str, fan: Path) -> None:
    load = {"type": "fmu", "fmu": str(fan), "names": FAN, **change}
    with pytest.raises(ScenarioError) as found:
        at_speed({key: value for key, value in load.items() if value is not None})
    assert text in str(found.value)


@pytest.mark.parametrize("tool", ["ecos", "libcosim"])
def test_a_package_takes_the_foreign_fmu_as_it_is(tool: str, fan: Path, tmp_path: Path, run_in: Run) -> None:
    load = {"type": "fmu", "fmu": str(fan), "names": FAN, "factor": -1.0, "parameters": "k = 2e-5; tau = 0.05"}
    scenario = at_speed(load)
    ssp = package(scenario, tmp_path / "fan.ssp")
    assert unpack_fmus(ssp, tmp_path)["load"].read_bytes() == fan.read_bytes()
    result = simulate(scenario)
    rows = run_in(tool, ssp, 1e-3, 300, ["driveline.output.speed", "driveline.input.reaction_torque"])
    # the fan's torque is a state: exchanged in the order of cardan's own coupling
    assert result["input.reaction_torque"][-1] > 40.0
    for column, name in zip(rows.T, ("output.speed", "input.reaction_torque")):
        assert np.abs(column - result[name][1:]).max() < 1e-9
