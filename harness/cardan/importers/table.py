"""The table of importers, for people and for the README."""

from __future__ import annotations

from collections.abc import Iterable

from cardan.importers.runner import Outcome

HEADINGS = ("Importer", "Package", "Version", "Python", "Result", "Largest difference from FMPy")


def rows(outcomes: Iterable[Outcome]) -> list[tuple[str, ...]]:
    """Return the cells of the table, without headings."""
    found: list[tuple[str, ...]] = []
    for one in outcomes:
        result = one.status
        if one.note:
            result += f": {one.note}"
        difference = "" if one.difference is None else "0" if one.difference == 0.0 else f"{one.difference:.0e}"
        found.append((one.tool, one.package, one.version, one.python, result, difference))
    return found


def markdown(outcomes: Iterable[Outcome]) -> str:
    """Return the table in Markdown, with a line that says what is compared."""
    lines = ["| " + " | ".join(HEADINGS) + " |", "|" + "---|" * len(HEADINGS)]
    lines += ["| " + " | ".join(cell.replace("|", "\\|") for cell in row) + " |" for row in rows(outcomes)]
    return "\n".join(lines) + "\n"
