"""What came out of all checks."""

from __future__ import annotations

from dataclasses import asdict, dataclass, field
from typing import Any

PASSED, FAILED, SKIPPED = "passed", "failed", "skipped"


@dataclass
class Outcome:
    """What came out of one check.

    Attributes
    ----------
    id, title, proves : str
        The check.
    status : str
        ``"passed"``, ``"failed"`` or ``"skipped"``.
    seconds : float
        Time that it took, s.
    reason : str
        Why it was skipped; else empty.
    problems, warnings, remarks : list of str
        What was found.
    figures : dict
        Measured values by name: ``[value, unit]``.
    """

    id: str
    title: str
    proves: str
    status: str
    seconds: float = 0.0
    reason: str = ""
    problems: list[str] = field(default_factory=list)
    warnings: list[str] = field(default_factory=list)
    remarks: list[str] = field(default_factory=list)
    figures: dict[str, list[Any]] = field(default_factory=dict)


@dataclass
class Report:
    """What came out of all checks of one FMU.

    Attributes
    ----------
    fmu, model_name, sha256 : str
        The file.
    versions : dict of str to str
        What it was checked with and on.
    started : str
        Date and time in UTC, ISO 8601.
    outcomes : list of Outcome
        In the order of the checks.
    """

    fmu: str
    model_name: str
    sha256: str
    versions: dict[str, str]
    started: str
    outcomes: list[Outcome] = field(default_factory=list)

    def __getitem__(self, check: str) -> Outcome:
        """Return the outcome of the check with that id."""
        return next(each for each in self.outcomes if each.id == check)

    def count(self, status: str) -> int:
        """Return how many checks came out like that."""
        return sum(each.status == status for each in self.outcomes)

    @property
    def passed(self) -> bool:
        """Whether no check failed."""
        return self.count(FAILED) == 0

    @property
    def seconds(self) -> float:
        """Time that all checks took, s."""
        return sum(each.seconds for each in self.outcomes)

    def to_dict(self) -> dict[str, Any]:
        """Return everything as JSON takes it."""
        return {"passed": self.passed, "counts": {status: self.count(status) for status in (PASSED, FAILED, SKIPPED)},
                "seconds": self.seconds, "fmu": self.fmu, "model_name": self.model_name, "sha256": self.sha256,
                "started": self.started, "versions": self.versions,
                "checks": [asdict(each) for each in self.outcomes]}

    def __str__(self) -> str:
        counts = ", ".join(f"{self.count(status)} {status}" for status in (PASSED, FAILED, SKIPPED))
        return f"{self.fmu}: {counts} in {self.seconds:.1f} s"
