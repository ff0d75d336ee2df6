"""Frequency responses with their sidebands, and their files."""

from __future__ import annotations

import csv
import math
import os
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from cardan.analyses.signals import control_name
from cardan.errors import InputError

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
Flags = NDArray[np.bool_]

HEADER = ("frequency_hz", "output", "harmonic", "real", "imag", "flagged")
NEAR = 1e-6  # of the fundamental: as near as this a line cannot be told from the input's own


@dataclass(frozen=True)
class Response:
    """Response of outputs to one input.

    Attributes
    ----------
    frequencies : ndarray, shape (F,)
        Hz.
    input : str
    outputs : tuple of str
    units : dict of str to str
        Units of input and outputs.
    harmonics : tuple of int
        Lines: k stands for the frequency of the input plus k times the fundamental of the motion.
    values : ndarray of complex, shape (F, len(harmonics), len(outputs))
        Output by input; harmonic 0 is G_0.
    fundamental : float
        Of the motion, Hz; 0 for a time-invariant model.
    flagged : ndarray of bool, shape (F,)
        Frequencies at which a sideband falls on the input's own line, so that the response depends on phase.
    label : str
        How it was made.
    """

    frequencies: Array
    input: str
    outputs: tuple[str, ...]
    units: dict[str, str]
    harmonics: tuple[int, ...]
    values: Complex
    fundamental: float
    flagged: Flags
    label: str

    def line(self, output: str, harmonic: int = 0) -> Complex:
        """Return one output at one line over the frequencies.

        Raises
        ------
        InputError
            If there is none such.
        """
        if output not in self.outputs or harmonic not in self.harmonics:
            raise InputError(f"no line {harmonic} of {output!r}; outputs: {', '.join(self.outputs)}; lines "
                             f"{self.harmonics[0]} to {self.harmonics[-1]}")
        column: Complex = self.values[:, self.harmonics.index(harmonic), self.outputs.index(output)]
        return column

    def frd(self, harmonic: int = 0) -> Any:
        """Return one line of all outputs as python-control's FrequencyResponseData, flagged frequencies left out."""
        import control

        good = ~self.flagged
        order = np.argsort(self.frequencies[good], kind="stable")
        data = self.values[good, self.harmonics.index(harmonic)][order].T[:, None, :]
        name = self.label if harmonic == 0 else f"{self.label}, line {harmonic:+d}"
        made = control.frd(data, 2.0 * math.pi * self.frequencies[good][order], inputs=[control_name(self.input)],
                           outputs=[control_name(n) for n in self.outputs], name=name)
        made.units = {control_name(n): u for n, u in self.units.items()}
        return made

    def unit(self, output: str) -> str:
        """Return the unit of an output by the input's."""
        return f"({self.units[output]})/({self.units[self.input]})"

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write a CSV file with the columns of ``HEADER``; what is flagged has no values (nan).

        Raises
        ------
        InputError
            If the file cannot be written.
        """
        from cardan.storage import written_beside

        with written_beside(Path(path)) as beside, open(beside, "w", encoding="utf-8", newline="") as stream:
            writer = csv.writer(stream, lineterminator="\n")
            writer.writerow(HEADER)
            for i, frequency in enumerate(self.frequencies):
                flag = int(self.flagged[i])
                for j, output in enumerate(self.outputs):
                    for k, harmonic in enumerate(self.harmonics):
                        value = complex(math.nan, math.nan) if flag else self.values[i, k, j]
                        writer.writerow((repr(float(frequency)), output, harmonic, repr(float(value.real)),
                                         repr(float(value.imag)), flag))


def flagged(frequencies: Array, fundamental: float, near: float = NEAR) -> Flags:
    """Return where a sideband falls on the input's line: f + k F = -f, multiples of half the fundamental F.

    With joints alone F is twice the shaft speed. Odd multiples of the shaft speed depend on the phase of the input;
    at even ones the input drives the phase of the motion itself as well.

    Parameters
    ----------
    frequencies : ndarray
        Hz.
    fundamental : float
        Hz; 0 flags nothing.
    near : float
        Distance that counts as on it, by the fundamental.
    """
    if fundamental <= 0.0:
        return np.zeros(len(frequencies), dtype=bool)
    turns = 2.0 * frequencies / fundamental
    return np.asarray(np.abs(turns - np.round(turns)) <= 2.0 * near)


def check_frequencies(frequencies: Array, highest: float = math.inf, why: str = "") -> Array:
    """Return frequencies (Hz) that can be used.

    Raises
    ------
    InputError
        For zero or negative ones, and those from `highest` on (named by `why`).
    """
    problems = []
    low = frequencies[~(frequencies > 0.0)]
    if len(low):
        problems.append(f"--frequencies: {low[0]:g} Hz is no frequency of a sine: all must be above 0")
    high = frequencies[frequencies >= highest]
    if len(high):
        problems.append(f"--frequencies: {high[0]:g} Hz is at or beyond {highest:g} Hz, {why}")
    if not len(frequencies):
        problems.append("--frequencies: none given")
    if problems:
        raise InputError(problems)
    return frequencies
