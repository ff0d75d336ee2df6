"""Figures of the measured tables."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from cardan.bench.records import Record, Tables, told
from cardan.bench.stepping import STATES
from cardan.bench.systems import COUPLED
from cardan.plots import COLOURS, STYLE
from cardan.storage import written_beside

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

ENDINGS = (".png", ".svg")
OTHERS, LIGHT = "#8f979e", "#9cc3dc"
MARKERS = "osD^vPX"
OWN = COLOURS[0]
_LOOK: dict[str, Any] = {"markersize": 4.0, "markeredgewidth": 0.0, "linewidth": 1.2}


def draw(tables: Tables, folder: Path) -> list[Path]:
    """Draw what there are tables for.

    Parameters
    ----------
    tables : dict
        Measured tables.
    folder : Path
        Existing directory.

    Returns
    -------
    list of Path
        The files written, each as PNG and SVG.

    Raises
    ------
    InputError
        If a file cannot be written.
    """
    import matplotlib as mpl

    files = []
    for name, (needed, make) in FIGURES.items():
        if not all(tables.get(table) for table in needed):
            continue
        with mpl.rc_context({**STYLE, "svg.hashsalt": "cardan"}):  # type: ignore[dict-item]
            figure = make(tables)
            for ending in ENDINGS:
                path = folder / f"{name}{ending}"
                with written_beside(path) as beside:
                    # Without the date the same figures give the same file.
                    figure.savefig(beside, metadata={"Date": None} if ending == ".svg" else {"Software": None})
                files.append(path)
    return files


def _figure(width: float, height: float, title: str, subtitle: str) -> Figure:
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    figure = Figure(figsize=(width, height), layout="constrained")
    FigureCanvasAgg(figure)
    # The empty second line keeps room for the subtitle, which the layout does not see.
    figure.suptitle(f"{title}\n", x=0.01, ha="left", fontsize=11.5, fontweight="bold", color="#222222")
    text = figure.text(0.0105, 1.0 - 23.0 / (72.0 * height), subtitle, fontsize=8, color="#777777", va="top")
    text.set_in_layout(False)
    return figure


def _logarithmic(axis: Axes, across: str, up: str) -> None:
    from matplotlib.ticker import LogLocator, NullLocator

    axis.set_xscale("log")
    axis.set_yscale("log")
    axis.set_xlabel(across)
    axis.set_ylabel(up)
    axis.yaxis.set_major_locator(LogLocator(numticks=8))
    axis.yaxis.set_minor_locator(NullLocator())


def _beside(figure: Figure, axis: Axes) -> None:
    """Put the legend of a panel to the right of all panels."""
    figure.legend(*axis.get_legend_handles_labels(), loc="outside right center", frameon=False, handlelength=1.8)


def integrator(tables: Tables) -> Figure:
    """Error against right-hand sides and against processor time, a line per case, a mark per tolerance."""
    records = tables["integrator"]
    figure = _figure(9.0, 3.9, "Integrator: work and precision",
                     "One mark per tolerance, 1e-3 to 1e-12; error of speeds and shaft torque over the run")
    axes = figure.subplots(1, 2, sharey=True)
    for place, (case, title) in enumerate(dict.fromkeys((r["case"], r["title"]) for r in records)):
        rows = [record for record in records if record["case"] == case and told(record)]
        for axis, column in zip(axes, ("rhs_per_ms", "ms_per_s")):
            axis.plot([row[column] for row in rows], [row["error"] for row in rows], color=COLOURS[place],
                      marker=MARKERS[place % len(MARKERS)], label=title, **_LOOK)
    _logarithmic(axes[0], "Right-hand sides per simulated ms", "Largest relative error")
    _logarithmic(axes[1], "Processor time per simulated second [ms]", "")
    _beside(figure, axes[1])
    return figure


def coupling(tables: Tables) -> Figure:
    """Error against communication step (above) and against processor time (below), a column per case."""
    from matplotlib.ticker import FixedLocator, NullLocator

    cases = [case for case in COUPLED if any(record["case"] == case.name for record in tables["coupling"])]
    figure = _figure(10.0, 6.4, "Coupling engine and load with the FMU",
                     "Largest speed error over the run against the same system solved as one; dashed: 1e-6")
    axes = figure.subplots(2, len(cases), sharey="col", squeeze=False)
    for column, case in enumerate(cases):
        above, below = axes[:, column]
        for place, (scheme, rows) in enumerate(_by_scheme(tables["coupling"], case.name)):
            good = [row for row in rows if row["error"] is not None]
            look = {"color": COLOURS[place], "marker": MARKERS[place], "label": scheme, **_LOOK}
            above.plot([row["step_ms"] for row in good], [row["error"] for row in good], **look)
            below.plot([row["ms_per_s"] for row in good], [row["error"] for row in good], **look)
            lost = [row["step_ms"] for row in rows if row["error"] is None]
            if lost:  # above the panel, in line with the steps that were tried
                above.plot(lost, np.full(len(lost), 0.965 - 0.045 * place), linestyle="none", marker="x", markersize=5,
                           color=COLOURS[place], transform=above.get_xaxis_transform())
        for scheme, rows in _by_scheme(tables.get("controlled", []), case.name):
            if scheme == "auto":
                below.plot([row["ms_per_s"] for row in rows], [row["error"] for row in rows], color="#222222",
                           linestyle=":", marker="*", markersize=7, markeredgewidth=0.0, label="auto")
        if any(row["error"] is None for row in tables["coupling"] if row["case"] == case.name):
            above.annotate("x  diverges", (1.0, 0.02), xycoords="axes fraction", ha="right", fontsize=7.5,
                           color="#777777")
        _logarithmic(above, "Communication step [ms]", "" if column else "Largest relative error")
        above.xaxis.set_major_locator(FixedLocator([0.25, 0.5, 1.0, 2.0, 4.0, 8.0]))
        above.xaxis.set_minor_locator(NullLocator())
        above.xaxis.set_major_formatter("{x:g}")
        _logarithmic(below, "Processor time per simulated second [ms]", "" if column else "Largest relative error")
        above.set_title(f"{case.name}: {case.title}", fontsize=9, loc="left", color="#444444")
        for axis in (above, below):
            axis.axhline(1e-6, color="#999999", linewidth=0.7, linestyle=(0, (4, 3)), zorder=1.0)
    _beside(figure, axes[1, 0])
    return figure


def _by_scheme(records: Iterable[Record], case: str) -> list[tuple[str, list[Record]]]:
    found: dict[str, list[Record]] = {}
    for record in records:
        # Without states of their own in the models this one is the held scheme.
        if record["case"] == case and record["scheme"] != "gauss-seidel":
            found.setdefault(record["scheme"], []).append(record)
    return list(found.items())


def peers(tables: Tables) -> Figure:
    """Processor time for the same error, as bars."""
    names = [name for name in ("peers", "coupled_peers") if tables.get(name)]
    heads = {"peers": "Driveline under constant torques",
             "coupled_peers": "Torque map with ripple and quadratic load, outside the FMU"}
    figure = _figure(8.6, 1.2 + 0.24 * sum(len(tables[name]) + 2 for name in names), "Time for a speed error of 1e-6",
                     "All in one run, interleaved; medians with quartiles. Blue: this project")
    axes = figure.subplots(len(names), 1, squeeze=False, sharex=True,
                           height_ratios=[len(tables[name]) + 1 for name in names])[:, 0]
    for axis, name in zip(axes, names):
        rows = sorted(tables[name], key=lambda record: float(record["ms_per_s"]))
        _dots(axis, rows, "method", "ms_per_s", [not row["method"].startswith(("scipy", "python-control"))
                                                 for row in rows], "ms")
        axis.set_title(heads[name], fontsize=9, loc="left", color="#444444")
    times = [row["ms_per_s"] for name in names for row in tables[name]]
    axes[-1].set_xlim(0.6 * min(times), 2.2 * max(times))
    axes[-1].set_xlabel("Processor time per simulated second [ms]")
    return figure


def cost(tables: Tables) -> Figure:
    """What a step costs: hosts, fidelity, number of outputs; memory over the steps."""
    figure = _figure(10.0, 6.0, "What a communication step of 1 ms costs", "Processor time, medians with quartiles")
    parts: Any = figure.subfigures(2, 1)
    above, below = (part.subplots(1, 2) for part in parts)
    steps = [row for row in tables["stepping"] if row["us"] is not None and row["what"] != STATES]
    _dots(above[0], steps, "what", "us", [not row["what"].startswith("empty") for row in steps], "us")
    above[0].set_xlabel("Time per step [us]")
    _models(above[1], tables["fidelity"])
    exchange = tables["exchange"]
    below[0].errorbar([row["outputs"] for row in exchange], [row["us"] for row in exchange],
                      [[row["us"] - row["low"] for row in exchange], [row["high"] - row["us"] for row in exchange]],
                      color=OWN, marker="o", capsize=2, **_LOOK)
    below[0].set_ylim(bottom=0.0)
    below[0].set_xlabel("Outputs read per step")
    below[0].set_ylabel("Time per step [us]")
    memory = tables["memory"]
    below[1].plot([row["steps"] / 1e6 for row in memory], [row["resident_MB"] for row in memory], color=OWN, marker="o",
                  **_LOOK)
    below[1].set_xlim(left=0.0)
    below[1].set_ylim(0.0, 1.4 * max(row["resident_MB"] for row in memory))
    below[1].set_xlabel("Steps [millions]")
    below[1].set_ylabel("Memory of the process [MB]")
    for axis, head in zip((*above, *below), ("Set 2 inputs, step, get 5 outputs", "Fidelity", "Exchange", "Memory")):
        axis.set_title(head, fontsize=9, loc="left", color="#444444")
    return figure


def _models(axis: Axes, rows: list[Record]) -> None:
    """Draw the cost of the models as bars, the kernel's share dark."""
    places = np.arange(len(rows))
    axis.barh(places, [row["fmu_us"] for row in rows], height=0.62, color=LIGHT, label="FMU")
    axis.barh(places, [row["kernel_us"] for row in rows], height=0.62, color=OWN, label="kernel alone")
    for place, row in zip(places, rows):
        axis.annotate(f"{row['fmu_us']:.2g} us", (row["fmu_us"], place), xytext=(4, 0), textcoords="offset points",
                      va="center", fontsize=7.5, color="#444444")
    axis.set_yticks(places, [row["model"] for row in rows])
    axis.invert_yaxis()
    axis.grid(axis="y", visible=False)
    axis.margins(x=0.14)
    axis.set_xlabel("Time per step, tolerance 1e-9 [us]")
    axis.legend(loc="upper right", frameon=True, framealpha=1.0, edgecolor="none")


def _dots(axis: Axes, rows: list[Record], name: str, column: str, ours: list[bool], unit: str) -> None:
    """Draw a logarithmic line of dots from the top, with quartiles and values; those of this project in colour."""
    for place, (row, own) in enumerate(zip(rows, ours)):
        value, colour = row[column], OWN if own else OTHERS
        axis.plot([row["low"], row["high"]], [place, place], color=colour, linewidth=3.0, alpha=0.45,
                  solid_capstyle="round")
        axis.plot(value, place, marker="o", markersize=6.0, color=colour, markeredgewidth=0.0)
        axis.annotate(f"{value:.3g} {unit}", (max(value, row["high"]), place), xytext=(7, 0),
                      textcoords="offset points", va="center", fontsize=7.5, color="#444444")
    axis.set_xscale("log")
    axis.set_xlim(0.7 * min(row["low"] for row in rows), 2.5 * max(row["high"] for row in rows))
    axis.set_yticks(range(len(rows)), [row[name] for row in rows])
    axis.set_ylim(len(rows) - 0.4, -0.6)
    axis.xaxis.set_major_formatter("{x:g}")


FIGURES: dict[str, tuple[tuple[str, ...], Callable[[Tables], Figure]]] = {
    "integrator": (("integrator",), integrator),
    "coupling": (("coupling",), coupling),
    "peers": (("peers",), peers),
    "cost": (("stepping", "fidelity", "exchange", "memory"), cost),
}
