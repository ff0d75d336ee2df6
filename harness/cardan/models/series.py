"""Columns of a CSV file as numbers."""

from __future__ import annotations

import csv
import difflib
import math
from pathlib import Path

from cardan.models.parameters import ParameterError


def read_columns(path: Path, time_column: str, column: str, time_key: str = "time_column",
                 key: str = "column") -> tuple[list[float], list[float]]:
    """Read a time column and a value column of a CSV file with a header line; lines starting with # are skipped.

    Parameters
    ----------
    path : Path
        The file.
    time_column, column : str
        Names in the header; an empty `time_column` is the first column.
    time_key, key : str
        Keys of the scene file that are named in an error.

    Raises
    ------
    ParameterError
        If the file cannot be read, a column is missing (nearest name given), a value is no finite number, or the
        times do not increase.
    """
    try:
        with open(path, encoding="utf-8-sig", newline="") as stream:
            rows = list(csv.reader(line for line in stream if line.strip() and not line.startswith("#")))
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise ParameterError("file", str(path), f"cannot be read: {error}") from None
    if len(rows) < 2:
        raise ParameterError("file", str(path), "needs a header line and at least one row of numbers")
    header = [name.strip() for name in rows[0]]
    places = []
    for name, asked in ((time_column or header[0], time_key), (column, key)):
        if name not in header:
            near = difflib.get_close_matches(name, header, 1, 0.0)
            raise ParameterError(asked, name, f"no such column in {path.name}; nearest: {near[0]}" if near else
                                 f"no such column in {path.name}", ", ".join(header))
        places.append(header.index(name))
    times: list[float] = []
    values: list[float] = []
    for number, row in enumerate(rows[1:], start=1):
        try:
            t, value = (float(row[place]) for place in places)
        except (ValueError, IndexError):
            raise ParameterError("file", str(path), f"data row {number} has no number in each of the columns "
                                 f"{header[places[0]]} and {header[places[1]]}") from None
        if not (math.isfinite(t) and math.isfinite(value)):
            raise ParameterError("file", str(path), f"data row {number} is not finite")
        if times and t <= times[-1]:
            raise ParameterError("file", str(path), f"time does not increase at data row {number} ({t:g} s)")
        times.append(t)
        values.append(value)
    return times, values
