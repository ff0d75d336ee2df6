"""The FMU of a part: its code under names made from content, its data, the exporter's libraries."""

from __future__ import annotations

import hashlib
import json
import re
import tempfile
from collections.abc import Mapping
from html import escape
from pathlib import Path

import cardan.models.base

from .. import BuildError, documentation
from ..sources import PYTHONFMU_MODULES, find_package
from . import description, feedthrough
from .parts import ScenePart

LIBRARIES = {"linux64": ("libpythonfmu-export.so", ".so"), "win64": ("pythonfmu-export.dll", ".dll")}
_HOME = Path(__file__).parent
# What needs the harness, and so more than the standard library.
_STAY_OUTSIDE = ("catalog.py", "foreign.py", "foreign_run.py")
# The exporter runs the text of this module again for every instance and keeps what comes of it: it is short. It also
# gives back a reference to the module's names that it only borrowed, once per instance; each method of the class it
# keeps holds one. A class without methods would so end in a crash: there are two.
_SLAVE = '''"""The class that the exporter looks for."""

import cardan_part.slave


class ScenePart(cardan_part.slave.ScenePart):
    """Engine, load, driver or moving joints of a scene."""

    def __init__(self, **kwargs):
        super().__init__(**kwargs)

    def do_step(self, current_time, step_size):
        return False  # never called: the part\'s method stands in front of it in every instance
'''
_IMPORTS = (
    (re.compile(r"^from cardan\.(models|units)\b", re.MULTILINE), r"from cardan_part_{tag}.\1"),
    (re.compile(r"\bcardan_part\.slave\b"), "cardan_part_{tag}.slave"),
    (re.compile(r"^from pythonfmu\b", re.MULTILINE), "from pythonfmu_{tag}"),
)


def code(data: Mapping[str, bytes]) -> dict[str, bytes]:
    """Return the modules of a part by path below ``resources``.

    Their names end with a hash of them all and of the part's data. Two parts would share modules otherwise, and models
    are imported when the data name them: from the folder of the part that came first, which may be gone by then.

    Parameters
    ----------
    data : mapping
        The part's data and files by name.
    """
    models = Path(cardan.models.base.__file__).parent
    pythonfmu = find_package("pythonfmu")
    files = {f"cardan_part/models/{path.name}": path for path in models.glob("*.py") if path.name not in _STAY_OUTSIDE}
    files["cardan_part/units.py"] = models.parent / "units.py"  # headings of CSV columns
    files |= {f"cardan_part/{path.name}": path for path in (_HOME / "part").glob("*.py")}
    files |= {f"pythonfmu/{name}.py": pythonfmu / f"{name}.py" for name in PYTHONFMU_MODULES}
    contents = {name: path.read_bytes() for name, path in sorted(files.items())}
    contents["cardan_part_slave.py"] = _SLAVE.encode()
    contents["pythonfmu/__init__.py"] = b"# pythonfmu without its builder, renamed for this FMU\n"
    tag = _hash({**contents, **data})[:12]
    return {_renamed(name, tag): _rewritten(content, tag) for name, content in contents.items()}


def _hash(contents: Mapping[str, bytes]) -> str:
    total = hashlib.sha256()
    for name, content in sorted(contents.items()):
        total.update(f"{name}\0{len(content)}\0".encode() + content)
    return total.hexdigest()


def _renamed(name: str, tag: str) -> str:
    head, _, rest = name.partition("/")
    return f"{head}_{tag}/{rest}" if rest else f"{name.removesuffix('.py')}_{tag}.py"


def _rewritten(content: bytes, tag: str) -> bytes:
    text = content.decode("utf-8")
    for pattern, new in _IMPORTS:
        text = pattern.sub(new.format(tag=tag), text)
    return text.encode("utf-8")


def members(part: ScenePart, *, version: str, stop_time: float, step: float) -> dict[str, bytes]:
    """Return the members of a part's FMU.

    Parameters
    ----------
    part : ScenePart
        What it is.
    version : str
        Of the project.
    stop_time, step : float
        Of the scene, s.
    """
    data = {**part.files, "part.json": json.dumps(part.data, indent=1, sort_keys=True).encode()}
    resources = {**code(data), **data}
    slave = next(name for name in resources if name.startswith("cardan_part_slave_"))
    resources["slavemodule.txt"] = slave.removesuffix(".py").encode()
    with tempfile.TemporaryDirectory() as directory:
        for name, content in part.files.items():
            path = Path(directory) / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(content)
        feeds = feedthrough.find(part.data, Path(directory))
    found = {f"resources/{name}": content for name, content in resources.items()}
    for platform, (library, ending) in LIBRARIES.items():
        path = find_package("pythonfmu") / "resources" / "binaries" / platform / library
        if not path.is_file():
            raise BuildError(f"{path} is missing; install pythonfmu anew")
        found[f"binaries/{platform}/{part.model_name}{ending}"] = path.read_bytes()
    found["modelDescription.xml"] = description.describe(
        part.model_name, part.text, part.variables, feeds, version=version, digest=_hash(resources),
        stop_time=stop_time, step=step)
    found["documentation/index.html"] = _page(part, version).encode()
    found["documentation/externalDependencies.txt"] = EXTERNAL.format(name=part.model_name).encode()
    found["documentation/licenses/license.txt"] = documentation.own_licence().encode()
    found["documentation/licenses/pythonfmu.txt"] = documentation.licence_of("pythonfmu").encode()
    return found


def _page(part: ScenePart, version: str) -> str:
    rows = "\n".join(f"<tr><td><code>{escape(each.name)}</code></td><td>{each.causality}</td>"
                     f"<td>{escape(each.unit)}</td><td>{'' if each.start is None else each.start}</td>"
                     f"<td>{escape(each.description)}</td></tr>" for each in part.variables)
    return ('<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8">'
            f"<title>{part.model_name}</title></head><body>\n<h1>{part.model_name} {version}</h1>\n"
            f"<p>{escape(part.text)}. A part of a system package; FMI 2.0 "
            "co-simulation, SI units. Inputs are held over a step, outputs hold for the present inputs.</p>\n<table>"
            "<tr><th>Name</th><th>Kind</th><th>Unit</th><th>Start</th><th>Meaning</th></tr>\n"
            f"{rows}\n</table></body></html>\n")


EXTERNAL = """{name} is a Python FMU (exporter: PythonFMU). It carries its Python code and needs from the importing
process, on Linux (x86-64, glibc 2.32 or later) or Windows (x86-64), Python 3.9 or later and nothing else. An importer
that is no Python program must bring libpython into its process before it loads the FMU.
"""
