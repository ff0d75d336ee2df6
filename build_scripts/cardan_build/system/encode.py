"""Models of a scene as plain data for `cardan_build.system.part.rebuild`, and the parameters that stay open."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from cardan.models.base import Model
from cardan.models.parameters import Key, key_name, keys_of

from .part.rebuild import MODELS


@dataclasses.dataclass(frozen=True)
class Parameter:
    """A scalar key of a model.

    Attributes
    ----------
    name : str
        Name in the scene's table, such as ``gearbox.clutch.capacity``.
    key : Key
        Unit, limits, meaning.
    value : float, int or bool
        What the scene gives.
    place : tuple of str
        Fields that lead to it from the outermost model.
    """

    name: str
    key: Key
    value: float | int | bool
    place: tuple[str, ...]


def encode(value: Any, files: dict[str, bytes]) -> Any:
    """Return a model, or a value inside one, as plain data.

    Parameters
    ----------
    value
        Model, nested table, list, number, text, path.
    files : dict
        Takes the content of files by their name in the FMU's resources.
    """
    if dataclasses.is_dataclass(value) and not isinstance(value, type):
        kind = type(value)
        module = kind.__module__.removeprefix(MODELS + ".")
        fields = {field.name: encode(getattr(value, field.name), files)
                  for field in dataclasses.fields(value) if field.init}
        return {"class": f"{module}:{kind.__name__}", "fields": fields}
    if isinstance(value, Path):
        name = f"data/{len(files)}_{value.name}"
        files[name] = value.read_bytes()
        return {"file": name}
    if isinstance(value, (list, tuple)):
        return [encode(each, files) for each in value]
    return value


def parameters(model: Model, prefix: str = "", place: tuple[str, ...] = ()) -> Iterator[Parameter]:
    """Yield the scalar keys of a model and of the models inside it, named as in a scene file.

    Lists, files and choices are part of what the FMU is; numbers and truth values that the scene leaves out stay out.
    """
    from cardan.models.combined import Combined
    from cardan.models.gearbox import Gearbox

    if isinstance(model, Combined):
        yield from parameters(model.first, prefix, (*place, "first"))
        yield from parameters(model.second, f"{prefix}governor.", (*place, "second"))
        return
    if isinstance(model, Gearbox):
        yield from parameters(model.source, prefix, (*place, "source"))
        prefix += "gearbox."
    yield from _keys(model, prefix, place)


def _keys(table: Any, prefix: str, place: tuple[str, ...]) -> Iterator[Parameter]:
    for field, (key, _) in keys_of(type(table)).items():
        value, name, where = getattr(table, field), prefix + key_name(field), (*place, field)
        if key.kind == "table" and value is not None:
            yield from _keys(value, f"{name}.", where)
        elif key.kind in ("real", "integer", "boolean") and value is not None:
            yield Parameter(name, key, float(value) if key.kind == "real" else value, where)
