"""The tolerance that the master gives."""

from __future__ import annotations

from cardan.check.accuracy import distance, farthest, results, scales, watched
from cardan.check.base import Check, Findings, Refused, Skip
from cardan.check.subject import Subject

TOLERANCES = (1e-4, 1e-6, 1e-8)
TIGHT = 1e-11
FLOOR = 1e-9  # relative error below which nothing has to fall any more
FALL = 0.5  # of the error is left after a hundred times tighter tolerance, at most
INTERVALS = 10  # communication steps, long ones, so that the solver's own step is not limited by them


class Tolerance(Check):
    """FMI 2.0 section 2.1.6: argument tolerance of fmi2SetupExperiment."""

    id = "tolerance"
    title = "Tolerance: the error falls with it"
    proves = "a tighter tolerance gives results nearer to those of a very tight one"
    needs = ("instantiation", "run")

    def run(self, subject: Subject, part: str, found: Findings) -> None:
        """Run with three tolerances and compare with a tight one, inputs at rest."""
        if not watched(subject):
            raise Skip("the FMU has no continuous Real output")
        times = self._times(subject)
        tight = results(subject, times, TIGHT)
        sizes = scales(subject, tight)
        errors = []
        for tolerance in TOLERANCES:
            rows = results(subject, times, tolerance)
            away = [distance(row, best, sizes) for row, best in zip(rows, tight)]
            errors.append(max(away))
            place = away.index(max(away))
            found.figure(f"error at {tolerance:g}", errors[-1])
            found.remark(f"at tolerance {tolerance:g} the error is largest in "
                         f"{farthest(subject, rows[place], tight[place], sizes)} at t = {times[place]:g} s")
        if max(errors) == 0.0:
            raise Skip("the results do not depend on the tolerance: the FMU has no error control of its own")
        for (loose, large), (tighter, small) in zip(zip(TOLERANCES, errors), zip(TOLERANCES[1:], errors[1:])):
            if small > max(FALL * large, FLOOR):
                found.fail(f"the error does not fall: {large:.3g} at tolerance {loose:g}, {small:.3g} at {tighter:g} "
                           "(relative)")

    @staticmethod
    def _times(subject: Subject) -> list[float]:
        """Return long communication steps over the experiment, the usual ones where the FMU wants those."""
        experiment = subject.experiment
        usual = experiment.times(subject.options.steps)
        if not subject.capability.canHandleVariableCommunicationStepSize:
            return usual
        span = (experiment.stop - experiment.start) / INTERVALS
        times = [experiment.start + i * span for i in range(INTERVALS + 1)]
        try:
            results(subject, times)
        except Refused:
            return usual
        return times
