"""What goes into an FMU: where it stands, and one hash over all of it."""

from __future__ import annotations

import hashlib
import importlib.util
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

from . import BuildError
from .amalgamate import amalgamate, digest_inside

# pythonfmu's modules that a running slave needs; the builder's own would cost start-up time.
PYTHONFMU_MODULES = ("_version", "default_experiment", "enums", "fmi2slave", "logmsg", "variables")
BINARY_SUFFIXES = (".so", ".pyd")


@dataclass(frozen=True)
class Sources:
    """Files of the FMU by the place they take under ``resources``, before the modules are renamed.

    Attributes
    ----------
    kernel, slave, pythonfmu : dict
        Path inside the package and content; `slave` has one entry.
    origin : dict
        Where the compiled kernels were found.
    """

    kernel: dict[str, bytes]
    slave: dict[str, bytes]
    pythonfmu: dict[str, bytes]
    origin: dict[str, Path]

    @cached_property
    def digest(self) -> str:
        """SHA-256 over names and contents, hexadecimal."""
        total = hashlib.sha256()
        for group in (self.kernel, self.slave, self.pythonfmu):
            for name, content in sorted(group.items()):
                total.update(f"{name}\0{len(content)}\0".encode())
                total.update(content)
        return total.hexdigest()

    @property
    def tag(self) -> str:
        """What the staged modules' names end with."""
        return self.digest[:12]

    @property
    def binaries(self) -> tuple[str, ...]:
        """Compiled kernels inside."""
        return tuple(sorted(name for name in self.kernel if name.endswith(BINARY_SUFFIXES)))


def collect(*, portable: bool = False, kernel_dirs: tuple[Path, ...] = ()) -> Sources:
    """Read everything that the FMU carries.

    Parameters
    ----------
    portable : bool
        Leave the compiled kernel of this installation out.
    kernel_dirs : tuple of Path
        Directories with further compiled kernels.

    Raises
    ------
    BuildError
        A package is missing, or two compiled kernels have the same name.
    """
    home = find_package("cardan_kernel")
    kernel = {path.name: path.read_bytes() for path in sorted(home.glob("*.py"))}
    binaries = {} if portable else compiled(home)
    origin = {name: home / name for name in binaries}
    for directory in kernel_dirs:
        added = compiled(directory)
        if not added:
            raise BuildError(f"{directory} holds no compiled kernel (_compiled*.so or _compiled*.pyd)")
        for name, content in added.items():
            if binaries.setdefault(name, content) != content:
                raise BuildError(f"{directory / name} and {origin[name]} have the same name; the FMU can carry one of "
                                 "them (--portable leaves this installation's out)")
            origin.setdefault(name, directory / name)
    slave = _find("cardan_slave")
    pythonfmu = find_package("pythonfmu")
    shim = "# pythonfmu without its builder, renamed for this FMU\n"
    return Sources(
        kernel | binaries,
        {"cardan_slave.py": slave.read_bytes()},
        {"__init__.py": shim.encode()}
        | {f"{name}.py": (pythonfmu / f"{name}.py").read_bytes() for name in PYTHONFMU_MODULES},
        origin,
    )


def check_compiled(sources: Sources) -> None:
    """Refuse binaries that were compiled from another source than the one that goes in beside them.

    Raises
    ------
    BuildError
        Names the binary and what to do.
    """
    if not sources.binaries:
        return
    expected = amalgamate(find_package("cardan_kernel")).digest
    for name in sources.binaries:
        if digest_inside(sources.kernel[name]) != expected:
            raise BuildError(f"the compiled kernel {sources.origin[name]} was made from another source than the "
                             "modules that would go beside it; compile it again (pip install -e .) or leave it out "
                             "(--portable)")


def compiled(directory: Path) -> dict[str, bytes]:
    """Compiled kernels in a directory by file name."""
    found = sorted(path for path in directory.glob("_compiled*") if path.suffix in BINARY_SUFFIXES)
    return {path.name: path.read_bytes() for path in found}


def find_package(name: str) -> Path:
    """Directory of a package; raises BuildError where it is not installed."""
    return _find(name).parent


def _find(name: str) -> Path:
    spec = importlib.util.find_spec(name)
    if spec is None or spec.origin is None:
        raise BuildError(f"the module {name} is not installed; install the project with: pip install -e .")
    return Path(spec.origin)
