"""An importer of the standard library alone, for any Python: ctypes, no numpy, no FMPy.

``pythonX.Y -I -S -B ctypes_host.py`` reads a job from standard input: ``library``, ``resources`` (URI), ``guid``,
``starts`` (list of kind, reference, value), ``inputs``, ``outputs``, ``mode`` and ``count``; modes as in host.c. It
prints one JSON object and leaves at once (docs/FMI.md, trap 11).
"""

import ctypes
import json
import os
import sys
import threading

LOGGER = ctypes.CFUNCTYPE(None, ctypes.c_void_p, ctypes.c_char_p, ctypes.c_int, ctypes.c_char_p, ctypes.c_char_p)


class Callbacks(ctypes.Structure):
    _fields_ = [("logger", LOGGER), ("allocate", ctypes.c_void_p), ("release", ctypes.c_void_p),
                ("finished", ctypes.c_void_p), ("environment", ctypes.c_void_p)]


class Host:
    """One instance."""

    def __init__(self, job, name="host"):
        self.job = job
        self.messages = []
        library = ctypes.CDLL(job["library"])
        library.fmi2Instantiate.restype = ctypes.c_void_p
        memory = ctypes.CDLL(None)
        self.callbacks = Callbacks(LOGGER(self._log), ctypes.cast(memory.calloc, ctypes.c_void_p),
                                   ctypes.cast(memory.free, ctypes.c_void_p), None, None)
        self.library = library
        self.instance = ctypes.c_void_p(library.fmi2Instantiate(
            name.encode(), 1, job["guid"].encode(), job["resources"].encode(), ctypes.byref(self.callbacks), 0, 1))
        assert self.instance.value, "fmi2Instantiate gave no instance"
        self.call("fmi2SetupExperiment", 0, ctypes.c_double(0.0), ctypes.c_double(0.0), 0, ctypes.c_double(0.0))
        for kind, reference, value in job["starts"]:
            if kind == "r":
                self.set_real([reference], [value])
            else:
                self.call("fmi2SetInteger", (ctypes.c_uint * 1)(reference), ctypes.c_size_t(1),
                          (ctypes.c_int * 1)(value))
        self.call("fmi2EnterInitializationMode")
        self.call("fmi2ExitInitializationMode")

    def _log(self, environment, name, status, category, text):
        self.messages.append((status, text.decode()))

    def call(self, function, *arguments):
        status = getattr(self.library, function)(self.instance, *arguments)
        assert status <= 1, f"{function} returned {status}: {self.messages}"

    def set_real(self, references, values):
        n = len(references)
        self.call("fmi2SetReal", (ctypes.c_uint * n)(*references), ctypes.c_size_t(n), (ctypes.c_double * n)(*values))

    def step(self, i):
        self.set_real(self.job["inputs"], [200.0 - 10.0 * (i % 7), 50.0 + 5.0 * (i % 3)])
        self.call("fmi2DoStep", ctypes.c_double(i * 1e-3), ctypes.c_double(1e-3), 1)
        n = len(self.job["outputs"])
        values = (ctypes.c_double * n)()
        self.call("fmi2GetReal", (ctypes.c_uint * n)(*self.job["outputs"]), ctypes.c_size_t(n), values)
        return [value.hex() for value in values]

    def close(self):
        self.call("fmi2Terminate")
        self.library.fmi2FreeInstance(self.instance)


def run(job):
    host = Host(job)
    rows = [host.step(i) for i in range(job["count"])]
    host.close()
    return {"rows": rows, "messages": host.messages}


def threads(job):
    # Each thread has its instance; all step at the same time.
    found = [None] * job["count"]
    barrier = threading.Barrier(job["count"])

    def work(number):
        host = Host(job, f"thread {number}")
        barrier.wait()
        for i in range(200):
            found[number] = host.step(i)
        host.close()

    started = [threading.Thread(target=work, args=(number,)) for number in range(job["count"])]
    for each in started:
        each.start()
    for each in started:
        each.join()
    return {"rows": found}


def cycles(job):
    memory = []
    first = None
    for i in range(job["count"]):
        host = Host(job)
        row = host.step(0)
        first = first or row
        assert row == first, "a later cycle gives other values"
        host.close()
        if (i + 1) % (job["count"] // 10) == 0:
            with open("/proc/self/statm") as stream:
                memory.append(int(stream.read().split()[1]) * os.sysconf("SC_PAGESIZE") // 1024)
    return {"memory": memory, "path": [entry for entry in sys.path if job["resources"].endswith(entry)]}


def main():
    job = json.load(sys.stdin)
    answer = {"run": run, "threads": threads, "cycles": cycles}[job["mode"]](job)
    answer["numpy"] = "numpy" in sys.modules
    print(json.dumps(answer), flush=True)
    os._exit(0)


if __name__ == "__main__":
    main()
