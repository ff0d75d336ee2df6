"""The FMU's library, loaded once per process."""

from __future__ import annotations

from typing import Any

from cardan.check.base import Refused
from cardan.check.subject import Subject

_LIBRARIES: dict[str, Any] = {}


def library(subject: Subject) -> Any:
    """Load the FMU's library once per process; its functions have their argument types.

    Raises
    ------
    Refused
        If it cannot be loaded or lacks a function of FMI 2.0.
    """
    from fmpy.fmi2 import FMU2Slave

    key = str(subject.directory)
    if key not in _LIBRARIES:
        subject.trail.mark("loading the library")
        try:
            _LIBRARIES[key] = FMU2Slave(guid=subject.model.guid or "", unzipDirectory=key, instanceName="check",
                                        modelIdentifier=subject.capability.modelIdentifier)
        except Exception as error:  # FMPy raises bare Exception, and AttributeError for a missing function
            raise Refused(f"the library cannot be loaded: {error}") from None
    return _LIBRARIES[key].dll
