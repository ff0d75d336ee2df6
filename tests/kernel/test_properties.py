"""Properties that hold for any valid driveline (hypothesis)."""

import math

import cardan_kernel
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.kernel.runs import start

ANGLE = st.floats(0.0, 1.2)
TURN = st.floats(-math.pi, math.pi)


@st.composite
def drivelines(draw, lossless=False):
    """Parameters of a random valid driveline that turns."""
    values = {
        "model.fidelity": draw(st.sampled_from((1, 2))),
        "input.inertia": draw(st.floats(0.01, 1.0)), "output.inertia": draw(st.floats(0.01, 2.0)),
        "shaft.inertia_a": draw(st.floats(1e-3, 0.02)), "shaft.inertia_b": draw(st.floats(1e-3, 0.02)),
        "shaft.stiffness": draw(st.floats(1e3, 1e5)), "shaft.damping": 0.0,
        "shaft.yoke_phase": draw(TURN), "shaft.plane_twist": draw(TURN),
        "joint1.angle": draw(ANGLE), "joint2.angle": draw(ANGLE),
        "initial.angle": draw(TURN), "initial.speed": draw(st.floats(-200.0, 200.0)),
        "initial.twist": draw(st.floats(-0.02, 0.02)), "initial.twist_rate": draw(st.floats(-2.0, 2.0)),
    }
    for joint in ("joint1", "joint2"):
        for axis in "abm":
            values[f"{joint}.cross.inertia_{axis}"] = draw(st.sampled_from((0.0, 1e-3, 5e-3)))
    if not lossless:
        values["shaft.damping"] = draw(st.floats(0.0, 5.0))
        values["input.damping"] = draw(st.floats(0.0, 1.0))
        values["joint1.trunnion.damping_a"] = draw(st.floats(0.0, 0.5))
        values["joint2.trunnion.friction"] = draw(st.sampled_from((0.0, 1.0)))
        values["input.torque"] = draw(st.floats(-100.0, 100.0))
        values["output.torque"] = draw(st.floats(-100.0, 100.0))
    return values


@given(drivelines())
@settings(max_examples=60, deadline=None)
def test_energy_balance(values):
    """Supplied - delivered - dissipated - stored stays zero to the integrator's tolerance."""
    driveline = start(cardan_kernel.Driveline, values, 1e-11)
    scale = driveline.get("energy.kinetic") + driveline.get("energy.strain") + 1.0
    assert driveline.do_step(0.0, 0.05), driveline.last_error
    assert abs(driveline.get("energy.residual")) < 1e-8 * (scale + driveline.get("energy.kinetic"))


@given(drivelines(lossless=True))
@settings(max_examples=60, deadline=None)
def test_time_reversal(values):
    """Without losses the motion run backwards returns to its start."""
    forward = start(cardan_kernel.Driveline, values, 1e-12)
    assert forward.do_step(0.0, 0.02), forward.last_error
    rate = forward.get("shaft.speed_a") - forward.get("shaft.speed_b")
    back = start(cardan_kernel.Driveline, {**values, "initial.angle": forward.get("input.angle"),
                                           "initial.speed": -forward.get("input.speed"),
                                           "initial.twist": forward.get("shaft.twist"),
                                           "initial.twist_rate": -rate}, 1e-12)
    assert back.do_step(0.0, 0.02), back.last_error
    size = abs(values["initial.speed"]) + 1.0
    assert abs(back.get("input.angle") - values["initial.angle"]) < 1e-7 * size
    assert abs(back.get("input.speed") + values["initial.speed"]) < 1e-5 * size
    if values["model.fidelity"] == 2:
        assert abs(back.get("shaft.twist") - values["initial.twist"]) < 1e-7 * size


@given(drivelines(), st.sampled_from((-1, 1)))
@settings(max_examples=60, deadline=None)
def test_half_a_turn_changes_nothing(values, side):
    """A cross looks alike after 180 deg: all speeds and torques are the same, the couples change sign."""
    one = start(cardan_kernel.Driveline, values, 1e-12)
    two = start(cardan_kernel.Driveline, {**values, "initial.angle": values["initial.angle"] + side * math.pi}, 1e-12)
    for driveline in (one, two):
        assert driveline.do_step(0.0, 0.02), driveline.last_error
    size = abs(values["initial.speed"]) + 100.0
    for name in ("input.speed", "output.speed", "shaft.twist", "joint1.ratio", "joint2.ratio"):
        assert abs(one.get(name) - two.get(name)) < 1e-8 * size
    for name in ("joint1.couple_in", "joint2.couple_out"):
        assert abs(one.get(name) + two.get(name)) < 1e-5 * (size + abs(one.get(name)))
    assert abs(two.get("output.angle") - one.get("output.angle") - side * math.pi) < 1e-8 * size


@given(drivelines(lossless=True), st.lists(st.floats(1e-6, 5e-3), min_size=2, max_size=12))
@settings(max_examples=40, deadline=None)
def test_communication_points_do_not_matter(values, steps):
    """Constant inputs: any division of the time gives the same motion to tolerance."""
    whole, parts = (start(cardan_kernel.Driveline, values, 1e-11) for _ in range(2))
    assert whole.do_step(0.0, math.fsum(steps)), whole.last_error
    for step in steps:
        assert parts.do_step(0.0, step), parts.last_error
    size = abs(values["initial.speed"]) + 10.0
    for name in ("input.angle", "input.speed", "output.speed"):
        assert abs(whole.get(name) - parts.get(name)) < 1e-6 * size
