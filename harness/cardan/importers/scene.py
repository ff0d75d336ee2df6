"""The scene that every importer runs: constant torques and other inputs held between changes.

A scene is plain data, so that a process of any importer can take it: start values by name, input changes by step,
outputs, step. It uses all kinds of variables that the driveline has: Real, Integer and Boolean, fixed and tunable
parameters, inputs that move, and outputs of every part of the model.
"""

from __future__ import annotations

from typing import Any

STEP = 1e-3  # s
COUNT = 120  # steps; a turn of the shaft takes 63

# A spatial pair with crosses and friction, on a soft shaft.
STARTS: dict[str, float | int] = {
    "model.fidelity": 2, "model.tolerance": 1e-10, "hold.degree": 3, "output.inertia": 0.8, "shaft.stiffness": 1.5e4,
    "shaft.yoke_phase": 0.7, "shaft.plane_twist": -0.4, "joint1.cross.inertia_a": 1e-3, "joint2.trunnion.friction": 0.3,
    "initial.speed": 100.0, "initial.twist": 1e-3, "joint1.angle": 0.35, "joint2.angle": 0.26, "input.torque": 200.0,
    "output.torque": 50.0,
}

# Step -> what changes at its start and is held from there on.
CHANGES: dict[int, dict[str, float | bool]] = {
    20: {"input.torque": 120.0, "hold.restart": True},
    21: {"hold.restart": False},
    50: {"output.torque": 90.0, "output.torque.by_speed": 0.2},
    80: {"joint1.angle.der1": 0.5, "shaft.damping": 4.0},
    100: {"input.torque": -40.0, "input.torque.der1": 3000.0, "joint1.angle.der1": 0.0},
}

OUTPUTS = ("input.angle", "input.speed", "input.acceleration", "output.angle", "output.speed", "output.acceleration",
           "shaft.torque", "shaft.twist", "ratio", "joint1.torque_in", "joint2.couple_out", "joint1.trunnion.force",
           "inertia_torque", "power.loss", "energy.kinetic", "layout.nonuniformity")


def job(fmu: str) -> dict[str, Any]:
    """Return what an importer is asked to do.

    Parameters
    ----------
    fmu : str
        Path of the driveline FMU.
    """
    return {"fmu": fmu, "step": STEP, "count": COUNT, "starts": STARTS,
            "changes": {str(step): values for step, values in CHANGES.items()}, "outputs": list(OUTPUTS)}


def by_type(values: dict[str, Any]) -> tuple[dict[str, Any], dict[str, Any], dict[str, Any]]:
    """Sort values into Real, Integer and Boolean ones.

    Parameters
    ----------
    values : dict
        Variable name -> value; the Python type says which it is.
    """
    booleans = {name: value for name, value in values.items() if isinstance(value, bool)}
    integers = {name: value for name, value in values.items() if isinstance(value, int) and name not in booleans}
    reals = {name: value for name, value in values.items() if isinstance(value, float)}
    return reals, integers, booleans
