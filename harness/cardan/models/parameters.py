"""Parameters of models, declared once: unit, limits and meaning of every key of a scene file.

Each helper returns a `dataclasses.field` whose metadata carries a `Key`; the scenario layer reads it to
convert and check the text of a scene file, and `check_ranges` applies the same limits to models made in Python.
A field whose key would hide a method carries a trailing underscore: ``torque_`` is the key ``torque``.
"""

from __future__ import annotations

import dataclasses
import math
from pathlib import Path
from typing import Any

REQUIRED = dataclasses.MISSING


class ParameterError(ValueError):
    """A parameter whose value is not allowed.

    Attributes
    ----------
    key : str
        Name of the parameter.
    value : object
        The value found.
    why : str
        What is wrong with it.
    allowed : str
        What would be right.
    """

    def __init__(self, key: str, value: object, why: str, allowed: str = "") -> None:
        self.key, self.value, self.why, self.allowed = key, value, why, allowed
        super().__init__(f"{key} = {value!r}: {why}" + (f"; allowed: {allowed}" if allowed else ""))


@dataclasses.dataclass(frozen=True)
class Key:
    """Declaration of one key.

    Attributes
    ----------
    kind : str
        ``real``, ``reals`` (a list), ``grid`` (a list of lists), ``integer``, ``boolean``, ``text``, ``choice``,
        ``file`` or ``table``.
    unit : str
        SI unit of reals.
    minimum, maximum : float or None
        Allowed range, inclusive unless `above` (minimum excluded) or `below` (maximum excluded) is set.
    choices : tuple of str
        Allowed texts of a choice.
    table : type or None
        Dataclass of a nested table.
    text : str
        One line of meaning.
    """

    kind: str
    text: str
    unit: str = ""
    minimum: float | None = None
    maximum: float | None = None
    above: bool = False
    below: bool = False
    choices: tuple[str, ...] = ()
    table: type | None = None

    def allowed(self) -> str:
        """Say the allowed range in words."""
        if self.choices:
            return ", ".join(self.choices)
        unit = f" {self.unit}" if self.unit not in ("", "1") else ""
        low, high = self.minimum, self.maximum
        if low is not None and high is not None:
            start, end = "(" if self.above else "[", ")" if self.below else "]"
            return f"{start}{low:g}, {high:g}{end}{unit}"
        if low is not None:
            return f"{'>' if self.above else '>='} {low:g}{unit}"
        if high is not None:
            return f"{'<' if self.below else '<='} {high:g}{unit}"
        return f"finite number{unit}"

    def contains(self, value: float) -> bool:
        """Return whether a number is finite and inside the range."""
        if not _finite(value):
            return False
        if self.minimum is not None and (value < self.minimum or (self.above and value == self.minimum)):
            return False
        return not (self.maximum is not None and (value > self.maximum or (self.below and value == self.maximum)))


def _finite(value: float) -> bool:
    try:
        return math.isfinite(value)
    except OverflowError:  # a whole number beyond the range of floats
        return False


def _field(key: Key, default: Any) -> Any:
    if isinstance(default, list):
        raise TypeError("defaults of lists are tuples")
    return dataclasses.field(default=default, metadata={"key": key})


def quantity(unit: str, text: str, default: Any = REQUIRED, minimum: float | None = None, maximum: float | None = None,
             above: float | None = None, below: float | None = None) -> Any:
    """Declare a real number; `above` and `below` are exclusive limits."""
    return _field(Key("real", text, unit, above if minimum is None else minimum, below if maximum is None else maximum,
                      above is not None, below is not None), default)


def quantities(unit: str, text: str, default: Any = REQUIRED, minimum: float | None = None,
               maximum: float | None = None, above: float | None = None) -> Any:
    """Declare a list of real numbers (a tuple in Python)."""
    return _field(Key("reals", text, unit, above if minimum is None else minimum, maximum, above is not None), default)


def grid(unit: str, text: str, default: Any = REQUIRED) -> Any:
    """Declare a list of lists of real numbers."""
    return _field(Key("grid", text, unit), default)


def integer(text: str, default: Any = REQUIRED, minimum: int | None = None, maximum: int | None = None) -> Any:
    """Declare a whole number."""
    return _field(Key("integer", text, minimum=minimum, maximum=maximum), default)


def boolean(text: str, default: Any = REQUIRED) -> Any:
    """Declare a truth value."""
    return _field(Key("boolean", text), default)


def words(text: str, default: Any = REQUIRED) -> Any:
    """Declare a free text."""
    return _field(Key("text", text), default)


def choice(options: tuple[str, ...], text: str, default: Any = REQUIRED) -> Any:
    """Declare one of several texts."""
    return _field(Key("choice", text, choices=options), default)


def file(text: str, default: Any = REQUIRED) -> Any:
    """Declare a file, relative to the scene file."""
    return _field(Key("file", text), default)


def table(kind: type, text: str, default: Any = None) -> Any:
    """Declare a nested table with the keys of the dataclass `kind`."""
    return _field(Key("table", text, table=kind), default)


def keys_of(kind: type) -> dict[str, tuple[Key, bool]]:
    """Return the keys of a dataclass: name of the field -> (declaration, required)."""
    return {f.name: (f.metadata["key"], f.default is REQUIRED)
            for f in dataclasses.fields(kind) if "key" in f.metadata}


def key_name(field: str) -> str:
    """Return the key of a field: its name without the trailing underscore."""
    return field.rstrip("_")


def check_ranges(instance: Any) -> None:
    """Check the parameters of a dataclass instance against their declarations.

    Raises
    ------
    ParameterError
        For the first value that is not a number, not finite, out of range or no listed choice.
    """
    for name, (key, _) in keys_of(type(instance)).items():
        value = getattr(instance, name)
        if value is None:
            continue
        if key.kind in ("real", "integer"):
            _check_number(name, key, value)
        elif key.kind == "reals":
            object.__setattr__(instance, name, tuple(value))
            for one in value:
                _check_number(name, key, one)
        elif key.kind == "grid":
            object.__setattr__(instance, name, tuple(tuple(row) for row in value))
            for row in value:
                for one in row:
                    _check_number(name, key, one)
        elif key.kind == "choice" and value not in key.choices:
            raise ParameterError(key_name(name), value, "not one of the choices", key.allowed())
        elif key.kind == "file":
            object.__setattr__(instance, name, Path(value))


def _check_number(name: str, key: Key, value: Any) -> None:
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        raise ParameterError(key_name(name), value, "not a number", key.allowed())
    if not key.contains(value):
        why = "out of range" if _finite(value) else "not finite"
        raise ParameterError(key_name(name), value, why, key.allowed())
