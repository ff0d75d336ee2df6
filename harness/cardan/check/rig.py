"""One bare instance of an FMU: every C function by its name, every status seen, every call noted.

`cardan.instance.Instance` protects its user from an FMU's faults; a check wants to see them, so it does not
use it.
"""

from __future__ import annotations

import ctypes
from collections.abc import Mapping, Sequence
from typing import Any

from cardan.check.base import Refused
from cardan.check.library import library
from cardan.check.quantities import Value
from cardan.check.subject import Subject
from cardan.logger import Callbacks, Message

STATUS = ("OK", "warning", "discard", "error", "fatal", "pending")
OK, WARNING, DISCARD, ERROR, FATAL, PENDING = range(6)
_TYPES: dict[str, Any] = {"Real": ctypes.c_double, "Integer": ctypes.c_int, "Boolean": ctypes.c_int,
                          "String": ctypes.c_char_p}


class Rig:
    """One instance, made at once.

    Parameters
    ----------
    subject : Subject
        The FMU.
    name : str
        Instance name.
    logging : bool
        Whether debug logging is on.
    guid : str, optional
        Another GUID than that of the model description.
    resources : str, optional
        Another resource location (URI) than the right one.

    Attributes
    ----------
    callbacks : cardan.logger.Callbacks
        Collects the FMU's messages.
    alive : bool
        False after the instance was freed, and after a fatal error, when it must not be touched again.

    Raises
    ------
    Refused
        If there is no instance.
    """

    def __init__(self, subject: Subject, name: str = "check", logging: bool = True, guid: str | None = None,
                 resources: str | None = None, visible: bool = False) -> None:
        self.subject = subject
        self.library = library(subject)
        self.callbacks = Callbacks(expand=subject.native)
        location = resources or (subject.directory / "resources").as_uri()
        subject.trail.mark("fmi2Instantiate")
        self.component = self.library.fmi2Instantiate(
            name.encode(), 1, (subject.model.guid if guid is None else guid).encode(), location.encode(),
            ctypes.byref(self.callbacks.struct), int(visible), int(logging))
        self.alive = bool(self.component)
        if not self.alive:
            raise Refused(f"fmi2Instantiate returned no instance{self._said(None)}")

    # ---- calls

    def status(self, function: str, *arguments: Any, what: str = "") -> int:
        """Call a C function of the instance and return its status, whatever it is."""
        self.subject.trail.mark(f"{function}({what})")
        try:
            status: int = getattr(self.library, function)(self.component, *arguments)
        except SystemError as error:  # a Python FMU that leaves its exception to whoever comes next
            self.alive = False
            raise Refused(f"{function}({what}) left an exception in the interpreter: {error.__cause__!r}") from None
        if status == FATAL:
            self.alive = False
        return status

    def good(self, function: str, *arguments: Any, what: str = "") -> None:
        """Call a C function that has to work.

        Raises
        ------
        Refused
            If it returns anything but OK or a warning.
        """
        before = self.latest
        status = self.status(function, *arguments, what=what)
        if status not in (OK, WARNING):
            raise Refused(f"{function}({what}) returned {name_of(status)}{self._said(before)}")

    def setup(self, start: float, stop: float | None = None, tolerance: float | None = None) -> int:
        """Call fmi2SetupExperiment and return its status."""
        what = f"start {start!r}, stop {stop!r}, tolerance {tolerance!r}"
        return self.status("fmi2SetupExperiment", int(tolerance is not None), tolerance or 0.0, start,
                           int(stop is not None), stop or 0.0, what=what)

    def begin(self, tolerance: float | None = None, stop: float | None = None) -> None:
        """Announce the experiment and enter initialization mode; both have to work."""
        before = self.latest
        status = self.setup(self.subject.experiment.start, stop, tolerance)
        if status > WARNING:
            raise Refused(f"fmi2SetupExperiment returned {name_of(status)}{self._said(before)}")
        self.good("fmi2EnterInitializationMode")

    def initialize(self) -> None:
        """Leave initialization mode; an error that is only told counts as one."""
        before = self.latest
        self.good("fmi2ExitInitializationMode")
        if any(message.status > WARNING for message in self.messages(before)):
            raise Refused(f"the initialization is refused{self._said(before)}")

    def start(self, values: Mapping[Any, Value] | None = None, tolerance: float | None = None) -> None:
        """Initialize with these values."""
        self.begin(tolerance)
        self.set(values or {})
        self.initialize()

    def step(self, time: float, size: float) -> int:
        """Call fmi2DoStep and return its status."""
        return self.status("fmi2DoStep", time, size, 1, what=f"t = {time!r}, h = {size!r}")

    def go(self, time: float, size: float) -> None:
        """Do a step that has to work."""
        self.good("fmi2DoStep", time, size, 1, what=f"t = {time!r}, h = {size!r}")

    def free(self) -> None:
        """Free the instance, unless a fatal error forbids it."""
        if self.alive:
            self.subject.trail.mark("fmi2FreeInstance")
            self.library.fmi2FreeInstance(self.component)
            self.alive = False
        self.callbacks.close()

    # ---- values

    def fetch(self, variable: Any) -> tuple[int, Value]:
        """Return the status of reading one variable, and what came back."""
        kind = _kind(variable)
        buffer = (_TYPES[kind] * 1)()
        status = self.status(f"fmi2Get{kind}", (ctypes.c_uint * 1)(variable.valueReference), 1, buffer,
                             what=variable.name)
        return status, _value(kind, buffer[0])

    def get(self, variables: Sequence[Any]) -> list[Value]:
        """Return the values of variables of any types; reading has to work."""
        found: dict[int, Value] = {}
        for kind in _TYPES:
            places = [place for place, each in enumerate(variables) if _kind(each) == kind]
            if places:
                count = len(places)
                buffer = (_TYPES[kind] * count)()
                references = (ctypes.c_uint * count)(*(variables[place].valueReference for place in places))
                names = variables[places[0]].name if count == 1 else f"{count} variables"
                self.good(f"fmi2Get{kind}", references, count, buffer, what=names)
                found.update((place, _value(kind, buffer[i])) for i, place in enumerate(places))
        return [found[place] for place in range(len(variables))]

    def put(self, variable: Any, value: Value) -> int:
        """Set one variable and return the status."""
        kind = _kind(variable)
        plain = str(value).encode() if kind == "String" else value
        return self.status(f"fmi2Set{kind}", (ctypes.c_uint * 1)(variable.valueReference), 1,
                           (_TYPES[kind] * 1)(plain), what=f"{variable.name} = {value!r}")

    def set(self, values: Mapping[Any, Value]) -> None:
        """Set variables; it has to work."""
        for variable, value in values.items():
            before = self.latest
            status = self.put(variable, value)
            if status > WARNING:
                raise Refused(f"setting {variable.name} = {value!r} returned {name_of(status)}{self._said(before)}")

    # ---- states

    def save(self) -> ctypes.c_void_p:
        """Return a new saved state."""
        state = ctypes.c_void_p()
        self.good("fmi2GetFMUstate", ctypes.byref(state))
        return state

    def restore(self, state: ctypes.c_void_p) -> None:
        """Return to a saved state."""
        self.good("fmi2SetFMUstate", state)

    def forget(self, state: ctypes.c_void_p) -> None:
        """Free a saved state."""
        self.good("fmi2FreeFMUstate", ctypes.byref(state))

    def pack(self, state: ctypes.c_void_p) -> bytes:
        """Return a saved state as bytes."""
        size = ctypes.c_size_t()
        self.good("fmi2SerializedFMUstateSize", state, ctypes.byref(size))
        buffer = ctypes.create_string_buffer(size.value)
        self.good("fmi2SerializeFMUstate", state, buffer, size.value)
        return buffer.raw

    def unpack(self, data: bytes) -> ctypes.c_void_p:
        """Return a saved state from bytes."""
        state = ctypes.c_void_p()
        self.good("fmi2DeSerializeFMUstate", ctypes.create_string_buffer(data, len(data)), len(data),
                  ctypes.byref(state))
        return state

    # ---- messages

    @property
    def latest(self) -> Message | None:
        """The last message so far."""
        return self.callbacks.messages[-1] if self.callbacks.messages else None

    def messages(self, since: Message | None = None) -> list[Message]:
        """Return the messages after the message `since`, of the last 1000."""
        fresh = []
        for message in reversed(self.callbacks.messages):
            if message is since:
                break
            fresh.append(message)
        return fresh[::-1]

    def _said(self, since: Message | None) -> str:
        texts = [message.text for message in self.messages(since) if message.text]
        return f": {'; '.join(dict.fromkeys(texts))}" if texts else " without a text"


def name_of(status: int) -> str:
    """Return a status in words."""
    return STATUS[status] if 0 <= status < len(STATUS) else f"the unknown status {status}"


def _kind(variable: Any) -> str:
    return "Integer" if variable.type == "Enumeration" else str(variable.type)


def _value(kind: str, raw: Any) -> Value:
    if kind == "String":
        return (raw or b"").decode("utf-8", "replace")
    return bool(raw) if kind == "Boolean" else raw
