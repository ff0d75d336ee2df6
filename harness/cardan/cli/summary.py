"""The table at the end of a run."""

from __future__ import annotations

import math

from rich.box import SIMPLE_HEAD
from rich.console import Console
from rich.table import Table

from cardan.result import Result

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
    console = Console(highlight=False)
    table = Table(title=info.title or None, title_justify="left", title_style="bold", box=SIMPLE_HEAD, pad_edge=False,
                  padding=(0, 0, 0, 1))
    for heading in ("quantity", "unit"):
        table.add_column(heading, no_wrap=True)
    for heading in ("min", "max", "mean", "final"):
        table.add_column(heading, justify="right", no_wrap=True)
    for name, figures in result.figures().items():
        unit, factor = result.shown(name)
        shown = [figures[key] for key in ("min", "max", "mean", "final")]
        dust = NOTHING * max(abs(value) for value in shown)  # rounding around zero
        table.add_row(name, unit, *(_number(0.0 if abs(value) <= dust else factor * value) for value in shown))
    console.print(table)
    for label, text in _lines(result, files):
        console.print(f"{label:<16} {text}", soft_wrap=True, markup=False)


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
