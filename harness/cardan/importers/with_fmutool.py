"""The checker of the FMU manipulation toolbox: it reads the description by its own rules and runs nothing."""

from __future__ import annotations

import subprocess
import sys
from typing import Any

TOOL = "fmutool -check"
DISTRIBUTION = "fmu-manipulation-toolbox"


def run(job: dict[str, Any]) -> None:
    """Check the description; raise RuntimeError with what is wrong."""
    said = command("fmutool", ["-input", job["fmu"], "-check"], job["work"])
    wrong = [line for line in said.splitlines() if line.startswith(("ERROR", "CRITICAL"))]
    if wrong:
        raise RuntimeError("; ".join(wrong))


def command(name: str, arguments: list[str], work: str) -> str:
    """Run a command of the toolbox in a directory; return what it prints, or raise RuntimeError with that."""
    code = f"from fmu_manipulation_toolbox.cli.{name} import {name}; {name}()"
    done = subprocess.run([sys.executable, "-B", "-c", code, *arguments], cwd=work, capture_output=True, text=True,
                          check=False)
    if done.returncode:
        raise RuntimeError(f"{name} ended with exit code {done.returncode}: {(done.stdout + done.stderr).strip()}")
    return done.stdout + done.stderr
