"""All checks, in the order in which they are carried out."""

from __future__ import annotations

from collections.abc import Iterable
from difflib import get_close_matches

from cardan.check.archive_file import ArchiveFile
from cardan.check.base import Check
from cardan.check.dependencies import Dependencies
from cardan.check.illegal_calls import IllegalCalls
from cardan.check.instantiation import Instantiation
from cardan.check.leftovers import Leftovers
from cardan.check.legal_calls import LegalCalls
from cardan.check.memory import Memory
from cardan.check.ranges import Ranges
from cardan.check.reference import ReferenceResults
from cardan.check.resetting import Instances, Resetting
from cardan.check.running import Running
from cardan.check.schema import Schema, Validation
from cardan.check.state import Serialization, State
from cardan.check.step_sizes import StepSizes
from cardan.check.structure import Structure
from cardan.check.texts import Texts
from cardan.check.timing import Timing
from cardan.check.tolerance import Tolerance
from cardan.check.units import Units
from cardan.check.values import Values
from cardan.check.variables import Variables
from cardan.errors import InputError

CHECKS: tuple[Check, ...] = (
    ArchiveFile(), Schema(), Validation(), Variables(), Units(), Ranges(), Structure(), Instantiation(), Values(),
    Running(), Dependencies(), LegalCalls(), IllegalCalls(), Texts(), State(),
    Serialization(), Resetting(), Instances(), StepSizes(),
    Tolerance(), ReferenceResults(), Leftovers(), Memory(), Timing(),
)


def find(identity: str) -> Check:
    """Return the check with that id.

    Raises
    ------
    InputError
        If there is none; the message gives the nearest ids.
    """
    for check in CHECKS:
        if check.id == identity:
            return check
    known = [check.id for check in CHECKS]
    near = get_close_matches(identity, known, 3)
    raise InputError(f"there is no check {identity!r}"
                     + (f"; did you mean {', '.join(near)}?" if near else f"; there are {', '.join(known)}"))


def chosen(only: Iterable[str] = (), leave_out: Iterable[str] = ()) -> list[Check]:
    """Return the checks to carry out.

    Parameters
    ----------
    only, leave_out : iterable of str
        Ids; without `only` all of them.

    Raises
    ------
    InputError
        If an id is unknown.
    """
    wanted, unwanted = [find(each) for each in only], [find(each) for each in leave_out]
    return [check for check in CHECKS if (not wanted or check in wanted) and check not in unwanted]
