"""Picture of a stability chart: growth over speed and joint angle with the transition curves."""

from __future__ import annotations

import math
import os
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from cardan.plots import COLOURS, STYLE
from cardan.storage import written_beside

if TYPE_CHECKING:
    from cardan.analyses.stability import Stability

RPM = 30.0 / math.pi
VISIBLE = 1e-4  # of the speed: narrower regions are drawn as a line


def plot_stability(chart: Stability, path: str | os.PathLike[str] | None = None) -> Any:
    """Draw a chart.

    Parameters
    ----------
    chart : Stability
    path : path-like, optional
        ``.png``, ``.svg`` or ``.pdf``; without it the figure stays open.

    Returns
    -------
    matplotlib.figure.Figure
    """
    import matplotlib as mpl

    if path is not None:
        mpl.use("Agg")
    import matplotlib.pyplot as plt

    with mpl.rc_context(STYLE):  # type: ignore[arg-type]
        figure = plt.figure(figsize=(9.0, 5.6), layout="constrained")
        axes = figure.subplots()
        if len(chart.angles) > 1 and len(chart.speeds) > 1:
            _map(figure, axes, chart)
        else:
            _curve(axes, chart)
        figure.suptitle(chart.title or "Cardan driveline", x=0.01, ha="left", fontsize=11.5, fontweight="bold",
                        color="#222222")
        axes.set_title(f"growth of twist perturbations   |   {chart.joints}   |   natural frequency "
                       f"{chart.natural_frequency / (2.0 * math.pi):.4g} Hz = {chart.natural_frequency * RPM:.5g} rpm",
                       loc="left", fontsize=7.8, color="#666666")
        if path is not None:
            with written_beside(Path(path)) as beside:
                figure.savefig(beside)
            plt.close(figure)
    return figure


def _map(figure: Any, axes: Any, chart: Stability) -> None:
    import matplotlib as mpl

    growth = np.ma.masked_invalid(chart.growth_per_turn)
    top = max(float(growth.max()), 1e-3)
    bottom = min(float(growth.min()), -1e-3)
    norm = mpl.colors.TwoSlopeNorm(0.0, bottom if bottom > -top else -top, top)
    shades = ["#1f5f86", "#9cc3d5", "#f7f7f5", "#f0a35e", "#a82a22"]
    colours = mpl.colors.LinearSegmentedColormap.from_list("growth", shades)
    axes.set_facecolor("#d9d9d9")
    mesh = axes.pcolormesh(chart.speeds * RPM, np.degrees(chart.angles), growth, cmap=colours, norm=norm,
                           shading="nearest", rasterized=True)
    axes.grid(False)
    bar = figure.colorbar(mesh, ax=axes, pad=0.02)
    bar.set_label("Growth per turn (logarithm) [1]")
    _transitions(axes, chart)
    axes.set_xlabel("Mean input speed [rpm]")
    axes.set_ylabel("Joint angle [deg]")
    axes.set_xlim(chart.speeds[0] * RPM, chart.speeds[-1] * RPM)
    axes.set_ylim(np.degrees(chart.angles[0]), np.degrees(chart.angles[-1]))


def _transitions(axes: Any, chart: Stability) -> None:
    regions = sorted({t.region for t in chart.transitions})
    names: dict[bool, str] = {False: "principal region", True: "higher regions"}
    for region in regions:
        found = sorted((t for t in chart.transitions if t.region == region), key=lambda t: t.angle)
        angles = np.degrees([t.angle for t in found])
        low = np.array([t.speed_low for t in found]) * RPM
        high = np.array([t.speed_high for t in found]) * RPM
        colour = COLOURS[0] if region == 1 else COLOURS[3] if region else COLOURS[5]
        style = {"color": colour, "linewidth": 1.1, "zorder": 4}
        if region:
            axes.plot(low, angles, label=names.pop(region > 1, None), **style)
            axes.plot(high, angles, **style)
            place = int(np.argmax(angles))
            x = np.nanmean([low[place], high[place]]) if np.isfinite([low[place], high[place]]).any() else np.nan
            if np.isfinite(x):
                axes.annotate(str(region), (x, angles[place]), xytext=(0, -4), textcoords="offset points", ha="center",
                              va="top", fontsize=8, color=colour, zorder=5,
                              bbox={"boxstyle": "circle,pad=0.15", "facecolor": "white", "edgecolor": colour,
                                    "linewidth": 0.6})
        else:
            axes.plot([t.speed_worst * RPM for t in found], angles, ".", color=colour, markersize=3,
                      label="sum or drift")
    orders = sorted({r.order for r in chart.resonances})
    for i, order in enumerate(orders):
        found_r = sorted((r for r in chart.resonances if r.order == order), key=lambda r: r.angle)
        axes.plot([r.speed * RPM for r in found_r], np.degrees([r.angle for r in found_r]), color="#777777",
                  linewidth=0.9, linestyle=(0, (4, 3)), label="resonance with a joint order" if i == 0 else None)
    if regions or orders:
        axes.legend(loc="lower right", frameon=True, framealpha=0.85, edgecolor="none", fontsize=7.5)


def _curve(axes: Any, chart: Stability) -> None:
    """One angle over the speeds, or one speed over the angles."""
    over_speed = len(chart.speeds) > 1
    x = chart.speeds * RPM if over_speed else np.degrees(chart.angles)
    y = chart.growth_per_turn.ravel()
    axes.plot(x, y, color=COLOURS[0], marker=".", markersize=3)
    axes.axhline(0.0, color="#8c8c8c", linewidth=0.8)
    if over_speed:
        for t in chart.transitions:
            if math.isfinite(t.speed_low) and math.isfinite(t.speed_high):
                if t.speed_high - t.speed_low > VISIBLE * t.speed_high:
                    axes.axvspan(t.speed_low * RPM, t.speed_high * RPM, color=COLOURS[1], alpha=0.18)
                else:
                    axes.axvline(t.speed_low * RPM, color=COLOURS[1], linewidth=0.8)
    axes.set_xlabel("Mean input speed [rpm]" if over_speed else "Joint angle [deg]")
    axes.set_ylabel("Growth per turn (logarithm) [1]")
