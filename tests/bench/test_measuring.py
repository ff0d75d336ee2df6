"""What the report is made with: timings, tuning, targets, tables, files."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from cardan.bench.c_host import NoHost, _libpython
from cardan.bench.coupling import orders
from cardan.bench.figures import draw
from cardan.bench.peers import Peer, Solution, tune
from cardan.bench.records import told
from cardan.bench.report import prepare, write
from cardan.bench.sections import Measured, chosen
from cardan.bench.tables import number, power
from cardan.bench.targets import targets
from cardan.bench.timing import clocked, figure, interleaved, ratio, repeated
from cardan.errors import InputError


def test_a_figure_is_the_median_with_quartiles() -> None:
    assert figure([5.0, 1.0, 2.0, 3.0, 4.0]) == (3.0, 2.0, 4.0)
    assert figure([3.0, 1.0]) == (2.0, 1.0, 3.0)
    assert figure([1.0]) * 1e3 == (1000.0, 1000.0, 1000.0)


def test_ratios_are_formed_within_each_round() -> None:
    """A round that is slow as a whole does not count."""
    assert ratio([2.0, 20.0, 4.0], [1.0, 10.0, 2.0]) == (2.0, 2.0, 2.0)


def test_jobs_run_in_turns_after_a_round_that_does_not_count() -> None:
    order: list[str] = []

    def job(name: str) -> float:
        order.append(name)
        return float(len(order))

    done: list[float] = []
    samples = interleaved({"a": lambda: job("a"), "b": lambda: job("b")}, 2, done.append)
    assert "".join(order) == "ababab"
    assert samples == {"a": [3.0, 5.0], "b": [4.0, 6.0]}
    assert done[-1] == 1.0


def test_a_short_job_is_repeated_until_it_can_be_measured() -> None:
    count = 0

    def job() -> float:
        nonlocal count
        count += 1
        return 0.004

    assert repeated(job, 0.02)() == pytest.approx(0.004)
    assert count == 5
    assert clocked(lambda: sum(range(10000)))() > 0.0


def test_a_peer_gets_the_loosest_setting_that_reaches_the_goal() -> None:
    exact = np.ones((2, 3))
    peer = Peer("p", lambda setting: Solution(np.arange(3.0), exact * (1.0 + setting), 1.0, 7.0),
                (1e-3, 1e-6, 1e-9))
    assert tune(peer, lambda points: exact)[1:3] == (1e-6, pytest.approx(1e-6, rel=1e-6))
    hopeless = Peer("p", peer.solve, (1e-3,))
    with pytest.raises(ValueError, match="does not reach an error of 1e-06"):
        tune(hopeless, lambda points: exact)


def coupling_records(order: float, factor: float) -> list[dict[str, object]]:
    return [{"case": "smooth", "scheme": "slope", "step_ms": h, "error": factor * h**order, "ms_per_s": 10.0 / h}
            for h in (4.0, 2.0, 1.0, 0.5)]


def test_orders_are_fitted_and_the_goal_is_found() -> None:
    """error = 1e-5 h^2 reaches 1e-6 at h = 0.316 ms, beyond the steps measured: time goes with 1 / h."""
    record = next(row for row in orders(coupling_records(2.0, 1e-5)) if row["scheme"] == "slope")
    assert record["fitted"] == pytest.approx(2.0)
    assert record["points"] == 3  # 4 ms is too long for an order
    assert record["step_ms"] == pytest.approx(0.1**0.5)
    assert record["ms_per_s"] == pytest.approx(10.0 / 0.1**0.5)
    assert not record["measured"]
    inside = next(row for row in orders(coupling_records(2.0, 5e-7)) if row["scheme"] == "slope")
    assert inside["measured"]
    assert inside["step_ms"] == pytest.approx(2.0**0.5)
    assert inside["ms_per_s"] == pytest.approx(10.0 / 2.0**0.5)


def test_a_diverged_run_is_no_point_of_a_fit() -> None:
    rows = coupling_records(2.0, 1e-5)
    rows[1]["error"] = None
    record = next(row for row in orders(rows) if row["scheme"] == "slope")
    assert record["points"] == 2
    assert record["fitted"] == pytest.approx(2.0)


def test_targets_are_met_or_not() -> None:
    tables = {"peers": [{"method": "scipy solve_ivp LSODA", "times_fmu_1ms": 30.0, "times_fmu_10ms": 60.0,
                         "times_kernel": 99.0},
                        {"method": "scipy solve_ivp DOP853", "times_fmu_1ms": 9.0, "times_fmu_10ms": 50.0,
                         "times_kernel": 120.0},
                        {"method": "scipy ode (dop853)", "times_fmu_1ms": 1.0, "times_fmu_10ms": 1.0,
                         "times_kernel": 1.0}],
              "orders": [{"case": "smooth", "scheme": "slope", "order": 2, "fitted": 2.15},
                         {"case": "smooth", "scheme": "held", "order": 1, "fitted": None},
                         {"case": "steep", "scheme": "held", "order": 1, "fitted": 0.1}]}
    assert [(target.measured, target.met) for target in targets(tables)] == [
        ("9 times", False), ("50 times", True), ("99 times", False), ("2.15", True), ("not fitted", None)]
    assert targets({}) == []


@pytest.mark.parametrize(("value", "digits", "text"), [
    (None, 2, "-"), (0.0, 2, "0"), (1.0, 3, "1.00"), (0.036, 2, "0.036"), (7.62e-7, 2, "7.6e-7"), (1234.5, 3, "1230"),
    (12000.0, 3, "12000"), (633000.0, 2, "6.3e5"), (99.99, 3, "100"), (18.24, 3, "18.2"), (10.0, 2, "10")])
def test_figures_are_written_shortly(value: float | None, digits: int, text: str) -> None:
    assert number(value, digits) == text


def test_tolerances_are_written_as_powers() -> None:
    assert [power(value) for value in (1e-3, 1e-12)] == ["1e-3", "1e-12"]


def test_an_error_near_that_of_its_reference_is_not_told() -> None:
    assert told({"error": 1e-9, "floor": 1e-12})
    assert not told({"error": 2e-12, "floor": 1e-12})


def test_an_unknown_section_is_told_with_the_choices() -> None:
    assert chosen(["peers", "integrator"]) == ["integrator", "peers"]
    assert len(chosen([])) == 8
    with pytest.raises(InputError, match="--only speed: no such section; choose from integrator, coupling"):
        chosen(["speed"])


def test_a_directory_that_cannot_be_made_is_told_before_measuring(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    with pytest.raises(InputError, match="cannot be made a directory"):
        prepare(tmp_path / "file" / "bench")
    prepare(tmp_path / "new" / "bench")
    assert (tmp_path / "new" / "bench").is_dir()


MACHINE = {"processor": "P", "cores": 2, "system": "S", "python": "3", "kernel": "compiled", "scipy": "1",
           "control": "0", "time": "2026-01-01T00:00Z"}


def test_results_go_to_disk_and_back(tmp_path: Path) -> None:
    """Six digits, and no number that JSON does not know."""
    records = [{"case": "ordinary", "title": "t", "tolerance": 1e-3, "error": 1.23456789e-4, "floor": 1e-13,
                "rhs_per_ms": 4.0, "ms_per_s": 0.2, "low": float("nan"), "high": 0.2}]
    files = write(Measured(MACHINE, {"integrator": records}), tmp_path)
    assert {path.name for path in files} == {"results.json", "report.md", "integrator.csv", "integrator.png",
                                             "integrator.svg"}
    assert all(path.stat().st_size > 0 for path in files)
    again = Measured.load(tmp_path / "results.json").tables["integrator"][0]
    assert again["error"] == 1.23457e-4
    assert again["low"] is None
    json.loads((tmp_path / "results.json").read_text(), parse_constant=pytest.fail)
    assert (tmp_path / "integrator.csv").read_text().startswith("case,title,tolerance,error,floor,")


def test_the_same_tables_give_the_same_figure(tmp_path: Path) -> None:
    stored = Measured.load(Path(__file__).parents[2] / "docs" / "bench" / "results.json")
    contents = []
    for name in ("a", "b"):
        folder = tmp_path / name
        folder.mkdir()
        files = draw(stored.tables, folder)
        contents.append([path.read_bytes() for path in files])
    assert len(contents[0]) == 8
    assert contents[0] == contents[1]


def test_without_a_shared_libpython_there_is_no_c_host(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("cardan.bench.c_host.sysconfig.get_config_var", lambda name: None)
    with pytest.raises(NoHost, match="no shared libpython"):
        _libpython()
