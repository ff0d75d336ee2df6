"""Units: defined, and with the SI exponents and factors that their names say."""

from __future__ import annotations

from typing import Any

from cardan.check.base import Check, Findings, listed
from cardan.check.quantities import unit_of
from cardan.check.subject import Subject
from cardan.check.unit_names import BASE, Reading, readings

CLOSE = 1e-5  # relative; tools print factors with six digits
RAD = BASE.index("rad")


class Units(Check):
    """FMI 2.0 section 2.2.2: definition of units."""

    id = "units"
    title = "Units: every one defined, exponents and factors as its name says"
    proves = "tools can convert every value: units are defined, and mean in SI what they are called"

    def run(self, subject: Subject, part: str, found: Findings) -> None:
        """Compare names with definitions."""
        definitions: dict[str, Any] = {}
        for unit in subject.model.unitDefinitions:
            if unit.name in definitions:
                found.fail(f"unit {unit.name} is defined twice")
            definitions[unit.name] = unit
            self._definition(unit, found)
        reals = [each for each in subject.variables if each.type == "Real"]
        for variable in reals:
            self._variable(variable, definitions, found)
        bare = [each.name for each in reals if not unit_of(each)]
        if bare and len(bare) < len(reals):
            found.warn(f"Real variables without a unit, while others have one (a pure number has the unit 1): "
                       f"{listed(bare)}")
        elif bare:
            found.remark("no Real variable has a unit")
        self._derivatives(subject, found)

    def _definition(self, unit: Any, found: Findings) -> None:
        """Compare a unit's name with its definition."""
        meant = readings(unit.name)
        if not meant:
            found.remark(f"unit {unit.name}: its name cannot be read, so its definition is not verified")
        if unit.baseUnit is None:
            found.remark(f"unit {unit.name} has no BaseUnit: tools cannot convert it")
            return
        given = _given(unit.baseUnit)
        if meant and not any(_agree(given, each) for each in meant):
            if any(_agree(given, each, but_rad=True) for each in meant):
                found.warn(f"unit {unit.name} is defined as {_shown(given)}, but its name says {_shown(meant[0])}: "
                           "the plane angle is not counted the same way")
            else:
                found.fail(f"unit {unit.name} is defined as {_shown(given)}, but its name says {_shown(meant[0])}")
        for display in unit.displayUnits:
            self._display(unit, given, display, found)

    @staticmethod
    def _display(unit: Any, given: Reading, display: Any, found: Findings) -> None:
        """Compare a display unit's factor and offset with what its name says."""
        meant = [each for each in readings(display.name) if _same(each.exponents, given.exponents, but_rad=True)]
        factor, offset = float(display.factor), float(display.offset)
        if factor == 0.0:
            found.fail(f"display unit {display.name} of {unit.name} has the factor 0")
            return
        if not readings(display.name):
            found.remark(f"display unit {display.name} of {unit.name}: its name cannot be read")
        elif not meant:
            found.fail(f"display unit {display.name} of {unit.name} is of another dimension: {unit.name} is "
                       f"{_shown(given)}")
        elif not any(_close(factor, given.factor / each.factor)
                     and _close(offset, (given.offset - each.offset) / each.factor) for each in meant):
            right = given.factor / meant[0].factor
            found.fail(f"display unit {display.name} of {unit.name}: factor {factor:.9g}, offset {offset:.9g} instead "
                       f"of factor {right:.9g}, offset {(given.offset - meant[0].offset) / meant[0].factor:.9g}")

    @staticmethod
    def _variable(variable: Any, definitions: dict[str, Any], found: Findings) -> None:
        """Look a variable's units up."""
        name = unit_of(variable)
        if name and name not in definitions:
            found.fail(f"{variable.name}: its unit {name} is not defined")
        elif variable.displayUnit and not name:
            found.fail(f"{variable.name} has the display unit {variable.displayUnit}, but no unit")
        elif variable.displayUnit and variable.displayUnit != name:
            known = [each.name for each in definitions[name].displayUnits]
            if variable.displayUnit not in known:
                found.fail(f"{variable.name}: its display unit {variable.displayUnit} is not defined for {name}")

    @staticmethod
    def _derivatives(subject: Subject, found: Findings) -> None:
        """Compare the units of variables and their derivatives by time."""
        for variable in subject.variables:
            state = variable.derivative
            if state is None or not hasattr(state, "name"):
                continue
            rates, values = readings(unit_of(variable)), readings(unit_of(state))
            if unit_of(variable) and unit_of(state) and rates and values and not any(
                    _same(rate.exponents, _per_second(value.exponents)) for rate in rates for value in values):
                found.fail(f"{variable.name} is the derivative of {state.name}, but its unit {unit_of(variable)} is "
                           f"not {unit_of(state)} per second")


def _given(base: Any) -> Reading:
    return Reading(float(base.factor), tuple(int(getattr(base, name) or 0) for name in BASE), float(base.offset))


def _per_second(exponents: tuple[int, ...]) -> tuple[int, ...]:
    return tuple(power - (name == "s") for name, power in zip(BASE, exponents))


def _same(one: tuple[int, ...], other: tuple[int, ...], but_rad: bool = False) -> bool:
    return all(a == b for place, (a, b) in enumerate(zip(one, other)) if not (but_rad and place == RAD))


def _agree(given: Reading, meant: Reading, but_rad: bool = False) -> bool:
    """Return whether a definition is what a name says. Without the plane angle, a turn may count as 1."""
    if not _same(given.exponents, meant.exponents, but_rad):
        return False
    if _close(given.offset, meant.offset) and _close(given.factor, meant.factor):
        return True
    turns = 6.283185307179586 ** (meant.exponents[RAD] - given.exponents[RAD])
    return but_rad and _close(given.factor * turns, meant.factor)


def _close(one: float, other: float) -> bool:
    return abs(one - other) <= CLOSE * max(abs(one), abs(other))


def _shown(reading: Reading) -> str:
    parts = [name if power == 1 else f"{name}{power}" for name, power in zip(BASE, reading.exponents) if power]
    text = ".".join(parts) or "1"
    if not _close(reading.factor, 1.0):
        text = f"{reading.factor:.9g} {text}"
    return f"{text} + {reading.offset:.9g}" if reading.offset else text
