"""Carries out the checks one after the other, each in a process of its own."""

from __future__ import annotations

import hashlib
import os
import shutil
import time
from collections.abc import Callable, Iterable
from dataclasses import replace
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

from cardan.archive import safe_directory
from cardan.check.base import Check, Findings
from cardan.check.catalog import chosen, find
from cardan.check.preflight import admit
from cardan.check.processes import carry_out
from cardan.check.report import FAILED, PASSED, SKIPPED, Outcome, Report
from cardan.check.subject import Options

Progress = Callable[[int, int, str], None]


def check_fmu(path: str | os.PathLike[str], *, only: Iterable[str] = (), leave_out: Iterable[str] = (),
              options: Options | None = None, strict: bool = False, progress: Progress | None = None) -> Report:
    """Check an FMI 2.0 co-simulation FMU.

    Parameters
    ----------
    path : path-like
        The FMU file.
    only, leave_out : iterable of str
        Ids of the checks to carry out (all where empty) and of those to leave out.
    options : Options, optional
        How thoroughly to look.
    strict : bool
        Whether warnings fail a check.
    progress : callable, optional
        Called as ``progress(done, total, title)`` before each check.

    Returns
    -------
    Report

    Raises
    ------
    FmuError
        If the file is no FMU that can be checked here.
    InputError
        If a check has an unknown id, or reference files cannot be read.
    """
    from cardan.check.cross_check_files import find_reference
    from cardan.provenance import versions

    checks = chosen(only, leave_out)
    options = options or Options()
    if options.reference:
        options = replace(options, reference=str(Path(options.reference).absolute()))
    about = admit(path)
    if find("reference") in checks:  # what is wrong with the files is told before the work
        find_reference(about.path, about.identifier, options.reference)

    report = Report(str(about.path), about.model_name, hashlib.sha256(about.path.read_bytes()).hexdigest(),
                    versions(), datetime.now(UTC).isoformat(timespec="seconds"))
    root = safe_directory()
    blocked: set[str] = set()
    try:
        for place, check in enumerate(checks):
            if progress is not None:
                progress(place, len(checks), check.title)
            lacking = blocked.intersection(check.needs)
            if lacking:
                blocked.add(check.id)
                report.outcomes.append(Outcome(check.id, check.title, check.proves, SKIPPED,
                                               reason=f"nothing to work on: {', '.join(lacking)} failed"))
                continue
            began = time.perf_counter()
            found = examine(check, about.path.absolute(), options, root)
            report.outcomes.append(_outcome(check, found, time.perf_counter() - began, strict))
            if found.data.get("stopped"):
                blocked.add(check.id)
            options = replace(options, exciting=options.exciting and not found.data.get("resting"),
                              steps=max(1, min(options.steps, found.data.get("reached", options.steps))))
    finally:
        shutil.rmtree(root, ignore_errors=True)
    return report


def examine(check: Check, path: Path, options: Options, root: Path) -> Findings:
    """Carry out one check in a process; after a crash go on with the next part in another one.

    Returns
    -------
    Findings
        Of all parts; ``data["stopped"]`` is set where the first one could not be carried out to its end.
    """
    total = Findings()
    limit = check.patience * options.time_limit
    job: dict[str, Any] = {"fmu": str(path), "check": check.id, "options": options.to_dict(), "parts": None}
    skipped: dict[str, str] = {}
    done = 0
    while True:
        ended = carry_out(job, root, limit)
        parts, part = [""], ""
        for line in ended.lines:
            if "begin" in line:
                parts, part = line["parts"], line["begin"]
            elif "found" in line:
                stopped = line["found"]["data"].pop("stopped", False)
                total.add(line["found"])
                if line["found"]["skipped"]:
                    skipped[part] = line["found"]["skipped"]
                elif stopped and done == 0:
                    total.data["stopped"] = True
                done += 1
        if ended.complete:
            break
        total.fail(f"{part}: {ended.death}" if part else ended.death)
        if done == 0:
            total.data["stopped"] = True
        done += 1
        rest = parts[parts.index(part) + 1 :]
        if not rest:
            break
        job = {**job, "parts": rest}
    if len(skipped) == done:
        total.skipped = next(iter(skipped.values()), "")
    else:  # the other parts still count
        total.remarks += [f"{part}: left out: {reason}" for part, reason in skipped.items()]
    return total


def _outcome(check: Check, found: Findings, seconds: float, strict: bool) -> Outcome:
    problems = found.problems + (found.warnings if strict else [])
    warnings = [] if strict else found.warnings
    status = FAILED if problems else SKIPPED if found.skipped else PASSED
    return Outcome(check.id, check.title, check.proves, status, seconds,
                   found.skipped if status == SKIPPED else "", problems, warnings, found.remarks, found.figures)
