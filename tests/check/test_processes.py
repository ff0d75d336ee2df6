"""A check that goes wrong takes nothing with it."""

from __future__ import annotations

import tempfile
from pathlib import Path

import pytest

from .conftest import Examine, Make
from .faults import STEP, after


def running(pid: int) -> bool:
    """Return whether a process is there and not just waiting to be forgotten."""
    try:
        return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except OSError:
        return False


@pytest.mark.skipif(not Path("/proc/self/stat").exists(), reason="needs /proc to see processes")
def test_what_an_endless_step_started_is_ended_with_it(lag: Make, examine: Examine, tmp_path: Path,
                                                      monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("LAG_NOTE", str(tmp_path / "pid"))
    fmu = lag(after(STEP, "import os, subprocess, time",
                    "open(os.environ['LAG_NOTE'], 'w').write(str(subprocess.Popen(['sleep', '77']).pid))",
                    "time.sleep(77)"))
    report = examine(fmu, "run", time_limit=5.0)
    assert "no end in fmi2DoStep" in report["run"].problems[0]
    assert not running(int((tmp_path / "pid").read_text()))


def test_what_a_dying_process_printed_is_told(lag: Make, examine: Examine) -> None:
    fmu = lag(after(STEP, "import os", "print('thirteen', flush=True)", "os._exit(13)"))
    problem = examine(fmu, "run")["run"].problems[0]
    assert problem.startswith("the process died in fmi2DoStep(t = 0.0, h = 0.01) (exit code 13); it printed: ")
    assert "thirteen" in problem


def test_nothing_is_left_in_the_temporary_directory(good: Path, lag: Make, examine: Examine, tmp_path: Path,
                                                   monkeypatch: pytest.MonkeyPatch) -> None:
    folder = tmp_path / "temporary"
    folder.mkdir()
    monkeypatch.setattr(tempfile, "tempdir", str(folder))
    examine(good, "run", "serialization")
    examine(lag(after(STEP, "import os", "os._exit(13)")), "run")
    assert list(folder.iterdir()) == []
