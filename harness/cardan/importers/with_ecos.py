"""Ecos (C++, its own FMI layer), through ecospy."""

from __future__ import annotations

from typing import Any

from cardan.importers.scene import by_type

TOOL = "Ecos"
DISTRIBUTION = "ecospy"
# ecospy's library is linked to TBB, which its wheel does not bring.
NEEDS = {"libtbb.so.12": "Debian and Ubuntu have it in the package libtbb12"}


def run(job: dict[str, Any]) -> list[list[float]]:
    """Run the scene; return the outputs after each step."""
    from ecospy import EcosLib, EcosSimulation, EcosSimulationStructure

    EcosLib.set_log_level("warn")
    structure = EcosSimulationStructure()
    structure.add_model("driveline", job["fmu"])
    structure.add_parameter_set("start", {f"driveline::{name}": value for name, value in job["starts"].items()})
    rows = []
    with EcosSimulation(structure=structure, step_size=job["step"]) as simulation:
        if not simulation.init(parameter_set="start"):
            raise RuntimeError(f"Ecos did not initialize: {EcosLib.get_last_error()}")
        setters = (simulation.set_real, simulation.set_integer, simulation.set_bool)
        for step in range(job["count"]):
            for setter, part in zip(setters, by_type(job["changes"].get(str(step), {}))):
                for name, value in part.items():
                    setter(f"driveline::{name}", value)
            simulation.step()
            rows.append([simulation.get_real(f"driveline::{name}") for name in job["outputs"]])
        simulation.terminate()
    return rows
