"""The Pythons of this machine: on the path, or installed by pyenv, whose names on the path need not start."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from functools import cache
from pathlib import Path

HERE = f"3.{sys.version_info.minor}"


@cache
def interpreter(version: str) -> str | None:
    """A Python of a version such as ``3.12`` that starts; None where there is none."""
    if version == HERE:
        return sys.executable
    root = Path(os.environ.get("PYENV_ROOT") or Path.home() / ".pyenv")
    candidates = [shutil.which(f"python{version}")]
    candidates += sorted(str(path) for path in root.glob(f"versions/{version}.*/bin/python"))
    for each in candidates:
        if each and _minor(each) == version:
            return each
    return None


def _minor(python: str) -> str:
    code = "import sys; print('%d.%d' % sys.version_info[:2])"
    done = subprocess.run([python, "-I", "-S", "-c", code], capture_output=True, text=True, check=False)
    return done.stdout.strip()
