"""The FMI side of a part: a thin pythonfmu slave around `Part`.

The exporter calls Python methods by name on the slave; an exception that leaves one of them ends in fmi2Fatal, and
freeing the instance after that crashes the host. So every one is guarded (docs/FMI.md, trap 3).
"""

from __future__ import annotations

import json
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

from pythonfmu.fmi2slave import Fmi2Slave
from pythonfmu.logmsg import LogMsg

from .part import Part

CATEGORIES = ("logAll", "logStatusWarning", "logStatusDiscard", "logStatusError")
ERROR = 3

# What the exporter calls: slave's name, part's name, and the answer that keeps the host alive when the call fails.
CALLBACKS: tuple[tuple[str, str, Callable[..., Any]], ...] = (
    ("setup_experiment", "setup_experiment", lambda *_: None),
    ("enter_initialization_mode", "enter_initialization_mode", lambda *_: None),
    ("exit_initialization_mode", "exit_initialization_mode", lambda *_: None),
    ("do_step", "do_step", lambda *_: False),
    ("terminate", "terminate", lambda *_: None),
    ("get_real", "get_real", lambda references: [float("nan")] * len(references)),
    ("get_integer", "get_integer", lambda references: [0] * len(references)),
    ("get_boolean", "get_boolean", lambda references: [False] * len(references)),
    ("get_string", "get_string", lambda references: [""] * len(references)),
    ("set_real", "set_real", lambda *_: None),
    ("set_integer", "set_integer", lambda *_: None),
    ("set_boolean", "set_boolean", lambda *_: None),
    ("set_string", "set_string", lambda *_: None),
    ("_get_fmu_state", "get_state", lambda *_: b""),
    ("_set_fmu_state", "set_state", lambda *_: None),
)


def reporter(queue: list[Any]) -> Callable[[int, str], None]:
    """Give ``report(status, text)``, which queues messages for the importer.

    What is not ASCII is escaped and percent signs are spelled: importers hand the text to printf as a format.
    """

    def report(status: int, text: str) -> None:
        try:
            plain = str(text).encode("ascii", "backslashreplace").decode("ascii").replace("%", " percent")
            queue.append(LogMsg(status, CATEGORIES[status], plain))
        except BaseException:  # an importer without the message is better off than one that crashed
            pass

    return report


def guarded(method: Callable[..., Any] | None, name: str, otherwise: Callable[..., Any],
            report: Callable[[int, str], None]) -> Callable[..., Any]:
    """Give `method` so that a failure is reported and answered with ``otherwise(...)``; None always fails."""

    def call(*arguments: Any) -> Any:
        try:
            if method is None:
                raise TypeError("there is nothing to call")
            return method(*arguments)
        except BaseException as error:
            report(ERROR, f"{name} failed: {error!r}")
            return otherwise(*arguments)

    return call


class ScenePart(Fmi2Slave):  # type: ignore[misc]  # pythonfmu has no types
    """Engine, load, driver or moving joints of a scene."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        report = reporter(self.log_queue)
        part: Part | None = None
        try:
            folder = Path(kwargs["resources"])
            part = Part(json.loads((folder / "part.json").read_text(encoding="utf-8")), folder, report)
        except BaseException as error:  # an instance that cannot work still has to answer
            report(ERROR, f"the part could not be made: {error!r}")
        for own, name, otherwise in CALLBACKS:
            setattr(self, own, guarded(getattr(part, name, None), name, otherwise, report))
        # The exporter puts the unzipped FMU in front of the host's path, once per instance. All imports are done.
        if "visible" in kwargs:
            sys.path[:] = [entry for entry in sys.path if entry != kwargs["resources"]]

    def do_step(self, current_time: float, step_size: float) -> bool:
        """Never called: the part's method stands in front of it in every instance."""
        return False

    @staticmethod
    def _fmu_state_to_bytes(state: bytes) -> bytes:
        return state

    @staticmethod
    def _fmu_state_from_bytes(state: bytes) -> bytes:
        return state
