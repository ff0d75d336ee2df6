"""The FMU itself, through FMI, against the independent high-precision references in tests/reference.

At tolerance 1e-9 over one second: angles within 1e-8 rad, speeds within 1e-6 rad/s, in every case: single, double,
spatial, with cross inertia, damped, frictional, speed-driven, with moving angles, rigid and compliant.
"""

from __future__ import annotations

from pathlib import Path

import pytest
from cardan import Instance

from tests.reference.cases import CASES
from tests.reference.table import load

BOUNDS = {"rad": 1e-8, "rad/s": 1e-6}
STEP = 0.01


@pytest.mark.parametrize("name", list(CASES))
def test_case_through_the_fmu(name: str, fmu: Path) -> None:
    case, table = CASES[name], load(name)
    first = table.row(0)
    with Instance(fmu) as instance:
        known = instance.description.variables
        compared = [column for column in table.columns if column in known and table.units[column] in BOUNDS]
        assert {"input.angle", "output.angle", "input.speed", "output.speed"} <= set(compared)
        values = {**case.parameters, **case.inputs(0.0, first["input.speed"], first["output.speed"])}
        for variable, value in values.items():
            instance.set(variable, int(value) if known[variable].type == "Integer" else value)
        instance.setup(0.0, 1.0, tolerance=1e-9)
        instance.initialize()
        for sample in range(11):
            row = table.row(sample)
            for column in compared:
                error = abs(float(instance.get(column)) - row[column])
                assert error < BOUNDS[table.units[column]], f"{column} at {sample / 10} s: {error:.2e}"
            if sample == 10:
                break
            for i in range(10):
                t = (10 * sample + i) * STEP
                inputs = case.inputs(t, float(instance.get("input.speed")), float(instance.get("output.speed")))
                for variable, value in inputs.items():
                    instance.set(variable, value)
                instance.step(t, STEP)
