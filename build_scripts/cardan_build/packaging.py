"""Runs in a process of its own: from a stage to what pythonfmu makes of it.

pythonfmu's builder imports the slave and leaves it in the process (docs/FMI.md, trap 2); nobody else's
process is to be used for that. Called as ``package(job)`` by `assembly`.
"""

from __future__ import annotations

import importlib
import sys
from pathlib import Path
from typing import Any

from . import dependencies, description, documentation, terminals
from .sources import PYTHONFMU_MODULES


def package(job: dict[str, Any]) -> None:
    """Write ``raw.fmu`` (pythonfmu's archive), ``modelDescription.xml`` and ``terminalsAndIcons`` into ``work``.

    Parameters
    ----------
    job : dict
        ``work`` and ``stage`` (directories), ``slave``, ``kernel``, ``pythonfmu`` (staged names), ``digest``,
        ``binaries``.
    """
    work, stage = Path(job["work"]), Path(job["stage"])
    sys.path.insert(0, str(stage))
    kernel = importlib.import_module(job["kernel"])
    table = importlib.import_module(f"{job['kernel']}.variables")
    found = dependencies.find(kernel.Driveline, table.VARIABLES)
    xml = description.describe(table.VARIABLES, table.UNITS, found, version=kernel.__version__, digest=job["digest"],
                               binaries=job["binaries"])
    (work / "modelDescription.xml").write_bytes(xml)
    documentation.write(work / "documentation", table.VARIABLES, version=kernel.__version__, text=description.TEXT,
                        digest=job["digest"], binaries=job["binaries"])
    for name, content in terminals.files(variable.name for variable in table.VARIABLES).items():
        path = work / name
        path.parent.mkdir(exist_ok=True)
        path.write_bytes(content)
    _alias(job["pythonfmu"])
    from pythonfmu import FmuBuilder

    FmuBuilder.build_FMU(
        stage / f"{job['slave']}.py",
        dest=work / "raw.fmu",
        project_files=[stage / job["kernel"], stage / job["pythonfmu"]],
        documentation_folder=work / "documentation",
    )


def _alias(name: str) -> None:
    """Let the slave derive from the class that the builder looks for: the installed pythonfmu under the staged name."""
    sys.modules[name] = importlib.import_module("pythonfmu")
    for module in PYTHONFMU_MODULES:
        sys.modules[f"{name}.{module}"] = importlib.import_module(f"pythonfmu.{module}")
