"""Error texts: whatever is refused is explained through the logger."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from typing import Any

from cardan.check.base import Check, Findings, Skip, listed
from cardan.check.legal_calls import steps
from cardan.check.quantities import Value, attribute
from cardan.check.rig import FATAL, WARNING, Rig, name_of
from cardan.check.subject import Subject
from cardan.logger import Message

RANGES, NUMBERS, SWITCH = "values outside their limits", "inputs that are no numbers", "logging switched on later"
MOST = 40  # variables tried


class Texts(Check):
    """FMI 2.0 sections 2.1.5 (logger) and 2.2.4 (log categories)."""

    id = "texts"
    title = "Error texts: delivered, and name what is wrong"
    proves = "whoever gives a wrong value is told which one, through the logger, in a declared category"
    needs = ("instantiation", "run")

    def parts(self, subject: Subject) -> Sequence[str]:
        """Return what is provoked."""
        return (RANGES, NUMBERS, SWITCH)

    def run(self, subject: Subject, part: str, found: Findings) -> None:
        """Provoke refusals and read what is said."""
        if part == SWITCH:
            self._switch(subject, found)
            return
        cases = list(_outside(subject) if part == RANGES else _no_numbers(subject))
        if not cases:
            raise Skip("no variable has limits" if part == RANGES else "there are no Real inputs")
        silent, mute, vague = [], [], []
        rig = Rig(subject)
        for variable, value in _spread(cases):
            said = f"{variable.name} = {value!r}"
            refused, messages = self._provoke(rig, variable, value)
            if not rig.alive:
                found.fail(f"{said}: the call returned fatal; freeing such an instance may crash the host")
                return
            texts = [each.text for each in messages if each.status > WARNING and each.text]
            if not refused and not texts:
                silent.append(said)
            elif not texts:
                mute.append(f"{said} ({refused})")
            elif not any(variable.name in text for text in texts):
                vague.append(f"{said} ({texts[0]})")
            _categories(subject, messages, found)
            if rig.status("fmi2Reset") > WARNING:
                rig.free()
                rig = Rig(subject)
        rig.free()
        _enter(found, part, len(_spread(cases)), silent, mute, vague)

    @staticmethod
    def _provoke(rig: Rig, variable: Any, value: Value) -> tuple[str, list[Message]]:
        """Start with a wrong value and step; what refused it, or an empty text, and what was said."""
        experiment = rig.subject.experiment
        before = rig.latest
        rig.begin()
        calls: dict[str, Callable[[], int]] = {
            "setting it": lambda: rig.put(variable, value),
            "fmi2ExitInitializationMode": lambda: rig.status("fmi2ExitInitializationMode"),
            "fmi2DoStep": lambda: rig.step(experiment.start, experiment.step),
        }
        for function, call in calls.items():
            status = call()
            if status > WARNING:
                return f"{function} returned {name_of(status)}", rig.messages(before)
        return "", rig.messages(before)

    @staticmethod
    def _switch(subject: Subject, found: Findings) -> None:
        """A refusal with logging off, then on: the second one has to come with a text."""
        rig = Rig(subject, logging=False)
        if rig.step(subject.experiment.start, subject.experiment.step) in (0, WARNING, FATAL) or not rig.alive:
            raise Skip("a step before the initialization is not refused, so there is nothing to tell")
        rig.free()
        rig = Rig(subject, logging=False)
        rig.good("fmi2SetDebugLogging", 1, 0, None, what="on, no category")
        before = rig.latest
        rig.step(subject.experiment.start, subject.experiment.step)
        if not any(each.text for each in rig.messages(before)):
            found.warn("after fmi2SetDebugLogging(true) without categories a refusal comes without a text")
        rig.good("fmi2Reset")
        rig.start()
        steps(rig)
        rig.free()


def _outside(subject: Subject) -> Iterator[tuple[Any, Value]]:
    for variable in subject.having("parameter", "input", kinds=("Real", "Integer")):
        low, high = attribute(variable, "min"), attribute(variable, "max")
        for limit, sign in ((low, -1), (high, 1)):
            if limit is None or not abs(limit) < (2**31 - 2 if variable.type == "Integer" else math.inf):
                continue
            if variable.type == "Integer":
                yield variable, int(limit) + sign
            else:
                yield variable, limit + sign * max(1.0, abs(limit))


def _no_numbers(subject: Subject) -> Iterator[tuple[Any, Value]]:
    for variable in subject.having("input", kinds=("Real",)):
        yield variable, math.nan
        yield variable, math.inf


def _spread(cases: list[tuple[Any, Value]]) -> list[tuple[Any, Value]]:
    """Return at most `MOST` cases, from all over the list."""
    every = -(-len(cases) // MOST)
    return cases[::every]


def _categories(subject: Subject, messages: list[Message], found: Findings) -> None:
    declared = {each.name for each in subject.model.logCategories}
    for message in messages:
        text = f"the log category {message.category!r} is not declared"
        if declared and message.category and message.category not in declared and text not in found.warnings:
            found.warn(text)


def _enter(found: Findings, part: str, count: int, silent: list[str], mute: list[str], vague: list[str]) -> None:
    if mute:
        found.fail(f"refused without a text: {listed(mute)}")
    if vague:
        found.remark(f"{part}: the text does not name the variable: {listed(vague)}")
    if silent:
        found.remark(f"{part}: taken without a word: {listed(silent)}")
    found.remark(f"{part}: {count} tried, {count - len(silent)} refused, {count - len(silent) - len(mute)} with a text")
