"""Values that checks draw stay allowed, whatever a model description declares."""

from __future__ import annotations

import random
from types import SimpleNamespace
from typing import Any

from cardan.check.accuracy import MEET, uneven
from cardan.check.excitation import Excitation
from cardan.check.quantities import drawn, limits, moved, start
from cardan.check.subject import Experiment, Options
from hypothesis import given
from hypothesis import strategies as st

NUMBERS = st.floats(-1e6, 1e6, allow_nan=False)


class Variable(SimpleNamespace):
    """A variable as FMPy has it: told apart by identity."""

    __hash__ = object.__hash__  # type: ignore[assignment]
    __eq__ = object.__eq__


@st.composite
def reals(draw: st.DrawFn) -> Any:
    """Real variables with or without limits and nominal, their start inside."""
    low, high = sorted((draw(NUMBERS), draw(NUMBERS)))
    first = draw(st.floats(low, high))
    nominal = draw(st.none() | st.floats(1e-6, 1e6))
    return Variable(
        name="x", type="Real", declaredType=None, start=repr(first), causality="input", variability="continuous",
        min=draw(st.sampled_from([None, repr(low)])), max=draw(st.sampled_from([None, repr(high)])),
        nominal=None if nominal is None else repr(nominal))


@given(variable=reals(), seed=st.integers(0, 1000))
def test_drawn_and_moved_values_are_inside_the_limits(variable: Any, seed: int) -> None:
    low, high = limits(variable)
    value = drawn(variable, random.Random(seed))
    assert value is not None and low <= float(value) <= high
    for base in (value, start(variable)):
        assert base is not None
        other = moved(variable, base)
        if other is None:
            assert low == high
        else:
            assert other != base or low == high
            assert low <= float(other) <= high


@given(variable=reals(), time=st.floats(0.0, 10.0))
def test_signals_are_inside_the_limits_and_repeatable(variable: Any, time: float) -> None:
    subject: Any = SimpleNamespace(having=lambda *_, **__: [variable], options=Options(),
                                   experiment=Experiment(0.0, 10.0, 0.1, None))
    low, high = limits(variable)
    values = [Excitation(subject).at(time)[variable] for _ in range(2)]
    assert values[0] == values[1]
    assert low <= float(values[0]) <= high


@given(blocks=st.integers(1, 20), step=st.floats(1e-4, 1.0), begin=st.floats(-10.0, 10.0), seed=st.integers(0, 100))
def test_uneven_points_meet_the_even_ones(blocks: int, step: float, begin: float, seed: int) -> None:
    times = uneven(begin, step, MEET * blocks, seed)
    lengths = [b - a for a, b in zip(times, times[1:])]
    assert all(0.15 * step < length < 2.3 * step for length in lengths)
    assert {begin + block * MEET * step for block in range(1, blocks + 1)} <= set(times)


def test_choices_move_to_their_neighbours() -> None:
    items = [SimpleNamespace(value="1"), SimpleNamespace(value="2")]
    kind = SimpleNamespace(items=items, min=None, max=None, unit=None)
    choice: Any = SimpleNamespace(name="c", type="Enumeration", declaredType=kind, start="2", min=None, max=None)
    assert limits(choice) == (1, 2)
    assert moved(choice, 2) == 1
    assert moved(choice, 1) == 2
    flag: Any = SimpleNamespace(name="f", type="Boolean", declaredType=None, start="true", min=None, max=None)
    assert start(flag) is True
    assert moved(flag, True) is False
    text: Any = SimpleNamespace(name="t", type="String", declaredType=None, start="file.txt", min=None, max=None)
    assert moved(text, "file.txt") is None
