"""libcosim of the Open Simulation Platform (C++, FMI Library), through libcosimpy.

Its clock counts nanoseconds, and a step is the difference of two times converted to seconds: it can differ from the
wanted one in the last digit, and so do the results.
"""

from __future__ import annotations

from typing import Any

from cardan.importers.scene import by_type

TOOL = "libcosim"
DISTRIBUTION = "libcosimpy"


def run(job: dict[str, Any]) -> list[list[float]]:
    """Run the scene; return the outputs after each step."""
    from libcosimpy.CosimExecution import CosimExecution
    from libcosimpy.CosimLogging import CosimLogLevel, log_output_level
    from libcosimpy.CosimManipulator import CosimManipulator
    from libcosimpy.CosimObserver import CosimObserver
    from libcosimpy.CosimSlave import CosimLocalSlave

    log_output_level(CosimLogLevel.WARNING)
    execution = CosimExecution.from_step_size(round(1e9 * job["step"]))
    slave = execution.add_local_slave(CosimLocalSlave(fmu_path=job["fmu"], instance_name="driveline"))
    observer = CosimObserver.create_last_value()
    execution.add_observer(observer)
    manipulator = CosimManipulator.create_override()
    execution.add_manipulator(manipulator)
    known = {variable.name.decode(): variable.reference for variable in execution.slave_variables(slave)}
    starters = (execution.real_initial_value, execution.integer_initial_value, execution.boolean_initial_value)
    setters = (manipulator.slave_real_values, manipulator.slave_integer_values, manipulator.slave_boolean_values)
    for start, part in zip(starters, by_type(job["starts"])):
        for name, value in part.items():
            start(slave, known[name], value)
    outputs = [known[name] for name in job["outputs"]]
    rows = []
    for step in range(job["count"]):
        for override, part in zip(setters, by_type(job["changes"].get(str(step), {}))):
            if part:
                override(slave, [known[name] for name in part], list(part.values()))
        if not execution.step():
            raise RuntimeError(f"libcosim did not do step {step}")
        rows.append([float(value) for value in observer.last_real_values(slave, outputs)])
    return rows
