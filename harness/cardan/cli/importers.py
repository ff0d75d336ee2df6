"""``cardan importers``: the FMU in other tools, and how far each is from FMPy."""

from __future__ import annotations

import dataclasses
import json
from pathlib import Path
from typing import Annotated

import typer

from cardan.cli.failures import expected_errors


def importers(
    fmu: Annotated[Path | None, typer.Argument(metavar="[FILE.fmu]",
                                               help="Driveline FMU; by default that of this installation.")] = None,
    only: Annotated[list[str] | None, typer.Option(metavar="NAME", help="Run only this importer.")] = None,
    pythons: Annotated[list[str] | None, typer.Option(
        "--python", metavar="PATH", help="Interpreter to run them under (may be given again).")] = None,
    as_markdown: Annotated[bool, typer.Option("--markdown", help="Print the table of the README.")] = False,
    as_json: Annotated[bool, typer.Option("--json", help="Print one JSON object.")] = False,
) -> None:
    """Run one scene in FMPy and in every other importer that is installed; compare to 1e-12.

    Exit code 0: none differs or fails (a missing one is skipped by name). 1: one does. 2: bad input.
    """
    with expected_errors(as_json):
        from cardan.archive import open_archive
        from cardan.importers import compare, markdown, unavailable
        from cardan.importers.runner import OTHERS

        if fmu is None:
            from cardan_build import default_fmu

            fmu = default_fmu()
        open_archive(fmu).close()
        under: list[str | None] = [*pythons] if pythons else [None]
        found = [outcome for python in under for outcome in compare(fmu, only or OTHERS, python)]
        if not only:
            found += unavailable()
    if as_json:
        typer.echo(json.dumps({"fmu": str(fmu), "importers": [dataclasses.asdict(outcome) for outcome in found]}))
    elif as_markdown:
        typer.echo(markdown(found), nl=False)
    else:
        from rich.box import SIMPLE_HEAD
        from rich.console import Console
        from rich.table import Table

        from cardan.importers.table import HEADINGS, rows

        table = Table(*HEADINGS, box=SIMPLE_HEAD, pad_edge=False)
        for row in rows(found):
            table.add_row(*row)
        Console(highlight=False).print(table)
    if not all(outcome.good for outcome in found):
        raise typer.Exit(1)
