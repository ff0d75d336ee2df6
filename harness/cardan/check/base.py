"""What a check is, and what it finds."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Iterable, Sequence
from dataclasses import asdict, dataclass, field
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from cardan.check.subject import Subject

SHOWN = 8  # names listed in one text


class Skip(Exception):
    """Raised by a check that does not apply; its text says why."""


class Refused(Exception):
    """A call that had to work did not; its text names the call, the status and what the FMU said."""


@dataclass
class Findings:
    """What one part of a check found.

    Attributes
    ----------
    problems : list of str
        What is against the standard or wrong; any of them fails the check.
    warnings : list of str
        What the standard allows and a user trips over; fails the check only where asked for.
    remarks : list of str
        What is worth knowing.
    figures : dict of str to list
        Measured values by name: ``[value, unit]``.
    skipped : str
        Why the check does not apply; empty where it does.
    data : dict
        What later checks are given.
    """

    problems: list[str] = field(default_factory=list)
    warnings: list[str] = field(default_factory=list)
    remarks: list[str] = field(default_factory=list)
    figures: dict[str, list[Any]] = field(default_factory=dict)
    skipped: str = ""
    data: dict[str, Any] = field(default_factory=dict)

    def fail(self, text: str) -> None:
        """Enter a problem."""
        self.problems.append(text)

    def warn(self, text: str) -> None:
        """Enter a warning."""
        self.warnings.append(text)

    def remark(self, text: str) -> None:
        """Enter a remark."""
        self.remarks.append(text)

    def figure(self, name: str, value: float, unit: str = "") -> None:
        """Enter a measured value; one that is no number is left out."""
        if math.isfinite(value):
            self.figures[name] = [value, unit]

    def to_dict(self) -> dict[str, Any]:
        """Return everything as JSON takes it."""
        return asdict(self)

    def add(self, other: dict[str, Any]) -> None:
        """Add what a part found, given as a dictionary; whether it was skipped is left to the caller."""
        self.problems += other["problems"]
        self.warnings += other["warnings"]
        self.remarks += other["remarks"]
        self.figures |= other["figures"]
        self.data |= other["data"]


class Check(ABC):
    """One check of an FMU. It runs in a process of its own, which it may lose.

    Attributes
    ----------
    id : str
        Short name for the command line and for reports.
    title : str
        What is looked at, for people.
    proves : str
        What is known about an FMU that passes.
    needs : tuple of str
        Checks without whose success this one has nothing to work on.
    patience : float
        Time limit in multiples of the usual one.
    """

    id: str
    title: str
    proves: str
    needs: tuple[str, ...] = ()
    patience: float = 1.0

    def parts(self, subject: Subject) -> Sequence[str]:
        """Return the names of the parts; after a crash in one the rest is still carried out."""
        return ("",)

    @abstractmethod
    def run(self, subject: Subject, part: str, found: Findings) -> None:
        """Carry out a part.

        Parameters
        ----------
        subject : Subject
            The FMU.
        part : str
            One of `parts`.
        found : Findings
            Where to enter what is found.

        Raises
        ------
        Skip
            If the check does not apply to this FMU.
        Refused
            If a call failed that had to work.
        """

    def errand(self, subject: Subject, data: dict[str, Any]) -> dict[str, Any]:
        """Do what this check wants done in a second process; see `Subject.errand`."""
        raise NotImplementedError


def listed(names: Iterable[str], most: int = SHOWN) -> str:
    """Return names in a row, the first ones where there are many."""
    every = list(names)
    rest = f" and {len(every) - most} more" if len(every) > most else ""
    return ", ".join(every[:most]) + rest
