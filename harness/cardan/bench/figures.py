"""Figures of the measured tables."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from cardan.bench.records import Record, Tables
from cardan.bench.systems import COUPLED
from cardan.plots import COLOURS, STYLE
from cardan.storage import written_beside

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

ENDINGS = (".png", ".svg")
GREY = "#b8bec4"
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
        with mpl.rc_context({**STYLE, "svg.hashsalt": "cardan"}):
            figure = make(tables)
            for ending in ENDINGS:
                path = folder / f"{name}{ending}"
                with written_beside(path) as beside:
                    # Without the date the same figures give the same file.
                    figure.savefig(beside, metadata={"Date": None} if ending == ".svg" else {"Software": None})
                files.append(path)
    return files


def _figure(width: float, height: float, rows: int, columns: int, title: str, subtitle: str,
            **options: Any) -> tuple[Figure, Any]:
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    figure = Figure(figsize=(width, height), layout="constrained")
    FigureCanvasAgg(figure)
    axes = figure.subplots(rows, columns, squeeze=False, **options)
    figure.suptitle(title, x=0.01, ha="left", fontsize=11.5, fontweight="bold", color="#222222")
    axes[0, 0].annotate(subtitle, (0.0, 1.0), xytext=(0, 18), xycoords="axes fraction", textcoords="offset points",
                        fontsize=8, color="#777777", annotation_clip=False)
    return figure, axes


def _logarithmic(axis: Axes, across: str, up: str) -> None:
    from matplotlib.ticker import LogLocator, NullLocator

    axis.set_xscale("log")
    axis.set_yscale("log")
    axis.set_xlabel(across)
    axis.set_ylabel(up)
    axis.yaxis.set_major_locator(LogLocator(numticks=8))
    axis.yaxis.set_minor_locator(NullLocator())


def _end_legend(axis: Axes) -> None:
    axis.legend(loc="center left", bbox_to_anchor=(1.0, 0.5), frameon=False, handlelength=1.8, borderaxespad=0.6)


def integrator(tables: Tables) -> Figure:
    """Error against right-hand sides and against processor time, a line per case, a mark per tolerance."""
    records = tables["integrator"]
    figure, axes = _figure(9.0, 3.9, 1, 2, "Integrator: work and precision",
                           "One mark per tolerance, 1e-3 to 1e-12; error of speeds and shaft torque over the run",
                           sharey=True)
    for place, (case, title) in enumerate(dict.fromkeys((r["case"], r["title"]) for r in records)):
        rows = [record for record in records if record["case"] == case]
        for axis, column in zip(axes[0], ("rhs_per_ms", "ms_per_s")):
            axis.plot([row[column] for row in rows], [row["error"] for row in rows], color=COLOURS[place],
                      marker=MARKERS[place % len(MARKERS)], label=title, **_LOOK)
    _logarithmic(axes[0, 0], "Right-hand sides per simulated ms", "Largest relative error")
    _logarithmic(axes[0, 1], "Processor time per simulated second [ms]", "")
    _end_legend(axes[0, 1])
    return figure


def coupling(tables: Tables) -> Figure:
    """Error against communication step (above) and against processor time (below), a column per case."""
    cases = [case for case in COUPLED if any(record["case"] == case.name for record in tables["coupling"])]
    figure, axes = _figure(10.0, 6.4, 2, len(cases), "Coupling engine and load with the FMU",
                           "Largest speed error over the run against the same system solved as one", sharey="col")
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
        _logarithmic(below, "Processor time per simulated second [ms]", "" if column else "Largest relative error")
        above.set_title(case.name, fontsize=9.5, loc="left", color="#222222")
        for axis in (above, below):
            axis.axhline(1e-6, color="#999999", linewidth=0.7, linestyle=(0, (4, 3)), zorder=1.0)
    _end_legend(axes[1, -1])
    axes[0, 0].texts[0].set_position((0, 26))
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
    heads = {"peers": "Driveline under constant torques", "coupled_peers": "Ripple engine and quadratic load outside"}
    figure, axes = _figure(9.0, 1.2 + 0.26 * sum(len(tables[name]) + 2 for name in names), len(names), 1,
                           "Time for a speed error of 1e-6", "Processor time per simulated second, one run, interleaved",
                           sharex=True, height_ratios=[len(tables[name]) + 1 for name in names])
    for axis, name in zip(axes[:, 0], names):
        rows = sorted(tables[name], key=lambda record: float(record["ms_per_s"]))
        _bars(axis, [row["method"] for row in rows], [row["ms_per_s"] for row in rows],
              [(row["low"], row["high"]) for row in rows],
              [not row["method"].startswith(("scipy", "python-control")) for row in rows], "ms")
        axis.set_xscale("log")
        axis.set_title(heads[name], fontsize=9, loc="left", color="#444444")
    axes[-1, 0].set_xlabel("Processor time per simulated second [ms]")
    axes[0, 0].texts[0].set_position((0, 22))
    return figure


def cost(tables: Tables) -> Figure:
    """What a step costs: hosts, fidelity, number of outputs; memory over the steps."""
    figure, axes = _figure(10.0, 6.2, 2, 2, "What a communication step of 1 ms costs",
                           "Processor time, medians with quartiles")
    steps = [row for row in tables["stepping"] if row["us"] is not None]
    _bars(axes[0, 0], [row["what"] for row in steps], [row["us"] for row in steps],
          [(row["low"], row["high"]) for row in steps],
          ["empty" not in row["what"] and "same" not in row["what"] for row in steps], "us")
    axes[0, 0].set_xscale("log")
    axes[0, 0].set_title("set 2 inputs, step, get 5 outputs", fontsize=9, loc="left", color="#444444")
    models = tables["fidelity"]
    _bars(axes[0, 1], [row["model"] for row in models], [row["fmu_us"] for row in models],
          [(row["low"], row["high"]) for row in models], [True] * len(models), "us")
    axes[0, 1].barh(range(len(models)), [row["kernel_us"] for row in models], height=0.62, color="#06334f")
    axes[0, 1].set_title("fidelity: FMU, and dark its kernel alone", fontsize=9, loc="left", color="#444444")
    exchange = tables["exchange"]
    axes[1, 0].errorbar([row["outputs"] for row in exchange], [row["us"] for row in exchange],
                        [[row["us"] - row["low"] for row in exchange], [row["high"] - row["us"] for row in exchange]],
                        color=OWN, marker="o", capsize=2, **_LOOK)
    axes[1, 0].set_ylim(bottom=0.0)
    axes[1, 0].set_xlabel("Outputs read per step")
    axes[1, 0].set_ylabel("Time per step [us]")
    memory = tables["memory"]
    axes[1, 1].plot([row["steps"] / 1e6 for row in memory], [row["resident_MB"] for row in memory], color=OWN,
                    marker="o", **_LOOK)
    axes[1, 1].set_ylim(0.0, 1.4 * max(row["resident_MB"] for row in memory))
    axes[1, 1].set_xlabel("Steps [millions]")
    axes[1, 1].set_ylabel("Memory of the process [MB]")
    axes[0, 0].texts[0].set_position((0, 24))
    return figure


def _bars(axis: Axes, names: list[str], values: list[float], spread: list[tuple[float, float]], ours: list[bool],
          unit: str) -> None:
    """Draw horizontal bars from the top with their values; those of this project in colour."""
    places = np.arange(len(names))
    errors = np.array([[value - low, high - value] for value, (low, high) in zip(values, spread)]).T
    axis.barh(places, values, height=0.62, color=[OWN if own else GREY for own in ours], xerr=np.maximum(errors, 0.0),
              error_kw={"elinewidth": 0.8, "ecolor": "#444444"})
    for place, value, (_, high) in zip(places, values, spread):
        axis.annotate(f"{value:.3g} {unit}", (max(value, high), place), xytext=(4, 0), textcoords="offset points",
                      va="center", fontsize=7.5, color="#444444")
    axis.set_yticks(places, names)
    axis.invert_yaxis()
    axis.grid(axis="y", visible=False)
    axis.margins(x=0.18)


FIGURES: dict[str, tuple[tuple[str, ...], Callable[[Tables], Figure]]] = {
    "integrator": (("integrator",), integrator),
    "coupling": (("coupling",), coupling),
    "peers": (("peers",), peers),
    "cost": (("stepping", "fidelity", "exchange", "memory"), cost),
}
