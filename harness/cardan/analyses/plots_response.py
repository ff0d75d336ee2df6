"""Pictures of linearizations: Bode, Nyquist, poles and zeros by python-control, and the sidebands."""

from __future__ import annotations

import math
import os
import warnings
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from cardan.analyses.signals import control_name
from cardan.errors import InputError
from cardan.plots import COLOURS, STYLE
from cardan.storage import written_beside

if TYPE_CHECKING:
    from cardan.analyses.linearization import Linearization

KINDS = ("bode", "nyquist", "poles", "waterfall")
LABELS = {"hill": "harmonic lift", "averaged": "averaged (rigid)", "ignored": "joints ignored", "frozen": "frozen",
          "fmu": "harmonic lift of the FMU"}


def plot_linearization(made: Linearization, path: str | os.PathLike[str] | None = None, kind: str = "bode", *,
                       hertz: bool = True, decibel: bool = True) -> Any:
    """Draw a linearization.

    Parameters
    ----------
    made : Linearization
    path : path-like, optional
        ``.png``, ``.svg`` or ``.pdf``; without it the figure stays open.
    kind : str
        ``bode``, ``nyquist``, ``poles`` or ``waterfall`` (sidebands).
    hertz, decibel : bool
        Frequencies in Hz (else rad/s), magnitudes in dB (else absolute).

    Returns
    -------
    matplotlib.figure.Figure

    Raises
    ------
    InputError
        For another kind, or a file that cannot be written.
    """
    if kind not in KINDS:
        raise InputError(f"--plot-kind {kind}: choose one of {', '.join(KINDS)}")
    import matplotlib as mpl

    if path is not None:
        mpl.use("Agg")
    import matplotlib.pyplot as plt

    draw = {"bode": _bode, "nyquist": _nyquist, "poles": _poles, "waterfall": _waterfall}[kind]
    style: Any = {**STYLE, "lines.linewidth": 1.3}
    with mpl.rc_context(style):
        figure = draw(made, hertz, decibel)
        _caption(figure, made)
        if path is not None:
            with written_beside(Path(path)) as beside:
                figure.savefig(beside)
            plt.close(figure)
    return figure


def _bode(made: Linearization, hertz: bool, decibel: bool) -> Any:
    import control
    import matplotlib.pyplot as plt

    count = len(made.outputs)
    figure, axes = plt.subplots(2 * count, 1, sharex=True, figsize=(8.5, 1.6 + 3.0 * count), squeeze=False,
                                gridspec_kw={"height_ratios": [2.0, 1.2] * count})
    control.bode_plot(made.response.frd(), dB=decibel, Hz=hertz, deg=True, ax=axes, color=COLOURS[0], title="",
                      wrap_phase=True, show_legend=False, share_magnitude=False, share_phase=False)
    for axis in axes[::2, 0]:
        axis.lines[0].set_label(LABELS[made.method])
    factor = 1.0 if hertz else 2.0 * math.pi
    for j, output in enumerate(made.outputs):
        magnitude, phase = axes[2 * j, 0], axes[2 * j + 1, 0]
        unit = made.response.unit(output)
        magnitude.set_ylabel(f"{_words(output)}\n[{f'dB re {unit}' if decibel else unit}]")
        phase.set_ylabel("Phase [deg]")
        phase.set_ylim(-200.0, 200.0)
        phase.set_yticks((-180, -90, 0, 90, 180))
        phase.set_yticks((), minor=True)
        if made.measured is not None:
            good = ~made.measured.flagged
            x = factor * made.measured.frequencies[good]
            values = made.measured.line(output)[good]
            size = 20.0 * np.log10(np.abs(values)) if decibel else np.abs(values)
            style: dict[str, Any] = {"linestyle": "", "marker": "o", "markersize": 4.5, "markerfacecolor": "white",
                                     "markeredgecolor": COLOURS[1], "zorder": 5}
            magnitude.plot(x, size, label="measured at the FMU", **style)
            magnitude.set_title(f"measured within {made.differences[output]:.1e}", loc="right", fontsize=7.8,
                                color=COLOURS[1], pad=3.0)
            phase.plot(x, np.degrees(np.angle(values)), **style)
        _mark_lines(made, (magnitude, phase), factor)
        magnitude.legend(loc="best", frameon=False)
        if j > 0:
            magnitude.get_legend().remove()
    for text in list(figure.texts):
        text.remove()  # python-control's own row labels
    for axis in axes[:, 0]:
        axis.set_xlabel("")
        axis.set_title("", loc="center")
        axis.grid(True, which="both", linewidth=0.4, color="#e6e6e6")
        axis.tick_params(labelbottom=False)
    axes[-1, 0].tick_params(labelbottom=True)
    axes[-1, 0].set_xlabel(f"Frequency of {_words(made.input)} [{'Hz' if hertz else 'rad/s'}]")
    figure.align_ylabels(axes[:, 0])
    figure.tight_layout(rect=(0.0, 0.0, 1.0, 1.0 - 0.62 / figure.get_figheight()))
    return figure


def _mark_lines(made: Linearization, axes: tuple[Any, ...], factor: float) -> None:
    """Mark the frequencies at which a sideband falls on the input."""
    step = 0.5 * made.point.motion.fundamental / (2.0 * math.pi)
    last = made.response.frequencies.max()
    for i, k in enumerate(range(1, min(40, int(last / step)) + 1)):
        for j, axis in enumerate(axes):
            axis.axvline(factor * k * step, color="#b0b0b0", linewidth=0.7, linestyle=(0, (2, 3)), zorder=1,
                         label="sideband on the input's line" if i == 0 and j == 0 else None)


def _nyquist(made: Linearization, hertz: bool, decibel: bool) -> Any:
    import control
    import matplotlib.pyplot as plt

    count = len(made.outputs)
    figure, axes = plt.subplots(1, count, figsize=(4.6 * count + 0.6, 5.2), squeeze=False)
    data = made.response.frd()
    for axis, output in zip(axes[0], made.outputs, strict=True):
        control.nyquist_plot(data[control_name(output), control_name(made.input)], ax=np.array([[axis]]),
                             color=COLOURS[0], title="", unit_circle=False, warn_encirclements=False,
                             warn_nyquist=False, max_curve_magnitude=1e9)
        if made.measured is not None:
            values = made.measured.line(output)[~made.measured.flagged]
            axis.plot(values.real, values.imag, "o", markersize=4.5, markerfacecolor="white",
                      markeredgecolor=COLOURS[1], label="measured at the FMU")
        unit = made.response.unit(output)
        axis.set_title(f"{_words(output)} by {_words(made.input)}", fontsize=9)
        axis.set_xlabel(f"Real part [{unit}]")
        axis.set_ylabel(f"Imaginary part [{unit}]")
        if axis.get_legend() is not None:
            axis.get_legend().remove()
        values = made.response.line(output)[~made.response.flagged]
        for part, limit in ((values.real, axis.set_xlim), (values.imag, axis.set_ylim)):
            reach = 0.08 * max(float(np.ptp(part)), 1e-300)
            limit(float(part.min()) - reach, float(part.max()) + reach)
    figure.tight_layout(rect=(0.0, 0.0, 1.0, 1.0 - 0.62 / figure.get_figheight()))
    return figure


def _poles(made: Linearization, hertz: bool, decibel: bool) -> Any:
    import control
    import matplotlib.pyplot as plt

    figure, axes = plt.subplots(figsize=(7.2, 5.6))
    system = made.system[control_name(made.outputs[0]), control_name(made.input)]
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # that the axes exist already
        control.pole_zero_plot(system, ax=np.array([[axes]]), title="", color=COLOURS[0], marker_size=6)
    if axes.lines:
        axes.lines[0].set_label("poles (x) and zeros (o)")
    axes.plot(made.poles.real, made.poles.imag, "s", markersize=10, markerfacecolor="none",
              markeredgecolor=COLOURS[1], label="Floquet exponents" if made.harmonics else "poles")
    if made.harmonics:
        half = 0.5 * made.point.motion.fundamental
        axes.axhspan(-half, half, color=COLOURS[1], alpha=0.06, label="strip of the fundamental")
        axes.set_ylim(-5.5 * half, 5.5 * half)
        reach = max(1.0, float(np.abs(made.poles.real).max()))
        axes.set_xlim(-2.2 * reach, 0.8 * reach)
    axes.axvline(0.0, color="#8c8c8c", linewidth=0.7)
    axes.set_xlabel("Real part [1/s]")
    axes.set_ylabel("Imaginary part [rad/s]")
    axes.set_title(f"{_words(made.outputs[0])} by {_words(made.input)}", fontsize=9)
    axes.legend(loc="best", frameon=False)
    figure.tight_layout(rect=(0.0, 0.0, 1.0, 1.0 - 0.62 / figure.get_figheight()))
    return figure


def _waterfall(made: Linearization, hertz: bool, decibel: bool) -> Any:
    """Sidebands one behind the other: how large the line f + k F is over the frequency f of the input."""
    import matplotlib.pyplot as plt

    count = len(made.outputs)
    response = made.response
    lines = len(response.harmonics)
    figure, axes = plt.subplots(1, count, figsize=(1.2 + 5.4 * count, 1.6 + 0.75 * lines), squeeze=False)
    factor = 1.0 if hertz else 2.0 * math.pi
    good = np.flatnonzero(~response.flagged)
    order = good[np.argsort(response.frequencies[good], kind="stable")]
    x = factor * response.frequencies[order]
    for j, (axis, output) in enumerate(zip(axes[0], made.outputs, strict=True)):
        size = np.abs(response.values[order, :, j])
        top = float(size.max())
        # 60 dB or the largest value are as high as two steps between lines
        height = 2.0 * size / top
        if decibel:
            height = np.maximum(20.0 * np.log10(np.maximum(size / top, 1e-30)), -160.0) / 30.0
        floor = float(height.min()) if decibel else 0.0
        for i in range(lines - 1, -1, -1):
            k = response.harmonics[i]
            y = i + height[:, i] - floor
            colour = COLOURS[1] if k == 0 else COLOURS[0]
            axis.fill_between(x, i, y, color="white", alpha=0.85, zorder=2.0 * (lines - i))
            axis.fill_between(x, i, y, color=colour, alpha=0.16, linewidth=0.0, zorder=2.0 * (lines - i))
            axis.plot(x, y, color=colour, zorder=2.0 * (lines - i) + 1.0)
        names = ["f" if k == 0 else f"f {'+' if k > 0 else '-'} {abs(k)} F" for k in response.harmonics]
        axis.set_yticks(range(lines), names)
        axis.set_ylim(-0.1, None)
        axis.set_xlim(x.min(), x.max())
        axis.set_xlabel(f"Frequency f of {_words(made.input)} [{'Hz' if hertz else 'rad/s'}]")
        scale = "30 dB" if decibel else f"{0.5 * top:.3g} {response.unit(output)}"
        axis.set_title(f"{_words(output)} by {_words(made.input)}   (one step: {scale})", loc="left", fontsize=8.5)
    unit = "Hz" if hertz else "rad/s"
    axes[0, 0].set_ylabel(f"Line; F = {factor * response.fundamental:.5g} {unit}, the fundamental")
    figure.tight_layout(rect=(0.0, 0.0, 1.0, 1.0 - 0.62 / figure.get_figheight()))
    return figure


def _words(name: str) -> str:
    return name.replace(".", " ").replace("_", " ")


def _caption(figure: Any, made: Linearization) -> None:
    point = made.point
    one, two = (math.degrees(a) for a in point.motion.plant.joints())
    lift = f", {made.harmonics} harmonics" if made.harmonics else ""
    rpm = point.speed * 30.0 / math.pi
    text = (f"{LABELS[made.method]}{lift}   |   {rpm:.5g} rpm, joints {one:.4g} and {two:.4g} deg   |   mean torque "
            f"{point.mean_torque:.4g} N.m   |   {'stable' if point.stable else 'UNSTABLE'}, "
            f"growth rate {point.floquet.growth_rate:.3g} 1/s")
    height = figure.get_figheight()
    title = point.motion.plant.scenario.title or "Cardan driveline"
    figure.suptitle(title, x=0.012, y=1.0 - 0.08 / height, ha="left", va="top", fontsize=11.5, fontweight="bold",
                    color="#222222")
    figure.text(0.012, 1.0 - 0.36 / height, text, ha="left", va="top", fontsize=7.8, color="#666666")
