"""The table ``[driveline]``: parameters and inputs of the FMU by their own names."""

from __future__ import annotations

import contextlib
import math
from collections.abc import Iterator, Mapping
from typing import Any

from cardan.scenario.convert import INVALID, Reader
from cardan.scenario.problems import Collector, nearest
from cardan.units import from_si

# what the rest of the scene decides
_ELSEWHERE = {
    "model.drive": "it follows from the [engine] type",
    "model.tolerance": "set [scene] tolerance",
    "hold.degree": "it follows from [scene] coupling",
    "hold.restart": "the master sets it at jumps",
    "input.torque": "it comes from [engine]",
    "input.speed_command": "it comes from [engine] type = 'speed'",
    "output.torque": "it comes from [load]",
}
_FIDELITIES = {"rigid": 1, "compliant": 2}


def flatten(table: Mapping[str, Any], prefix: str = "") -> Iterator[tuple[str, Any]]:
    """Yield (dotted name, value) of a table whose names are quoted, nested or both.

    An empty table is a value like any other: where it stands for a number it must be reported, not dropped.
    """
    for name, value in table.items():
        full = f"{prefix}.{name}" if prefix else name
        if isinstance(value, Mapping) and value:
            yield from flatten(value, full)
        else:
            yield full, value


def elsewhere(name: str) -> str:
    """Return where a variable is set if not in ``[driveline]``; empty if it is set there."""
    return next((why for known, why in _ELSEWHERE.items() if name == known or name.startswith(known + ".")), "")


def misplaced(table: str, content: Any, collector: Collector) -> bool:
    """Note names of driveline variables that stand outside ``[driveline]``; return whether `table` holds such."""
    from cardan_kernel.variables import INDEX

    if table.partition(".")[0] not in {name.partition(".")[0] for name in INDEX if "." in name}:
        return False
    for name, raw in flatten({table: content}):
        collector.add(name, raw, f"is no key of a table {table!r}; variables of the driveline stand in [driveline]",
                      nearest=f"driveline.{name if name in INDEX else nearest(name, INDEX)}")
    return True


def read_driveline(table: Mapping[str, Any], collector: Collector, reader: Reader) -> dict[str, float | int | bool]:
    """Return variable name -> SI value for everything that the table sets.

    Unknown names, wrong units, values out of the range that the FMU declares, outputs, and variables that another
    table decides are noted as problems.
    """
    from cardan_kernel.variables import INDEX, VARIABLES

    settable = [v.name for v in VARIABLES if v.causality != "output" and not elsewhere(v.name)]
    values: dict[str, float | int | bool] = {}
    for name, raw in flatten(table):
        path = f"driveline.{name}"
        if name in values:
            collector.add(path, raw, "given twice (quoted and as a nested table)")
            continue
        if name not in INDEX:
            collector.unknown(path, raw, "variable", name, settable)
            continue
        variable = VARIABLES[INDEX[name]]
        if variable.causality == "output":
            collector.add(path, raw, "is an output of the FMU and cannot be set; list it in [scene] outputs")
        elif elsewhere(name):
            collector.add(path, raw, f"cannot be set here: {elsewhere(name)}")
        else:
            value = _value(variable, raw, path, collector, reader)
            if value is not INVALID:
                values[name] = value
    return values


def _value(variable: Any, raw: Any, path: str, collector: Collector, reader: Reader) -> Any:
    if variable.type == "Real":
        value = reader.number(raw, variable.unit, path)
    else:
        value = _FIDELITIES.get(raw, raw) if variable.name == "model.fidelity" and isinstance(raw, str) else raw
        if isinstance(value, str) and value.strip().isdecimal() and value.isascii():
            with contextlib.suppress(ValueError):  # thousands of digits
                value = int(value)
        if isinstance(value, bool) or not isinstance(value, int):
            collector.add(path, raw, "must be a whole number", _allowed(variable))
            return INVALID
    if value is INVALID:
        return value
    if isinstance(value, float) and not math.isfinite(value):
        collector.add(path, raw, "not finite", _allowed(variable))
        return INVALID
    low, high = variable.minimum, variable.maximum
    if (low is not None and value < low) or (high is not None and value > high):
        collector.add(path, raw, "out of range", _allowed(variable))
        return INVALID
    return value


def _allowed(variable: Any) -> str:
    """Say the range of a variable, in its unit and in its display unit."""
    if variable.name == "model.fidelity":
        return "1 (rigid), 2 (compliant)"
    parts: list[str] = []
    for unit in (variable.unit, variable.display):
        if unit or not parts:
            low, high = (None if v is None else (from_si(v, variable.unit, unit) if unit else v)
                         for v in (variable.minimum, variable.maximum))
            # the largest double below 90 deg is the limit of a bend angle: say "below 90"
            end = ")" if variable.name.endswith(".angle") else "]"
            name = f" {unit}" if unit not in ("", "1") else ""
            if low is not None and high is not None:
                parts.append(f"[{low:.10g}, {high:.10g}{end}{name}")
            elif low is not None:
                parts.append(f">= {low:g}{name}")
            else:
                parts.append(f"finite number{name}")
    return " = ".join(dict.fromkeys(parts))
