"""The container of the FMU manipulation toolbox: an FMU in C that imports the driveline and is run by FMPy."""

from __future__ import annotations

import json
import shutil
from pathlib import Path
from typing import Any

from cardan.importers.with_fmpy import play
from cardan.importers.with_fmutool import command

TOOL = "fmucontainer"
DISTRIBUTION = "fmu-manipulation-toolbox"


def run(job: dict[str, Any]) -> list[list[float]]:
    """Put the FMU into a container and run the scene in that; return the outputs after each step."""
    work = Path(job["work"])
    shutil.copy(job["fmu"], work / "driveline.fmu")
    plan = {"name": "container.fmu", "fmu": ["driveline.fmu"], "step_size": job["step"], "auto_link": False,
            "auto_input": True, "auto_output": True, "auto_parameter": True}
    (work / "container.json").write_text(json.dumps(plan), encoding="utf-8")
    command("fmucontainer", ["-container", "container.json", "-fmu-directory", ".", "-auto-parameter"], job["work"])
    return play({**job, "fmu": str(work / "container.fmu")}, "driveline.")
