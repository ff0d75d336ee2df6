"""Work in a process of its own: it may crash, never end, or litter, and nothing is lost but the process."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from cardan.check.trail import last_mark

KEPT_OUTPUT = 2000  # characters of what a dead process printed


@dataclass(frozen=True)
class Ended:
    """How a process ended.

    Attributes
    ----------
    lines : list of dict
        What it answered.
    complete : bool
        Whether it came to its end by itself.
    death : str
        Otherwise how it died, in words, with the last call.
    """

    lines: list[dict[str, Any]]
    complete: bool
    death: str


def carry_out(job: dict[str, Any], root: Path, limit: float) -> Ended:
    """Let `cardan.check.worker` do a job.

    Parameters
    ----------
    job : dict
        See `cardan.check.worker`.
    root : pathlib.Path
        Directory for the process's files; they are left to the caller.
    limit : float
        Time limit, s, after which the process and its children are killed.

    Returns
    -------
    Ended
    """
    folder = Path(tempfile.mkdtemp(prefix="job_", dir=root))
    for name in ("cwd", "tmp"):
        (folder / name).mkdir()
    with (folder / "output.txt").open("wb") as output:
        process = subprocess.Popen([sys.executable, "-m", "cardan.check.worker"], stdin=subprocess.PIPE, stdout=output,
                                   stderr=subprocess.STDOUT, cwd=folder / "cwd", env=_environment(folder),
                                   start_new_session=True)
        late = False
        try:
            process.communicate(json.dumps({**job, "folder": str(folder)}).encode(), timeout=limit)
        except subprocess.TimeoutExpired:
            late = True
        finally:
            _kill(process)
    lines = _answers(folder / "answers.jsonl")
    complete = bool(lines) and lines[-1].get("end") is True
    return Ended([line for line in lines if "end" not in line], complete,
                 "" if complete else _death(folder, process.returncode, limit if late else None))


def _environment(folder: Path) -> dict[str, str]:
    """Return the environment with its own temporary directory, and this package on the path."""
    home = str(Path(__file__).resolve().parents[2])
    path = [home, *filter(None, os.environ.get("PYTHONPATH", "").split(os.pathsep))]
    temporary = {name: str(folder / "tmp") for name in ("TMPDIR", "TEMP", "TMP")}
    # numpy comes along with FMPy and starts threads that nobody needs: a third of the time to get going.
    return {"OPENBLAS_NUM_THREADS": "1", **os.environ, **temporary, "PYTHONPATH": os.pathsep.join(path)}


def _kill(process: subprocess.Popen[bytes]) -> None:
    """End the process with all that it started, and wait for it."""
    try:
        if sys.platform == "win32":
            process.kill()
        else:
            os.killpg(process.pid, signal.SIGKILL)  # it leads a group of its own
    except (ProcessLookupError, PermissionError):
        pass
    process.wait()


def _answers(path: Path) -> list[dict[str, Any]]:
    """Return the complete lines of the answer; a process that died may have left half a line."""
    if not path.is_file():
        return []
    text = path.read_text(encoding="utf-8", errors="replace")
    return [json.loads(line) for line in text[: text.rfind("\n") + 1].splitlines()]


def _death(folder: Path, code: int, limit: float | None) -> str:
    mark = last_mark(folder / "trail")
    where = f" in {mark}" if mark else ""
    if limit is not None:
        return f"no end{where}: stopped after {limit:g} s"
    output = (folder / "output.txt").read_text(encoding="utf-8", errors="replace").strip()
    said = f"; it printed: {' | '.join(output[-KEPT_OUTPUT:].splitlines()[-3:])}" if output else ""
    return f"the process died{where} ({_code(code)}){said}"


def _code(code: int) -> str:
    if code < 0:
        try:
            return f"signal {signal.Signals(-code).name}"
        except ValueError:
            return f"signal {-code}"
    return f"exit code {code:#x}" if code > 255 else f"exit code {code}"
