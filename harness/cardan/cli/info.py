"""``cardan info``: what runs here, or what an FMU says about itself."""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from cardan.cli.failures import expected_errors

if TYPE_CHECKING:
    from cardan.description import Description


def info(
    fmu: Annotated[Path | None, typer.Argument(metavar="[FILE.fmu]", help="FMU to describe.")] = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print one JSON object.")] = False,
) -> None:
    """Say which kernel and which versions run here; with a file, describe that FMU."""
    with expected_errors(as_json):
        about = installation() if fmu is None else describe(fmu)
    if as_json:
        typer.echo(json.dumps(about))
    elif fmu is None:
        for name, value in about.items():
            typer.echo(f"{name:<12} {value}")
    else:
        _print_description(about)


def installation() -> dict[str, str]:
    """Return kernel and versions of this installation."""
    from cardan_kernel import KERNEL
    from cardan_kernel import __version__ as kernel_version

    from cardan.provenance import versions

    slower = "" if KERNEL == "compiled" else " (same results, slower; an installation with a C compiler compiles it)"
    return {"kernel": f"{KERNEL} {kernel_version}{slower}", **versions()}


def describe(path: Path) -> dict[str, Any]:
    """Return all that an FMU says about itself: identity, capabilities, variables, contents.

    Raises
    ------
    FmuError
        If the file is no FMI 2.0 co-simulation FMU.
    """
    from cardan.archive import open_archive
    from cardan.description import read_description

    about = read_description(path)
    with open_archive(path) as archive:
        contents = {member.filename: member.file_size for member in archive.infolist() if not member.is_dir()}
    return {
        "file": str(path), "size": path.stat().st_size, "sha256": about.sha256, "model": about.model_name,
        "version": about.version, "description": about.text, "guid": about.guid,
        "generation_tool": about.generation_tool, "generation_date": about.generation_date,
        "capabilities": _capabilities(about), "variables": [_row(about, name) for name in about.variables],
        "contents": contents,
    }


def _capabilities(about: Description) -> dict[str, bool]:
    return {"variable communication step": about.variable_step, "get and set state": about.can_get_set_state,
            "serialize state": about.can_serialize_state, "runs without Python": about.native}


def _row(about: Description, name: str) -> dict[str, str]:
    variable = about[name]
    return {key: getattr(variable, key) for key in ("name", "type", "causality", "variability", "unit", "display_unit",
                                                    "start", "minimum", "maximum", "description")}


def _print_description(about: dict[str, Any]) -> None:
    from rich.box import SIMPLE_HEAD
    from rich.console import Console
    from rich.table import Table

    console = Console(highlight=False, soft_wrap=True, width=None if sys.stdout.isatty() else 200)
    for key in ("file", "model", "version", "description", "guid", "sha256", "generation_tool", "generation_date"):
        console.print(f"{key.replace('_', ' '):<16} {about[key]}", markup=False)
    for name, present in about["capabilities"].items():
        console.print(f"{name:<28} {'yes' if present else 'no'}")
    for causality in dict.fromkeys(row["causality"] for row in about["variables"]):
        table = Table(title=f"{causality}s", title_justify="left", title_style="bold", box=SIMPLE_HEAD, pad_edge=False)
        for heading in ("name", "unit", "start", "range"):
            table.add_column(heading, no_wrap=True)
        table.add_column("description", min_width=12)
        for row in about["variables"]:
            if row["causality"] == causality:
                table.add_row(row["name"], _unit(row), _short(row["start"]), _range(row), row["description"])
        console.print(table, crop=False)
    console.print("contents", style="bold")
    for name, size in about["contents"].items():
        console.print(f"{size:>10}  {name}", markup=False)


def _unit(row: dict[str, str]) -> str:
    if row["type"] != "Real":
        return row["type"]
    return f"{row['unit']} ({row['display_unit']})" if row["display_unit"] else row["unit"]


def _range(row: dict[str, str]) -> str:
    low, high = _short(row["minimum"]), _short(row["maximum"])
    return f"{low} .. {high}" if low or high else ""


def _short(number: str) -> str:
    try:
        return f"{float(number):.6g}"
    except ValueError:  # a truth value, a text, or nothing
        return number
