"""Start values, limits and nominal values."""

from __future__ import annotations

import math
from typing import Any

from cardan.check.base import Check, Findings
from cardan.check.quantities import attribute, limits, start
from cardan.check.subject import Subject


class Ranges(Check):
    """FMI 2.0 section 2.2.7: attributes min, max, nominal and start."""

    id = "ranges"
    title = "Start values: present, of the right type, inside their limits"
    proves = "an importer that sets the declared start values sets allowed ones"

    def run(self, subject: Subject, part: str, found: Findings) -> None:
        """Go through all variables."""
        for variable in subject.variables:
            self._limits(variable, found)
            needed = variable.initial in ("exact", "approx") or variable.causality == "input"
            if variable.start is None:
                if needed:
                    found.fail(f"{variable.name} has no start value, which {variable.causality} with initial = "
                               f"{variable.initial} needs")
                continue
            self._start(variable, found)

    @staticmethod
    def _limits(variable: Any, found: Findings) -> None:
        low, high = limits(variable)
        if low > high:
            found.fail(f"{variable.name}: min = {low:g} is above max = {high:g}")
        nominal = attribute(variable, "nominal")
        if nominal is not None and not (math.isfinite(nominal) and nominal > 0.0):
            found.fail(f"{variable.name}: nominal = {nominal:g} must be a finite number above 0")

    @staticmethod
    def _start(variable: Any, found: Findings) -> None:
        value = start(variable)
        if value is None:
            found.fail(f"{variable.name}: start = {variable.start!r} is no value of type {variable.type}")
            return
        if isinstance(value, (bool, str)):
            return
        low, high = limits(variable)
        if not math.isfinite(value):
            found.fail(f"{variable.name}: start = {value} is not finite")
        elif not low <= value <= high:
            found.fail(f"{variable.name}: start = {value!r} is outside its limits, {low:g} to {high:g}")
        if variable.type == "Enumeration" and variable.declaredType is not None and variable.declaredType.items:
            items = [int(item.value) for item in variable.declaredType.items]
            if value not in items:
                found.fail(f"{variable.name}: start = {value} is none of the values {items} of its type")
