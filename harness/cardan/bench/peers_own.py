"""The ways of this project to solve what the peers solve."""

from __future__ import annotations

import time
from typing import Any

import cardan_kernel
import numpy as np

from cardan.bench.coupled_run import Study
from cardan.bench.monolithic import Array
from cardan.bench.peers import POINTS, Peer, Solution
from cardan.bench.systems import ORDINARY, RESISTANCE, TORQUE
from cardan.instance import Instance

FINE = np.linspace(0.0, 1.0, 1001)
RATES = (500.0, 800.0, 1000.0, 1250.0, 2000.0, 2500.0)  # communication steps per second
COUPLING = "hermite5"
UNDER = 1e-8  # tolerance of the FMU below the coupling's error of 1e-6

BASES = {"kernel": "compiled kernel in process", "fmu_10ms": "FMU, 10 ms steps", "fmu_1ms": "FMU, 1 ms steps",
         "coupled": f"FMU, {COUPLING}, engine and load outside"}


def kernel_peers() -> list[Peer]:
    """Return the bare kernel called in process: compiled, where there is one, and interpreted."""
    found = [_kernel_peer("interpreted kernel in process", cardan_kernel.Interpreted)]
    if cardan_kernel.Compiled is not None:
        found.insert(0, _kernel_peer(BASES["kernel"], cardan_kernel.Compiled))
    return found


def _kernel_peer(name: str, kernel: Any) -> Peer:
    times = POINTS.tolist()
    spans = list(zip(times, np.diff(POINTS).tolist()))
    references = [cardan_kernel.INDEX["input.speed"], cardan_kernel.INDEX["output.speed"]]

    def solve(tolerance: float) -> Solution:
        driveline = kernel()
        driveline.setup_experiment(0.0, None, tolerance)
        driveline.enter_initialization_mode()
        for key, value in {**ORDINARY, "input.torque": TORQUE, "output.torque": RESISTANCE}.items():
            driveline.set(key, value)
        driveline.exit_initialization_mode()
        begin = time.process_time()
        rows = [driveline.get_real(references)]
        for t, h in spans:
            driveline.do_step(t, h)
            rows.append(driveline.get_real(references))
        seconds = time.process_time() - begin
        return Solution(POINTS, np.array(rows).T, seconds, driveline.get("solver.evaluations"))

    return Peer(name, solve)


def fmu_peers(instance: Instance) -> list[Peer]:
    """Return the FMU stepped at 10 ms and at 1 ms: two inputs sent and five outputs read at each point."""
    inputs = instance.plan(["input.torque", "output.torque"])
    outputs = instance.plan(["input.speed", "output.speed", "input.angle", "output.angle", "shaft.torque"])

    def peer(name: str, points: Array) -> Peer:
        times = points.tolist()
        spans = list(zip(times, np.diff(points).tolist()))

        def solve(tolerance: float) -> Solution:
            instance.reset()
            for key, value in ORDINARY.items():
                instance.set(key, value)
            inputs.values[0], inputs.values[1] = TORQUE, RESISTANCE
            inputs.write()
            instance.setup(0.0, float(points[-1]), tolerance)
            instance.initialize()
            values, write, step, read = inputs.values, inputs.write, instance.step, outputs.read
            seen = read()
            first, second = [seen[0]], [seen[1]]
            begin = time.process_time()
            for t, h in spans:
                values[0], values[1] = TORQUE, RESISTANCE
                write()
                step(t, h)
                seen = read()
                first.append(seen[0])
                second.append(seen[1])
            seconds = time.process_time() - begin
            evaluations = float(instance.get("solver.evaluations"))
            return Solution(points, np.array([first, second]), seconds, evaluations)

        return Peer(name, solve)

    return [peer(BASES["fmu_10ms"], POINTS), peer(BASES["fmu_1ms"], FINE)]


def coupled_peer(study: Study) -> Peer:
    """Return the harness with engine and load outside the FMU; its setting is the communication rate, 1/s."""

    def solve(rate: float) -> Solution:
        run = study.run(COUPLING, round(rate), UNDER)
        return Solution(np.linspace(0.0, study.case.stop_time, run.speeds.shape[1]), run.speeds, run.processor, None)

    return Peer(BASES["coupled"], solve, settings=RATES)
