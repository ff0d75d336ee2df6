"""Scenes for system packages, each with what it is there to show."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from cardan.scenario import Scenario

OUTPUTS = ("input.angle", "input.speed", "output.speed", "shaft.torque")
_PAIR = {"joint1.angle": "20 deg", "joint2.angle": "15 deg", "output.inertia": "0.6 kg.m2"}
_MAP = {"type": "map", "speeds": [0, 100, 300], "throttles": [0, 1], "torques": [[0, -20, -30], [0, 120, 80]],
        "throttle": 0.7}


def without_feedthrough(folder: Path) -> dict[str, Any]:
    """Torques that no shaft speed acts on at once, from rest: every tool exchanges them as ``held`` does.

    The engine's lag is a state that starts at zero torque; the load is a series that first drives, then brakes.
    """
    (folder / "load.csv").write_text("t,T\n0,0\n0.1,-80\n0.25,-20\n0.35,60\n1,60\n", encoding="utf-8")
    return {"driveline": _PAIR, "engine": {**_MAP, "lag": "50 ms"},
            "load": {"type": "csv", "file": "load.csv", "column": "T"}}


def prescribed(folder: Path) -> dict[str, Any]:
    """A prescribed speed, which nothing acts on, and a load that begins as a jump."""
    return {"driveline": _PAIR, "engine": {"type": "speed", "speed": "30 rad/s", "final_speed": "120 rad/s",
                                           "ramp_start": "50 ms", "ramp_time": "0.2 s"},
            "load": {"type": "step", "after": "40 N.m", "time": "0.1 s"}}


def feedthrough(folder: Path) -> dict[str, Any]:
    """Torques that follow angle and speed at once: a ripple and a fan."""
    return {"driveline": {**_PAIR, "initial.speed": "60 rad/s", "shaft.stiffness": "4000 N.m/rad"},
            "engine": {"type": "four_stroke", "torque": "80 N.m", "orders": [2.0], "amplitudes": "60 N.m"},
            "load": {"type": "quadratic", "coefficient": "0.01 N.m.s2/rad2"}}


def gearbox(folder: Path) -> dict[str, Any]:
    """Gear decisions at sample times, a launch clutch, a governor, a dynamometer: states of every kind."""
    return {
        "driveline": {**_PAIR, "initial.speed": "30 rad/s"},
        "engine": {**_MAP, "torques": [[-10, -20, -30], [100, 120, 80]], "lag": "0.1 s",
                   "governor": {"speed": 50, "gain": 2, "integral_gain": 4, "torque_high": 120},
                   "gearbox": {"ratios": [3.0, 2.0, 1.2], "engine_inertia": 0.3, "initial_speed": 90,
                               "clutch": {"capacity": 400, "engage_speed": 80, "full_speed": 140},
                               "shift": {"up": 80, "up_full": 110, "down": 20, "down_full": 30, "dwell": 0.05,
                                         "open_time": 0.05, "close_time": 0.1}}},
        "load": {"type": "dyno", "speed": 45, "gain": 3, "integral_gain": 5, "torque_limit": 300},
    }


def moving_joints(folder: Path) -> dict[str, Any]:
    """Joint angles that move on their own."""
    moving = {"joint1.angle.der1": "0.3 rad/s", "joint1.angle.der2": "-0.2 rad/s2", "joint2.angle.der1": "0.1 rad/s"}
    return {**feedthrough(folder), "driveline": {**_PAIR, "initial.speed": "60 rad/s", **moving}}


def driven(folder: Path) -> dict[str, Any]:
    """A driver on a road: pedals go from one part to two others."""
    (folder / "schedule.csv").write_text("t,v\n0,5\n0.2,5.1\n0.6,5.6\n2,6\n", encoding="utf-8")
    bends = {name: value for name, value in _PAIR.items() if name != "output.inertia"}  # the road sets that
    return {"driveline": {**bends, "initial.speed": "55 rad/s"},
            "engine": {**_MAP, "torques": [[-10, -20, -30], [100, 120, 80]], "lag": "50 ms"},
            "load": {"type": "road", "mass": 900, "wheel_radius": "0.3 m", "axle_ratio": 3.4, "rolling": 0.01,
                     "drag_coefficient": 0.3, "frontal_area": 2.0, "brake_force": "4 kN"},
            "driver": {"file": "schedule.csv", "column": "v"}}


ALL = {each.__name__: each for each in (without_feedthrough, prescribed, feedthrough, gearbox, moving_joints, driven)}


def scenario(name: str, folder: Path, step: float = 1e-3, stop: float = 0.4,
             outputs: tuple[str, ...] = OUTPUTS) -> Scenario:
    """A scene of this module, run with held values."""
    scene = {"stop_time": stop, "communication_step": step, "coupling": "held", "tolerance": 1e-10,
             "outputs": list(outputs)}
    return Scenario.from_dict({"scene": scene, **ALL[name](folder)}, base=folder, name=name)
