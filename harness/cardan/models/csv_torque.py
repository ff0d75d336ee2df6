"""A measured torque over time from a CSV file, for either end."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import ClassVar

from cardan.models.base import INFINITY, Bus, Model, Shaft, State, Torque
from cardan.models.curve import Curve
from cardan.models.parameters import choice, file, quantity, words
from cardan.models.series import read_columns


@dataclass(frozen=True, eq=False)
class CsvTorque(Model):
    """T(t) = factor * column, constant before the first and after the last row.

    ``pchip`` (default) is a monotone cubic with continuous slope; ``linear`` joins the rows by straight lines whose
    corners are events.
    """

    kind: ClassVar[str] = "csv"
    file: Path = file("CSV file with a header line")
    column: str = words("name of the torque column, N.m unless its heading has a unit: T [kN.m]")
    time_column: str = words("name of the time column, s unless its heading has a unit; the first if empty", "")
    interpolation: str = choice(("pchip", "linear"), "between the rows", "pchip")
    factor: float = quantity("1", "factor on the column, to N.m", 1.0)
    _curve: Curve = field(init=False, repr=False)

    def prepare(self) -> None:
        times, values = read_columns(self.file, self.time_column, self.column, "N.m")
        self.put(_curve=Curve(times, [self.factor * v for v in values], self.interpolation == "pchip"))

    def torque(self, t: float, x: State, shaft: Shaft, bus: Bus) -> Torque:
        value, slope = self._curve(t)
        return Torque(value, slope, 0.0)

    def next_event(self, t: float) -> float:
        return self._curve.next_corner(t) if self._curve.corners else INFINITY
