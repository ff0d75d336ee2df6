"""Runs the importers, each in a process of its own, and compares what they give."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import cardan
from cardan.archive import safe_directory
from cardan.errors import CardanError, InputError
from cardan.importers import scene

REFERENCE = "fmpy"
OTHERS = ("libcosim", "ecos", "container", "fmutool")
LIMIT = 1e-12  # largest difference from FMPy, relative to the largest value of the output over the run
PATIENCE = 120.0  # s for one importer

# Importers that the package index lists but gives no working wheel of, tried on Linux with Python 3.11 to 3.13.
UNAVAILABLE = {
    "PyFMI": "pyfmi has only a source distribution (2.5), which wants FMI Library and Assimulo built beforehand",
    "OMSimulator": "omsimulator has only a source distribution, which downloads the program while it is installed",
    "FMI++": "fmipp has only a source distribution, which wants SWIG, Boost and SUNDIALS to be built",
    "fmuloader": "0.1.2rc0 loads only FMUs that have model exchange too (it binds fmi2EnterEventMode)",
}


@dataclass(frozen=True)
class Outcome:
    """What came of one importer.

    Attributes
    ----------
    tool : str
        Name of the importer.
    package, version : str
        Distribution that brings it; version empty where it is not installed.
    python : str
        Version of the Python that it ran under.
    status : str
        ``"reference"``, ``"same"`` (within `LIMIT`), ``"no error"`` (checkers), ``"differs"``, ``"failed"`` or
        ``"skipped"``.
    difference : float or None
        Largest difference from FMPy over all outputs and steps, relative to the largest value of each output.
    note : str
        Why it was skipped or failed, or which output differs most.
    """

    tool: str
    package: str
    version: str
    python: str
    status: str
    difference: float | None = None
    note: str = ""

    @property
    def good(self) -> bool:
        """Whether nothing is wrong: skipped is not wrong, differing and failing is."""
        return self.status not in ("differs", "failed")


def compare(fmu: str | os.PathLike[str], names: Iterable[str] = OTHERS, python: str | None = None) -> list[Outcome]:
    """Run the scene in FMPy and in other importers.

    Parameters
    ----------
    fmu : path-like
        The driveline FMU.
    names : iterable of str
        Importers out of `OTHERS`.
    python : str, optional
        Interpreter to run them under (3.11 or later); by default this one.

    Returns
    -------
    list of Outcome
        FMPy first, the others in their order.

    Raises
    ------
    InputError
        If there is no such importer.
    CardanError
        If FMPy, with which the others are compared, does not run the scene.
    """
    wanted = list(names)
    for name in wanted:
        if name not in OTHERS:
            raise InputError(f"importer {name!r} does not exist; choose from {', '.join(OTHERS)}")
    path = Path(fmu).resolve()
    reference = _child(REFERENCE, path, python)
    if "rows" not in reference:
        raise CardanError(f"FMPy does not run {path}: {reference.get('failed') or reference.get('skipped')}")
    found = [_outcome(REFERENCE, reference, "reference")]
    for name in wanted:
        found.append(_judge(name, _child(name, path, python), reference["rows"]))
    return found


def unavailable() -> list[Outcome]:
    """Return a row for each importer that cannot be had (`UNAVAILABLE`)."""
    return [Outcome(tool, "", "", "", "skipped", note=why) for tool, why in UNAVAILABLE.items()]


def _child(name: str, fmu: Path, python: str | None) -> dict[str, Any]:
    """Return the answer of an importer's process; one that crashes or hangs has failed."""
    # Unpacked FMUs stand below it, and not every importer can read every path back from a URI.
    directory = safe_directory()
    try:
        answer = directory / "answer.json"
        job = {**scene.job(str(fmu)), "work": str(directory), "answer": str(answer)}
        paths = [str(Path(cardan.__file__).resolve().parent.parent), *filter(None, [os.environ.get("PYTHONPATH")])]
        environment = {**os.environ, "PYTHONPATH": os.pathsep.join(paths), "TMPDIR": str(directory)}
        done = subprocess.run([python or sys.executable, "-B", "-m", "cardan.importers", name], text=True,
                              input=json.dumps(job), capture_output=True, timeout=PATIENCE, check=False, cwd=directory,
                              env=environment)
        if answer.is_file():
            made: dict[str, Any] = json.loads(answer.read_text(encoding="utf-8"))
            return made
        last = done.stderr.strip().splitlines()[-1:] or ["no message"]
        return {"failed": f"its process ended with exit code {done.returncode}: {last[0]}"}
    except subprocess.TimeoutExpired:
        return {"failed": f"no answer within {PATIENCE:g} s"}
    except OSError as error:
        raise InputError(f"python = {python}: cannot be started: {error.strerror}") from None
    finally:
        shutil.rmtree(directory, ignore_errors=True)


def _outcome(name: str, answer: dict[str, Any], status: str, **more: Any) -> Outcome:
    from importlib import import_module

    module = import_module(f"cardan.importers.with_{name}")
    return Outcome(module.TOOL, module.DISTRIBUTION, answer.get("version", ""), answer.get("python", ""), status,
                   **more)


def _judge(name: str, answer: dict[str, Any], reference: list[list[float]]) -> Outcome:
    for status in ("skipped", "failed"):
        if status in answer:
            return _outcome(name, answer, status, note=answer[status])
    if answer["rows"] is None:
        return _outcome(name, answer, "no error")
    difference, output = largest_difference(answer["rows"], reference)
    status = "same" if difference <= LIMIT else "differs"
    return _outcome(name, answer, status, difference=difference, note=output if status == "differs" else "")


def largest_difference(rows: list[list[float]], reference: list[list[float]]) -> tuple[float, str]:
    """Return the largest difference of two runs, relative to the largest value of each output, and whose it is.

    Parameters
    ----------
    rows, reference : list of list of float, shape (steps, outputs)
        Outputs of `cardan.importers.scene`.
    """
    if len(rows) != len(reference):
        return float("inf"), f"{len(rows)} steps instead of {len(reference)}"
    worst, whose = 0.0, ""
    for name, column, right in zip(scene.OUTPUTS, zip(*rows), zip(*reference)):
        scale = max(abs(value) for value in right)
        difference = max(abs(a - b) for a, b in zip(column, right)) / scale
        if not difference <= worst:  # NaN counts as a difference
            worst, whose = difference, name
    return worst, whose
