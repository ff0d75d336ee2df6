"""A part of a scene behind FMI's functions: values by reference, order of calls, complete state.

The counterpart of ``cardan_kernel.Driveline`` for engine, load and driver; it has the same methods and keeps the same
rules: nothing is raised, a refusal is reported with the variable, its value and the allowed range, and leaves the
state as it was.
"""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from cardan.models.parameters import ParameterError

from .rebuild import decode, replace
from .roles import Bending, Moving, OnShaft, Role

DISCARD, ERROR = 2, 3


class Part:
    """One instance.

    Parameters
    ----------
    data : dict
        Content of ``part.json``: ``role``, ``variables``, and what the role needs.
    folder : Path
        Where its files are.
    report : callable, optional
        ``report(status, text)`` takes messages; status 2 discard, 3 error.

    Raises
    ------
    ParameterError
        If the data are no valid model.
    """

    def __init__(self, data: dict[str, Any], folder: Path,
                 report: Callable[[int, str], None] | None = None) -> None:
        self.data, self.folder = data, folder
        self.variables: list[dict[str, Any]] = data["variables"]
        self.index = {each["name"]: place for place, each in enumerate(self.variables)}
        self.last_error = ""
        self._report = report
        self._values: list[Any] = [each["start"] for each in self.variables]
        self._names = {kind: [each["name"] for each in self.variables if each["causality"] == kind]
                       for kind in ("parameter", "input", "output")}
        self._phase, self._time, self._step = "instantiated", 0.0, 0.0
        self._moving: Moving = ([], ())
        self._seen: dict[str, float] | None = None
        self._complaint = ""  # a mistake that makes the next step refused
        self._misfit = ""  # parameters that fit no model make all steps refused
        self._changed = False  # parameters were set since the model was made
        self._role: Role = self._make({})

    # ---- life cycle

    def setup_experiment(self, start_time: float, stop_time: Any = None, tolerance: Any = None) -> None:
        """Take the start time, s."""
        if self._expected("setup_experiment", "instantiated"):
            self._time, self._seen = start_time, None

    def enter_initialization_mode(self) -> None:
        """Begin the initialization."""
        if self._expected("enter_initialization_mode", "instantiated"):
            self._phase, self._seen = "initializing", None

    def exit_initialization_mode(self) -> None:
        """Start the states for the parameters and inputs that are set by now."""
        if not self._expected("exit_initialization_mode", "initializing"):
            return
        try:
            self._moving = self._start()
        except (ArithmeticError, ValueError) as error:
            self._misfit = f"the initial state cannot be computed: {error}"
            self._complain(ERROR, self._misfit)
        self._phase, self._seen = "stepping", None

    def do_step(self, t: float, h: float) -> bool:
        """Advance from t to t + h, s; False if that is refused, with the state as it was."""
        refusal = self._refusal(t, h)
        if refusal:
            return self._complain(DISCARD, refusal)
        inputs = self._inputs()
        before = self._moving
        try:
            settled = self._role.settle(t, self._step, before, inputs)
            moving = self._role.advance(t, h, settled, inputs)
        except (ArithmeticError, ValueError) as error:
            return self._complain(DISCARD, f"the step from {t!r} s by {h!r} s is refused: {error}")
        for name, value in zip(self._role.states, moving[0]):
            if not math.isfinite(value):
                return self._complain(DISCARD, f"the step from {t!r} s by {h!r} s is refused: {name} becomes {value!r}")
        self._moving, self._time, self._step, self._seen = moving, t + h, h, None
        return True

    def terminate(self) -> None:
        """End the run; values stay readable."""
        if self._expected("terminate", "stepping"):
            self._phase = "terminated"

    # ---- values

    def get_real(self, references: Sequence[int]) -> list[float]:
        """Return values of Real variables; NaN where something is wrong, which is reported."""
        return [float(self._get(place, "Real", math.nan)) for place in references]

    def get_integer(self, references: Sequence[int]) -> list[int]:
        """Return values of Integer variables."""
        return [int(self._get(place, "Integer", 0)) for place in references]

    def get_boolean(self, references: Sequence[int]) -> list[bool]:
        """Return values of Boolean variables."""
        return [bool(self._get(place, "Boolean", False)) for place in references]

    def set_real(self, references: Sequence[int], values: Sequence[float]) -> None:
        """Set Real variables."""
        for place, value in zip(references, values):
            self._set(place, "Real", value)

    def set_integer(self, references: Sequence[int], values: Sequence[int]) -> None:
        """Set Integer variables."""
        for place, value in zip(references, values):
            self._set(place, "Integer", value)

    def set_boolean(self, references: Sequence[int], values: Sequence[bool]) -> None:
        """Set Boolean variables."""
        for place, value in zip(references, values):
            self._set(place, "Boolean", bool(value))

    def get(self, name: str) -> Any:
        """Return a value by name."""
        place = self.index[name]
        return self._get(place, self.variables[place]["type"], math.nan)

    def set(self, name: str, value: Any) -> None:
        """Set a value by name."""
        place = self.index[name]
        self._set(place, self.variables[place]["type"], value)

    def next_sample(self, t: float) -> float:
        """Return the first time after t, s, at which a decision may be due (inf: never)."""
        return self._role.next_sample(t)

    # ---- state

    def get_state(self) -> bytes:
        """Return everything that moves or was set."""
        x, discrete = self._moving
        state = [self._phase, self._time, self._step, self._values, list(x), list(discrete), self._complaint]
        return json.dumps(state).encode()

    def set_state(self, state: bytes) -> None:
        """Go back to a state of `get_state`, of this or of another instance."""
        phase, time, step, values, x, discrete, complaint = json.loads(state.decode())
        parameters = [self.index[name] for name in self._names["parameter"]]
        self._changed = self._changed or any(values[place] != self._values[place] for place in parameters)
        self._phase, self._time, self._step, self._values, self._complaint = phase, time, step, values, complaint
        self._rebuild()
        self._moving, self._seen = (x, self._role.discrete(discrete)), None

    # ---- inside

    def _get(self, place: int, kind: str, otherwise: Any) -> Any:
        if not (0 <= place < len(self.variables) and self.variables[place]["type"] == kind):
            self._complain(ERROR, f"value reference {place} is no {kind} variable; there are 0 to "
                                  f"{len(self.variables) - 1}")
            return otherwise
        if self.variables[place]["causality"] != "output":
            return self._values[place]
        if self._seen is None:
            try:
                if self._phase in ("stepping", "terminated"):
                    inputs = self._inputs()
                    moving = self._role.settle(self._time, self._step, self._moving, inputs)
                    self._seen = self._role.outputs(self._time, self._step, moving, inputs)
                else:
                    moving = self._start()  # makes the model anew first, where parameters were set
                    self._seen = self._role.outputs(self._time, 0.0, moving, self._inputs())
            except (ArithmeticError, ValueError) as error:
                self._complain(ERROR, f"the outputs at {self._time!r} s cannot be computed: {error}")
                return otherwise
        return self._seen[self.variables[place]["name"]]

    def _set(self, place: int, kind: str, value: Any) -> None:
        if not (0 <= place < len(self.variables) and self.variables[place]["type"] == kind):
            self._note(f"value reference {place} is no {kind} variable; there are 0 to {len(self.variables) - 1}")
            return
        variable = self.variables[place]
        name = variable["name"]
        if variable["causality"] == "output":
            self._note(f"{name} is an output and cannot be set")
        elif variable["causality"] == "parameter" and self._phase in ("stepping", "terminated"):
            self._note(f"{name} is a fixed parameter and cannot be set to {value!r} after initialization; reset first")
        else:
            self._values[place], self._seen = value, None
            self._changed = self._changed or variable["causality"] == "parameter"

    def _rebuild(self) -> None:
        """Make the model anew if parameters were set; values that do not fit make all steps refused until they do."""
        if not self._changed:
            return
        self._changed, self._misfit = False, ""
        different = {name: self._values[self.index[name]] for name in self._names["parameter"]
                     if self._values[self.index[name]] != self.variables[self.index[name]]["start"]}
        try:
            self._role = self._make(different)
        except ParameterError as error:
            self._misfit = str(error)
            self._complain(ERROR, self._misfit)

    def _make(self, changed: dict[str, Any]) -> Role:
        data = self.data
        if data["role"] == "bending":
            return Bending(data["courses"])
        model = decode(replace(data["model"], data["places"], changed), self.folder)
        return OnShaft(model, data["role"], data["step"], data["pedals"])

    def _inputs(self) -> dict[str, float]:
        return {name: self._values[self.index[name]] for name in self._names["input"]}

    def _start(self) -> Moving:
        self._rebuild()
        return self._role.start(self._time, self._inputs())

    def _expected(self, call: str, phase: str) -> bool:
        if self._phase == phase:
            return True
        return self._complain(ERROR, f"{call} is refused while the instance is {self._phase}: it must be {phase}")

    def _refusal(self, t: float, h: float) -> str:
        """Why a step cannot be done; empty if it can."""
        if self._phase != "stepping":
            return f"a step is refused while the instance is {self._phase}; initialize it first"
        if self._misfit:
            return f"a step is refused: {self._misfit}"
        if self._complaint:
            complaint, self._complaint = self._complaint, ""
            return f"a step is refused: {complaint}"
        if not (math.isfinite(t) and math.isfinite(h) and h > 0.0):
            return f"a step from {t!r} s by {h!r} s is refused; its length must be above 0 s"
        for name in self._names["input"]:
            value = self._values[self.index[name]]
            if not math.isfinite(value):
                return f"{name} = {value!r} is not finite"
        return ""

    def _note(self, text: str) -> None:
        self._complaint = text
        self._complain(ERROR, text)

    def _complain(self, status: int, text: str) -> bool:
        self.last_error = text
        if self._report is not None:
            self._report(status, text)
        return False
