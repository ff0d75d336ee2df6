"""An FMU's library with one instance of it: unpacked, loaded, instantiated, called, and put away again."""

from __future__ import annotations

import ctypes
import os
import threading
import weakref
from typing import Any

from cardan.archive import remove, unpack
from cardan.description import Description, read_description
from cardan.errors import FATAL, FmiError, FmuError, StepRefused
from cardan.logger import Callbacks

# FMPy changes the working directory of the process while it loads a library. The garbage collector may close an
# instance while the same thread loads another one, hence reentrant.
_LOADING = threading.RLock()
_ABANDONED: list[Any] = []  # instances after a fatal error: freeing them crashes, so their callbacks stay alive


class Loaded:
    """One instance, and the failures of its calls as errors with the FMU's own text.

    Parameters
    ----------
    path : path-like
        The FMU file.
    name : str
        Instance name.

    Attributes
    ----------
    description : Description
        What the FMU says about itself.
    callbacks : Callbacks
        Collects its messages.
    functions : ctypes library
        The FMU's C functions without argument types: the fastest way to call them.
    component : ctypes.c_void_p
        The instance.
    alive : bool
        False once closed.
    fatal : str
        Text of a fatal error, after which the instance must not be touched; else empty.
    """

    def __init__(self, path: str | os.PathLike[str], name: str) -> None:
        import fmpy

        self.description: Description = read_description(path)
        directory = unpack(path, fmpy.platform)
        self._files = weakref.finalize(self, remove, directory)
        self.alive = False
        self.fatal = ""
        about = self.description
        library = directory / "binaries" / fmpy.platform / f"{about.identifier}{fmpy.sharedLibraryExtension}"
        try:
            if not library.is_file():
                raise FmuError(f"{about.path} has no binary for this platform ({fmpy.platform})")
            self._instantiate(str(directory), name)
            # A PyDLL call keeps the interpreter lock, which a Python FMU takes again anyway: 8 % faster per step.
            kind: Any = ctypes.CDLL if about.native else ctypes.PyDLL
            self.functions: Any = kind(str(library), handle=self._fmu.dll._handle)
        except BaseException:
            self.close()
            raise
        self.component = ctypes.c_void_p(self._fmu.component)

    def _instantiate(self, directory: str, name: str) -> None:
        from fmpy.fmi2 import FMU2Slave

        about = self.description
        self.callbacks = Callbacks(expand=about.native)
        with _LOADING:
            try:
                self._fmu = FMU2Slave(guid=about.guid, modelIdentifier=about.identifier, instanceName=name,
                                      unzipDirectory=directory)
                # Without logging, FMUs of the common Python export swallow their error texts.
                self._fmu.instantiate(callbacks=self.callbacks.struct, loggingOn=True)
            except Exception as error:  # FMPy raises bare Exception
                said = self.callbacks.take_text()
                raise FmuError(f"{about.path} cannot be instantiated: {error}{f': {said}' if said else ''}") from None
            if not about.native:
                # What a Python slave has said while it was made is delivered with the next call, and freeing the
                # instance before that crashes. Reading nothing delivers it.
                self._fmu.getReal([])
        self.alive = True

    def close(self) -> None:
        """Free the instance and remove the unpacked files. May be called again."""
        if self.alive:
            self.alive = False
            if self.fatal:
                _ABANDONED.append((self._fmu, self.callbacks))
            else:
                with _LOADING:
                    self._fmu.freeInstance()
                self.callbacks.close()
        self._files()

    def require(self) -> None:
        """Raise an `FmuError` if the instance is closed or dead."""
        if not self.alive:
            raise FmuError(f"{self.description.path.name}: the instance is closed; make a new one")
        if self.fatal:
            raise FmuError(f"{self.description.path.name}: the instance is unusable after a fatal error: {self.fatal}")

    def call(self, method: str, *arguments: Any, detail: str = "", **named: Any) -> Any:
        """Call a method of FMPy's `FMU2Slave`; its failure becomes an `FmiError` with the FMU's text."""
        from fmpy.fmi1 import FMICallException

        self.require()
        try:
            return getattr(self._fmu, method)(*arguments, **named)
        except FMICallException as error:
            raise self.failure(error.function, error.status, detail) from None

    def complaint(self) -> str:
        """Return the errors that a Python FMU has told since the last failure although its calls came back good.

        The common Python export can return no error from initialization calls; a message is all it has.
        """
        return "" if self.description.native else self.callbacks.take_text(only_errors=True)

    def failure(self, function: str, status: int, detail: str) -> FmiError:
        """Return the error for a call that came back with a status beyond warning."""
        return FmiError(function, status, self._text(status), detail)

    def refusal(self, time: float, size: float, status: int) -> StepRefused:
        """Return the error for a step that was not done."""
        return StepRefused(time, size, status, self._text(status))

    def _text(self, status: int) -> str:
        text = self.callbacks.take_text()
        if status == FATAL:
            self.fatal = text or "it gave no reason"
        return text
