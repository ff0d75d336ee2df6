"""Dynamics against the independent high-precision model in tests/reference (34 and 44 digits).

At tolerance 1e-9 over one second: angles within 1e-8 rad and speeds within 1e-6 rad/s, for every case, at
communication steps of 1 ms and, since every law is exact between the points, of 50 ms.
"""

import cardan_kernel
import pytest

from tests.kernel.runs import start
from tests.reference.cases import CASES
from tests.reference.table import load

BOUNDS = {"rad": 1e-8, "rad/s": 1e-6}
CREATED = [name for name in CASES if name != "hill"]


def follow(kernel, case, table, step, tolerance=1e-9, samples=10):
    """Run a case; returns the largest error of each column that is a variable of the FMU."""
    first = table.row(0)
    inputs = case.inputs(0.0, first["input.speed"], first["output.speed"])
    driveline = start(kernel, {**case.parameters, **inputs}, tolerance)
    errors = {}
    per_sample = round(0.1 / step)
    for sample in range(samples + 1):
        row = table.row(sample)
        for name in table.columns:
            if name in cardan_kernel.INDEX:
                errors[name] = max(errors.get(name, 0.0), abs(driveline.get(name) - row[name]))
        if sample == samples:
            break
        for i in range(per_sample):
            t = (sample * per_sample + i) * step
            for name, value in case.inputs(t, driveline.get("input.speed"), driveline.get("output.speed")).items():
                driveline.set(name, value)
            assert driveline.do_step(t, step), driveline.last_error
    return errors


@pytest.mark.parametrize("step", [1e-3, 0.05])
@pytest.mark.parametrize("name", CREATED)
def test_case(name, step):
    table = load(name)
    errors = follow(cardan_kernel.Driveline, CASES[name], table, step)
    assert {"input.angle", "output.angle", "input.speed", "output.speed"} <= set(errors)
    for column, error in errors.items():
        unit = table.units[column]
        if unit in BOUNDS:
            assert error < BOUNDS[unit], f"{column}: {error:.2e} {unit}"


@pytest.mark.parametrize("name", ["spatial", "crossed_inertia", "rigid_double", "moving_angle"])
def test_error_follows_tolerance(name):
    """Two decades of tolerance are at least one decade of error, down to 1e-12."""
    case, table = CASES[name], load(name)
    errors = [follow(cardan_kernel.Driveline, case, table, 0.1, tolerance)["input.speed"]
              for tolerance in (1e-6, 1e-8, 1e-10, 1e-12)]
    for loose, tight in zip(errors, errors[1:]):
        assert tight < 0.1 * loose
    assert errors[-1] < 1e-8


def test_interpreted_kernel_on_a_short_run():
    """The first tenth of a second of the spatial case with the interpreted kernel."""
    errors = follow(cardan_kernel.Interpreted, CASES["spatial"], load("spatial"), 0.05, samples=1)
    assert errors["input.angle"] < 1e-8
    assert errors["input.speed"] < 1e-6
