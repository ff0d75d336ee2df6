"""What FMUs say: callbacks that collect the texts of each instance."""

from __future__ import annotations

import ctypes
import itertools
from collections import deque
from typing import Any, NamedTuple

LONGEST = 1000  # messages kept per instance


class Message(NamedTuple):
    """One message: FMI status (0 ok .. 4 fatal), the FMU's category, text."""

    status: int
    category: str
    text: str


_BOXES: dict[int, deque[Message]] = {}
_NUMBERS = itertools.count(1)
_COMMON: dict[bool, Any] = {}  # callback structs without and with expansion, made on first use


class Callbacks:
    """Callbacks of one instance; they must outlive it.

    Parameters
    ----------
    expand : bool
        Whether the FMU's texts are printf formats with arguments, as FMI says. Python FMUs send plain texts,
        in which a per cent sign would be taken for a format and crash.

    Attributes
    ----------
    struct : ctypes.Structure
        What fmi2Instantiate takes.
    messages : collections.deque of Message
        The last 1000.
    """

    def __init__(self, expand: bool) -> None:
        from fmpy.fmi2 import fmi2CallbackFunctions

        self.messages: deque[Message] = deque(maxlen=LONGEST)
        self._number = next(_NUMBERS)
        self._reported: Message | None = None
        _BOXES[self._number] = self.messages
        common = _common(expand)
        self.struct = fmi2CallbackFunctions()
        ctypes.memmove(ctypes.byref(self.struct), ctypes.byref(common), ctypes.sizeof(common))
        self.struct.componentEnvironment = self._number

    def take_text(self, only_errors: bool = False) -> str:
        """Return what was said since the last call: discards and errors, or without any the last other text.

        Parameters
        ----------
        only_errors : bool
            Whether other texts than discards and errors are left alone.

        Returns
        -------
        str
            Texts, joined; empty where nothing was said.
        """
        fresh: list[Message] = []
        for message in reversed(self.messages):
            if message is self._reported:
                break
            fresh.insert(0, message)
        serious = [message.text for message in fresh if message.status > 1]
        if only_errors and not serious:
            return ""
        if fresh:
            self._reported = fresh[-1]
        return "; ".join(dict.fromkeys(serious or [message.text for message in fresh[-1:]]))

    def close(self) -> None:
        """Forget the instance; messages stay readable."""
        _BOXES.pop(self._number, None)


def _common(expand: bool) -> Any:
    if expand not in _COMMON:
        from fmpy import calloc, fmi2, free

        struct = fmi2.fmi2CallbackFunctions()
        struct.logger = fmi2.fmi2CallbackLoggerTYPE(_receive)
        struct.allocateMemory = fmi2.fmi2CallbackAllocateMemoryTYPE(calloc)
        struct.freeMemory = fmi2.fmi2CallbackFreeMemoryTYPE(free)
        if expand:
            _add_proxy(struct)
        _COMMON[expand] = struct
    return _COMMON[expand]


def _add_proxy(struct: Any) -> None:
    # FMPy's native proxy expands the format. It knows ONE receiver per process, so all instances share
    # `_receive`, which tells them apart by the component environment.
    try:
        from fmpy.logging import addLoggerProxy
    except OSError:  # no native library for this platform: texts arrive unexpanded
        return
    addLoggerProxy(ctypes.byref(struct))


def _receive(environment: int | None, name: bytes, status: int, category: bytes | None, text: bytes | None) -> None:
    box = _BOXES.get(environment or 0)
    if box is not None:
        box.append(Message(status, _decoded(category), _decoded(text)))
    elif environment is None:  # an FMU that FMPy runs with its own callbacks
        print(f"[{status}] {_decoded(text)}")


def _decoded(text: bytes | None) -> str:
    return (text or b"").decode("utf-8", "replace").strip()
