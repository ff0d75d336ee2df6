"""Saved states: going back, and going on from bytes in another process, repeats everything to the last bit."""

from __future__ import annotations

import base64
from collections.abc import Sequence
from typing import Any

from cardan.check.base import Check, Findings, Refused, Skip
from cardan.check.excitation import Excitation
from cardan.check.quantities import Value, moved
from cardan.check.rig import WARNING, Rig
from cardan.check.subject import Subject
from cardan.check.trajectory import Row, advance, difference, names_of

ROLLBACK, TWICE, STARTED = "rollback", "two states at once", "state of the initialization"
HERE, ELSEWHERE, DAMAGED = "in the same instance", "in another process", "damaged bytes"


class State(Check):
    """FMI 2.0 section 2.1.8: getting and setting the complete FMU state."""

    id = "state"
    title = "State: saved and restored, repeats to the last bit"
    proves = "after fmi2SetFMUstate every variable and every later step is what it was, whatever happened between"
    needs = ("instantiation", "run")

    def parts(self, subject: Subject) -> Sequence[str]:
        """Return the situations."""
        return (ROLLBACK, TWICE, STARTED)

    def run(self, subject: Subject, part: str, found: Findings) -> None:
        """Save, go on, go back, go on again."""
        if not subject.capability.canGetAndSetFMUstate:
            raise Skip("the FMU does not claim canGetAndSetFMUstate")
        rig, watched, times = Rig(subject), subject.variables, _times(subject)
        inputs = Excitation(subject).at
        rig.start(inputs(times[0]))
        begin = 0 if part == STARTED else len(times) // 3
        advance(rig, times[: begin + 1], inputs, [])
        state = rig.save()
        before = [rig.get(watched)]
        ahead = advance(rig, times[begin:], inputs, watched)
        if part == TWICE:
            later = rig.save()
            rig.restore(state)
            _compare(before, [rig.get(watched)], "after returning to the first of two states", watched, found)
            rig.restore(later)
            _compare(ahead[-1:], [rig.get(watched)], "after returning to the second of two states", watched, found)
            rig.forget(later)
        else:
            _disturb(rig)
        for attempt in ("first", "second"):
            rig.restore(state)
            _compare(before, [rig.get(watched)], f"at once after the {attempt} return", watched, found)
            _compare(ahead, advance(rig, times[begin:], inputs, watched), f"on the {attempt} way again", watched, found)
        rig.forget(state)
        rig.free()


class Serialization(Check):
    """FMI 2.0 section 2.1.8: serialized states."""

    id = "serialization"
    title = "State as bytes: taken over by another process, repeats to the last bit"
    proves = "a run can be interrupted, stored, and continued elsewhere as if nothing had been"
    needs = ("instantiation", "run")

    def parts(self, subject: Subject) -> Sequence[str]:
        """Return where the bytes go."""
        return (HERE, ELSEWHERE, DAMAGED)

    def run(self, subject: Subject, part: str, found: Findings) -> None:
        """Save to bytes, go on, and have it done again from the bytes."""
        if not (subject.capability.canGetAndSetFMUstate and subject.capability.canSerializeFMUstate):
            raise Skip("the FMU does not claim canSerializeFMUstate")
        rig, watched, times = Rig(subject), subject.variables, _times(subject)
        inputs = Excitation(subject).at
        middle = len(times) // 3
        rig.start(inputs(times[0]))
        advance(rig, times[: middle + 1], inputs, [])
        state = rig.save()
        data = rig.pack(state)
        rig.forget(state)
        if part == DAMAGED:
            self._damaged(rig, data, found)
            return
        expected = [rig.get(watched), *advance(rig, times[middle:], inputs, watched)]
        if part == HERE:
            found.figure("state", len(data), "bytes")
            _disturb(rig)
            _compare(expected, _continued(rig, data, times[middle:]), "from the bytes", watched, found)
        else:
            answer = subject.errand(self.id, {"state": base64.b64encode(data).decode(), "middle": middle})
            rows = [[_from_json(value) for value in row] for row in answer["rows"]]
            _compare(expected, rows, "in a second process, from the bytes", watched, found)
        rig.free()

    def errand(self, subject: Subject, data: dict[str, Any]) -> dict[str, Any]:
        """Go on from the bytes in this process."""
        rig, times = Rig(subject), _times(subject)
        rig.start(Excitation(subject).at(times[0]))
        rows = _continued(rig, base64.b64decode(data["state"]), times[data["middle"]:])
        return {"rows": [[_to_json(value) for value in row] for row in rows]}

    @staticmethod
    def _damaged(rig: Rig, data: bytes, found: Findings) -> None:
        """Offer half of the bytes: refused by a status or in words, and the instance goes on."""
        before = rig.latest
        try:
            state = rig.unpack(data[: len(data) // 2])
            rig.restore(state)
            rig.forget(state)
            if not any(each.status > WARNING for each in rig.messages(before)):
                found.warn("half of the bytes of a state are taken without a word")
        except Refused as refusal:
            if not rig.alive:
                found.fail(f"half of the bytes of a state: {refusal}; freeing such an instance may crash the host")
                return
        rig.free()


def _times(subject: Subject) -> list[float]:
    return subject.experiment.times(min(subject.options.steps, max(3, subject.experiment.count)))


def _continued(rig: Rig, data: bytes, times: Sequence[float]) -> list[Row]:
    watched = rig.subject.variables
    state = rig.unpack(data)
    rig.restore(state)
    rig.forget(state)
    return [rig.get(watched), *advance(rig, times, Excitation(rig.subject).at, watched)]


def _disturb(rig: Rig) -> None:
    """Change whatever may be changed between steps, so that a state that forgets something shows it."""
    for variable in rig.subject.having("parameter", "input"):
        if variable.variability != "fixed":
            other = moved(variable, rig.fetch(variable)[1])
            if other is not None:
                rig.put(variable, other)


def _compare(expected: Sequence[Row], got: Sequence[Row], when: str, watched: Sequence[Any], found: Findings) -> None:
    text = difference(names_of(watched), expected, got)
    if text:
        found.fail(f"{when}: {text}")


def _to_json(value: Value) -> Value:
    """Return a float as hexadecimal text, equal to the last bit; other values as they are."""
    return f"float {value.hex()}" if isinstance(value, float) else value


def _from_json(value: Value) -> Value:
    return float.fromhex(value[6:]) if isinstance(value, str) and value.startswith("float ") else value
