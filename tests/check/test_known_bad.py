"""FMUs with one fault each: caught by the check that is there for it."""

from __future__ import annotations

import pytest

from .conftest import Examine, Make
from .faults import BIRTH, FAULTS, LATE_PARAMETER, STEP, after, y_depends_on


@pytest.mark.parametrize("name", FAULTS)
def test_the_fault_is_caught_by_its_check(name: str, lag: Make, examine: Examine) -> None:
    fault = FAULTS[name]
    report = examine(lag(fault.code, fault.xml), fault.check)
    outcome = report[fault.check]
    assert outcome.status == "failed", outcome
    assert any(fault.said in text for text in outcome.problems), outcome.problems
    assert not any("not carried out" in text for text in outcome.problems), outcome.problems
    assert not report.passed


def test_a_step_without_end_is_a_failed_check_and_spares_the_others_the_wait(lag: Make, examine: Examine) -> None:
    fmu = lag(after(STEP, "while current_time > 0.045:", "    pass"))
    report = examine(fmu, "schema", "run", "state", "memory", time_limit=5.0)
    assert report["schema"].status == "passed"
    assert "no end in fmi2DoStep(t = 0.05, h = " in report["run"].problems[0]
    assert "stopped after 5 s" in report["run"].problems[0]
    assert {report[each].status for each in ("state", "memory")} == {"skipped"}
    assert "run failed" in report["state"].reason
    assert report.seconds < 14.0  # three more checks would take 25 s


def test_after_a_crash_the_rest_of_the_check_is_carried_out(lag: Make, examine: Examine) -> None:
    problems = examine(lag(after(BIRTH, "self.refuse('hello')")), "legal-calls")["legal-calls"].problems
    assert [text.partition(":")[0] for text in problems] == ["instantiate, free", "initialize, reset, free"]


def test_what_is_declared_but_never_seen_is_a_remark(lag: Make, examine: Examine) -> None:
    outcome = examine(lag(xml=y_depends_on("3 4")), "dependencies")["dependencies"]
    assert outcome.status == "passed"
    assert "InitialUnknowns: declared but never seen: y on lag" in outcome.remarks


def test_what_is_not_claimed_is_skipped_with_the_reason(lag: Make, examine: Examine) -> None:
    fmu = lag(xml={'canGetAndSetFMUstate="true" canSerializeFMUstate="true"': "",
                   'canHandleVariableCommunicationStepSize="true"': ""})
    report = examine(fmu, "state", "serialization", "steps")
    assert report.passed
    for check, claim in (("state", "canGetAndSetFMUstate"), ("serialization", "canSerializeFMUstate"),
                         ("steps", "canHandleVariableCommunicationStepSize")):
        assert report[check].status == "skipped"
        assert claim in report[check].reason


def test_warnings_fail_only_where_asked_for(lag: Make, examine: Examine) -> None:
    fmu = lag(xml={'<Real unit="s" start': "<Real start"})
    lenient = examine(fmu, "units")["units"]
    assert lenient.status == "passed"
    assert lenient.warnings == ["Real variables without a unit, while others have one "
                                "(a pure number has the unit 1): lag"]
    assert examine(fmu, "units", strict=True)["units"].status == "failed"


def test_a_fixed_parameter_set_too_late_is_a_warning(lag: Make, examine: Examine) -> None:
    outcome = examine(lag(LATE_PARAMETER), "illegal-calls")["illegal-calls"]
    assert outcome.status == "passed"
    assert outcome.warnings == ["fixed parameter set between steps: accepted without a word"]


def test_inputs_that_an_fmu_does_not_take_are_left_at_rest(lag: Make, examine: Examine) -> None:
    report = examine(lag({"if not step_size > 0.0:": "if u != 0.0 or not step_size > 0.0:"}), "run", "state")
    assert report.passed
    assert any("with moving inputs the FMU refuses" in text for text in report["run"].remarks)


def test_an_fmu_may_end_the_run_by_itself(lag: Make, examine: Examine) -> None:
    """fmi2Discard with fmi2Terminated and without an error text, as the reference FMU Stair does it."""
    fmu = lag(after(STEP, "if current_time > 0.065:", "    return False"))
    report = examine(fmu, "run", "state", "steps", "tolerance")
    assert report["run"].status == "passed"
    assert any("the FMU itself ends the run at t = 0.07 s" in text for text in report["run"].remarks)
    assert report["state"].status == "passed"
