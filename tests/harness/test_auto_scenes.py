"""``auto`` delivers the scene's tolerance on every shipped scene: each output within ten times of it.

Errors are the largest over the run, relative to the largest value of the output, against a run at 5e-10. Long scenes
are cut after their liveliest part (the pickup's launch and first shift). ``energy.residual`` is itself an error.
"""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest
from cardan import Result, Scenario, simulate

CUT = {"pickup_udds": {"scene.stop_time": 26.0, "scene.communication_step": 0.05},
       "pickup_udds_full": {"scene.stop_time": 26.0, "scene.communication_step": 0.05},
       "propshaft_highspeed": {"scene.stop_time": 0.5},
       "engine_start": {"scene.stop_time": 1.5, "scene.communication_step": 5e-3}}


@cache
def run(name: str, tolerance: float) -> Result:
    changes = {"scene.coupling": "auto", "scene.tolerance": tolerance, **CUT.get(name, {})}
    return simulate(Scenario.load(name).with_overrides(changes))


@pytest.mark.parametrize("tolerance", [1e-3, 1e-5, 1e-8])
@pytest.mark.parametrize("name", Scenario.shipped())
def test_tolerance_is_delivered(name: str, tolerance: float) -> None:
    exact, result = run(name, 5e-10), run(name, tolerance)
    assert result.info.completed
    assert result.info.note == ""
    for output, values in exact.columns.items():
        largest = float(np.abs(values).max())
        if output != "energy.residual" and largest > 0.0:
            error = float(np.abs(result[output] - values).max()) / largest
            assert error < 10.0 * tolerance, f"{output}: {error:.2e}"
