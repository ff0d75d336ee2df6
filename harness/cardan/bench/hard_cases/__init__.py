"""The hard cases: each states a property, measures it and says whether it holds.

`measure_all` gives the rows of the table in the README; the tests run the same functions.
"""

from __future__ import annotations

from collections.abc import Iterator

from cardan.bench.hard_cases import counting, coupled, inputs, limits, parametric, reversal, rotation
from cardan.bench.hard_cases.outcome import CASES, HardCase, Outcome

__all__ = ["CASES", "HardCase", "Outcome", "measure_all"]

_MODULES = (counting, coupled, inputs, limits, parametric, reversal, rotation)  # each enters its cases when imported


def measure_all() -> Iterator[tuple[HardCase, list[Outcome]]]:
    """Measure every case in the order of its number."""
    for number in sorted(CASES):
        yield CASES[number], list(CASES[number].measure())
