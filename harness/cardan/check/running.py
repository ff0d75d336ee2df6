"""The default experiment from its start to its stop time."""

from __future__ import annotations

import ctypes
import math
from typing import Any

from cardan.check.base import Check, Findings, Refused, listed
from cardan.check.excitation import Excitation
from cardan.check.quantities import Value, limits
from cardan.check.rig import DISCARD, WARNING, Rig, name_of
from cardan.check.subject import Subject

TERMINATED = 3  # fmi2Terminated of fmi2StatusKind
SLACK = 1e-9  # relative, by which a value may pass its limit: the limits are printed numbers


class Running(Check):
    """FMI 2.0 section 4.2: initialization, steps of constant length, termination."""

    id = "run"
    title = "Default experiment: runs to its end, outputs are finite and in range"
    proves = "a plain master can run the FMU from start to stop with moving inputs"
    needs = ("instantiation",)

    def run(self, subject: Subject, part: str, found: Findings) -> None:
        """Run with moving inputs; where the FMU refuses them, with its start values."""
        moving = Excitation(subject)
        try:
            self._run(subject, moving, found)
        except Refused as refusal:
            if not moving.variables:
                raise
            resting = Excitation(subject)
            resting.variables = []
            self._run(subject, resting, found)
            found.data["resting"] = True
            found.remark(f"with moving inputs the FMU refuses ({refusal}): all checks keep its start values instead")

    @staticmethod
    def _run(subject: Subject, inputs: Excitation, found: Findings) -> None:
        experiment, outputs = subject.experiment, subject.outputs
        count = min(experiment.count, subject.options.run_steps)
        times = experiment.times(count)
        rig = Rig(subject)
        rig.begin(experiment.tolerance, experiment.stop)
        rig.set(inputs.at(times[0]))
        rig.initialize()
        seen = [_Seen(each) for each in outputs]
        _note(seen, rig.get(outputs), times[0])
        reached = times[-1]
        for now, then in zip(times, times[1:]):
            rig.set(inputs.at(now))
            before = rig.latest
            status = rig.step(now, then - now)
            if status == DISCARD and _wants_to_end(rig) and not any(each.status > WARNING
                                                                   for each in rig.messages(before)):
                found.remark(f"the FMU itself ends the run at t = {now:g} s")
                reached = now
                break
            if status > WARNING:
                texts = "; ".join(each.text for each in rig.messages(before) if each.text) or "no text"
                raise Refused(f"fmi2DoStep(t = {now!r}, h = {then - now!r}) returned {name_of(status)}: {texts}")
            _note(seen, rig.get(outputs), then)
        rig.good("fmi2Terminate")
        rig.get(outputs)
        rig.free()
        _judge(seen, found)
        found.data["reached"] = round((reached - times[0]) / experiment.step)
        moved = f"{len(inputs.variables)} moving inputs" if inputs.variables else "inputs at their start values"
        found.remark(f"{count} steps of {experiment.step:g} s up to t = {reached:g} s, {moved}")


class _Seen:
    """What one output did."""

    def __init__(self, variable: Any) -> None:
        self.variable = variable
        low, high = limits(variable)
        self.low = low - SLACK * max(1.0, abs(low)) if math.isfinite(low) else low
        self.high = high + SLACK * max(1.0, abs(high)) if math.isfinite(high) else high
        self.infinite = self.outside = ""
        self.first: Value | None = None
        self.changed = False


def _note(seen: list[_Seen], values: list[Value], time: float) -> None:
    for each, value in zip(seen, values):
        if isinstance(value, float) and not math.isfinite(value):
            each.infinite = each.infinite or f"{each.variable.name} = {value} at t = {time:g} s"
        elif not isinstance(value, str) and not each.low <= value <= each.high:
            each.outside = each.outside or f"{each.variable.name} = {value!r} at t = {time:g} s"
        if each.first is None:
            each.first = value
        each.changed = each.changed or value != each.first


def _judge(seen: list[_Seen], found: Findings) -> None:
    infinite = [each.infinite for each in seen if each.infinite]
    if infinite:
        found.fail(f"outputs that are no finite numbers: {listed(infinite)}")
    outside = [each.outside for each in seen if each.outside]
    if outside:
        found.fail(f"outputs outside their declared limits: {listed(outside)}")
    resting = [each.variable.name for each in seen if not each.changed]
    if resting:
        found.remark(f"outputs that never change: {listed(resting)}")


def _wants_to_end(rig: Rig) -> bool:
    """Return whether a discarded step was the FMU's wish to end the run."""
    flag = ctypes.c_int(0)
    return rig.status("fmi2GetBooleanStatus", TERMINATED, ctypes.byref(flag)) <= WARNING and bool(flag.value)
