"""The good FMU of the tests here: T dy/dt = gain u - y, by another author's rules but without a fault.

It travels in an FMU as it stands; the tests spoil single lines of it.
"""

import json
import math

from pythonfmu import Fmi2Slave
from pythonfmu.enums import Fmi2Status
from pythonfmu.logmsg import LogMsg

NAMES = ("u", "gain", "lag", "start", "y", "steps", "doubled", "label")
REALS, INTEGERS, BOOLEANS, STRINGS = (0, 1, 2, 3, 4), (5,), (6,), (7,)
FIXED, OUTPUTS = (2, 3, 7), (4, 5)
NEW, INITIALIZING, RUNNING, ENDED = range(4)


class Lag(Fmi2Slave):
    """First-order lag."""

    def __init__(self, **kwargs):
        super().__init__(**kwargs)
        self.values = [0.0, 2.0, 0.05, 1.0, 1.0, 0, False, "none"]
        self.mode, self.tolerance = NEW, 1e-6

    def refuse(self, text):
        self.log_queue.append(LogMsg(Fmi2Status.error, "logStatusError", text))
        return False

    def enter(self, wanted, mode, what):
        if self.mode not in wanted:
            self.refuse(f"{what} is refused in mode {self.mode}")
        else:
            self.mode = mode

    def setup_experiment(self, start_time, stop_time, tolerance):
        self.enter((NEW,), NEW, "setup_experiment")
        self.tolerance = tolerance or 1e-6

    def enter_initialization_mode(self):
        self.enter((NEW,), INITIALIZING, "enter_initialization_mode")

    def exit_initialization_mode(self):
        self.enter((INITIALIZING,), RUNNING, "exit_initialization_mode")

    def terminate(self):
        self.enter((RUNNING,), ENDED, "terminate")

    def do_step(self, current_time, step_size):
        u, gain, lag, _, y, steps, doubled, _ = self.values
        if self.mode != RUNNING:
            return self.refuse(f"do_step is refused in mode {self.mode}")
        if not step_size > 0.0:
            return self.refuse(f"step size {step_size} must be above 0")
        for name, value in (("u", u), ("gain", gain), ("lag", lag)):
            if not math.isfinite(value) or (name == "lag" and not 1e-3 <= value <= 10.0):
                return self.refuse(f"{name} = {value} is refused")
        goal = gain * u * (2.0 if doubled else 1.0)
        count = math.ceil(step_size / lag * self.tolerance**-0.25)
        h = step_size / count / lag
        for _ in range(count):  # the classical Runge-Kutta method for dy/ds = goal - y
            y += (goal - y) * h * (1.0 - h * (0.5 - h * (1.0 / 6.0 - h / 24.0)))
        self.values[4:6] = [y, steps + 1]
        return True

    def fetch(self, references, kinds, otherwise):
        found = []
        for each in references:
            if each not in kinds:
                self.refuse(f"value reference {each} is unknown")
            found.append(self.values[each] if each in kinds else otherwise)
        return found

    def put(self, references, values, kinds):
        for each, value in zip(references, values):
            if each not in kinds or each in OUTPUTS or (each in FIXED and self.mode > INITIALIZING):
                self.refuse(f"value reference {each} cannot be set now")
                continue
            self.values[each] = value
            if NAMES[each] == "start":
                self.values[4] = value

    def get_real(self, vrs):
        return self.fetch(vrs, REALS, math.nan)

    def get_integer(self, vrs):
        return self.fetch(vrs, INTEGERS, 0)

    def get_boolean(self, vrs):
        return self.fetch(vrs, BOOLEANS, False)

    def get_string(self, vrs):
        return self.fetch(vrs, STRINGS, "")

    def set_real(self, vrs, values):
        self.put(vrs, values, REALS)

    def set_integer(self, vrs, values):
        self.put(vrs, values, INTEGERS)

    def set_boolean(self, vrs, values):
        self.put(vrs, values, BOOLEANS)

    def set_string(self, vrs, values):
        self.put(vrs, values, STRINGS)

    def _get_fmu_state(self):
        return {"values": list(self.values), "mode": self.mode, "tolerance": self.tolerance}

    def _set_fmu_state(self, state):
        try:
            self.values, self.mode, self.tolerance = list(state["values"]), state["mode"], state["tolerance"]
        except (KeyError, TypeError):
            self.refuse("this is no state")

    @staticmethod
    def _fmu_state_to_bytes(state):
        return json.dumps(state).encode()

    @staticmethod
    def _fmu_state_from_bytes(state):
        try:
            return json.loads(bytes(state).decode())
        except ValueError:
            return {}
