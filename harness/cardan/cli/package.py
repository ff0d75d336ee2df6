"""``cardan package``: a scene as a system package for other tools."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from cardan.cli.failures import collected, expected_errors, refuse


def package(
    scene: Annotated[str, typer.Argument(help="Scene file (TOML), or the name of a shipped scene (`cardan scenes`).")],
    output: Annotated[Path | None, typer.Option("-o", "--output", metavar="FILE.ssp",
                                                help="Package to write; by default named after the scene.")] = None,
    changes: Annotated[list[str] | None, typer.Option(
        "--set", metavar="KEY=VALUE",
        help='Change a key of the scene, such as driveline.joint1.angle="10 deg".')] = None,
    fmu: Annotated[Path | None, typer.Option(
        metavar="FILE", help="Driveline FMU to put in; by default that of this installation.")] = None,
) -> None:
    """Write a scene as an SSP 1.0 package: driveline, engine, load and driver as FMUs, connected, with their values.

    Run it with constant steps and held inputs; the parameter set is named "scene". Held values need shorter steps than
    other couplings do: --set scene.communication_step="0.5 ms".
    """
    with expected_errors():
        from cardan_build.system import package as make

        from cardan.cli.simulate import read_overrides
        from cardan.scenario import Scenario

        problems: list[str] = []
        scenario = None
        with collected(problems):
            overrides = read_overrides(changes or [], None, problems)
            scenario = Scenario.load(scene).with_overrides(overrides)
        refuse(problems)
        assert scenario is not None
        made = make(scenario, output or Path(f"{scenario.name}.ssp"), fmu)
    if scenario.coupling not in ("held", "gauss-seidel"):
        typer.echo(f"note: the scene's step is meant for coupling = {scenario.coupling!r}; tools hold values over it,"
                   " which may need a shorter one (cardan simulate --set scene.coupling=held shows it)", err=True)
    typer.echo(f"{made}: {made.stat().st_size / 1024:.0f} kB, {scenario.stop_time:g} s in steps of "
               f"{scenario.communication_step:g} s, parameter set scene")
