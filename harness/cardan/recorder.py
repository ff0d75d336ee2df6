"""Recording of a run: one row per communication point of the scene, in memory reserved before the run."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from cardan.coupling import Master
from cardan.errors import InputError


class Recorder:
    """Rows of the values that a master has at hand, and of the models' own signals.

    Parameters
    ----------
    master : Master
        After `Master.begin`.
    names : sequence of str
        FMU variables and signals of the models to keep.
    rows : int
        Communication points of the run.

    Attributes
    ----------
    count : int
        Rows recorded so far.
    units : dict of str to str
        Units of the columns, in the order of `names`; ``"1"`` where there is none.

    Raises
    ------
    InputError
        If the rows do not fit into memory.
    """

    def __init__(self, master: Master, names: Sequence[str], rows: int) -> None:
        self._master = master
        description = master.instance.description
        signals = master.surroundings.signals
        self.units = {name: (signals[name] if name in signals else description[name].unit) or "1" for name in names}
        self._signals = tuple(name for name in names if name in signals)
        known = (*master.outputs.names, *master.inputs.names, *self._signals)
        self._others = tuple(name for name in names if name not in known)  # counters and the like, one by one
        self._sent = any(name in master.inputs.names for name in names)
        self._fields = (*master.outputs.names, *(master.inputs.names if self._sent else ()), *self._others,
                        *self._signals)
        self._width = len(self._fields)
        try:
            # A view of lazily zeroed memory: takes whole rows faster than the array does.
            memory: Any = np.zeros(self._width * rows)
            self._store: Any = memoryview(memory)
        except (MemoryError, ValueError):
            size = 8e-9 * self._width * rows
            raise InputError(f"stop_time / communication_step = {rows - 1} steps need {size:.3g} GB for the record;"
                             " take a longer communication_step or fewer outputs") from None
        self.count = 0

    def record(self) -> None:
        """Keep the present point as the next row."""
        master, store = self._master, self._store
        at = self.count * self._width
        values = master.outputs.values
        end = at + len(values)
        store[at:end] = values
        if self._sent:
            at, end = end, end + len(master.inputs.values)
            store[at:end] = master.inputs.values
        for name in self._others:
            store[end] = float(master.instance.get(name))
            end += 1
        if self._signals:
            seen = master.surroundings.observe(master.time, master.shaft_in, master.shaft_out)
            for name in self._signals:
                store[end] = seen[name]
                end += 1
        self.count += 1

    def columns(self) -> dict[str, NDArray[np.float64]]:
        """Return the columns recorded so far by name, in the order of `units`."""
        table = np.frombuffer(self._store, dtype=float).reshape(-1, self._width)[: self.count]
        return {name: table[:, self._fields.index(name)].copy() for name in self.units}
