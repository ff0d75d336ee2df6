"""Unpacking of FMU archives: only what a run needs, only where it is safe."""

from __future__ import annotations

import os
import re
import shutil
import stat
import sys
import tempfile
import zipfile
from collections.abc import Iterator
from importlib.machinery import PathFinder
from pathlib import Path, PurePosixPath

from cardan.errors import FmuError

LARGEST = 1 << 30  # bytes unpacked; a driveline needs less than 10 MB
LARGEST_DESCRIPTION = 64 << 20  # bytes of modelDescription.xml; ten thousand variables need about 5 MB
SAFE_PATH = re.compile(r"[A-Za-z0-9_.,:~ /\\-]+")


def safe_directory() -> Path:
    """Make an empty private directory on whose path every FMU loads.

    FMUs are given their resources as a URI, and the common Python export decodes only ``%20`` in it: below a
    path with ``+ # % ;`` or non-ASCII letters it crashes the process.

    Returns
    -------
    pathlib.Path
        The directory; the caller removes it.

    Raises
    ------
    FmuError
        If no such directory can be made.
    """
    tried = []
    for base in _bases():
        tried.append(str(base))
        if SAFE_PATH.fullmatch(str(base)) and os.access(base, os.W_OK):
            return Path(tempfile.mkdtemp(prefix="cardan_", dir=base))
    raise FmuError(
        "no directory to unpack the FMU in: none of " + ", ".join(tried) + " is writable and free of other than ASCII"
        " letters, digits, space and _ . , : ~ -; point the environment variable TMPDIR to one that is"
    )


def _bases() -> Iterator[Path]:
    yield Path(tempfile.gettempdir()).resolve()
    if sys.platform == "win32":
        yield from (Path(os.environ[key]) for key in ("PUBLIC", "ProgramData") if key in os.environ)
    else:
        yield from (Path("/tmp"), Path("/var/tmp"))
    yield Path.cwd()


def open_archive(path: str | os.PathLike[str]) -> zipfile.ZipFile:
    """Open an FMU's archive and check that it is one.

    Parameters
    ----------
    path : path-like
        The FMU file.

    Returns
    -------
    zipfile.ZipFile
        Open for reading.

    Raises
    ------
    FmuError
        If the file is missing, unreadable, not a zip archive or has no modelDescription.xml.
    """
    try:
        archive = zipfile.ZipFile(path)
    except zipfile.BadZipFile:
        raise FmuError(f"{path} is not an FMU: it is no zip archive") from None
    except FileNotFoundError:
        raise FmuError(f"{path} does not exist; `cardan build -o {path}` makes the driveline FMU") from None
    except OSError as error:
        raise FmuError(f"{path} cannot be read: {error.strerror}") from None
    if "modelDescription.xml" not in archive.namelist():
        archive.close()
        raise FmuError(f"{path} is not an FMU: the archive has no modelDescription.xml")
    size = archive.getinfo("modelDescription.xml").file_size
    if size > LARGEST_DESCRIPTION:
        archive.close()
        raise FmuError(f"{path} is refused: its modelDescription.xml has {size >> 20} MiB, the limit is "
                       f"{LARGEST_DESCRIPTION >> 20} MiB")
    return archive


def unpack(path: str | os.PathLike[str], platform: str) -> Path:
    """Unpack an FMU's description, resources and the binaries of one platform.

    Parameters
    ----------
    path : path-like
        The FMU file.
    platform : str
        FMI 2.0 platform folder, for example ``"linux64"``.

    Returns
    -------
    pathlib.Path
        A new directory on a safe path; the caller removes it with `remove`.

    Raises
    ------
    FmuError
        If the archive is damaged, hostile (paths that leave the directory, links, more than 1 GiB), or
        cannot be unpacked. Nothing is left behind then.
    """
    with open_archive(path) as archive:
        members = [member for member in archive.infolist() if _wanted(member, platform)]
        _refuse_hostile(path, archive.infolist(), members)
        target = safe_directory()
        try:
            archive.extractall(target, members)
        except (OSError, RuntimeError, NotImplementedError, zipfile.BadZipFile) as error:
            remove(target)
            raise FmuError(f"{path} cannot be unpacked: {error}") from None
        return target


def remove(directory: Path) -> None:
    """Remove an unpacked FMU and what a Python FMU leaves of it in the import system of the host.

    Parameters
    ----------
    directory : pathlib.Path
        What `unpack` returned.
    """
    inside = f"{directory}{os.sep}"
    # Its resources stay in sys.path, where the host's own imports would find them.
    sys.path[:] = [entry for entry in sys.path if not f"{entry}{os.sep}".startswith(inside)]
    # Its modules stay in sys.modules: one that hides a module of the host (pythonfmu, say) has to go.
    ours = [name for name, module in sys.modules.items() if str(getattr(module, "__file__", "")).startswith(inside)]
    for name in ours:
        if PathFinder.find_spec(name.partition(".")[0]) is not None:
            del sys.modules[name]
    # On Windows a loaded library cannot be deleted; a left-over is better than an error after a good run.
    shutil.rmtree(directory, ignore_errors=True)


def _wanted(member: zipfile.ZipInfo, platform: str) -> bool:
    name = member.filename
    return name == "modelDescription.xml" or name.startswith((f"binaries/{platform}/", "resources/"))


def _refuse_hostile(path: object, everything: list[zipfile.ZipInfo], wanted: list[zipfile.ZipInfo]) -> None:
    for member in everything:
        name = member.filename
        parts = PurePosixPath(name).parts
        if "\\" in name or ":" in name or name.startswith("/") or ".." in parts:
            raise FmuError(f"{path} is refused: its member {name!r} would be unpacked outside the target directory")
        if stat.S_ISLNK(member.external_attr >> 16):
            raise FmuError(f"{path} is refused: its member {name!r} is a link")
    size = sum(member.file_size for member in wanted)
    if size > LARGEST:
        raise FmuError(f"{path} is refused: it would unpack to {size >> 20} MiB, the limit is {LARGEST >> 20} MiB")
