"""The FMU's ``documentation`` folder: page for people, licences, what the importing process must bring."""

from __future__ import annotations

import importlib.metadata
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from . import BuildError
from .documentation_page import page
from .notices import FMI_HEADERS

EXTERNAL = """CardanDriveline is a Python FMU (exporter: PythonFMU). It carries its Python code and needs from the
importing process, on Linux (x86-64, glibc 2.32 or later) or Windows (x86-64):

- Python 3.9 or later, nothing else: no numpy, no further package.
- The compiled kernel inside is used by Python 3.11 and later on its platform; elsewhere the same source runs
  interpreted, with the same results, more slowly. The first log message tells which one runs.
- An importer that is no Python program must bring libpython into its process before it loads the FMU: link it, or set
  LD_PRELOAD to libpython3.x.so on Linux, or have python3.dll on the path on Windows.
- The folder that the FMU is unpacked to may hold letters, digits, spaces, and . _ - in its path; the exporter cannot
  read others back from the resource URI.
"""


def write(folder: Path, variables: Sequence[Any], *, version: str, text: str, digest: str,
          binaries: Sequence[str]) -> None:
    """Write the documentation.

    Parameters
    ----------
    folder : Path
        The ``documentation`` directory; made here.
    variables : sequence of Variable
        ``cardan_kernel.variables.VARIABLES``.
    version, text : str
        Version and one-line description of the model.
    digest : str
        SHA-256 of the sources inside, hexadecimal.
    binaries : sequence of str
        File names of the compiled kernels inside.
    """
    licences = folder / "licenses"
    licences.mkdir(parents=True)
    pages = {
        folder / "index.html": page(variables, version=version, text=text, digest=digest, binaries=binaries),
        folder / "externalDependencies.txt": EXTERNAL,
        licences / "license.txt": own_licence(),
        licences / "pythonfmu.txt": licence_of("pythonfmu"),
        licences / "fmi.txt": FMI_HEADERS,
    }
    for path, content in pages.items():
        path.write_text(content, encoding="utf-8", newline="\n")


def own_licence() -> str:
    """Licence of this project: the repository's file, or the copy that was installed."""
    path = Path(__file__).resolve().parents[2] / "LICENSE"
    return path.read_text(encoding="utf-8") if path.is_file() else licence_of("cardan-driveline")


def licence_of(distribution: str) -> str:
    """Licence text of an installed distribution; BuildError where it brings none."""
    try:
        files = importlib.metadata.files(distribution) or []
    except importlib.metadata.PackageNotFoundError:
        raise BuildError(f"the distribution {distribution} is not installed; its licence belongs in the FMU") from None
    for each in files:
        if each.name == "LICENSE" and ".dist-info" in str(each):
            return each.read_text(encoding="utf-8")
    raise BuildError(f"the distribution {distribution} has no LICENSE file; it belongs in the FMU")
