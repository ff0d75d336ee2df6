"""State: everything is in it, nothing is shared."""

import math
import random

import cardan_kernel
import pytest

from tests.kernel.runs import outputs, start

BASE = {"joint1.angle": math.radians(20), "joint2.angle": math.radians(15), "initial.speed": 300.0, "hold.degree": 5,
        "joint1.trunnion.friction": 0.5, "joint2.cross.inertia_a": 1e-3}


def drive(driveline, begin, count, step=1e-3):
    """Steps with torques that depend on the communication point alone."""
    for i in range(begin, begin + count):
        t = i * step
        driveline.set("input.torque", 200 + 80 * math.sin(600 * t))
        driveline.set("input.torque.der1", 48000 * math.cos(600 * t))
        driveline.set("output.torque", 150 + 0.4 * driveline.get("output.speed"))
        driveline.set("output.torque.by_speed", 0.4)
        assert driveline.do_step(t, step), driveline.last_error


def test_restored_run_repeats_bit_for_bit(kernel):
    driveline = start(kernel, BASE)
    drive(driveline, 0, 20)
    state = driveline.get_state()
    drive(driveline, 20, 20)
    first, end = outputs(driveline), driveline.get_state()
    driveline.set_state(state)
    assert driveline.get_state() == state
    drive(driveline, 20, 20)
    assert outputs(driveline) == first
    assert driveline.get_state() == end


def test_state_goes_into_another_instance(kernel):
    driveline = start(kernel, BASE)
    drive(driveline, 0, 20)
    other = kernel()
    other.set_state(driveline.get_state())
    drive(driveline, 20, 20)
    drive(other, 20, 20)
    assert other.get_state() == driveline.get_state()


def test_instances_do_not_see_each_other(kernel):
    alone, one, two = start(kernel, BASE), start(kernel, BASE), start(kernel, {**BASE, "joint1.angle": 0.7})
    for i in range(10):
        drive(alone, i, 1)
    for i in range(10):
        drive(one, i, 1)
        drive(two, i, 1)
    assert outputs(one) == outputs(alone)
    assert outputs(two) != outputs(alone)


def test_state_of_another_version_is_refused():
    driveline = start(cardan_kernel.Driveline, BASE)
    before = driveline.get_state()
    driveline.set_state(before[:-8])
    assert "bytes is refused" in driveline.last_error
    assert not driveline.do_step(0.0, 1e-3)
    assert driveline.do_step(0.0, 1e-3)


def test_bytes_that_are_no_state_are_refused(kernel):
    driveline = start(kernel, BASE)
    before = driveline.get_state()
    for junk in (bytes(len(before)), b"\xff" * len(before)):
        driveline.set_state(junk)
        assert "no state of this version" in driveline.last_error
        assert driveline.get_state() == before
        assert not driveline.do_step(0.0, 1e-3)
    assert driveline.do_step(0.0, 1e-3)


def test_asking_for_outputs_changes_nothing():
    """Outputs are computed when asked for; a run that asks and one that does not end alike."""
    quiet, curious = start(cardan_kernel.Driveline, BASE), start(cardan_kernel.Driveline, BASE)
    for i in range(20):
        quiet.set("input.torque", 10.0 * i)
        curious.set("input.torque", 10.0 * i)
        outputs(curious)
        assert quiet.do_step(i * 1e-3, 1e-3)
        assert curious.do_step(i * 1e-3, 1e-3)
        outputs(curious)
    assert outputs(quiet) == outputs(curious)


def test_outputs_belong_to_the_end_of_the_step():
    """Inputs set after a step do not change its outputs (docs: outputs hold their values)."""
    driveline = start(cardan_kernel.Driveline, BASE)
    drive(driveline, 0, 3)
    before = outputs(driveline)
    driveline.set("input.torque", -999.0)
    driveline.set("joint1.angle", 0.9)
    assert outputs(driveline) == before


@pytest.mark.skipif(cardan_kernel.Compiled is None, reason="the compiled kernel was not built")
@pytest.mark.parametrize("seed", range(30))
def test_kernels_are_equal_to_the_last_bit(seed):
    """Compiled and interpreted: same state, outputs, Jacobians and messages for random parameters and inputs."""
    chance = random.Random(seed)
    values = {"model.fidelity": chance.choice((1, 2)), "model.drive": chance.choice((0, 1)),
              "hold.degree": chance.choice((0, 1, 3, 5)), "shaft.yoke_phase": chance.gauss(0, 1),
              "shaft.plane_twist": chance.gauss(0, 1), "initial.angle": chance.gauss(0, 30),
              "initial.speed": chance.gauss(0, 200), "initial.twist": chance.gauss(0, 0.01),
              "joint1.angle": chance.choice((0.0, chance.uniform(0, 1.3))), "joint2.angle": chance.uniform(0, 1.3),
              "input.damping": chance.choice((0.0, 0.3)), "shaft.damping": chance.choice((0.0, 3.0))}
    for joint in ("joint1", "joint2"):
        if chance.random() < 0.5:
            values[f"{joint}.trunnion.friction"] = chance.uniform(0, 3)
            values[f"{joint}.trunnion.damping_a"] = chance.uniform(0, 1)
        if chance.random() < 0.5:
            values.update({f"{joint}.cross.inertia_{axis}": chance.uniform(0, 0.01) for axis in "abm"})
    one, two = start(cardan_kernel.Interpreted, values), start(cardan_kernel.Compiled, values)
    moving = chance.random() < 0.4
    for i in range(12):
        inputs = {"input.torque": chance.gauss(0, 300), "input.torque.der1": chance.gauss(0, 1e4),
                  "input.torque.by_speed": -chance.random(), "output.torque": chance.gauss(0, 300),
                  "output.torque.by_speed": chance.choice((0.0, chance.random())),
                  "input.speed_command": 100 + chance.gauss(0, 5), "input.speed_command.der2": chance.gauss(0, 1e3)}
        if moving:
            inputs["joint1.angle.der1"] = chance.gauss(0, 0.01)
            inputs["joint1.angle"] = chance.uniform(0.3, 0.31)
        step = chance.choice((1e-9, 1e-4, 1e-3, 1e-2))
        for driveline in (one, two):
            for name, value in inputs.items():
                driveline.set(name, value)
            driveline.set("hold.restart", i == 6)
            driveline.do_step(i, step)
        assert one.last_error == two.last_error
        assert one.get_state() == two.get_state()
    assert outputs(one) == outputs(two)
    assert one.jacobian() == two.jacobian()
    assert one.get_state() == two.get_state()
