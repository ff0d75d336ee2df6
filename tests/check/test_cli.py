"""The command: exit codes, reports for people, for programs and for CI systems."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import pytest
from cardan.check.junit import write_junit
from cardan.check.report import Outcome, Report
from cardan.cli.app import app
from typer.testing import CliRunner, Result

from .conftest import Make
from .faults import STEP, after


def cardan(*arguments: Any) -> Result:
    return CliRunner().invoke(app, ["check", *map(str, arguments)])


@pytest.fixture(scope="module")
def bad_units(lag: Make) -> Path:
    return lag(xml={'kg="-1" s="2"': 'kg="1" s="2"'})


def test_all_passed(good: Path) -> None:
    result = cardan(good, "--only", "units", "--only", "state")
    assert result.exit_code == 0
    lines = result.stdout.splitlines()
    assert [line.split()[:2] for line in lines if "passed  " in line] == [["units", "passed"], ["state", "passed"]]
    assert lines[-1].startswith("2 passed, 0 failed, 0 skipped in ")
    assert result.stderr == ""  # no progress where there is no terminal


def test_a_check_failed(bad_units: Path) -> None:
    result = cardan(bad_units, "--only", "units", "--only", "ranges")
    assert result.exit_code == 1
    text = " ".join(result.stdout.split())
    assert "- unit m/N is defined as kg.s2, but its name says kg-1.s2" in text
    assert "1 passed, 1 failed, 0 skipped" in text


def test_json(bad_units: Path) -> None:
    result = cardan(bad_units, "--only", "units", "--only", "reference", "--json")
    assert result.exit_code == 1
    told = json.loads(result.stdout)
    assert told["passed"] is False
    assert told["counts"] == {"passed": 0, "failed": 1, "skipped": 1}
    assert len(told["sha256"]) == 64
    assert told["versions"]["fmpy"]
    units, reference = told["checks"]
    assert units["id"] == "units" and units["status"] == "failed" and units["problems"]
    assert units["proves"] and units["seconds"] > 0.0
    assert reference["status"] == "skipped" and "no Lag_ref.csv" in reference["reason"]


def test_junit(bad_units: Path, tmp_path: Path) -> None:
    path = tmp_path / "report.xml"
    chosen = ["--only", "units", "--only", "reference", "--only", "timing"]
    assert cardan(bad_units, *chosen, "--junit", path).exit_code == 1
    root = ElementTree.parse(path).getroot()
    assert root.tag == "testsuites"
    suite = root[0]
    assert [suite.get(name) for name in ("tests", "failures", "errors", "skipped")] == ["3", "1", "0", "1"]
    cases = {str(case.get("name")).split(":")[0]: case for case in suite.iter("testcase")}
    failure = cases["units"].find("failure")
    assert failure is not None and "m/N" in str(failure.get("message"))
    skipped = cases["reference"].find("skipped")
    assert skipped is not None and "Lag_ref.csv" in str(skipped.get("message"))
    assert cases["timing"].find("failure") is None
    assert "step: " in str(cases["timing"].findtext("system-out"))
    assert float(str(cases["units"].get("time"))) > 0.0
    assert cases["units"].get("classname") == "cardan.check.Lag"


def test_junit_survives_what_an_fmu_says(tmp_path: Path) -> None:
    outcome = Outcome("run", "title", "proves", "failed", problems=["a \x00 b \x1b[31m <&> \ud800 end"])
    path = tmp_path / "report.xml"
    write_junit(Report("X.fmu", "X\x01", "0", {}, "2026-01-01T00:00:00+00:00", [outcome]), path)
    failure = next(ElementTree.parse(path).getroot().iter("failure"))
    assert failure.get("message") == "a ? b ?[31m <&> ? end"


@pytest.mark.parametrize(("arguments", "said"), [
    (["--only", "unit"], "there is no check 'unit'; did you mean units?"),
    (["--skip", "zzz"], "there are archive, schema, "),
    (["--junit", "missing/report.xml"], "there is no directory"),
    (["--reference", "missing"], "missing has no reference: there is no Lag_ref.csv"),
])
def test_what_cannot_be_carried_out(arguments: list[str], said: str, good: Path) -> None:
    result = cardan(good, *arguments)
    assert result.exit_code == 2
    assert said in result.stderr
    assert result.stdout == ""


def test_errors_as_json(tmp_path: Path) -> None:
    result = cardan(tmp_path / "none.fmu", "--json")
    assert result.exit_code == 2
    assert "does not exist" in json.loads(result.stdout)["errors"][0]


def test_skipping(good: Path) -> None:
    result = cardan(good, "--only", "units", "--only", "ranges", "--skip", "ranges", "--json")
    assert [each["id"] for each in json.loads(result.stdout)["checks"]] == ["units"]


def test_strict(lag: Make) -> None:
    fmu = lag(xml={'<Real unit="s" start': "<Real start"})
    assert cardan(fmu, "--only", "units").exit_code == 0
    assert cardan(fmu, "--only", "units", "--strict").exit_code == 1


def test_remarks_are_for_those_who_ask(good: Path) -> None:
    assert "6 members" not in cardan(good, "--only", "archive").stdout
    assert "members, " in cardan(good, "--only", "archive", "--verbose").stdout


def test_export(good: Path, tmp_path: Path) -> None:
    result = cardan(good, "--export", tmp_path / "out")
    assert result.exit_code == 0
    names = sorted(path.name for path in (tmp_path / "out").iterdir())
    assert names == ["Lag_in.csv", "Lag_ref.csv", "Lag_ref.opt"]
    assert result.stdout.splitlines() == [f"written: {tmp_path / 'out' / name}" for name in names]
    assert cardan(good, "--only", "reference", "--reference", tmp_path / "out").exit_code == 0


def test_export_of_what_does_not_run(lag: Make, tmp_path: Path) -> None:
    result = cardan(lag(after(STEP, "return False")), "--export", tmp_path / "out", "--json")
    assert result.exit_code == 2
    assert "fmi2DoStep(t = 0.0, h = 0.01) returned discard" in json.loads(result.stdout)["errors"][0]
    assert not (tmp_path / "out").exists()
