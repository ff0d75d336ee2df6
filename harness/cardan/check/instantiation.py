"""Loading and instantiating: the library, its functions, and an instance in the usual and the unusual way."""

from __future__ import annotations

import shutil
import time
from collections.abc import Sequence
from dataclasses import replace

from cardan.check.base import Check, Findings, Refused
from cardan.check.library import library
from cardan.check.rig import Rig
from cardan.check.subject import Subject

PLAIN, SILENT, SPACE, OTHER = "", "without logging, visible", "from a path with a space", "with another GUID"


class Instantiation(Check):
    """FMI 2.0 section 2.1.5: creation, destruction and logging of FMU instances."""

    id = "instantiation"
    title = "Library: loads, has all functions, makes instances"
    proves = "the library has every function of FMI 2.0 co-simulation, says its version, and makes instances that live"

    def parts(self, subject: Subject) -> Sequence[str]:
        """Return the ways of instantiating."""
        return (PLAIN, SILENT, SPACE, OTHER)

    def run(self, subject: Subject, part: str, found: Findings) -> None:
        """Make an instance and bring it through its initialization."""
        if part == PLAIN:
            self._plain(subject, found)
        elif part == SILENT:
            _use(Rig(subject, logging=False, visible=True))
        elif part == SPACE:
            self._space(subject)
        else:
            self._other(subject, found)

    @staticmethod
    def _plain(subject: Subject, found: Findings) -> None:
        began = time.perf_counter()
        functions = library(subject)
        found.figure("loading", 1e3 * (time.perf_counter() - began), "ms")
        for function, expected in (("fmi2GetVersion", b"2.0"), ("fmi2GetTypesPlatform", b"default")):
            subject.trail.mark(function)
            said = getattr(functions, function)()
            if said != expected:
                found.fail(f"{function} returned {said!r} instead of {expected!r}")
        _use(Rig(subject))

    @staticmethod
    def _space(subject: Subject) -> None:
        """Use a copy whose path has a space, which is %20 in the resource location."""
        directory = subject.scratch / "with a space"
        shutil.copytree(subject.directory, directory)
        moved = replace(subject, directory=directory)
        _use(Rig(moved))

    @staticmethod
    def _other(subject: Subject, found: Findings) -> None:
        """Give a GUID that is not the FMU's: the description would not belong to the library."""
        try:
            rig = Rig(subject, guid="{00000000-0000-0000-0000-000000000000}")
        except Refused:
            return
        found.remark("an instance is made for another GUID too: a description of another version would not be noticed")
        _use(rig)


def _use(rig: Rig) -> None:
    rig.start()
    rig.good("fmi2Terminate")
    rig.free()
