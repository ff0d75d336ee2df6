"""The system in one piece, written from docs/PHYSICS.md: the reference of the benchmark is right.

It shares no line with the kernel, so both being wrong alike is no accident to be feared.
"""

from __future__ import annotations

import numpy as np
import pytest
from cardan.bench import integrator
from cardan.bench.monolithic import Monolith, speed_error
from cardan.bench.systems import ORDINARY, RESISTANCE, TORQUE, ordinary


def test_it_moves_as_the_kernel_does() -> None:
    """Kernel at tolerance 1e-12: 1e-11 over 0.2 s."""
    system = ordinary()
    points = np.linspace(0.0, 0.2, 21)
    driveline = integrator.started({**ORDINARY, "input.torque": TORQUE, "output.torque": RESISTANCE}, 1e-12)
    rows = [[driveline.get("input.speed"), driveline.get("output.speed")]]
    for t, h in zip(points[:-1], np.diff(points)):
        assert driveline.do_step(t, h), driveline.last_error
        rows.append([driveline.get("input.speed"), driveline.get("output.speed")])
    assert speed_error(np.array(rows).T, system.reference(points)) < 1e-11


def test_straight_joints_turn_as_one_inertia() -> None:
    """T_in - T_out = (J1 + J2a + J2b + J3) w' for the mean motion of a straight shaft: exact for the momentum."""
    system = Monolith(lambda angle, speed: 30.0, lambda speed: 10.0, 0.0, 0.0, 50.0)
    states = _states(system, 0.3)
    momentum = system.j1 * states[2] + system.j2a * states[2] + (system.j2b + system.j3) * states[3]
    whole = system.j1 + system.j2a + system.j2b + system.j3
    assert momentum == pytest.approx(whole * 50.0 + 20.0 * 0.3, rel=1e-12)


def test_a_free_driveline_keeps_its_energy() -> None:
    """No torque, no damping: kinetic and strain energy together, 1e-11."""
    system = Monolith(lambda angle, speed: 0.0, lambda speed: 0.0, 0.6, 0.4, 80.0, 0.01, d=0.0)

    def energy(states: np.ndarray) -> float:
        speeds = system.speeds(states.reshape(4, 1))[:, 0]
        half_a = np.cos(0.6) / (1.0 - (np.sin(0.6) * np.cos(states[0])) ** 2) * states[2]
        kinetic = system.j1 * speeds[0] ** 2 + system.j2a * half_a**2 + system.j2b * states[3] ** 2
        return 0.5 * float(kinetic + system.j3 * speeds[1] ** 2 + system.k * states[1] ** 2)

    start = np.array(system.start())
    assert energy(_states(system, 0.5)) == pytest.approx(energy(start), rel=1e-11)


def _states(system: Monolith, t: float) -> np.ndarray:
    from scipy.integrate import solve_ivp

    solution = solve_ivp(system.right_hand_side(), (0.0, t), system.start(), method="DOP853", rtol=2.5e-14, atol=1e-15)
    return np.asarray(solution.y[:, -1])


def test_the_error_is_the_largest_of_both_speeds_and_inf_for_what_is_no_number() -> None:
    exact = np.array([[1.0, 2.0], [10.0, -20.0]])
    assert speed_error(exact + [[0.0, 0.1], [0.0, 0.0]], exact) == pytest.approx(0.05)
    assert speed_error(exact + [[0.0, 0.0], [4.0, 0.0]], exact) == pytest.approx(0.2)
    assert speed_error(exact * np.nan, exact) == np.inf
    assert speed_error(exact[:, :1], exact) == np.inf
