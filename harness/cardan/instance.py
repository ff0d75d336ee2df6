"""One running FMU: life cycle, values by name, steps and states, at the cost of the bare C calls.

Loading is left to FMPy. The calls of a communication step go to the FMU's C functions directly, with arrays
that are made once (`Instance.plan`): FMPy's own wrappers build new lists and arrays in each call, which costs
about as much as the step itself (docs/NUMERICS.md, "The FMU boundary").
"""

from __future__ import annotations

import ctypes
import os
import sys
import weakref
from array import array
from collections.abc import Iterable

from cardan.description import Description, Value
from cardan.errors import FATAL, FmiError
from cardan.loading import Loaded
from cardan.logger import Message
from cardan.plan import Plan

State = ctypes.c_void_p


class Instance:
    """A loaded and instantiated FMI 2.0 co-simulation FMU.

    Parameters
    ----------
    path : path-like
        The FMU file.
    name : str, optional
        Instance name, seen in the FMU's messages.

    Attributes
    ----------
    description : Description
        Variables, units, capabilities and identity.

    Raises
    ------
    FmuError
        If the file is no usable FMU for this platform.

    Examples
    --------
    >>> with Instance("CardanDriveline.fmu") as fmu:        # doctest: +SKIP
    ...     fmu.set("input.inertia", 0.3)
    ...     fmu.setup(0.0, 1.0, tolerance=1e-9)
    ...     fmu.initialize()
    ...     fmu.set("input.torque", 100.0)
    ...     fmu.step(0.0, 1e-3)
    ...     fmu.get("output.speed")
    """

    def __init__(self, path: str | os.PathLike[str], name: str = "driveline") -> None:
        self._loaded = Loaded(path, name)
        self.description: Description = self._loaded.description
        functions = self._loaded.functions
        self._component = self._loaded.component
        self._states: dict[int | None, State] = {}
        self._plans: weakref.WeakSet[Plan] = weakref.WeakSet()
        self._time, self._size = ctypes.c_double(), ctypes.c_double()
        self._get_real, self._set_real = functions["fmi2GetReal"], functions["fmi2SetReal"]
        self._do_step = functions["fmi2DoStep"]
        self._get_state, self._set_state = functions["fmi2GetFMUstate"], functions["fmi2SetFMUstate"]
        self._free_state = functions["fmi2FreeFMUstate"]

    def __enter__(self) -> Instance:
        return self

    def __exit__(self, *exception: object) -> None:
        self.close()

    def __del__(self) -> None:
        if hasattr(self, "_states") and not sys.is_finalizing():
            self.close()

    def close(self) -> None:
        """Free the instance and remove its unpacked files. May be called again."""
        if self._loaded.alive and not self._loaded.fatal:
            self.free_states()
        self._loaded.close()
        self._retire()

    def _retire(self) -> None:
        """Put a clear error in the place of C functions that would crash from now on."""

        def refuse(*arguments: object) -> int:
            self._loaded.require()
            return 3

        self._get_real = self._set_real = self._do_step = refuse
        self._get_state = self._set_state = self._free_state = refuse
        for plan in self._plans:
            plan.read = plan.write = refuse  # type: ignore[assignment]

    def _failed(self, function: str, status: int, detail: str) -> FmiError:
        if status == FATAL:
            self._retire()
        return self._loaded.failure(function, status, detail)

    def setup(self, start: float = 0.0, stop: float | None = None, tolerance: float | None = None) -> None:
        """Announce the experiment and enter initialization mode.

        Parameters
        ----------
        start, stop : float
            Times, s; None for an open end.
        tolerance : float, optional
            Relative tolerance; None leaves the FMU's own.
        """
        self._loaded.call("setupExperiment", tolerance=tolerance, startTime=start, stopTime=stop)
        self._loaded.call("enterInitializationMode")

    def initialize(self) -> None:
        """Leave initialization mode: outputs are valid afterwards and steps may be done.

        Raises
        ------
        FmiError
            If the FMU finds its start values wrong, with the FMU's own text.
        """
        self._loaded.call("exitInitializationMode")
        complaint = self._loaded.complaint()
        if complaint:
            raise FmiError("fmi2ExitInitializationMode", 3, complaint)

    def reset(self) -> None:
        """Bring the instance back to where it was after instantiation; saved states are freed."""
        self._loaded.require()
        self.free_states()
        self._loaded.call("reset")

    def terminate(self) -> None:
        """End the run; outputs stay readable."""
        self._loaded.call("terminate")

    @property
    def messages(self) -> list[Message]:
        """What the FMU has said so far, the last 1000 messages."""
        return list(self._loaded.callbacks.messages)

    def plan(self, names: Iterable[str]) -> Plan:
        """Make a plan for exchanging Real variables together, with its `Plan.read` and `Plan.write`."""
        plan = Plan([self.description[name] for name in names])
        # Closures: attribute look-ups would add a fifth to each call.
        get_real, set_real, component, failed = self._get_real, self._set_real, self._component, self._failed
        references, count, pointer, values = plan.references, plan.count, plan.pointer, plan.values

        def read() -> array[float]:
            status = get_real(component, references, count, pointer)
            if status > 1:
                raise failed("fmi2GetReal", status, ", ".join(plan.names))
            return values

        def write() -> None:
            status = set_real(component, references, count, pointer)
            if status > 1:
                sent = ", ".join(f"{name} = {value!r}" for name, value in zip(plan.names, values, strict=True))
                raise failed("fmi2SetReal", status, sent)

        plan.read, plan.write = read, write
        self._plans.add(plan)
        return plan

    def get(self, name: str) -> Value:
        """Return the value of one variable of any type, in the unit of its description."""
        variable = self.description[name]
        value = self._loaded.call(f"get{variable.call_type}", [variable.reference], detail=name)[0]
        if variable.type == "Boolean":
            return bool(value)
        result: Value = value.decode("utf-8") if isinstance(value, bytes) else value
        return result

    def set(self, name: str, value: Value) -> None:
        """Set one variable of any type, in the unit of its description.

        Raises
        ------
        InputError
            If there is no such variable or the value is of another type; the message names variable and value.
        FmiError
            If the FMU refuses it, with the FMU's own text.
        """
        variable = self.description[name]
        self._loaded.call(f"set{variable.call_type}", [variable.reference], [variable.converted(value)],
                          detail=f"{name} = {value!r}")

    def step(self, time: float, size: float) -> None:
        """Do one communication step.

        Parameters
        ----------
        time, size : float
            Start and length of the step, s.

        Raises
        ------
        StepRefused
            If the FMU does not do it, with the FMU's last message; the FMU's state is the one before.
        """
        self._time.value = time
        self._size.value = size
        status = self._do_step(self._component, self._time, self._size, 1)
        if status > 1:
            if status == FATAL:
                self._retire()
            raise self._loaded.refusal(time, size, status)

    def get_state(self) -> State:
        """Save the complete state; free it with `free_state` when it is no longer needed."""
        state = ctypes.c_void_p()
        status = self._get_state(self._component, ctypes.byref(state))
        if status > 1:
            raise self._failed("fmi2GetFMUstate", status, self._unsupported())
        self._states[state.value] = state
        return state

    def set_state(self, state: State) -> None:
        """Return to a saved state, which stays usable."""
        status = self._set_state(self._component, state)
        if status > 1:
            raise self._failed("fmi2SetFMUstate", status, self._unsupported())

    def free_state(self, state: State) -> None:
        """Give back the memory of a saved state."""
        if self._states.pop(state.value, None) is not None:
            self._free_state(self._component, ctypes.byref(state))

    def free_states(self) -> None:
        """Give back the memory of all saved states."""
        for state in list(self._states.values()):
            self.free_state(state)

    def serialize(self) -> bytes:
        """Return the complete state as bytes that another instance of the same FMU can take."""
        self._loaded.require()
        state = self.get_state()
        try:
            return bytes(self._loaded.call("serializeFMUstate", state, detail=self._unsupported()))
        finally:
            self.free_state(state)

    def deserialize(self, data: bytes) -> None:
        """Return to a state from `serialize`."""
        state = self._loaded.call("deSerializeFMUstate", data, detail=self._unsupported())
        self._states[state.value] = state
        try:
            self.set_state(state)
        finally:
            self.free_state(state)

    def _unsupported(self) -> str:
        about = self.description
        return "" if about.can_get_set_state and about.can_serialize_state else "the FMU claims no support for it"

