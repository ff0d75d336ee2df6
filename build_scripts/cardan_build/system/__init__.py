"""System packages (SSP 1.0): a scene as FMUs of its own parts, connected, with its values.

`package` writes one: the driveline, the engine, the load and the driver as FMUs, the connections, a parameter set
named ``scene`` for each, and a default experiment. An importer that runs it with constant communication steps gets
what ``cardan simulate`` computes with ``coupling = "held"``, as far as it exchanges the values in that order.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from cardan.scenario import Scenario

__all__ = ["package"]


def package(scenario: Scenario, output: Path, fmu: Path | None = None) -> Path:
    """Write a scene as a system package.

    Parameters
    ----------
    scenario : Scenario
        The scene.
    output : Path
        File to write, ending with ``.ssp``; replaced only by a complete and verified package.
    fmu : Path, optional
        Driveline FMU to put in; by default that of this installation.

    Returns
    -------
    Path
        `output`.

    Raises
    ------
    BuildError
        If the scene cannot start, the FMU is none of this project, the package fails its verification, or the file
        cannot be written.
    """
    from .assembly import assemble

    return assemble(scenario, Path(output), fmu)
