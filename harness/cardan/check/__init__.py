"""Compliance check of FMI 2.0 co-simulation FMUs, this project's and any other.

`check_fmu` carries out the checks of `cardan.check.catalog` and gives a `Report`; `export_reference` writes the
reference files that the check ``reference`` compares with.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from cardan.check.export import export_reference as export_reference
    from cardan.check.report import Report as Report
    from cardan.check.runner import check_fmu as check_fmu
    from cardan.check.subject import Options as Options

__all__ = ["Options", "Report", "check_fmu", "export_reference"]

_HOMES = {"Options": "subject", "Report": "report", "check_fmu": "runner", "export_reference": "export"}


def __getattr__(name: str) -> Any:
    if name in _HOMES:
        from importlib import import_module

        return getattr(import_module(f"cardan.check.{_HOMES[name]}"), name)
    raise AttributeError(f"module 'cardan.check' has no attribute {name!r}")
