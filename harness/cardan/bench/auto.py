"""``coupling = "auto"`` on the shipped scenes: does it deliver the tolerance that it is given?"""

from __future__ import annotations

import numpy as np

from cardan.bench.records import Options, Record, Tables, Tell
from cardan.result import Result
from cardan.scenario import Scenario
from cardan.simulation import simulate

# Long scenes are cut after their liveliest part: the pickup's launch and first shift, the engine's way through the
# resonance. The whole schedule begins as the short one does.
CUT: dict[str, dict[str, float]] = {
    "pickup_udds": {"scene.stop_time": 26.0, "scene.communication_step": 0.05},
    "propshaft_highspeed": {"scene.stop_time": 0.5},
    "engine_start": {"scene.stop_time": 1.5, "scene.communication_step": 5e-3},
}
LEFT_OUT = ("pickup_udds_full",)
FINER = 0.05  # tolerance of the reference over the tightest one measured
METERS = ("energy.residual",)  # says how exact the run was: no quantity of the motion


def measure(options: Options, tell: Tell) -> Tables:
    """Return the table ``auto``: scene, tolerance, worst error over all recorded quantities."""
    names = [name for name in Scenario.shipped() if name not in LEFT_OUT]
    tolerances = [float(f"1e-{exponent}") for exponent in ((3, 6) if options.quick else range(3, 9))]
    records: list[Record] = []
    for number, name in enumerate(names):
        runs = len(tolerances) + 1
        reference = _run(name, FINER * tolerances[-1])
        for place, tolerance in enumerate(tolerances):
            result = _run(name, tolerance)
            error, where = worst(result, reference)
            records.append({"scene": name, "tolerance": tolerance, "error": error, "quantity": where,
                            "over_tolerance": error / tolerance, "fmu_steps": result.info.steps,
                            "simulated_s": result.info.reached_time,
                            "ms_per_s": 1e3 * result.info.processor_time / result.info.reached_time})
            tell((number + (place + 2) / runs) / len(names))
    return {"auto": records}


def _run(name: str, tolerance: float) -> Result:
    changes = {"scene.coupling": "auto", "scene.tolerance": tolerance, **CUT.get(name, {})}
    return simulate(Scenario.load(name).with_overrides(changes))


def worst(result: Result, reference: Result) -> tuple[float, str]:
    """Return the largest error over all recorded quantities, relative to each one's largest value, and whose it is."""
    found = (0.0, "")
    for name, exact in reference.columns.items():
        size = float(np.abs(exact).max())
        if name in METERS or size == 0.0:
            continue
        error = float(np.abs(result[name] - exact).max()) / size
        found = max(found, (error, name))
    return found
