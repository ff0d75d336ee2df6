"""Runs the FMUs of a package once, each by its own rules, in a clean process; checks the package's XML."""

from __future__ import annotations

import io
import json
import math
import os
import subprocess
import sys
import tempfile
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from .. import BuildError
from ..sources import find_package

_CHILD = "import json, sys; job = json.load(sys.stdin); sys.path[:0] = job['path']; "
_CHILD += "from cardan_build.system.verification import run; run(job)"


def verify(fmus: Mapping[str, bytes], members: Mapping[str, bytes], step: float, own: Sequence[str]) -> None:
    """Check a package before it is written.

    Parameters
    ----------
    fmus : mapping
        FMUs by component.
    members : mapping
        Members of the package.
    step : float
        Communication step, s.
    own : sequence of str
        Components whose FMUs are ours: their descriptions are judged too, those of others only have to work.

    Raises
    ------
    BuildError
        With everything that is wrong.
    """
    problems = _schema(members)
    with tempfile.TemporaryDirectory(prefix="cardan_") as directory:
        for name, content in fmus.items():
            (Path(directory) / f"{name}.fmu").write_bytes(content)
        job = {"path": [str(find_package(name).parent) for name in ("cardan_build", "fmpy")], "folder": directory,
               "names": list(fmus), "step": step, "own": list(own)}
        # -I keeps the current directory, PYTHONPATH and the user's packages out.
        done = subprocess.run([sys.executable, "-I", "-B", "-c", _CHILD], input=json.dumps(job), capture_output=True,
                              text=True, check=False, cwd=directory, env={**os.environ, "TMPDIR": directory})
        answer = Path(directory) / "answer.json"
        if answer.is_file():
            problems += json.loads(answer.read_text(encoding="utf-8"))
        else:
            problems.append(f"the process that tries the FMUs ended with exit code {done.returncode}: "
                            f"{done.stderr.strip()}")
    if problems:
        raise BuildError("the package was made, but does not work:\n" + "\n".join(problems))


def _schema(members: Mapping[str, bytes]) -> list[str]:
    """What the schemas of SSP 1.0, which FMPy brings, say about the package's files."""
    import fmpy.ssp.ssd
    from lxml import etree

    schemas = {"ssd": "SystemStructureDescription.xsd", "ssv": "SystemStructureParameterValues.xsd"}
    problems = []
    for name, content in members.items():
        schema = schemas.get(name.rpartition(".")[2])
        if schema is not None:
            try:
                fmpy.ssp.ssd.validate_tree(etree.parse(io.BytesIO(content)).getroot(), schema)
            except Exception as error:  # FMPy raises bare Exception
                problems.append(f"{name}: {error}")
    return problems


def run(job: dict[str, Any]) -> None:
    """Try each FMU for one step; write the problems to ``answer.json`` and leave."""
    problems: list[str] = []
    for name in job["names"]:
        try:
            tried = _try(Path(job["folder"]) / f"{name}.fmu", job["step"], name in job["own"])
            problems += [f"{name}: {each}" for each in tried]
        except Exception as error:  # whatever an FMU or FMPy raises is a problem of the package
            problems.append(f"{name}: {type(error).__name__}: {error}")
    (Path(job["folder"]) / "answer.json").write_text(json.dumps(problems), encoding="utf-8")
    os._exit(0)  # an interpreter that ran a pythonfmu FMU sometimes aborts at exit (docs/FMI.md, trap 11)


def _try(fmu: Path, step: float, strictly: bool) -> list[str]:
    from fmpy import extract, read_model_description
    from fmpy.fmi2 import FMU2Slave
    from fmpy.validation import validate_fmu

    problems = [str(each) for each in validate_fmu(str(fmu))] if strictly else []
    if problems:
        return problems
    described = read_model_description(str(fmu), validate=False)
    slave = FMU2Slave(guid=described.guid, unzipDirectory=extract(str(fmu)), instanceName="verification",
                      modelIdentifier=described.coSimulation.modelIdentifier)
    slave.instantiate()
    slave.setupExperiment(startTime=0.0)
    slave.enterInitializationMode()
    slave.exitInitializationMode()
    slave.doStep(currentCommunicationPoint=0.0, communicationStepSize=step)
    for variable in described.modelVariables:
        if variable.causality == "output" and variable.type == "Real":
            value = slave.getReal([variable.valueReference])[0]
            if not math.isfinite(value):
                problems.append(f"{variable.name} is {value!r} after one step")
    slave.terminate()
    slave.freeInstance()
    return problems
