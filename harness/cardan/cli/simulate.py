"""``cardan simulate``: run a scene, write what comes out, say how it went."""

from __future__ import annotations

import dataclasses
import json
import tomllib
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from cardan.cli.failures import collected, expected_errors, refuse
from cardan.errors import CardanError

if TYPE_CHECKING:
    from cardan.result import Result
    from cardan.scenario import Scenario
    from cardan.simulation import Progress


def simulate(
    scene: Annotated[str, typer.Argument(help="Scene file (TOML), or the name of a shipped scene (`cardan scenes`).")],
    output: Annotated[Path | None, typer.Option("-o", "--output", metavar="FILE",
                                                help="Write the result: .csv, .parquet or .nc.")] = None,
    plot: Annotated[Path | None, typer.Option(metavar="FILE", help="Write a picture: .png, .svg or .pdf.")] = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print the summary as one JSON object.")] = False,
    changes: Annotated[list[str] | None, typer.Option(
        "--set", metavar="KEY=VALUE",
        help='Change a key of the scene, such as driveline.joint1.angle="10 deg".')] = None,
    fmu: Annotated[Path | None, typer.Option(metavar="FILE",
                                             help="FMU to run; by default the driveline of this installation.")] = None,
    stop_time: Annotated[str | None, typer.Option(metavar="TIME", help='End of the run, such as "10 s".')] = None,
) -> None:
    """Run a scene and print a summary.

    Exit code 0: complete. 1: the run failed or ended early, and what was recorded is kept; or a file could not be
    written. 2: bad input, nothing written.
    """
    with expected_errors(as_json):
        scenario = _checked(scene, output, plot, changes or [], fmu, stop_time)
        result, interrupted = _run(scenario, fmu)
    # From here on there is a run, which no error may lose.
    files, errors = _write(result, output, plot)
    try:
        if as_json:
            typer.echo(json.dumps({**result.summary(), "files": files, **({"errors": errors} if errors else {})}))
        else:
            from cardan.cli.summary import print_summary

            print_summary(result, files)
    finally:  # even where stdout takes nothing
        if not result.info.completed:
            errors.append(f"the run ended at t = {result.info.reached_time:.6g} s: {result.info.message}")
        for error in errors:
            typer.echo(f"error: {error}", err=True)
    if errors:
        raise typer.Exit(130 if interrupted else 1)


def _checked(scene: str, output: Path | None, plot: Path | None, changes: list[str], fmu: Path | None,
             stop_time: str | None) -> Scenario:
    """Read the scene; raise one error with all that is wrong with it and with the files."""
    from cardan.archive import open_archive
    from cardan.plots import PICTURES
    from cardan.scenario import Scenario
    from cardan.scenario.shipped import find
    from cardan.storage import FORMATS, writable_problems

    problems: list[str] = []
    scenario = None
    with collected(problems):
        overrides = read_overrides(changes, stop_time, problems)
        scenario = Scenario.load(scene)
        if overrides:
            scenario = scenario.with_overrides(overrides)
    read = [find(scene), *([fmu] if fmu is not None else [])]
    if scenario is not None:
        read += _files_of((scenario.engine, scenario.load_model, scenario.driver))
    if output is not None:
        problems += writable_problems(output, FORMATS, read)
    if plot is not None:
        problems += writable_problems(plot, PICTURES, read)
    if fmu is not None:
        with collected(problems):
            open_archive(fmu).close()
    refuse(problems)
    assert scenario is not None
    return scenario


def _files_of(part: object) -> list[Path]:
    """Return the files that models are made from, in whatever key they stand."""
    if isinstance(part, Path):
        return [part]
    if isinstance(part, (list, tuple)):
        return [path for item in part for path in _files_of(item)]
    if dataclasses.is_dataclass(part):
        return [path for entry in dataclasses.fields(part) for path in _files_of(getattr(part, entry.name))]
    return []


def read_overrides(changes: list[str], stop_time: str | None, problems: list[str]) -> dict[str, Any]:
    overrides: dict[str, Any] = {}
    for change in changes:
        key, equals, text = change.partition("=")
        if not equals or not key.strip():
            problems.append(f"--set {change}: must be of the form KEY=VALUE, such as scene.coupling=slope")
        else:
            overrides[key.strip()] = _value(text.strip())
    if stop_time is not None:
        overrides["scene.stop_time"] = stop_time
    return overrides


def _value(text: str) -> Any:
    """Return a list, a table or a quoted text as TOML has it; all else is taken as it stands, with its unit."""
    if text[:1] in "[{\"'" and text:
        try:
            return tomllib.loads(f"value = {text}")["value"]
        except tomllib.TOMLDecodeError:
            return text
    return text


def _run(scenario: Scenario, fmu: Path | None) -> tuple[Result, bool]:
    from cardan.simulation import Interrupted
    from cardan.simulation import simulate as run

    with progress_bar(scenario.title) as progress:
        try:
            return run(scenario, fmu=fmu, progress=progress, announce=lambda line: typer.echo(line, err=True)), False
        except Interrupted as stop:
            return stop.result, True


@contextmanager
def progress_bar(title: str) -> Iterator[Progress | None]:
    """Give a progress bar on stderr; nothing where stderr is no terminal."""
    import sys

    if not sys.stderr.isatty():
        yield None
        return
    from rich.console import Console
    from rich.progress import BarColumn, Progress, TaskProgressColumn, TextColumn, TimeRemainingColumn

    bar = Progress(TextColumn("{task.description}", markup=False), BarColumn(), TaskProgressColumn(),
                   TimeRemainingColumn(), console=Console(stderr=True), transient=True)
    task = bar.add_task(title, total=1.0)

    def update(fraction: float) -> None:
        bar.start()  # with the first step, below the line that says what runs
        bar.update(task, completed=fraction)

    try:
        yield update
    finally:
        bar.stop()


def _write(result: Result, output: Path | None, plot: Path | None) -> tuple[dict[str, str], list[str]]:
    """Try each file; return those that were written, and what went wrong with the others."""
    files: dict[str, str] = {}
    errors: list[str] = []
    for kind, path, write in (("result", output, result.save), ("plot", plot, result.plot)):
        if path is None:
            continue
        try:
            write(path)
            files[kind] = str(path)
        except CardanError as error:
            errors.append(str(error))
        except Exception as error:  # a library's own, which must cost neither the other file nor the summary
            errors.append(f"{path} cannot be written: {type(error).__name__}: {error}")
    return files, errors
