"""Coupling schemes: error against communication step and processor time, and the orders that come out."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from cardan.bench.coupled_run import Outcome, Study
from cardan.bench.records import Options, Record, Tables, Tell
from cardan.bench.systems import COUPLED
from cardan.bench.timing import figure
from cardan.coupling import SCHEMES
from cardan.instance import Instance

Floats = NDArray[np.float64]

FIXED = ("held", "gauss-seidel", "linear", "slope", "hermite3", "hermite5", "iterated")
CONTROLLED = ("adaptive", "auto")
TOLERANCE = 1e-12  # of the FMU, so that the coupling alone makes the error

# An order is fitted where the error follows it: below the steps that are too long for the motion (the ripple has
# 100 Hz) and above the rounding of the reference.
LONGEST, SMALLEST_ERROR, LARGEST_ERROR = 2.1e-3, 1e-11, 1e-2
GOAL = 1e-6


def measure(options: Options, tell: Tell) -> Tables:
    """Return the tables ``coupling`` (fixed steps), ``controlled`` (by tolerance) and ``orders``."""
    from cardan_build import default_fmu

    fixed: list[Record] = []
    controlled: list[Record] = []
    tolerances = [float(f"1e-{exponent}") for exponent in (range(3, 9, 2) if options.quick else range(3, 9))]
    repeats = 1 if options.quick else 3
    with Instance(default_fmu()) as instance:
        for number, case in enumerate(COUPLED):
            study = Study(instance, case)
            rates = case.rates[2:5] if options.quick else case.rates
            jobs = [(scheme, rate, TOLERANCE) for rate in rates for scheme in FIXED]
            jobs += [(scheme, case.rates[0], tolerance) for tolerance in tolerances for scheme in CONTROLLED]
            found: dict[tuple[str, int, float], list[Outcome]] = {job: [] for job in jobs}
            for turn in range(repeats):
                for job in jobs:
                    found[job].append(study.run(*job))
                tell((number + (turn + 1) / repeats) / len(COUPLED))
            for (scheme, rate, tolerance), outcomes in found.items():
                time = figure([outcome.processor for outcome in outcomes]) * (1e3 / case.stop_time)
                error = outcomes[0].error if math.isfinite(outcomes[0].error) else None
                record: Record = {"case": case.name, "scheme": scheme, "step_ms": 1e3 / rate, "error": error,
                                  "ms_per_s": time.median, "low": time.low, "high": time.high,
                                  "fmu_steps": outcomes[0].steps}
                if scheme in FIXED:
                    fixed.append(record)
                else:
                    controlled.append({"tolerance": tolerance, **record})
    return {"coupling": fixed, "controlled": controlled, "orders": orders(fixed)}


def orders(records: list[Record]) -> list[Record]:
    """Fit the order of each scheme in each case, and find step and processor time for an error of 1e-6.

    Parameters
    ----------
    records : list of dict
        The table ``coupling``.

    Returns
    -------
    list of dict
        ``order`` as the scheme states it, ``fitted`` (None: fewer than two points), ``points`` that were fitted,
        ``step_ms`` and ``ms_per_s`` for the goal, ``measured`` False where they lie outside the measured steps.
    """
    table = []
    for case in dict.fromkeys(record["case"] for record in records):
        for scheme in FIXED:
            rows = [record for record in records if (record["case"], record["scheme"]) == (case, scheme)]
            rows = [row for row in rows if row["error"] is not None]
            steps = np.array([row["step_ms"] for row in rows])
            errors = np.array([row["error"] for row in rows])
            good = (steps < 1e3 * LONGEST) & (errors > SMALLEST_ERROR) & (errors < LARGEST_ERROR)
            fitted = None
            if good.sum() > 1:
                fitted = float(np.polyfit(np.log(steps[good]), np.log(errors[good]), 1)[0])
            step = cost = None
            inside = False
            if len(rows) > 1:
                inside = bool(errors.min() <= GOAL <= errors.max())
                step = _step_for_goal(errors, steps, SCHEMES[scheme].order)
                cost = _cost_of_step(step, steps, np.array([row["ms_per_s"] for row in rows]))
            table.append({"case": case, "scheme": scheme, "order": SCHEMES[scheme].order, "fitted": fitted,
                          "points": int(good.sum()), "step_ms": step, "ms_per_s": cost, "measured": inside})
    return table


def _step_for_goal(errors: Floats, steps: Floats, order: int) -> float:
    """Interpolate the step to the goal, both logarithmic; outside the measured steps the scheme's order tells it."""
    ranks = np.argsort(errors)
    errors, steps = errors[ranks], steps[ranks]
    for near in (0, -1):
        if (errors[near] > GOAL) == (near == 0):
            return float(steps[near] * (GOAL / errors[near]) ** (1.0 / order))
    return float(np.exp(np.interp(np.log(GOAL), np.log(errors), np.log(steps))))


def _cost_of_step(step: float, steps: Floats, costs: Floats) -> float:
    """Interpolate the processor time to a step; it goes with the number of steps outside the measured ones."""
    ranks = np.argsort(steps)
    within = float(np.clip(step, steps.min(), steps.max()))
    return float(np.exp(np.interp(np.log(within), np.log(steps[ranks]), np.log(costs[ranks]))) * within / step)
