"""``cardan linearize``: frequency response about the rotating steady state."""

from __future__ import annotations

import json
import math
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from cardan.cli.failures import expected_errors

if TYPE_CHECKING:
    from cardan.analyses.linearization import Linearization


def linearize(
    scene: Annotated[str, typer.Argument(help="Scene file (TOML), or the name of a shipped scene (`cardan scenes`).")],
    source: Annotated[str, typer.Option("--input", metavar="NAME", help="input.torque, output.torque, or "
                                        "input.acceleration where the engine prescribes the speed.")] = "input.torque",
    outputs: Annotated[str, typer.Option("--output", metavar="NAMES", help="Outputs with commas, such as "
                                         "output.speed,shaft.torque.")] = "output.speed",
    method: Annotated[str, typer.Option(metavar="METHOD", help="hill (harmonic lift), averaged (rigid, closed form), "
                                        "ignored (joints straight), frozen (at one angle), fmu (lift of the FMU "
                                        "through FMI alone).")] = "hill",
    frequencies: Annotated[str, typer.Option(metavar="RANGE", help="Hz: START:STOP:COUNT, START:STOP:COUNT:log, or "
                                             "numbers with commas.")] = "1:200:400",
    speed: Annotated[str | None, typer.Option(metavar="SPEED", help='Mean input speed, such as "3000 rpm"; the torque '
                                              "that holds it is found.")] = None,
    output: Annotated[Path | None, typer.Option("-o", metavar="FILE.csv", help="Write the response; a measurement goes "
                                                "beside it as FILE.measured.csv.")] = None,
    plot: Annotated[Path | None, typer.Option(metavar="FILE", help="Write a picture: .png, .svg or .pdf.")] = None,
    kind: Annotated[str, typer.Option("--plot-kind", metavar="KIND",
                                      help="bode, nyquist, poles or waterfall (sidebands).")] = "bode",
    absolute: Annotated[bool, typer.Option("--absolute", help="Magnitudes absolute, not in dB.")] = False,
    radians: Annotated[bool, typer.Option("--rad", help="Frequencies of pictures in rad/s, not Hz.")] = False,
    harmonics: Annotated[int | None, typer.Option(metavar="N", help="Harmonics of the lift; by default as many as the "
                                                  "tolerance asks for.")] = None,
    tolerance: Annotated[float, typer.Option(metavar="X", help="Relative change of G_0 that more harmonics may make."
                                             )] = 1e-8,
    sidebands: Annotated[int, typer.Option(metavar="K", help="Lines -K .. K in the files.")] = 3,
    angle: Annotated[str, typer.Option("--at-angle", metavar="ANGLE", help="Input shaft angle for --method frozen."
                                       )] = "0 deg",
    measure: Annotated[bool, typer.Option("--measure", help="Measure the FMU with small sines at up to 12 of the "
                                          "frequencies.")] = False,
    measured_at: Annotated[str | None, typer.Option("--measure-at", metavar="RANGE", help="Measure at these "
                                                    "frequencies, Hz.")] = None,
    fmu: Annotated[Path | None, typer.Option(metavar="FILE", help="FMU for --method fmu and --measure; by default the "
                                             "driveline of this installation.")] = None,
    changes: Annotated[list[str] | None, typer.Option(
        "--set", metavar="KEY=VALUE",
        help='Change a key of the scene, such as driveline.joint1.angle="10 deg".')] = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print the figures as one JSON object.")] = False,
) -> None:
    """Linearize a scene about its periodic steady state and compute its frequency response.

    The motion is periodic, so the response at the input's own frequency is the zeroth harmonic transfer function;
    sidebands stand at the input's frequency plus multiples of the motion's fundamental. Frequencies at which a sideband
    falls on the input are flagged.
    """
    with expected_errors(as_json):
        from cardan.analyses.linearize import linearize as run
        from cardan.analyses.plots_response import KINDS
        from cardan.cli.analysis_scene import bar, checked_scene, warn
        from cardan.errors import InputError
        from cardan.plots import PICTURES

        scenario = checked_scene(scene, changes, ((output, (".csv",)), (plot, PICTURES)), fmu)
        if kind not in KINDS:
            raise InputError(f"--plot-kind {kind}: choose one of {', '.join(KINDS)}")
        with bar(f"measuring {scenario.title}") as progress:
            made = run(scenario, source, outputs, method=method, speed=speed, frequencies=frequencies,
                       harmonics=harmonics, tolerance=tolerance, angle=angle, sidebands=sidebands,
                       measure=measured_at if measured_at is not None else measure, fmu=fmu, progress=progress)
        warn(made.warnings)
        files: dict[str, Any] = {}
        if output is not None:
            files["response"] = made.save(output)
        if plot is not None:
            made.plot(plot, kind, hertz=not radians, decibel=not absolute)
            files["plot"] = str(plot)
    if as_json:
        typer.echo(json.dumps({**made.summary(), "response": _rows(made), "files": files}))
    else:
        _print(made, files)


def _rows(made: Linearization) -> list[dict[str, Any]]:
    """Return G_0 of all outputs, for JSON."""
    response = made.response
    rows = []
    for i, frequency in enumerate(response.frequencies):
        for output in response.outputs:
            value = response.line(output)[i]
            flag = bool(response.flagged[i])
            rows.append({"frequency_hz": float(frequency), "output": output, "harmonic": 0,
                         "real": None if flag else float(value.real), "imag": None if flag else float(value.imag),
                         "flagged": flag})
    return rows


def _print(made: Linearization, files: dict[str, Any]) -> None:
    import numpy as np
    from rich.box import SIMPLE_HEAD
    from rich.console import Console
    from rich.table import Table

    console = Console(highlight=False, soft_wrap=True, width=None if sys.stdout.isatty() else 160)
    point = made.point
    truncation = f", truncated to {made.truncation:.1e}" if math.isfinite(made.truncation) else ""
    lines = [
        ("method", f"{made.method}" + (f", {made.harmonics} harmonics{truncation}" if made.harmonics else "")),
        ("operating point", f"{point.speed * 30.0 / math.pi:.8g} rpm, mean torque {point.mean_torque:.8g} N.m, "
                            f"residual {point.residual:.1e}"),
        ("stability", f"{'stable' if point.stable else 'UNSTABLE'}, growth rate {point.floquet.growth_rate:.8g} 1/s"),
        ("multipliers", "  ".join(_complex(m) for m in point.floquet.multipliers) or "none"),
        ("poles [1/s]", "  ".join(_complex(p) for p in made.poles) or "none"),
    ]
    for label, text in lines:
        console.print(f"{label:<16} {text}", markup=False)
    table = Table(box=SIMPLE_HEAD, pad_edge=False)
    for heading in ("output", "unit"):
        table.add_column(heading, no_wrap=True)
    for heading in ("first", "largest", "at Hz", "last", "measured within"):
        table.add_column(heading, justify="right", no_wrap=True)
    good = ~made.response.flagged
    for output in made.outputs:
        size = np.abs(made.response.line(output)[good])
        if len(size):
            top = int(np.argmax(size))
            table.add_row(output, made.response.unit(output), f"{size[0]:.5g}", f"{size[top]:.5g}",
                          f"{made.response.frequencies[good][top]:.5g}", f"{size[-1]:.5g}",
                          f"{made.differences[output]:.1e}" if output in made.differences else "")
    console.print(table)
    flagged = made.response.frequencies[~good]
    if len(flagged):
        console.print(f"{'flagged':<16} {', '.join(f'{f:g}' for f in flagged)} Hz: a sideband falls on the input's "
                      "line, the response depends on phase", markup=False)
    for label, names in files.items():
        console.print(f"{label + ' file':<16} {', '.join(names) if isinstance(names, list) else names}", markup=False)


def _complex(value: complex) -> str:
    return f"{value.real:.6g}{value.imag:+.6g}j" if value.imag else f"{value.real:.6g}"
