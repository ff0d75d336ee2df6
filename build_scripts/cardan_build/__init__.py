"""Builds ``CardanDriveline.fmu`` from the kernel, the slave and pythonfmu.

`build` writes an FMU; `default_fmu` gives the path of one that fits the installed sources, building it
where the cache has none; ``python -m cardan_build -o FILE`` is `build` from a shell.
"""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

__all__ = ["BuildError", "build", "default_fmu"]


class BuildError(Exception):
    """An FMU cannot be built; the message says why and what to do."""


def build(output: Path, *, portable: bool = False, kernel_dirs: Iterable[Path] = ()) -> Path:
    """Build the FMU and put it at `output`, which is replaced only by a complete and verified file.

    Parameters
    ----------
    output : Path
        File to write; its directory is made where it is missing.
    portable : bool
        Leave the compiled kernel of this installation out.
    kernel_dirs : iterable of Path
        Directories with compiled kernels (``_compiled*.so``, ``_compiled*.pyd``) made elsewhere of the same source.

    Returns
    -------
    Path
        `output`.

    Raises
    ------
    BuildError
        A source is missing, a compiled kernel is of another source, `output` cannot be written, or the FMU
        fails its verification.
    """
    from .assembly import assemble

    return assemble(Path(output), portable=portable, kernel_dirs=tuple(Path(each) for each in kernel_dirs))


def default_fmu() -> Path:
    """Path of an FMU of the installed sources, from the user's cache or built now.

    Returns
    -------
    Path
        A complete FMU; processes that ask at once may each build it, and get the same bytes.

    Raises
    ------
    BuildError
        As `build`.
    """
    from .cache import cached_fmu

    return cached_fmu()
