"""Statics and loads: couples, trunnion force, torque through the joints, literature figures (PHYSICS.md 2 and 5)."""

import math

import cardan_kernel
import pytest

from tests.kernel.runs import go, outputs, start
from tests.reference.table import load

RIGID_DRIVEN = {"model.fidelity": 1, "model.drive": 1}


def test_secondary_couples_of_the_multibody_model():
    """One joint 20 deg with the spring behind it; couples B1, B2 and speeds of the 3-D model over 1 s."""
    table = load("driven_single")
    beta, speed = math.radians(20), 100.0
    driveline = start(cardan_kernel.Driveline, {
        "joint1.angle": beta, "input.inertia": 0.05, "output.inertia": 0.08, "shaft.inertia_a": 0.0,
        "shaft.inertia_b": 0.0, "shaft.stiffness": 8000.0, "shaft.damping": 1.0, "initial.speed": speed,
        "initial.twist_rate": speed / math.cos(beta) - speed, "hold.degree": 5}, 1e-11)
    start_up = [1 / 64, 1 / 64, 1 / 32, 1 / 16, 1 / 8, 1 / 4, 1 / 2]
    t, w = 0.0, 80 * math.pi
    for sample in range(11):
        for column, name in (("phi1_rad", "input.angle"), ("theta3_rad", "output.angle"), ("w1_rad_s", "input.speed"),
                             ("w2_rad_s", "shaft.speed_a"), ("w3_rad_s", "output.speed"),
                             ("Tshaft_Nm", "shaft.torque"), ("B1_Nm", "joint1.couple_in"),
                             ("B2_Nm", "joint1.couple_out")):
            assert driveline.get(name) == pytest.approx(table[column][sample], abs=2e-7), (sample, name)
        if sample == 10:
            break
        steps = [2.5e-4] * 400
        if sample == 0:  # short first steps keep the sixth order of the hold
            steps = [2.5e-4 * part for part in start_up] + steps[1:]
        for h in steps:
            driveline.set("input.torque", 50 + 20 * math.sin(w * t))
            driveline.set("input.torque.der1", 20 * w * math.cos(w * t))
            driveline.set("output.torque", 0.5 * driveline.get("output.speed"))
            driveline.set("output.torque.by_speed", 0.5)
            assert driveline.do_step(t, h)
            t += h


def test_static_torques_and_trunnion_force():
    """Massless single joint: T_in = r T_out, couples and the force M / (2 R cos beta) at its largest."""
    beta, load_torque, radius = math.radians(30), 63.7, 0.0155
    largest = 0.0
    for i in range(73):
        driveline = start(cardan_kernel.Driveline, {
            **RIGID_DRIVEN, "joint1.angle": beta, "initial.angle": math.radians(5 * i), "input.inertia": 0.0,
            "output.inertia": 0.0, "shaft.inertia_a": 0.0, "shaft.inertia_b": 0.0, "output.torque": load_torque,
            "input.speed_command": 1.0, "joint1.trunnion.radius": radius})
        r = driveline.get("joint1.ratio")
        assert driveline.get("input.reaction_torque") == pytest.approx(r * load_torque, rel=1e-14)
        assert driveline.get("joint1.couple_in") == pytest.approx(
            r * load_torque * math.tan(beta) * math.sin(math.radians(5 * i)), abs=1e-12)
        assert driveline.get("power.input") == pytest.approx(r * load_torque, rel=1e-14)
        largest = max(largest, driveline.get("joint1.trunnion.force") / driveline.get("input.reaction_torque"))
    assert largest == pytest.approx(1 / (2 * radius * math.cos(beta)), rel=1e-13)


def test_ivanovic_corrected():
    """30 deg, M_max = M / cos a = 73.511 N.m on a cross of 31 mm between the forces: 2.371 kN per trunnion."""
    angle = math.radians(30)
    torque = 73.511 * math.cos(angle)
    driveline = start(cardan_kernel.Driveline, {
        **RIGID_DRIVEN, "joint1.angle": angle, "initial.angle": math.pi / 2, "input.inertia": 0.0,
        "output.inertia": 0.0, "shaft.inertia_a": 0.0, "shaft.inertia_b": 0.0, "input.speed_command": 1.0,
        "output.torque": torque / math.cos(angle), "joint1.trunnion.radius": 0.0155})
    assert driveline.get("input.reaction_torque") == pytest.approx(torque, rel=1e-14)
    assert driveline.get("joint1.trunnion.force") == pytest.approx(2371.0, abs=0.5)


def test_torque_through_the_joints_balances_the_inertias():
    """Torque in - torque out over each part is inertia times acceleration, crosses and friction included."""
    values = {"joint1.angle": 0.4, "joint2.angle": 0.3, "shaft.yoke_phase": 0.2, "initial.speed": 150.0,
              "initial.twist": 0.01, "input.torque": 120.0, "output.torque": 90.0, "input.damping": 0.2,
              "output.damping": 0.1, "joint1.cross.inertia_b": 4e-3, "joint2.trunnion.damping_a": 0.3}
    driveline = go(start(cardan_kernel.Driveline, values), 0.013, 1e-3)
    now = outputs(driveline)
    assert now["joint1.torque_in"] == pytest.approx(120 - 0.2 * now["input.acceleration"] - 0.2 * now["input.speed"])
    assert now["joint2.torque_out"] == pytest.approx(90 + 1.5 * now["output.acceleration"] + 0.1 * now["output.speed"])
    assert now["power.input"] == pytest.approx(120 * now["input.speed"])
    slip = now["shaft.speed_a"] - now["shaft.speed_b"]
    assert now["shaft.torque"] == pytest.approx(2e4 * now["shaft.twist"] + 2.0 * slip)


def test_fligiel_corrected():
    """314 rad/s, J = 0.008794: acceleration extremes 3019.6, 12321.1, 29043.5 1/s2 at their corrected angles."""
    for degrees, extreme, place in ((10, 3019.6, 44.12), (20, 12321.1, 41.46), (30, 29043.5, 37.02)):
        driveline = start(cardan_kernel.Driveline, {
            **RIGID_DRIVEN, "joint1.angle": math.radians(degrees), "initial.angle": math.radians(-place),
            "input.speed_command": 314.0, "output.inertia": 0.008794})
        acceleration = driveline.get("output.acceleration")
        assert acceleration == pytest.approx(extreme, rel=2e-5)
        assert driveline.get("inertia_torque") == pytest.approx(0.008794 * acceleration, rel=1e-14)
        beta = math.radians(degrees)
        fastest = start(cardan_kernel.Driveline, {**RIGID_DRIVEN, "joint1.angle": beta, "input.speed_command": 314.0})
        assert fastest.get("output.speed") == pytest.approx(314 / math.cos(beta), rel=1e-14)
