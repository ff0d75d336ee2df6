"""Columns of a CSV file as numbers."""

from __future__ import annotations

import csv
import difflib
import math
from pathlib import Path

from cardan.models.parameters import ParameterError
from cardan.units import UnitError, from_si, split_heading

SHORTEST = 1e-9  # s between rows: slopes and curvatures of closer ones leave the range of numbers


def read_columns(path: Path, time_column: str, column: str, unit: str, time_key: str = "time_column",
                 key: str = "column") -> tuple[list[float], list[float]]:
    """Read a time column and a value column of a CSV file with a header line; lines starting with # are skipped.

    A heading with a unit in brackets (``T [kN.m]``; the name alone finds it as well) is converted to SI; other columns
    are in SI.

    Parameters
    ----------
    path : Path
        The file.
    time_column, column : str
        Names in the header; an empty `time_column` is the first column.
    unit : str
        SI unit of the values.
    time_key, key : str
        Keys of the scene file that are named in an error.

    Raises
    ------
    ParameterError
        If the file cannot be read, a column is missing (nearest name given) or has a unit of another
        dimension, a value is no finite number, or the
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
    bare = [split_heading(name)[0] for name in header]
    places, factors = [], []
    for name, asked, wanted in ((time_column or header[0], time_key, "s"), (column, key, unit)):
        if name in header:
            place = header.index(name)
        elif bare.count(name) == 1:
            place = bare.index(name)
        else:
            near = difflib.get_close_matches(name, header, 1, 0.0)
            raise ParameterError(asked, name, f"no such column in {path.name}; nearest: {near[0]}" if near else
                                 f"no such column in {path.name}", ", ".join(header))
        given = split_heading(header[place])[1]
        try:
            factors.append(from_si(1.0, given, wanted) if given else 1.0)
        except UnitError as error:
            raise ParameterError(asked, header[place], f"unit of this column of {path.name}: {error}",
                                 f"a unit such as {wanted}; no brackets: {wanted}") from None
        places.append(place)
    times: list[float] = []
    values: list[float] = []
    for number, row in enumerate(rows[1:], start=1):
        try:
            t, value = (float(row[place]) * factor for place, factor in zip(places, factors))
        except (ValueError, IndexError):
            raise ParameterError("file", str(path), f"data row {number} has no number in each of the columns "
                                 f"{header[places[0]]} and {header[places[1]]}") from None
        if not (math.isfinite(t) and math.isfinite(value)):
            raise ParameterError("file", str(path), f"data row {number} is not finite")
        if times and t <= times[-1]:
            raise ParameterError("file", str(path), f"time does not increase at data row {number} ({t:g} s)")
        if times and t - times[-1] < SHORTEST:
            raise ParameterError("file", str(path), f"time increases by less than {SHORTEST:g} s at data row {number}")
        times.append(t)
        values.append(value)
    return times, values
