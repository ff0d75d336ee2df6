"""Reset: an instance after fmi2Reset is as good as a new one."""

from __future__ import annotations

from collections.abc import Sequence

from cardan.check.base import Check, Findings
from cardan.check.excitation import Excitation
from cardan.check.quantities import moved, start
from cardan.check.rig import WARNING, Rig
from cardan.check.subject import Subject
from cardan.check.trajectory import advance, difference, names_of, run

CHANGED, INITIALIZING = "after a run with everything changed", "in initialization mode"


class Resetting(Check):
    """FMI 2.0 section 2.1.6: fmi2Reset."""

    id = "reset"
    title = "Reset: brings the start back, and the same run again"
    proves = "after fmi2Reset parameters, inputs and results are those of a new instance, to the last bit"
    needs = ("instantiation", "run")

    def parts(self, subject: Subject) -> Sequence[str]:
        """Return where the reset happens."""
        return (CHANGED, INITIALIZING)

    def run(self, subject: Subject, part: str, found: Findings) -> None:
        """Run a new instance, and one that was used and reset."""
        times, inputs = subject.experiment.times(subject.options.steps), Excitation(subject)
        watched = subject.variables
        new = Rig(subject, "new")
        expected = run(new, times, inputs.at, watched)
        new.free()
        rig = Rig(subject, "used")
        rig.begin()
        for variable in subject.having("parameter", "input"):
            first = start(variable)
            other = None if first is None else moved(variable, first)
            if other is not None:
                rig.put(variable, other)
        if part == CHANGED:
            status = rig.status("fmi2ExitInitializationMode")
            if status <= WARNING and rig.step(times[0], times[1] - times[0]) <= WARNING:
                advance(rig, times[1:], inputs.at, [])
            elif rig.alive:  # not every combination of values can run
                rig.good("fmi2Reset")
                rig.start(inputs.at(times[0]))
                advance(rig, times, inputs.at, [])
        rig.good("fmi2Reset")
        text = difference(names_of(watched), expected, run(rig, times, inputs.at, watched))
        if text:
            found.fail(f"the run after fmi2Reset is not that of a new instance: {text}")
        rig.free()


class Instances(Check):
    """FMI 2.0 section 2.1.5: several instances in one process."""

    id = "instances"
    title = "Two instances: neither sees the other"
    proves = "instances in one process, stepped in turns with different inputs, give the results that each gives alone"
    needs = ("instantiation", "run")

    def run(self, subject: Subject, part: str, found: Findings) -> None:
        """Run two alone, then two in turns, and free one of them half way."""
        if subject.capability.canBeInstantiatedOnlyOncePerProcess:
            found.skipped = "the FMU says canBeInstantiatedOnlyOncePerProcess"
            return
        times, watched = subject.experiment.times(subject.options.steps), subject.outputs
        inputs = (Excitation(subject).at, Excitation(subject, phase=2.0).at)
        expected = []
        for signals in inputs:
            rig = Rig(subject, "alone")
            expected.append(run(rig, times, signals, watched))
            rig.free()
        if inputs[0](times[0]) and expected[0] == expected[1]:
            found.remark("other inputs give the same outputs, so little is proved")
        rigs = [Rig(subject, name) for name in ("first", "second")]
        rows = [run(rig, times[:1], signals, watched) for rig, signals in zip(rigs, inputs)]
        half = len(times) // 2
        for place, (now, then) in enumerate(zip(times, times[1:])):
            if place == half:
                rigs[1].free()
            for number, rig in enumerate(rigs):
                if rig.alive:
                    rows[number] += advance(rig, (now, then), inputs[number], watched)
        rigs[0].free()
        for number, name in enumerate(("first", "second")):
            text = difference(names_of(watched), expected[number][: len(rows[number])], rows[number])
            if text:
                found.fail(f"the {name} of two instances gives other results than alone: {text}")
