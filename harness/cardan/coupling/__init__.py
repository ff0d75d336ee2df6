"""Coupling of the FMU with the engine and the load outside it: one small module per scheme.

`scheme` makes a scheme by its name in a scene file; `Master` is what a scheme works on.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from cardan.coupling.adaptive import Adaptive
from cardan.coupling.auto import Auto
from cardan.coupling.base import Scheme
from cardan.coupling.gauss_seidel import GaussSeidel
from cardan.coupling.held import Held
from cardan.coupling.hermite import Hermite3, Hermite5
from cardan.coupling.iterated import Iterated
from cardan.coupling.linear import Linear
from cardan.coupling.master import Master
from cardan.coupling.slope import Slope
from cardan.errors import InputError

if TYPE_CHECKING:
    from cardan.scenario import Scenario

KINDS: tuple[type[Scheme], ...] = (Held, GaussSeidel, Linear, Slope, Hermite3, Hermite5, Iterated, Adaptive, Auto)
SCHEMES: dict[str, type[Scheme]] = {kind.name: kind for kind in KINDS}
FALLBACK = "slope"  # for an FMU that cannot be rolled back
FOREIGN = "gauss-seidel"  # for an engine or load that is an FMU of its own

__all__ = ["FALLBACK", "FOREIGN", "SCHEMES", "Adaptive", "Iterated", "Master", "Scheme", "scheme", "scheme_of"]


def scheme(name: str) -> Scheme:
    """Make the coupling scheme of that name with its own defaults.

    Raises
    ------
    InputError
        If there is none; the message lists the choices.
    """
    try:
        return SCHEMES[name]()
    except KeyError:
        raise InputError(f"coupling = {name!r}: no such scheme; choose one of {', '.join(SCHEMES)}") from None


def scheme_of(scenario: Scenario) -> Scheme:
    """Make the coupling scheme of a scene with the scene's tolerance, sweeps and shortest step."""
    kind = SCHEMES.get(scenario.coupling)
    if kind is not None and issubclass(kind, Adaptive):
        return kind(scenario.tolerance, scenario.shortest_step)
    if kind is Iterated:
        return Iterated(scenario.sweeps, scenario.sweep_tolerance)
    return scheme(scenario.coupling)
