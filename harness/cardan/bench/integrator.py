"""Work and precision of the integrator: error against right-hand sides and processor time."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import partial
from math import radians
from typing import Any

import numpy as np
from cardan_kernel import Driveline

from cardan.bench.records import Options, Record, Tables, Tell
from cardan.bench.systems import ORDINARY, RESISTANCE, TORQUE
from cardan.bench.timing import clocked, figure, interleaved, repeated

FINEST = 1e-13
WATCHED = ("input.speed", "output.speed", "shaft.torque")


@dataclass(frozen=True)
class Case:
    """A driveline under constant inputs, driven in process.

    Attributes
    ----------
    name, title : str
        What it is called.
    values : mapping of str to float
        Parameters and inputs of the driveline, SI.
    span, step : float
        Simulated time and communication step, s.
    """

    name: str
    title: str
    values: Mapping[str, float]
    span: float = 0.5
    step: float = 1e-2


_PUSHED = {**ORDINARY, "input.torque": TORQUE, "output.torque": RESISTANCE}
CASES = (
    Case("ordinary", "20/15 deg, 3000 rpm", _PUSHED),
    Case("bent", "45/40 deg, 3000 rpm", {**_PUSHED, "joint1.angle": radians(45), "joint2.angle": radians(40)}),
    Case("fast", "45/45 deg, 20 000 rpm", {**_PUSHED, "joint1.angle": radians(45), "joint2.angle": radians(45),
                                           "initial.speed": 2094.4}, 0.1, 2e-3),
    Case("limit", "85 deg, 100 rad/s, J3 = 0.02 kg.m2",
         {**ORDINARY, "joint1.angle": radians(85), "joint2.angle": 0.0, "initial.speed": 100.0, "output.inertia": 0.02,
          "input.torque": 20.0, "output.torque": 2.0}),
    Case("hard spring", "k = 1e7 N.m/rad", {**_PUSHED, "shaft.stiffness": 1e7}, 0.2),
    Case("rigid limit", "k = 1e9 N.m/rad, d = 2000 N.m.s/rad",
         {**_PUSHED, "shaft.stiffness": 1e9, "shaft.damping": 2000.0}, 0.02, 2e-3),
    Case("friction", "reversal, 5 N.m Coulomb friction in both joints",
         {**_PUSHED, "initial.speed": 10.0, "input.torque": -100.0, "output.torque": 0.0,
          "joint1.trunnion.friction": 5.0, "joint2.trunnion.friction": 5.0}),
)


def measure(options: Options, tell: Tell) -> Tables:
    """Return the table ``integrator``: one record per case and tolerance.

    The reference is the kernel itself at its finest tolerance (tests compare it with independent ones); ``floor`` is
    what two such references with different communication steps differ by, below which no error can be told.
    """
    exponents = range(3, 13, 3) if options.quick else range(3, 13)
    records: list[Record] = []
    for number, case in enumerate(CASES):
        exact, _ = run(case, FINEST, case.step / 4)
        floor = error(run(case, FINEST, case.step)[0], exact)
        tolerances = [float(f"1e-{exponent}") for exponent in exponents]
        found = {tolerance: run(case, tolerance, case.step) for tolerance in tolerances}
        jobs = {str(tolerance): repeated(clocked(partial(start_and_go, case, tolerance))) for tolerance in tolerances}
        samples = interleaved(jobs, options.repeats)
        for tolerance in tolerances:
            outputs, counted = found[tolerance]
            time = figure(samples[str(tolerance)]) * (1e3 / case.span)
            records.append({"case": case.name, "title": case.title, "tolerance": tolerance,
                            "error": error(outputs, exact), "floor": floor, "rhs_per_ms": counted / (1e3 * case.span),
                            "ms_per_s": time.median, "low": time.low, "high": time.high})
        tell((number + 1) / len(CASES))
    return {"integrator": records}


def start_and_go(case: Case, tolerance: float, kernel: Any = Driveline, step: float | None = None) -> Any:
    """Return a driveline that has gone through the case, or raise a `RuntimeError` with its text."""
    driveline = started(case.values, tolerance, kernel)
    h = step or case.step
    for i in range(round(case.span / h)):
        if not driveline.do_step(i * h, h):
            raise RuntimeError(driveline.last_error)
    return driveline


def started(values: Mapping[str, float], tolerance: float, kernel: Any = Driveline) -> Any:
    """Return an initialized driveline of a kernel class."""
    driveline = kernel()
    driveline.setup_experiment(0.0, None, tolerance)
    driveline.enter_initialization_mode()
    for name, value in values.items():
        driveline.set(name, value)
    driveline.exit_initialization_mode()
    return driveline


def run(case: Case, tolerance: float, step: float) -> tuple[np.ndarray[Any, Any], float]:
    """Return the watched outputs at the case's communication points, shape (points, 3), and the right-hand sides."""
    driveline = started(case.values, tolerance)
    every = round(case.step / step)
    rows = []
    for i in range(round(case.span / step)):
        if not driveline.do_step(i * step, step):
            raise RuntimeError(driveline.last_error)
        if (i + 1) % every == 0:
            rows.append([driveline.get(name) for name in WATCHED])
    return np.array(rows), driveline.get("solver.evaluations")


def error(outputs: np.ndarray[Any, Any], exact: np.ndarray[Any, Any]) -> float:
    """Return the largest error over all points and outputs, each relative to the output's largest value."""
    return float((np.abs(outputs - exact) / np.abs(exact).max(axis=0)).max())
