"""Models as plain data, and back.

A model is a dataclass; as data it is ``{"class": "module:Class", "fields": {...}}`` with nested models, lists and
files in the same way. Files stand beside the data, relative to a folder.
"""

from __future__ import annotations

import importlib
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from cardan.models.base import Model

MODELS = Model.__module__.rpartition(".")[0]


def decode(data: Any, folder: Path) -> Any:
    """Make models from data.

    Parameters
    ----------
    data
        What `cardan_build.system.encode` wrote.
    folder : Path
        Where the files are.

    Raises
    ------
    ParameterError
        If a value is out of its range or does not fit the others.
    """
    if isinstance(data, list):
        return tuple(decode(each, folder) for each in data)
    if not isinstance(data, dict):
        return data
    if "file" in data:
        return folder / data["file"]
    module, name = data["class"].split(":")
    kind = getattr(importlib.import_module(f"{MODELS}.{module}"), name)
    return kind(**{field: decode(each, folder) for field, each in data["fields"].items()})


def replace(data: Any, places: Mapping[str, Sequence[str]], values: Mapping[str, Any]) -> Any:
    """Return a copy of the data with some fields changed.

    Parameters
    ----------
    data
        A model as data.
    places : dict
        Name of a parameter -> fields that lead to it from the outermost model.
    values : dict
        Name of a parameter -> new value.
    """
    copy = _copy(data)
    for name, value in values.items():
        inner = copy
        *way, last = places[name]
        for field in way:
            inner = inner["fields"][field]
        inner["fields"][last] = value
    return copy


def _copy(data: Any) -> Any:
    if isinstance(data, dict) and "fields" in data:
        return {**data, "fields": {name: _copy(each) for name, each in data["fields"].items()}}
    return data
