"""``cardan orders``: order spectra, order tracking and Campbell diagram of a run."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Annotated, Any

import typer

from cardan.cli.failures import expected_errors


def orders(
    result: Annotated[Path, typer.Argument(metavar="RESULT", help="Result of `cardan simulate -o`: .csv, .parquet or "
                                           ".nc.")],
    signals: Annotated[str | None, typer.Option("--signal", metavar="NAMES",
                                                help="Columns with commas; all by default.")] = None,
    highest: Annotated[float, typer.Option("--max-order", metavar="X", help="Largest order.")] = 12.0,
    track: Annotated[str, typer.Option(metavar="ORDERS", help="Orders to follow over a run-up, such as 2,4.")] = "",
    window: Annotated[int, typer.Option(metavar="TURNS", help="Turns of a window when following.")] = 4,
    campbell: Annotated[Path | None, typer.Option(metavar="FILE", help="Write the Campbell diagram of the run's scene: "
                                                  ".png, .svg or .pdf; its crossings are listed.")] = None,
    speed: Annotated[str | None, typer.Option(metavar="RANGE", help='Speeds of the Campbell diagram, such as '
                                              '"100 rpm:6000 rpm:60".')] = None,
    output: Annotated[Path | None, typer.Option("-o", "--output", metavar="FILE.csv",
                                                help="Write all amplitudes.")] = None,
    plot: Annotated[Path | None, typer.Option(metavar="FILE", help="Write a picture: .png, .svg or .pdf.")] = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print the figures as one JSON object.")] = False,
) -> None:
    """Split the signals of a run into orders of the input shaft speed, without leakage at any course of the speed."""
    with expected_errors(as_json):
        from cardan.analyses.order_spectrum import orders as run
        from cardan.cli.failures import refuse
        from cardan.plots import PICTURES
        from cardan.result import Result
        from cardan.storage import writable_problems

        problems: list[str] = []
        for path, endings in ((output, (".csv",)), (plot, PICTURES), (campbell, PICTURES)):
            if path is not None:
                problems += writable_problems(path, endings)
        refuse(problems)
        loaded = Result.load(result)
        spectrum = run(loaded, signals, highest=highest, track=track, window=window)
        files = {}
        if output is not None:
            spectrum.save(output)
            files["orders"] = str(output)
        if plot is not None:
            spectrum.plot(plot)
            files["plot"] = str(plot)
        diagram = None
        if campbell is not None or speed is not None:
            diagram = _campbell(loaded, result, speed)
            if campbell is not None:
                diagram.plot(campbell)
                files["campbell"] = str(campbell)
    if as_json:
        summary = spectrum.summary()
        if diagram is not None:
            summary["campbell"] = diagram.summary()
        typer.echo(json.dumps({**summary, "files": files}))
        return
    typer.echo(str(spectrum))
    if diagram is not None:
        typer.echo(str(diagram))
    for label, name in files.items():
        typer.echo(f"{label + ' file':<16} {name}")


def _campbell(loaded: Any, path: Path, speed: str | None) -> Any:
    from cardan.analyses.campbell import campbell
    from cardan.errors import InputError
    from cardan.scenario import Scenario

    if not loaded.info.scene:
        raise InputError(f"{path} does not carry its scene, which the Campbell diagram needs (a .csv has it in its "
                         ".meta.json)")
    return campbell(Scenario.from_dict(loaded.info.scene, path.parent), speed)
