"""Names of units to SI exponents: ``N.m.s/rad``, ``kg.m2``, ``rpm``, ``W/(m2.K)``, ``km/h``, ``degC``.

The grammar is that of Modelica and FMI: symbols with an optional prefix and a whole exponent, joined by ``.`` and
``/``; a group in parentheses counts as one. What ``a/b.c`` means is not settled (a/b times c, or a/(b.c)), so
`readings` gives both.
"""

from __future__ import annotations

import math
import re
from typing import NamedTuple

BASE = ("kg", "m", "s", "A", "K", "mol", "cd", "rad")
Exponents = tuple[int, ...]
_NOTHING: Exponents = (0,) * 8


class Reading(NamedTuple):
    """What a unit's name says: value in SI = factor * value + offset, with exponents of `BASE`."""

    factor: float
    exponents: Exponents
    offset: float = 0.0


def _of(factor: float = 1.0, offset: float = 0.0, **powers: int) -> Reading:
    return Reading(factor, tuple(powers.get(base, 0) for base in BASE), offset)


_WATT = {"kg": 1, "m": 2, "s": -3}
_PREFIXED = {
    "m": _of(m=1), "g": _of(1e-3, kg=1), "s": _of(s=1), "A": _of(A=1), "K": _of(K=1), "mol": _of(mol=1),
    "cd": _of(cd=1), "lm": _of(cd=1), "rad": _of(rad=1), "sr": _of(rad=2), "Hz": _of(s=-1), "N": _of(kg=1, m=1, s=-2),
    "Pa": _of(kg=1, m=-1, s=-2), "J": _of(kg=1, m=2, s=-2), "W": _of(**_WATT), "V": _of(**_WATT, A=-1),
    "C": _of(A=1, s=1), "F": _of(kg=-1, m=-2, s=4, A=2), "Ohm": _of(**_WATT, A=-2), "S": _of(kg=-1, m=-2, s=3, A=2),
    "Wb": _of(kg=1, m=2, s=-2, A=-1), "T": _of(kg=1, s=-2, A=-1), "H": _of(kg=1, m=2, s=-2, A=-2),
    "lx": _of(cd=1, m=-2), "Bq": _of(s=-1), "Gy": _of(m=2, s=-2), "Sv": _of(m=2, s=-2), "kat": _of(mol=1, s=-1),
    "l": _of(1e-3, m=3), "L": _of(1e-3, m=3), "bar": _of(1e5, kg=1, m=-1, s=-2),
    "eV": _of(1.602176634e-19, kg=1, m=2, s=-2), "Nm": _of(kg=1, m=2, s=-2), "VA": _of(**_WATT),
    "var": _of(**_WATT), "t": _of(1e3, kg=1),
}
_WHOLE = {
    "1": _of(), "-": _of(), "%": _of(0.01), "ppm": _of(1e-6), "min": _of(60.0, s=1), "h": _of(3600.0, s=1),
    "hr": _of(3600.0, s=1), "d": _of(86400.0, s=1), "deg": _of(math.pi / 180.0, rad=1),
    "\N{DEGREE SIGN}": _of(math.pi / 180.0, rad=1), "rev": _of(2.0 * math.pi, rad=1),
    "rpm": _of(math.pi / 30.0, rad=1, s=-1),
    "degC": _of(1.0, 273.15, K=1), "\N{DEGREE SIGN}C": _of(1.0, 273.15, K=1),
    "degF": _of(5.0 / 9.0, 459.67 * 5.0 / 9.0, K=1), "degK": _of(K=1), "degRk": _of(5.0 / 9.0, K=1),
    "in": _of(0.0254, m=1), "ft": _of(0.3048, m=1), "yd": _of(0.9144, m=1), "mi": _of(1609.344, m=1),
    "lb": _of(0.45359237, kg=1), "lbm": _of(0.45359237, kg=1), "lbf": _of(4.4482216152605, kg=1, m=1, s=-2),
    "psi": _of(6894.757293168361, kg=1, m=-1, s=-2), "atm": _of(101325.0, kg=1, m=-1, s=-2),
    "mph": _of(0.44704, m=1, s=-1),
    "kph": _of(1.0 / 3.6, m=1, s=-1), "kn": _of(1852.0 / 3600.0, m=1, s=-1), "hp": _of(745.6998715822702, **_WATT),
    "rps": _of(2.0 * math.pi, rad=1, s=-1), "\N{OHM SIGN}": _of(**_WATT, A=-2),
    "\N{GREEK CAPITAL LETTER OMEGA}": _of(**_WATT, A=-2),
}
_PREFIXES = {"Y": 1e24, "Z": 1e21, "E": 1e18, "P": 1e15, "T": 1e12, "G": 1e9, "M": 1e6, "k": 1e3, "h": 1e2, "da": 1e1,
             "d": 1e-1, "c": 1e-2, "m": 1e-3, "u": 1e-6, "\N{MICRO SIGN}": 1e-6, "\N{GREEK SMALL LETTER MU}": 1e-6,
             "n": 1e-9, "p": 1e-12, "f": 1e-15, "a": 1e-18}
_RAISED = str.maketrans("\N{SUPERSCRIPT ONE}\N{SUPERSCRIPT TWO}\N{SUPERSCRIPT THREE}\N{SUPERSCRIPT FOUR}"
                        "\N{SUPERSCRIPT MINUS}\N{MIDDLE DOT}\N{DOT OPERATOR}", "1234-..")
_TOKEN = re.compile(r"([./*()])|(1(?![0-9])|%|-(?![0-9])|[^\W\d_]+|\N{DEGREE SIGN}[A-Za-z]*)"
                    r"(?:(?:\^|\*\*)?([+-]?\d+))?")


def readings(name: str) -> list[Reading]:
    """Return what the name of a unit can mean: one reading, two where ``a/b.c`` is open, none where it is unknown.

    Parameters
    ----------
    name : str
        Unit name as in the model description; empty for no unit.
    """
    text = name.strip().translate(_RAISED)
    if not text:
        return [_of()]
    found: list[Reading] = []
    for far in (False, True):
        try:
            reading, rest = _product(_tokens(text), far)
        except ValueError:
            return []
        if rest:
            return []
        if reading not in found:
            found.append(reading)
    return found


def _tokens(text: str) -> list[tuple[str, str]]:
    tokens, place = [], 0
    text = re.sub(r"\s*([./*()])\s*", r"\1", text).replace(" ", ".")
    while place < len(text):
        match = _TOKEN.match(text, place)
        if match is None:
            raise ValueError(text)
        tokens.append((match[1], "") if match[1] else (match[2], match[3] or "1"))
        place = match.end()
    return tokens


def _product(tokens: list[tuple[str, str]], far: bool) -> tuple[Reading, list[tuple[str, str]]]:
    """Read factors up to a closing parenthesis; with `far` a ``/`` divides by all that follows."""
    factor, exponents, offset, sign, count = 1.0, _NOTHING, 0.0, 1, 0
    while True:
        if not tokens:
            raise ValueError("a factor is missing")
        if tokens[0][0] == "(":
            one, tokens = _product(tokens[1:], far)
            if not tokens or tokens[0][0] != ")":
                raise ValueError("a parenthesis is missing")
            tokens, power = tokens[1:], sign
        else:
            one, power = _symbol(tokens[0][0]), sign * int(tokens[0][1] or "0")
            tokens = tokens[1:]
        factor *= one.factor**power
        exponents = tuple(have + power * more for have, more in zip(exponents, one.exponents))
        offset = one.offset if count == 0 and power == 1 else 0.0
        count += 1
        if not tokens or tokens[0][0] == ")":
            return Reading(factor, exponents, offset if count == 1 else 0.0), tokens
        operator = tokens[0][0]
        if operator not in (".", "*", "/"):
            raise ValueError(operator)
        sign = -1 if operator == "/" or (far and sign == -1) else 1
        tokens = tokens[1:]


def _symbol(name: str) -> Reading:
    if name in _WHOLE:
        return _WHOLE[name]
    if name in _PREFIXED:
        return _PREFIXED[name]
    for prefix, factor in _PREFIXES.items():
        base = _PREFIXED.get(name[len(prefix):]) if name.startswith(prefix) else None
        if base is not None:
            return Reading(factor * base.factor, base.exponents)
    raise ValueError(name)
