"""The FMUs that the harness is tested with, and scenes with exact solutions."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from cardan.scenario import Scenario

# Another author's FMU: other names, all four types, no state support, and errors on demand.
FOREIGN = '''
from pythonfmu import Boolean, Fmi2Causality, Fmi2Slave, Fmi2Variability, Integer, Real, String
from pythonfmu.enums import Fmi2Status


class Foreign(Fmi2Slave):
    def __init__(self, **kwargs):
        super().__init__(**kwargs)
        self.gain, self.count, self.ready, self.label, self.y, self.limit = 2.0, 0, False, "none", 0.0, 100.0
        parameter, local = Fmi2Causality.parameter, Fmi2Causality.local
        self.register_variable(Real("gain", causality=parameter, variability=Fmi2Variability.tunable))
        self.register_variable(Real("limit", causality=parameter, variability=Fmi2Variability.tunable))
        self.register_variable(Integer("count", causality=parameter, variability=Fmi2Variability.tunable))
        self.register_variable(Boolean("ready", causality=parameter, variability=Fmi2Variability.tunable))
        self.register_variable(String("label", causality=parameter, variability=Fmi2Variability.tunable))
        self.register_variable(Real("y", causality=Fmi2Causality.output))

    def do_step(self, current_time, step_size):
        if self.y > self.limit:
            self.log(f"y = {self.y} is above limit = {self.limit}", Fmi2Status.error)
            return False
        if self.count == 13:
            raise RuntimeError("thirteen")
        self.y += self.gain * step_size
        return True
'''


@pytest.fixture(scope="session")
def fmu() -> Path:
    """The driveline FMU of this installation."""
    from cardan_build import default_fmu

    return default_fmu()


@pytest.fixture(scope="session")
def foreign_fmu(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """An FMU that is no driveline: y grows by gain per second until it is above limit."""
    folder = tmp_path_factory.mktemp("foreign")
    (folder / "foreign.py").write_text(FOREIGN)
    code = "from pythonfmu import FmuBuilder; FmuBuilder.build_FMU('foreign.py', dest='.')"
    subprocess.run([sys.executable, "-c", code], cwd=folder, check=True, capture_output=True)
    return folder / "Foreign.fmu"


@pytest.fixture
def shaft_scene() -> Callable[..., Scenario]:
    """Make scenes of a rigid straight shaft, J = 0.5 kg.m2 in all: J w' = T_engine - T_load exactly."""

    def make(coupling: str = "held", step: float = 0.01, stop: float = 1.0, engine: dict[str, Any] | None = None,
             load: dict[str, Any] | None = None, outputs: tuple[str, ...] = ("output.speed",),
             **driveline: Any) -> Scenario:
        inertias = {"input.inertia": 0.2, "shaft.inertia_a": 0.05, "shaft.inertia_b": 0.05, "output.inertia": 0.2}
        return Scenario.from_dict({
            "scene": {"title": "straight shaft", "stop_time": stop, "communication_step": step, "coupling": coupling,
                      "tolerance": 1e-12, "outputs": list(outputs)},
            "driveline": {"model.fidelity": 1, **inertias, **driveline},
            "engine": engine or {"type": "constant", "torque": 100.0},
            "load": load or {"type": "constant", "torque": 0.0},
        })

    return make
