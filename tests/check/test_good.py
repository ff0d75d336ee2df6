"""FMUs without a fault pass, and the figures are what they have to be."""

from __future__ import annotations

from pathlib import Path

from cardan.check import Report
from cardan.check.memory import BOUND, slope

from .conftest import Examine


def complaints(report: Report) -> dict[str, list[str]]:
    return {each.id: each.problems + each.warnings for each in report.outcomes if each.problems or each.warnings}


def test_the_good_fmu_passes_every_check(good: Path, examine: Examine) -> None:
    report = examine(good)
    assert complaints(report) == {}
    assert {each.id for each in report.outcomes if each.status == "skipped"} == {"reference"}
    assert report.passed
    assert all(each.proves and each.title and each.seconds > 0.0 for each in report.outcomes)


def test_the_driveline_passes_every_check_over_1000_instances(driveline: Path, examine: Examine) -> None:
    report = examine(driveline, instances=1000)
    assert complaints(report) == {}
    assert {each.id for each in report.outcomes if each.status == "skipped"} <= {"reference"}
    memory = report["memory"].figures
    assert memory["instances"][0] == 1000
    assert 1024.0 * memory["growth"][0] < BOUND
    assert report["tolerance"].figures["error at 1e-08"][0] < 1e-3 * report["tolerance"].figures["error at 0.0001"][0]
    times = report["timing"].figures
    assert 0.0 < times["step"][0] < times["step with all Real inputs and outputs"][0]


def test_the_growth_of_memory_is_the_slope_of_the_marks() -> None:
    assert slope([(10, 1000), (20, 1500), (30, 2000)]) == 50.0
