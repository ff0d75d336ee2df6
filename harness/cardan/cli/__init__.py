"""The command line: one module per command, each importing what it needs when it runs."""

from __future__ import annotations

import contextlib
import os
import sys


def main() -> None:
    """Run the command ``cardan`` and leave the process with its exit code."""
    from cardan.cli.app import app

    code: int | str | None = 0
    try:
        app()
    except SystemExit as end:
        code = end.code
    if "fmpy" in sys.modules and isinstance(code, int):
        # Now and then a process that has run a Python FMU aborts while the interpreter shuts down. Everything is
        # written and closed by now, so leave at once: the exit code is part of the result.
        for stream in (sys.stdout, sys.stderr):
            with contextlib.suppress(OSError):  # the reader of a pipe is gone
                stream.flush()
        os._exit(code)
    sys.exit(code)
