"""The reference of scene files in Markdown, made from the declarations of their keys."""

from __future__ import annotations

import dataclasses
import inspect
from collections.abc import Iterator

from cardan.models.catalog import DRIVERS, ENGINES, LOADS
from cardan.models.gearbox import Gearbox
from cardan.models.governor import IdleGovernor
from cardan.models.parameters import REQUIRED, Key, key_name, keys_of
from cardan.scenario.tables import SceneTable

HEAD = """# Scene files

Written by `python -m cardan.readme` from the declarations of the keys. Numbers are SI; text carries its unit, such as
`"3000 rpm"`, `"80 N.m"`, `"20 deg"`, `"5 ms"`. Lists of quantities may be one text: `"0, 200, 400 rpm"`. File names are
relative to the scene file. `[driveline]` takes the names of the FMU's parameters and inputs; the README lists them.

`cardan simulate SCENE --set KEY=VALUE` changes a key, such as `--set driveline.joint1.angle="10 deg"`.
"""


def scene_reference() -> str:
    """Return the page: every table, type and key with unit, allowed values, default and meaning."""
    parts = [HEAD, "## [scene]\n", *_keys(SceneTable, (("outputs", "list of names", "the important ones",
                                                        "FMU outputs and signals of the models to record"),))]
    for table, kinds in (("engine", ENGINES), ("load", LOADS), ("driver", DRIVERS)):
        for name, kind in kinds.items():
            parts += _section(f"[{table}] type = \"{name}\"", kind)
    for name, kind in (("engine.gearbox", Gearbox), ("engine.governor", IdleGovernor)):
        parts += _section(f"[{name}] around any engine that gives a torque", kind)
    return "\n".join(parts).rstrip() + "\n"


def _section(title: str, kind: type) -> Iterator[str]:
    yield f"\n## {title}\n"
    yield inspect.cleandoc(kind.__doc__ or "").split("\n\nAttributes")[0] + "\n"
    yield from _keys(kind)
    for name, (key, _) in keys_of(kind).items():
        if key.kind == "table" and key.table is not None:
            yield f"\n`{key_name(name)}` is a table of its own:\n"
            yield from _keys(key.table)


def _keys(kind: type, more: tuple[tuple[str, str, str, str], ...] = ()) -> Iterator[str]:
    defaults = {field.name: field.default for field in dataclasses.fields(kind)}
    rows = [(key_name(name), _allowed(key), "required" if required else _default(defaults[name], key), key.text)
            for name, (key, required) in keys_of(kind).items()]
    rows += more
    if not rows:
        yield "No keys of its own."
        return
    yield "| key | value | default | meaning |"
    yield "|---|---|---|---|"
    for name, allowed, default, text in rows:
        yield f"| `{name}` | {allowed} | {default} | {text.replace('|', chr(92) + '|')} |"


def _allowed(key: Key) -> str:
    kinds = {"text": "text", "file": "file", "boolean": "true or false", "table": "table"}
    if key.kind in kinds:
        return kinds[key.kind]
    words = key.allowed().replace("|", "\\|")
    return {"reals": f"list, each {words}", "grid": f"list of lists, each {words}",
            "integer": f"whole number {words}"}.get(key.kind, words)


def _default(value: object, key: Key) -> str:
    if value in (None, (), "") or value is REQUIRED:
        return ""
    if isinstance(value, float):
        return f"{value:g}{f' {key.unit}' if key.unit not in ('', '1') else ''}"
    if isinstance(value, tuple):
        return ", ".join(f"{one:g}" if isinstance(one, float) else str(one) for one in value)
    return f"`{value}`" if isinstance(value, str) else str(value).lower()
