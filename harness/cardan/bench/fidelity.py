"""What fidelity costs, and what the exchange of variables costs."""

from __future__ import annotations

import time
from collections.abc import Mapping, Sequence

import cardan_kernel

from cardan.bench.records import Options, Tables, Tell
from cardan.bench.systems import ORDINARY, RESISTANCE, SPEED, TORQUE
from cardan.bench.timing import Job, figure, interleaved, ratio
from cardan.instance import Instance

STEP, COUNT, TOLERANCE = 1e-3, 1000, 1e-9
_CROSS = {f"joint{joint}.cross.inertia_{axis}": value for joint in (1, 2)
          for axis, value in (("a", 2e-4), ("b", 2e-4), ("m", 3e-4))}
_VISCOUS = {f"joint{joint}.trunnion.damping_{axis}": 0.01 for joint in (1, 2) for axis in ("a", "b")}
_COULOMB = {f"joint{joint}.trunnion.friction": 1.0 for joint in (1, 2)}

# From the closed form to everything; each has what those above it have.
MODELS: dict[str, Mapping[str, float]] = {
    "kinematic: rigid, speed prescribed": {**ORDINARY, "model.fidelity": 1, "model.drive": 1,
                                           "input.speed_command": SPEED},
    "rigid": {**ORDINARY, "model.fidelity": 1},
    "compliant": ORDINARY,
    "with crosses": {**ORDINARY, **_CROSS},
    "with viscous trunnions": {**ORDINARY, **_CROSS, **_VISCOUS},
    "with Coulomb friction": {**ORDINARY, **_CROSS, **_VISCOUS, **_COULOMB},
}
COUNTS = (0, 1, 2, 5, 10, 20)  # outputs read per step, and then all of them


def measure(options: Options, tell: Tell) -> Tables:
    """Return the tables ``fidelity`` (per model, FMU and bare kernel) and ``exchange`` (per number of outputs)."""
    from cardan_build import default_fmu

    with Instance(default_fmu()) as instance:
        jobs: dict[str, Job] = {}
        for name, values in MODELS.items():
            jobs[f"FMU {name}"] = _fmu(instance, values, ("input.speed", "output.speed"), COUNT)
            jobs[f"kernel {name}"] = _kernel(values)
        samples = interleaved(jobs, options.repeats, lambda done: tell(0.6 * done))
        models = []
        for name in MODELS:
            fmu, bare = figure(samples[f"FMU {name}"]) * 1e6, figure(samples[f"kernel {name}"]) * 1e6
            models.append({"model": name, "fmu_us": fmu.median, "low": fmu.low, "high": fmu.high,
                           "kernel_us": bare.median,
                           "ratio": ratio(samples[f"FMU {name}"], samples["FMU compliant"]).median,
                           "kernel_ratio": ratio(samples[f"kernel {name}"], samples["kernel compliant"]).median})
        names = [variable.name for variable in cardan_kernel.VARIABLES
                 if variable.causality == "output" and variable.type == "Real"]
        jobs = {str(count): _fmu(instance, ORDINARY, names[:count], COUNT) for count in (*COUNTS, len(names))}
        samples = interleaved(jobs, options.repeats, lambda done: tell(0.6 + 0.4 * done))
    exchange = []
    for count, times in samples.items():
        taken = figure(times) * 1e6
        exchange.append({"outputs": int(count), "us": taken.median, "low": taken.low, "high": taken.high,
                         "ratio": ratio(times, samples["2"]).median})
    return {"fidelity": models, "exchange": exchange}


def _fmu(instance: Instance, values: Mapping[str, float], outputs: Sequence[str], count: int) -> Job:
    """Return a job that starts the FMU anew (not timed) and gives seconds per step of 1 ms."""
    inputs, plan = instance.plan(("input.torque", "output.torque")), instance.plan(outputs)

    def job() -> float:
        instance.reset()
        for name, value in values.items():
            instance.set(name, value)
        instance.setup(0.0, None, TOLERANCE)
        instance.initialize()
        sent, write, step, read = inputs.values, inputs.write, instance.step, plan.read
        begin = time.process_time()
        for i in range(count):
            sent[0], sent[1] = TORQUE, RESISTANCE
            write()
            step(i * STEP, STEP)
            if outputs:
                read()
        return (time.process_time() - begin) / count

    return job


def _kernel(values: Mapping[str, float]) -> Job:
    """Return a job that gives seconds per step of 1 ms of the bare kernel, inputs constant and nothing read."""

    def job() -> float:
        driveline = cardan_kernel.Driveline()
        driveline.setup_experiment(0.0, None, TOLERANCE)
        driveline.enter_initialization_mode()
        for name, value in {**values, "input.torque": TORQUE, "output.torque": RESISTANCE}.items():
            driveline.set(name, value)
        driveline.exit_initialization_mode()
        step = driveline.do_step
        begin = time.process_time()
        for i in range(COUNT):
            step(i * STEP, STEP)
        return (time.process_time() - begin) / COUNT

    return job
