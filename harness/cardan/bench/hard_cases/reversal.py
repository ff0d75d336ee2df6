"""Through zero speed, with and without Coulomb friction."""

from __future__ import annotations

import math
from collections.abc import Iterator

from .outcome import Outcome, hard_case, start, step

JOINTS = {"joint1.angle": math.radians(30), "joint2.angle": math.radians(20)}


def sweep(friction: float, h: float) -> tuple[float, float, float]:
    """Reverse under +-100 N.m; returns the energy residual over the work done, the final angle and rejected steps."""
    driveline = start({**JOINTS, "joint1.trunnion.friction": friction, "joint2.trunnion.friction": friction,
                       "shaft.damping": 5.0, "input.damping": 0.5})
    work = 0.0
    for i in range(round(2.0 / h)):
        driveline.set("input.torque", 100.0 if (i * h) % 1.0 < 0.5 else -100.0)
        step(driveline, i * h, h)
        work += abs(driveline.get("power.input")) * h
    return abs(driveline.get("energy.residual")) / work, driveline.get("input.angle"), driveline.get("solver.rejected")


@hard_case(5, "reversal through zero speed under +-100 N.m")
def reversal() -> Iterator[Outcome]:
    """The balance holds through every reversal, the result does not depend on the communication step, and a
    torque below the breakaway torque leaves the shaft standing.
    """
    for friction in (0.0, 5.0):
        residual, angle, _ = sweep(friction, 1e-2)
        yield Outcome(residual, 1e-8, "1", f"energy residual over the work done, friction {friction:g} N.m")
        yield Outcome(abs(sweep(friction, 2e-3)[1] - angle), 1e-6, "rad", "final angle, step 10 ms against 2 ms, "
                      f"friction {friction:g} N.m")
    speeds, rejected, steps = stick(5.0)
    yield Outcome(max(abs(w) for w in speeds), 0.05, "rad/s",
                  "largest speed while stuck at 0.5 N.m against friction 5 N.m")
    changes = sum(1 for a, b in zip(speeds, speeds[1:]) if a * b < 0.0)
    yield Outcome(changes, 1, "1", "changes of sign of the speed while stuck (chatter)")
    yield Outcome(rejected / steps, 0.5, "1", "rejected over accepted steps while stuck")
    yield Outcome(1.0 / leave(5.0), 1.0 / 5.0, "s/rad", "leaves: 1 / speed 0.5 s after the torque rises to 50 N.m")


def stick(friction: float) -> tuple[list[float], float, float]:
    """Speeds over 1 s under a torque below breakaway, after the shaft has come to rest."""
    driveline = start({**JOINTS, "joint1.trunnion.friction": friction, "joint2.trunnion.friction": friction,
                       "initial.angle": 0.8, "shaft.damping": 20.0, "input.torque": 0.5})
    for i in range(100):
        step(driveline, i * 1e-2, 1e-2)
    steps, rejected = driveline.get("solver.steps"), driveline.get("solver.rejected")
    speeds = []
    for i in range(100, 200):
        step(driveline, i * 1e-2, 1e-2)
        speeds.append(driveline.get("input.speed"))
    return speeds, driveline.get("solver.rejected") - rejected, driveline.get("solver.steps") - steps


def leave(friction: float) -> float:
    """Speed half a second after the torque has risen above breakaway, rad/s."""
    driveline = start({**JOINTS, "joint1.trunnion.friction": friction, "joint2.trunnion.friction": friction,
                       "initial.angle": 0.8, "shaft.damping": 20.0, "input.torque": 0.5})
    for i in range(100):
        driveline.set("input.torque", 0.5 if i < 50 else 50.0)
        step(driveline, i * 1e-2, 1e-2)
    return driveline.get("input.speed")


@hard_case(17, "start from rest in the joint's worst position against a friction load")
def worst_start() -> Iterator[Outcome]:
    """At 75 deg and p = 90 deg the ratio is at its smallest; the load is smoothed dry friction of 40 N.m."""
    driveline = start({"joint1.angle": math.radians(75), "initial.angle": math.pi / 2, "output.inertia": 0.5,
                       "shaft.stiffness": 2e4, "shaft.damping": 2.0, "joint1.trunnion.friction": 1.0})
    work, lost, h = 0.0, 0.0, 1e-4
    for i in range(10000):
        w = driveline.get("output.speed")
        size = math.hypot(w, 0.05)
        driveline.set("input.torque", 60.0)
        driveline.set("output.torque", 40.0 * w / size)
        driveline.set("output.torque.by_speed", 40.0 * 0.05**2 / size**3)
        step(driveline, i * h, h)
        work += 60.0 * h * driveline.get("input.speed")
        lost += h * driveline.get("power.output")
    yield Outcome(abs(driveline.get("energy.residual")) / work, 1e-8, "1", "energy residual over the work done")
    yield Outcome(1.0 / driveline.get("input.angle"), 1.0 / math.pi, "1/rad", "starts: 1 / angle turned in 1 s")
    stored = driveline.get("energy.kinetic") + driveline.get("energy.strain")
    yield Outcome(stored / (work - lost), 1.0, "1", "stored energy over supplied less delivered")
