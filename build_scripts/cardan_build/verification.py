"""Runs a finished FMU once in a clean process that knows neither the repository nor the installed kernel."""

from __future__ import annotations

import json
import os
import sys
from pathlib import Path
from typing import Any

# Names that must not be taken from the host: the FMU brings its own under others.
HOST_MODULES = ("cardan_kernel", "cardan_slave", "pythonfmu")
LOG_CATEGORY = "logAll"


def verify(job: dict[str, Any]) -> None:
    """Check the description, step once, and print a JSON object with ``kernel`` and ``problems``.

    Parameters
    ----------
    job : dict
        ``fmu``, the file, and ``unpack``, an empty directory.
    """
    for name in HOST_MODULES:
        sys.modules[name] = None  # type: ignore[assignment]  # importing it now fails
    report = _run(Path(job["fmu"]), Path(job["unpack"]))
    print(json.dumps(report), flush=True)
    os._exit(0)  # an interpreter that ran a pythonfmu FMU sometimes aborts at exit (docs/FMI.md, trap 11)


def _run(fmu: Path, unpack: Path) -> dict[str, Any]:
    from fmpy import extract, read_model_description
    from fmpy.validation import validate_fmu

    problems = [str(each) for each in validate_fmu(str(fmu))]
    if problems:
        return {"problems": problems, "kernel": ""}
    described = read_model_description(str(fmu))
    extract(str(fmu), str(unpack))
    messages, output = _step(described, unpack)
    kernel = next((text.split(": ")[1].split(" ")[0] for text in messages if " kernel" in text), "")
    if not kernel:
        problems.append(f"no message tells which kernel runs; messages: {messages}")
    if not output > 0.0:
        problems.append(f"output.speed is {output!r} after a step with a driving torque; messages: {messages}")
    problems += [f"the host's {name} was imported" for name in HOST_MODULES if sys.modules[name] is not None]
    return {"problems": problems, "kernel": kernel}


def _step(described: Any, unpack: Path) -> tuple[list[str], float]:
    """Texts of the log and output.speed after a step of 1 ms at 10 N.m."""
    from fmpy import calloc, free
    from fmpy.fmi2 import (
        FMU2Slave,
        fmi2CallbackAllocateMemoryTYPE,
        fmi2CallbackFreeMemoryTYPE,
        fmi2CallbackFunctions,
        fmi2CallbackLoggerTYPE,
    )

    messages: list[str] = []
    callbacks = fmi2CallbackFunctions()
    callbacks.logger = fmi2CallbackLoggerTYPE(lambda *arguments: messages.append(arguments[4].decode()))
    callbacks.allocateMemory = fmi2CallbackAllocateMemoryTYPE(calloc)
    callbacks.freeMemory = fmi2CallbackFreeMemoryTYPE(free)
    reference = {variable.name: variable.valueReference for variable in described.modelVariables}
    slave = FMU2Slave(guid=described.guid, unzipDirectory=str(unpack), instanceName="verification",
                      modelIdentifier=described.coSimulation.modelIdentifier)
    slave.instantiate(callbacks=callbacks, loggingOn=True)
    slave.setupExperiment(startTime=0.0)
    slave.enterInitializationMode()
    slave.setReal([reference["input.torque"]], [10.0])
    slave.exitInitializationMode()
    slave.doStep(currentCommunicationPoint=0.0, communicationStepSize=1e-3)
    output = slave.getReal([reference["output.speed"]])[0]
    slave.terminate()
    slave.freeInstance()
    return messages, float(output)
