"""Memory over many instances."""

from __future__ import annotations

import os
import time
from pathlib import Path

from cardan.check.base import Check, Findings, Skip
from cardan.check.rig import Rig
from cardan.check.subject import Subject

# The common Python export itself leaves 7 to 22 kB per instance (docs/FMI.md, trap 10), and up to 28 kB where a state
# is saved as a dictionary, which no FMU made with it can avoid; C FMUs leave nothing. A result, a log or a model that
# stays alive shows on top of that.
BOUND = 40.0 * 1024.0  # bytes per instance
MARKS = 20  # times that memory is looked at
WARM_UP = 0.2  # of the instances fill caches and pools first
SHARE = 0.8  # of the time limit
LEAST = 20  # instances, below which nothing can be said


class Memory(Check):
    """No section of FMI: an optimization makes thousands of instances."""

    id = "memory"
    title = "Memory: flat over many instances"
    proves = "instances that are made, run, saved and freed in one process leave less than 40 KiB each"
    needs = ("instantiation", "run")
    patience = 3.0

    def run(self, subject: Subject, part: str, found: Findings) -> None:
        """Make, run and free instances; the slope of the resident memory after the warm-up."""
        if resident() is None:
            raise Skip("resident memory cannot be read on this system")
        if subject.capability.canBeInstantiatedOnlyOncePerProcess:
            raise Skip("the FMU says canBeInstantiatedOnlyOncePerProcess")
        until = time.perf_counter() + SHARE * self.patience * subject.options.time_limit
        wanted = subject.options.instances
        every = max(1, wanted // MARKS)
        marks: list[tuple[int, int]] = []
        made = 0
        while made < wanted and time.perf_counter() < until:
            self._live(subject)
            made += 1
            if made % every == 0:
                marks.append((made, resident() or 0))
        marks = [mark for mark in marks if mark[0] >= WARM_UP * made]
        if made < LEAST or len(marks) < 3:
            raise Skip(f"only {made} instances were made: too few to see a leak")
        if made < wanted:
            found.remark(f"the time limit allowed {made} of {wanted} instances")
        leak = slope(marks)
        found.figure("growth", leak / 1024.0, "KiB per instance")
        found.figure("instances", made)
        if leak > BOUND:
            found.fail(f"memory grows by {leak / 1024.0:.1f} KiB per instance over {made} instances; at most "
                       f"{BOUND / 1024.0:.0f} KiB are allowed")

    @staticmethod
    def _live(subject: Subject) -> None:
        experiment = subject.experiment
        rig = Rig(subject)
        rig.start()
        rig.go(experiment.start, experiment.step)
        if subject.capability.canGetAndSetFMUstate:
            rig.forget(rig.save())
        rig.good("fmi2Terminate")
        rig.free()


def slope(marks: list[tuple[int, int]]) -> float:
    """Return the slope of a line through points, by least squares."""
    count = len(marks)
    middle_x = sum(x for x, _ in marks) / count
    middle_y = sum(y for _, y in marks) / count
    return sum((x - middle_x) * (y - middle_y) for x, y in marks) / sum((x - middle_x) ** 2 for x, _ in marks)


def resident() -> int | None:
    """Return the resident memory of this process in bytes; None where the system does not tell."""
    try:
        return int(Path("/proc/self/statm").read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE")
    except (OSError, ValueError, AttributeError):
        return None
