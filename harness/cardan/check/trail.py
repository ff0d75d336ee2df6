"""The last call before a process died: a few bytes in a file, kept by the system when the process is gone."""

from __future__ import annotations

import mmap
from pathlib import Path

SIZE = 512  # bytes


class Trail:
    """Notes what is being done.

    Parameters
    ----------
    path : pathlib.Path
        File to note it in.
    """

    def __init__(self, path: Path) -> None:
        path.write_bytes(bytes(SIZE))
        with path.open("r+b") as file:
            self._memory = mmap.mmap(file.fileno(), SIZE)

    def mark(self, text: str) -> None:
        """Note what comes next, in the place of what was noted before."""
        note = text.encode("ascii", "replace")[: SIZE - 1]
        self._memory[: len(note) + 1] = note + b"\0"


def last_mark(path: Path) -> str:
    """Return what was noted last; empty where nothing was."""
    try:
        return path.read_bytes().partition(b"\0")[0].decode("ascii", "replace")
    except OSError:
        return ""
