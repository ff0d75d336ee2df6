"""Ranges and lists on the command line: ``1:200:400``, ``10,20,50``, ``500 rpm:6000 rpm:100``."""

from __future__ import annotations

import math
from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

from cardan.errors import InputError
from cardan.units import UnitError, to_si

Array = NDArray[np.float64]

MOST = 1_000_000


def read_range(text: str | float | Iterable[float | str], unit: str, option: str) -> Array:
    """Return the numbers that a text stands for.

    Parameters
    ----------
    text : str, float or iterable
        ``start:stop:count`` (equally spaced, both ends included; a fourth part ``log`` spaces them by ratio), or
        numbers with commas, each with its unit or in `unit`; numbers and lists of them are taken as they are.
    unit : str
        SI unit of the result.
    option : str
        What it is for, in messages.

    Raises
    ------
    InputError
        If it is no such text.
    """
    form = f"{option} = {text!r}: must be START:STOP:COUNT or numbers with commas"
    if not isinstance(text, str):
        items: list[float | str] = [text] if isinstance(text, (int, float)) else list(text)
        return np.array([_number(item, unit, option) for item in items])
    parts = [part.strip() for part in text.split(":")]
    if len(parts) == 1:
        numbers = [part.strip() for part in text.split(",")]
        if not all(numbers):
            raise InputError(form)
        return np.array([_number(number, unit, option) for number in numbers])
    by_ratio = len(parts) == 4 and parts[3] == "log"
    if len(parts) != 3 and not by_ratio:
        raise InputError(f"{form}, such as 1:200:400")
    start, stop = (_number(part, unit, option) for part in parts[:2])
    try:
        count = int(parts[2])
    except ValueError:
        raise InputError(f"{option} = {text!r}: the count {parts[2]!r} must be a whole number") from None
    if not 1 <= count <= MOST:
        raise InputError(f"{option} = {text!r}: the count must be from 1 to {MOST}")
    if count == 1 and start != stop:
        raise InputError(f"{option} = {text!r}: one point cannot have two ends; give the number alone")
    if by_ratio:
        if start <= 0.0 or stop <= 0.0:
            raise InputError(f"{option} = {text!r}: spacing by ratio needs both ends above 0")
        return np.asarray(np.geomspace(start, stop, count))
    return np.asarray(np.linspace(start, stop, count))


def _number(item: float | str, unit: str, option: str) -> float:
    try:
        value = to_si(item, unit)
    except UnitError as error:
        raise InputError(f"{option}: {error}") from None
    if not math.isfinite(value):
        raise InputError(f"{option} = {item!r}: must be a finite number")
    return value
