"""The FMU's ports for importers that draw connections: ``terminalsAndIcons``.

FMI 2.0.4 takes this folder over from FMI 3.0 (section 2.4.9), with the schema and the version number of FMI 3.0.
Member names are those of the Modelica Standard Library's rotational adaptors. The matching rule is ``bus``: a
partner without, say, accelerations can still be connected. A driving torque flows into the input flange, the load's
torque out of the output flange: connected to a partner's flange with the opposite direction, no sign changes.
"""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import NamedTuple
from xml.etree.ElementTree import Element, SubElement, indent, tostring

from . import BuildError, sketch

FOLDER = "terminalsAndIcons"
FMI_VERSION = "3.0"  # of this file's format
_HOME = Path(__file__).parent
_COLOUR, _STROKE = "91 103 112", "1.5"
_HALF = 12.0  # of a flange's picture; the coordinate system goes from -100 to 100


class Flange(NamedTuple):
    """A shaft end.

    Attributes
    ----------
    name, description : str
        Name of the terminal, which is also the prefix of its variables, and what it is.
    kind : str
        The Modelica connector that it resembles.
    torque : str
        ``inflow`` or ``outflow``: where a positive torque goes.
    picture : str
        Base name of its PNG file.
    x, y : float
        Place of its middle.
    """

    name: str
    description: str
    kind: str
    torque: str
    picture: str
    x: float
    y: float


_KIND = "Modelica.Mechanics.Rotational.Interfaces."
FLANGES = (
    Flange("input", "Input shaft end, driven by the engine; in use with model.drive = 0", f"{_KIND}Flange_a", "inflow",
           "flange_a", -100.0, 0.0),
    Flange("output", "Output shaft end, which drives the load", f"{_KIND}Flange_b", "outflow", "flange_b", 100.0, 0.0),
)
# Variable after the flange's prefix, member name; the torque and its derivatives are what flows.
SIGNALS = (("angle", "phi"), ("speed", "w"), ("acceleration", "a"))
FLOWS = (("torque", "tau"), ("torque.der1", "tau_der1"), ("torque.by_speed", "tau_by_speed"))


def files(names: Iterable[str]) -> dict[str, bytes]:
    """Return the members of the folder by their path in the FMU.

    Parameters
    ----------
    names : iterable of str
        The FMU's variables.

    Raises
    ------
    BuildError
        A port names a variable that is not there.
    """
    pictures = {f"{FOLDER}/{each.picture}.png": (_HOME / f"{each.picture}.png").read_bytes() for each in FLANGES}
    return {
        f"{FOLDER}/terminalsAndIcons.xml": describe(names),
        f"{FOLDER}/icon.png": (_HOME / "icon.png").read_bytes(),
        f"{FOLDER}/icon.svg": (sketch.icon() + "\n").encode(),
        **pictures,
    }


def describe(names: Iterable[str]) -> bytes:
    """Return ``terminalsAndIcons.xml``; arguments and errors as in `files`."""
    known = set(names)
    root = Element("fmiTerminalsAndIcons", fmiVersion=FMI_VERSION)
    drawn = SubElement(root, "GraphicalRepresentation")
    whole = {"x1": "-100", "y1": "-100", "x2": "100", "y2": "100"}
    SubElement(drawn, "CoordinateSystem", whole, suggestedScalingFactorTo_mm="0.1")
    SubElement(drawn, "Icon", whole)
    table = SubElement(root, "Terminals")
    for flange in FLANGES:
        _terminal(table, flange, known)
    indent(root)
    body: bytes = tostring(root, encoding="utf-8")
    return b'<?xml version="1.0" encoding="UTF-8"?>\n' + body + b"\n"


def _terminal(parent: Element, flange: Flange, known: set[str]) -> None:
    element = SubElement(parent, "Terminal", name=flange.name, matchingRule="bus", terminalKind=flange.kind,
                         description=flange.description)
    for members, kind in ((SIGNALS, "signal"), (FLOWS, flange.torque)):
        for suffix, member in members:
            variable = f"{flange.name}.{suffix}"
            if variable not in known:
                raise BuildError(f"the port {flange.name} names the variable {variable}, which the FMU does not have")
            SubElement(element, "TerminalMemberVariable", variableName=variable, memberName=member, variableKind=kind)
    SubElement(element, "TerminalGraphicalRepresentation", defaultConnectionColor=_COLOUR,
               defaultConnectionStrokeSize=_STROKE, x1=f"{flange.x - _HALF:g}", y1=f"{flange.y - _HALF:g}",
               x2=f"{flange.x + _HALF:g}", y2=f"{flange.y + _HALF:g}", iconBaseName=flange.picture)
