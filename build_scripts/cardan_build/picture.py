"""Draws the FMU's pictures: ``python -m cardan_build.picture [DIRECTORY]`` (needs matplotlib).

``model.png`` is what importers show of the FMU; ``icon.png`` and the flanges are for ``terminalsAndIcons``.
"""

from __future__ import annotations

import sys
from math import cos, radians, sin
from pathlib import Path
from typing import Any

from .sketch import BLUE, GREY

RISE = radians(20.0)  # both joints bend the same way by this angle
_ARM, _END = 0.36, 1.9


def draw(directory: Path) -> None:
    """Write all pictures as PNG without a date inside.

    Parameters
    ----------
    directory : Path
        Where they go; the package's own directory holds those that are built in.
    """
    _driveline(directory / "model.png", 4.0, 2.0, "CardanDriveline")
    _driveline(directory / "icon.png", 2.0, 2.0, "")
    _flange(directory / "flange_a.png", filled=True)
    _flange(directory / "flange_b.png", filled=False)


def _driveline(path: Path, width: float, height: float, title: str) -> None:
    """The driveline of 8 by 8 height/width units on width by height inches."""
    figure, axes = _canvas(width, height)
    axes.set(xlim=(0.0, 8.0), ylim=(-4.0 * height / width, 4.0 * height / width))
    left, right = (2.35, 0.2), (5.65, 0.2)
    start = (left[0] - _END * cos(RISE), left[1] - _END * sin(RISE))
    end = (right[0] + _END * cos(RISE), right[1] - _END * sin(RISE))
    scale = width / 4.0
    axes.plot(*zip(start, left, right, end, strict=True), color=GREY, linewidth=6.0 * scale, solid_joinstyle="round")
    for centre, lean, half in ((start, RISE, 0.6), (end, -RISE, 0.75)):
        x, y = -half * sin(lean), half * cos(lean)
        axes.plot((centre[0] - x, centre[0] + x), (centre[1] - y, centre[1] + y), color=BLUE, linewidth=15.0 * scale,
                  solid_capstyle="butt")
    for x, y in (left, right):
        for turn in (52.0, 128.0):
            dx, dy = _ARM * cos(radians(turn)), _ARM * sin(radians(turn))
            axes.plot((x - dx, x + dx), (y - dy, y + dy), color=BLUE, linewidth=5.0 * scale, solid_capstyle="round")
        axes.plot((x,), (y,), "o", color="white", markeredgecolor=BLUE, markersize=9.0 * scale,
                  markeredgewidth=2.5 * scale)
    if title:
        axes.text(4.0, 1.3, title, color=BLUE, fontsize=13, ha="center", weight="bold")
    figure.savefig(path, format="png", metadata={"Software": None}, transparent=not title)


def _flange(path: Path, *, filled: bool) -> None:
    """A circle, filled or not, as Modelica tools draw flanges."""
    figure, axes = _canvas(0.4, 0.4)
    axes.set(xlim=(-1.0, 1.0), ylim=(-1.0, 1.0))
    axes.plot((0.0,), (0.0,), "o", color=GREY if filled else "white", markeredgecolor=GREY, markersize=20.0,
              markeredgewidth=2.5)
    figure.savefig(path, format="png", metadata={"Software": None}, transparent=True)


def _canvas(width: float, height: float) -> tuple[Any, Any]:
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    figure = Figure(figsize=(width, height), dpi=100, facecolor="white")
    FigureCanvasAgg(figure)
    axes = figure.add_axes((0.0, 0.0, 1.0, 1.0))
    axes.axis("off")
    return figure, axes


if __name__ == "__main__":
    draw(Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).parent)
