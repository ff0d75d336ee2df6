"""The FMU of the installed sources in the user's cache directory."""

from __future__ import annotations

import hashlib
import os
import shutil
import sys
from pathlib import Path

from . import BuildError
from .assembly import assemble
from .sources import collect

VARIABLE = "CARDAN_CACHE_DIR"
KEPT = 16  # older builds go; a process that just asked for one of them has had time to unpack it


def cache_directory() -> Path:
    """``CARDAN_CACHE_DIR``, or the platform's place for caches."""
    named = os.environ.get(VARIABLE)
    if named:
        return Path(named)
    if sys.platform == "win32":
        base = Path(os.environ.get("LOCALAPPDATA") or Path.home() / "AppData" / "Local")
    elif sys.platform == "darwin":
        base = Path.home() / "Library" / "Caches"
    else:
        base = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache")
    return base / "cardan-driveline"


def cached_fmu() -> Path:
    """Path of the FMU of the present sources; see `cardan_build.default_fmu`."""
    home = cache_directory()
    path = home / _key() / "CardanDriveline.fmu"
    if path.is_file():
        return path
    try:
        assemble(path)
    except BuildError as error:
        if path.is_file():  # another process was faster and has it open, which Windows does not let us replace
            return path
        if isinstance(error.__cause__, OSError):
            raise BuildError(f"{error}; {VARIABLE} can name another directory for built FMUs") from error
        raise
    _prune(home)
    return path


def _key() -> str:
    """Hash of what the FMU is made of and of the modules that make it."""
    total = hashlib.sha256(collect().digest.encode())
    for path in sorted(Path(__file__).parent.iterdir()):
        if path.is_file():
            total.update(path.name.encode() + path.read_bytes())
    return total.hexdigest()[:20]


def _prune(home: Path) -> None:
    builds = sorted((path.stat().st_mtime, path) for path in home.iterdir() if path.is_dir())
    for _, path in builds[:-KEPT]:
        shutil.rmtree(path, ignore_errors=True)
