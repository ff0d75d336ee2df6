"""A foreign FMU on its way: its time, its instance, and the states it can be brought back to."""

from __future__ import annotations

import weakref
from collections.abc import Mapping
from pathlib import Path
from typing import NamedTuple

from cardan.errors import FmuError
from cardan.instance import Instance, State
from cardan.plan import Plan

KEPT = 4  # states; a coupling that repeats a step goes back by one
NEAR = 1e-12  # s per s of time: closer times are the same

# Instances whose run nobody holds any more. They are closed before the next one is made: the garbage collector could
# find them in the middle of that, when no library may be unloaded.
_FORGOTTEN: list[Instance] = []


class Saved(NamedTuple):
    """A state at a time, s, with the inputs that it is left with."""

    time: float
    state: State


class ForeignRun:
    """One run of a foreign FMU.

    Parameters
    ----------
    path : Path
        The FMU.
    settings : mapping
        Start values by name, in its own units.
    time : float
        Start of the run, s.
    inputs : mapping
        Inputs at the start, in its own units.
    keeps : bool
        Whether states are saved on the way.

    Attributes
    ----------
    time : float
        Where it is, s.

    Raises
    ------
    CardanError
        If the FMU cannot be loaded or does not take its start values.
    """

    def __init__(self, path: Path, settings: Mapping[str, float | int | bool | str], time: float,
                 inputs: Mapping[str, float], keeps: bool) -> None:
        self.time = time
        self._keeps, self._saved = keeps, list[Saved]()
        while _FORGOTTEN:
            _FORGOTTEN.pop().close()
        self._instance = Instance(path, path.stem)
        self._forget = weakref.finalize(self, _FORGOTTEN.append, self._instance)
        self._plans: dict[tuple[str, ...], Plan] = {}
        try:
            for name, value in settings.items():
                self._instance.set(name, value)
            self.send(inputs)
            self._instance.setup(time)
            self.send(inputs)
            self._instance.initialize()
        except BaseException:
            self.close()
            raise

    def close(self) -> None:
        """Free the FMU. May be called again."""
        self._forget.detach()
        self._saved.clear()
        self._instance.close()

    def send(self, inputs: Mapping[str, float]) -> None:
        """Set inputs."""
        plan = self._plan(tuple(inputs))
        for place, value in enumerate(inputs.values()):
            plan.values[place] = value
        plan.write()

    def read(self, names: tuple[str, ...]) -> list[float]:
        """Return values of outputs."""
        return list(self._plan(names).read())

    def _plan(self, names: tuple[str, ...]) -> Plan:
        if names not in self._plans:
            self._plans[names] = self._instance.plan(names)
        return self._plans[names]

    def go(self, t: float) -> None:
        """Bring the FMU to time t, s: by a step with the inputs that it has, or from a saved state.

        Raises
        ------
        StepRefused
            If it does not do the step.
        FmuError
            If t is before all states that it can be brought back to.
        """
        near = NEAR * max(1.0, abs(t))
        if t < self.time - near:
            self._back(t + near)
        if t > self.time + near:
            if self._keeps:
                self._saved.append(Saved(self.time, self._instance.get_state()))
                if len(self._saved) > KEPT:
                    self._instance.free_state(self._saved.pop(0).state)
            self._instance.step(self.time, t - self.time)
            self.time = t

    def _back(self, latest: float) -> None:
        name = self._instance.description.path.name
        if not self._keeps:
            raise FmuError(f"{name} cannot go back in time (it does not save and restore its state);"
                           " coupling = 'held' or 'gauss-seidel' needs no way back")
        while self._saved:
            time, state = self._saved.pop()
            if time <= latest:
                self._instance.set_state(state)
                self._instance.free_state(state)
                self.time = time
                return
            self._instance.free_state(state)
        raise FmuError(f"{name} keeps the last {KEPT} states, and all of them are after t = {latest:.6g} s")
