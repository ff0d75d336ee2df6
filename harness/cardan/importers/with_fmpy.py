"""FMPy (Dassault Systemes, ctypes): what the others are compared with."""

from __future__ import annotations

import shutil
from typing import Any

from cardan.importers.scene import by_type

TOOL = "FMPy"
DISTRIBUTION = "fmpy"


def run(job: dict[str, Any]) -> list[list[float]]:
    """Run the scene; return the outputs after each step."""
    return play(job, "")


def play(job: dict[str, Any], prefix: str) -> list[list[float]]:
    """Run the scene in FMPy's slave.

    Parameters
    ----------
    job : dict
        From `cardan.importers.scene.job`.
    prefix : str
        What an FMU that contains the driveline puts before the names of its parameters.
    """
    from fmpy import extract, read_model_description
    from fmpy.fmi2 import FMU2Slave

    described = read_model_description(job["fmu"])
    known = {variable.name: variable.valueReference for variable in described.modelVariables}

    def references(names: Any) -> list[int]:
        return [known[name] if name in known else known[prefix + name] for name in names]

    def send(values: dict[str, Any]) -> None:
        for call, part in zip((slave.setReal, slave.setInteger, slave.setBoolean), by_type(values)):
            if part:
                call(references(part), list(part.values()))

    unpacked = extract(job["fmu"])
    slave = FMU2Slave(guid=described.guid, unzipDirectory=unpacked, instanceName="driveline",
                      modelIdentifier=described.coSimulation.modelIdentifier)
    slave.instantiate()
    slave.setupExperiment(startTime=0.0)
    send(job["starts"])
    slave.enterInitializationMode()
    slave.exitInitializationMode()
    outputs = references(job["outputs"])
    rows = []
    for step in range(job["count"]):
        send(job["changes"].get(str(step), {}))
        slave.doStep(currentCommunicationPoint=step * job["step"], communicationStepSize=job["step"])
        rows.append([float(value) for value in slave.getReal(outputs)])
    slave.terminate()
    slave.freeInstance()
    shutil.rmtree(unpacked, ignore_errors=True)
    return rows
