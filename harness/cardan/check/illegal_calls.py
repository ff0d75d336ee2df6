"""Calls that FMI 2.0 forbids: refused, told, without effect, and without harm to the process.

Refused means a status of discard or error, or, where the FMU's exporter lets the call return nothing but OK, an
error message through the logger. Steps of a length that is no number are left out: the standard does not speak of
them, and its own reference FMUs never return from one. A wrong order of calls or length of a step that is accepted
without a word is a problem; a wrong variable is a warning, since the reference FMUs accept some of those.
"""

from __future__ import annotations

import ctypes
import math
from collections.abc import Callable, Sequence
from typing import Any

from cardan.check.base import Check, Findings, Skip
from cardan.check.legal_calls import steps, whole_run
from cardan.check.quantities import moved
from cardan.check.rig import DISCARD, ERROR, FATAL, WARNING, Rig
from cardan.check.subject import Subject
from cardan.check.trajectory import same

Call = Callable[[Rig], int]
DONE_ALL_THE_SAME = -1  # in place of a status


class IllegalCalls(Check):
    """FMI 2.0 section 4.2.4, and the attributes of variables, sections 2.1.7 and 2.2.7."""

    id = "illegal-calls"
    title = "Life cycle: illegal calls are refused, and do no harm"
    proves = "a master's mistake is told instead of spoiling the results or crashing; after a reset all is well"
    needs = ("instantiation", "run")

    def parts(self, subject: Subject) -> Sequence[str]:
        """Return the mistakes by name."""
        return tuple(MISTAKES)

    def run(self, subject: Subject, part: str, found: Findings) -> None:
        """Make one mistake, then reset and run."""
        rig = Rig(subject)
        prepare, mistake = MISTAKES[part]
        prepare(rig)
        before = rig.latest
        status = mistake(rig)
        told = any(each.status > WARNING for each in rig.messages(before))
        if status == DONE_ALL_THE_SAME:
            found.fail("refused in words, but done all the same")
        elif status == FATAL:
            found.fail("returned fatal: the instance is lost, and freeing it may crash the host")
            return
        elif status not in (DISCARD, ERROR) and not told:
            (found.warn if mistake in WRONG_VARIABLES else found.fail)("accepted without a word")
        elif status not in (DISCARD, ERROR):
            found.remark(f"{part}: told by a message only, the call returned OK")
        if rig.status("fmi2Reset") > WARNING:
            found.fail("fmi2Reset does not work afterwards")
        else:
            whole_run(rig)
        rig.free()


def _stay(rig: Rig) -> None:
    pass


def _begin(rig: Rig) -> None:
    rig.begin()


def _start(rig: Rig) -> None:
    rig.start()
    steps(rig)


def _end(rig: Rig) -> None:
    whole_run(rig)


def _step(rig: Rig) -> int:
    return rig.step(rig.subject.experiment.start, rig.subject.experiment.step)


def _step_of(factor: float) -> Call:
    def call(rig: Rig) -> int:
        experiment = rig.subject.experiment
        return rig.step(experiment.times(3)[-1], factor * experiment.step)

    return call


def _call(function: str) -> Call:
    return lambda rig: rig.status(function)


def _setup(rig: Rig) -> int:
    return rig.setup(rig.subject.experiment.start)


def _change(rig: Rig, variables: Sequence[Any], kind: str) -> int:
    """Set a variable that must not be set, and see to it that nothing comes of it."""
    for variable in variables:
        _, value = rig.fetch(variable)
        other = moved(variable, value) if not (isinstance(value, float) and not math.isfinite(value)) else 1.0
        if other is None:
            continue
        before = rig.latest
        status = rig.put(variable, other)
        refused = status in (DISCARD, ERROR) or any(each.status > WARNING for each in rig.messages(before))
        if refused and status != ERROR and not same(rig.fetch(variable)[1], value):
            return DONE_ALL_THE_SAME
        return status
    raise Skip(f"the FMU has no {kind}")


def _set_fixed(rig: Rig) -> int:
    fixed = [each for each in rig.subject.having("parameter") if each.variability == "fixed"]
    return _change(rig, fixed, "fixed parameter")


def _set_output(rig: Rig) -> int:
    outputs = [each for each in rig.subject.having("output") if each.initial == "calculated"]
    return _change(rig, outputs, "calculated output")


def _unused(rig: Rig) -> int:
    return 1 + max(int(each.valueReference) for each in rig.subject.model.modelVariables)


def _read_unknown(rig: Rig) -> int:
    return rig.status("fmi2GetReal", (ctypes.c_uint * 1)(_unused(rig)), 1, (ctypes.c_double * 1)(),
                      what=f"value reference {_unused(rig)}")


def _set_unknown(rig: Rig) -> int:
    return rig.status("fmi2SetReal", (ctypes.c_uint * 1)(_unused(rig)), 1, (ctypes.c_double * 1)(),
                      what=f"value reference {_unused(rig)}")


WRONG_VARIABLES = (_set_fixed, _set_output, _read_unknown, _set_unknown)
MISTAKES: dict[str, tuple[Callable[[Rig], None], Call]] = {
    "step before initialization": (_stay, _step),
    "step in initialization mode": (_begin, _step),
    "initialization left before it was entered": (_stay, _call("fmi2ExitInitializationMode")),
    "initialization entered twice": (_begin, _call("fmi2EnterInitializationMode")),
    "initialization entered between steps": (_start, _call("fmi2EnterInitializationMode")),
    "experiment set up in initialization mode": (_begin, _setup),
    "experiment set up between steps": (_start, _setup),
    "terminate before initialization": (_stay, _call("fmi2Terminate")),
    "terminate twice": (_end, _call("fmi2Terminate")),
    "step after terminate": (_end, _step),
    "step of negative length": (_start, _step_of(-1.0)),
    "step of length zero": (_start, _step_of(0.0)),
    "fixed parameter set between steps": (_start, _set_fixed),
    "output set between steps": (_start, _set_output),
    "unknown value reference read": (_start, _read_unknown),
    "unknown value reference set": (_start, _set_unknown),
}
