"""Writes the archive: sorted, compressed, with fixed dates and permissions, complete or not at all."""

from __future__ import annotations

import os
import zipfile
from collections.abc import Mapping
from pathlib import Path

DATE = (1980, 1, 1, 0, 0, 0)  # the earliest that a zip archive can say
LEVEL = 9
_PLAIN, _EXECUTABLE = 0o100644, 0o100755


def contents(path: Path) -> dict[str, bytes]:
    """Members of an archive by name."""
    with zipfile.ZipFile(path) as archive:
        return {name.replace("\\", "/"): archive.read(name) for name in archive.namelist() if not name.endswith("/")}


def write(path: Path, members: Mapping[str, bytes]) -> None:
    """Write an archive; the same members give the same bytes.

    Parameters
    ----------
    path : Path
        File to write.
    members : mapping
        Content by name; the model description comes first, as readers of streams like it.
    """
    with zipfile.ZipFile(path, "w") as archive:
        for name in sorted(members, key=lambda each: (each != "modelDescription.xml", each)):
            entry = zipfile.ZipInfo(name, DATE)
            entry.create_system = 3  # Unix, so that the permissions are read wherever it was built
            binary = name.endswith((".so", ".dll", ".pyd"))
            entry.external_attr = (_EXECUTABLE if binary else _PLAIN) << 16
            entry.compress_type = zipfile.ZIP_DEFLATED
            archive.writestr(entry, members[name], compresslevel=LEVEL)


def put(source: Path, target: Path) -> None:
    """Rename `source`, which is complete and in the same directory, to `target`."""
    with source.open("rb+") as stream:
        os.fsync(stream.fileno())
    os.replace(source, target)
