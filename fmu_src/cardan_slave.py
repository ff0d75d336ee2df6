"""The FMI side of the driveline: a thin pythonfmu slave around `cardan_kernel.Driveline`.

The exporter calls Python methods by name on the slave. The kernel's own methods stand there as
attributes of the instance, which saves a Python call each and makes a step cost what the kernel costs.

An exception that leaves a callback ends in fmi2Fatal, and freeing the instance after that crashes the
host. So nothing leaves: the kernel answers bad input by itself, and the callbacks of an interpreted
kernel, which a signal can interrupt anywhere, are guarded.

The first log message of an instance (status OK, category ``logAll``, with setup_experiment) tells what runs, for
example ``cardan_kernel 0.1.0: compiled kernel``. It must not be queued earlier: the exporter crashes when an instance
that has a message from its constructor is freed without another call.

In the FMU this file, the kernel and pythonfmu's modules carry names made from their content (the build
renames them here and in the imports), so that neither the host's modules nor another FMU's are run.
"""

import sys

# Cython enters a compiled module under the name it was compiled with too, which is the host's.
COMPILED_AS = "cardan_kernel._compiled"
_host_has_it = COMPILED_AS in sys.modules

from cardan_kernel import KERNEL, Driveline, __version__  # noqa: E402
from pythonfmu.fmi2slave import Fmi2Slave  # noqa: E402
from pythonfmu.logmsg import LogMsg  # noqa: E402

if __name__ != "cardan_slave" and not _host_has_it:
    sys.modules.pop(COMPILED_AS, None)

OK, WARNING, DISCARD, ERROR = 0, 1, 2, 3
CATEGORIES = ("logAll", "logStatusWarning", "logStatusDiscard", "logStatusError")

# What the exporter calls: slave's name, kernel's name, and the answer that keeps the host alive when the call fails.
CALLBACKS = (
    ("setup_experiment", "setup_experiment", lambda *_: None),
    ("enter_initialization_mode", "enter_initialization_mode", lambda *_: None),
    ("exit_initialization_mode", "exit_initialization_mode", lambda *_: None),
    ("do_step", "do_step", lambda *_: False),
    ("terminate", "terminate", lambda *_: None),
    ("get_real", "get_real", lambda references: [float("nan")] * len(references)),
    ("get_integer", "get_integer", lambda references: [0] * len(references)),
    ("get_boolean", "get_boolean", lambda references: [False] * len(references)),
    ("set_real", "set_real", lambda *_: None),
    ("set_integer", "set_integer", lambda *_: None),
    ("set_boolean", "set_boolean", lambda *_: None),
    ("_get_fmu_state", "get_state", lambda *_: b""),
    ("_set_fmu_state", "set_state", lambda *_: None),
)


def reporter(queue):
    """Give the function that queues messages for the importer.

    It knows the queue alone and not the slave, so that no cycle keeps a freed instance alive.

    Parameters
    ----------
    queue : list
        Queue that the exporter empties after each call.

    Returns
    -------
    callable
        ``report(status, text)``; status 0 OK, 1 warning, 2 discard, 3 error. What is not ASCII is escaped, and
        percent signs are spelled: importers hand the text to printf as a format.
    """

    def report(status, text):
        try:
            plain = str(text).encode("ascii", "backslashreplace").decode("ascii").replace("%", " percent")
            queue.append(LogMsg(status, CATEGORIES[status], plain))
        except BaseException:  # an importer without the message is better off than one that crashed
            pass

    return report


def guarded(method, otherwise, report):
    """Give `method` so that a failure is reported and answered with ``otherwise(...)``."""

    def call(*arguments):
        try:
            return method(*arguments)
        except BaseException as error:
            report(ERROR, f"{method.__name__} failed: {error!r}")
            return otherwise(*arguments)

    return call


def announced(method, line, report):
    """Give `method` so that it tells `line` first."""

    def call(*arguments):
        report(OK, line)
        return method(*arguments)

    return call


def absent(name, otherwise, reason, report):
    """Give the stand-in for a kernel method where the kernel could not be made."""

    def call(*arguments):
        report(ERROR, f"{name} is refused: the driveline could not be made: {reason}")
        return otherwise(*arguments)

    return call


class CardanDriveline(Fmi2Slave):
    """Universal-joint driveline with one or two joints, rigid or compliant."""

    def __init__(self, **kwargs):
        super().__init__(**kwargs)
        self.report = report = reporter(self.log_queue)
        core, reason = None, ""
        try:
            core = Driveline(report)
        except BaseException as error:  # an instance that cannot work still has to answer
            reason = repr(error)
        for own, name, otherwise in CALLBACKS:
            method = getattr(core, name, None)
            if method is None:
                method = absent(name, otherwise, reason, report)
            elif KERNEL == "interpreted":
                method = guarded(method, otherwise, report)
            setattr(self, own, method)
        slower = "" if KERNEL == "compiled" else " (no compiled one fits here; same results, slower)"
        line = f"cardan_kernel {__version__}: {KERNEL} kernel{slower}"
        self.setup_experiment = announced(self.setup_experiment, line, report)
        # The exporter puts the unzipped FMU in front of the host's path, once per instance. All imports are done by
        # now. "visible" tells the exporter's call from the builder's, which takes its entry back by itself.
        if "visible" in kwargs:
            sys.path[:] = [entry for entry in sys.path if entry != kwargs.get("resources")]

    def get_string(self, vrs):
        """There are no String variables."""
        self.report(ERROR, f"get_string is refused: value references {vrs} are no String variables")
        return [""] * len(vrs)

    def set_string(self, vrs, values):
        """There are no String variables."""
        self.report(ERROR, f"set_string is refused: value references {vrs} are no String variables")

    def do_step(self, current_time, step_size):
        """Never called: the kernel's method stands in front of it in every instance."""
        return False

    @staticmethod
    def _fmu_state_to_bytes(state):
        return state

    @staticmethod
    def _fmu_state_from_bytes(state):
        return state
