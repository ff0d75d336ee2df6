"""The FMU, unpacked once, and a job that every host here does."""

from __future__ import annotations

import json
import subprocess
import sys
import zipfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

STARTS = {"model.fidelity": 2, "model.tolerance": 1e-6, "joint1.angle": 0.35, "joint2.angle": 0.26,
          "initial.speed": 314.0, "shaft.stiffness": 2e4}
INPUTS = ("input.torque", "output.torque")
OUTPUTS = ("input.speed", "output.speed", "input.angle", "output.angle", "shaft.torque")

Job = dict[str, Any]
Play = Callable[..., dict[str, Any]]


@pytest.fixture(scope="session")
def fmu() -> Path:
    """The driveline FMU of this installation."""
    from cardan_build import default_fmu

    return default_fmu()


def unpack(fmu: Path, folder: Path) -> Job:
    """Unpack an FMU; return what a host needs to load it and to do its work."""
    from cardan.description import read_description

    about = read_description(fmu)
    with zipfile.ZipFile(fmu) as archive:
        archive.extractall(folder)
    references = {name: variable.reference for name, variable in about.variables.items()}
    return {
        "library": str(folder / "binaries" / "linux64" / f"{about.identifier}.so"), "guid": about.guid,
        "resources": (folder / "resources").as_uri(),
        "starts": [("i" if isinstance(value, int) else "r", references[name], value) for name, value in STARTS.items()],
        "inputs": [references[name] for name in INPUTS], "outputs": [references[name] for name in OUTPUTS],
    }


@pytest.fixture(scope="session")
def job(fmu: Path, tmp_path_factory: pytest.TempPathFactory) -> Job:
    """The FMU unpacked to a directory with spaces in its name."""
    if sys.platform != "linux":
        pytest.skip("these hosts are written for Linux")
    return unpack(fmu, tmp_path_factory.mktemp("hosts") / "a path with spaces")


@pytest.fixture(scope="session")
def play() -> Play:
    """Run ctypes_host.py under a Python, isolated and without site packages."""

    def run(job: Job, mode: str, count: int, python: str = sys.executable) -> dict[str, Any]:
        done = subprocess.run([python, "-I", "-S", "-B", str(Path(__file__).with_name("ctypes_host.py"))], text=True,
                              input=json.dumps({**job, "mode": mode, "count": count}), capture_output=True,
                              check=False, timeout=120)
        assert done.returncode == 0, f"{python} ended with exit code {done.returncode}: {done.stderr}"
        answer: dict[str, Any] = json.loads(done.stdout)
        return answer

    return run


@pytest.fixture(scope="session")
def expected(job: Job, play: Play) -> list[list[str]]:
    """Outputs of 200 steps, as this Python gives them."""
    rows: list[list[str]] = play(job, "run", 200)["rows"]
    return rows
