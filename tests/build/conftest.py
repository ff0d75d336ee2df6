"""An FMU for all tests here, and clean processes to run it in."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import cardan_build
import pytest
from cardan_build.sources import find_package

SCRIPT = Path(__file__).with_name("clean_runs.py")
Run = Callable[..., dict[str, Any]]


@pytest.fixture(scope="session")
def fmu(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The FMU of the installed sources."""
    return cardan_build.build(tmp_path_factory.mktemp("fmu") / "CardanDriveline.fmu")


@pytest.fixture(scope="session")
def portable_fmu(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The same without the compiled kernel."""
    return cardan_build.build(tmp_path_factory.mktemp("portable") / "CardanDriveline.fmu", portable=True)


@pytest.fixture(scope="session")
def other_sources(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A directory to put in front of the path: another version of the kernel, with twice the input inertia."""
    directory = tmp_path_factory.mktemp("other")
    shutil.copytree(find_package("cardan_kernel"), directory / "cardan_kernel",
                    ignore=shutil.ignore_patterns("_compiled*", "__pycache__"))
    for name, old, new in (("__init__.py", '__version__ = "', '__version__ = "99.'),
                           ("variables.py", '"input.inertia", "kg.m2", 0.2', '"input.inertia", "kg.m2", 0.4')):
        path = directory / "cardan_kernel" / name
        text = path.read_text(encoding="utf-8")
        assert text.count(old) == 1
        path.write_text(text.replace(old, new), encoding="utf-8")
    return directory


@pytest.fixture(scope="session")
def other_fmu(other_sources: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The FMU of that version."""
    path = tmp_path_factory.mktemp("other_fmu") / "CardanDriveline.fmu"
    found = [str(other_sources), str(find_package("cardan_build").parent)]
    subprocess.run([sys.executable, "-m", "cardan_build", "-o", str(path)], check=True, capture_output=True,
                   env={**os.environ, "PYTHONPATH": os.pathsep.join(found)})
    return path


@pytest.fixture
def run(tmp_path: Path) -> Run:
    """Call a function of clean_runs.py in a process of its own, by default without the repository on its path."""
    count = iter(range(1000))

    def call(function: str, *, isolated: bool = True, **job: Any) -> dict[str, Any]:
        unpack = tmp_path / f"unpacked {next(count)}"
        unpack.mkdir()
        job = {"unpack": unpack} | job
        flags = ["-I", "-B"] if isolated else ["-B"]
        done = subprocess.run([sys.executable, *flags, str(SCRIPT), function], input=json.dumps(job, default=str),
                              text=True, capture_output=True, cwd=tmp_path, check=False)
        lines = done.stdout.splitlines()
        assert lines, f"{function} printed nothing; exit code {done.returncode}\n{done.stderr}"
        answer = json.loads(lines[-1])
        assert isinstance(answer, dict)
        return answer | {"exit": done.returncode}

    return call
