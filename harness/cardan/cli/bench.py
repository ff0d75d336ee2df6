"""``cardan bench``: speed against error, measured here and now."""

from __future__ import annotations

import json
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from cardan.cli.failures import expected_errors

if TYPE_CHECKING:
    from cardan.bench.sections import Measured, Progress


def bench(
    output: Annotated[Path, typer.Option("-o", "--output", metavar="DIR",
                                         help="Directory for tables, figures and results.json.")] = Path("bench"),
    only: Annotated[str, typer.Option(metavar="NAME,..", help="Measure these sections alone.")] = "",
    quick: Annotated[bool, typer.Option("--quick", help="A subset with few repeats.")] = False,
    as_json: Annotated[bool, typer.Option("--json", help="Print everything as one JSON object.")] = False,
) -> None:
    """Measure speed against error: integrator, coupling, auto, peers, stepping, fidelity, scaling, hard.

    Exit code 0: measured, and every hard case held. 1: a hard case did not. 2: bad input.
    """
    with expected_errors(as_json):
        from cardan.bench.records import Options
        from cardan.bench.report import prepare, write
        from cardan.bench.sections import chosen, run

        names = chosen([name.strip() for name in only.split(",") if name.strip()])
        prepare(output)
        with _bar() as progress:
            measured = run(Options(quick), names, progress)
        files = [str(path) for path in write(measured, output)]
    held = all(record["held"] for record in measured.tables.get("hard", []))
    if as_json:
        from cardan.bench.targets import targets

        typer.echo(json.dumps({**measured.to_dict(), "files": files,
                               "targets": [target._asdict() for target in targets(measured.tables)]}))
    else:
        _print(measured, files)
    if not held:
        raise typer.Exit(1)


@contextmanager
def _bar() -> Iterator[Progress | None]:
    """Give a progress bar on stderr; nothing where stderr is no terminal."""
    import sys

    if not sys.stderr.isatty():
        yield None
        return
    from rich.console import Console
    from rich.progress import BarColumn, TaskProgressColumn, TextColumn, TimeRemainingColumn
    from rich.progress import Progress as Bar

    with Bar(TextColumn("{task.description}"), BarColumn(), TaskProgressColumn(), TimeRemainingColumn(),
             console=Console(stderr=True), transient=True) as bar:
        task = bar.add_task("", total=1.0)
        yield lambda done, what: bar.update(task, completed=done, description=what)


def _print(measured: Measured, files: list[str]) -> None:
    """Print the targets with what was measured, and where the rest is."""
    from rich.box import SIMPLE_HEAD
    from rich.console import Console
    from rich.table import Table

    from cardan.bench.targets import targets

    console = Console(highlight=False)
    promises = targets(measured.tables)
    if promises:
        table = Table("target", "wanted", "measured", "", box=SIMPLE_HEAD, pad_edge=False)
        for target in promises:
            verdict = {True: "met", False: "[red]not met[/red]", None: "-"}[target.met]
            table.add_row(target.what, target.wanted, target.measured, verdict)
        console.print(table)
    broken = [record for record in measured.tables.get("hard", []) if not record["held"]]
    for record in broken:
        console.print(f"[red]hard case {record['number']}, {record['case']}:[/red] {record['property']}: "
                      f"{record['measured']:.3g}, bound {record['bound']:.3g} {record['unit']}")
    console.print(f"{len(files)} files, among them {files[0]} and {files[1]}")
