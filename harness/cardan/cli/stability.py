"""``cardan stability``: regions of parametric instability over speed and joint angle."""

from __future__ import annotations

import json
import math
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from cardan.cli.failures import expected_errors

if TYPE_CHECKING:
    from cardan.analyses.stability import Stability

SHOWN = 40  # transitions in the table


def stability(
    scene: Annotated[str, typer.Argument(help="Scene file (TOML), or the name of a shipped scene (`cardan scenes`).")],
    speed: Annotated[str | None, typer.Option(metavar="RANGE", help='Mean input speeds, such as "500 rpm:6000 rpm:100" '
                                              "(START:STOP:COUNT) or numbers with commas; by default around the "
                                              "natural frequency.")] = None,
    angle: Annotated[str | None, typer.Option(metavar="RANGE", help='Joint angles, such as "1 deg:40 deg:40"; by '
                                              "default those of the scene.")] = None,
    joints: Annotated[str, typer.Option(metavar="WHICH", help="Joints that take the angle: scene (those that the scene "
                                        "bends), 1, 2 or both.")] = "scene",
    damping: Annotated[str | None, typer.Option(metavar="NAME", help="Damping whose critical value is found: "
                                                "output.damping, input.damping, shaft.damping or none.")] = None,
    output: Annotated[Path | None, typer.Option("-o", "--output", metavar="FILE.csv", help="Write the growth at all "
                                                "points.")] = None,
    plot: Annotated[Path | None, typer.Option(metavar="FILE", help="Write a picture: .png, .svg or .pdf.")] = None,
    processes: Annotated[int | None, typer.Option(metavar="N", help="Parallel processes; by default one per processor."
                                                  )] = None,
    changes: Annotated[list[str] | None, typer.Option(
        "--set", metavar="KEY=VALUE",
        help='Change a key of the scene, such as driveline.joint1.angle="10 deg".')] = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print the figures as one JSON object.")] = False,
) -> None:
    """Chart the stability of a scene: Floquet multipliers, growth per turn, transition curves, critical damping.

    Growth per turn is a natural logarithm: a perturbation goes as exp(growth * turns of the input shaft). With
    [engine] type = "speed" the prescribed speed is swept, else the mean speed, held by the torque that it takes.
    """
    with expected_errors(as_json):
        from cardan.analyses.stability import stability as run
        from cardan.cli.analysis_scene import bar, checked_scene, warn
        from cardan.plots import PICTURES

        scenario = checked_scene(scene, changes, ((output, (".csv",)), (plot, PICTURES)))
        with bar(scenario.title) as progress:
            chart = run(scenario, speed, angle, joints=joints, damping=damping, processes=processes, progress=progress)
        warn(chart.warnings)
        files = {}
        if output is not None:
            chart.save(output)
            files["chart"] = str(output)
        if plot is not None:
            chart.plot(plot)
            files["plot"] = str(plot)
    if as_json:
        typer.echo(json.dumps({**chart.summary(), "files": files}))
    else:
        _print(chart, files)


def _print(chart: Stability, files: dict[str, str]) -> None:
    from rich.box import SIMPLE_HEAD
    from rich.console import Console
    from rich.table import Table

    rpm = 30.0 / math.pi
    console = Console(highlight=False, soft_wrap=True, width=None if sys.stdout.isatty() else 160)
    console.print(f"{chart.title}: angle of {chart.joints}; natural frequency {chart.natural_frequency * rpm:.6g} rpm",
                  markup=False)
    table = Table(box=SIMPLE_HEAD, pad_edge=False)
    table.add_column("region", no_wrap=True)
    for heading in ("angle [deg]", "low [rpm]", "high [rpm]", "growth per turn [1]", "worst at [rpm]"):
        table.add_column(heading, justify="right", no_wrap=True)
    for t in chart.transitions[:SHOWN]:
        name = f"{t.region} {t.type}" if t.region else t.type
        table.add_row(name, f"{math.degrees(t.angle):.6g}", f"{t.speed_low * rpm:.10g}", f"{t.speed_high * rpm:.10g}",
                      f"{t.growth_per_turn:.5g}", f"{t.speed_worst * rpm:.8g}")
    if chart.transitions:
        console.print(table)
    else:
        console.print("no instability in this range")
    if len(chart.transitions) > SHOWN:
        console.print(f"{len(chart.transitions) - SHOWN} more regions: see --json or --plot")
    for r in chart.resonances[:SHOWN]:
        console.print(f"resonance with order {r.order} at {r.speed * rpm:.8g} rpm ({math.degrees(r.angle):.6g} deg)")
    for c in chart.critical_damping[:SHOWN]:
        console.print(f"critical {c.parameter} at {math.degrees(c.angle):.6g} deg: {c.value:.6g} N.m.s/rad, damping "
                      f"ratio {c.ratio:.6g}", markup=False)
    for label, name in files.items():
        console.print(f"{label + ' file':<16} {name}", markup=False)
