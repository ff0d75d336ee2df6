"""Which software made a result."""

from __future__ import annotations

import platform
import re
from importlib.metadata import PackageNotFoundError, version
from typing import Any

from cardan.instance import Instance

_KERNEL = re.compile(r"cardan_kernel (\S+): (compiled|interpreted) kernel")


def kernel_of(instance: Instance) -> tuple[str, str]:
    """Return which kernel a running driveline FMU has chosen, by its own first message.

    Parameters
    ----------
    instance : Instance
        Any FMU.

    Returns
    -------
    tuple of str
        ``"compiled"`` or ``"interpreted"``, and the kernel's version; ``("foreign FMU", "")`` where it is no
        driveline of this project.
    """
    for message in instance.messages:
        found = _KERNEL.match(message.text)
        if found:
            return found[2], found[1]
    return "foreign FMU", ""


def package_version(name: str) -> str:
    """Return the version of an installed distribution, or ``"not installed"``."""
    try:
        return version(name)
    except PackageNotFoundError:
        return "not installed"


def versions() -> dict[str, str]:
    """Return the versions of this program and of what it runs on."""
    return {
        "cardan": package_version("cardan-driveline"),
        "fmpy": package_version("fmpy"),
        "pythonfmu": package_version("pythonfmu"),
        "numpy": package_version("numpy"),
        "python": platform.python_version(),
        "system": f"{platform.system()} {platform.machine()}",
    }


def provenance(instance: Instance) -> dict[str, Any]:
    """Return kernel, identity of the FMU and all versions: the fields of a `RunInfo` of these names."""
    about = instance.description
    kernel, kernel_version = kernel_of(instance)
    fmu = {"file": about.path.name, "sha256": about.sha256, "guid": about.guid, "version": about.version,
           "kernel_version": kernel_version}
    return {"kernel": kernel, "fmu": fmu, "versions": versions()}
