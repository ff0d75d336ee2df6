"""The driveline FMU with the values of a scene as its start values.

Importers differ in which parameter bindings they apply, and FMPy's system simulation applies none; so the values
stand in the FMU itself: in its description, and in a module on top of its slave that sets them in every new instance.
"""

from __future__ import annotations

import hashlib
import zipfile
from collections.abc import Mapping
from pathlib import Path
from xml.etree import ElementTree

from .. import BuildError, archive
from .description import guid, number

SLAVE = "resources/slavemodule.txt"

_MODULE = '''"""The driveline with the start values of a scene: {title}."""

import {slave} as driveline

START = {start!r}


class CardanDriveline(driveline.CardanDriveline):
    """The driveline, set before its importer sets anything."""

    def __init__(self, **kwargs):
        super().__init__(**kwargs)
        self.begin()

    def begin(self):
        for kind, (references, values) in START.items():
            getattr(self, "set_" + kind)(references, values)
'''


def with_start_values(fmu: Path, values: Mapping[str, float | int | bool], title: str, *, stop_time: float,
                      step: float) -> dict[str, bytes]:
    """Return the members of an archive: the driveline FMU with other start values.

    Parameters
    ----------
    fmu : Path
        A driveline FMU of this project.
    values : mapping
        Parameters and inputs by name, SI.
    title : str
        Of the scene.
    stop_time, step : float
        Default experiment, s.

    Raises
    ------
    BuildError
        If the file is no driveline FMU of this project, or lacks one of the variables.
    """
    try:
        members = archive.contents(fmu)
    except (OSError, zipfile.BadZipFile) as error:
        raise BuildError(f"{fmu} is no driveline FMU: {error}") from error
    slave = members.get(SLAVE, b"").decode("ascii", "replace").strip()
    if not slave.startswith("cardan_slave_") or "modelDescription.xml" not in members:
        raise BuildError(f"{fmu} is no driveline FMU of this project; make one with: cardan build -o {fmu.name}")
    root = ElementTree.fromstring(members["modelDescription.xml"])
    known = {each.get("name", ""): each for each in root.iter("ScalarVariable")}
    start: dict[str, tuple[list[int], list[float | int | bool]]] = {}
    for name, value in values.items():
        if name not in known:
            raise BuildError(f"{fmu} has no variable {name}, which the scene sets; build it anew")
        typed = known[name][0]
        typed.set("start", number(typed.tag, value))
        references, starts = start.setdefault(typed.tag.lower(), ([], []))
        references.append(int(known[name].get("valueReference", "")))
        starts.append(float(value) if typed.tag == "Real" else bool(value) if typed.tag == "Boolean" else int(value))
    for experiment in root.iter("DefaultExperiment"):
        experiment.attrib.update({"stopTime": repr(stop_time), "stepSize": repr(step)})
    text = _MODULE.format(title=title.encode("ascii", "replace").decode().replace('"', "'").replace("\\", "/"),
                          slave=slave, start=start)
    module = f"cardan_start_{hashlib.sha256(text.encode()).hexdigest()[:12]}"
    root.set("guid", guid(ElementTree.tostring(root)))
    described: bytes = ElementTree.tostring(root, encoding="utf-8")
    return {**members, SLAVE: module.encode(), f"resources/{module}.py": text.encode(),
            "modelDescription.xml": b'<?xml version="1.0" encoding="UTF-8"?>\n' + described + b"\n"}
