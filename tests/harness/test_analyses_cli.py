"""``cardan linearize``, ``cardan stability`` and ``cardan orders``: files, JSON, messages and exit codes."""

from __future__ import annotations

import csv
import json
import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import cardan
import numpy as np
import pytest
from cardan.cli.app import app
from typer.testing import CliRunner, Result

DRIVELINE = """
[scene]
title = "50 Hz driveline"
stop_time = "0.3 s"
communication_step = "0.2 ms"
outputs = ["input.angle", "input.speed", "shaft.torque"]
[driveline]
joint1.angle = "15 deg"
shaft.stiffness = "18000 N.m/rad"
shaft.damping = 4.0
initial.speed = "3000 rpm"
[engine]
type = "constant"
torque = "100 N.m"
[load]
type = "quadratic"
coefficient = 0.001
"""
PAIR = """
[scene]
stop_time = "1 s"
communication_step = "1 ms"
outputs = ["input.speed"]
[driveline]
joint1.angle = "20 deg"
joint2.angle = "20 deg"
shaft.inertia_a = 0.0
shaft.inertia_b = 0.0
shaft.damping = 0.0
[engine]
type = "speed"
speed = "1000 rpm"
[load]
type = "constant"
torque = 0.0
"""

Run = Callable[..., Result]


@pytest.fixture
def run(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Run:
    """Run a command in a folder with the scenes ``driveline.toml`` and ``pair.toml``."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "driveline.toml").write_text(DRIVELINE)
    (tmp_path / "pair.toml").write_text(PAIR)
    return lambda *arguments: CliRunner().invoke(app, [str(a) for a in arguments])


def test_linearize_writes_response_and_picture(run: Run, tmp_path: Path) -> None:
    found = run("linearize", "driveline.toml", "--input", "input.torque", "--output", "output.speed,shaft.torque",
                "--frequencies", "10,20,50", "--speed", "3000 rpm", "-o", "r.csv", "--plot", "r.png")
    assert found.exit_code == 0, found.output
    assert "3000 rpm, mean torque" in found.output
    assert "50 Hz: a sideband falls on the input's line" in found.output
    lines = list(csv.DictReader((tmp_path / "r.csv").read_text().splitlines()))
    assert len(lines) == 3 * 2 * 7
    assert {line["flagged"] for line in lines if line["frequency_hz"] == "50.0"} == {"1"}
    made = cardan.linearize(cardan.Scenario.load("driveline.toml"), "input.torque", "output.speed,shaft.torque",
                            frequencies="10,20,50", speed="3000 rpm")
    for line in lines:
        if line["flagged"] == "0":
            i = [10.0, 20.0].index(float(line["frequency_hz"]))
            value = made.response.line(line["output"], int(line["harmonic"]))[i]
            assert complex(float(line["real"]), float(line["imag"])) == value
    assert (tmp_path / "r.png").stat().st_size > 10_000


@pytest.mark.parametrize("kind", ["nyquist", "poles", "waterfall"])
def test_linearize_pictures(run: Run, tmp_path: Path, kind: str) -> None:
    found = run("linearize", "driveline.toml", "--frequencies", "2:98:40", "--speed", "3000 rpm", "--plot", "r.png",
                "--plot-kind", kind, "--absolute", "--rad", "--json")
    assert found.exit_code == 0, found.output
    assert (tmp_path / "r.png").stat().st_size > 10_000


def test_linearize_json(run: Run) -> None:
    found = json.loads(run("linearize", "driveline.toml", "--frequencies", "10,50", "--speed", "3000 rpm",
                           "--json").stdout)
    assert found["method"] == "hill"
    assert found["flagged_hz"] == [50.0]
    point = found["operating_point"]
    assert point["speed"] == pytest.approx(100.0 * math.pi)
    assert point["stable"] is True
    assert point["residual"] < 1e-12
    assert len(point["multipliers"]) == 3
    assert [row["flagged"] for row in found["response"]] == [False, True]
    assert found["response"][1]["real"] is None


@pytest.mark.parametrize(("arguments", "words"), [
    (["--input", "engine.torque"], "--input engine.torque: unknown signal"),
    (["--output", "nothing"], "--output nothing: unknown signal"),
    (["--frequencies", "0,10"], "0 Hz is no frequency of a sine"),
    (["--frequencies", "3000", "--measure"], "the Nyquist frequency of the measurement"),
    (["--set", "load.type=constant", "--set", "load.torque=0", "--set", "load.coefficient=1"], "unknown key"),
    (["--plot", "r.gif"], "unknown ending '.gif'"),
    (["--plot", "r.png", "--plot-kind", "pie"], "--plot-kind pie: choose one of bode"),
    (["--fmu", "missing.fmu", "--method", "fmu"], "missing.fmu"),
])
def test_linearize_refuses(run: Run, tmp_path: Path, arguments: list[str], words: str) -> None:
    found = run("linearize", "driveline.toml", "--speed", "3000 rpm", "-o", "r.csv", *arguments)
    assert found.exit_code == 2
    assert words in found.stderr
    assert not (tmp_path / "r.csv").exists()


def test_no_steady_state_and_unstable_points(run: Run) -> None:
    free = ["--set", 'load={type="constant", torque=0.0}', "--set", "engine.torque=0", "--set",
            "driveline.shaft.damping=0"]
    found = run("linearize", "driveline.toml", *free, "--speed", "3000 rpm", "--json")
    assert found.exit_code == 2
    assert "no steady state" in json.loads(found.stdout)["errors"][0]
    unstable = ["--set", "driveline.joint1.angle=30 deg", "--set", "driveline.shaft.damping=1", "--speed", "3000 rpm"]
    found = run("linearize", "driveline.toml", *unstable, "--frequencies", "10")
    assert found.exit_code == 0
    assert "warning: the steady state at 3000 rpm is unstable" in found.stderr
    found = run("linearize", "driveline.toml", *unstable, "--frequencies", "10", "--measure")
    assert found.exit_code == 2
    assert "error: --measure: the steady state at 3000 rpm is unstable" in found.stderr


def test_stability_json_has_the_transitions(run: Run, tmp_path: Path) -> None:
    found = run("stability", "pair.toml", "--speed", "500 rpm:1500 rpm:10", "--angle", "15 deg:30 deg:2", "--json",
                "-o", "s.csv", "--plot", "s.png")
    assert found.exit_code == 0, found.output
    chart = json.loads(found.stdout)
    natural = math.sqrt(2e4 / 1.5)
    principal = [t for t in chart["transitions"] if t["region"] == 1]
    assert [t["angle"] for t in principal] == pytest.approx([math.radians(15.0), math.radians(30.0)])
    for t, (low, high) in zip(principal, [(0.9828906982969513, 1.0175600156512447),
                                          (0.9319210110795295, 1.0758397621398706)]):
        assert (t["speed_low"], t["speed_high"]) == pytest.approx((low * natural, high * natural), rel=1e-10)
        assert t["growth_per_turn"] > 0.1
        assert t["type"] == "principal"
    assert all(c["parameter"] == "output.damping" for c in chart["critical_damping"])
    table = np.loadtxt(tmp_path / "s.csv", delimiter=",", skiprows=1)
    assert table.shape == (20, 3)
    assert (tmp_path / "s.png").stat().st_size > 10_000


def test_stability_table_and_refusals(run: Run) -> None:
    found = run("stability", "pair.toml", "--speed", "1000 rpm,1100 rpm,1200 rpm")
    assert found.exit_code == 0, found.output
    assert "1 principal" in found.output
    assert "critical output.damping at 20 deg: 10.799" in found.output
    for arguments, words in ((["--speed", "0:10:3"], "all speeds must be above 0"),
                             (["--angle", "95 deg"], "must be at least 0 and below 90 deg"),
                             (["--set", "driveline.model.fidelity=rigid"], "a rigid driveline has no twist")):
        found = run("stability", "pair.toml", *arguments)
        assert found.exit_code == 2
        assert words in found.stderr


def test_orders_of_a_saved_run(run: Run, tmp_path: Path) -> None:
    assert run("simulate", "driveline.toml", "-o", "d.csv").exit_code == 0
    found = run("orders", "d.csv", "--signal", "shaft.torque", "--track", "2", "-o", "o.csv", "--plot", "o.png",
                "--campbell", "c.png", "--json")
    assert found.exit_code == 0, found.output
    summary: dict[str, Any] = json.loads(found.stdout)
    assert summary["signals"]["shaft.torque"]["leading"][0]["order"] == 2.0
    assert [c["order"] for c in summary["campbell"]["crossings"]] == [6.0, 4.0, 2.0]
    for name in ("o.png", "c.png"):
        assert (tmp_path / name).stat().st_size > 10_000
    assert (tmp_path / "o.csv").read_text().startswith("order,signal,unit,amplitude,phase_rad\n")
    assert "order 2:" in run("orders", "d.csv").output


@pytest.mark.parametrize(("arguments", "words"), [
    (["nowhere.csv"], "nowhere.csv does not exist"),
    (["d.csv", "--signal", "torque"], "--signal torque: was not recorded"),
    (["d.csv", "--plot", "o.txt"], "unknown ending '.txt'"),
    (["bare.csv", "--speed", "100 rpm:200 rpm:3"], "does not carry its scene"),
])
def test_orders_refuses(run: Run, tmp_path: Path, arguments: list[str], words: str) -> None:
    t = np.linspace(0.0, 1.0, 400)
    table = np.column_stack([t, 30.0 * t, np.cos(60.0 * t)])
    for name in ("d.csv", "bare.csv"):
        np.savetxt(tmp_path / name, table, delimiter=",", comments="",
                   header="time [s],input.angle [rad],shaft.torque [N.m]")
    found = run("orders", *arguments)
    assert found.exit_code == 2
    assert words in found.stderr


def test_python_names_are_exported() -> None:
    assert cardan.linearize.__module__ == "cardan.analyses.linearize"
    assert cardan.stability.__module__ == "cardan.analyses.stability"
    assert cardan.orders.__module__ == "cardan.analyses.order_spectrum"
