"""Exact Jacobians against high-precision differences of the independent model (tests/reference/jacobian.json)."""

import json

import pytest
from cardan_kernel import JACOBIAN_INPUTS, JACOBIAN_OUTPUTS, JACOBIAN_STATES

from tests.kernel.runs import start
from tests.reference.table import FOLDER

POINTS = json.loads((FOLDER / "jacobian.json").read_text(encoding="ascii"))["points"]


NAMES = {"p": "input.angle", "twist": "shaft.twist", "w1": "input.speed", "wy": "shaft.speed_b",
         # with the speed prescribed, the speed and its rate are inputs
         "input.speed_command": "input.speed", "input.speed_command.der1": "input.acceleration"}
DIRECTIONS = [*JACOBIAN_STATES, *JACOBIAN_INPUTS]


def pick(by_states, by_inputs, rows, names):
    """Rows of [by_states, by_inputs] with the columns of the directions `names`."""
    columns = [DIRECTIONS.index(NAMES.get(name, name)) for name in names]
    return [[(by_states[i] + by_inputs[i])[j] for j in columns] for i in rows]


def compare(found, wanted, what):
    """Entries to 1e-9 of the row's largest: rounding of the kernel's sums, not of the differences."""
    for row, (mine, theirs) in enumerate(zip(found, wanted, strict=True)):
        scale = max([abs(v) for v in theirs] + [1e-3])
        for column, (a, b) in enumerate(zip(mine, theirs, strict=True)):
            assert abs(a - b) < 1e-9 * scale, (what, row, column, a, b)


@pytest.mark.parametrize("place", range(len(POINTS)), ids=lambda i: f"{i}-{POINTS[i]['case']}")
def test_point(kernel, place):
    point = POINTS[place]
    driveline = start(kernel, {**point["parameters"], **point["inputs"]})
    a, b, c, d = driveline.jacobian()
    states = [JACOBIAN_STATES.index(NAMES[name]) for name in point["states"]]
    outputs = [JACOBIAN_OUTPUTS.index(name) for name in point["outputs"]]
    compare(pick(a, b, states, point["states"]), point["A"], "A")
    compare(pick(a, b, states, point["by"]), point["B"], "B")
    compare(pick(c, d, outputs, point["states"]), point["C"], "C")
    compare(pick(c, d, outputs, point["by"]), point["D"], "D")
    for name, value in zip(point["outputs"], point["values"], strict=True):
        assert driveline.get(name) == pytest.approx(value, rel=1e-10, abs=1e-9), name
