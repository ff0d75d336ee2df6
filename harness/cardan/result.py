"""What a run leaves behind: columns with units, and where they come from."""

from __future__ import annotations

import dataclasses
import math
import os
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.figure import Figure

Column = NDArray[np.float64]

# SI units that nobody reads off a chart, and what they become
FAMILIAR = {"rad/s": ("rpm", 30.0 / math.pi), "m/s": ("km/h", 3.6), "W": ("kW", 1e-3)}


@dataclass(frozen=True)
class RunInfo:
    """How a result was made.

    Attributes
    ----------
    title : str
        Title of the scene.
    scene : dict
        The scene as it was run, tables and keys of its file.
    completed : bool
        Whether the stop time was reached.
    message : str
        Why not, in the FMU's own words; empty for a complete run.
    note : str
        What the user should know of a complete run: another scheme than asked for, a coupling that makes energy.
    start_time, stop_time, reached_time, communication_step : float
        s.
    coupling : str
        Coupling scheme.
    steps : int
        Steps that the FMU has done.
    kernel : str
        Which kernel ran inside the FMU, with its version.
    wall_time, processor_time, loading_time : float
        Of the stepping loop, and before it, s.
    real_time_factor : float
        Simulated time per wall time of the stepping loop.
    energy_residual : float
        Power sent by the models minus power received by the FMU, summed, J: what coupling has cost.
    energy_supplied, energy_taken : float
        What the engine has delivered and the load has taken, J.
    fmu, versions : dict
        Identity of the FMU (file, sha256, guid, version) and versions of the software.
    """

    title: str = ""
    scene: dict[str, Any] = field(default_factory=dict)
    completed: bool = True
    message: str = ""
    note: str = ""
    start_time: float = 0.0
    stop_time: float = 0.0
    reached_time: float = 0.0
    communication_step: float = math.nan
    coupling: str = ""
    steps: int = 0
    kernel: str = ""
    wall_time: float = math.nan
    processor_time: float = math.nan
    loading_time: float = math.nan
    real_time_factor: float = math.nan
    energy_residual: float = math.nan
    energy_supplied: float = math.nan
    energy_taken: float = math.nan
    fmu: dict[str, str] = field(default_factory=dict)
    versions: dict[str, str] = field(default_factory=dict)

    @classmethod
    def from_dict(cls, values: dict[str, Any]) -> RunInfo:
        """Make it from stored values; what another version stored and this one does not know is left out."""
        known = {entry.name for entry in dataclasses.fields(cls)}
        # JSON has no NaN: what could not be stored is None
        kept: dict[str, Any] = {name: math.nan if value is None else value
                                for name, value in values.items() if name in known}
        return cls(**kept)


@dataclass(frozen=True, eq=False)
class Result:
    """Recorded columns over time.

    Attributes
    ----------
    time : ndarray, shape (n,)
        Communication points, s.
    columns : dict of str to ndarray, shape (n,)
        By name of the FMU variable or model signal, in SI units.
    units : dict of str to str
        Units of the columns; ``"1"`` for plain numbers.
    info : RunInfo
        How it was made.
    display : dict of str to (str, float)
        Preferred unit for people and the factor to it, for columns that have one; see `shown`.
    """

    time: Column
    columns: dict[str, Column]
    units: dict[str, str]
    info: RunInfo = field(default_factory=RunInfo)
    display: dict[str, tuple[str, float]] = field(default_factory=dict)

    def __getitem__(self, name: str) -> Column:
        """Return a column by name.

        Raises
        ------
        KeyError
            If it was not recorded; the message lists what was.
        """
        if name == "time":
            return self.time
        try:
            return self.columns[name]
        except KeyError:
            raise KeyError(f"{name!r} was not recorded; recorded are {', '.join(self.columns)}") from None

    def __len__(self) -> int:
        return len(self.time)

    def header(self, name: str) -> str:
        """Return the heading of a column, name with unit: ``output.speed [rad/s]``."""
        return f"{name} [{'s' if name == 'time' else self.units[name]}]"

    def shown(self, name: str) -> tuple[str, float]:
        """Return the unit that people read a column in, and the factor to it from the column's own."""
        return self.display.get(name) or FAMILIAR.get(self.units[name], (self.units[name], 1.0))

    def figures(self) -> dict[str, dict[str, Any]]:
        """Return unit, minimum, maximum, mean over time and final value of each column, SI."""
        found = {}
        for name, values in self.columns.items():
            found[name] = {"unit": self.units[name], "min": float(values.min()), "max": float(values.max()),
                           "mean": _mean(self.time, values), "final": float(values[-1])}
        return found

    def summary(self) -> dict[str, Any]:
        """Return all that is worth a line about the run, ready for JSON (not finite numbers are None)."""
        known = dataclasses.asdict(self.info)
        del known["scene"]
        summary: dict[str, Any] = jsonable({**known, "points": len(self), "figures": self.figures()})
        return summary

    def to_pandas(self, units: bool = False) -> pd.DataFrame:
        """Return a data frame over the time in s.

        Parameters
        ----------
        units : bool
            Whether the columns' names carry their units, as in CSV files; units are in ``attrs["units"]`` anyway.
        """
        import pandas as pd

        frame = pd.DataFrame({self.header(name) if units else name: values for name, values in self.columns.items()},
                             index=pd.Index(self.time, name="time [s]" if units else "time"))
        frame.attrs["units"] = {"time": "s", **self.units}
        return frame

    def plot(self, path: str | os.PathLike[str] | None = None) -> Figure:
        """Return a figure with one panel per unit, and save it if a path is given."""
        from cardan.plots import plot_result

        return plot_result(self, path)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write ``.csv`` (with ``.meta.json`` beside it), ``.parquet`` or ``.nc``; see `cardan.storage.save`."""
        from cardan.storage import save

        save(self, path)

    @classmethod
    def load(cls, path: str | os.PathLike[str]) -> Result:
        """Read what `save` has written."""
        from cardan.storage import load

        return load(path)

    def __str__(self) -> str:
        info = self.info
        end = "complete" if info.completed else f"ended at {info.reached_time:g} s: {info.message}"
        lines = [f"{info.title or 'result'}: {len(self)} points to {info.reached_time:g} s, {end}",
                 f"  {info.coupling}, step {info.communication_step:g} s, {info.kernel} kernel, "
                 f"real-time factor {info.real_time_factor:.3g}, energy residual {info.energy_residual:.3g} J"]
        lines += [f"  note: {info.note}"] if info.note else []
        lines += [f"  {self.header(name)}: {values.min():.6g} .. {values.max():.6g}, final {values[-1]:.6g}"
                  for name, values in self.columns.items()]
        return "\n".join(lines)


def _mean(time: Column, values: Column) -> float:
    span = float(time[-1] - time[0])
    return float(np.trapezoid(values, time)) / span if span > 0.0 else float(values[0])


def jsonable(value: Any) -> Any:
    """Return a copy that JSON can hold: numbers that are not finite become None."""
    if isinstance(value, dict):
        return {str(key): jsonable(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [jsonable(item) for item in value]
    if isinstance(value, float):
        return value if math.isfinite(value) else None
    return value if value is None or isinstance(value, (bool, int, str)) else str(value)
