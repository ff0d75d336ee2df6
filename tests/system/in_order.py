"""A master that takes a package's FMUs in the order of ``coupling = "held"``, as a tool that resolves feedthrough does.

At each point the driveline's outputs go to the driver, his pedals and the shafts to engine and load, their torques back
to the driveline; then all step with what they hold.
"""

from __future__ import annotations

import xml.etree.ElementTree as ElementTree
import zipfile
from contextlib import ExitStack
from pathlib import Path

from cardan.instance import Instance
from cardan_build.system.assembly import unpack_fmus

ORDER = ("driveline", "driver", "bending", "engine", "load")
_SSD = {"ssd": "http://ssp-standard.org/SSP1/SystemStructureDescription"}


def connections(ssp: Path) -> list[tuple[str, str, str, str]]:
    """Element and connector that give, element and connector that take."""
    with zipfile.ZipFile(ssp) as package:
        root = ElementTree.fromstring(package.read("SystemStructure.ssd"))
    keys = ("startElement", "startConnector", "endElement", "endConnector")
    return [tuple(each.attrib[key] for key in keys) for each in root.iterfind(".//ssd:Connection", _SSD)]


def play(ssp: Path, folder: Path, step: float, count: int, names: tuple[str, ...]) -> list[list[float]]:
    """Run a package; return the named variables (``component.variable``) at every point, the start included."""
    paths = unpack_fmus(ssp, folder)
    links = connections(ssp)
    order = [name for name in ORDER if name in paths]
    with ExitStack() as stack:
        parts = {name: stack.enter_context(Instance(path, name)) for name, path in paths.items()}

        def exchange() -> None:
            for giver in order:
                for start, given, end, taken in links:
                    if start == giver:
                        parts[end].set(taken, parts[start].get(given))

        def look() -> list[float]:
            return [float(parts[name.partition(".")[0]].get(name.partition(".")[2])) for name in names]

        for part in parts.values():
            part.setup(0.0)
        exchange()
        for part in parts.values():
            part.initialize()
        exchange()
        rows = [look()]
        for i in range(count):
            for part in parts.values():
                part.step(i * step, step)
            exchange()
            rows.append(look())
    return rows
