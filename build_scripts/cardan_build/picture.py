"""Draws ``model.png``, the FMU's picture: ``python -m cardan_build.picture FILE`` (needs matplotlib)."""

from __future__ import annotations

import sys
from pathlib import Path

SHAFTS = ((0.6, 2.2), (2.2, 5.4), (5.4, 7.0))
HEIGHTS = ((0.9, 1.1), (1.1, 2.1), (2.1, 2.3))
BLUE, GREY = "#1f4e79", "#5b6770"


def draw(path: Path) -> None:
    """Write the picture as PNG, 400 x 200 pixels, without a date inside."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure
    from matplotlib.patches import Rectangle

    figure = Figure(figsize=(4.0, 2.0), dpi=100, facecolor="white")
    FigureCanvasAgg(figure)
    axes = figure.add_axes((0.0, 0.0, 1.0, 1.0))
    axes.set(xlim=(0.0, 8.0), ylim=(0.0, 4.0))
    axes.axis("off")
    for (x0, x1), (y0, y1) in zip(SHAFTS, HEIGHTS, strict=True):
        axes.plot((x0, x1), (y0 + 0.6, y1 + 0.6), color=GREY, linewidth=5.0, solid_capstyle="round")
    for x, y in ((2.2, 1.7), (5.4, 2.7)):
        axes.plot((x - 0.18, x + 0.18), (y - 0.32, y + 0.32), color=BLUE, linewidth=3.0)
        axes.plot((x - 0.30, x + 0.30), (y + 0.22, y - 0.22), color=BLUE, linewidth=3.0)
    for x, y, width in ((0.3, 1.0, 0.35), (7.1, 2.15, 0.45)):
        axes.add_patch(Rectangle((x, y - 0.1), width, 1.2 if width > 0.4 else 1.0, color=BLUE))
    axes.text(0.3, 0.35, "input", color=GREY, fontsize=9)
    axes.text(6.9, 1.5, "output", color=GREY, fontsize=9)
    axes.text(4.0, 3.45, "CardanDriveline", color=BLUE, fontsize=11, ha="center")
    figure.savefig(path, format="png", metadata={"Software": None})


if __name__ == "__main__":
    draw(Path(sys.argv[1]))
