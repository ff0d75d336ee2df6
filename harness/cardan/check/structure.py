"""ModelStructure: Outputs and InitialUnknowns complete, and with dependencies."""

from __future__ import annotations

from typing import Any

from cardan.check.base import Check, Findings, listed
from cardan.check.subject import Subject


class Structure(Check):
    """FMI 2.0 section 2.2.8: definition of the model structure."""

    id = "structure"
    title = "ModelStructure: Outputs and InitialUnknowns complete"
    proves = "importers know what has to be computed at the start, and can sort several FMUs"

    def run(self, subject: Subject, part: str, found: Findings) -> None:
        """Compare the lists with the variables that belong there."""
        model = subject.model
        self._compare("Outputs", model.outputs, subject.having("output"), found)
        self._compare("InitialUnknowns", model.initialUnknowns, initial_unknowns(model), found)
        for name, unknowns in (("Outputs", model.outputs), ("InitialUnknowns", model.initialUnknowns)):
            open_ones = [each.variable.name for each in unknowns if each.dependencies is None]
            if open_ones:
                found.remark(f"{name} without dependencies, so that importers assume all: {listed(open_ones)}")
            for unknown in unknowns:
                self._entry(name, unknown, found)

    @staticmethod
    def _compare(name: str, unknowns: list[Any], expected: list[Any], found: Findings) -> None:
        given = [each.variable.name for each in unknowns]
        wanted = [each.name for each in expected]
        if wanted and not given:
            found.fail(f"{name} is missing; it has to list {listed(wanted)}")
            return
        missing = [each for each in wanted if each not in set(given)]
        if missing:
            found.fail(f"{name} does not list {listed(missing)}")
        extra = [each for each in given if each not in set(wanted)]
        if extra:
            found.fail(f"{name} lists what does not belong there: {listed(extra)}")
        twice = sorted({each for each in given if given.count(each) > 1})
        if twice:
            found.fail(f"{name} lists twice: {listed(twice)}")

    @staticmethod
    def _entry(name: str, unknown: Any, found: Findings) -> None:
        """Judge the dependencies of one unknown as they are written."""
        target, given, kinds = unknown.variable.name, unknown.dependencies, unknown.dependenciesKind
        if kinds is not None and (given is None or len(kinds) != len(given)):
            found.fail(f"{name}, {target}: {len(kinds)} dependenciesKind for {len(given or [])} dependencies")
        for known in given or []:
            if name == "InitialUnknowns" and not is_initial_known(known):
                found.fail(f"{name}, {target} depends on {known.name}, which is computed itself: only inputs, "
                           "variables with initial = exact and the time may stand there")


def initial_unknowns(model: Any) -> list[Any]:
    """Return what InitialUnknowns has to list: computed outputs, calculated parameters, computed states and rates."""
    computed = ("approx", "calculated")
    states = {id(each) for unknown in model.derivatives
              for each in (unknown.variable, getattr(unknown.variable, "derivative", None))}
    return [each for each in model.modelVariables
            if (each.causality == "output" and each.initial in computed)
            or each.causality == "calculatedParameter"
            or (id(each) in states and each.initial in computed)]


def is_initial_known(variable: Any) -> bool:
    """Return whether something may depend on a variable in initialization mode."""
    return variable.causality in ("input", "independent") or variable.initial == "exact"
