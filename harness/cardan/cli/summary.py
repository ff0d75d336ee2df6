"""The table at the end of a run."""

from __future__ import annotations

import math

from rich.box import SIMPLE_HEAD
from rich.console import Console
from rich.measure import Measurement
from rich.table import Table
from rich.text import Text

from cardan.result import Result

HEADINGS = ["quantity", "unit", "min", "max", "mean", "final"]
BOUNDLESS = 10_000  # characters: wider than any table
NOTHING = 1e-12  # of the largest figure of a quantity


def print_summary(result: Result, files: dict[str, str]) -> None:
    """Print speeds, torques and whatever was recorded, then times, energy and kernel.

    Parameters
    ----------
    result : Result
        What to sum up; columns are shown in their display units.
    files : dict of str to str
        What was written where.
    """
    info = result.info
    console = Console(highlight=False, markup=False, emoji=False)  # titles and names stand as they are
    rows = []
    for name, figures in result.figures().items():
        unit, factor = result.shown(name)
        shown = [figures[key] for key in ("min", "max", "mean", "final")]
        dust = NOTHING * max(abs(value) for value in shown)  # rounding around zero
        rows.append([name, unit, *(_number(0.0 if abs(value) <= dust else factor * value) for value in shown)])
    if info.title:
        console.print(Text(info.title, style="bold"), soft_wrap=True)
    _print_rows(console, rows)
    for label, text in _lines(result, files):
        console.print(f"{label:<16} {text}", soft_wrap=True, markup=False)


def _print_rows(console: Console, rows: list[list[str]]) -> None:
    """Print a table; plain lines where the console is too narrow for it, since a figure cut short is a wrong one."""
    table = Table(box=SIMPLE_HEAD, pad_edge=False, padding=(0, 0, 0, 1))
    for place, heading in enumerate(HEADINGS):
        table.add_column(heading, justify="left" if place < 2 else "right", no_wrap=True)
    for row in rows:
        table.add_row(*map(Text, row))
    if Measurement.get(console, console.options.update_width(BOUNDLESS), table).maximum <= console.width:
        console.print(table)
        return
    for line in [HEADINGS, *rows]:
        console.print(Text(" ".join(line)), soft_wrap=True)


def _number(value: float) -> str:
    if not math.isfinite(value):
        return str(value)
    text = f"{value:.5g}"
    return "0" if text == "-0" else text


def _lines(result: Result, files: dict[str, str]) -> list[tuple[str, str]]:
    info = result.info
    lines = [
        ("simulated", f"{info.reached_time - info.start_time:g} s in {info.steps} steps"
                      f" ({info.coupling}, communication step {1e3 * info.communication_step:g} ms)"),
        ("computed in", f"{info.wall_time:.3g} s (processor {info.processor_time:.3g} s), after"
                        f" {info.loading_time:.2g} s of loading"),
        ("real-time factor", f"{info.real_time_factor:.3g}"),
        ("energy residual", f"{info.energy_residual:.3g} J at the interface; supplied {info.energy_supplied:.4g} J"),
        ("kernel", f"{info.kernel} {info.fmu.get('kernel_version', '')}".rstrip()),
    ]
    if info.note:
        lines.append(("note", info.note))
    return lines + [(f"{kind} file", path) for kind, path in files.items()]
