"""What measurements return: flat tables, so that one writer makes CSV, JSON and Markdown of all of them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

Record = dict[str, Any]  # column -> number or text
Tables = dict[str, list[Record]]
Tell = Callable[[float], None]  # fraction of a section that is done, 0 to 1


@dataclass(frozen=True)
class Options:
    """How much is measured.

    Attributes
    ----------
    quick : bool
        A subset with fewer repeats, for a look.
    """

    quick: bool = False

    @property
    def repeats(self) -> int:
        """Rounds of interleaved timings."""
        return 3 if self.quick else 9


def told(record: Record) -> bool:
    """Return whether the reference of an error is good enough to tell it."""
    return bool(record["error"] > 3.0 * record["floor"])
