"""Values of a driveline by value reference: who may set what, and outputs computed when they are asked for."""

from math import isfinite, nan
from typing import Callable, List, Optional

from .memory import (
    FRESH_LAYOUT,
    FRESH_LOADS,
    FRESH_MOTION,
    INSTANTIATED,
    LAYOUT,
    MARK,
    MODE,
    RUNNING,
    STEPS,
    TERMINATED,
    TWIST,
    UNCHECKED,
    VARS,
    WORK,
)
from .places import STIFFNESS
from .stepper import Stepper
from .variables import INDEX, VARIABLES

VARIABLE_COUNT = len(VARIABLES)
FIRST_INPUT = INDEX["input.torque"]
FIRST_OUTPUT = INDEX["input.angle"]
FIRST_LOAD_OUTPUT = INDEX["joint1.torque_in"]
FIRST_LAYOUT_OUTPUT = INDEX["layout.nonuniformity"]
FIRST_COUNTER = INDEX["solver.steps"]

# What a variable is, by value reference: type and who may set it.
FIXED = 1
TUNABLE = 2
INPUT = 3
OUTPUT = 4
REAL = 10
INTEGER = 20
BOOLEAN = 30

WARNING = 1
ERROR = 3


def _kind(variable):
    kind = {"Real": REAL, "Integer": INTEGER, "Boolean": BOOLEAN}[variable.type]
    if variable.causality == "output":
        return kind + OUTPUT
    if variable.causality == "input":
        return kind + INPUT
    return kind + (TUNABLE if variable.variability == "tunable" else FIXED)


class Values:
    """Variables of a driveline, its refusals and the stepper behind them.

    Parameters
    ----------
    log : callable, optional
        Called as ``log(status, text)`` with the FMI 2.0 status 1 (warning) or 3 (error).

    Attributes
    ----------
    last_error : str
        Text of the last refusal.
    """

    def __init__(self, log: Optional[Callable[[int, str], None]] = None) -> None:
        self.log = log
        self.last_error = ""
        self.pending = ""
        self.stale = True
        self.stepper = Stepper()
        self.z = self.stepper.store
        self.kinds = [0] * 128
        for reference in range(VARIABLE_COUNT):
            variable = VARIABLES[reference]
            self.kinds[reference] = _kind(variable)
            self.z[VARS + reference] = float(variable.start or 0.0)
        self.z[MODE] = INSTANTIATED
        self.z[MARK] = LAYOUT
        self.z[UNCHECKED] = 1.0

    def refuse(self, text: str) -> bool:
        """Tell why something is refused; returns False."""
        self.last_error = text
        if self.log is not None:
            self.log(ERROR, text)
        return False

    def misuse(self, text):
        """A call that is not allowed changes nothing; the next step is refused with its text."""
        self.refuse(text)
        self.pending = text

    def set_values(self, kind, references, values):
        """Set variables of one type (``REAL``, ``INTEGER``, ``BOOLEAN``) by value reference."""
        z = self.z
        for place in range(len(references)):
            reference = references[place]
            value = values[place]
            if not 0 <= reference < VARIABLE_COUNT:
                self.misuse(f"value reference {reference} is unknown: they go from 0 to {VARIABLE_COUNT - 1}")
                continue
            access = self.kinds[reference] - kind
            if access == INPUT:
                z[VARS + reference] = value
                if z[MODE] != RUNNING:
                    self.stepper.forget_outputs()
            elif 0 < access < OUTPUT:
                self.set_parameter(reference, value, access)
            else:
                self.misuse(self.not_settable(reference, kind))

    def set_parameter(self, reference, value, access):
        """Set a parameter; a fixed one only before the run."""
        z = self.z
        if z[MODE] == RUNNING or z[MODE] == TERMINATED:
            if access == FIXED:
                self.misuse(f"{VARIABLES[reference].name} is a fixed parameter and cannot be set after initialization: "
                            f"reset the instance to change it")
                return
            if VARS + reference == STIFFNESS and isfinite(value) and isfinite(z[STIFFNESS]):
                # Whoever changes the spring does work on it.
                z[WORK] += 0.5 * (value - z[STIFFNESS]) * z[TWIST] * z[TWIST]
        else:
            self.stepper.forget_outputs()
        z[VARS + reference] = value
        z[UNCHECKED] = 1.0
        self.stale = True

    def not_settable(self, reference, kind):
        """Why a variable cannot be set by a call of this type, in words."""
        variable = VARIABLES[reference]
        if variable.causality == "output":
            return f"{variable.name} is an output and cannot be set"
        return f"{variable.name} is of type {variable.type} and cannot be set by a call for another type"

    def value(self, reference: int, kind: int) -> float:
        """Value of a variable as a float, computed now if it has to be; NaN where there is none."""
        z = self.z
        if not 0 <= reference < VARIABLE_COUNT:
            self.misuse(f"value reference {reference} is unknown: they go from 0 to {VARIABLE_COUNT - 1}")
            return nan
        if not kind < self.kinds[reference] < kind + 10:
            self.misuse(f"{VARIABLES[reference].name} is of type {VARIABLES[reference].type}: ask for it by that type")
            return nan
        if reference < FIRST_OUTPUT:
            return z[VARS + reference]
        if reference >= FIRST_COUNTER:
            return z[STEPS + reference - FIRST_COUNTER]
        if reference < FIRST_LOAD_OUTPUT:
            if z[FRESH_MOTION] == 0.0:
                self.compute(FRESH_MOTION)
        elif reference < FIRST_LAYOUT_OUTPUT:
            if z[FRESH_LOADS] == 0.0:
                self.compute(FRESH_LOADS)
        elif z[FRESH_LAYOUT] == 0.0:
            self.compute(FRESH_LAYOUT)
        return z[VARS + reference]

    def compute(self, group):
        """Bring a group of outputs up to date; before the run they follow every value that is set."""
        try:
            if self.z[MODE] < RUNNING:
                self.stepper.start()
                self.stale = True
            elif self.stale:
                self.stepper.configure()
                self.stale = False
            self.stepper.refresh(group)
        except (ValueError, OverflowError, ZeroDivisionError):
            for reference in range(FIRST_OUTPUT, FIRST_COUNTER):
                self.z[VARS + reference] = nan

    def number(self, reference):
        """Value of a variable as it stands in memory."""
        return self.z[VARS + reference]

    def get_real(self, references: List[int]) -> List[float]:
        """Values of Real variables by value reference."""
        return [self.value(reference, REAL) for reference in references]

    def get_integer(self, references: List[int]) -> List[int]:
        """Values of Integer variables by value reference."""
        values = [self.value(reference, INTEGER) for reference in references]
        return [int(value) if isfinite(value) else 0 for value in values]

    def get_boolean(self, references: List[int]) -> List[bool]:
        """Values of Boolean variables by value reference."""
        return [self.value(reference, BOOLEAN) == 1.0 for reference in references]

    def set_real(self, references: List[int], values: List[float]) -> None:
        """Set Real variables by value reference."""
        self.set_values(REAL, references, values)

    def set_integer(self, references: List[int], values: List[int]) -> None:
        """Set Integer variables by value reference."""
        self.set_values(INTEGER, references, values)

    def set_boolean(self, references: List[int], values: List[bool]) -> None:
        """Set Boolean variables by value reference."""
        self.set_values(BOOLEAN, references, [1.0 if value else 0.0 for value in values])

    def get(self, name: str) -> float:
        """Value of the variable `name`."""
        reference = INDEX[name]
        return self.value(reference, self.kinds[reference] // 10 * 10)

    def set(self, name: str, value: float) -> None:
        """Set the variable `name`."""
        reference = INDEX[name]
        self.set_values(self.kinds[reference] // 10 * 10, [reference], [float(value)])
