"""Scenes that the analyses are tested with."""

from __future__ import annotations

import math
from typing import Any

from cardan.scenario import Scenario

NATURAL = 100.0 * math.pi  # rad/s: 50 Hz

# Massless shaft halves: behind joint 1 there is J3 alone, and the anchors of docs/PHYSICS.md section 6 are exact.
BARE = {"shaft.inertia_a": 0.0, "shaft.inertia_b": 0.0, "shaft.damping": 0.0}


def scene(driveline: dict[str, Any], engine: dict[str, Any] | None = None, load: dict[str, Any] | None = None,
          **table: Any) -> Scenario:
    """Make a scene; without engine and load nothing acts on the shafts."""
    return Scenario.from_dict({
        "scene": {"title": "analysed", "stop_time": 1.0, "communication_step": 1e-3, "outputs": ["input.speed"],
                  **table},
        "driveline": driveline,
        "engine": engine or {"type": "constant", "torque": 0.0},
        "load": load or {"type": "constant", "torque": 0.0},
    })


def homokinetic(angle: float, **driveline: Any) -> Scenario:
    """Double joint of equal angles (deg) under a prescribed speed; J3 = 1.5 kg.m2, k = 2e4 N.m/rad."""
    return scene({"joint1.angle": f"{angle!r} deg", "joint2.angle": f"{angle!r} deg", **BARE, **driveline},
                 {"type": "speed", "speed": "1000 rpm"})


def single(angle: float, damping: float = 4.0, load: dict[str, Any] | None = None, **driveline: Any) -> Scenario:
    """Single joint (deg), natural frequency 50 Hz with the default inertias, a load that holds the speed."""
    stiffness = NATURAL**2 / (1.0 / 0.2044 + 1.0 / 1.5044)
    return scene({"joint1.angle": f"{angle!r} deg", "shaft.stiffness": stiffness, "shaft.damping": damping,
                  **driveline}, load=load or {"type": "linear", "coefficient": 0.5})
