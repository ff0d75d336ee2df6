"""Runs over the shaft angle: the angle itself, the times of equal steps of it, and orders in windows of whole turns."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from cardan.errors import InputError
from cardan.result import Result

Array = NDArray[np.float64]

ANGLE = "input.angle"
SPEED = "input.speed"


@dataclass(frozen=True)
class Track:
    """Course of one order of one signal.

    Attributes
    ----------
    signal : str
    order : float
    speeds : ndarray, shape (W,)
        Mean input speed of each window, rad/s.
    times : ndarray, shape (W,)
        Middle of each window, s.
    amplitudes : ndarray, shape (W,)
    """

    signal: str
    order: float
    speeds: Array
    times: Array
    amplitudes: Array


def shaft_angle(run: Result) -> Array:
    """Return the input shaft angle over the run, rad, from its column or from the speed.

    Raises
    ------
    InputError
        If neither was recorded or the shaft does not keep turning forward.
    """
    if ANGLE in run.columns:
        angle = run[ANGLE]
    elif SPEED in run.columns:
        angle = spline(run.time, run[SPEED]).antiderivative()(run.time)
    else:
        raise InputError(f"the result has neither {ANGLE} nor {SPEED}: list one of them in [scene] outputs")
    if len(angle) < 8:
        raise InputError(f"the result has {len(angle)} points; orders need more")
    forward = np.diff(angle) > 0.0
    if not forward.all():
        # a start from rest: what comes before the shaft keeps turning is left out
        last = int(np.flatnonzero(~forward)[-1]) + 1
        if last > len(angle) // 2:
            raise InputError(f"the shaft stands still or turns back at t = {run.time[last]:.6g} s: orders need a shaft "
                             "that keeps turning forward")
        angle = angle.copy()
        angle[:last] = angle[last] - 1e-9 * np.arange(last, 0, -1)
    return np.asarray(angle)


def spline(x: Array, y: Array) -> Any:
    from scipy.interpolate import make_interp_spline

    return make_interp_spline(x, y, k=5)


def times_of(time: Array, angle: Array, grid: Array) -> Array:
    """Return the times at which the shaft passes the angles of a grid."""
    forward = spline(time, angle)
    speed = forward.derivative()
    times = np.interp(grid, angle, time)
    for _ in range(8):
        step = (forward(times) - grid) / np.maximum(speed(times), 1e-300)
        times = np.clip(times - step, time[0], time[-1])
        if float(np.abs(step).max()) < 1e-14 * float(time[-1]):
            break
    return np.asarray(times)


def follow(name: str, order: float, values: Array, times: Array, first: float, samples: int, turns: int,
           window: int) -> Track:
    """Follow one order: windows of whole turns, half overlapping, the trend taken out first."""
    half = order != round(order)
    length = window + (window % 2 if half else 0)
    length = min(length, turns)
    hop = max(1, length // 2)
    speeds, middles, amplitudes = [], [], []
    size = length * samples
    x = np.arange(size) / samples
    carrier = np.exp(-2j * math.pi * order * x) * 2.0 / size
    ramp = x - x.mean()
    for start in range(0, turns - length + 1, hop):
        part = slice(start * samples, start * samples + size)
        y = values[part]
        y = y - y.mean() - ramp * float(ramp @ y) / float(ramp @ ramp)
        amplitudes.append(abs(complex(carrier @ y)))
        step = times[part][-1] - times[part][0]
        speeds.append(2.0 * math.pi * (size - 1) / samples / step)
        middles.append(0.5 * (times[part][0] + times[part][-1]))
    return Track(name, order, np.array(speeds), np.array(middles), np.array(amplitudes))
