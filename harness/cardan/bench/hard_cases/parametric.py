"""Parametric resonance: growth as Floquet's theory says (docs/PHYSICS.md section 6)."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np
from cardan_kernel import Driveline
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from .outcome import Outcome, hard_case, start, step

K, J = 2e4, 0.5
NATURAL = math.sqrt(K / J)


def multipliers(beta: float, nu: float, damping: float = 0.0) -> np.ndarray:
    """Floquet multipliers over half a turn of y'' + 2 damping/nu y' + nu^-2 r(p)^2 y = 0, by p = Omega t.

    Hill's equation of the homokinetic double joint with constant input speed; `damping` is the ratio of ground
    damping of the output inertia. An integration of its own (LSODA), not the driveline's.
    """
    c, s2 = math.cos(beta), math.sin(beta) ** 2

    def rate(p: float, y: np.ndarray) -> list[float]:
        r = c / (1.0 - s2 * math.cos(p) ** 2)
        return [y[1], -2.0 * damping / nu * y[1] - (r / nu) ** 2 * y[0]]

    columns = [solve_ivp(rate, (0.0, math.pi), unit, rtol=1e-12, atol=1e-13, method="DOP853").y[:, -1]
               for unit in ([1.0, 0.0], [0.0, 1.0])]
    return np.linalg.eigvals(np.array(columns).T)


def growth(beta: float, nu: float, damping: float = 0.0) -> float:
    """Largest growth per half turn, ln |mu|."""
    return float(np.log(np.abs(multipliers(beta, nu, damping)).max()))


def homokinetic(beta: float, nu: float, drag: float = 0.0, twist: float = 1e-10) -> tuple[Driveline, float]:
    """The double joint at nu = Omega / w_n with a small twist; drag is N.m.s/rad at the output."""
    speed = nu * NATURAL
    return start({"model.drive": 1, "joint1.angle": beta, "joint2.angle": beta, "input.speed_command": speed,
                  "output.inertia": J, "shaft.inertia_b": 0.0, "shaft.stiffness": K, "shaft.damping": 0.0,
                  "output.damping": drag, "output.torque": -drag * speed, "initial.twist": twist,
                  "initial.angle": 0.6}, 1e-13), speed


def simulated_growth(beta: float, nu: float, drag: float = 0.0, settle: int = 100, count: int = 12) -> float:
    """Growth per half turn of the perturbation in the driveline itself, after `settle` half turns in which the
    decaying solution dies out, over the next `count`.
    """
    driveline, speed = homokinetic(beta, nu, drag)
    half = math.pi / speed

    def run(half_turns: int, begin: int) -> None:
        for i in range(begin, begin + half_turns):
            step(driveline, i * half, half)

    run(settle, 0)
    first = driveline.get("shaft.twist")
    run(count, settle)
    return math.log(abs(driveline.get("shaft.twist") / first)) / count


def edge(beta: float, side: int) -> float:
    """nu at the lower (side -1) or upper (+1) edge of the principal region: a multiplier passes -1."""

    def trace(nu: float) -> float:
        return float(np.real(multipliers(beta, nu).sum())) + 2.0

    width = math.sin(beta) ** 2 / math.cos(beta)  # twice the region's, to first order
    return float(brentq(trace, 1.0, 1.0 + side * width, xtol=1e-12))


@hard_case(6, "parametric resonance without damping, and at its critical damping")
def parametric() -> Iterator[Outcome]:
    """Growth as the Floquet exponent inside the principal region, bounded outside, critical damping between."""
    for degrees in (5, 15, 30):
        beta = math.radians(degrees)
        expected = growth(beta, 1.0)
        measured = simulated_growth(beta, 1.0, settle=int(10.0 / expected))
        yield Outcome(abs(measured / expected - 1.0), 1e-5, "1", f"growth per half turn against Floquet, {degrees} deg "
                      f"({expected:.6f})")
        outside = edge(beta, 1) * 1.002
        yield Outcome(largest_twist(beta, outside) / 1e-10, 30.0, "1",
                      f"just outside (nu = {outside:.5f}), {degrees} deg: "
                      "largest twist over the first in 300 turns")
    beta = math.radians(30)
    critical = brentq(lambda zeta: growth(beta, 1.0, zeta), 1e-3, 0.2, xtol=1e-12)
    for factor, grows in ((0.99, True), (1.01, False)):
        drag = factor * critical * 2.0 * math.sqrt(K * J)
        rate = simulated_growth(beta, 1.0, drag, settle=120, count=600)
        yield Outcome(-rate if grows else rate, 0.0, "1", f"30 deg, damping {factor} of critical ({critical:.6f}): "
                      f"{'grows' if grows else 'decays'}, sign of the growth")


def largest_twist(beta: float, nu: float) -> float:
    """Largest twist over 300 turns just outside the region, rad."""
    driveline, speed = homokinetic(beta, nu)
    worst = 0.0
    for i in range(600):
        step(driveline, i * math.pi / speed, math.pi / speed)
        worst = max(worst, abs(driveline.get("shaft.twist")))
    return worst


def free_free(detuning: float, seconds: float = 3.0) -> tuple[float, float]:
    """J1 - joint - k - J2 without torques near Omega = w_n: growth of the twist and relative energy drift.

    At p = 45 deg the rotation has nearly its mean speed, so the detuning is that of the mean.
    """
    j1, j2, k, beta = 0.3, 0.3, 2e4, math.radians(20)
    speed = math.sqrt(k * (1 / j1 + 1 / j2)) * (1.0 + detuning)
    driveline = start({"input.inertia": j1, "output.inertia": 0.0, "shaft.inertia_a": 0.0, "shaft.inertia_b": j2,
                       "shaft.stiffness": k, "shaft.damping": 0.0, "joint1.angle": beta, "initial.speed": speed,
                       "initial.angle": math.pi / 4, "initial.twist": 1e-3}, 1e-12)
    before = driveline.get("energy.kinetic") + driveline.get("energy.strain")
    amplitudes = []
    for i in range(round(seconds / 5e-4)):
        step(driveline, i * 5e-4, 5e-4)
        amplitudes.append(abs(driveline.get("shaft.twist")))
    drift = abs((driveline.get("energy.kinetic") + driveline.get("energy.strain")) / before - 1.0)
    return max(amplitudes) / max(amplitudes[:100]), drift


@hard_case(7, "free-free resonance")
def free_free_resonance() -> Iterator[Outcome]:
    """The twist grows out of the rotation while the total energy is conserved."""
    ratio, drift = free_free(0.0)
    yield Outcome(1.0 / ratio, 0.25, "1", "at Omega = w_n: 1 / growth of the twist in 3 s")
    yield Outcome(drift, 1e-12, "1", "relative drift of the total energy meanwhile, tolerance 1e-12")
    edge_of_region = math.tan(math.radians(10)) ** 2 / 2.0
    for side in (-1.6, 1.6):
        ratio, _ = free_free(side * edge_of_region)
        yield Outcome(ratio, 2.0, "1", f"at Omega / w_n - 1 = {side * edge_of_region:+.4f}, outside: growth in 3 s")
