"""The commands of ``cardan``."""

from __future__ import annotations

import json
import sys
from typing import Annotated, Any

import typer
from typer.core import TyperGroup

from cardan.cli.bench import bench
from cardan.cli.build import build
from cardan.cli.check import check
from cardan.cli.importers import importers
from cardan.cli.info import info
from cardan.cli.linearize import linearize
from cardan.cli.orders import orders
from cardan.cli.package import package
from cardan.cli.scenes import scenes
from cardan.cli.simulate import simulate
from cardan.cli.stability import stability


class _Commands(TyperGroup):
    """Gives usage errors as JSON too where JSON is asked for."""

    def invoke(self, ctx: Any) -> Any:
        try:
            return super().invoke(ctx)
        except Exception as error:
            # Typer shows the error on stderr. Its class comes from Click, which newer versions of Typer hold inside.
            said = getattr(error, "format_message", None)
            if said is not None and "--json" in sys.argv:
                typer.echo(json.dumps({"completed": False, "errors": [said()]}))
            raise


# Plain help texts: importing rich for them would double the time of `cardan --help`.
app = typer.Typer(cls=_Commands, no_args_is_help=True, add_completion=False, rich_markup_mode=None,
                  pretty_exceptions_enable=False, context_settings={"help_option_names": ["-h", "--help"]})
for command, summary in (
    (simulate, "Run a scene; write result and picture."),
    (linearize, "Frequency response about the steady state."),
    (stability, "Regions of parametric instability."),
    (orders, "Orders of a run, Campbell diagram."),
    (build, "Build the driveline FMU."),
    (check, "Check an FMU against FMI 2.0."),
    (info, "Say what runs here, or describe an FMU."),
    (scenes, "List the shipped scenes."),
    (package, "Write a scene as an SSP system package."),
    (importers, "Run the FMU in other importers; compare."),
    (bench, "Measure speed against error."),
):
    app.command(short_help=summary)(command)


def _print_version(wanted: bool) -> None:
    if wanted:
        from cardan.provenance import package_version

        typer.echo(f"cardan {package_version('cardan-driveline')}")
        raise typer.Exit


@app.callback()
def cardan(
    version: Annotated[bool, typer.Option("--version", callback=_print_version, is_eager=True,
                                          help="Print the version and leave.")] = False,
) -> None:
    """Simulate drivelines with universal joints: the FMU, what drives and loads it, and what comes out."""
