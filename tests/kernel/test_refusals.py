"""What is refused, with which words, and that nothing is lost by it."""

import math

import cardan_kernel
import pytest
from cardan_kernel import INDEX, VARIABLES

from tests.kernel.runs import start

GOOD = {"joint1.angle": 0.3, "joint2.angle": 0.25, "initial.speed": 100.0}
BOUNDED = [v for v in VARIABLES if v.causality == "parameter" and (v.minimum is not None or v.maximum is not None)]


def begin(values, tolerance=None):
    """A driveline after initialization, with its refusals collected."""
    told = []
    driveline = cardan_kernel.Driveline(log=lambda status, text: told.append((status, text)))
    driveline.setup_experiment(0.0, None, tolerance)
    driveline.enter_initialization_mode()
    for name, value in values.items():
        driveline.set(name, value)
    driveline.exit_initialization_mode()
    return driveline, told


@pytest.mark.parametrize("variable", BOUNDED, ids=lambda v: v.name)
def test_parameter_out_of_range(variable):
    """Name, value and range are told; the step is refused; a corrected value lets the run go on."""
    for bad in ([] if variable.minimum is None else [variable.minimum - 1]) + (
            [] if variable.maximum is None else [variable.maximum + 1]):
        driveline, told = begin({**GOOD, variable.name: bad})
        assert told and told[0][0] == 3
        for part in (f"{variable.name} = {bad:.10g}", "refused", "must be"):
            assert part in told[0][1]
        assert not driveline.do_step(0.0, 1e-3)
        assert variable.name in driveline.last_error
        driveline.set(variable.name, variable.start)
        assert driveline.do_step(0.0, 1e-3), driveline.last_error


@pytest.mark.parametrize("bad", [math.nan, math.inf, -math.inf])
@pytest.mark.parametrize("variable", [v for v in VARIABLES if v.causality != "output" and v.type == "Real"],
                         ids=lambda v: v.name)
def test_not_a_number(variable, bad):
    driveline, told = begin({**GOOD, variable.name: bad})
    assert any(variable.name in text for _, text in told) or not driveline.do_step(0.0, 1e-3)
    assert not driveline.do_step(0.0, 1e-3)
    assert f"{variable.name} = {bad}" in driveline.last_error


@pytest.mark.parametrize("name", [v.name for v in VARIABLES if v.causality == "input" and v.type == "Real"])
@pytest.mark.parametrize("bad", [math.nan, math.inf])
def test_bad_input_during_the_run_leaves_the_state(name, bad):
    driveline = start(cardan_kernel.Driveline, GOOD)
    assert driveline.do_step(0.0, 1e-3)
    good, state = driveline.get(name), driveline.get_state()
    driveline.set(name, bad)
    assert not driveline.do_step(1e-3, 1e-3)
    assert name in driveline.last_error and str(bad) in driveline.last_error
    driveline.set(name, good)
    assert driveline.get_state() == state
    assert driveline.do_step(1e-3, 1e-3)


@pytest.mark.parametrize(("angle", "words"), [
    (math.pi / 2, "below 1.570796327 rad (90 deg)"), (2.0, "114.592 deg"), (-0.1, "shaft.plane_twist")])
def test_joint_at_or_beyond_90_degrees(angle, words):
    driveline = start(cardan_kernel.Driveline, GOOD)
    driveline.set("joint1.angle", angle)
    assert not driveline.do_step(0.0, 1e-3)
    assert "joint1.angle" in driveline.last_error and words in driveline.last_error


def test_joint_that_straightens_to_zero():
    """20 deg to 0 in a second of 1 ms steps: the end misses zero by rounding and is taken all the same."""
    beta = math.radians(20)
    driveline = start(cardan_kernel.Driveline, {**GOOD, "joint1.angle": beta, "joint1.angle.der1": -beta})
    for i in range(1000):
        driveline.set("joint1.angle", beta - beta * (i * 1e-3))
        assert driveline.do_step(i * 1e-3, 1e-3), driveline.last_error
    driveline.set("joint1.angle", -2e-17)
    driveline.set("joint1.angle.der1", 0.0)
    assert driveline.do_step(1.0, 1e-3), driveline.last_error
    assert abs(driveline.get("joint1.ratio") - 1.0) < 1e-15


def test_joint_that_moves_through_90_degrees_during_the_step():
    """Also where only the middle of the step is beyond it."""
    driveline = start(cardan_kernel.Driveline, GOOD)
    for inputs in ({"joint2.angle.der1": 2.0}, {"joint2.angle.der1": 6.0, "joint2.angle.der2": -12.0}):
        state = driveline.get_state()
        for name, value in inputs.items():
            driveline.set(name, value)
        assert not driveline.do_step(0.0, 1.0)
        assert "joint2.angle reaches" in driveline.last_error and "90 deg" in driveline.last_error
        driveline.set_state(state)
    assert driveline.do_step(0.0, 1.0)


@pytest.mark.parametrize("step", [0.0, -1e-3, math.nan, math.inf])
def test_step_that_is_no_step(step):
    driveline = start(cardan_kernel.Driveline, GOOD)
    state = driveline.get_state()
    assert not driveline.do_step(0.0, step)
    assert "must be a finite number above 0" in driveline.last_error
    assert driveline.get_state() == state


def test_order_of_calls():
    driveline = cardan_kernel.Driveline()
    assert not driveline.do_step(0.0, 1e-3)
    assert "before exit_initialization_mode" in driveline.last_error
    driveline.setup_experiment(0.0)
    driveline.enter_initialization_mode()
    assert not driveline.do_step(0.0, 1e-3)
    driveline.exit_initialization_mode()
    assert driveline.do_step(0.0, 1e-3)
    driveline.terminate()
    assert not driveline.do_step(1e-3, 1e-3)
    assert "after terminate" in driveline.last_error


def test_life_cycle_in_another_order():
    """Calls out of order change nothing and are told; the next step is refused once."""
    driveline = cardan_kernel.Driveline()
    driveline.exit_initialization_mode()
    assert "outside of initialization mode" in driveline.last_error
    driveline.terminate()
    assert "before exit_initialization_mode" in driveline.last_error
    driveline = start(cardan_kernel.Driveline, GOOD)
    for call in (driveline.enter_initialization_mode, driveline.exit_initialization_mode,
                 lambda: driveline.setup_experiment(0.0)):
        call()
        assert "refused" in driveline.last_error
        assert not driveline.do_step(0.0, 1e-3)
        assert driveline.do_step(0.0, 1e-3)


def test_late_change_of_a_fixed_parameter():
    driveline = start(cardan_kernel.Driveline, GOOD)
    driveline.set("input.inertia", 5.0)
    assert "input.inertia is a fixed parameter" in driveline.last_error
    assert driveline.get("input.inertia") == 0.2
    assert not driveline.do_step(0.0, 1e-3)
    assert driveline.do_step(0.0, 1e-3)
    driveline.set("shaft.stiffness", 1e4)  # tunable
    assert driveline.do_step(1e-3, 1e-3)


def test_wrong_references_and_types():
    driveline = start(cardan_kernel.Driveline, GOOD)
    assert math.isnan(driveline.get_real([999])[0]) and "999 is unknown" in driveline.last_error
    assert math.isnan(driveline.get_real([INDEX["model.drive"]])[0]) and "type Integer" in driveline.last_error
    driveline.set_real([INDEX["output.speed"]], [1.0])
    assert "output.speed is an output" in driveline.last_error
    driveline.set_integer([INDEX["input.torque"]], [1])
    assert "type Real" in driveline.last_error
    assert driveline.get("input.torque") == 0.0


def test_no_inertia_left():
    driveline, told = begin({**GOOD, "input.inertia": 0.0, "shaft.inertia_a": 0.0})
    assert "one of them must be positive" in told[0][1]
    assert not driveline.do_step(0.0, 1e-3)


@pytest.mark.parametrize("tolerance", [0.0, -1.0, 1.0, math.nan])
def test_tolerance_of_the_master(tolerance):
    _driveline, told = begin(GOOD, tolerance)
    assert "tolerance" in told[0][1] and "at least 1e-13 and at most 0.1" in told[0][1]


def test_torque_that_leaves_the_numbers():
    """A derivative of 1e305 N.m/s over a second: told and undone."""
    driveline = start(cardan_kernel.Driveline, GOOD)
    state = driveline.get_state()
    driveline.set("input.torque.der1", 1e305)
    assert not driveline.do_step(0.0, 1.0)
    assert "der1" in driveline.last_error
    driveline.set("input.torque.der1", 0.0)
    assert driveline.get_state() == state
    assert driveline.do_step(0.0, 1e-3)
