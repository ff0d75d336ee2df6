"""The files of a report: results as JSON and CSV, tables as Markdown, figures."""

from __future__ import annotations

import csv
import os
from pathlib import Path

from cardan.bench.figures import draw
from cardan.bench.sections import Measured
from cardan.bench.tables import report
from cardan.errors import InputError
from cardan.storage import written_beside

RESULTS = "results.json"


def prepare(folder: Path) -> None:
    """Make the directory and see that it can be written to, before minutes are spent on measuring.

    Raises
    ------
    InputError
        If it cannot.
    """
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise InputError(f"{folder} cannot be made a directory: {error.strerror or error}; give another one with -o") \
            from None
    if not os.access(folder, os.W_OK):
        raise InputError(f"{folder} is not writable; give another directory with -o")


def write(measured: Measured, folder: Path) -> list[Path]:
    """Write everything; each file is complete or not there.

    Parameters
    ----------
    measured : Measured
        What was measured.
    folder : Path
        Existing directory.

    Returns
    -------
    list of Path
        The files.
    """
    measured = Measured(**measured.to_dict())  # tables and figures show what is stored
    results, text = folder / RESULTS, folder / "report.md"
    with written_beside(results) as beside:
        measured.save(beside)
    with written_beside(text) as beside:
        beside.write_text(report(measured), encoding="utf-8")
    files = [results, text]
    for name, records in measured.tables.items():
        path = folder / f"{name}.csv"
        with written_beside(path) as beside, open(beside, "w", newline="", encoding="utf-8") as stream:
            writer = csv.DictWriter(stream, list(records[0]) if records else [], lineterminator="\n")
            writer.writeheader()
            writer.writerows(records)
        files.append(path)
    return files + draw(measured.tables, folder)
