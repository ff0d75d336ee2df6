"""The measurements that the README shows: complete, and what does not depend on the machine is measured again.

Errors and orders are deterministic up to the last digits of libm; times are only asked to be there.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from cardan import Instance
from cardan.bench import hard, integrator
from cardan.bench.coupled_run import Study
from cardan.bench.coupling import TOLERANCE
from cardan.bench.figures import FIGURES
from cardan.bench.records import Options
from cardan.bench.sections import SECTIONS, Measured
from cardan.bench.systems import RIPPLE, SMOOTH, STEEP, Coupled
from cardan.bench.tables import PARTS, REPORT, report
from cardan.bench.targets import targets

FOLDER = Path(__file__).parents[2] / "docs" / "bench"
TIMES = ("ms_per_s", "us", "fmu_us", "kernel_us", "low", "high")


@pytest.fixture(scope="module")
def stored() -> Measured:
    return Measured.load(FOLDER / "results.json")


@pytest.fixture(scope="module")
def instance() -> Iterator[Instance]:
    from cardan_build import default_fmu

    with Instance(default_fmu()) as fmu:
        yield fmu


def found(stored: Measured, table: str, **wanted: Any) -> dict[str, Any]:
    """The one record of a table with these values."""
    records = [record for record in stored.tables[table]
               if all(record[key] == value for key, value in wanted.items())]
    assert len(records) == 1
    return records[0]


def test_every_section_was_measured_in_full(stored: Measured) -> None:
    assert stored.made_by["quick"] is False
    assert stored.made_by["kernel"] == "compiled"
    assert {needed for needed, _, _ in REPORT} <= set(stored.tables)
    assert len(SECTIONS) == 8
    for name, records in stored.tables.items():
        assert records, name
        for record in records:
            for column in set(TIMES) & set(record):
                assert record[column] is not None, (name, record)
                assert record[column] > 0.0, (name, record)


def test_the_report_and_the_figures_beside_it_are_its_own(stored: Measured) -> None:
    assert (FOLDER / "report.md").read_text(encoding="utf-8") == report(stored)
    for name in FIGURES:
        assert (FOLDER / f"{name}.png").stat().st_size > 20_000


def test_every_target_is_in_the_report(stored: Measured) -> None:
    promises = targets(stored.tables)
    assert len(promises) == 15
    text = report(stored)
    for promise in promises:
        assert promise.what in text
        assert promise.measured in text


def test_every_part_of_the_readme_has_rows(stored: Measured) -> None:
    for name, make in PARTS.items():
        text = make(stored)
        assert name == "machine" or text.count("\n") >= 2, name
        assert "nan" not in text.lower().split()


@pytest.mark.parametrize("case", [case.name for case in integrator.CASES if case.name != "rigid limit"])
def test_the_integrators_errors_are_measured_again(case: str, stored: Measured) -> None:
    """Where a step more or less changes the error by half, the order of magnitude is what is stated."""
    system = next(each for each in integrator.CASES if each.name == case)
    exact, _ = integrator.run(system, integrator.FINEST, system.step / 4)
    for tolerance in (1e-3, 1e-6):
        outputs, evaluations = integrator.run(system, tolerance, system.step)
        record = found(stored, "integrator", case=case, tolerance=tolerance)
        assert integrator.error(outputs, exact) == pytest.approx(record["error"], rel=0.5)
        assert evaluations / (1e3 * system.span) == pytest.approx(record["rhs_per_ms"], rel=0.02)


def test_the_error_follows_the_work_with_order_eight(stored: Measured) -> None:
    """DOP853 on smooth cases: error as work to the power -8, steeper while the steps are too long for the order."""
    for case in ("ordinary", "bent", "limit"):
        coarse = found(stored, "integrator", case=case, tolerance=1e-6)
        fine = found(stored, "integrator", case=case, tolerance=1e-12)
        order = math.log(coarse["error"] / fine["error"]) / math.log(fine["rhs_per_ms"] / coarse["rhs_per_ms"])
        assert 8.0 < order < 10.5


@pytest.mark.parametrize("scheme", ["held", "gauss-seidel", "linear", "slope", "hermite3", "hermite5", "iterated"])
@pytest.mark.parametrize("case", [SMOOTH, RIPPLE], ids=lambda case: case.name)
def test_coupling_errors_are_measured_again(scheme: str, case: Coupled, stored: Measured, instance: Instance) -> None:
    """1 % where the error is well above rounding."""
    study = Study(instance, case)
    for rate in (500, 1000):
        record = found(stored, "coupling", case=case.name, scheme=scheme, step_ms=1e3 / rate)
        outcome = study.run(scheme, rate, TOLERANCE)
        assert outcome.error == pytest.approx(record["error"], rel=0.01)
        assert outcome.steps == record["fmu_steps"]


@pytest.mark.parametrize("scheme", ["held", "gauss-seidel", "linear", "slope", "hermite3", "hermite5", "iterated"])
def test_fitted_orders_are_the_stated_ones(scheme: str, stored: Measured) -> None:
    for case in ("smooth", "ripple"):
        record = found(stored, "orders", case=case, scheme=scheme)
        assert record["points"] >= 3
        assert record["fitted"] == pytest.approx(record["order"], abs=0.2)


@pytest.mark.parametrize(("scheme", "stable"), [("held", False), ("linear", False), ("slope", True),
                                                ("hermite3", True), ("hermite5", True), ("iterated", True)])
def test_a_steep_load_is_stable_at_10_ms_where_its_slope_is_passed(scheme: str, stable: bool, stored: Measured,
                                                                   instance: Instance) -> None:
    """3000 w^4 N.m: K h / J is 15 there, an explicit extrapolation diverges, and the run ends instead of hanging."""
    outcome = Study(instance, STEEP).run(scheme, 100, TOLERANCE)
    record = found(stored, "coupling", case="steep", scheme=scheme, step_ms=10.0)
    if stable:
        assert outcome.error < 0.05
        assert outcome.error == pytest.approx(record["error"], rel=0.01)
    else:
        assert outcome.error == math.inf
        assert record["error"] is None
        assert outcome.steps < 100


def test_hard_cases_are_those_of_the_table(stored: Measured) -> None:
    """Their figures have tests of their own; here that the table has them all and says that they hold."""
    assert {record["number"] for record in stored.tables["hard"]} == set(hard.CASES)
    assert all(record["held"] for record in stored.tables["hard"])
    assert all(record["measured"] <= record["bound"] for record in stored.tables["hard"])


def test_auto_is_within_ten_times_its_tolerance(stored: Measured) -> None:
    records = stored.tables["auto"]
    assert {record["tolerance"] for record in records} == {1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8}
    assert max(record["over_tolerance"] for record in records) <= 10.0


def test_memory_is_flat_over_a_million_steps(stored: Measured) -> None:
    memory = stored.tables["memory"]
    assert memory[-1]["steps"] == 1_000_000
    assert memory[-1]["resident_MB"] - memory[0]["resident_MB"] < 1.0


def test_quick_is_a_subset_with_fewer_repeats() -> None:
    assert Options(quick=True).repeats < Options().repeats
