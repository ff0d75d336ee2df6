"""The FMU in importers that are not ours: to 1e-12 of FMPy, each in a process of its own; missing ones by name."""

from __future__ import annotations

import json
import subprocess
import sys
from importlib.metadata import PackageNotFoundError
from pathlib import Path
from typing import Any

import pytest
from cardan.errors import CardanError, InputError
from cardan.importers import __main__ as child
from cardan.importers import compare, markdown, runner, scene
from cardan.importers.runner import OTHERS, Outcome, largest_difference


@pytest.fixture(scope="module")
def fmu() -> Path:
    from cardan_build import default_fmu

    return default_fmu()


def cardan(*arguments: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run([sys.executable, "-c", "from cardan.cli import main; main()", "importers", *arguments],
                          capture_output=True, text=True, check=False)


@pytest.fixture(scope="module")
def found(fmu: Path) -> dict[str, dict[str, Any]]:
    """What the command says, by importer."""
    done = cardan(str(fmu), "--json")
    assert done.returncode == 0, done.stdout + done.stderr
    return {row["tool"]: row for row in json.loads(done.stdout)["importers"]}


@pytest.mark.parametrize("tool", ["libcosim", "Ecos", "fmucontainer", "fmutool -check"])
def test_importer_gives_what_fmpy_gives(tool: str, found: dict[str, dict[str, Any]]) -> None:
    row = found[tool]
    if row["status"] == "skipped":
        pytest.skip(row["note"])
    assert row["version"]
    if tool == "fmutool -check":  # a checker runs nothing
        assert row["status"] == "no error"
    else:
        assert row["status"] == "same"
        assert row["difference"] <= 1e-12


def test_the_table_has_the_reference_and_all_that_cannot_be_had(found: dict[str, dict[str, Any]]) -> None:
    assert found["FMPy"]["status"] == "reference"
    assert set(found) - set(runner.UNAVAILABLE) == {"FMPy", "libcosim", "Ecos", "fmucontainer", "fmutool -check"}
    assert all(row["note"] for row in found.values() if row["status"] == "skipped")


def test_the_scene_moves_every_output(fmu: Path) -> None:
    rows = runner._child("fmpy", fmu, None)["rows"]
    assert len(rows) == scene.COUNT
    for name, column in zip(scene.OUTPUTS, zip(*rows)):
        assert max(column) > min(column), name
    assert rows[-1][scene.OUTPUTS.index("input.angle")] > 6.3  # more than a turn


def test_a_missing_importer_is_skipped_by_name(monkeypatch: pytest.MonkeyPatch) -> None:
    def absent(name: str) -> str:
        raise PackageNotFoundError(name)

    monkeypatch.setattr(child, "version", absent)
    for name in OTHERS:
        answer = child.answer(name, {})
        assert "is not installed (pip install " in answer["skipped"]
        outcome = runner._judge(name, answer, [])
        assert (outcome.status, outcome.good) == ("skipped", True)
        assert outcome.package in outcome.note


def test_a_missing_library_is_told_with_its_package(monkeypatch: pytest.MonkeyPatch) -> None:
    from cardan.importers import with_ecos

    def unloadable(job: object) -> None:
        raise OSError("libtbb.so.12: cannot open shared object file: No such file or directory")

    monkeypatch.setattr(child, "version", lambda name: "0.0")
    monkeypatch.setattr(with_ecos, "run", unloadable)
    assert "Debian and Ubuntu have it in the package libtbb12" in child.answer("ecos", {})["skipped"]


def stand_in(folder: Path, commands: str) -> str:
    """A Python that is none."""
    path = folder / "python"
    path.write_text(f"#!/bin/sh\n{commands}\n")
    path.chmod(0o755)
    return str(path)


@pytest.mark.skipif(sys.platform == "win32", reason="the stand-in is a shell script")
def test_a_crash_or_a_hang_is_one_failed_row(fmu: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    crashed = runner._child("ecos", fmu, stand_in(tmp_path, "echo bang >&2; kill -SEGV $$"))
    assert "exit code -11: bang" in crashed["failed"]
    monkeypatch.setattr(runner, "PATIENCE", 0.2)
    hung = runner._child("ecos", fmu, stand_in(tmp_path, "exec sleep 5"))
    assert "no answer within 0.2 s" in hung["failed"]
    outcome = runner._judge("ecos", hung, [])
    assert (outcome.status, outcome.good) == ("failed", False)


def test_a_difference_is_seen_and_named() -> None:
    reference = [[1.0 + step] * len(scene.OUTPUTS) for step in range(4)]
    rows = [list(row) for row in reference]
    assert largest_difference(rows, reference) == (0.0, "")
    rows[2][3] += 8e-12
    difference, name = largest_difference(rows, reference)
    assert difference == pytest.approx(2e-12, rel=1e-3)  # relative to the largest value, 4
    assert name == scene.OUTPUTS[3]
    outcome = runner._judge("ecos", {"rows": rows, "version": "1", "python": "3"}, reference)
    assert (outcome.status, outcome.good, outcome.note) == ("differs", False, name)
    rows[1][5] = float("nan")
    assert runner._judge("ecos", {"rows": rows}, reference).status == "differs"
    assert runner._judge("ecos", {"rows": rows[:3]}, reference).status == "differs"


def test_table() -> None:
    text = markdown([Outcome("FMPy", "fmpy", "0.3.32", "3.11.7", "reference"),
                     Outcome("Ecos", "ecospy", "0.7.2", "3.11.7", "same", 0.0),
                     Outcome("libcosim", "libcosimpy", "0.0.6", "3.11.7", "differs", 3.4e-11, "output.speed"),
                     Outcome("PyFMI", "", "", "", "skipped", note="no wheel")])
    assert text.splitlines() == [
        "| Importer | Package | Version | Python | Result | Largest difference from FMPy |",
        "|---|---|---|---|---|---|",
        "| FMPy | fmpy | 0.3.32 | 3.11.7 | reference |  |",
        "| Ecos | ecospy | 0.7.2 | 3.11.7 | same | 0 |",
        "| libcosim | libcosimpy | 0.0.6 | 3.11.7 | differs: output.speed | 3e-11 |",
        "| PyFMI |  |  |  | skipped: no wheel |  |",
    ]


@pytest.mark.parametrize(("arguments", "text"), [
    (["--only", "dymola"], "importer 'dymola' does not exist; choose from libcosim, ecos, container, fmutool"),
    (["none.fmu"], "none.fmu does not exist"),
    (["--only", "ecos", "--python", "/none/python"], "/none/python: cannot be started"),
])
def test_bad_input(arguments: list[str], text: str) -> None:
    done = cardan(*arguments)
    assert done.returncode == 2
    assert text in done.stderr


def test_an_fmu_that_fmpy_cannot_run_is_an_error_not_a_table(tmp_path: Path) -> None:
    (tmp_path / "text.fmu").write_text("no archive")
    with pytest.raises(CardanError, match="FMPy does not run"):
        compare(tmp_path / "text.fmu", ["ecos"])
    with pytest.raises(InputError):
        compare(tmp_path / "text.fmu", ["nobody"])
