"""Changing single keys of a scene."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from cardan.scenario.driveline import flatten


def apply_overrides(tables: dict[str, Any], changes: Mapping[str, Any]) -> dict[str, Any]:
    """Return the tables with dotted keys set, added or (value None) removed.

    Names below ``driveline`` are FMU names and stay dotted; elsewhere each dot opens a nested table. Keys that do
    not exist are added all the same: reading the scene reports them.
    """
    tables = dict(tables)
    driveline = tables.get("driveline")
    if isinstance(driveline, Mapping):
        tables["driveline"] = dict(flatten(driveline))
    for name, value in changes.items():
        if not isinstance(name, str):
            raise TypeError(f"the key of an override must be a text such as 'scene.stop_time', not {name!r}")
        head, _, rest = name.partition(".")
        path = [head, rest] if head == "driveline" and rest else name.split(".")
        place: Any = tables
        for part in path[:-1]:
            inner = place.get(part)
            place[part] = dict(inner) if isinstance(inner, Mapping) else {}
            place = place[part]
        if value is None:
            place.pop(path[-1], None)
        else:
            place[path[-1]] = value
    return tables
