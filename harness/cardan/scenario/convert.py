"""From the tables of a scene file to the dataclasses that declare their keys."""

from __future__ import annotations

import contextlib
import dataclasses
import math
import sys
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from cardan.models.parameters import Key, ParameterError, key_name, keys_of
from cardan.scenario.problems import Collector, nearest
from cardan.units import UnitError, to_si

INVALID: Any = object()  # stands for a value that could not be read


class Reader:
    """Reads values with their declared unit, limits and kind, and notes every problem.

    Parameters
    ----------
    collector : Collector
        Takes the problems.
    base : Path
        Folder that relative file names refer to.
    """

    def __init__(self, collector: Collector, base: Path) -> None:
        self.collector, self.base = collector, base

    def build(self, kind: type, table: Mapping[str, Any], path: str, ignore: tuple[str, ...] = (),
              **given: Any) -> Any:
        """Return an instance of the dataclass `kind` made from a table, or None if it had problems.

        Parameters
        ----------
        kind : type
            Dataclass whose fields carry a `Key`.
        table : mapping
            Keys and values as they stand in the file.
        path : str
            Dotted name of the table, for messages.
        ignore : tuple of str
            Keys of the table that are dealt with elsewhere.
        **given
            Further arguments of `kind` that do not come from the table.
        """
        declared = {key_name(field): (field, key, required) for field, (key, required) in keys_of(kind).items()}
        found = len(self.collector.problems)
        values = dict(given)
        for name, raw in table.items():
            if name in ignore:
                continue
            if name not in declared:
                self.collector.unknown(f"{path}.{name}", raw, f"key of [{path}]", name, [*declared, *ignore])
                continue
            field, key, _ = declared[name]
            values[field] = self.value(key, raw, f"{path}.{name}")
        for name, (_, key, required) in declared.items():
            if required and name not in table:
                self.collector.add(f"{path}.{name}", None, f"missing ({key.text})", key.allowed())
        if len(self.collector.problems) > found:
            return None
        try:
            return kind(**values)
        except ParameterError as error:
            self.collector.add(f"{path}.{error.key}", error.value, error.why, error.allowed)
        except ArithmeticError as error:
            # each value may be allowed, but not with the others: no arithmetic is left unguarded for that
            self.collector.add(path, None, f"the values of [{path}] are too large or too small together: {error}")
        return None

    def value(self, key: Key, raw: Any, path: str) -> Any:
        """Return a value as its declaration wants it, or `INVALID` after noting what is wrong."""
        return getattr(self, f"_{key.kind}")(key, raw, path)

    def number(self, raw: Any, unit: str, path: str) -> Any:
        """Return a number in SI, or `INVALID`."""
        if isinstance(raw, int) and not isinstance(raw, bool) and abs(raw) > sys.float_info.max:
            self.collector.add(path, raw, "beyond the range of numbers")
            return INVALID
        try:
            return to_si(raw, unit)
        except UnitError as error:
            self.collector.add(path, raw, str(error).removeprefix(f"{raw!r}").lstrip(": ").removeprefix("is "))
        return INVALID

    def _real(self, key: Key, raw: Any, path: str) -> Any:
        value = self.number(raw, key.unit, path)
        if value is not INVALID and not key.contains(value):
            self.collector.add(path, raw, "out of range" if math.isfinite(value) else "not finite", key.allowed())
            return INVALID
        return value

    def _reals(self, key: Key, raw: Any, path: str) -> Any:
        items = _split(raw)
        if not isinstance(items, list):
            self.collector.add(path, raw, "must be a list, or a text such as '1, 2, 3 N.m'", key.allowed())
            return INVALID
        values = [self._real(key, item, f"{path}[{i}]") for i, item in enumerate(items)]
        return INVALID if INVALID in values else tuple(values)

    def _grid(self, key: Key, raw: Any, path: str) -> Any:
        if not isinstance(raw, list):
            self.collector.add(path, raw, "must be a list of rows")
            return INVALID
        rows = [self._reals(key, row, f"{path}[{i}]") for i, row in enumerate(raw)]
        return INVALID if INVALID in rows else tuple(rows)

    def _integer(self, key: Key, raw: Any, path: str) -> Any:
        if isinstance(raw, str) and raw.isascii():
            with contextlib.suppress(ValueError):
                raw = int(raw)
        if isinstance(raw, bool) or not isinstance(raw, int):
            self.collector.add(path, raw, "must be a whole number", key.allowed())
            return INVALID
        if not key.contains(raw):
            self.collector.add(path, raw, "out of range", key.allowed())
            return INVALID
        return raw

    def _boolean(self, key: Key, raw: Any, path: str) -> Any:
        value = {"true": True, "false": False}.get(raw.lower(), raw) if isinstance(raw, str) else raw
        if not isinstance(value, bool):
            self.collector.add(path, raw, "must be true or false")
            return INVALID
        return value

    def _text(self, key: Key, raw: Any, path: str) -> Any:
        if not isinstance(raw, str):
            self.collector.add(path, raw, "must be a text")
            return INVALID
        return raw

    def _choice(self, key: Key, raw: Any, path: str) -> Any:
        if raw not in key.choices:
            self.collector.add(path, raw, "not one of the choices", key.allowed(), _like(raw, key.choices))
            return INVALID
        return raw

    def _file(self, key: Key, raw: Any, path: str) -> Any:
        if not isinstance(raw, str):
            self.collector.add(path, raw, "must be a file name")
            return INVALID
        place = self.base / raw
        if not place.is_file():
            others = [p.name for p in place.parent.glob("*")] if place.parent.is_dir() else []
            self.collector.add(path, raw, "no such file (names are relative to the scene file)",
                               nearest=_like(place.name, others))
            return INVALID
        return place

    def _table(self, key: Key, raw: Any, path: str) -> Any:
        if not isinstance(raw, Mapping):
            self.collector.add(path, raw, f"must be a table [{path}]")
            return INVALID
        assert key.table is not None and dataclasses.is_dataclass(key.table)
        made = self.build(key.table, raw, path)
        return INVALID if made is None else made


def plain(value: Any, path: str, collector: Collector) -> Any:
    """Return a copy with NumPy numbers and arrays as Python's own; keys that are no texts are noted as problems."""
    if isinstance(value, Mapping):
        made: dict[str, Any] = {}
        for name, inner in value.items():
            below = f"{path}.{name}" if path else str(name)
            if isinstance(name, str):
                made[name] = plain(inner, below, collector)
            else:
                collector.add(below, name, "a key must be a text")
        return made
    if isinstance(value, (list, tuple)):
        items = [plain(inner, f"{path}[{i}]", collector) for i, inner in enumerate(value)]
        return tuple(items) if isinstance(value, tuple) else items
    # told by the module, so that reading a scene does not import NumPy
    return value.tolist() if type(value).__module__ == "numpy" and hasattr(value, "tolist") else value


def _like(raw: Any, names: Any) -> str:
    return nearest(raw, names) if isinstance(raw, str) else ""


def _split(raw: Any) -> Any:
    """Turn "1, 2, 3 N.m" into a list of texts that all carry the unit at the end."""
    if not isinstance(raw, str):
        return list(raw) if isinstance(raw, tuple) else raw
    parts = [part.strip() for part in raw.split(",")]
    unit = parts[-1].partition(" ")[2]
    return [part if " " in part else f"{part} {unit}".strip() for part in parts]
