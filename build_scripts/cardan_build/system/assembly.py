"""From a scene to a system package: the FMUs, the structure, the parameter sets, one archive."""

from __future__ import annotations

import io
import tempfile
import zipfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

from .. import BuildError, archive, default_fmu
from . import part_archive
from .beginning import Beginning, beginning
from .foreign_part import ForeignPart
from .parts import split
from .start_values import with_start_values
from .structure import DRIVELINE, Connection, Port, Value, parameter_set, structure
from .verification import verify

Settings = dict[str, float | int | bool]


def assemble(scenario: Any, output: Path, fmu: Path | None = None) -> Path:
    """Write the package; see `cardan_build.system.package`."""
    from cardan_kernel import __version__ as version

    output = output.absolute()
    if output.suffix != ".ssp":
        raise BuildError(f"{output} is no name for a system package: it must end with .ssp")
    if output.is_dir():
        raise BuildError(f"{output} is a directory; name a file")
    settings: Settings = {**scenario.driveline, "hold.degree": 0, "model.tolerance": scenario.tolerance}
    start = beginning(scenario, settings)
    parts, connections = split(scenario, start)
    baked = {**settings, **_inputs(start, connections)}
    times = {"stop_time": scenario.stop_time, "step": scenario.communication_step}
    driveline = with_start_values(fmu or default_fmu(), baked, scenario.title, **times)
    fmus = {DRIVELINE: packed(driveline)}
    fmus |= {part.name: part.content if isinstance(part, ForeignPart) else
             packed(part_archive.members(part, version=version, **times)) for part in parts}
    described = _described(driveline["modelDescription.xml"])
    ports = {DRIVELINE: _driveline_ports(described, connections, scenario.outputs)}
    ports |= {part.name: part.ports for part in parts}
    taken = {each.taken for each in connections if each.taker == DRIVELINE}
    values = {DRIVELINE: [Value(name, described[name][0], value, described[name][1])
                          for name, value in settings.items() if name not in taken]}
    values |= {part.name: part.values for part in parts}
    members = {"SystemStructure.ssd": structure(scenario.name, scenario.title, ports, connections, version=version,
                                                **times)}
    for name, content in fmus.items():
        members[f"resources/{name}.fmu"] = content
        members[f"resources/{name}.ssv"] = parameter_set(values[name], version)
    own = [DRIVELINE, *(part.name for part in parts if not isinstance(part, ForeignPart))]
    verify(fmus, members, scenario.communication_step, own)
    try:
        output.parent.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(prefix=".cardan-build-", dir=output.parent) as directory:
            made = Path(directory) / output.name
            archive.write(made, members)
            archive.put(made, output)
    except OSError as error:
        raise BuildError(f"{output} cannot be written: {error}") from error
    return output


def packed(members: Mapping[str, bytes]) -> bytes:
    """Return an archive in memory; the same members give the same bytes."""
    stream = io.BytesIO()
    archive.write(stream, members)  # type: ignore[arg-type]  # what zipfile takes
    return stream.getvalue()


def _inputs(start: Beginning, connections: list[Connection]) -> Settings:
    """Start values of the driveline's inputs that others send: importers that send late begin with the right ones."""
    known: Settings = {"input.torque": start.torque_in, "output.torque": start.torque_out}
    known |= {f"input.speed_command{tail}": value for tail, value in zip(("", ".der1", ".der2"), start.command)}
    taken = {each.taken for each in connections if each.taker == DRIVELINE}
    return {name: value for name, value in known.items() if name in taken}


def _described(xml: bytes) -> dict[str, tuple[str, str, str]]:
    """Variables of an FMU: name -> type, unit, causality."""
    found = {}
    for each in ElementTree.fromstring(xml).iter("ScalarVariable"):
        found[each.get("name", "")] = each[0].tag, each[0].get("unit", ""), each.get("causality", "local")
    return found


def _driveline_ports(described: Mapping[str, tuple[str, str, str]], connections: list[Connection],
                     outputs: tuple[str, ...]) -> list[Port]:
    """Connectors of the driveline: what is exchanged, and the outputs that the scene records."""
    used = [each.given for each in connections if each.giver == DRIVELINE]
    used += [each.taken for each in connections if each.taker == DRIVELINE]
    used += [name for name in outputs if name in described and described[name][2] == "output"]
    return [Port(name, described[name][2], *described[name][:2]) for name in dict.fromkeys(used)]


def unpack_fmus(ssp: Path, folder: Path) -> dict[str, Path]:
    """Write the FMUs of a package into a folder; return their paths by component."""
    found = {}
    with zipfile.ZipFile(ssp) as package:
        for name in package.namelist():
            if name.startswith("resources/") and name.endswith(".fmu"):
                path = folder / Path(name).name
                path.write_bytes(package.read(name))
                found[path.stem] = path
    return found
