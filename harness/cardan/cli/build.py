"""``cardan build``: make the FMU."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from cardan.cli.failures import expected_errors


def build(
    output: Annotated[Path, typer.Option("-o", "--output", metavar="FILE", help="FMU to write.")] = Path(
        "CardanDriveline.fmu"),
    portable: Annotated[bool, typer.Option("--portable", help="Leave the compiled kernel out.")] = False,
    kernels: Annotated[list[Path] | None, typer.Option(
        "--kernel", metavar="DIR", help="Add compiled kernels that were made elsewhere of the same source.")] = None,
) -> None:
    """Build the driveline FMU: verified in a clean process, same source, same bytes."""
    import logging
    import sys

    logging.basicConfig(level=logging.INFO, format="%(message)s", stream=sys.stderr)
    with expected_errors():
        from cardan_build import build as build_fmu

        from cardan.description import read_description

        made = build_fmu(output, portable=portable, kernel_dirs=kernels or [])
        about = read_description(made)
    typer.echo(f"{made}: {made.stat().st_size / 1024:.0f} kB, sha256 {about.sha256}")
