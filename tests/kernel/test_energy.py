"""Energy: conserved without damping, and `energy.residual` tells the integration error."""

import math

import cardan_kernel
import pytest

from tests.kernel.runs import go, start

JOINTS = {"joint1.angle": math.radians(20), "joint2.angle": math.radians(15)}


def test_drift_over_100_seconds():
    """No damping, no load, 3000 rpm, 100 s: relative drift below 1e-7 at tolerance 1e-9."""
    driveline = start(cardan_kernel.Driveline, {**JOINTS, "shaft.damping": 0.0, "initial.speed": 314.159,
                                                "initial.twist": 0.01}, 1e-9)
    begin = driveline.get("energy.kinetic") + driveline.get("energy.strain")
    go(driveline, 100.0, 0.1)
    end = driveline.get("energy.kinetic") + driveline.get("energy.strain")
    assert abs(end / begin - 1.0) < 1e-7


@pytest.mark.parametrize("tolerance", [1e-5, 1e-7, 1e-9, 1e-11])
def test_residual_is_the_true_error(tolerance):
    """Without load the energy is known exactly, so its error is known; the residual gives its order."""
    driveline = start(cardan_kernel.Driveline, {**JOINTS, "shaft.damping": 0.0, "initial.speed": 314.159,
                                                "initial.twist": 0.01}, tolerance)
    begin = driveline.get("energy.kinetic") + driveline.get("energy.strain")
    go(driveline, 1.0, 0.05)
    error = begin - driveline.get("energy.kinetic") - driveline.get("energy.strain")
    residual = driveline.get("energy.residual")
    assert 0.3 * abs(error) < abs(residual) < 3.0 * abs(error)


POWERED = {**JOINTS, "initial.speed": 200.0, "input.torque": 150.0, "output.torque": 100.0, "input.damping": 0.1,
           "output.damping": 0.2, "joint1.trunnion.damping_a": 0.2, "joint2.trunnion.damping_b": 0.1,
           "joint1.cross.inertia_a": 2e-3, "joint1.cross.inertia_b": 1e-3, "joint2.cross.inertia_m": 3e-3}


@pytest.mark.parametrize("extra", [
    {}, {"model.fidelity": 1}, {"joint1.trunnion.friction": 2.0},
    {"model.drive": 1, "input.speed_command": 200.0, "input.speed_command.der1": 40.0},
    {"joint1.angle.der1": 0.2, "joint1.angle.der2": -0.4, "joint2.angle.der1": 0.1},
    {"model.fidelity": 1, "joint1.angle.der1": 0.2, "joint2.angle.der1": 0.1},
], ids=["compliant", "rigid", "friction", "driven", "moving", "rigid moving"])
def test_balance_with_everything(kernel, extra):
    """Supplied - delivered - dissipated - stored is zero in one long step with every loss present."""
    driveline = start(kernel, {**POWERED, **extra}, 1e-11)
    assert driveline.do_step(0.0, 0.2), driveline.last_error
    assert abs(driveline.get("energy.residual")) < 1e-9 * driveline.get("energy.kinetic")


def test_balance_over_jumps():
    """A joint angle and a shaft stiffness that jump at a communication point do work; the balance holds."""
    driveline = start(cardan_kernel.Driveline, {**POWERED, "shaft.damping": 0.5}, 1e-11)
    for i in range(40):
        driveline.set("joint1.angle", math.radians(20 + 0.1 * i))
        driveline.set("joint2.angle", math.radians(15 + 0.05 * i))
        if i == 20:
            driveline.set("shaft.stiffness", 3e4)
        assert driveline.do_step(i * 0.005, 0.005), driveline.last_error
    assert abs(driveline.get("energy.residual")) < 1e-9 * driveline.get("energy.kinetic")


def test_prescribed_speed_that_jumps():
    """The drive supplies the kinetic energy of a jump in the prescribed speed."""
    driveline = start(cardan_kernel.Driveline, {**JOINTS, "model.drive": 1, "input.speed_command": 100.0}, 1e-11)
    for i in range(10):
        driveline.set("input.speed_command", 100.0 + 5.0 * i)
        assert driveline.do_step(i * 0.01, 0.01), driveline.last_error
    assert driveline.get("input.speed") == 145.0
    assert abs(driveline.get("energy.residual")) < 1e-9 * driveline.get("energy.kinetic")


def test_kinematic_model_integrates_nothing():
    """Rigid with prescribed speed: exact motion, no integrator step, reaction torque from the balance of power."""
    driveline = start(cardan_kernel.Driveline, {**POWERED, "model.fidelity": 1, "model.drive": 1,
                                                "input.speed_command": 200.0, "input.speed_command.der1": 30.0})
    before = driveline.get("energy.kinetic")
    supplied, step = 0.0, 2e-5
    previous = driveline.get("power.input") - driveline.get("power.output") - driveline.get("power.loss")
    for i in range(1000):
        driveline.set("input.speed_command", 200.0 + 30.0 * (i * step))
        assert driveline.do_step(i * step, step)
        power = driveline.get("power.input") - driveline.get("power.output") - driveline.get("power.loss")
        supplied += 0.5 * step * (previous + power)  # trapezium, so of second order in the step
        previous = power
    assert driveline.get("solver.evaluations") == 0
    assert driveline.get("energy.residual") == 0.0
    assert supplied == pytest.approx(driveline.get("energy.kinetic") - before, rel=1e-4)
