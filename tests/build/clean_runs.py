"""What the tests do with an FMU in processes of their own.

``python -I -B clean_runs.py FUNCTION`` reads a JSON object from standard input, calls FUNCTION with it and
prints the answer as JSON in one line, before the process can come to harm at its exit (docs/FMI.md,
trap 11).
"""

import json
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
from raw_host import CASE, Direct, Host, exercise, unpack

del sys.path[0]


def use_path(job):
    """Put directories in front of the module path, as a host that has its own modules does."""
    sys.path[:0] = job.get("path", [])


def run(job):
    """The exercise in the FMU."""
    use_path(job)
    host = Host(unpack(job["fmu"], job["unpack"]))
    host.initialize(CASE)
    first = host.outputs()
    found = exercise(host)
    messages = host.messages
    host.close()
    return {"first": first, "steps": found, "messages": messages}


def run_kernel(job):
    """The same in the kernel that this process imports."""
    use_path(job)
    import cardan_kernel

    direct = Direct(getattr(cardan_kernel, job["which"])(), cardan_kernel.VARIABLES)
    direct.initialize(CASE)
    return {"first": direct.outputs(), "steps": exercise(direct), "kernel": cardan_kernel.KERNEL}


def beside_host_modules(job):
    """The FMU in a host with modules of the same names, imported before or after it: whose code runs where?"""
    import importlib

    use_path(job)
    names = ("cardan_kernel", "cardan_kernel._compiled", "cardan_slave", "pythonfmu")
    answer = {}
    if job["order"] == "host first":
        answer["before"] = [importlib.import_module(name).__file__ for name in names]
    answer.update(run(job | {"path": []}))
    answer["after"] = [importlib.import_module(name).__file__ for name in names]
    return answer


def two_versions(job):
    """Several FMUs one after the other, and then stepped in turns, in one process."""
    hosts = [Host(unpack(fmu, Path(job["unpack"]) / str(place))) for place, fmu in enumerate(job["fmus"])]
    for host in hosts:
        host.initialize(CASE)
    found = [exercise(host, 5) for host in hosts]
    answer = {"messages": [host.messages for host in hosts], "steps": found}
    for host in hosts:
        host.close()
    return answer


def failing_steps(job):
    """200 refused steps with the state restored after each, then the run goes on as if nothing had been."""
    host = Host(unpack(job["fmu"], job["unpack"]))
    host.initialize(CASE)
    exercise(host, 3)
    statuses = set()
    bad = (("input.torque", float("nan")), ("output.torque", float("inf")), ("joint1.angle", 1.6))
    for place in range(200):
        state = host.slave.getFMUState()
        name, value = bad[place % len(bad)]
        kept = host.get(name)
        host.set(name, value)
        statuses.add(host.step(3e-3, 1e-3))
        host.set(name, kept)
        host.slave.setFMUState(state)
        host.slave.freeFMUState(state)
    refused = len(host.messages)
    rest = exercise(host, 10, begin=3)
    host.slave.reset()
    host.initialize(CASE)
    again = [*exercise(host, 3), *exercise(host, 10, begin=3)]
    host.close()
    return {"statuses": sorted(statuses), "rest": rest, "again": again[3:], "messages": refused}


def fails_midway(job):
    """FMPy's simulate_fmu over 0.1 s with a torque that stops being a number at 0.05 s."""
    import numpy
    from fmpy import simulate_fmu

    messages = []
    signal = numpy.array([(0.0, 1.0), (0.05, 1.0), (0.0500001, float("nan")), (0.1, float("nan"))],
                         dtype=[("time", float), ("input.torque", float)])
    result = simulate_fmu(job["fmu"], stop_time=0.1, step_size=1e-3, output_interval=1e-3, input=signal,
                          output=["output.speed"], debug_logging=True,
                          logger=lambda *arguments: messages.append(arguments[4].decode()))
    return {"last": float(result["time"][-1]), "messages": messages}


def state_round_trip(job):
    """Save, go on, restore, repeat; and hand the serialized state out."""
    host = Host(unpack(job["fmu"], job["unpack"]))
    host.initialize(CASE)
    exercise(host, 10)
    state = host.slave.getFMUState()
    data = host.slave.serializeFMUState(state)
    first = exercise(host, 10, begin=10)
    host.slave.setFMUState(state)
    second = exercise(host, 10, begin=10)
    host.slave.freeFMUState(state)
    host.close()
    return {"first": first, "second": second, "state": data.hex()}


def continue_from(job):
    """Go on from a serialized state in a process that never saw its beginning."""
    host = Host(unpack(job["fmu"], job["unpack"]))
    host.initialize()
    state = host.slave.deSerializeFMUstate(bytes.fromhex(job["state"]))
    host.slave.setFMUState(state)
    found = exercise(host, 10, begin=10)
    host.close()
    return {"steps": found}


def silent(job):
    """The same bad step without and with logging switched on."""
    unpacked = unpack(job["fmu"], job["unpack"])
    answer = {}
    for logging in (False, True):
        host = Host(unpacked, logging=logging)
        host.initialize(CASE)
        host.set("joint2.angle", 2.0)
        status = host.step(0.0, 1e-3)
        answer[str(logging)] = [status, host.messages]
        host.close()
    return answer


def many_instances(job):
    """Growth of the module path and of memory over instances."""
    import resource

    unpacked = unpack(job["fmu"], job["unpack"])
    sizes = []
    before = len(sys.path)
    for _ in range(2):
        for _ in range(job["count"]):
            host = Host(unpacked)
            host.initialize(CASE)
            host.step(0.0, 1e-3)
            host.close()
        sizes.append(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024)
    return {"path": len(sys.path) - before, "per_instance": (sizes[1] - sizes[0]) / job["count"],
            "left": [entry for entry in sys.path if entry.startswith(str(unpacked))]}


def call_order(job):
    """Calls at the wrong time; after each the instance still works once it is treated rightly."""
    host = Host(unpack(job["fmu"], job["unpack"]))
    answer = {"before initialization": host.step(0.0, 1e-3)}
    host.initialize(CASE)
    answer["negative"] = host.step(0.0, -1e-3)
    answer["zero"] = host.step(0.0, 0.0)
    answer["not finite"] = host.step(0.0, float("nan"))
    answer["good"] = host.step(0.0, 1e-3)
    host.set("input.inertia", 5.0)
    answer["late fixed parameter"] = host.step(1e-3, 1e-3)
    answer["after it"] = host.step(1e-3, 1e-3)
    kept = host.get("input.inertia")
    host.set("output.damping", 0.1)
    answer["late tunable parameter"] = host.step(2e-3, 1e-3)
    host.slave.terminate()
    answer["after terminate"] = host.step(3e-3, 1e-3)
    answer["string"] = [each.decode() for each in host.slave.getString([0])]
    answer["unknown"] = [value == value for value in host.slave.getReal([99999])]
    host.slave.freeInstance()
    return {"statuses": answer, "kept": kept, "messages": host.messages}


def main():
    job = json.load(sys.stdin)
    answer = globals()[sys.argv[1]](job)
    print("\n" + json.dumps(answer), flush=True)


if __name__ == "__main__":
    main()
