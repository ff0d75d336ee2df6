"""Kinematics against closed forms in 50 digits and against a 3-D multibody model."""

import math

import pytest
from mpmath import atan2, cos, mp, mpf, pi, sin, sqrt, tan

from tests.kernel.runs import go, start
from tests.reference.table import load

RIGID_DRIVEN = {"model.fidelity": 1, "model.drive": 1}


@pytest.fixture(autouse=True)
def fifty_digits():
    """Reference arithmetic of every test here."""
    with mp.workdps(50):
        yield


def lead(p, beta):
    """phi_out - p of one joint, docs/PHYSICS.md section 2."""
    c = cos(beta)
    return atan2((1 - c) * sin(p) * cos(p), c * cos(p) ** 2 + sin(p) ** 2)


@pytest.mark.parametrize("degrees", [0.0, 1e-6, 5.0, 20.0, 45.0, 80.0, 89.9])
def test_one_turn_of_one_joint(kernel, degrees):
    """phi_out, ratio, g and the cross rates over a turn: 1e-14, near 90 deg times the sensitivity 1/cos."""
    beta = math.radians(degrees)
    tolerance = 1e-14 / math.cos(beta)
    for i in range(25):
        p = mpf(math.radians(15 * i - 180))
        driveline = start(kernel, {**RIGID_DRIVEN, "initial.angle": float(p), "input.speed_command": 2.0,
                                   "joint1.angle": beta, "shaft.plane_twist": 0.0})
        b = mpf(beta)
        s, c = sin(b), cos(b)
        D = 1 - s**2 * cos(p) ** 2
        assert abs(driveline.get("output.angle") - (p + lead(p, b))) < tolerance + 4e-16 * abs(p)
        assert abs(driveline.get("joint1.ratio") * D / c - 1) < tolerance
        assert abs(driveline.get("joint1.trunnion.rate_in") - 2 * c / D * s * cos(p)) < 4 * tolerance / math.cos(beta)
        assert abs(driveline.get("joint1.trunnion.rate_out") - 2 * s * sin(p) / sqrt(D)) < 4 * tolerance


def test_series_of_the_lead():
    """phi_out - p = sum q^n / n sin(2 n p), q = tan^2(beta / 2): the reference itself is right."""
    beta, p = mpf("0.6"), mpf("1.1")
    q = tan(beta / 2) ** 2
    series = sum(q**n / n * sin(2 * n * p) for n in range(1, 120))
    assert abs(series - lead(p, beta)) < mpf(10) ** -45


def test_a_million_turns(kernel):
    """The bounded difference phi_out - phi_in after 1e6 turns at a speed that no double divides: 1e-12.

    The rotation reached is the product of the doubles w and t; its position in the turn is found in 50 digits.
    """
    speed, step, steps = 2.0 * math.pi * 333.3, 30.0, 100
    driveline = start(kernel, {**RIGID_DRIVEN, "input.speed_command": speed, "joint1.angle": math.radians(30.0)})
    go(driveline, steps * step, step)
    p = mpf(speed) * mpf(step) * steps
    assert p > 1e6 * 2 * pi * mpf("0.99")
    p -= 2 * pi * mp.floor(p / (2 * pi))
    b = mpf(math.radians(30.0))
    ratio = cos(b) / (1 - sin(b) ** 2 * cos(p) ** 2)
    assert abs(driveline.get("joint1.ratio") - ratio) < 1e-12
    rate = sin(b) * sin(p) / sqrt(1 - sin(b) ** 2 * cos(p) ** 2)
    assert abs(driveline.get("joint1.trunnion.rate_out") / speed - rate) < 1e-12
    bounded = driveline.get("output.angle") - driveline.get("input.angle")
    assert abs(bounded - lead(p, b)) < 2e-9  # both count turns: their last digit is 1e-9 rad


@pytest.mark.parametrize(("psi", "theta"), [(0.0, 0.0), (40.0, 40.0), (-70.0, 110.0)])
def test_homokinetic_pairs(kernel, psi, theta):
    """beta1 = beta2 and psi - theta = 0 (mod 180 deg): constant ratio 1 within 1e-13 (PHYSICS.md 4)."""
    for i in range(13):
        driveline = start(kernel, {**RIGID_DRIVEN, "initial.angle": math.radians(15 * i), "input.speed_command": 10.0,
                                   "joint1.angle": math.radians(25), "joint2.angle": math.radians(25),
                                   "shaft.yoke_phase": math.radians(psi), "shaft.plane_twist": math.radians(theta)})
        assert abs(driveline.get("ratio") - 1.0) < 1e-13
        # sin(theta + 180 deg) of a double leaves 1e-16 of the 180 deg; U is linear in it
        assert driveline.get("layout.nonuniformity") < 1e-15


def test_crossed_layout_of_a_pair(kernel):
    """beta 25 deg, psi = -40, theta = +40 deg: the ratio leaves 1 by 0.2138 (PHYSICS.md 4 and 5)."""
    ratios = []
    for i in range(361):
        driveline = start(kernel, {**RIGID_DRIVEN, "initial.angle": math.radians(0.5 * i), "input.speed_command": 1.0,
                                   "joint1.angle": math.radians(25), "joint2.angle": math.radians(25),
                                   "shaft.yoke_phase": math.radians(-40), "shaft.plane_twist": math.radians(40)})
        ratios.append(driveline.get("ratio"))
    kappa = 1 / math.cos(driveline.get("layout.equivalent_angle"))
    assert max(abs(ratio - 1) for ratio in ratios) == pytest.approx(0.2138, abs=5e-5)
    assert max(ratios) == pytest.approx(kappa, rel=1e-5)
    assert min(ratios) == pytest.approx(1 / kappa, rel=1e-5)
    assert driveline.get("layout.nonuniformity") == pytest.approx(kappa - 1 / kappa, rel=1e-12)


def test_spatial_pair_of_the_multibody_model(kernel):
    """Angles and speeds of a spatial pair from a 3-D multibody model, good to 1e-14."""
    psi, theta = math.radians(25.0), math.radians(40.0)
    table = load("spatial_pair")
    for i, t in enumerate(table["t_s"]):
        driveline = start(kernel, {**RIGID_DRIVEN, "initial.angle": 0.2 + 100 * math.pi * t,
                                   "input.speed_command": 100 * math.pi, "joint1.angle": math.radians(20),
                                   "joint2.angle": math.radians(35), "shaft.yoke_phase": psi,
                                   "shaft.plane_twist": theta})
        angle = driveline.get("output.angle") + math.pi / 2 + psi - theta
        assert angle == pytest.approx(table["phi3_rad"][i], abs=1e-13)
        assert driveline.get("shaft.speed_a") == pytest.approx(table["w2_rad_s"][i], rel=2e-14)
        assert driveline.get("output.speed") == pytest.approx(table["w3_rad_s"][i], rel=2e-14)
