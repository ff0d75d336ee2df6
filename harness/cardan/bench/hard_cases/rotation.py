"""Free and fast rotation, extreme inertias, joints near 90 degrees."""

from __future__ import annotations

import math
from collections.abc import Iterator

from .outcome import Outcome, Refused, hard_case, start, step

RIGID = {"model.fidelity": 1, "shaft.inertia_a": 0.0, "shaft.inertia_b": 0.0}


def mass(j1: float, j2: float, beta: float, p: float) -> float:
    """M = J1 + J2 r^2 of the rigid single joint at the angle `p`, kg.m2."""
    c, _s = math.cos(beta), math.sin(beta)
    return j1 + j2 * (c / (math.sin(p) ** 2 + c * c * math.cos(p) ** 2)) ** 2


def free_rotation_error(j1: float, j2: float, beta: float, tolerance: float, turns: int = 10) -> float:
    """Largest relative error of w = w0 sqrt(M0 / M) over some turns of the rigid joint without torques."""
    driveline = start({**RIGID, "input.inertia": j1, "output.inertia": j2, "joint1.angle": beta,
                       "initial.angle": 0.4, "initial.speed": 50.0}, tolerance)
    m0 = mass(j1, j2, beta, 0.4)
    worst = 0.0
    for i in range(40 * turns):
        step(driveline, i * math.pi / 1000.0, math.pi / 1000.0)
        exact = 50.0 * math.sqrt(m0 / mass(j1, j2, beta, driveline.get("input.angle")))
        worst = max(worst, abs(driveline.get("input.speed") / exact - 1.0))
    return worst


@hard_case(1, "free rotation of the rigid joint, 15 to 89 deg")
def free_rotation() -> Iterator[Outcome]:
    """Kinetic energy is conserved, so w = w0 sqrt(M0 / M) (PHYSICS.md 3)."""
    for degrees in (15, 45, 75, 85, 89):
        error = free_rotation_error(0.2, 0.3, math.radians(degrees), 1e-9)
        yield Outcome(error, 1e-9, "1", f"relative speed error at {degrees} deg, tolerance 1e-9")


@hard_case(2, "inertias a million times apart")
def inertia_ratio() -> Iterator[Outcome]:
    """The same law with J1 / J2 = 1e-6 and 1e6."""
    for j1, j2 in ((1e-6, 1.0), (1.0, 1e-6)):
        for degrees in (30, 75):
            error = free_rotation_error(j1, j2, math.radians(degrees), 1e-9)
            yield Outcome(error, 1e-9, "1", f"relative speed error, J1/J2 = {j1 / j2:g}, {degrees} deg")


@hard_case(3, "joint angles up to 90 deg and through it")
def near_ninety() -> Iterator[Outcome]:
    """89.9 deg is accurate; 90 deg and a joint that moves through it are refused with the state kept."""
    error = free_rotation_error(0.2, 0.3, math.radians(89.9), 1e-9, turns=2)
    yield Outcome(error, 1e-9, "1", "relative speed error at 89.9 deg, tolerance 1e-9")
    try:
        start({**RIGID, "joint1.angle": math.pi / 2})
        refused = 1.0
    except Refused as refusal:
        refused = 0.0 if "joint1.angle" in str(refusal) and "90 deg" in str(refusal) else 1.0
    yield Outcome(refused, 0.0, "1", "90 deg: 0 if refused by name and range")
    driveline = start({**RIGID, "joint1.angle": 1.4, "initial.speed": 20.0})
    state = driveline.get_state()
    driveline.set("joint1.angle.der1", 1.0)
    taken = driveline.do_step(0.0, 0.5)
    driveline.set("joint1.angle.der1", 0.0)
    yield Outcome(float(taken or driveline.get_state() != state), 0.0, "1",
                  "moving through 90 deg within a step: 0 if refused and the state kept")


@hard_case(16, "20 000 rpm at 45 deg")
def fast_rotation() -> Iterator[Outcome]:
    """Energy of the lossless compliant driveline at 20 000 rpm over 1 s (333 turns)."""
    driveline = start({"joint1.angle": math.pi / 4, "joint2.angle": math.pi / 4, "shaft.damping": 0.0,
                       "shaft.stiffness": 2e5, "input.inertia": 0.01, "output.inertia": 0.02,
                       "initial.speed": 20000 * math.pi / 30})
    before = driveline.get("energy.kinetic") + driveline.get("energy.strain")
    for i in range(1000):
        step(driveline, i * 1e-3, 1e-3)
    after = driveline.get("energy.kinetic") + driveline.get("energy.strain")
    yield Outcome(abs(after / before - 1.0), 1e-9, "1", "relative energy drift over 1 s, tolerance 1e-9")
    yield Outcome(abs(driveline.get("energy.residual")) / before, 1e-9, "1", "relative energy residual")
