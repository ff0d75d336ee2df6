"""``coupling = "auto"`` on the shipped scenes: does it deliver the tolerance that it is given?"""

from __future__ import annotations

import numpy as np

from cardan.bench.records import Options, Record, Tables, Tell
from cardan.result import Result
from cardan.scenario import Scenario
from cardan.simulation import simulate

# Lengths that fit into a report of a few minutes: the first launch of the pickup is in them, and the resonance that
# the engine passes at its start.
LENGTHS = {"pickup_udds": 26.0, "pickup_udds_full": None, "propshaft_highspeed": 0.3}
FINER = 0.1  # tolerance of the reference over the tightest one measured
METERS = ("energy.residual",)  # says how exact the run was: no quantity of the motion


def measure(options: Options, tell: Tell) -> Tables:
    """Return the table ``auto``: scene, tolerance, worst error over all recorded quantities."""
    names = [name for name in Scenario.shipped() if LENGTHS.get(name, 0.0) is not None]
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
    changes = {"scene.coupling": "auto", "scene.tolerance": tolerance}
    scenario = Scenario.load(name)
    if LENGTHS.get(name):
        changes["scene.stop_time"] = LENGTHS[name]
    return simulate(scenario.with_overrides(changes))


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
