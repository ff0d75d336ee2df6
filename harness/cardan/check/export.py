"""Writes the reference files of an FMU, to be compared with on other machines and by other versions."""

from __future__ import annotations

import base64
import os
import shutil
from pathlib import Path

from cardan.archive import safe_directory
from cardan.check.cross_check_files import LARGEST
from cardan.check.preflight import admit
from cardan.check.processes import carry_out
from cardan.check.subject import Options
from cardan.errors import FmiError, InputError

ROWS = 200


def export_reference(fmu: str | os.PathLike[str], directory: str | os.PathLike[str], *, steps: int | None = None,
                     tolerance: float | None = None, time_limit: float = 60.0) -> list[Path]:
    """Run an FMU with moving inputs and write ``X_ref.csv``, ``X_ref.opt`` and, with inputs, ``X_in.csv``.

    Parameters
    ----------
    fmu : path-like
        The FMU file; X is its name.
    directory : path-like
        Where to write; it is made where it is missing.
    steps : int, optional
        Communication steps of the default experiment's length; by default up to its stop time, at most 10000.
    tolerance : float, optional
        Relative tolerance; by default that of the default experiment, or 1e-9. The comparison allows 100 times it.
    time_limit : float
        Seconds.

    Returns
    -------
    list of pathlib.Path
        The files written.

    Raises
    ------
    FmuError
        If the file is no FMU that can be run here.
    FmiError
        If the run fails; nothing is written then.
    InputError
        If the directory cannot be written.
    """
    about = admit(fmu)
    root = safe_directory()
    try:
        count = _count(about.path) if steps is None else steps
        rows = ROWS
        while True:
            job = {"fmu": str(about.path.absolute()), "check": "reference", "options": Options().to_dict(),
                   "errand": {"count": count, "every": max(1, -(-count // rows)), "tolerance": tolerance}}
            ended = carry_out(job, root, time_limit)
            answer = next((line["answer"] for line in ended.lines if "answer" in line), None)
            if answer is None:
                problems = [text for line in ended.lines if "found" in line for text in line["found"]["problems"]]
                raise FmiError("the reference run", 3, "; ".join(problems) or ended.death)
            texts = {name: base64.b64decode(text) for name, text in answer.items()}
            if rows == 1 or all(len(text) <= LARGEST for text in texts.values()):
                return _write(Path(directory), about.path.stem, texts)
            rows //= 2
    finally:
        shutil.rmtree(root, ignore_errors=True)


def _count(path: Path) -> int:
    """Return the steps of the default experiment."""
    from fmpy import read_model_description

    from cardan.check.subject import experiment_of

    return min(10000, experiment_of(read_model_description(str(path), validate=False)).count)


def _write(directory: Path, stem: str, texts: dict[str, bytes]) -> list[Path]:
    written = []
    try:
        directory.mkdir(parents=True, exist_ok=True)
        for name, text in sorted(texts.items()):
            path = directory / f"{stem}{name}"
            path.write_bytes(text)
            written.append(path)
    except OSError as error:
        raise InputError(f"{directory} cannot be written: {error.strerror}") from None
    return written
