"""The process that carries out one check: ``python -m cardan.check.worker``.

It reads a job as a JSON object from standard input: ``fmu``, ``check`` (an id), ``options``, ``folder`` and
either ``parts`` (names, or null for all) or ``errand`` (what `Check.errand` is given). Answers go line by line
to ``answers.jsonl`` in the folder, so that a crash loses nothing that was found before it.
"""

from __future__ import annotations

import json
import os
import sys
import traceback
from pathlib import Path
from typing import IO, Any

from cardan.archive import unpack
from cardan.check.base import Check, Findings, Refused, Skip
from cardan.check.catalog import find
from cardan.check.processes import carry_out
from cardan.check.subject import Options, Subject
from cardan.check.trail import Trail
from cardan.errors import CardanError


def main() -> None:
    """Do the job and leave the process at once: FMUs are known to abort it at its regular end."""
    job = json.load(sys.stdin)
    with (Path(job["folder"]) / "answers.jsonl").open("w", encoding="utf-8") as answers:
        _work(job, find(job["check"]), answers)
        _write(answers, {"end": True})
    sys.stdout.flush()
    os._exit(0)


def _work(job: dict[str, Any], check: Check, answers: IO[str]) -> None:
    found = Findings()
    try:
        subject = open_subject(job)
        if "errand" in job:
            _write(answers, {"answer": check.errand(subject, job["errand"])})
            return
        parts = job["parts"] or list(check.parts(subject))
    except Exception as error:
        _enter(found, error)
        _write(answers, {"begin": "", "parts": [""]})
        _write(answers, {"found": found.to_dict()})
        return
    for part in parts:
        found = Findings()
        _write(answers, {"begin": part, "parts": parts})
        try:
            check.run(subject, part, found)
        except Exception as error:
            _enter(found, error)
            found.data["stopped"] = not found.skipped
        if part:
            found.problems = [f"{part}: {text}" for text in found.problems]
            found.warnings = [f"{part}: {text}" for text in found.warnings]
        _write(answers, {"found": found.to_dict()})


def open_subject(job: dict[str, Any]) -> Subject:
    """Unpack and read the FMU of a job."""
    import fmpy
    from fmpy import read_model_description

    folder = Path(job["folder"])
    options = Options(**job["options"])
    path = Path(job["fmu"])
    directory = unpack(path, fmpy.platform)
    scratch = folder / "scratch"
    scratch.mkdir()

    def errand(check: str, data: dict[str, Any]) -> dict[str, Any]:
        sent = {"fmu": str(path), "check": check, "options": job["options"], "errand": data}
        ended = carry_out(sent, folder, options.time_limit)
        if not ended.complete:
            raise Refused(f"in a second process: {ended.death}")
        for line in ended.lines:
            if "answer" in line:
                answer: dict[str, Any] = line["answer"]
                return answer
            if "found" in line:
                raise Refused(f"in a second process: {'; '.join(line['found']['problems'])}")
        raise Refused("in a second process: no answer")

    return Subject(path, directory, scratch, read_model_description(str(directory), validate=False), options,
                   Trail(folder / "trail"), errand)


def _enter(found: Findings, error: Exception) -> None:
    """Enter what stopped a part."""
    if isinstance(error, Skip):
        found.skipped = str(error)
    elif isinstance(error, (Refused, CardanError)):
        found.fail(str(error))
    else:
        place = traceback.extract_tb(error.__traceback__)[-1]
        found.fail(f"not carried out: {type(error).__name__}: {error} ({Path(place.filename).name}, "
                   f"line {place.lineno})")


def _write(answers: IO[str], line: dict[str, Any]) -> None:
    answers.write(json.dumps(line) + "\n")
    answers.flush()


if __name__ == "__main__":
    main()
