"""Errors that a user can act on. Everything else that is raised is a defect of this program."""

from __future__ import annotations

from collections.abc import Iterable

FATAL = 4  # the FMI status after which an instance must not be touched


class CardanError(Exception):
    """Base of all expected errors; its text is meant for the user, not for a traceback."""


class InputError(CardanError):
    """Input that cannot be used, with every problem found, not only the first.

    Parameters
    ----------
    problems : str or iterable of str
        One line each: the thing, its value, what is allowed, what to do.
    """

    def __init__(self, problems: str | Iterable[str]) -> None:
        self.problems: list[str] = [problems] if isinstance(problems, str) else list(problems)
        super().__init__("\n".join(self.problems))


class FmuError(CardanError):
    """A file that is no usable FMI 2.0 co-simulation FMU, or a use that it does not support."""


class FmiError(CardanError):
    """An FMI call that failed.

    Parameters
    ----------
    function : str
        Name of the FMI function.
    status : int
        The FMI status returned: 2 discard, 3 error, 4 fatal.
    text : str
        What the FMU itself said about it; empty when it said nothing.
    detail : str, optional
        What was asked for, for example the variables and their values.
    """

    def __init__(self, function: str, status: int, text: str, detail: str = "") -> None:
        self.function = function
        self.status = status
        self.text = text
        label = {2: "discard", 3: "error", 4: "fatal"}.get(status, f"status {status}")
        said = text or "the FMU gave no reason"
        super().__init__(f"{function} returned {label}{f' ({detail})' if detail else ''}: {said}")


class StepRefused(FmiError):
    """A communication step that the FMU did not do; its state is the one before the step.

    Parameters
    ----------
    time, size : float
        Start and length of the step, s.
    status : int
        The FMI status returned.
    text : str
        What the FMU itself said about it.
    """

    def __init__(self, time: float, size: float, status: int, text: str) -> None:
        self.time = time
        self.size = size
        super().__init__("fmi2DoStep", status, text, f"step of {size:.6g} s at t = {time:.6g} s")
