"""Results against a reference."""

from __future__ import annotations

import base64
from collections.abc import Mapping
from typing import Any

from cardan.check.base import Check, Findings, Skip, listed
from cardan.check.cross_check_files import Reference, Signals, find_reference, options_text, signals_text
from cardan.check.excitation import Excitation
from cardan.check.quantities import Value, attribute
from cardan.check.rig import Rig
from cardan.check.subject import Subject
from cardan.check.trajectory import advance

TIMES_TOLERANCE = 100.0  # allowed deviation in units of RelTol: an error of a run is larger than that of a step
EVENTS = 0.01  # of the samples may lie where an event comes one sample earlier or later
WAVES = 5.0  # periods of the exported inputs


class ReferenceResults(Check):
    """The form of the FMI cross-check rules; the files may come from another tool."""

    id = "reference"
    title = "Results: as in the reference files"
    proves = "the FMU gives here what it, or the tool that made the reference, gave there"
    needs = ("instantiation",)

    def run(self, subject: Subject, part: str, found: Findings) -> None:
        """Run as the options say, with the inputs given, and compare every column."""
        identifier = subject.capability.modelIdentifier
        reference = find_reference(subject.path, identifier, subject.options.reference)
        if reference is None:
            raise Skip(f"no {subject.path.stem}_ref.csv beside the FMU, and no other directory was named")
        known = {each.name: each for each in subject.model.modelVariables}
        unknown = [name for name in (*reference.results.columns, *reference.inputs.columns) if name not in known]
        if unknown:
            found.fail(f"the reference speaks of variables that the FMU does not have: {listed(unknown)}")
            return
        watched = [known[name] for name in reference.results.columns]
        moved = {known[name]: name for name in reference.inputs.columns}

        def inputs(time: float) -> Mapping[Any, Value]:
            return {variable: _typed(variable, reference.inputs.at(name, time, variable.variability == "continuous"))
                    for variable, name in moved.items()}

        result = simulate(subject, reference.options, reference.step, inputs, watched)
        worst = 0.0
        for variable in watched:
            worst = max(worst, self._column(reference, result, variable, found))
        found.figure("largest deviation", worst)
        found.remark(f"{len(watched)} columns and {len(reference.results.times)} rows of {reference.source}, "
                     f"{len(moved)} inputs given")

    @staticmethod
    def _column(reference: Reference, result: Signals, variable: Any, found: Findings) -> float:
        """Compare one column; the largest deviation in parts of its size: its largest value, or its nominal."""
        name = variable.name
        expected, times = reference.results.columns[name], reference.results.times
        size = max(max(map(abs, expected)), attribute(variable, "nominal") or 0.0, 1e-300)
        allowed = max(TIMES_TOLERANCE * reference.options["RelTol"] * size, reference.options.get("AbsTol", 0.0))
        got = [result.at(name, time, linear=True) for time in times]
        off = [place for place in range(len(times)) if not abs(got[place] - expected[place]) <= allowed]
        beyond = [place for place in off if not _in_tube(expected, place, got[place], allowed)]
        if beyond or len(off) > EVENTS * len(times):
            place = max(beyond or off, key=lambda i: abs(got[i] - expected[i]))
            found.fail(f"{name} = {got[place]!r} at t = {times[place]:g} s instead of {expected[place]!r}; "
                       f"{len(off)} of {len(times)} samples are off by more than {allowed:.3g}")
        return max(abs(a - b) for a, b in zip(got, expected)) / size

    def errand(self, subject: Subject, data: dict[str, Any]) -> dict[str, Any]:
        """Make reference files; see `cardan.check.export`."""
        experiment = subject.experiment
        count, every = data["count"], data["every"]
        stop = experiment.start + count * experiment.step
        tolerance = data["tolerance"] or experiment.tolerance or 1e-9
        waves = Excitation(subject, period=(stop - experiment.start) / WAVES)
        places = sorted({*range(0, count, every), count})
        times = [experiment.start + place * experiment.step for place in places]
        given = Signals(times, {each.name: [float(waves.at(time)[each]) for time in times] for each in waves.variables})
        options = {"StartTime": experiment.start, "StopTime": stop, "StepSize": experiment.step, "RelTol": tolerance,
                   "OutputIntervalLength": every * experiment.step}
        # Counts of solver steps and the like differ by one between machines for the last bit of a sine.
        outputs = [each for each in subject.outputs if each.type == "Real"] or [
            each for each in subject.outputs if each.type != "String"]

        def inputs(time: float) -> Mapping[Any, Value]:
            return {each: given.at(each.name, time, linear=True) for each in waves.variables}

        result = simulate(subject, options, experiment.step, inputs, outputs)
        rows = Signals(times, {each.name: [_plain(each, result.columns[each.name][place]) for place in places]
                               for each in outputs})
        texts = {"_ref.csv": signals_text(rows), "_ref.opt": options_text(options)}
        if given.columns:
            texts["_in.csv"] = signals_text(given)
        return {name: base64.b64encode(text.encode()).decode() for name, text in texts.items()}


def simulate(subject: Subject, options: Mapping[str, float], step: float, inputs: Any, watched: list[Any]) -> Signals:
    """Run from StartTime to StopTime; values at every communication point."""
    start, stop = options["StartTime"], options["StopTime"]
    count = max(1, round((stop - start) / step))
    times = [start + i * step for i in range(count)] + [stop]
    rig = Rig(subject)
    status = rig.setup(start, stop, options["RelTol"])
    if status > 1:
        rig.setup(start, stop)
    rig.good("fmi2EnterInitializationMode")
    rig.set(inputs(start))
    rig.initialize()
    rows = [rig.get(watched), *advance(rig, times, inputs, watched)]
    rig.good("fmi2Terminate")
    rig.free()
    return Signals(times, {each.name: [float(row[place]) for row in rows] for place, each in enumerate(watched)})


def _typed(variable: Any, number: float) -> Value:
    if variable.type == "Real":
        return number
    return number != 0.0 if variable.type == "Boolean" else int(number)


def _plain(variable: Any, number: float) -> float:
    """Return a whole number for a variable that has only those, so that it is written as one."""
    return number if variable.type == "Real" else int(number)


def _in_tube(expected: list[float], place: int, value: float, allowed: float) -> bool:
    """Return whether a value and the one expected lie between those before and after: a jump, a sample off in time."""
    near = (expected[max(0, place - 1)], expected[min(place + 1, len(expected) - 1)])
    return all(min(near) - allowed <= each <= max(near) + allowed for each in (value, expected[place]))
