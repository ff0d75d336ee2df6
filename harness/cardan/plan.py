"""Variables that are exchanged together, with the arrays for it made once."""

from __future__ import annotations

import ctypes
from array import array
from collections.abc import Callable, Sequence
from typing import Any

from cardan.description import Variable
from cardan.errors import InputError


class Plan:
    """Real variables in a fixed order, with their value references and a buffer for their values.

    Parameters
    ----------
    variables : sequence of Variable
        All of type Real.

    Attributes
    ----------
    names : tuple of str
        Variables, in order.
    units : tuple of str
        Their units.
    values : array.array of float
        The buffer that `read` fills and `write` sends; change its items, not its length.
    read, write : callable
        Set by the instance that made the plan: fetch the values and return the buffer, or send it.

    Raises
    ------
    InputError
        If a variable is not Real.
    """

    __slots__ = ("__weakref__", "count", "names", "pointer", "read", "references", "units", "values", "write")

    read: Callable[[], array[float]]
    write: Callable[[], None]

    def __init__(self, variables: Sequence[Variable]) -> None:
        for variable in variables:
            if variable.type != "Real":
                raise InputError(f"{variable.name} is of type {variable.type}; only Real variables go into a plan")
        self.names = tuple(variable.name for variable in variables)
        self.units = tuple(variable.unit for variable in variables)
        count = len(variables)
        self.values = array("d", bytes(8 * count))
        self.references = (ctypes.c_uint * count)(*(variable.reference for variable in variables))
        self.count = ctypes.c_size_t(count)
        self.pointer: Any = (ctypes.c_double * count).from_buffer(self.values) if count else None
