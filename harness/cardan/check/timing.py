"""Time per step: measured, never a reason to fail."""

from __future__ import annotations

import ctypes
import time

from cardan.check.base import Check, Findings
from cardan.check.excitation import Excitation
from cardan.check.library import library
from cardan.check.rig import WARNING, Rig, name_of
from cardan.check.subject import Subject

BATCHES = 5
SECONDS = 0.3  # that one batch may take


class Timing(Check):
    """No section of FMI; figures for choosing a step and for seeing a regression."""

    id = "timing"
    title = "Time: per instance and per step (reported, never failed)"
    proves = "nothing; it says what an instance, a step, and a step with its exchange of values cost here"
    needs = ("instantiation", "run")

    def run(self, subject: Subject, part: str, found: Findings) -> None:
        """Measure in batches; the fastest one counts, since a busy machine only adds."""
        library(subject)
        rig = None
        for name in ("first instantiation", "further instantiation"):
            if rig is not None:
                rig.start()
                rig.free()
            began = time.perf_counter()
            rig = Rig(subject)
            found.figure(name, 1e3 * (time.perf_counter() - began), "ms")
        assert rig is not None
        began = time.perf_counter()
        rig.start(Excitation(subject).at(subject.experiment.start))
        found.figure("initialization", 1e3 * (time.perf_counter() - began), "ms")
        bare, full = self._steps(subject, rig, found)
        if bare:
            found.figure("step", 1e6 * min(bare), "us")
            found.figure("step with all Real inputs and outputs", 1e6 * min(full), "us")
            found.figure("real-time factor", subject.experiment.step / min(full))
        rig.free()

    @staticmethod
    def _steps(subject: Subject, rig: Rig, found: Findings) -> tuple[list[float], list[float]]:
        """Step through the experiment, every other batch with the exchange of values."""
        experiment = subject.experiment
        inputs = Excitation(subject)
        outputs = [each for each in subject.outputs if each.type == "Real"]
        functions, component = rig.library, rig.component
        values = [float(value) for value in inputs.held(experiment.start).values()]
        sent = (ctypes.c_double * len(values))(*values)
        to = (ctypes.c_uint * len(values))(*(each.valueReference for each in inputs.variables))
        got = (ctypes.c_double * len(outputs))()
        of = (ctypes.c_uint * len(outputs))(*(each.valueReference for each in outputs))
        means: tuple[list[float], list[float]] = ([], [])
        place, h = 0, experiment.step
        size = max(1, experiment.count // (2 * BATCHES))
        for batch in range(2 * BATCHES):
            exchanging, done, spent = batch % 2, 0, 0.0
            rig.subject.trail.mark("fmi2DoStep in a batch")
            while done < size and spent < SECONDS:
                began = time.perf_counter()
                if exchanging:
                    functions.fmi2SetReal(component, to, len(to), sent)
                status = functions.fmi2DoStep(component, experiment.start + place * h, h, 1)
                if exchanging:
                    functions.fmi2GetReal(component, of, len(of), got)
                spent += time.perf_counter() - began
                if status > WARNING:
                    found.remark(f"stepping ended after {place} steps with {name_of(status)}")
                    return means
                done, place = done + 1, place + 1
            means[exchanging].append(spent / done)
        return means
