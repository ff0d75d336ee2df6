"""Runs over communication points, and their comparison to the last bit."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

from cardan.check.quantities import Value
from cardan.check.rig import Rig

Inputs = Callable[[float], Mapping[Any, Value]]
Row = list[Value]


def advance(rig: Rig, times: Sequence[float], inputs: Inputs, outputs: Sequence[Any]) -> list[Row]:
    """Step an initialized instance through communication points.

    Parameters
    ----------
    rig : Rig
        The instance, at ``times[0]``.
    times : sequence of float
        Communication points, s.
    inputs : callable
        Gives the values to set at the begin of the step from a time on.
    outputs : sequence
        Variables to read after each step.

    Returns
    -------
    list of list
        One row per step.
    """
    rows = []
    for now, then in zip(times, times[1:]):
        rig.set(inputs(now))
        rig.go(now, then - now)
        rows.append(rig.get(outputs))
    return rows


def run(rig: Rig, times: Sequence[float], inputs: Inputs, outputs: Sequence[Any],
        values: Mapping[Any, Value] | None = None, tolerance: float | None = None) -> list[Row]:
    """Initialize a fresh instance and step it; the first row is the state after the initialization."""
    rig.start({**inputs(times[0]), **(values or {})}, tolerance)
    return [rig.get(outputs), *advance(rig, times, inputs, outputs)]


def same(one: Value, other: Value) -> bool:
    """Return whether two values are equal to the last bit; NaN equals NaN, 0 differs from -0."""
    if isinstance(one, float) and isinstance(other, float):
        return one.hex() == other.hex()
    return one == other


def difference(names: Sequence[str], expected: Sequence[Row], found: Sequence[Row]) -> str:
    """Return where two runs differ for the first time, in words; empty where they are equal bit for bit."""
    if len(expected) != len(found):
        return f"{len(found)} rows instead of {len(expected)}"
    for place, (row, other) in enumerate(zip(expected, found)):
        wrong = [i for i in range(len(row)) if not same(row[i], other[i])]
        if wrong:
            i = wrong[0]
            more = f" (and {len(wrong) - 1} other variables)" if len(wrong) > 1 else ""
            return f"{names[i]} is {other[i]!r} instead of {row[i]!r} in row {place}{more}"
    return ""


def names_of(variables: Sequence[Any]) -> list[str]:
    """Return the names of variables."""
    return [variable.name for variable in variables]
