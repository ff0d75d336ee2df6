"""The command line in processes of its own: what it prints where, its exit codes, what it leaves on disk."""

from __future__ import annotations

import json
import shlex
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import pytest
from cardan import Result
from cardan.cli.app import app
from cardan.errors import InputError
from typer.testing import CliRunner

SCENE = """
[scene]
title = "straight shaft"
stop_time = "0.2 s"
communication_step = "10 ms"
coupling = "held"
outputs = ["output.speed", "input.torque", "joint1.angle"]
[driveline]
model.fidelity = "rigid"
[engine]
type = "constant"
torque = "100 N.m"
"""
MOVING = '"joint1.angle" = "80 deg"\n"joint1.angle.der1" = "110 deg/s"\n'

INERTIAS = ("input.inertia", "shaft.inertia_a", "shaft.inertia_b", "output.inertia")

Run = Callable[..., "subprocess.CompletedProcess[str]"]
COMMAND = [sys.executable, "-c", "from cardan.cli import main; main()"]


@pytest.fixture
def run(tmp_path: Path) -> Run:
    """Run ``cardan`` in an empty directory with the scenes ``good.toml`` and ``fails.toml``."""
    (tmp_path / "good.toml").write_text(SCENE)
    (tmp_path / "fails.toml").write_text(SCENE.replace("[engine]", MOVING + "[engine]"))

    def call(*arguments: str) -> subprocess.CompletedProcess[str]:
        return subprocess.run([*COMMAND, *arguments], cwd=tmp_path, capture_output=True, text=True, timeout=120)

    return call


@pytest.fixture
def files(tmp_path: Path) -> Callable[[], set[str]]:
    """Names in the directory beside the scenes."""
    return lambda: {entry.name for entry in tmp_path.iterdir()} - {"good.toml", "fails.toml"}


def test_a_run_writes_result_picture_and_table(run: Run, fmu: Path, tmp_path: Path,
                                               files: Callable[[], set[str]]) -> None:
    done = run("simulate", "good.toml", "--fmu", str(fmu), "-o", "run.csv", "--plot", "run.png")
    assert done.returncode == 0, done.stderr
    assert files() == {"run.csv", "run.meta.json", "run.png"}
    assert (tmp_path / "run.png").read_bytes().startswith(b"\x89PNG")
    for word in ("straight shaft", "output.speed", "rpm", "real-time factor", "energy residual", "kernel", "run.csv"):
        assert word in done.stdout
    assert "kernel" in done.stderr  # the line at the start
    result = Result.load(tmp_path / "run.csv")
    assert result.info.completed
    assert result.info.title == "straight shaft"


def test_json_is_one_object(run: Run, fmu: Path, files: Callable[[], set[str]]) -> None:
    done = run("simulate", "good.toml", "--fmu", str(fmu), "--json", "--stop-time", "100 ms", "--set",
               "scene.outputs=output.speed", "--set", 'driveline.joint1.angle="10 deg"')
    assert done.returncode == 0, done.stderr
    summary = json.loads(done.stdout)
    assert (summary["completed"], summary["stop_time"], summary["steps"]) == (True, 0.1, 10)
    assert list(summary["figures"]) == ["output.speed"]
    assert summary["figures"]["output.speed"]["unit"] == "rad/s"
    assert summary["kernel"] in ("compiled", "interpreted")
    assert files() == set()


def test_a_failed_run_keeps_its_result_and_says_why(run: Run, fmu: Path, tmp_path: Path) -> None:
    done = run("simulate", "fails.toml", "--fmu", str(fmu), "-o", "run.nc", "--json")
    assert done.returncode == 1
    assert "joint1.angle reaches" in done.stderr
    assert "Traceback" not in done.stderr
    summary = json.loads(done.stdout)
    assert not summary["completed"]
    assert "joint1.angle reaches" in summary["message"]
    result = Result.load(tmp_path / "run.nc")
    assert (len(result), result.info.completed) == (10, False)  # 90 deg after 91 ms


def test_all_problems_at_once_and_nothing_written(run: Run, tmp_path: Path, files: Callable[[], set[str]]) -> None:
    text = SCENE.replace("0.2 s", "0.2 kg").replace("output.speed", "output.sped").replace("rigid", "soft")
    (tmp_path / "good.toml").write_text(text)
    done = run("simulate", "good.toml", "-o", "none/run.csv", "--plot", "run.gif", "--set", "nonsense",
               "--fmu", "no.fmu", "--json")
    assert done.returncode == 2
    said = [line for line in done.stderr.splitlines() if line.startswith("error: ")]
    for part in ("stop_time", "output.sped", "model.fidelity", "none/run.csv", "run.gif", "--set nonsense", "no.fmu"):
        assert sum(part in line for line in said) == 1, part
    assert json.loads(done.stdout) == {"completed": False, "errors": [line.removeprefix("error: ") for line in said]}
    assert files() == set()


@pytest.mark.parametrize(("arguments", "said"), [
    (("simulate", "nosuch"), "no such scene file"),
    (("simulate", "broken.toml"), "no valid TOML"),
    (("simulate", "good.toml", "-o", "."), "is a directory"),
    (("simulate", "good.toml", "--fmu", "good.toml"), "no zip archive"),
    (("simulate", "good.toml", "--set", "driveline.joint1.angle=90 deg"), "90"),
    (("simulate", "good.toml", "--set", "scene.coupling=jacoby"), "gauss-seidel"),
    (("simulate", "good.toml", *(f"--set=driveline.{name}=0" for name in INERTIAS)), "inertia"),
    (("simulate",), "Missing argument"),
    (("simulate", "good.toml", "--nonsense"), "--nonsense"),
    (("info", "good.toml"), "no zip archive"),
    (("build", "-o", "none.toml/x.fmu"), "cannot be written"),
])
def test_bad_input_ends_with_exit_code_2(run: Run, tmp_path: Path, files: Callable[[], set[str]],
                                         arguments: tuple[str, ...], said: str) -> None:
    (tmp_path / "broken.toml").write_text("[scene\n")
    (tmp_path / "none.toml").write_text("a file, not a directory")
    done = run(*arguments)
    assert done.returncode == 2
    assert said in done.stderr
    assert "Traceback" not in done.stderr
    assert done.stdout == ""
    assert files() == {"broken.toml", "none.toml"}


@pytest.mark.parametrize("extra", [("--bogus",), ("a", "b")])
def test_usage_errors_are_json_too(run: Run, extra: tuple[str, ...]) -> None:
    for done in (run("simulate", "good.toml", "--json", *extra), run("simulate", "--json")):
        assert done.returncode == 2
        assert not json.loads(done.stdout)["completed"]
        assert len(json.loads(done.stdout)["errors"]) == 1
        assert "Error" in done.stderr


@pytest.mark.parametrize("name", ["scene.csv", "drive.csv", "link.csv", "fmu.csv"])
def test_what_is_read_is_never_written_over(run: Run, tmp_path: Path, fmu: Path, name: str) -> None:
    drive = '[load]\ntype = "csv"\nfile = "drive.csv"\ncolumn = "torque"\n'
    (tmp_path / "scene.csv").write_text(SCENE + drive)
    (tmp_path / "drive.csv").write_text("time,torque\n0,0\n1,-1\n")
    (tmp_path / "fmu.csv").write_bytes(fmu.read_bytes())
    (tmp_path / "link.csv").symlink_to("drive.csv")
    before = (tmp_path / name).read_bytes()
    done = run("simulate", "scene.csv", "--fmu", "fmu.csv", "-o", name)
    assert done.returncode == 2, done.stderr
    assert f"error: {name} would write over" in done.stderr
    assert "kernel" not in done.stderr  # nothing has run
    assert (tmp_path / name).read_bytes() == before


def test_a_failed_save_loses_no_run(tmp_path: Path, fmu: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def full(*_: object) -> None:
        raise InputError("run.csv cannot be written: No space left on device")

    monkeypatch.setattr(Result, "save", full)
    (tmp_path / "good.toml").write_text(SCENE)
    monkeypatch.chdir(tmp_path)
    done = CliRunner().invoke(app, ["simulate", "good.toml", "--fmu", str(fmu), "-o", "run.csv", "--plot", "run.svg"])
    assert done.exit_code == 1
    assert "error: run.csv cannot be written" in done.output
    assert "real-time factor" in done.output
    assert "run.svg" in done.output
    assert (tmp_path / "run.svg").is_file()


@pytest.mark.parametrize("width", ["20", "200"])
def test_titles_and_figures_stand_as_they_are(run: Run, fmu: Path, monkeypatch: pytest.MonkeyPatch, width: str) -> None:
    monkeypatch.setenv("COLUMNS", width)
    title = "[bold]a[/] :smile: $5 and $_6"
    done = run("simulate", "good.toml", "--fmu", str(fmu), "--set", f'scene.title="{title}"', "--plot", "run.svg")
    assert done.returncode == 0, done.stderr
    assert title in done.stdout
    row = next(line.split() for line in done.stdout.splitlines() if "output.speed" in line)
    assert row == ["output.speed", "rpm", "0", "111.77", "55.883", "111.77"]


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="needs /dev/full and a POSIX shell")
@pytest.mark.parametrize(("streams", "code"), [
    (">&-", 1), (">/dev/full", 1), ("--json >/dev/full", 1), ("2>&-", 0), ("2>/dev/full", 0), (">&- 2>&-", 1),
    ("<&- >&- 2>&-", 1)])
def test_closed_and_full_streams_cost_no_run(run: Run, fmu: Path, tmp_path: Path, streams: str, code: int) -> None:
    line = f"{shlex.join([*COMMAND, 'simulate', 'good.toml', '--fmu', str(fmu), '-o', 'run.csv'])} {streams}"
    done = subprocess.run(["sh", "-c", line], cwd=tmp_path, capture_output=True, text=True, timeout=120)
    assert done.returncode == code
    assert "Traceback" not in done.stderr
    assert ("stdout cannot be written" in done.stderr) == (code == 1 and "2>" not in streams)
    assert len(Result.load(tmp_path / "run.csv")) == 21


@pytest.mark.skipif(sys.platform == "win32", reason="no SIGINT to other processes")
def test_ctrl_c_keeps_what_was_recorded(run: Run, fmu: Path, tmp_path: Path) -> None:
    command = [*COMMAND, "simulate", "good.toml", "--fmu", str(fmu), "--stop-time", "1e4 s", "-o", "run.csv"]
    with subprocess.Popen(command, cwd=tmp_path, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
        assert process.stderr is not None
        assert "kernel" in process.stderr.readline()
        time.sleep(0.3)
        process.send_signal(signal.SIGINT)
        _, errors = process.communicate(timeout=60)
    assert process.returncode == 130
    assert "stopped by the user" in errors
    assert "Traceback" not in errors
    assert 1 < len(Result.load(tmp_path / "run.csv")) < 1_000_000


def test_info_describes_an_fmu(run: Run, fmu: Path) -> None:
    done = run("info", str(fmu))
    assert done.returncode == 0, done.stderr
    for word in ("CardanDriveline", "shaft.stiffness", "N.m/rad", "rad/s (rpm)", "get and set state", "sha256",
                 "modelDescription.xml"):
        assert word in done.stdout
    about = json.loads(run("info", str(fmu), "--json").stdout)
    assert about["capabilities"]["serialize state"] is True
    assert {row["name"]: row["unit"] for row in about["variables"]}["power.input"] == "W"
    assert about["contents"]["modelDescription.xml"] > 1000


def test_info_says_what_runs_here(run: Run) -> None:
    about = json.loads(run("info", "--json").stdout)
    assert about["kernel"].split()[0] in ("compiled", "interpreted")
    assert set(about) >= {"cardan", "fmpy", "pythonfmu", "python"}


def test_scenes_are_listed(run: Run) -> None:
    done = run("scenes")
    assert done.returncode == 0, done.stderr
    assert "pickup_udds " in done.stdout
    assert "Pickup on the first 200 s of the UDDS" in done.stdout


def test_build_writes_a_loadable_fmu(run: Run, files: Callable[[], set[str]]) -> None:
    done = run("build", "-o", "mine.fmu", "--portable")
    assert done.returncode == 0, done.stderr
    assert "sha256" in done.stdout
    assert files() == {"mine.fmu"}
    assert run("simulate", "good.toml", "--fmu", "mine.fmu", "--json").returncode == 0


def test_help_names_the_commands(run: Run) -> None:
    """Its time, 0.11 s against a bar of 0.3 s, is kept by the test below: nothing heavy may be imported for it."""
    done = run("--help")
    assert done.returncode == 0
    assert all(command in done.stdout for command in ("simulate", "build", "info", "scenes", "check"))


def test_help_imports_nothing_heavy() -> None:
    code = ("import sys; from cardan.cli import app; "
            "print(sorted({name.split('.')[0] for name in sys.modules} & "
            "{'numpy', 'fmpy', 'rich', 'pandas', 'matplotlib', 'pydantic', 'scipy', 'cardan_kernel', 'cardan_build'}))")
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"
