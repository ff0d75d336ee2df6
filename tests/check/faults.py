"""Single faults for the FMU of lag.py and lag.xml, each with the check that has to find it."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import NamedTuple

Changes = Mapping[str, str]
NONE: Changes = MappingProxyType({})


class Fault(NamedTuple):
    """A fault: who finds it, what is said, what is replaced in the source and in the model description."""

    check: str
    said: str
    code: Changes = NONE
    xml: Changes = NONE


BIRTH = "        self.mode, self.tolerance = NEW, 1e-6\n"
STEP = "        u, gain, lag, _, y, steps, doubled, _ = self.values\n"
CLASS = "class Lag(Fmi2Slave):\n"
VALUES = '[0.0, 2.0, 0.05, 1.0, 1.0, 0, False, "none"]'
UNKNOWN_Y = '<InitialUnknowns><Unknown index="5" dependencies="4"/>'


def after(place: str, *lines: str) -> Changes:
    """Put lines of code after a place in a method."""
    return {place: place + "".join(f"        {line}\n" for line in lines)}


LATE_PARAMETER: Changes = {" or (each in FIXED and self.mode > INITIALIZING)": ""}


def before_class(line: str) -> Changes:
    """Put a line of code before the class."""
    return {CLASS: f"{line}\n\n\n{CLASS}"}


def y_depends_on(indices: str) -> Changes:
    """Declare another dependency of y in InitialUnknowns."""
    return {UNKNOWN_Y: UNKNOWN_Y.replace('"4"', f'"{indices}"')}


SHARED = {**before_class(f"SHARED = {VALUES}"), f"self.values = {VALUES}": "self.values = SHARED"}

DESCRIPTION = {
    "wrong exponent": Fault(
        "units", "unit m/N is defined as kg.s2, but its name says kg-1.s2", xml={'kg="-1" s="2"': 'kg="1" s="2"'}),
    "unit not defined": Fault(
        "units", "lag: its unit ms is not defined", xml={'<Real unit="s" start': '<Real unit="ms" start'}),
    "wrong display factor": Fault(
        "units", "display unit mm of m: factor 0.001", xml={'"mm" factor="1000"': '"mm" factor="0.001"'}),
    "display unit of another dimension": Fault(
        "units", "display unit kg of m is of another dimension",
        xml={'<DisplayUnit name="mm"': '<DisplayUnit name="kg"'}),
    "no InitialUnknowns": Fault(
        "structure", "InitialUnknowns is missing; it has to list y, steps",
        xml={UNKNOWN_Y: "<!--", '<Unknown index="6" dependencies=""/></InitialUnknowns>': "-->"}),
    "incomplete InitialUnknowns": Fault(
        "structure", "InitialUnknowns does not list y", xml={UNKNOWN_Y: "<InitialUnknowns>"}),
    "computed variable as a dependency": Fault(
        "structure", "y depends on steps, which is computed itself", xml=y_depends_on("4 6")),
    "start outside its limits": Fault(
        "ranges", "lag: start = 0.05 is outside its limits, 0.1 to 10", xml={'min="0.001"': 'min="0.1"'}),
    "no start value": Fault("ranges", "u has no start value", xml={'start="0" nominal="5"': 'nominal="5"'}),
    "unknown attribute": Fault("schema", "colour", xml={'<Real unit="s"': '<Real colour="red" unit="s"'}),
    "undefined unit, by FMPy's rules": Fault(
        "validation", 'The unit "ms" of variable "lag"', xml={'<Real unit="s" start': '<Real unit="ms" start'}),
    "name twice": Fault("variables", "two variables are named gain", xml={'name="lag"': 'name="gain"'}),
    "two parameters on one reference": Fault(
        "variables", "more than one of them can be set", xml={'valueReference="3"': 'valueReference="2"'}),
    "declared start is not the real one": Fault(
        "values", "gain is 2.0, declared 2.5", xml={'unit="m/N" start="2"': 'unit="m/N" start="2.5"'}),
    "lying InitialUnknowns": Fault("dependencies", "start = 1.3 instead of 1.0 changes y", xml=y_depends_on("")),
    "hidden feed-through": Fault(
        "dependencies", "Outputs: not among the dependencies: at t = 0.03 s, u =",
        {"return self.fetch(vrs, REALS, math.nan)":
         "return [x + self.values[0] * (vr == 4) for vr, x in zip(vrs, self.fetch(vrs, REALS, math.nan))]"},
        y_depends_on("1 4")),
}

RUNNING = {
    "crash in doStep": Fault(
        "run", "the process died in fmi2DoStep(t = 0.05, h = 0.0",
        after(STEP, "if current_time > 0.045:", "    import ctypes", "    ctypes.string_at(0)")),
    "exit in doStep": Fault("run", "(exit code 3)", after(STEP, "import os", "os._exit(3)")),
    "exception in doStep": Fault("run", "returned fatal", after(STEP, "raise RuntimeError('thirteen')")),
    "NaN comes out": Fault(
        "run", "no finite numbers: y = nan at t = 0.01 s", {"[y, steps + 1]": "[math.nan, steps + 1]"}),
    "output outside its limits": Fault(
        "run", "outputs outside their declared limits: y =", xml={'max="1000"': 'max="1.5"'}),
    "steps of another length than asked for": Fault(
        "steps", "do not converge", {"h = step_size / count": "h = 0.01 / count"}),
    "only some lengths of step are right": Fault(
        "steps", "uneven steps change the results",
        after(STEP, "gain *= 1.0 if round(step_size, 9) in (0.01, 0.005, 0.0025) else 1.001")),
    "tolerance turned around": Fault(
        "tolerance", "the error does not fall", {"self.tolerance**-0.25": "(1e-16 / self.tolerance) ** -0.25"}),
}

STATES = {
    "state not restored": Fault(
        "state", "y is", {'list(state["values"])': '[*state["values"][:4], *self.values[4:]]'}),
    "hidden state forgotten": Fault(
        "state", "on the first way again: y is",
        {**after(BIRTH, "self.hidden = 0.0"), **after(STEP, "self.hidden += 1e-9", "y += self.hidden")}),
    "inputs not in the state": Fault(
        "state", "u is", {'list(state["values"])': '[self.values[0], *state["values"][1:]]'}),
    "bytes lose digits": Fault(
        "serialization", "from the bytes: ", {"json.dumps(state)": "json.dumps(state | {'tolerance': 1e-5})"}),
    "values shared by all instances": Fault("instances", "gives other results than alone", SHARED),
    "reset keeps values": Fault("reset", "is not that of a new instance: ", SHARED),
}

CALLS = {
    "step before initialization": Fault(
        "illegal-calls", "step before initialization: accepted without a word",
        {"if self.mode != RUNNING:": "if self.mode == ENDED:"}),
    "step backwards": Fault(
        "illegal-calls", "step of negative length: accepted without a word", after(STEP, "step_size = abs(step_size)")),
    "complains and does it": Fault(
        "illegal-calls", "fixed parameter set between steps: refused in words, but done",
        {'cannot be set now")\n                continue': 'cannot be set now")'}),
    "message waits for nobody": Fault(
        "legal-calls", "instantiate, free: the process died in fmi2FreeInstance", after(BIRTH, "self.refuse('hello')")),
    "no texts": Fault(
        "texts", "refused without a text: lag = ",
        {'self.log_queue.append(LogMsg(Fmi2Status.error, "logStatusError", text))': "pass"}),
}

GUESTS = {
    "file in the working directory": Fault(
        "leftovers", "left in the working directory: trace.txt", after(STEP, "open('trace.txt', 'a').close()")),
    "file in the temporary directory": Fault(
        "leftovers", "left in the temporary directory: ", after(STEP, "import tempfile", "tempfile.mkstemp()")),
    "memory kept": Fault(
        "memory", "KiB per instance", {**before_class("KEPT = []"), **after(BIRTH, "KEPT.append(b'x' * 200000)")}),
}

FAULTS = DESCRIPTION | RUNNING | STATES | CALLS | GUESTS
