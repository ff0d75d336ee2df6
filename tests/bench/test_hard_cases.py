"""The hard cases: every property of every case holds, and no number is missing."""

import pytest
from cardan.bench.hard_cases import CASES


def test_all_eighteen_are_there():
    assert sorted(CASES) == list(range(1, 19))


@pytest.mark.parametrize("number", sorted(CASES))
def test_hard_case(number):
    outcomes = list(CASES[number].measure())
    assert outcomes
    for outcome in outcomes:
        assert outcome.held, f"{outcome.detail}: {outcome.measured:.3g} {outcome.unit}, bound {outcome.bound:.3g}"
