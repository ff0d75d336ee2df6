"""Orders of the shaft speed in a run: spectra over the shaft angle, and their course over a run-up.

Signals are resampled at equal steps of the input shaft angle over whole turns, through splines of fifth degree in
time. An order is then exactly a line of the discrete Fourier transform: nothing leaks, whatever the speed does.
"""

from __future__ import annotations

import csv
import math
import os
from collections.abc import Iterable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from cardan.analyses.resampling import Track, follow, shaft_angle, spline, times_of
from cardan.errors import InputError
from cardan.result import Result

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]

HEADER = ("order", "signal", "unit", "amplitude", "phase_rad")
HIGHEST = 12.0
WINDOW = 4  # turns of a window of a run-up


@dataclass(frozen=True)
class OrderSpectrum:
    """Amplitudes by order.

    Attributes
    ----------
    orders : ndarray, shape (K,)
        Per turn of the input shaft: multiples of 0.5.
    lines : dict of str to ndarray of complex, shape (K,)
        By signal: ``amplitude e^(j phase)``, the signal having the part amplitude cos(order * angle + phase); order 0
        is the mean.
    units : dict of str to str
    turns : int
        Whole turns that went into it.
    speeds : tuple of float
        Lowest and highest input speed, rad/s.
    title : str
    tracks : list of Track
        Courses that were asked for.
    """

    orders: Array
    lines: dict[str, Complex]
    units: dict[str, str]
    turns: int
    speeds: tuple[float, float]
    title: str = ""
    tracks: list[Track] = field(default_factory=list)

    def amplitude(self, signal: str, order: float) -> float:
        """Return the amplitude of one order.

        Raises
        ------
        InputError
            If the signal or the order was not computed.
        """
        place = int(np.argmin(np.abs(self.orders - order)))
        if signal not in self.lines or abs(self.orders[place] - order) > 1e-9:
            raise InputError(f"no order {order:g} of {signal!r}: signals {', '.join(self.lines)}, orders 0 to "
                             f"{self.orders[-1]:g} in steps of 0.5")
        return float(abs(self.lines[signal][place]))

    def leading(self, signal: str, count: int = 5) -> list[tuple[float, float]]:
        """Return the largest orders above 0 with their amplitudes."""
        size = np.abs(self.lines[signal])
        places = np.argsort(-size[1:], kind="stable")[:count] + 1
        return [(float(self.orders[i]), float(size[i])) for i in places if size[i] > 0.0]

    def summary(self) -> dict[str, Any]:
        """Return all figures, ready for JSON."""
        return {
            "title": self.title, "turns": self.turns, "speed_low": self.speeds[0], "speed_high": self.speeds[1],
            "orders": [float(o) for o in self.orders],
            "signals": {name: {"unit": self.units[name], "mean": float(line[0].real),
                               "amplitudes": [float(v) for v in np.abs(line)],
                               "leading": [{"order": o, "amplitude": a} for o, a in self.leading(name)]}
                        for name, line in self.lines.items()},
            "tracks": [{"signal": t.signal, "order": t.order, "speeds": t.speeds.tolist(), "times": t.times.tolist(),
                        "amplitudes": t.amplitudes.tolist()} for t in self.tracks],
        }

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write a CSV file with the columns of ``HEADER``."""
        from cardan.storage import written_beside

        with written_beside(Path(path)) as beside, open(beside, "w", encoding="utf-8", newline="") as stream:
            writer = csv.writer(stream, lineterminator="\n")
            writer.writerow(HEADER)
            for name, line in self.lines.items():
                for order, value in zip(self.orders, line):
                    writer.writerow((repr(float(order)), name, self.units[name], repr(float(abs(value))),
                                     repr(float(np.angle(value)))))

    def plot(self, path: str | os.PathLike[str] | None = None) -> Any:
        """Draw spectra and courses."""
        from cardan.analyses.plots_orders import plot_orders

        return plot_orders(self, path)

    def __str__(self) -> str:
        rows = [f"{self.title or 'orders'}: {self.turns} turns"]
        for name, line in self.lines.items():
            leading = ", ".join(f"order {o:g}: {a:.4g}" for o, a in self.leading(name))
            rows.append(f"  {name} [{self.units[name] or '1'}]: mean {line[0].real:.6g}; {leading}")
        return "\n".join(rows)


def orders(result: Result | str | os.PathLike[str], signals: str | Iterable[str] | None = None, *,
           highest: float = HIGHEST, track: Iterable[float] | str = (), window: int = WINDOW) -> OrderSpectrum:
    """Compute the orders of a run.

    Parameters
    ----------
    result : Result or path
        With ``input.angle`` or ``input.speed`` among its columns.
    signals : str or iterable of str, optional
        Columns; all but angles and counters by default.
    highest : float
        Largest order.
    track : iterable of float or str
        Orders whose course over the run is wanted, ``"2,4"``.
    window : int
        Turns of a window of that course.

    Returns
    -------
    OrderSpectrum

    Raises
    ------
    InputError
        If there is no angle, less than two turns, a reversal, an unknown column, or too few points for an order.
    """
    run = result if isinstance(result, Result) else Result.load(result)
    names = _signals(run, signals)
    wanted = _orders(track)
    if not (math.isfinite(highest) and highest >= 0.5):
        raise InputError(f"--max-order {highest:g}: must be at least 0.5")
    if window < 1:
        raise InputError(f"--window {window}: must be at least one turn")
    angle = shaft_angle(run)
    turns = int((angle[-1] - angle[0]) / (2.0 * math.pi) * (1.0 + 1e-12))
    turns -= turns % 2  # half orders need an even number
    if turns < 2:
        raise InputError(f"the run has {(angle[-1] - angle[0]) / (2.0 * math.pi):.3g} turns; orders need at least two")
    per_turn = (len(run.time) - 1) * 2.0 * math.pi / (angle[-1] - angle[0])
    top = max([highest, *wanted])
    if per_turn < 4.0 * top:
        raise InputError(f"the run has {per_turn:.3g} points per turn, too few for order {top:g}: at least "
                         f"{4.0 * top:g} are needed (a shorter communication step, or a lower --max-order)")
    samples = 2 * int(2.0 ** math.ceil(math.log2(max(4.0 * top, per_turn))))
    first = angle[-1] - 2.0 * math.pi * turns  # the last turns: the start of a run is what dies away
    grid = first + 2.0 * math.pi * np.arange(turns * samples) / samples
    times = times_of(run.time, angle, grid)
    table = np.array([spline(run.time, run[name])(times) for name in names])
    count = round(2.0 * highest) + 1
    spectrum = np.fft.rfft(table, axis=1) / table.shape[1]
    lines = spectrum[:, ::turns // 2][:, :count] * np.where(np.arange(count) > 0, 2.0, 1.0)
    phase = np.exp(-1j * 0.5 * np.arange(count) * first)
    speed = np.diff(grid[::samples]) / np.diff(times[::samples]) if turns > 1 else np.array([0.0])
    tracks = [follow(name, order, values, times, first, samples, turns, window) for name, values in zip(names, table)
              for order in wanted]
    return OrderSpectrum(np.arange(count, dtype=float) / 2.0, {name: line * phase for name, line in zip(names, lines)},
                         {name: run.units[name] for name in names}, turns, (float(speed.min()), float(speed.max())),
                         run.info.title, tracks)


def _signals(run: Result, signals: str | Iterable[str] | None) -> list[str]:
    if signals is None:
        names = [name for name in run.columns if run.units[name] != "rad" or name == "shaft.twist"]
        return [name for name in names if not name.startswith(("solver.", "energy."))]
    wanted = signals.replace(" ", "").split(",") if isinstance(signals, str) else list(signals)
    problems = [f"--signal {name}: was not recorded; recorded are {', '.join(run.columns)}" for name in wanted
                if name not in run.columns]
    if problems or not wanted:
        raise InputError(problems or "--signal: none given")
    return wanted


def _orders(track: Iterable[float] | str) -> list[float]:
    try:
        found = [float(v) for v in (track.split(",") if isinstance(track, str) and track else track)]
    except ValueError:
        raise InputError(f"--track {track}: must be orders with commas, such as 2,4") from None
    problems = [f"--track {order:g}: orders are multiples of 0.5 above 0" for order in found
                if order <= 0.0 or 2.0 * order != round(2.0 * order)]
    if problems:
        raise InputError(problems)
    return found
