"""Frequency response measured at an FMU: small sines, odd part of runs with both signs, lock-in with least squares.

The runs start at the state that the linearization predicts, so that little is left to die away; what is left, motions
with the Floquet exponents, is fitted along with the lines at f + k F and told by them over a window of whole periods.
"""

from __future__ import annotations

import dataclasses
import math
import os
from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from cardan.analyses.closed_loop import ClosedLoop, Sine
from cardan.analyses.hill import lift, lift_to_tolerance
from cardan.analyses.plant import TWIST, W1, WY, P
from cardan.analyses.ranges import read_range
from cardan.analyses.response import Response, check_frequencies, flagged
from cardan.analyses.signals import output_units
from cardan.analyses.trigonometric import interpolate
from cardan.errors import CardanError

if TYPE_CHECKING:
    from cardan.analyses.linearization import Linearization

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]

DOTS = 12
STEPS = 48  # of a half turn, as long as they are this fine:
FINE = 0.12  # rad of the sine per step
FINER = 8  # times at most
SWING = 3e-4  # rad, or by the speed: size of the measured motion
TURNS_LEAST = 24.0  # half turns that a window has at least
WINDOW_MOST = 4.0  # s
RESIDUAL = 1e-4  # of a fit that may be trusted


class Unmeasurable(CardanError):
    """The FMU cannot be measured here; the text says why."""


def measured(scenario: Any, made: Linearization, measure: bool | str | Iterable[float],
             fmu: str | os.PathLike[str] | None, progress: Callable[[float], None] | None) -> Linearization:
    """Return a linearization with a measurement added.

    Parameters
    ----------
    scenario : Scenario
    made : Linearization
        Operating point and prediction.
    measure : bool or frequencies
        True for up to 12 of the frequencies, or frequencies in Hz.
    fmu : path-like, optional
    progress : callable, optional
        Called with the fraction done.

    Raises
    ------
    Unmeasurable
        At an unstable operating point.
    InputError
        For frequencies that cannot be measured.
    """
    from cardan.analyses.linearize import default_fmu, periodic_system

    point = made.point
    motion = point.motion
    plant = motion.plant
    if not point.stable:
        raise Unmeasurable(f"--measure: {point.warning}")
    halves = max(1, round(plant.period_angle / math.pi))
    h = motion.period / (STEPS * halves)
    asked = made.response.frequencies if isinstance(measure, bool) else read_range(measure, "Hz", "--measure-at")
    frequencies = check_frequencies(asked, 0.5 / h, f"the Nyquist frequency of the measurement (its step is {h:.3g} s)")
    fundamental = 1.0 / motion.period
    near = 2e-3
    flags = flagged(frequencies, fundamental, near)
    if measure is True and len(frequencies) > DOTS:
        good = np.flatnonzero(~flags)
        chosen = good[np.linspace(0, len(good) - 1, DOTS).round().astype(int)] if len(good) else np.arange(DOTS)
        frequencies, flags = frequencies[chosen], flags[chosen]
    place = plant.inputs.index(made.input)
    system, names = periodic_system(point, place, made.outputs)
    omega = 2.0 * math.pi * frequencies
    probe = omega[~flags]
    lifted = lift(system, 4) if not len(probe) else lift_to_tolerance(system, probe, 1e-7)[0]
    lines = (len(made.response.harmonics) - 1) // 2
    values = np.full((len(frequencies), 2 * lines + 1, len(made.outputs)), complex(math.nan, math.nan))
    columns = [list(output_units()).index(name) for name in made.outputs]
    warnings = list(made.warnings)
    with ClosedLoop(plant, default_fmu(fmu), motion.added) as loop:
        for i, f in enumerate(frequencies):
            if not flags[i]:
                times = min(FINER, math.ceil(float(omega[i]) * h / FINE))
                through = _direct(motion, STEPS * halves * times)
                found, residual = _one(loop, made, lifted, names, place, float(omega[i]), h / times, through, columns)
                middle = len(found) // 2
                values[i] = found[middle - lines:middle + lines + 1]
                if residual > RESIDUAL:
                    warnings.append(f"measured at {f:.6g} Hz: lines and decaying motions leave {residual:.1e} of the "
                                    "signal unexplained; the value is uncertain by as much")
            if progress is not None:
                progress((i + 1) / len(frequencies))
    response = Response(frequencies, made.input, made.outputs, made.units, tuple(range(-lines, lines + 1)), values,
                        fundamental, flags, "measured")
    differences = _differences(made, response, lifted, omega)
    return dataclasses.replace(made, measured=response, differences=differences, warnings=warnings)


def _direct(motion: Any, count: int) -> Array:
    """Direct effect of both torques on the outputs at the ends of the steps of a period."""
    return interpolate(motion.fields.d, np.arange(count) / count)


def _one(loop: ClosedLoop, made: Linearization, lifted: Any, names: tuple[str, ...], place: int, omega: float, h: float,
         through: Array, columns: list[int]) -> tuple[Complex, float]:
    """Measure one frequency; return the lines -K .. K of all outputs and the relative residual of the fit."""
    motion = made.point.motion
    k = len(motion.own[0])
    size = len(lifted.a)
    states = np.linalg.solve(1j * omega * np.eye(size) - lifted.a, lifted.b[:, 0])
    parts = states.reshape(2 * lifted.harmonics + 1, -1)
    move = parts.sum(axis=0).real
    reach = np.abs(parts).sum(axis=0)
    limits = np.array([1.0 if name in ("input.angle", "shaft.twist") else max(1.0, motion.speed) for name in names])
    amplitude = SWING / max(1e-300, float((reach / limits).max(initial=0.0)))
    if not len(names):
        amplitude = 1.0
    shift = np.zeros(4 + k)
    for j, name in enumerate(names):
        where = {"input.angle": P, "shaft.twist": TWIST, "input.speed": W1, "shaft.speed_b": WY}.get(name)
        shift[where if where is not None else 4 + j - (len(names) - k)] = move[j]
    start = np.concatenate([motion.states[0], motion.own[0]])
    count = _samples(omega, motion, h)
    runs = []
    for sign in (1.0, -1.0):
        begin = start + sign * amplitude * shift
        runs.append(loop.run(begin[:4], begin[4:], h, count, Sine(place, sign * amplitude, omega), through)[:, columns])
    odd = (runs[0] - runs[1]) / (2.0 * amplitude)
    bands = max(6, lifted.harmonics + 1)
    return lock_in(odd, h, omega, motion.fundamental, made.point.floquet.exponents, bands)


def _samples(omega: float, motion: Any, h: float) -> int:
    """Samples of a window: whole periods of the motion, long enough to tell neighbouring lines apart."""
    fundamental = motion.fundamental
    turns = 2.0 * omega / fundamental
    gap = abs(turns - round(turns)) * fundamental / 2.0 / (2.0 * math.pi)
    span = max(TURNS_LEAST * motion.period, 3.0 / max(gap, 1e-9), 4.0 * 2.0 * math.pi / omega)
    whole: int = math.ceil(min(span, max(WINDOW_MOST, 4.0 * 2.0 * math.pi / omega)) / motion.period)
    return round(whole * float(motion.period) / h)


def lock_in(signals: Array, h: float, omega: float, fundamental: float, exponents: Complex,
            bands: int) -> tuple[Complex, float]:
    """Fit lines and decaying motions to signals.

    Parameters
    ----------
    signals : ndarray, shape (M, p)
        At the times h, 2 h, ..
    h : float
        s.
    omega, fundamental : float
        Of excitation and motion, rad/s.
    exponents : ndarray of complex
        Floquet exponents, 1/s; closed under conjugation up to multiples of the fundamental.
    bands : int
        Lines omega + k fundamental are fitted for abs(k) <= bands.

    Returns
    -------
    lines : ndarray of complex, shape (2 bands + 1, p)
        Amplitudes Y_k: the signal has the part ``Re(Y_k e^(j (omega + k fundamental) t))``.
    residual : float
        Largest relative residual of a signal.
    """
    count = len(signals)
    t = h * np.arange(1, count + 1)
    k = np.arange(-bands, bands + 1)
    lines = np.exp(1j * np.outer(t, omega + k * fundamental))
    parts = [lines, lines.conj()]
    for exponent in exponents:
        decay = np.exp(exponent * t)
        parts.append(decay[:, None] * np.exp(1j * fundamental * np.outer(t, k)))
    basis = np.concatenate(parts, axis=1)
    found, *_ = np.linalg.lstsq(basis, signals.astype(complex), rcond=1e-13)
    left = np.linalg.norm(signals - (basis @ found).real, axis=0)
    size = np.linalg.norm(signals, axis=0)
    residual = float((left / np.where(size > 0.0, size, 1.0)).max(initial=0.0))
    return 2.0 * found[:len(k)], residual


def _differences(made: Linearization, response: Response, lifted: Any, omega: Array) -> dict[str, float]:
    """Largest relative difference of G_0 by output."""
    if made.response.label == "hill" or made.response.label == "fmu":
        model = lifted.response(omega)[:, lifted.harmonics, :, 0]
    else:
        s = 1j * omega
        model = np.array([np.asarray(made.system(x)).reshape(-1) for x in s])
    good = ~response.flagged
    found = {}
    for j, output in enumerate(made.outputs):
        there = response.line(output)[good]
        found[output] = float((np.abs(model[good, j] - there) / np.abs(there)).max(initial=0.0))
    return found
