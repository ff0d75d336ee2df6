"""Problems of a scene, collected and reported all at once."""

from __future__ import annotations

import difflib
from collections.abc import Iterable
from dataclasses import dataclass

from cardan.errors import CardanError


@dataclass(frozen=True)
class Problem:
    """One thing that is wrong in a scene.

    Attributes
    ----------
    file : str
        The scene file, or what stands for it.
    key : str
        Dotted key, such as ``driveline.joint1.angle``; empty for the file as a whole.
    value : str
        The value found, as text; empty where there is none.
    why : str
        What is wrong.
    allowed : str
        Allowed range or choices.
    nearest : str
        Nearest valid name for a name that does not exist.
    """

    file: str
    key: str
    value: str
    why: str
    allowed: str = ""
    nearest: str = ""

    def __str__(self) -> str:
        where = f"{self.file}: {self.key}" if self.key else self.file
        text = f"{where} = {self.value}: {self.why}" if self.value else f"{where}: {self.why}"
        if self.allowed:
            text += f"; allowed: {self.allowed}"
        return text + (f"; did you mean {self.nearest!r}?" if self.nearest else "")


class ScenarioError(CardanError, ValueError):
    """A scene that cannot be simulated.

    Attributes
    ----------
    problems : tuple of Problem
        Everything that was found, in the order of the tables.
    """

    def __init__(self, problems: Iterable[Problem]) -> None:
        self.problems = tuple(problems)
        super().__init__("\n".join(str(problem) for problem in self.problems))


class Collector:
    """Gathers problems of one file while it is read."""

    def __init__(self, file: str) -> None:
        self.file = file
        self.problems: list[Problem] = []

    def add(self, key: str, value: object, why: str, allowed: str = "", nearest: str = "") -> None:
        """Note a problem; `value` None means that there is none to show."""
        self.problems.append(Problem(self.file, key, "" if value is None else _short(value), why, allowed, nearest))

    def unknown(self, key: str, value: object, what: str, name: str, names: Iterable[str]) -> None:
        """Note a name that does not exist, with the nearest one that does."""
        self.add(key, value, f"unknown {what} {name!r}", nearest=nearest(name, names))

    def finish(self) -> None:
        """Raise `ScenarioError` if there was any problem."""
        if self.problems:
            raise ScenarioError(self.problems)


def nearest(name: str, names: Iterable[str]) -> str:
    """Return the name most like `name`; empty if there are none."""
    return max(names, key=lambda n: difflib.SequenceMatcher(None, name.lower(), n.lower()).ratio(), default="")


def _short(value: object) -> str:
    try:
        text = repr(value)
    except ValueError:  # Python writes no whole number of thousands of digits
        return "a number of thousands of digits"
    return text if len(text) <= 80 else text[:77] + "..."
