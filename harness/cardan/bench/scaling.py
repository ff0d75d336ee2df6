"""How cost grows: with simulated time, with parallel instances, and memory with the number of steps."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

from cardan.bench.records import Options, Record, Tables, Tell
from cardan.bench.systems import ORDINARY, RESISTANCE, SPEED
from cardan.bench.timing import figure

STEP = 1e-3
PARALLEL_STEPS = 100_000  # per process
WARM = 20_000  # steps before anything is looked at


def measure(options: Options, tell: Tell) -> Tables:
    """Return the tables ``simulated_time``, ``parallel`` and ``memory``."""
    lengths = (1, 10) if options.quick else (1, 10, 100, 1000)
    over_time = []
    for number, length in enumerate(lengths):
        costs = [_child("steps", length * 1000)["seconds"] / length for _ in range(3 if length <= 100 else 1)]
        taken = figure(costs) * 1e3
        over_time.append({"simulated_s": length, "ms_per_s": taken.median, "low": taken.low, "high": taken.high})
        tell(0.4 * (number + 1) / len(lengths))
    steps = 200_000 if options.quick else 1_000_000
    found = _child("memory", steps)
    tell(0.7)
    memory: list[Record] = [{"steps": count, "resident_MB": size} for count, size in found["resident"]]
    return {"simulated_time": over_time, "parallel": _parallel(options, tell), "memory": memory}


def _parallel(options: Options, tell: Tell) -> list[Record]:
    """Run the same work in one process and in several at once; wall time tells what they share."""
    count = PARALLEL_STEPS // (5 if options.quick else 1)
    records: list[Record] = []
    alone = 0.0
    for processes in (1, 2):
        rates, costs = [], []
        for _ in range(3):
            running = [_start("wall", count) for _ in range(processes)]
            for child in running:
                assert child.stdout is not None
                child.stdout.readline()  # all are loaded and initialized
            begin = time.perf_counter()
            for child in running:
                assert child.stdin is not None
                child.stdin.write("go\n")
                child.stdin.flush()
            costs += [json.loads(child.communicate()[0].splitlines()[-1])["seconds"] / count for child in running]
            rates.append(processes * count * STEP / (time.perf_counter() - begin))
        rate, cost = figure(rates), figure(costs) * 1e6
        alone = alone or rate.median
        records.append({"processes": processes, "simulated_s_per_s": rate.median, "low": rate.low, "high": rate.high,
                        "speed_up": rate.median / alone, "processor_us_per_step": cost.median})
        tell(0.7 + 0.15 * processes)
    return records


def _start(mode: str, count: int) -> subprocess.Popen[str]:
    return subprocess.Popen([sys.executable, "-m", __name__, mode, str(count)], stdin=subprocess.PIPE,
                            stdout=subprocess.PIPE, text=True, env={**os.environ, "OMP_NUM_THREADS": "1"})


def _child(mode: str, count: int) -> dict[str, Any]:
    """Run this module in a process of its own and return what it found."""
    child = _start(mode, count)
    text, _ = child.communicate("go\n")
    if child.returncode:
        raise RuntimeError(f"the process that measures {mode!r} ended with exit code {child.returncode}")
    answer: dict[str, Any] = json.loads(text.splitlines()[-1])
    return answer


def resident() -> float:
    """Return the memory of this process that is in use, MB."""
    if Path("/proc/self/statm").is_file():
        pages = int(Path("/proc/self/statm").read_text(encoding="ascii").split()[1])
        return pages * os.sysconf("SC_PAGESIZE") / 1e6
    import tracemalloc  # elsewhere what Python itself has allocated has to do

    if not tracemalloc.is_tracing():
        tracemalloc.start()
    return tracemalloc.get_traced_memory()[0] / 1e6


def child(mode: str, count: int) -> dict[str, Any]:
    """Step the ordinary driveline FMU in this process.

    Parameters
    ----------
    mode : str
        ``steps``: processor time of `count` steps; ``wall``: the same, told when it begins and ends; ``memory``: the
        memory after every tenth of them.
    count : int
        Steps of 1 ms.
    """
    from cardan_build import default_fmu

    from cardan.instance import Instance

    with Instance(default_fmu()) as instance:
        # Speed prescribed: a long run stays where it is.
        for name, value in {**ORDINARY, "model.drive": 1, "input.speed_command": SPEED}.items():
            instance.set(name, value)
        instance.setup(0.0, None, 1e-9)
        instance.initialize()
        inputs, outputs = instance.plan(("output.torque", "output.torque.der1")), instance.plan(
            ("input.speed", "output.speed", "input.angle", "output.angle", "shaft.torque"))
        values, write, step, read = inputs.values, inputs.write, instance.step, outputs.read

        def go(first: int, last: int) -> None:
            for i in range(first, last):
                values[0] = RESISTANCE
                write()
                step(i * STEP, STEP)
                read()

        return _measured(mode, count, go)


def _measured(mode: str, count: int, go: Callable[[int, int], None]) -> dict[str, Any]:
    go(0, WARM)
    if mode == "memory":
        marks = [WARM + (count - WARM) * i // 10 for i in range(11)]
        sizes = [(marks[0], resident())]
        for first, last in zip(marks, marks[1:]):
            go(first, last)
            sizes.append((last, resident()))
        return {"resident": sizes}
    if mode == "wall":
        print("ready", flush=True)
    sys.stdin.readline()
    begin = time.process_time()
    go(WARM, WARM + count)
    return {"seconds": time.process_time() - begin}


if __name__ == "__main__":
    print(json.dumps(child(sys.argv[1], int(sys.argv[2]))), flush=True)
    os._exit(0)  # a process that has run a Python FMU now and then aborts on its way out (docs/FMI.md, trap 11)
