"""What a communication step costs beyond the physics: against an empty FMU, in other hosts, with states saved."""

from __future__ import annotations

import tempfile
import time
from collections.abc import Mapping, Sequence
from contextlib import ExitStack
from pathlib import Path
from typing import Any

import cardan_kernel

from cardan.bench.c_host import CHost, NoHost
from cardan.bench.empty_fmu import OUTPUTS as EMPTY_OUTPUTS
from cardan.bench.empty_fmu import build_empty
from cardan.bench.records import Options, Record, Tables, Tell
from cardan.bench.systems import ORDINARY, RESISTANCE, TORQUE
from cardan.bench.timing import Job, figure, interleaved, ratio
from cardan.instance import Instance

INPUTS = ("input.torque", "output.torque")
OUTPUTS = ("input.speed", "output.speed", "input.angle", "output.angle", "shaft.torque")
STEP, COUNT = 1e-3, 1000
COARSE, DEFAULT = 1e-6, 1e-9  # tolerances: more than enough for an error of 1e-6 at this step, and the driveline's own

EMPTY, LEAN = "empty pythonfmu FMU", "empty FMU with getters and setters of its own"
OURS = "driveline FMU, tolerance 1e-6"
KERNEL, SHARE = "kernel in process, tolerance 1e-6", "its step alone: the kernel's share of the FMU's"
STATES = "save, restore and free the state"


def measure(options: Options, tell: Tell) -> Tables:
    """Return the table ``stepping``: one communication step of 1 ms (set 2, step, get 5) in all that takes it."""
    from cardan_build import build, default_fmu

    with ExitStack() as stack:
        folder = Path(stack.enter_context(tempfile.TemporaryDirectory(prefix="cardan_bench_")))
        empty, lean = build_empty(folder / "empty"), build_empty(folder / "lean", own_access=True)
        portable = build(folder / "portable" / "CardanDriveline.fmu", portable=True)
        tell(0.2)
        jobs: dict[str, Job] = {}
        for name, path, tolerance in ((EMPTY, empty, None), (LEAN, lean, None),
                                      (OURS, default_fmu(), COARSE),
                                      ("driveline FMU, tolerance 1e-9", default_fmu(), DEFAULT),
                                      ("driveline FMU without its compiled kernel", portable, COARSE)):
            instance = stack.enter_context(Instance(path))
            jobs[name] = _loop(instance, path in (empty, lean), tolerance)
            if name == OURS:
                jobs[STATES] = _states(instance)
        jobs[KERNEL], jobs[SHARE] = _kernel(True), _kernel(False)
        samples = interleaved(jobs, options.repeats * 2, lambda done: tell(0.2 + 0.5 * done))
        records = [_record(name, times, samples[EMPTY]) for name, times in samples.items()]
        records += _in_c(folder, {EMPTY: empty, OURS: default_fmu()}, options)
        tell(1.0)
    return {"stepping": records}


def _loop(instance: Instance, bare: bool, tolerance: float | None) -> Job:
    """Return the loop: set 2, step, get 5, over preallocated arrays; gives seconds per step."""
    for name, value in ({} if bare else ORDINARY).items():
        instance.set(name, value)
    instance.setup(0.0, None, tolerance)
    instance.initialize()
    inputs = instance.plan(("u1", "u2") if bare else INPUTS)
    outputs = instance.plan(EMPTY_OUTPUTS if bare else OUTPUTS)
    values, write, step, read = inputs.values, inputs.write, instance.step, outputs.read

    def job() -> float:
        begin = time.process_time()
        for i in range(COUNT):
            values[0], values[1] = TORQUE, RESISTANCE
            write()
            step(i * STEP, STEP)
            read()
        return (time.process_time() - begin) / COUNT

    return job


def _states(instance: Instance) -> Job:
    def job() -> float:
        begin = time.process_time()
        for _ in range(COUNT):
            state = instance.get_state()
            instance.set_state(state)
            instance.free_state(state)
        return (time.process_time() - begin) / COUNT

    return job


def _kernel(exchange: bool) -> Job:
    """Return the same loop without FMI: methods of the kernel's class, called from Python; or its step alone."""
    index = cardan_kernel.INDEX
    sent, got = [index[name] for name in INPUTS], [index[name] for name in OUTPUTS]
    driveline: Any = cardan_kernel.Driveline()
    driveline.setup_experiment(0.0, None, COARSE)
    driveline.enter_initialization_mode()
    for name, value in {**ORDINARY, INPUTS[0]: TORQUE, INPUTS[1]: RESISTANCE}.items():
        driveline.set(name, value)
    driveline.exit_initialization_mode()
    write, step, read = driveline.set_real, driveline.do_step, driveline.get_real

    def job() -> float:
        begin = time.process_time()
        for i in range(COUNT):
            write(sent, [TORQUE, RESISTANCE])
            step(i * STEP, STEP)
            read(got)
        return (time.process_time() - begin) / COUNT

    def step_alone() -> float:
        begin = time.process_time()
        for i in range(COUNT):
            step(i * STEP, STEP)
        return (time.process_time() - begin) / COUNT

    return job if exchange else step_alone


def _in_c(folder: Path, fmus: Mapping[str, Path], options: Options) -> list[Record]:
    """Return the same loop in a host written in C; a host that cannot be made is a record with its reason."""
    labels = {name: f"{name}, in a C host" for name in fmus}
    try:
        host = CHost(folder)
        samples: dict[str, list[float]] = {name: [] for name in fmus}
        for _ in range(2 if options.quick else 5):  # in turns, a process each
            for name, path in fmus.items():
                if name == OURS:
                    samples[name] += host.times(path, INPUTS, OUTPUTS, ORDINARY, COARSE)
                else:
                    samples[name] += host.times(path, ("u1", "u2"), EMPTY_OUTPUTS, {}, None)
    except NoHost as reason:
        return [{"what": label, "us": None, "low": None, "high": None, "ratio": None, "remark": str(reason)}
                for label in labels.values()]
    return [_record(labels[name], times, samples[EMPTY]) for name, times in samples.items()]


def _record(name: str, times: Sequence[float], base: Sequence[float]) -> Record:
    time_ = figure(times) * 1e6
    return {"what": name, "us": time_.median, "low": time_.low, "high": time_.high,
            "ratio": ratio(times, base).median, "remark": ""}
