"""Files that a run leaves behind."""

from __future__ import annotations

import os
import tempfile
from pathlib import Path
from typing import Any

from cardan.check.base import Check, Findings, listed
from cardan.check.excitation import Excitation
from cardan.check.rig import Rig
from cardan.check.subject import Subject
from cardan.check.trajectory import run

PLACES = {"cwd": "the working directory", "tmp": "the temporary directory", "home": "the home directory"}
CACHES = "__pycache__"  # the Python of the importing process may keep compiled modules beside an FMU's sources


class Leftovers(Check):
    """No section of FMI: a guest leaves the house as it was."""

    id = "leftovers"
    title = "Files: none left behind"
    proves = "after a run and the end of the process nothing stays in the working, temporary and home directory"
    needs = ("instantiation", "run")

    def run(self, subject: Subject, part: str, found: Findings) -> None:
        """Let a second process run the FMU in empty directories, and look what is there when it has ended."""
        folders = {name: subject.scratch / name for name in PLACES}
        for folder in folders.values():
            folder.mkdir()
        answer = subject.errand(self.id, {name: str(folder) for name, folder in folders.items()})
        for name, folder in folders.items():
            left = sorted(str(each.relative_to(folder)) for each in folder.rglob("*") if each.is_file())
            if left:
                found.fail(f"left in {PLACES[name]}: {listed(left)}")
        if answer["changed"]:
            found.warn(f"the FMU writes into its own directory, which may be read-only: {listed(answer['changed'])}")
        if answer["open"] > 0:
            found.warn(f"{answer['open']} files or sockets stay open after fmi2FreeInstance")

    def errand(self, subject: Subject, data: dict[str, Any]) -> dict[str, Any]:
        """Run twice from the given directories; what changed in the FMU's own directory, and what stays open."""
        os.chdir(data["cwd"])
        for name in ("TMPDIR", "TEMP", "TMP"):
            os.environ[name] = data["tmp"]
        os.environ["HOME"] = os.environ["USERPROFILE"] = data["home"]
        tempfile.tempdir = None
        before = _content(subject.directory)
        handles = []
        for _ in range(2):
            rig = Rig(subject)
            run(rig, subject.experiment.times(subject.options.steps), Excitation(subject).at, subject.outputs)
            rig.good("fmi2Terminate")
            rig.free()
            handles.append(_handles())
        after = _content(subject.directory)
        return {"changed": [name for name in after if after[name] != before.get(name)], "open": handles[1] - handles[0]}


def _content(directory: Path) -> dict[str, tuple[int, int]]:
    """Return size and time of change of every file, caches left out."""
    files = [each for each in directory.rglob("*") if each.is_file() and CACHES not in each.parts]
    return {str(each.relative_to(directory)): (each.stat().st_size, each.stat().st_mtime_ns) for each in files}


def _handles() -> int:
    """Return how many files this process has open; 0 where the system does not tell."""
    try:
        return len(os.listdir("/proc/self/fd"))
    except OSError:
        return 0
