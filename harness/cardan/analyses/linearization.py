"""What a linearization gives: the model, its frequency response, its operating point."""

from __future__ import annotations

import math
import os
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from cardan.analyses.operating_point import OperatingPoint
from cardan.analyses.response import Response

Complex = NDArray[np.complex128]


@dataclass(frozen=True)
class Linearization:
    """A linearized driveline.

    Attributes
    ----------
    method : str
        ``hill``, ``averaged``, ``ignored``, ``frozen`` or ``fmu``.
    input : str
    outputs : tuple of str
    units : dict of str to str
    point : OperatingPoint
        What it is linearized about.
    system : control.StateSpace
        The model with named signals and its ``units``; of the periodic methods the harmonic lift in real coordinates
        (outputs ``name``, ``name_cos1``, ``name_sin1``, ..).
    poles : ndarray of complex
        Poles (of the lift those in the middle strip: the Floquet exponents), 1/s.
    response : Response
        At the frequencies that were asked for.
    harmonics : int
        Of the lift; 0 for a time-invariant model.
    truncation : float
        Relative change of G_0 that three more harmonics make; NaN where the number was given.
    warnings : list of str
    measured : Response or None
        What `measure` has found, at some of the frequencies.
    differences : dict of str to float
        Largest relative difference of measurement and model by output, flagged frequencies left out.
    """

    method: str
    input: str
    outputs: tuple[str, ...]
    units: dict[str, str]
    point: OperatingPoint
    system: Any
    poles: Complex
    response: Response
    harmonics: int = 0
    truncation: float = math.nan
    warnings: list[str] = field(default_factory=list)
    measured: Response | None = None
    differences: dict[str, float] = field(default_factory=dict)

    def save(self, path: str | os.PathLike[str]) -> list[str]:
        """Write the response as CSV, and a measurement beside it as ``NAME.measured.csv``; returns the files."""
        place = Path(path)
        self.response.save(place)
        files = [str(place)]
        if self.measured is not None:
            beside = place.with_name(f"{place.stem}.measured{place.suffix}")
            self.measured.save(beside)
            files.append(str(beside))
        return files

    def plot(self, path: str | os.PathLike[str] | None = None, kind: str = "bode", **options: Any) -> Any:
        """Draw it: ``bode``, ``nyquist``, ``poles`` or ``waterfall``; see `cardan.analyses.plots_response`."""
        from cardan.analyses.plots_response import plot_linearization

        return plot_linearization(self, path, kind, **options)

    def summary(self) -> dict[str, Any]:
        """Return all figures, ready for JSON."""
        return {
            "method": self.method, "input": self.input, "outputs": list(self.outputs), "units": self.units,
            "operating_point": self.point.summary(), "harmonics": self.harmonics,
            "truncation": self.truncation if math.isfinite(self.truncation) else None,
            "poles": [[float(p.real), float(p.imag)] for p in self.poles], "states": list(self.system.state_labels),
            "frequencies": len(self.response.frequencies),
            "flagged_hz": [float(f) for f in self.response.frequencies[self.response.flagged]],
            "measured_differences": self.differences, "warnings": self.warnings,
        }

    def __str__(self) -> str:
        lines = [f"{self.method}: {self.input} to {', '.join(self.outputs)}, {len(self.poles)} poles, "
                 f"{self.harmonics} harmonics, {len(self.response.frequencies)} frequencies", f"  {self.point}"]
        lines += [f"  measured: {name} within {value:.2e}" for name, value in self.differences.items()]
        return "\n".join(lines + [f"  warning: {text}" for text in self.warnings])
