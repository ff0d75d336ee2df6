"""The hard cases as a table: what is demanded, and how far inside its bound the worst figure lies."""

from __future__ import annotations

from cardan.bench.hard_cases import CASES
from cardan.bench.records import Options, Record, Tables, Tell


def measure(options: Options, tell: Tell) -> Tables:
    """Return the table ``hard``: one record per property of every case."""
    records: list[Record] = []
    for place, number in enumerate(sorted(CASES)):
        case = CASES[number]
        for outcome in case.measure():
            records.append({"number": number, "case": case.title, "property": outcome.detail,
                            "measured": outcome.measured, "bound": outcome.bound, "unit": outcome.unit,
                            "held": outcome.held})
        tell((place + 1) / len(CASES))
    return {"hard": records}
