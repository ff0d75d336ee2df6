"""Call orders that FMI 2.0 allows: all of them have to work."""

from __future__ import annotations

import ctypes
from collections.abc import Callable, Sequence

from cardan.check.base import Check, Findings, Skip
from cardan.check.rig import Rig
from cardan.check.subject import Subject

STEPS = 3
Order = Callable[[Rig], None]


class LegalCalls(Check):
    """FMI 2.0 section 4.2.4: state machine of calling sequence from master to slave."""

    id = "legal-calls"
    title = "Life cycle: every legal order of calls works"
    proves = "a master may leave, reset and free the instance in every state, and query it where the standard allows it"
    needs = ("instantiation", "run")

    def parts(self, subject: Subject) -> Sequence[str]:
        """Return the orders by name."""
        return tuple(ORDERS)

    def run(self, subject: Subject, part: str, found: Findings) -> None:
        """Go through one order."""
        rig = Rig(subject)
        ORDERS[part](rig)
        rig.free()


def steps(rig: Rig, count: int = STEPS) -> None:
    """Do steps from the start time on."""
    times = rig.subject.experiment.times(count)
    for now, then in zip(times, times[1:]):
        rig.go(now, then - now)


def whole_run(rig: Rig) -> None:
    """Initialize, step, terminate."""
    rig.start()
    steps(rig)
    rig.good("fmi2Terminate")


def _nothing(rig: Rig) -> None:
    pass


def _leave_initialization(rig: Rig) -> None:
    rig.begin()


def _no_steps(rig: Rig) -> None:
    rig.start()
    rig.good("fmi2Terminate")


def _no_terminate(rig: Rig) -> None:
    rig.start()
    steps(rig)


def _read_after_terminate(rig: Rig) -> None:
    whole_run(rig)
    rig.get(rig.subject.outputs)


def _reset_instantiated(rig: Rig) -> None:
    rig.good("fmi2Reset")
    whole_run(rig)


def _reset_and_free(rig: Rig) -> None:
    rig.start()
    rig.good("fmi2Reset")


def _reset_initializing(rig: Rig) -> None:
    rig.begin()
    rig.good("fmi2Reset")
    whole_run(rig)


def _reset_running(rig: Rig) -> None:
    rig.start()
    steps(rig)
    rig.good("fmi2Reset")
    rig.good("fmi2Reset")
    whole_run(rig)


def _reset_terminated(rig: Rig) -> None:
    whole_run(rig)
    rig.good("fmi2Reset")
    whole_run(rig)


def _full_setup(rig: Rig) -> None:
    experiment = rig.subject.experiment
    rig.begin(experiment.tolerance or 1e-6, experiment.stop)
    rig.initialize()
    steps(rig)
    rig.good("fmi2Terminate")


def _later_start(rig: Rig) -> None:
    experiment = rig.subject.experiment
    begin = experiment.start + 10.0 * experiment.step
    rig.good("fmi2SetupExperiment", 0, 0.0, begin, 0, 0.0, what=f"start {begin!r}")
    rig.good("fmi2EnterInitializationMode")
    rig.initialize()
    for place in range(STEPS):
        now = experiment.start + (10 + place) * experiment.step
        rig.go(now, experiment.start + (11 + place) * experiment.step - now)


def _logging(rig: Rig) -> None:
    names = [each.name.encode() for each in rig.subject.model.logCategories]
    categories = (ctypes.c_char_p * len(names))(*names)

    def switch() -> None:
        rig.good("fmi2SetDebugLogging", 0, 0, None, what="off")
        rig.good("fmi2SetDebugLogging", 1, len(names), categories, what="on, all categories")
        rig.good("fmi2SetDebugLogging", 1, 0, None, what="on, no category")

    switch()
    rig.begin()
    switch()
    rig.initialize()
    switch()
    steps(rig)
    switch()
    rig.good("fmi2Terminate")
    switch()


def _empty_lists(rig: Rig) -> None:
    rig.begin()
    for kind, value in (("Real", ctypes.c_double), ("Integer", ctypes.c_int), ("Boolean", ctypes.c_int),
                        ("String", ctypes.c_char_p)):
        for action in ("Get", "Set"):
            rig.good(f"fmi2{action}{kind}", (ctypes.c_uint * 0)(), 0, (value * 0)(), what="no variables")


def _repeatable_step(rig: Rig) -> None:
    experiment = rig.subject.experiment
    rig.start()
    rig.good("fmi2DoStep", experiment.start, experiment.step, 0, what="noSetFMUStatePriorToCurrentPoint = false")


def _status_queries(rig: Rig) -> None:
    rig.start()
    steps(rig)
    buffers = (("", ctypes.c_int), ("Real", ctypes.c_double), ("Integer", ctypes.c_int), ("Boolean", ctypes.c_int),
               ("String", ctypes.c_char_p))
    for kind, value in buffers:
        for query in range(4):  # most are answered with discard, which is right where no step is pending
            rig.status(f"fmi2Get{kind}Status", query, ctypes.byref(value()), what=f"kind {query}")


def _states_everywhere(rig: Rig) -> None:
    if not rig.subject.capability.canGetAndSetFMUstate:
        raise Skip("the FMU does not claim canGetAndSetFMUstate")
    saved = [rig.save()]
    rig.begin()
    saved.append(rig.save())
    rig.initialize()
    steps(rig)
    saved.append(rig.save())
    rig.restore(saved[-1])
    rig.good("fmi2Terminate")
    saved.append(rig.save())
    for state in saved:
        rig.forget(state)


def _nothing_to_free(rig: Rig) -> None:
    rig.subject.trail.mark("fmi2FreeInstance(NULL)")
    rig.library.fmi2FreeInstance(None)
    whole_run(rig)


ORDERS: dict[str, Order] = {
    "instantiate, free": _nothing,
    "initialization mode, free": _leave_initialization,
    "initialize, terminate, free": _no_steps,
    "steps, free": _no_terminate,
    "steps, terminate, get, free": _read_after_terminate,
    "initialize, reset, free": _reset_and_free,
    "reset at once, run": _reset_instantiated,
    "reset in initialization mode, run": _reset_initializing,
    "reset twice between steps, run": _reset_running,
    "reset after terminate, run": _reset_terminated,
    "stop time and tolerance given": _full_setup,
    "another start time": _later_start,
    "logging switched in every state": _logging,
    "lists without variables": _empty_lists,
    "step that may be repeated": _repeatable_step,
    "status queries": _status_queries,
    "state saved in every state": _states_everywhere,
    "null pointer freed": _nothing_to_free,
}
