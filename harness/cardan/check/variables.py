"""The table of variables: names, value references, aliases, descriptions."""

from __future__ import annotations

from collections import defaultdict
from typing import Any

from cardan.check.base import Check, Findings, listed
from cardan.check.quantities import unit_of
from cardan.check.subject import Subject


class Variables(Check):
    """FMI 2.0 section 2.2.7: definition of model variables."""

    id = "variables"
    title = "Variables: names, value references, aliases, descriptions"
    proves = "names are unique; variables that share a value reference agree; every variable is described"

    def run(self, subject: Subject, part: str, found: Findings) -> None:
        """Go through the table."""
        variables = subject.model.modelVariables
        names: set[str] = set()
        groups: dict[tuple[str, int], list[Any]] = defaultdict(list)
        for variable in variables:
            if variable.name in names:
                found.fail(f"two variables are named {variable.name}")
            names.add(variable.name)
            kind = "Integer" if variable.type == "Enumeration" else variable.type
            groups[kind, variable.valueReference].append(variable)
        for (kind, reference), aliases in groups.items():
            if len(aliases) > 1:
                self._aliases(kind, reference, aliases, found)
        bare = [each.name for each in subject.having("parameter", "input", "output") if not each.description]
        if bare:
            found.remark(f"without a description: {listed(bare)}")
        counts = {name: len(subject.having(name)) for name in ("parameter", "input", "output", "local")}
        found.remark(", ".join(f"{count} {name}s" for name, count in counts.items() if count))

    @staticmethod
    def _aliases(kind: str, reference: int, aliases: list[Any], found: Findings) -> None:
        """Judge variables of one value reference: one quantity, so one unit and one start."""
        said = f"{listed(each.name for each in aliases)} share {kind} value reference {reference}"
        if len({unit_of(each) for each in aliases}) > 1:
            found.fail(f"{said} but have different units")
        if len({each.start for each in aliases if each.start is not None}) > 1:
            found.fail(f"{said} but have different start values")
        settable = [each.name for each in aliases if each.causality in ("parameter", "input")]
        if len(settable) > 1:
            found.fail(f"{said}, and more than one of them can be set: {listed(settable)}")
