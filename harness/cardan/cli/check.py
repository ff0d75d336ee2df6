"""``cardan check``: does an FMU keep to FMI 2.0, and does it do what it says?"""

from __future__ import annotations

import json
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from cardan.cli.failures import expected_errors

if TYPE_CHECKING:
    from cardan.check.runner import Progress


def check(
    fmu: Annotated[Path, typer.Argument(metavar="FILE.fmu", help="FMI 2.0 co-simulation FMU.")],
    junit: Annotated[Path | None, typer.Option(metavar="FILE.xml", help="Write a JUnit report for CI systems.")] = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print the report as one JSON object.")] = False,
    reference: Annotated[Path | None, typer.Option(
        metavar="DIR", help="Where X_ref.csv, X_in.csv and X_ref.opt are; by default beside the FMU.")] = None,
    export: Annotated[Path | None, typer.Option(
        metavar="DIR", help="Write such reference files instead of checking.")] = None,
    only: Annotated[list[str] | None, typer.Option(metavar="CHECK",
                                                   help="Carry out this check alone (repeatable).")] = None,
    leave_out: Annotated[list[str] | None, typer.Option("--skip", metavar="CHECK",
                                                        help="Leave this check out (repeatable).")] = None,
    strict: Annotated[bool, typer.Option("--strict", help="Let warnings fail a check.")] = False,
    instances: Annotated[int, typer.Option(min=1, help="Instances of the memory check.")] = 1000,
    time_limit: Annotated[float, typer.Option(min=0.1, metavar="SECONDS", help="Time that one check may take.")] = 60.0,
    verbose: Annotated[bool, typer.Option("-v", "--verbose", help="Print remarks too.")] = False,
) -> None:
    """Check an FMU against FMI 2.0, each check in a process of its own.

    Exit code 0: no check failed. 1: a check failed. 2: the file is no FMU that can be checked here, the
    reference cannot be read or made, or a report cannot be written.
    """
    with expected_errors(as_json):
        from cardan.check import Options, check_fmu, export_reference
        from cardan.errors import InputError

        if junit is not None and not junit.absolute().parent.is_dir():
            raise InputError(f"{junit} cannot be written: there is no directory {junit.absolute().parent}")
        if export is not None:
            files = [str(path) for path in export_reference(fmu, export, time_limit=time_limit)]
            typer.echo(json.dumps({"files": files}) if as_json else "\n".join(f"written: {path}" for path in files))
            return
        options = Options(time_limit=time_limit, instances=instances, reference=str(reference or ""))
        with _bar(fmu.name) as progress:
            report = check_fmu(fmu, only=only or (), leave_out=leave_out or (), options=options, strict=strict,
                               progress=progress)
        if junit is not None:
            from cardan.check.junit import write_junit

            write_junit(report, junit)
    if as_json:
        typer.echo(json.dumps(report.to_dict()))
    else:
        from cardan.check.table import print_report

        print_report(report, verbose)
    if not report.passed:
        raise typer.Exit(1)


@contextmanager
def _bar(title: str) -> Iterator[Progress | None]:
    """Give a progress bar on stderr; nothing where stderr is no terminal."""
    import sys

    if not sys.stderr.isatty():
        yield None
        return
    from rich.console import Console
    from rich.progress import BarColumn, MofNCompleteColumn, TextColumn, TimeElapsedColumn
    from rich.progress import Progress as Bar

    with Bar(TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), TimeElapsedColumn(),
             console=Console(stderr=True), transient=True) as bar:
        task = bar.add_task(title, total=None)
        yield lambda done, total, what: bar.update(task, completed=done, total=total, description=what)
