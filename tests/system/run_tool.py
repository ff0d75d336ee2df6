"""Runs a system package in a tool that is not ours; started by the tests in a process of its own.

``python run_tool.py`` reads a job from standard input and writes rows, or why there are none, to ``job["answer"]``.
Row n holds the variables after n + 1 steps.
"""

from __future__ import annotations

import json
import os
import sys
from pathlib import Path
from typing import Any


def in_fmpy(job: dict[str, Any]) -> list[list[float]]:
    from fmpy.ssp.simulation import simulate_ssp

    # It steps while its own sum of steps is below the stop time.
    found = simulate_ssp(job["ssp"], stop_time=(job["count"] - 0.5) * job["step"], step_size=job["step"])
    return [[float(row[name]) for name in job["names"]] for row in found]


def in_ecos(job: dict[str, Any]) -> list[list[float]]:
    from ecospy import EcosLib, EcosSimulation

    EcosLib.set_log_level("warn")
    rows = []
    with EcosSimulation(ssp_path=job["ssp"], step_size=job["step"]) as simulation:
        if not simulation.init(parameter_set="scene"):
            raise RuntimeError(EcosLib.get_last_error())
        for _ in range(job["count"]):
            simulation.step()
            rows.append([simulation.get_real(name.replace(".", "::", 1)) for name in job["names"]])
        simulation.terminate()
    return rows


def in_libcosim(job: dict[str, Any]) -> list[list[float]]:
    from libcosimpy.CosimExecution import CosimExecution
    from libcosimpy.CosimLogging import CosimLogLevel, log_output_level
    from libcosimpy.CosimObserver import CosimObserver

    log_output_level(CosimLogLevel.WARNING)
    # Without a step it takes the one that the package names, in an annotation of the default experiment.
    step = None if job["step"] == 1e-3 else round(1e9 * job["step"])
    execution = CosimExecution.from_ssp_file(job["ssp"], step)
    observer = CosimObserver.create_last_value()
    execution.add_observer(observer)
    known = {}
    for slave in execution.slave_infos():
        for variable in execution.slave_variables(slave.index):
            known[f"{slave.name.decode()}.{variable.name.decode()}"] = (slave.index, variable.reference)
    rows = []
    for _ in range(job["count"]):
        if not execution.step():
            raise RuntimeError("a step was not done")
        rows.append([observer.last_real_values(known[name][0], [known[name][1]])[0] for name in job["names"]])
    return rows


def main() -> None:
    job = json.load(sys.stdin)
    try:
        answer: dict[str, Any] = {"rows": globals()[f"in_{job['tool']}"](job)}
    except ImportError as error:
        answer = {"skipped": f"{job['tool']} is not installed: {error}"}
    except OSError as error:
        if "libtbb" not in str(error):
            raise
        answer = {"skipped": f"ecospy needs libtbb12: {error}"}
    Path(job["answer"]).write_text(json.dumps(answer), encoding="utf-8")
    sys.stdout.flush()
    os._exit(0)


if __name__ == "__main__":
    main()
