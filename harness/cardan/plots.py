"""Pictures of results: stacked panels over time, one per kind of quantity, in the units that people use."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from cardan.result import Column, Result
from cardan.storage import written_beside

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

PICTURES = (".png", ".svg", ".pdf")

COLOURS = ("#0b5c8f", "#d1572a", "#3f8f4f", "#8a5aa8", "#c79a1b", "#4a4a4a", "#1fa3a3", "#b3446c")
STYLE: dict[str, Any] = {
    "font.family": "sans-serif",
    "font.sans-serif": ["DejaVu Sans"],
    "font.size": 8.5,
    "axes.edgecolor": "#8c8c8c",
    "axes.labelcolor": "#333333",
    "axes.linewidth": 0.6,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "axes.axisbelow": True,
    "grid.color": "#e6e6e6",
    "grid.linewidth": 0.6,
    "lines.linewidth": 1.0,
    "lines.solid_joinstyle": "round",
    "xtick.color": "#555555",
    "ytick.color": "#555555",
    "xtick.major.width": 0.6,
    "ytick.major.width": 0.6,
    "agg.path.chunksize": 20000,
    "savefig.dpi": 160,
    "svg.fonttype": "none",
}

# unit -> quantity; the order is that of the panels
QUANTITIES = {"km/h": "Vehicle speed", "pedal": "Pedal", "gear": "Gear", "rpm": "Speed", "rad/s": "Speed",
              "deg/s": "Speed", "turns": "Shaft angle", "1": "Ratio", "%": "Ratio", "N.m": "Torque", "N": "Force",
              "kN": "Force", "deg": "Angle", "rad": "Angle", "rad/s2": "Acceleration", "m/s2": "Acceleration",
              "W": "Power", "kW": "Power", "J": "Energy", "kJ": "Energy", "s": "Time"}
METER = "energy.residual"  # tells how exact the run was: a figure for the caption, not a curve
COLUMNS = 1500  # across a panel
# A curve becomes a band where it has more turning points per column and, per column, a greater share of the panel's
# height than these, over a window of columns.
WINDOW, DENSE, TALL = 31, 0.3, 0.05


@dataclass(frozen=True)
class Line:
    """One column as it is drawn."""

    name: str
    label: str
    values: Column


def plot_result(result: Result, path: str | os.PathLike[str] | None = None) -> Figure:
    """Draw all columns of a result.

    Parameters
    ----------
    result : Result
        What to draw.
    path : path-like, optional
        ``.png``, ``.svg`` or ``.pdf`` to save to. Without it the figure belongs to pyplot, ready for ``show()``.

    Returns
    -------
    matplotlib.figure.Figure

    Raises
    ------
    InputError
        If the picture cannot be written.
    """
    import matplotlib as mpl

    with mpl.rc_context(STYLE):  # type: ignore[arg-type]
        panels = panels_of(result)
        figure = _figure(9.0, 1.05 + 1.5 * len(panels), on_screen=path is None)
        axes = figure.subplots(len(panels), 1, sharex=True, squeeze=False)[:, 0]
        for axis, (unit, lines) in zip(axes, panels.items(), strict=True):
            _panel(axis, result.time, unit, lines)
        axes[-1].set_xlabel("Time [s]")
        axes[-1].set_xlim(result.time[0], result.time[-1] if len(result) > 1 else result.time[0] + 1.0)
        figure.align_ylabels(axes)
        _caption(figure, axes[0], result)
        if path is not None:
            with written_beside(Path(path)) as beside:
                figure.savefig(beside)
    return figure


def panels_of(result: Result) -> dict[str, list[Line]]:
    """Group the columns into panels by the unit that they are shown in.

    Returns
    -------
    dict of str to list of Line
        Unit (or ``gear``, ``pedal``) to its lines, in the order of the panels.
    """
    panels: dict[str, list[Line]] = {}
    for name, values in result.columns.items():
        if name == METER and len(result.columns) > 1:
            continue
        unit, factor = _shown(name, result)
        panels.setdefault(unit, []).append(Line(name, _label(name), values * factor))
    order = list(QUANTITIES)
    return dict(sorted(panels.items(), key=lambda item: order.index(item[0]) if item[0] in order else len(order)))


def _shown(name: str, result: Result) -> tuple[str, float]:
    if name.endswith(".gear"):
        return "gear", 1.0
    if name.endswith((".throttle", ".brake")):
        return "pedal", 100.0
    if name in ("input.angle", "output.angle") and float(np.ptp(result[name])) > 4.0 * np.pi:
        return "turns", 0.5 / np.pi
    return result.shown(name)


def _label(name: str) -> str:
    return re.sub(r"(joint)(\d)", r"\1 \2", name).replace(".", " ").replace("_", " ")


def _figure(width: float, height: float, on_screen: bool) -> Figure:
    if on_screen:
        import matplotlib.pyplot as plt

        return plt.figure(figsize=(width, height), layout="constrained")
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    figure = Figure(figsize=(width, height), layout="constrained")
    FigureCanvasAgg(figure)
    return figure


def _panel(axis: Axes, time: Column, unit: str, lines: list[Line]) -> None:
    from matplotlib.ticker import MaxNLocator

    span = _swing(np.concatenate([line.values for line in lines]))
    for line, colour, rank in _styled(lines):
        style: dict[str, Any] = {"color": colour, "linewidth": 1.4 - 0.5 * rank, "zorder": 3.0 + rank}
        if "target" in line.name:
            style = {"color": "#9a9a9a", "linewidth": 2.6, "zorder": 2.0}
        if unit == "gear":
            axis.plot(time, line.values, drawstyle="steps-post", label=line.label, **style)
        else:
            _curve(axis, time, line, span, style)
    quantity = QUANTITIES.get(unit, "Value")
    written = {"gear": "", "pedal": " [%]"}.get(unit, f" [{unit}]")
    axis.set_ylabel(f"{quantity}{written}", parse_math=False)
    axis.yaxis.set_major_locator(MaxNLocator(5, integer=unit == "gear"))
    axis.margins(y=0.08)
    axis.ticklabel_format(axis="y", useOffset=False, scilimits=(-4, 6))
    legend = axis.legend(loc="center left", bbox_to_anchor=(1.0, 0.5), frameon=False, handlelength=1.4,
                         borderaxespad=0.6)
    for text in legend.get_texts():
        text.set_parse_math(False)  # names of other FMUs may hold a $


def _curve(axis: Axes, time: Column, line: Line, span: float, style: dict[str, Any]) -> None:
    """Draw a line; where it swings faster than a panel of height `span` can show, draw the band that it fills."""
    from scipy.ndimage import median_filter, uniform_filter1d

    size = len(time) // COLUMNS
    if size < 2 or not np.isfinite(line.values).all():
        axis.plot(time, line.values, label=line.label, **style)
        return
    whole = len(time) // size * size
    values = line.values[:whole]
    low, high = values.reshape(-1, size).min(axis=1), values.reshape(-1, size).max(axis=1)
    turns = np.zeros(whole)
    turns[1:-1] = np.diff(np.sign(np.diff(values))) != 0.0
    dense = uniform_filter1d(turns.reshape(-1, size).sum(axis=1), WINDOW) > DENSE
    # The median is not misled by a single spike or step within the window. Rounding noise is no band, and a line with
    # little to hide has none at all.
    height = median_filter(high - low, WINDOW) / span if span > 0.0 else np.zeros(len(low))
    dense &= height > 1e-3
    band = dense if np.mean(dense & (height > TALL)) > 0.25 else np.zeros_like(dense)
    axis.fill_between(time[:whole:size], low, high, where=band, color=style["color"], alpha=0.45, linewidth=0.4,
                      zorder=style["zorder"] - 0.01)
    axis.plot(time[:whole], np.where(np.repeat(band, size), np.nan, values), label=line.label, **style)


def _styled(lines: list[Line]) -> Iterator[tuple[Line, str, float]]:
    """Give each line its colour and its rank 0 to 1: wide swings go behind narrow ones and are drawn broader."""
    swings = [_swing(line.values) for line in lines]
    ranks = np.empty(len(lines))
    ranks[np.argsort(swings, kind="stable")[::-1]] = np.linspace(0.0, 1.0, len(lines)) if len(lines) > 1 else 0.7
    for place, (line, rank) in enumerate(zip(lines, ranks, strict=True)):
        yield line, COLOURS[place % len(COLOURS)], float(rank)


def _swing(values: Column) -> float:
    finite = values[np.isfinite(values)]
    return float(np.ptp(finite)) if len(finite) else 0.0


def _caption(figure: Figure, top: Axes, result: Result) -> None:
    info = result.info
    parts = [f"{info.coupling}, step {1e3 * info.communication_step:g} ms" if info.coupling else "",
             f"{info.kernel} kernel" if info.kernel in ("compiled", "interpreted") else info.kernel,
             f"energy residual {np.abs(result[METER]).max():.2g} J" if METER in result.columns else ""]
    top.set_title("   |   ".join(part for part in parts if part), loc="left", fontsize=7.5, color="#777777",
                  parse_math=False)
    figure.suptitle(info.title or "Cardan driveline", x=0.01, ha="left", fontsize=11.5, fontweight="bold",
                    color="#222222", parse_math=False)  # a title may speak of dollars
    if not info.completed:
        top.set_title(f"ended early at {info.reached_time:g} s", loc="right", fontsize=8.0, color="#c0392b")
