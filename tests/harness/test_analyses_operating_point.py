"""Periodic steady states and their Floquet multipliers, against closed forms and an independent integration."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from cardan.analyses.floquet import floquet, kernel_monodromy
from cardan.analyses.gauss import gauss_monodromy
from cardan.analyses.operating_point import operating_point
from cardan.analyses.periodic import NoSteadyState, periodic_motion
from cardan.analyses.plant import Plant
from cardan.errors import InputError
from cardan.scenario import Scenario

from tests.harness.analysis_scenes import BARE, homokinetic, scene, single

QUADRATIC = {"type": "quadratic", "coefficient": 1e-3}
MAP = {"type": "map", "lag": 0.1, "speeds": [0, 100, 500], "throttles": [0.0, 1.0],
       "torques": [[0, 0, 0.0], [100, 80.0, 20]]}


def test_homokinetic_pair_without_load_turns_uniformly() -> None:
    # docs/PHYSICS.md section 6: theta_out = Omega t is an exact motion
    point = operating_point(Plant(homokinetic(30.0)))
    outputs = point.motion.fields.outputs
    assert np.abs(outputs[:, 5] / point.speed - 1.0).max() < 1e-12
    assert np.abs(point.motion.states[:, 1]).max() < 1e-11
    assert point.residual < 1e-12


def test_free_rigid_rotation_keeps_its_energy() -> None:
    # w = v / sqrt(M(p)), M = J1 + J2 r^2; the time of a turn is <sqrt M> 2 pi / v
    made = scene({"model.fidelity": 1, "joint1.angle": "30 deg", **BARE})
    motion = periodic_motion(Plant(made), 200.0)
    p, w = motion.states[:, 0], motion.states[:, 2]
    c, s = math.cos(math.radians(30.0)), math.sin(math.radians(30.0))
    inertia = 0.2 + 1.5 * (c / (1.0 - (s * np.cos(p)) ** 2)) ** 2
    fine = np.linspace(0.0, math.pi, 4001)[:-1]
    mean = np.sqrt(0.2 + 1.5 * (c / (1.0 - (s * np.cos(fine)) ** 2)) ** 2).mean()
    assert w == pytest.approx(200.0 * mean / np.sqrt(inertia), rel=1e-12)
    # rounding of the inertia torques, which are of 1e4 N.m
    assert motion.added == pytest.approx(0.0, abs=1e-8)


def test_single_joint_with_compliance_behind_it_has_the_linear_response() -> None:
    # J y'' + d (y' - w_a) + k (y - phi_a) = 0 with phi_a = p + sum q^n/n sin 2np: each order by itself
    made = scene({"joint1.angle": "25 deg", **BARE, "shaft.damping": 3.0}, {"type": "speed", "speed": 70.0})
    motion = operating_point(Plant(made)).motion
    t, q = motion.times, math.tan(math.radians(12.5)) ** 2
    twist = np.zeros(len(t))
    for n in range(1, 60):
        w = 2 * n * 70.0
        twist += (q**n / n * np.exp(1j * w * t) * (-1.5 * w * w / (2e4 + 3j * w - 1.5 * w * w))).imag
    assert motion.states[:, 1] == pytest.approx(twist, abs=1e-13)


@pytest.mark.parametrize(("engine", "load"), [
    (None, QUADRATIC),
    (None, {"type": "road", "mass": 2000.0, "wheel_radius": 0.3, "rolling": 0.01, "axle_ratio": 3.4}),
    ({"type": "four_stroke", "torque": 50.0, "orders": [2, 4], "amplitudes": [30.0, 10.0]}, QUADRATIC),
    (MAP, {"type": "linear", "coefficient": 0.3}),
    (MAP, {"type": "dyno", "speed": 150.0, "gain": 5.0, "integral_gain": 10.0, "torque_limit": 1000.0}),
])
def test_motion_repeats_when_it_is_simulated(engine: dict[str, Any] | None, load: dict[str, Any], fmu: Any) -> None:
    # the harmonic balance knows nothing of the FMU's integrator and the FMU nothing of the balance
    from cardan.analyses.period_map import period_map

    plant = Plant(scene({"joint1.angle": "20 deg", "joint2.angle": "10 deg", "shaft.damping": 5.0}, engine, load))
    point = operating_point(plant, 150.0 if load["type"] != "dyno" else None)
    gap, matrix = period_map(plant, point, fmu)
    assert gap < 2e-8
    multipliers = np.linalg.eigvals(matrix)
    for exact in point.floquet.multipliers:
        assert np.abs(multipliers - exact).min() < 2e-6


def test_mean_speed_and_torque_are_as_asked() -> None:
    point = operating_point(Plant(single(20.0, load=QUADRATIC)), 314.0)
    motion = point.motion
    assert motion.fields.rates[:, 0].mean() == pytest.approx(314.0, rel=1e-13)
    assert motion.mean_torque == pytest.approx(motion.added, rel=1e-12)
    # supplied power = what load and shaft take, on average
    f = motion.fields
    slip = f.outputs[:, 9] - f.outputs[:, 10]
    taken = (f.torques[:, 1] * f.outputs[:, 5] + 4.0 * slip * slip).mean()
    # the mean over the points is exact for products up to their number of harmonics
    assert (f.outputs[:, 3] * f.outputs[:, 1]).mean() == pytest.approx(taken, rel=1e-9)


def test_speed_at_which_a_scene_balances() -> None:
    made = single(20.0, load=QUADRATIC).with_overrides({"engine.torque": "100 N.m"})
    point = operating_point(Plant(made))
    assert point.mean_torque == pytest.approx(100.0, rel=1e-12)
    held = operating_point(Plant(made), point.speed)
    assert held.motion.added == pytest.approx(0.0, abs=1e-8)


def test_kernel_and_gauss_give_the_same_monodromy_matrix() -> None:
    for load in (QUADRATIC, {"type": "linear", "coefficient": 0.5}):
        motion = periodic_motion(Plant(single(25.0, load=load)), 250.0)
        one, turned = kernel_monodromy(motion)
        other, also = gauss_monodromy(motion.fields.a, motion.period, 1)
        assert one == pytest.approx(other, abs=1e-10 * np.abs(other).max())
        # both count the turns of a perturbation, on scales of their own
        assert abs(turned - also) < 0.5 * math.pi


def test_multipliers_obey_liouville() -> None:
    # the product of all multipliers is exp of the time integral of the trace of A
    for made, speed in ((single(30.0), 200.0), (single(15.0, load=QUADRATIC), 400.0)):
        motion = periodic_motion(Plant(made), speed)
        found = floquet(motion)
        trace = np.trace(motion.fields.a, axis1=1, axis2=2).mean() * motion.period
        assert math.log(abs(np.prod(found.multipliers))) == pytest.approx(trace, rel=1e-10)
        # the neutral multiplier of the phase is left out and counted as 1
        assert np.abs(np.linalg.eigvals(found.monodromy) - 1.0).min() < 1e-9


@pytest.mark.parametrize(("made", "speed", "words"), [
    (scene({"joint1.angle": "20 deg", **BARE}), 100.0,
     "nothing resists the rotation (no load that depends on speed, no damping)"),
    (scene({"joint1.angle": "20 deg", **BARE}), None, "torques balance at any speed; give --speed"),
    (scene({"joint1.angle": "20 deg"}, {"type": "constant", "torque": 10.0}), None,
     "the engine drives more than the load takes at every speed from 100 rad/s on (10 N.m there)"),
    (scene({"joint1.angle": "20 deg"}, {"type": "speed", "speed": 0.0}), None, "the prescribed input speed is 0"),
])
def test_no_steady_state(made: Scenario, speed: float | None, words: str) -> None:
    with pytest.raises(NoSteadyState) as error:
        operating_point(Plant(made), speed)
    assert words in str(error.value)


def test_unstable_points_say_so() -> None:
    point = operating_point(Plant(single(30.0, damping=2.0)), 100.0 * math.pi)
    assert not point.stable
    assert "is unstable: perturbations grow with 13.7" in point.warning
    assert operating_point(Plant(single(30.0, damping=40.0)), 100.0 * math.pi).warning == ""


def test_bad_input() -> None:
    with pytest.raises(InputError, match="must be a speed above 0"):
        operating_point(Plant(single(20.0)), -1.0)
    with pytest.raises(InputError, match=r"joint1\.angle\.der1 = 0\.1: a moving joint angle has no periodic motion"):
        Plant(single(20.0, **{"joint1.angle.der1": 0.1}))


def test_ripple_of_half_orders_needs_two_turns() -> None:
    engine = {"type": "four_stroke", "torque": 50.0, "cylinders": 3, "orders": [1.5], "amplitudes": [30.0]}
    plant = Plant(scene({"joint1.angle": "5 deg"}, engine, QUADRATIC))
    assert plant.period_angle == pytest.approx(4.0 * math.pi)
    whole = Plant(scene({"joint1.angle": "5 deg"}, {**engine, "orders": [2.0]}, QUADRATIC))
    assert whole.period_angle == pytest.approx(math.pi)
