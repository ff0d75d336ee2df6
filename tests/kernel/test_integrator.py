"""DOP853: conditions of order, convergence and step control."""

import math

import cardan_kernel
import pytest
from cardan_kernel import tableau
from mpmath import mp, mpf

from tests.kernel.runs import start


def test_order_conditions_of_the_tableau():
    """sum b c^k = 1/(k+1) for k = 0..7, row sums, and the embedded weights of order 5 and 3 (Hairer et al., II.1)."""
    with mp.workdps(40):
        check_order_conditions()


def check_order_conditions():
    nodes = [mpf(c) for c in tableau.NODES]
    for c, row in zip(nodes, tableau.STAGE_WEIGHTS):
        assert abs(sum(map(mpf, row.values())) - c) < 1e-14
    b = {j: mpf(v) for j, v in tableau.WEIGHTS.items()}
    for k in range(8):
        assert abs(sum(v * nodes[j] ** k for j, v in b.items()) - mpf(1) / (k + 1)) < 1e-15
    fifth = {j: b.get(j, 0) - mpf(tableau.ERROR_WEIGHTS_5.get(j, 0)) for j in range(12)}
    for k in range(5):
        assert abs(sum(v * nodes[j] ** k for j, v in fifth.items()) - mpf(1) / (k + 1)) < 1e-14
    third = {j: mpf(v) for j, v in tableau.EMBEDDED_WEIGHTS_3.items()}
    for k in range(3):
        assert abs(sum(v * nodes[j] ** k for j, v in third.items()) - mpf(1) / (k + 1)) < 1e-14


def two_inertias(step, tolerance):
    """Error of twist after 0.05 s of a free two-inertia shaft: twist = a cos(w_n t)."""
    driveline = start(cardan_kernel.Driveline, {"shaft.damping": 0.0, "initial.twist": 0.01, "initial.speed": 50.0},
                      tolerance)
    front, back = 0.2 + 0.0044, 1.5 + 0.0044
    frequency = math.sqrt(2e4 * (1 / front + 1 / back))
    for i in range(round(0.05 / step)):
        assert driveline.do_step(i * step, step)
    # wy starts equal to wa: no twist rate
    return abs(driveline.get("shaft.twist") - 0.01 * math.cos(frequency * 0.05)), driveline


def test_order_eight():
    """Fixed steps (a loose tolerance, so that each communication step is one integrator step): slope 8."""
    errors = [two_inertias(0.05 / n, 0.1)[0] for n in (20, 40)]
    assert math.log2(errors[0] / errors[1]) == pytest.approx(8, abs=0.3)


@pytest.mark.parametrize("tolerance", [1e-6, 1e-8, 1e-10, 1e-12])
def test_exact_solution_to_tolerance(tolerance):
    error, driveline = two_inertias(0.05, tolerance)
    assert error < 0.01 * 10 * tolerance + 1e-15
    assert driveline.get("solver.evaluations") == (12 * driveline.get("solver.steps")
                                                   + 11 * driveline.get("solver.rejected"))


def test_step_is_carried_over_communication_points():
    """Short communication steps do not shorten the proposed step: one integrator step each, none rejected."""
    driveline = start(cardan_kernel.Driveline, {"joint1.angle": 0.3, "initial.speed": 300.0}, 1e-6)
    for i in range(2000):
        assert driveline.do_step(i * 1e-5, 1e-5)
    steps = driveline.get("solver.steps")
    assert steps <= 2002
    assert driveline.do_step(0.02, 0.02)
    assert driveline.get("solver.steps") - steps < 20


def test_friction_reversals_are_resolved():
    """Coulomb friction reverses four times a turn in each joint: no step is rejected and the balance holds."""
    driveline = start(cardan_kernel.Driveline, {"joint1.angle": 0.35, "joint2.angle": 0.26, "initial.speed": 314.0,
                                                "joint1.trunnion.friction": 2.0, "joint2.trunnion.friction": 1.0}, 1e-9)
    assert driveline.do_step(0.0, 0.1)
    assert driveline.get("solver.rejected") < 0.01 * driveline.get("solver.steps")
    assert abs(driveline.get("energy.residual")) < 1e-9 * driveline.get("energy.kinetic")
