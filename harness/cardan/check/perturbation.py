"""Moves one variable at a time and watches what follows: which unknown depends on which known, observed.

A point is a set of values of the knowns: the start values first, then random ones of the usual size, so that
a dependency that a zero hides at the start is seen later. A change counts beyond `NOISE`: what a sum leaves when
its parts cancel is no dependency.
"""

from __future__ import annotations

import math
import random
import time
from collections.abc import Sequence
from typing import Any

from cardan.check.base import Refused
from cardan.check.excitation import Excitation
from cardan.check.quantities import Value, attribute, drawn, moved, start
from cardan.check.rig import WARNING, Rig
from cardan.check.subject import Subject
from cardan.check.trajectory import same

NOISE = 1e-9  # of the largest value seen, of the nominal value, or of 1 where there is none
Pair = tuple[str, str]


class Perturbation:
    """Observes dependencies on an FMU.

    Parameters
    ----------
    subject : Subject
        The FMU.
    knowns, unknowns : sequence
        What is moved, and what is watched.
    until : float
        Value of `time.perf_counter` after which no further point is begun.

    Attributes
    ----------
    seen : dict of (str, str) to str
        Unknown and known with what was seen, in words.
    moved : set of str
        Knowns that could be moved at least once.
    points : int
        Points that worked.
    refused : set of str
        Knowns whose setting was refused.
    unsteady : str
        Where moving a known and moving it back did not give the same unknowns; else empty.
    """

    def __init__(self, subject: Subject, knowns: Sequence[Any], unknowns: Sequence[Any], until: float) -> None:
        self._subject = subject
        self._knowns = list(knowns)
        self._unknowns = list(unknowns)
        self._until = until
        self._size = {each.name: attribute(each, "nominal") or 1.0 for each in unknowns}
        self.seen: dict[Pair, str] = {}
        self.moved: set[str] = set()
        self.refused: set[str] = set()
        self.points = 0
        self.unsteady = ""

    def in_initialization(self, count: int) -> None:
        """Move every known in initialization mode, at the start values and at ``count - 1`` other points."""
        rig = Rig(self._subject)
        for values in self._drawn_points(count):
            rig = self._fresh(rig)
            rig.begin()
            point = {known: value for known, value in values.items() if rig.put(known, value) <= WARNING}
            self._around(rig, point, "in initialization mode")
            if time.perf_counter() > self._until:
                break
        rig.free()

    def after_initialization(self, count: int) -> None:
        """Start with one known changed, and look at the unknowns after the initialization."""
        rig = Rig(self._subject)
        for values in self._drawn_points(count):
            rig, before = self._started(rig, values)
            if before is None:
                continue
            self.points += 1
            for known, value in values.items():
                other = moved(known, value)
                if other is None:
                    continue
                rig, after = self._started(rig, {**values, known: other})
                if after is not None:
                    self.moved.add(known.name)
                    self._note(known, value, other, before, after, "after the initialization")
                if time.perf_counter() > self._until:
                    return rig.free()
        rig.free()

    def at_communication_points(self, count: int) -> None:
        """Move every input between steps and look at the unknowns at once."""
        experiment, inputs = self._subject.experiment, Excitation(self._subject)
        rig = Rig(self._subject)
        times = experiment.times(3 * count)
        rig.start(inputs.at(times[0]))
        for place, (now, then) in enumerate(zip(times, times[1:])):
            rig.set(inputs.at(now))
            if rig.step(now, then - now) > WARNING:
                break
            if place % 3 == 2:
                point = dict(zip(self._knowns, rig.get(self._knowns)))
                self._around(rig, point, f"at t = {then:g} s")
        rig.free()

    # ---- one point

    def _around(self, rig: Rig, point: dict[Any, Value], where: str) -> None:
        """Move every known at a point and move it back."""
        before = rig.get(self._unknowns)
        self.points += 1
        for known, value in point.items():
            other = moved(known, value)
            if other is None:
                continue
            if rig.put(known, other) > WARNING:
                self.refused.add(known.name)
                if not rig.alive:
                    raise Refused(f"setting {known.name} = {other!r} {where} returned fatal")
                continue
            self.moved.add(known.name)
            after = rig.get(self._unknowns)
            self._note(known, value, other, before, after, where)
            rig.set({known: value})
            back = rig.get(self._unknowns)
            wrong = [each.name for each, one, two in zip(self._unknowns, before, back) if not same(one, two)]
            if wrong and not self.unsteady:
                self.unsteady = (f"{where}, {known.name} was set to {other!r} and back to {value!r}, but {wrong[0]} "
                                 "did not come back to the same value")
            before = back

    def _note(self, known: Any, value: Value, other: Value, before: Sequence[Value], after: Sequence[Value],
              where: str) -> None:
        for unknown, one, two in zip(self._unknowns, before, after):
            if (unknown.name, known.name) not in self.seen and self._differs(unknown.name, one, two):
                self.seen[unknown.name, known.name] = (f"{where}, {known.name} = {other!r} instead of {value!r} "
                                                       f"changes {unknown.name} from {one!r} to {two!r}")

    def _differs(self, name: str, one: Value, two: Value) -> bool:
        if not isinstance(one, float) or not isinstance(two, float):
            return one != two
        if not (math.isfinite(one) and math.isfinite(two)):
            return False  # no number: found by another check
        self._size[name] = max(self._size[name], abs(one), abs(two))
        return abs(one - two) > NOISE * self._size[name]

    # ---- points and instances

    def _drawn_points(self, count: int) -> list[dict[Any, Value]]:
        chance = random.Random(1)
        first = {known: start(known) for known in self._knowns}
        points = [first, *({known: drawn(known, chance) for known in self._knowns} for _ in range(count - 1))]
        return [{known: value for known, value in point.items() if value is not None} for point in points]

    def _fresh(self, rig: Rig) -> Rig:
        """Return an instance as new: by a reset, or another one where that does not work."""
        if rig.alive and rig.status("fmi2Reset") <= WARNING:
            return rig
        rig.free()
        return Rig(self._subject)

    def _started(self, rig: Rig, values: dict[Any, Value]) -> tuple[Rig, list[Value] | None]:
        """Start with these values; the unknowns, or None where the FMU refuses such a start."""
        rig = self._fresh(rig)
        try:
            rig.start(values)
            return rig, rig.get(self._unknowns)
        except Refused:
            return rig, None
