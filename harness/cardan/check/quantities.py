"""Numbers in the attributes of variables: start, limits, nominal, and other values that are as good."""

from __future__ import annotations

import math
import random
from typing import Any

Value = float | int | bool | str


def attribute(variable: Any, name: str) -> float | None:
    """Return a numeric attribute of a variable, or that of its declared type; None where there is none.

    Parameters
    ----------
    variable : fmpy.model_description.ModelVariable
        The variable.
    name : str
        ``"min"``, ``"max"`` or ``"nominal"``.
    """
    text = getattr(variable, name, None)
    if text is None and variable.declaredType is not None:
        text = getattr(variable.declaredType, name, None)
    if text is None:
        return None
    try:
        return float(text)
    except ValueError:
        return None


def limits(variable: Any) -> tuple[float, float]:
    """Return the smallest and the largest allowed value; infinite where none is given."""
    low, high = attribute(variable, "min"), attribute(variable, "max")
    if variable.type == "Enumeration" and variable.declaredType is not None and variable.declaredType.items:
        values = [int(item.value) for item in variable.declaredType.items]
        low = min(values) if low is None else low
        high = max(values) if high is None else high
    return -math.inf if low is None else low, math.inf if high is None else high


def unit_of(variable: Any) -> str:
    """Return the unit of a variable, its own or that of its declared type; empty for none."""
    declared = variable.declaredType.unit if variable.declaredType is not None else None
    return variable.unit or declared or ""


def start(variable: Any) -> Value | None:
    """Return the start value in the variable's type; None where there is none or it is no such value."""
    text = variable.start
    if text is None:
        return None
    try:
        if variable.type == "Real":
            return float(text)
        if variable.type in ("Integer", "Enumeration"):
            return int(text)
    except ValueError:
        return None
    return text in ("true", "1") if variable.type == "Boolean" else str(text)


def nominal(variable: Any) -> float:
    """Return the typical size of a Real: its nominal, else its start value, else 1 (FMI's default)."""
    given = attribute(variable, "nominal")
    if given:
        return abs(given)
    first = start(variable)
    return abs(first) if isinstance(first, float) and first != 0.0 and math.isfinite(first) else 1.0


def drawn(variable: Any, chance: random.Random) -> Value | None:
    """Return a random allowed value in the usual size; None where the variable is not to be moved."""
    first, (low, high) = start(variable), limits(variable)
    if variable.type == "Real":
        base = first if isinstance(first, float) and math.isfinite(first) else 0.0
        value = base + nominal(variable) * chance.uniform(0.1, 0.9)
        return value if low <= value <= high else _inside(low, high, chance.uniform(0.1, 0.9))
    if variable.type == "Boolean":
        return chance.random() < 0.5
    if variable.type in ("Integer", "Enumeration") and high - low < 100:
        return chance.randint(math.ceil(low), math.floor(high))
    return first


def moved(variable: Any, value: Value) -> Value | None:
    """Return another allowed value, clearly apart; None where there is none.

    Strings are left alone: most of them are file names.
    """
    low, high = limits(variable)
    if variable.type == "Real":
        size = max(abs(float(value)), 0.1 * nominal(variable))
        for factor in (0.3, -0.3, 0.01, -0.01):
            other = float(value) + factor * size
            if low <= other <= high and other != value:
                return other
        return _inside(low, high, 0.5) if low < high else None
    if variable.type == "Boolean":
        return not value
    if variable.type in ("Integer", "Enumeration"):
        return next((int(value) + by for by in (1, -1) if low <= int(value) + by <= high), None)
    return None


def _inside(low: float, high: float, part: float) -> float:
    """Return a value between two limits, of which one may be infinite."""
    if math.isinf(low):
        return high - part * max(1.0, abs(high)) if math.isfinite(high) else part
    if math.isinf(high):
        return low + part * max(1.0, abs(low))
    return low + part * (high - low)
