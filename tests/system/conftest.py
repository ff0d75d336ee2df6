"""Packages of the scenes here, each made once."""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from cardan import Result, Scenario, simulate
from cardan_build.system import package
from numpy.typing import NDArray
from system import scenes

Packaged = Callable[..., tuple[Path, Scenario, Result]]


@pytest.fixture(scope="session")
def packaged(tmp_path_factory: pytest.TempPathFactory) -> Packaged:
    """Give the package of a scene, made with steps of 1 ms, and what ``cardan simulate`` gives with any step."""
    packages: dict[str, tuple[Path, Scenario]] = {}
    made: dict[tuple[str, float], tuple[Path, Scenario, Result]] = {}

    def make(name: str, step: float = 1e-3) -> tuple[Path, Scenario, Result]:
        if name not in packages:
            folder = tmp_path_factory.mktemp(name)
            scenario = scenes.scenario(name, folder)
            packages[name] = package(scenario, folder / f"{name}.ssp"), scenario
        if (name, step) not in made:
            ssp, scenario = packages[name]
            made[name, step] = ssp, scenario, simulate(scenario.with_overrides({"scene.communication_step": step}))
        return made[name, step]

    return make


@pytest.fixture
def run_in(tmp_path: Path) -> Callable[[str, Path, float, int, list[str]], NDArray[np.float64]]:
    """Run a package in another tool; skipped by name where that is not installed."""

    def run(tool: str, ssp: Path, step: float, count: int, names: list[str]) -> NDArray[np.float64]:
        answer = tmp_path / f"{tool}.json"
        job = {"tool": tool, "ssp": str(ssp), "step": step, "count": count, "names": names, "answer": str(answer)}
        done = subprocess.run([sys.executable, "-B", str(Path(__file__).with_name("run_tool.py"))], text=True,
                              input=json.dumps(job), capture_output=True, check=False, timeout=120, cwd=tmp_path)
        assert answer.is_file(), f"{tool} ended with exit code {done.returncode}: {done.stderr[-2000:]}"
        said = json.loads(answer.read_text(encoding="utf-8"))
        if "skipped" in said:
            pytest.skip(said["skipped"])
        return np.array(said["rows"])

    return run
