"""Limits with known results: no joints, rigid shaft, locked output."""

from __future__ import annotations

import math
from collections.abc import Iterator

from .outcome import Outcome, hard_case, start, step


def plain_shaft_difference() -> float:
    """1 where straight joints differ in any bit from two inertias on a spring, else 0.

    The plain shaft is the same driveline whose inertias stand on the shaft halves: with r = 1 the two ways
    of adding them are the same sums only if the joints add nothing at all, not even a rounding.
    """
    values = {"shaft.stiffness": 1.7e4, "shaft.damping": 1.3, "initial.speed": 123.4, "initial.twist": 0.007,
              "input.torque": 77.0, "output.torque": 55.0}
    bent_nowhere = start({**values, "shaft.yoke_phase": 0.7, "shaft.plane_twist": -0.4, "input.inertia": 0.25,
                          "output.inertia": 1.25, "shaft.inertia_a": 0.0, "shaft.inertia_b": 0.0})
    plain = start({**values, "input.inertia": 0.0, "output.inertia": 0.0, "shaft.inertia_a": 0.25,
                   "shaft.inertia_b": 1.25})
    for i in range(500):
        for driveline in (bent_nowhere, plain):
            step(driveline, i * 1e-3, 1e-3)
        for name in ("input.angle", "input.speed", "output.angle", "output.speed", "shaft.twist", "shaft.torque"):
            if bent_nowhere.get(name) != plain.get(name):
                return 1.0
    return 0.0


@hard_case(8, "straight joints")
def straight() -> Iterator[Outcome]:
    """beta = 0 is a plain two-inertia shaft, bit for bit; and its exact solution."""
    yield Outcome(plain_shaft_difference(), 0.0, "1", "0 if equal to the last bit over 500 steps")
    j1, j3, k, a = 0.25, 1.25, 1.7e4, 0.01
    driveline = start({"input.inertia": j1, "output.inertia": j3, "shaft.inertia_a": 0.0, "shaft.inertia_b": 0.0,
                       "shaft.stiffness": k, "shaft.damping": 0.0, "initial.twist": a, "initial.speed": 100.0}, 1e-12)
    for i in range(100):
        step(driveline, i * 1e-3, 1e-3)
    exact = a * math.cos(math.sqrt(k * (1 / j1 + 1 / j3)) * 0.1)
    yield Outcome(abs(driveline.get("shaft.twist") - exact) / a, 1e-11, "1",
                  "twist against a cos(w_n t), tolerance 1e-12")


def rigid_difference(k: float, d: float) -> float:
    """Largest difference of the output speed to the rigid driveline over 20 ms, rad/s."""
    values = {"joint1.angle": 0.35, "joint2.angle": 0.2, "initial.speed": 100.0, "input.torque": 50.0,
              "output.torque": 30.0}
    # Start on the slow motion: twist and twist rate that the rigid driveline's shaft torque asks for.
    probe = start({**values, "model.fidelity": 1})
    torque = probe.get("shaft.torque")
    step(probe, 0.0, 1e-7)
    rate = (probe.get("shaft.torque") - torque) / 1e-7
    soft = start({**values, "shaft.stiffness": k, "shaft.damping": d, "initial.twist": torque / k,
                  "initial.twist_rate": rate / k})
    stiff = start({**values, "model.fidelity": 1})
    worst = 0.0
    for i in range(20):
        step(soft, i * 1e-3, 1e-3)
        step(stiff, i * 1e-3, 1e-3)
        worst = max(worst, abs(soft.get("output.speed") - stiff.get("output.speed")))
    return worst


@hard_case(11, "stiffness up to 1e9 N.m/rad")
def stiff() -> Iterator[Outcome]:
    """The compliant model converges to the rigid one as 1/k, without damping and with d = 2000 N.m.s/rad."""
    for d in (0.0, 2000.0):
        soft, hard = rigid_difference(1e8, d), rigid_difference(1e9, d)
        yield Outcome(hard, 1e-3, "rad/s", f"output speed against the rigid model, k = 1e9, d = {d:g}")
        yield Outcome(abs(math.log10(soft / hard) - 1.0), 0.15, "1", f"order in 1/k less one, d = {d:g}")


@hard_case(12, "output locked by an inertia of 1e12 kg.m2")
def locked() -> Iterator[Outcome]:
    """The torque is k twist, finite, and settles at the driving torque times the joint's static ratio."""
    beta, torque, k = 0.3, 200.0, 2e4
    driveline = start({"output.inertia": 1e12, "joint1.angle": beta, "input.torque": torque, "input.damping": 20.0,
                       "shaft.stiffness": k, "shaft.damping": 0.0})
    for i in range(2000):
        step(driveline, i * 1e-3, 1e-3)
    yield Outcome(abs(driveline.get("shaft.torque") - k * driveline.get("shaft.twist")), 0.0, "N.m", "T - k twist")
    yield Outcome(abs(driveline.get("shaft.torque") * driveline.get("joint1.ratio") / torque - 1.0), 1e-8, "1",
                  "static balance T_in = r T after 2 s")
    yield Outcome(abs(driveline.get("output.speed")), 1e-8, "rad/s", "speed of the locked output")
