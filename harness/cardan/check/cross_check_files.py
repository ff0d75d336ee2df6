"""Reference files in the form of the FMI cross-check rules: ``X_ref.csv``, ``X_in.csv``, ``X_ref.opt``.

The rules: https://github.com/modelica/fmi-cross-check, FMI-CROSS-CHECK-RULES.md, sections 9.1.4 and appendix B.
"""

from __future__ import annotations

import bisect
import csv
import math
from dataclasses import dataclass, field
from pathlib import Path

from cardan.errors import InputError

REQUIRED = ("StartTime", "StopTime", "StepSize", "RelTol")
LARGEST = 1_000_000  # bytes of a CSV file, by the rules


@dataclass(frozen=True)
class Signals:
    """Columns over time; `times` may have a point twice, where a signal jumps."""

    times: list[float]
    columns: dict[str, list[float]]

    def at(self, name: str, time: float, linear: bool) -> float:
        """Return a signal at a time, after the jump where there is one; its first and last value last for ever.

        Parameters
        ----------
        name : str
            Column.
        time : float
            s.
        linear : bool
            Whether to interpolate; else the last value holds.
        """
        values = self.columns[name]
        right = bisect.bisect_right(self.times, time)
        if right == 0:
            return values[0]
        if right == len(self.times) or not linear or self.times[right - 1] == time:
            return values[right - 1]
        begin, end = self.times[right - 1], self.times[right]
        part = (time - begin) / (end - begin)
        return values[right - 1] + part * (values[right] - values[right - 1])


@dataclass(frozen=True)
class Reference:
    """What an FMU has to give.

    Attributes
    ----------
    source : str
        The file with the results.
    options : dict of str to float
        ``StartTime``, ``StopTime``, ``StepSize`` (s, 0 for a variable step), ``RelTol`` and what else is given.
    results, inputs : Signals
        Outputs to reach, inputs to apply.
    """

    source: str
    options: dict[str, float]
    results: Signals
    inputs: Signals = field(default_factory=lambda: Signals([], {}))

    @property
    def step(self) -> float:
        """Communication step, s: the StepSize, or the spacing of the results."""
        given = self.options["StepSize"] or self.options.get("OutputIntervalLength", 0.0)
        span = self.options["StopTime"] - self.options["StartTime"]
        return given or span / max(1, len(self.results.times) - 1)


def find_reference(fmu: Path, identifier: str, directory: str = "") -> Reference | None:
    """Read the reference files of an FMU.

    Parameters
    ----------
    fmu : pathlib.Path
        The FMU file.
    identifier : str
        Its model identifier: the files are named after the FMU file or after it.
    directory : str
        Where they are; empty for beside the FMU.

    Returns
    -------
    Reference or None
        None where there are none beside the FMU.

    Raises
    ------
    InputError
        If the given directory has none, or a file cannot be read.
    """
    folder = Path(directory) if directory else fmu.parent
    stems = dict.fromkeys((fmu.stem, identifier))
    for stem in stems:
        results = folder / f"{stem}_ref.csv"
        if results.is_file():
            signals = read_signals(results)
            given = folder / f"{stem}_in.csv"
            names = (folder / f"{stem}_ref.opt", folder / f"{stem}.opt")
            options = next((path for path in names if path.is_file()), None)
            if options is None:
                raise InputError(f"{names[0]} is missing: it says how {results.name} was made")
            inputs = read_signals(given) if given.is_file() else Signals([], {})
            return Reference(str(results), read_options(options), signals, inputs)
    if directory:
        raise InputError(f"{directory} has no reference: there is no "
                         + " and no ".join(f"{stem}_ref.csv" for stem in stems))
    return None


def read_signals(path: Path) -> Signals:
    """Read a CSV file: the time and one column per variable, names in the first line.

    Raises
    ------
    InputError
        If a cell is no number, a row is too short or too long, or the time goes back; with the line.
    """
    lines = list(csv.reader(_text(path).splitlines()))
    if len(lines) < 2 or len(lines[0]) < 2:
        raise InputError(f"{path} has no data: a line with names and at least one with numbers are needed")
    names = [name.strip() for name in lines[0]]
    rows: list[list[float]] = []
    for number, cells in enumerate(lines[1:], 2):
        if not cells:
            continue
        if len(cells) != len(names):
            raise InputError(f"{path}, line {number}: {len(cells)} numbers for {len(names)} names")
        rows.append([_number(cell, path, number) for cell in cells])
        if len(rows) > 1 and rows[-1][0] < rows[-2][0]:
            raise InputError(f"{path}, line {number}: the time goes back from {rows[-2][0]:g} to {rows[-1][0]:g}")
    columns = {name: [row[place] for row in rows] for place, name in enumerate(names)}
    return Signals(columns.pop(names[0]), columns)


def read_options(path: Path) -> dict[str, float]:
    """Read an options file: a name, a comma and a number per line; texts such as the SolverType are passed over.

    Raises
    ------
    InputError
        If a required element is missing or makes no sense.
    """
    found: dict[str, float] = {}
    for line in _text(path).splitlines():
        name, comma, text = line.partition("//")[0].partition(",")
        if comma:
            try:
                found[name.strip()] = float(text)
            except ValueError:
                continue
    missing = [name for name in REQUIRED if name not in found]
    if missing:
        raise InputError(f"{path} lacks {', '.join(missing)}, each with a number after a comma")
    span = found["StopTime"] - found["StartTime"]
    if not (span > 0.0 and 0.0 <= found["StepSize"] <= span and found["RelTol"] > 0.0 and math.isfinite(span)):
        raise InputError(f"{path}: StopTime has to be after StartTime, StepSize from 0 to their difference, and RelTol "
                         "above 0")
    return found


def signals_text(signals: Signals) -> str:
    """Return a CSV file's text, numbers with all digits."""
    rows = zip(signals.times, *signals.columns.values())
    head = ",".join(f'"{name}"' for name in ("time", *signals.columns))
    return "\n".join([head, *(",".join(map(repr, row)) for row in rows)]) + "\n"


def options_text(options: dict[str, float]) -> str:
    """Return an options file's text; the optional SolverType is left out, since readers exist that stumble over it."""
    return "".join(f"{name}, {value!r}\n" for name, value in options.items())


def _text(path: Path) -> str:
    try:
        return path.read_text(encoding="utf-8-sig")
    except (OSError, UnicodeDecodeError) as error:
        raise InputError(f"{path} cannot be read: {error}") from None


def _number(cell: str, path: Path, line: int) -> float:
    try:
        return float(cell)
    except ValueError:
        raise InputError(f"{path}, line {line}: {cell!r} is no number") from None
