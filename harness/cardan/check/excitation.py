"""What moves the inputs: slow waves of the usual size, the same at every run."""

from __future__ import annotations

import math
from typing import Any

from cardan.check.quantities import Value, limits, nominal, start
from cardan.check.subject import Subject

PERIOD = 20  # communication steps of the slowest wave


class Excitation:
    """Smooth signals for the continuous Real inputs; all other inputs keep their start values.

    A signal is start + nominal * (0.5 + 0.4 sin(...)), kept inside the limits, so that it has the size that
    the model description calls usual and is never at rest.

    Parameters
    ----------
    subject : Subject
        The FMU; where its options say that it takes no moving inputs, there are no signals.
    period : float, optional
        Period of the slowest signal, s; by default 20 communication steps.
    phase : float
        Shifts all signals, rad: another excitation for another instance.

    Attributes
    ----------
    variables : list
        What is moved.
    """

    def __init__(self, subject: Subject, period: float | None = None, phase: float = 0.0) -> None:
        inputs = [each for each in subject.having("input", kinds=("Real",)) if each.variability == "continuous"]
        self.variables: list[Any] = inputs if subject.options.exciting else []
        self._begin = subject.experiment.start
        self._period = PERIOD * subject.experiment.step if period is None else period
        self._phase = phase

    def at(self, time: float) -> dict[Any, Value]:
        """Return the values of the moved inputs at a time (s)."""
        turn = 2.0 * math.pi * (time - self._begin) / self._period
        return {variable: self._value(variable, turn * (1.0 + 0.37 * place) + 1.3 * place + self._phase)
                for place, variable in enumerate(self.variables)}

    def held(self, time: float) -> dict[Any, Value]:
        """Return the values at the start, whatever the time: inputs at rest."""
        return self.at(self._begin)

    @staticmethod
    def _value(variable: Any, angle: float) -> float:
        low, high = limits(variable)
        first = start(variable)
        base = first if isinstance(first, float) and math.isfinite(first) else 0.0
        size = nominal(variable)
        if math.isfinite(low) and math.isfinite(high):
            size = min(size, 0.8 * (high - low))
        value = base + size * (0.5 + 0.4 * math.sin(angle))
        if value > high:  # a start value at the upper limit: wave downwards
            value = base - size * (0.5 + 0.4 * math.sin(angle))
        return min(max(value, low), high)
