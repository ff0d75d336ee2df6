"""Dependencies as declared against dependencies as observed."""

from __future__ import annotations

import time
from collections.abc import Sequence
from typing import Any

from cardan.check.base import Check, Findings, Skip, listed
from cardan.check.perturbation import Perturbation
from cardan.check.structure import initial_unknowns, is_initial_known
from cardan.check.subject import Subject

INITIAL, RUNNING = "InitialUnknowns", "Outputs"
SHARE = 0.3  # of the time limit, for each of the three ways of observing
AFTER = 4  # points at which the initialization is gone through for every known
BETWEEN = 4  # communication points


class Dependencies(Check):
    """FMI 2.0 section 2.2.8: attribute dependencies."""

    id = "dependencies"
    title = "Dependencies: complete, found by moving every input and parameter"
    proves = "no output was seen to depend on anything that its dependencies do not list"
    needs = ("instantiation",)

    def parts(self, subject: Subject) -> Sequence[str]:
        """Return the two lists of the model structure."""
        return (INITIAL, RUNNING)

    def run(self, subject: Subject, part: str, found: Findings) -> None:
        """Observe, then compare."""
        if part == INITIAL:
            self._initial(subject, found)
        else:
            self._running(subject, found)

    @staticmethod
    def _initial(subject: Subject, found: Findings) -> None:
        knowns = [each for each in subject.variables if is_initial_known(each) and each.variability != "constant"]
        listed_ones = {id(each.variable): each.variable for each in subject.model.initialUnknowns}
        unknowns = list({**listed_ones, **{id(each): each for each in initial_unknowns(subject.model)}}.values())
        if not unknowns or not knowns:
            raise Skip("nothing is computed at the start, or nothing can be set")
        share = SHARE * subject.options.time_limit
        watch = Perturbation(subject, knowns, unknowns, time.perf_counter() + share)
        watch.in_initialization(subject.options.points)
        inside = watch.points
        later = Perturbation(subject, knowns, unknowns, time.perf_counter() + share)
        later.after_initialization(min(AFTER, subject.options.points))
        watch.seen = {**later.seen, **watch.seen}
        watch.moved |= later.moved
        found.remark(f"InitialUnknowns: {len(watch.moved)} of {len(knowns)} knowns moved at {inside} points in "
                     f"initialization mode and through {later.points} initializations")
        _compare(INITIAL, subject.model.initialUnknowns, watch, found)

    @staticmethod
    def _running(subject: Subject, found: Findings) -> None:
        inputs = subject.having("input")
        outputs = subject.having("output")
        if not inputs or not outputs:
            raise Skip("the FMU has no inputs or no outputs")
        watch = Perturbation(subject, inputs, outputs, time.perf_counter() + SHARE * subject.options.time_limit)
        watch.at_communication_points(BETWEEN)
        found.remark(f"Outputs: {len(watch.moved)} of {len(inputs)} inputs moved at {watch.points} communication "
                     "points")
        _compare(RUNNING, subject.model.outputs, watch, found)


def _compare(name: str, unknowns: Sequence[Any], watch: Perturbation, found: Findings) -> None:
    """Compare what was seen with what is declared."""
    declared = {each.variable.name: each.dependencies for each in unknowns}
    hidden = [text for (unknown, known), text in watch.seen.items()
              if _lacks(declared.get(unknown), known)]
    for text in hidden[:10]:
        found.fail(f"not among the dependencies: {text}")
    if len(hidden) > 10:
        found.fail(f"and {len(hidden) - 10} more that are not among the dependencies")
    if watch.unsteady:
        found.warn(watch.unsteady)
    if watch.refused:
        found.remark(f"{name}: setting them was refused: {listed(sorted(watch.refused))}")
    idle = [f"{unknown} on {known.name}" for unknown, knowns in declared.items() for known in knowns or []
            if known.name in watch.moved and (unknown, known.name) not in watch.seen]
    if idle:
        found.remark(f"{name}: declared but never seen: {listed(idle)}")


def _lacks(dependencies: list[Any] | None, known: str) -> bool:
    """Return whether a list of dependencies says that there is none on `known`; no list says that all are there."""
    return dependencies is not None and known not in {each.name for each in dependencies}
