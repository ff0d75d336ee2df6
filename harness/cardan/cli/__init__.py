"""The command line: one module per command, each importing what it needs when it runs."""

from __future__ import annotations

import contextlib
import io
import os
import sys


def main() -> None:
    """Run the command ``cardan`` and leave the process with its exit code."""
    _prepare_streams()
    from cardan.cli.app import app

    code: int | str | None = 0
    try:
        app()
    except SystemExit as end:
        code = end.code
    except OSError as error:
        if not _stdout_fails():
            raise
        print(f"error: stdout cannot be written: {error.strerror or error}", file=sys.stderr)
        code = 1
    if "fmpy" in sys.modules and isinstance(code, int):
        # Now and then a process that has run a Python FMU aborts while the interpreter shuts down. Everything is
        # written and closed by now, so leave at once: the exit code is part of the result.
        for stream in (sys.stdout, sys.stderr):
            with contextlib.suppress(OSError):  # the reader of a pipe is gone
                stream.flush()
        os._exit(code)
    sys.exit(code)


class _Patient(io.FileIO):
    """A stderr that may be closed or full: no message is worth a run."""

    def write(self, data: object) -> int:
        """Write what can be written; claim that it was all."""
        with contextlib.suppress(OSError):
            return super().write(data)  # type: ignore[arg-type]
        return memoryview(data).nbytes  # type: ignore[arg-type]


def _prepare_streams() -> None:
    """Put something in the place of closed streams, and make messages on stderr dispensable."""
    for descriptor in (0, 1, 2):
        try:
            os.fstat(descriptor)
        except OSError:
            # The lowest number that is free is this one: else the next file to be opened, such as a result, would
            # be taken for the stream. It refuses what is written to it, as a closed one does.
            os.open(os.devnull, os.O_RDONLY)
    if sys.stdout is None:
        sys.stdout = open(1, "w", encoding="utf-8", closefd=False)  # noqa: SIM115
    if sys.stderr is None or not sys.stderr.isatty():
        encoding = "utf-8" if sys.stderr is None else sys.stderr.encoding
        sys.stderr = io.TextIOWrapper(io.BufferedWriter(_Patient(2, "w", closefd=False)), encoding,
                                      "backslashreplace", line_buffering=True)


def _stdout_fails() -> bool:
    """Return whether stdout takes no more; if so, drop the text that waits for it."""
    try:
        sys.stdout.flush()
        os.write(sys.stdout.fileno(), b"\n")  # an unbuffered stream keeps no text that would tell
    except OSError:
        # or the interpreter would try again at its end, and complain
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return True
    return False
