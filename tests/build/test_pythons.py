"""The FMU's Python code under every Python found here: compiled from 3.11 on, interpreted before, equal results."""

from __future__ import annotations

import json
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path
from typing import Any

import cardan_kernel
import pytest

VERSIONS = [f"3.{minor}" for minor in range(9, 16)]
VALUES = {"joint1.angle": 0.4, "joint2.angle": 0.2, "shaft.yoke_phase": 0.3, "initial.speed": 50.0, "hold.degree": 3,
          "joint1.trunnion.friction": 0.2}
HERE = f"3.{sys.version_info.minor}"


def interpreter(version: str) -> str | None:
    """A Python of this version that starts; names on the path can be shims of versions that are not installed."""
    if version == HERE:
        return sys.executable
    found = shutil.which(f"python{version}")
    if found and subprocess.run([found, "-c", "pass"], capture_output=True, check=False).returncode == 0:
        return found
    return None


def play(python: str, resources: Path) -> dict[str, Any]:
    outputs = [place for place, each in enumerate(cardan_kernel.VARIABLES)
               if each.causality == "output" and each.type == "Real"]
    job = {"resources": str(resources), "names": cardan_kernel.INDEX, "values": VALUES, "outputs": outputs}
    done = subprocess.run([python, "-I", "-B", str(Path(__file__).with_name("bare_host.py"))], input=json.dumps(job),
                          capture_output=True, text=True, check=True)
    answer: dict[str, Any] = json.loads(done.stdout)
    return answer


@pytest.fixture(scope="session")
def resources(fmu: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    directory = tmp_path_factory.mktemp("bare")
    with zipfile.ZipFile(fmu) as archive:
        archive.extractall(directory)
    return directory / "resources"


@pytest.mark.parametrize("version", VERSIONS)
def test_runs_under_this_python_with_the_same_results(version: str, resources: Path) -> None:
    python = interpreter(version)
    if python is None:
        pytest.skip(f"no Python {version} is installed here")
    answer, here = play(python, resources), play(sys.executable, resources)
    assert answer["steps"] == here["steps"]
    assert all(step[0] for step in answer["steps"])
    assert answer["state"]
    assert not answer["path"]
    fits = cardan_kernel.Compiled is not None and int(version.split(".")[1]) >= 11
    assert (": compiled kernel" in answer["messages"][0][2]) == fits
