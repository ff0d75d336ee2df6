"""Text with a unit to SI numbers, and back for display.

``"3000 rpm"`` becomes 314.159... where ``rad/s`` is expected; ``"3 kg"`` there is an error that names the text,
the expected unit and examples. A dimension is the vector of exponents of kg, m, s and rad (the plane angle is
kept, so that N.m and N.m/rad are told apart). The grammar is that of FMI unit names: symbols joined by ``.`` and
``/``, each with an optional whole exponent (``kg.m2``, ``N.m.s/rad``, ``1/s``); everything after one ``/`` up to
the next ``.`` or ``/`` divides.
"""

from __future__ import annotations

import math
import re
from functools import cache
from typing import NamedTuple

Exponents = tuple[int, int, int, int]  # kg, m, s, rad


class UnitError(ValueError):
    """A text that is no number with a unit, or whose unit does not fit."""


class Unit(NamedTuple):
    """A unit: factor to SI and exponents of kg, m, s, rad."""

    factor: float
    exponents: Exponents


_NONE: Exponents = (0, 0, 0, 0)
_FORCE: Exponents = (1, 1, -2, 0)
_ENERGY: Exponents = (1, 2, -2, 0)
_POWER: Exponents = (1, 2, -3, 0)
_PRESSURE: Exponents = (1, -1, -2, 0)
_LENGTH: Exponents = (0, 1, 0, 0)
_TIME: Exponents = (0, 0, 1, 0)
_ANGLE: Exponents = (0, 0, 0, 1)

# symbols that take an SI prefix
_PREFIXED: dict[str, Unit] = {
    "g": Unit(1e-3, (1, 0, 0, 0)),
    "m": Unit(1.0, _LENGTH),
    "s": Unit(1.0, _TIME),
    "rad": Unit(1.0, _ANGLE),
    "N": Unit(1.0, _FORCE),
    "J": Unit(1.0, _ENERGY),
    "W": Unit(1.0, _POWER),
    "Pa": Unit(1.0, _PRESSURE),
    "Hz": Unit(1.0, (0, 0, -1, 0)),
    "Nm": Unit(1.0, _ENERGY),
}
_PREFIXES = {"G": 1e9, "M": 1e6, "k": 1e3, "c": 1e-2, "m": 1e-3, "u": 1e-6, "n": 1e-9}

_SYMBOLS: dict[str, Unit] = {
    **_PREFIXED,
    "1": Unit(1.0, _NONE),
    "%": Unit(0.01, _NONE),
    "kg": Unit(1.0, (1, 0, 0, 0)),
    "t": Unit(1e3, (1, 0, 0, 0)),
    "lb": Unit(0.45359237, (1, 0, 0, 0)),
    "in": Unit(0.0254, _LENGTH),
    "ft": Unit(0.3048, _LENGTH),
    "lbf": Unit(4.4482216152605, _FORCE),
    "l": Unit(1e-3, (0, 3, 0, 0)),
    "L": Unit(1e-3, (0, 3, 0, 0)),
    "min": Unit(60.0, _TIME),
    "h": Unit(3600.0, _TIME),
    "bar": Unit(1e5, _PRESSURE),
    "deg": Unit(math.pi / 180.0, _ANGLE),
    "\N{DEGREE SIGN}": Unit(math.pi / 180.0, _ANGLE),
    "rev": Unit(2.0 * math.pi, _ANGLE),
    "rpm": Unit(math.pi / 30.0, (0, 0, -1, 1)),
    "mph": Unit(0.44704, (0, 1, -1, 0)),
    "kph": Unit(1.0 / 3.6, (0, 1, -1, 0)),
}

_EXAMPLES: dict[Exponents, tuple[str, ...]] = {
    _NONE: ("0.05", "5 %"),
    _ANGLE: ("20 deg", "0.35 rad"),
    (0, 0, -1, 1): ("3000 rpm", "314 rad/s"),
    (0, 0, -2, 1): ("100 rad/s2", "50 rpm/s"),
    (0, 0, -3, 1): ("100 rad/s3",),
    _TIME: ("2 ms", "10 s"),
    (0, 0, -1, 0): ("50 Hz", "10 1/s"),
    _LENGTH: ("1.5 m", "30 mm"),
    (0, 2, 0, 0): ("2.88 m2", "50 cm2"),
    (0, 3, 0, 0): ("2.8 l", "0.0028 m3"),
    (0, 1, -1, 0): ("10 km/h", "5 m/s"),
    (0, 1, -2, 0): ("9.81 m/s2",),
    (1, 0, 0, 0): ("2325 kg", "800 g"),
    (1, -3, 0, 0): ("1.2 kg/m3",),
    (1, 2, 0, 0): ("0.2 kg.m2",),
    _FORCE: ("200 N", "2 kN"),
    (1, 0, -1, 0): ("5 N.s/m",),
    (1, -1, 0, 0): ("0.5 N.s2/m2",),
    _ENERGY: ("80 N.m", "0.4 kN.m"),
    _POWER: ("135 kW", "50 N.m/s"),
    (1, 2, -2, -1): ("8000 N.m/rad", "140 N.m/deg"),
    (1, 2, -1, -1): ("2 N.m.s/rad", "0.2 N.m/rpm"),
    (1, 2, 0, -2): ("0.01 N.m.s2/rad2",),
    _PRESSURE: ("1 bar", "100 kPa"),
}

_NUMBER = re.compile(r"\s*([+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?|[+-]?(?:inf|nan|infinity)\b)"
                     r"\s*(.*?)\s*\Z", re.IGNORECASE)
_HEADING = re.compile(r"\s*(.*?)\s*\[([^\[\]]*)\]\s*\Z")
_TOKEN = re.compile(r"(1|%|\N{DEGREE SIGN}|[A-Za-z]+)(?:\^|\*\*)?(-?[0-9]+)?")


def _symbol(name: str) -> Unit:
    found = _SYMBOLS.get(name)
    if found is not None:
        return found
    base = _PREFIXED.get(name[1:]) if len(name) > 1 else None
    if base is not None and name[0] in _PREFIXES:
        return Unit(_PREFIXES[name[0]] * base.factor, base.exponents)
    raise UnitError(f"unknown unit {name!r}")


@cache
def parse_unit(text: str) -> Unit:
    """Return the factor to SI and the exponents of a unit such as ``N.m.s/rad``; empty text is dimensionless.

    Raises
    ------
    UnitError
        If a symbol is unknown or the text is malformed.
    """
    rest = re.sub(r"\s*([./*])\s*", r"\1", text.strip()).replace("*", ".").replace(" ", ".")
    if rest == "":
        return Unit(1.0, _NONE)
    factor, exponents = 1.0, list(_NONE)
    sign, place = 1, 0
    while True:
        token = _TOKEN.match(rest, place)
        if token is None:
            raise UnitError(f"malformed unit {text!r}")
        unit = _symbol(token[1])
        try:
            power = sign * int(token[2] or 1)
            factor *= unit.factor**power
        except (ArithmeticError, ValueError):  # ValueError: an exponent of thousands of digits
            factor = math.inf
        if not 0.0 < factor < math.inf:
            raise UnitError(f"unit {text!r} is beyond the range of numbers")
        exponents = [e + power * u for e, u in zip(exponents, unit.exponents)]
        place = token.end()
        if place == len(rest):
            return Unit(factor, (exponents[0], exponents[1], exponents[2], exponents[3]))
        if rest[place] not in "./":
            raise UnitError(f"malformed unit {text!r}")
        sign = -1 if rest[place] == "/" else 1
        place += 1


def examples(unit: str) -> tuple[str, ...]:
    """Return texts that would be accepted where `unit` is expected."""
    return _EXAMPLES.get(parse_unit(unit).exponents, (f"1.5 {unit}",))


def to_si(value: float | str, unit: str) -> float:
    """Convert a number (taken as SI) or a text with a unit to a number in the SI unit `unit`.

    Parameters
    ----------
    value : float or str
        ``80``, ``"80"`` (both in `unit`), ``"80 N.m"``.
    unit : str
        Expected unit, such as ``"N.m"``; ``""`` or ``"1"`` for none.

    Raises
    ------
    UnitError
        If the text is no number with a unit, or the unit has another dimension. The message names the text, the
        expected unit and examples. Infinite and NaN numbers pass: ranges are the caller's business.
    """
    if isinstance(value, (int, float)) and not isinstance(value, bool):
        try:
            return float(value)
        except OverflowError:
            raise UnitError("a whole number beyond the range of numbers") from None
    wanted = unit or "1"
    hint = f"expected {'a plain number' if wanted == '1' else 'unit ' + wanted}, for example " + " or ".join(
        repr(e) for e in examples(unit))
    if not isinstance(value, str):
        raise UnitError(f"{value!r} is no number with a unit; {hint}")
    found = _NUMBER.match(value)
    if found is None:
        raise UnitError(f"{value!r} is no number with a unit; {hint}")
    try:
        number = float(found[1])
    except ValueError:  # letters that only look like those of "inf"
        raise UnitError(f"{value!r} is no number with a unit; {hint}") from None
    if found[2] == "":
        return number
    try:
        given = parse_unit(found[2])
    except UnitError as error:
        raise UnitError(f"{value!r}: {error}; {hint}") from None
    target = parse_unit(unit)
    if given.exponents != target.exponents:
        raise UnitError(f"{value!r}: unit {found[2]!r} does not fit; {hint}")
    return number * given.factor / target.factor


def from_si(value: float, unit: str, display: str) -> float:
    """Convert a number in `unit` to the display unit, for example rad/s to rpm.

    Raises
    ------
    UnitError
        If the two units have different dimensions.
    """
    source, target = parse_unit(unit), parse_unit(display)
    if source.exponents != target.exponents:
        raise UnitError(f"{display!r} is no unit for {unit!r}")
    return value * source.factor / target.factor


def split_heading(text: str) -> tuple[str, str]:
    """Return name and unit of a column heading: ``"T [kN.m]"`` is ``("T", "kN.m")``; without brackets no unit."""
    found = _HEADING.match(text)
    return (found[1], found[2]) if found is not None else (text.strip(), "")
