"""Values: what is declared is what comes back, and what is set is what comes back."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from cardan.check.base import Check, Findings, Refused, listed
from cardan.check.quantities import Value, moved, start
from cardan.check.rig import WARNING, Rig, name_of
from cardan.check.subject import Subject
from cardan.check.trajectory import same

STARTS, BEFORE = "start values", "set before initialization"
DURING, RUNNING = "set in initialization", "set between steps"


class Values(Check):
    """FMI 2.0 section 2.1.7: getting and setting variable values."""

    id = "values"
    title = "Values: start values as declared, set values come back"
    proves = "start values are those of the model description, and a value that is set is the value that is got"
    needs = ("instantiation",)

    def parts(self, subject: Subject) -> Sequence[str]:
        """Return what is tried."""
        return (STARTS, BEFORE, DURING, RUNNING)

    def run(self, subject: Subject, part: str, found: Findings) -> None:
        """Get, or set and get."""
        rig = Rig(subject)
        if part == STARTS:
            rig.begin()
            self._starts(subject, rig, found)
        elif part == BEFORE:
            changes = _changes(subject.having("parameter", "input"))
            refused = _put(rig, changes)
            rig.begin()
            self._compare(rig, changes, refused, found)
        elif part == DURING:
            rig.begin()
            changes = _changes(subject.having("parameter", "input"))
            self._compare(rig, changes, _put(rig, changes), found)
        else:
            rig.start()
            changes = _changes([each for each in subject.having("parameter", "input") if each.variability != "fixed"])
            self._compare(rig, changes, _put(rig, changes), found)
        rig.free()

    @staticmethod
    def _starts(subject: Subject, rig: Rig, found: Findings) -> None:
        wrong, unread = [], []
        for variable in subject.variables:
            declared = start(variable)
            if declared is None or variable.initial != "exact":
                continue
            status, value = rig.fetch(variable)
            if status > WARNING:
                unread.append(f"{variable.name} ({name_of(status)})")
            elif not same(declared, value) and not (declared == value == 0.0):
                wrong.append(f"{variable.name} is {value!r}, declared {declared!r}")
        if unread:
            found.fail(f"cannot be read in initialization mode: {listed(unread)}")
        if wrong:
            found.fail(f"start values differ from the model description: {listed(wrong)}")

    @staticmethod
    def _compare(rig: Rig, changes: dict[Any, Value], refused: list[str], found: Findings) -> None:
        if refused:
            found.fail(f"cannot be set: {listed(refused)}")
        lost = []
        for variable, value in changes.items():
            status, back = rig.fetch(variable)
            if status > WARNING:
                lost.append(f"{variable.name} (reading it returned {name_of(status)})")
            elif not same(value, back):
                lost.append(f"{variable.name} ({back!r} instead of {value!r})")
        if lost:
            found.fail(f"set, but something else comes back: {listed(lost)}")


def _changes(variables: Sequence[Any]) -> dict[Any, Value]:
    """Return another allowed value for every variable that has one."""
    found: dict[Any, Value] = {}
    for variable in variables:
        first = start(variable)
        other = None if first is None else moved(variable, first)
        if other is not None:
            found[variable] = other
    return found


def _put(rig: Rig, changes: dict[Any, Value]) -> list[str]:
    """Set values; return what was refused, and forget it."""
    refused = []
    for variable, value in list(changes.items()):
        status = rig.put(variable, value)
        if status > WARNING:
            refused.append(f"{variable.name} = {value!r} ({name_of(status)})")
            del changes[variable]
            if not rig.alive:
                raise Refused(f"setting {variable.name} = {value!r} returned fatal")
    return refused
