"""Pictures of order spectra, their courses, and Campbell diagrams."""

from __future__ import annotations

import math
import os
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from cardan.plots import COLOURS, STYLE
from cardan.storage import written_beside

if TYPE_CHECKING:
    from cardan.analyses.campbell import Campbell
    from cardan.analyses.order_spectrum import OrderSpectrum

RPM = 30.0 / math.pi


def _begin(path: Any, width: float, height: float) -> Any:
    import matplotlib as mpl

    if path is not None:
        mpl.use("Agg")
    import matplotlib.pyplot as plt

    return plt.figure(figsize=(width, height), layout="constrained")


def _finish(figure: Any, path: str | os.PathLike[str] | None) -> None:
    if path is None:
        return
    import matplotlib.pyplot as plt

    with written_beside(Path(path)) as beside:
        figure.savefig(beside)
    plt.close(figure)


def plot_orders(spectrum: OrderSpectrum, path: str | os.PathLike[str] | None = None) -> Any:
    """Draw one panel per signal: its orders, and beside them the courses that were asked for.

    Parameters
    ----------
    spectrum : OrderSpectrum
    path : path-like, optional
        ``.png``, ``.svg`` or ``.pdf``; without it the figure stays open.
    """
    import matplotlib as mpl

    names = list(spectrum.lines)
    tracked = bool(spectrum.tracks)
    with mpl.rc_context(STYLE):  # type: ignore[arg-type]
        figure = _begin(path, 9.0 if tracked else 7.5, 1.2 + 1.7 * len(names))
        axes = figure.subplots(len(names), 2 if tracked else 1, squeeze=False,
                               width_ratios=[1.0, 1.2] if tracked else None)
        for name, row in zip(names, axes, strict=True):
            unit = spectrum.units[name] or "1"
            size = np.abs(spectrum.lines[name])[1:]
            row[0].bar(spectrum.orders[1:], size, width=0.28, color=COLOURS[0])
            row[0].set_title(name, loc="left", fontsize=8.5)
            row[0].set_ylabel(f"Amplitude [{unit}]")
            row[0].xaxis.set_major_locator(mpl.ticker.MultipleLocator(2.0 if spectrum.orders[-1] > 8 else 1.0))
            row[0].set_xlim(0.0, spectrum.orders[-1] + 0.5)
            row[0].grid(axis="x", visible=False)
            if tracked:
                for i, track in enumerate(t for t in spectrum.tracks if t.signal == name):
                    row[1].plot(track.speeds * RPM, track.amplitudes, color=COLOURS[i % len(COLOURS)],
                                label=f"order {track.order:g}")
                row[1].set_ylabel(f"Amplitude [{unit}]")
                row[1].legend(loc="best", frameon=False)
        axes[-1, 0].set_xlabel("Order of the input shaft speed [1]")
        if tracked:
            axes[-1, 1].set_xlabel("Mean input speed of a window [rpm]")
        low, high = (speed * RPM for speed in spectrum.speeds)
        figure.suptitle(f"{spectrum.title or 'Orders'}   ({spectrum.turns} turns, {low:.5g} to {high:.5g} rpm)", x=0.01,
                        ha="left", fontsize=11.0, fontweight="bold", color="#222222")
        _finish(figure, path)
    return figure


def plot_campbell(diagram: Campbell, path: str | os.PathLike[str] | None = None) -> Any:
    """Draw a Campbell diagram with its crossings.

    Parameters
    ----------
    diagram : Campbell
    path : path-like, optional
        ``.png``, ``.svg`` or ``.pdf``; without it the figure stays open.
    """
    import matplotlib as mpl

    with mpl.rc_context(STYLE):  # type: ignore[arg-type]
        figure = _begin(path, 8.5, 5.4)
        axes = figure.subplots()
        hertz = 1.0 / (2.0 * math.pi)
        last = float(diagram.speeds[-1])
        top = 1.6 * diagram.straight
        labelled = math.inf
        for order, source in diagram.orders.items():
            end = min(last, top / order)
            colour = COLOURS[1] if source == "engine" else COLOURS[2] if source == "joints" else COLOURS[3]
            axes.plot([0.0, end * RPM], [0.0, order * end * hertz], color=colour, linewidth=0.9,
                      linestyle="-" if "joints" in source else (0, (5, 2)))
            if labelled - end < 0.025 * last:
                continue  # no room for its number
            labelled = end
            axes.annotate(f"{order:g}", (end * RPM, order * end * hertz), xytext=(3, 2), textcoords="offset points",
                          fontsize=7.5, color=colour, annotation_clip=False)
        axes.axhline(diagram.straight * hertz, color="#8c8c8c", linewidth=0.9, linestyle=(0, (1, 2)),
                     label="natural frequency, joints straight")
        axes.plot(diagram.speeds * RPM, diagram.frequencies * hertz, color=COLOURS[0], linewidth=1.6,
                  label="frequency of perturbations as it turns")
        axes.plot([c.speed * RPM for c in diagram.crossings], [c.frequency * hertz for c in diagram.crossings], "o",
                  markersize=5.5, markerfacecolor="white", markeredgecolor="#222222", zorder=5, label="crossings")
        for source, colour in (("joints", COLOURS[2]), ("engine", COLOURS[1]), ("joints and engine", COLOURS[3])):
            if source in diagram.orders.values():
                axes.plot([], [], color=colour, label=f"orders of {source}")
        axes.set_xlim(0.0, last * RPM)
        axes.set_ylim(0.0, top * hertz)
        axes.set_xlabel("Mean input speed [rpm]")
        axes.set_ylabel("Frequency [Hz]")
        axes.legend(loc="upper left", bbox_to_anchor=(1.02, 1.0), frameon=False)
        figure.suptitle(diagram.title or "Campbell diagram", x=0.01, ha="left", fontsize=11.5, fontweight="bold",
                        color="#222222")
        _finish(figure, path)
    return figure
