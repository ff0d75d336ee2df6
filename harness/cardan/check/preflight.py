"""What has to be true before anything can be checked; everything else is for the checks to find."""

from __future__ import annotations

import os
import zipfile
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from cardan.archive import LARGEST, open_archive, remove, unpack
from cardan.errors import FmuError

LARGEST_DESCRIPTION = 64 << 20  # bytes of modelDescription.xml; ten thousand variables need about 5 MB


@dataclass(frozen=True)
class Admitted:
    """An FMU that can be checked: file, model name and model identifier."""

    path: Path
    model_name: str
    identifier: str


def admit(path: str | os.PathLike[str]) -> Admitted:
    """Let in what is an FMI 2.0 co-simulation FMU for this platform; its faults are for the checks.

    Parameters
    ----------
    path : path-like
        The FMU file.

    Returns
    -------
    Admitted

    Raises
    ------
    FmuError
        If the file is missing or no zip archive, is damaged or hostile (paths that leave the directory, links,
        more than 1 GiB), has no readable modelDescription.xml, is of another FMI version, has no co-simulation,
        or no binary for this platform. Nothing is left unpacked.
    """
    import fmpy

    with open_archive(path) as archive:
        root = _description(path, archive)
        names = set(archive.namelist())
        declared = sum(member.file_size for member in archive.infolist())
    if declared > LARGEST:
        raise FmuError(f"{path} is refused: it would unpack to {declared >> 20} MiB, the limit is {LARGEST >> 20} MiB")
    remove(unpack(path, fmpy.platform))
    version = root.get("fmiVersion")
    if version != "2.0":
        raise FmuError(f"{path} is an FMU of FMI {version}; only FMI 2.0 is supported" if version else
                       f"{path} is not an FMU: its modelDescription.xml gives no fmiVersion")
    capability = root.find("CoSimulation")
    if capability is None:
        raise FmuError(f"{path} is an FMU for model exchange only; co-simulation is needed")
    identifier = capability.get("modelIdentifier") or ""
    library = f"binaries/{fmpy.platform}/{identifier}{fmpy.sharedLibraryExtension}"
    if library not in names:
        platforms = sorted({name.split("/")[1] for name in names if name.startswith("binaries/") and name[-1] != "/"})
        raise FmuError(f"{path} has no binary for this platform: there is no {library}; binaries are inside for: "
                       f"{', '.join(platforms) or 'no platform'}")
    return Admitted(Path(path), root.get("modelName") or identifier, identifier)


def _description(path: object, archive: zipfile.ZipFile) -> Any:
    """Return the root of the model description, read without following references out of it."""
    from lxml import etree

    size = archive.getinfo("modelDescription.xml").file_size
    if size > LARGEST_DESCRIPTION:
        raise FmuError(f"{path} is refused: its modelDescription.xml has {size >> 20} MiB, the limit is "
                       f"{LARGEST_DESCRIPTION >> 20} MiB")
    try:
        text = archive.read("modelDescription.xml")
    except (OSError, RuntimeError, NotImplementedError, zipfile.BadZipFile) as error:
        raise FmuError(f"{path} cannot be unpacked: {error}") from None
    parser = etree.XMLParser(resolve_entities=False, no_network=True, load_dtd=False)
    try:
        root = etree.fromstring(text, parser)
    except etree.XMLSyntaxError as error:
        raise FmuError(f"{path}: its modelDescription.xml is no XML: {error}") from None
    if root.tag != "fmiModelDescription":
        raise FmuError(f"{path} is not an FMU: its modelDescription.xml starts with <{root.tag}>")
    return root
