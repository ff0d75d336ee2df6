"""Simulation of cardan drivelines: the FMU, what acts on it, and what comes out.

Everything is imported on first use, so that ``import cardan`` and ``cardan --help`` cost next to nothing.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from cardan.analyses.campbell import campbell as campbell
    from cardan.analyses.linearize import linearize as linearize
    from cardan.analyses.order_spectrum import orders as orders
    from cardan.analyses.stability import stability as stability
    from cardan.instance import Instance as Instance
    from cardan.result import Result as Result
    from cardan.scenario import Scenario as Scenario
    from cardan.simulation import simulate as simulate

    __version__: str

__all__ = ["Instance", "Result", "Scenario", "__version__", "campbell", "linearize", "orders", "simulate", "stability"]

_HOMES = {"Instance": "cardan.instance", "Result": "cardan.result", "Scenario": "cardan.scenario",
          "campbell": "cardan.analyses.campbell", "linearize": "cardan.analyses.linearize",
          "orders": "cardan.analyses.order_spectrum", "simulate": "cardan.simulation",
          "stability": "cardan.analyses.stability"}


def __getattr__(name: str) -> Any:
    if name == "__version__":
        from cardan.provenance import package_version

        return package_version("cardan-driveline")
    if name in _HOMES:
        from importlib import import_module

        return getattr(import_module(_HOMES[name]), name)
    raise AttributeError(f"module 'cardan' has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted(__all__)
