"""The reference CSV files: ``#`` comment lines, one header line ``name [unit]``, then numbers.

``load("spatial")`` gives the columns by name; the digits beyond a double's are kept in the file.
"""

from __future__ import annotations

import csv
from dataclasses import dataclass
from pathlib import Path

FOLDER = Path(__file__).parent


@dataclass(frozen=True)
class Table:
    """A reference file: its comment lines, its units and its columns by name."""

    comments: list[str]
    units: dict[str, str]
    columns: dict[str, list[float]]

    def __getitem__(self, name: str) -> list[float]:
        """Return one column; `name` without its unit."""
        return self.columns[name]

    def row(self, index: int) -> dict[str, float]:
        """Return one row as name to value."""
        return {name: column[index] for name, column in self.columns.items()}


def load(name: str, folder: Path = FOLDER) -> Table:
    """Return the reference table `name`, a case of ``cases.CASES``, ``hill_edges`` or ``hill_growth``.

    Raises
    ------
    FileNotFoundError
        If there is no such file, with the command that makes it.
    """
    path = folder / f"{name}.csv"
    if not path.is_file():
        raise FileNotFoundError(f"no reference {path}: make it with 'python -m tests.reference.generate {name}'")
    lines = path.read_text(encoding="ascii").splitlines()
    comments = [line[1:].strip() for line in lines if line.startswith("#")]
    rows = list(csv.reader(line for line in lines if not line.startswith("#")))
    heads = [head.partition(" [") for head in rows[0]]
    names = [head[0] for head in heads]
    columns = {name: [float(row[i]) for row in rows[1:]] for i, name in enumerate(names)}
    return Table(comments, {head[0]: head[2].rstrip("]") for head in heads}, columns)


def save(name: str, comments: list[str], heads: list[str], rows: list[list[str]], folder: Path = FOLDER) -> Path:
    """Write a table of numbers given as text and return its path."""
    path = folder / f"{name}.csv"
    lines = [f"# {line}" for line in comments] + [",".join(heads)] + [",".join(row) for row in rows]
    path.write_text("\n".join(lines) + "\n", encoding="ascii")
    return path
