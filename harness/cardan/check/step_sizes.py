"""Communication steps of changing length."""

from __future__ import annotations

from cardan.check.accuracy import MEET, Values, distance, results, scales, uneven, watched
from cardan.check.base import Check, Findings, Skip
from cardan.check.subject import Subject

EXACT = 1e-6  # relative; differences below it count as none
FACTOR = 10.0  # by which uneven steps may be worse than what halving the even ones changes
SHRINK = 0.9  # what is left of a difference when the steps are halved, at most


class StepSizes(Check):
    """FMI 2.0 section 4.3.1: canHandleVariableCommunicationStepSize."""

    id = "steps"
    title = "Communication steps: of any length, results converge"
    proves = "uneven communication steps give the result of even ones, as far as that is independent of the step at all"
    needs = ("instantiation", "run")

    def run(self, subject: Subject, part: str, found: Findings) -> None:
        """Compare even steps h, h/2, h/4 with uneven ones over the same time, inputs at rest."""
        if not subject.capability.canHandleVariableCommunicationStepSize:
            raise Skip("the FMU does not claim canHandleVariableCommunicationStepSize")
        if not watched(subject):
            raise Skip("the FMU has no continuous Real output")
        if subject.options.steps < MEET:
            raise Skip(f"the FMU ends its run within {MEET} steps")
        start, h = subject.experiment.start, subject.experiment.step
        count = MEET * (subject.options.steps // MEET)
        whole = results(subject, [start + i * h for i in range(count + 1)])
        half = results(subject, [start + i * h / 2 for i in range(2 * count + 1)])[::2]
        quarter = results(subject, [start + i * h / 4 for i in range(4 * count + 1)])[::4]
        times = uneven(start, h, count)
        rows = dict(zip(times, results(subject, times)))
        sizes = scales(subject, whole)
        first, second = _farthest(whole, half, sizes), _farthest(half, quarter, sizes)
        spread = _farthest([rows[start + i * h] for i in range(0, count + 1, MEET)], quarter[::MEET], sizes)
        found.figure("h to h/2", first)
        found.figure("h/2 to h/4", second)
        found.figure("uneven steps", spread)
        if second > max(SHRINK * first, EXACT):
            found.fail(f"results do not converge: from h = {h:g} s to h/2 they change by {first:.3g}, from h/2 to h/4 "
                       f"by {second:.3g} (relative); does fmi2DoStep use the step that it is given?")
        elif spread > max(FACTOR * max(first, second), EXACT):
            found.fail(f"uneven steps change the results by {spread:.3g}, halving even ones by {first:.3g} (relative)")


def _farthest(one: list[Values], other: list[Values], sizes: Values) -> float:
    return max(distance(a, b, sizes) for a, b in zip(one, other))
