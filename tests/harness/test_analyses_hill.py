"""The harmonic lift: accuracy by harmonics, poles, python-control objects, and the time-invariant stand-ins."""

from __future__ import annotations

import math
import re
import time
from typing import Any

import control
import numpy as np
import pytest
from cardan.analyses.hill import lift
from cardan.analyses.linearize import linearize, periodic_system
from cardan.errors import CardanError

from tests.harness.analysis_scenes import NATURAL, scene, single

AWAY = "1,5,10,20,30,40,45,48,52,55,70,90,110,130,180"  # Hz, off the multiples of 50 Hz


@pytest.fixture(scope="module")
def lifts() -> dict[float, Any]:
    """Linearizations of the 50 Hz driveline at 3000 rpm by joint angle (deg)."""
    return {angle: linearize(single(angle, damping), output="output.speed,shaft.torque,input.speed", speed="3000 rpm",
                             frequencies=AWAY) for angle, damping in ((15.0, 4.0), (30.0, 20.0))}


@pytest.mark.parametrize(("angle", "limit"), [(15.0, 1e-6), (30.0, 5e-3)])
def test_three_harmonics(lifts: dict[float, Any], angle: float, limit: float) -> None:
    # docs/PHYSICS.md section 7 states 1e-6 at 15 deg and 5e-3 at 30 deg at resonance
    made = lifts[angle]
    coarse = linearize(made.point.motion.plant.scenario, output="output.speed,shaft.torque,input.speed",
                       speed="3000 rpm", frequencies=AWAY, harmonics=3)
    difference = np.abs(coarse.response.values[:, 3] / made.response.values[:, 3] - 1.0)
    assert difference.max() < limit
    assert coarse.harmonics == 3


def test_truncation_error_is_the_one_stated(lifts: dict[float, Any]) -> None:
    for made in lifts.values():
        assert made.truncation < 1e-8
        system, _ = periodic_system(made.point, 0, made.outputs)
        omega = 2.0 * math.pi * made.response.frequencies
        much = lift(system, made.harmonics + 8).response(omega)[:, made.harmonics + 8, :, 0]
        assert np.abs(made.response.values[:, 3] / much - 1.0).max() < 1e-9


def test_poles_are_the_floquet_exponents(lifts: dict[float, Any]) -> None:
    for made in lifts.values():
        assert len(made.poles) == 4
        for exponent in made.point.floquet.exponents:
            apart = made.poles - exponent
            apart -= 1j * made.point.motion.fundamental * np.round(apart.imag / made.point.motion.fundamental)
            assert np.abs(apart).min() < 1e-8


def test_lift_solves_the_periodic_equations(lifts: dict[float, Any]) -> None:
    # the sum of the lines is a solution: x' = A(t) x + B(t) u at every point of the period
    made = lifts[30.0]
    system, _ = periodic_system(made.point, 0, made.outputs)
    h, s = 12, 2j * math.pi * 37.0
    big = lift(system, h)
    states = np.linalg.solve(s * np.eye(len(big.a)) - big.a, big.b[:, 0]).reshape(2 * h + 1, -1)
    t, k = made.point.motion.times, np.arange(-h, h + 1)
    waves = np.exp(1j * np.outer(t, k) * system.fundamental)
    x = waves @ states
    rate = waves @ ((s + 1j * k * system.fundamental)[:, None] * states)
    left = rate - np.einsum("tij,tj->ti", system.a, x) - system.b[:, :, 0]
    size = np.einsum("tij,tj->ti", np.abs(system.a), np.abs(x)) + np.abs(system.b[:, :, 0])
    assert (np.abs(left) / size).max() < 1e-10  # rounding of the solution and harmonics left out


def test_state_space_is_the_response_in_real_coordinates(lifts: dict[float, Any]) -> None:
    made = lifts[30.0]
    system = made.system
    assert isinstance(system, control.StateSpace)
    assert system.input_labels == ["input_torque"]
    assert system.output_labels[:5] == ["output_speed", "shaft_torque", "input_speed", "output_speed_cos1",
                                        "shaft_torque_cos1"]
    assert system.state_labels[:4] == ["input_angle", "shaft_twist", "input_speed", "shaft_speed_b"]
    assert system.units["input_torque"] == "N.m"
    assert system.units["output_speed_sin2"] == "rad/s"
    assert system.units["shaft_twist_cos1"] == "rad"
    for i in (0, 7, 12):
        values = np.asarray(system(2j * math.pi * made.response.frequencies[i])).reshape(-1)
        mean, cos1, sin1 = values[:3], values[3:6], values[6:9]
        lines = made.response.values[i]
        assert mean == pytest.approx(lines[3], rel=1e-9)
        assert (cos1 - 1j * sin1) / 2.0 == pytest.approx(lines[4], rel=1e-7)
        assert (cos1 + 1j * sin1) / 2.0 == pytest.approx(lines[2], rel=1e-7)


def test_frequency_response_data_has_names_and_leaves_flagged_lines_out() -> None:
    made = linearize(single(15.0), speed="3000 rpm", frequencies="10,50,60,100,150")
    assert made.response.flagged.tolist() == [False, True, False, True, True]
    data = made.response.frd()
    assert isinstance(data, control.FrequencyResponseData)
    assert data.omega == pytest.approx(2.0 * math.pi * np.array([10.0, 60.0]))
    assert (data.input_labels, data.output_labels) == (["input_torque"], ["output_speed"])
    assert data.units == {"input_torque": "N.m", "output_speed": "rad/s"}


def test_straight_joints_give_the_plain_two_inertia_system() -> None:
    made = linearize(single(0.0, 4.0), output="output.speed,shaft.twist", speed="3000 rpm", frequencies=AWAY)
    k, d, j1, j2, b = single(0.0).driveline["shaft.stiffness"], 4.0, 0.2044, 1.5044, 0.5
    s = 2j * math.pi * made.response.frequencies
    # J1 w1' = T - (k x + d (w1 - w2)), J2 w2' = k x + d (w1 - w2) - b w2, x' = w1 - w2
    z = k / s + d
    w2 = z / ((j1 * s + z) * (j2 * s + b + z) - z * z)
    assert made.response.line("output.speed") == pytest.approx(w2, rel=1e-11)
    assert made.response.line("shaft.twist") == pytest.approx(w2 * (j2 * s + b) / z / s, rel=1e-11)
    ignored = linearize(single(25.0, 4.0), output="output.speed,shaft.twist", speed="3000 rpm", frequencies=AWAY,
                        method="ignored")
    assert ignored.response.line("output.speed") == pytest.approx(w2, rel=1e-11)


def test_averaged_law_of_the_rigid_driveline() -> None:
    made = scene({"model.fidelity": 1, "joint1.angle": "30 deg"}, load={"type": "linear", "coefficient": 0.5})
    options: dict[str, Any] = {"output": "output.speed,input.speed", "speed": "3000 rpm", "frequencies": "1,2,4"}
    exact, mean = linearize(made, **options), linearize(made, method="averaged", **options)
    difference = np.abs(mean.response.values[:, 0] / exact.response.values[:, exact.response.harmonics.index(0)] - 1.0)
    assert difference[0].max() < 1e-5
    # it is the limit of low frequency, and of second order in it
    assert difference[2].max() / difference[1].max() == pytest.approx(4.0, abs=1.5)
    ignored = linearize(made, method="ignored", **options)
    assert np.abs(ignored.response.values[0, 0] / exact.response.values[0, 3] - 1.0).max() > 50.0 * difference[0].max()
    assert mean.system.state_labels == ["input_speed"]


def test_averaged_law_also_of_a_load_torque_and_a_quadratic_load() -> None:
    made = scene({"model.fidelity": 1, "joint1.angle": "30 deg", "joint2.angle": "10 deg"},
                 load={"type": "quadratic", "coefficient": 1e-3})
    for source in ("input.torque", "output.torque"):
        options: dict[str, Any] = {"input": source, "speed": "3000 rpm", "frequencies": "0.2"}
        exact, mean = linearize(made, **options), linearize(made, method="averaged", **options)
        assert mean.response.line("output.speed") == pytest.approx(exact.response.line("output.speed"), rel=2e-4)


def test_frozen_model_warns_how_wrong_it_is() -> None:
    made = linearize(single(30.0, 20.0), speed="3000 rpm", frequencies="1:45:12", method="frozen")
    assert "no stiffness against its angle" in made.warnings[-1]
    factor = re.search(r"up to (\S+) times too (small|large) \(output\.speed at 1 Hz\)", made.warnings[-1])
    assert factor is not None
    assert float(factor[1]) > 5.0
    system = made.system
    assert system.A[0].tolist() == [0.0, 0.0, 1.0, 0.0]
    assert made.harmonics == 0
    assert made.response.harmonics == (0,)


def test_prescribed_speed_has_its_acceleration_as_input() -> None:
    made = scene({"joint1.angle": "20 deg", "shaft.damping": 5.0}, {"type": "speed", "speed": "1500 rpm"},
                 {"type": "linear", "coefficient": 0.3})
    found = linearize(made, "input.acceleration", "input.speed,input.angle", frequencies="7,20")
    s = 2j * math.pi * np.array([7.0, 20.0])
    assert found.response.line("input.speed") == pytest.approx(1.0 / s, rel=1e-12)
    assert found.response.line("input.angle") == pytest.approx(1.0 / s**2, rel=1e-12)


def test_cost_of_a_response(lifts: dict[float, Any]) -> None:
    # the issue asks for 400 frequencies at three harmonics below 50 ms; the best of three, on a shared machine
    system, _ = periodic_system(lifts[30.0].point, 0, ("output.speed", "shaft.torque"))
    omega = 2.0 * math.pi * np.linspace(1.0, 199.0, 400)
    best = math.inf
    for _ in range(3):
        start = time.perf_counter()
        lift(system, 3).response(omega)
        best = min(best, time.perf_counter() - start)
    assert best < 0.05


@pytest.mark.parametrize(("options", "words"), [
    ({"input": "engine.torque"}, "--input engine.torque: unknown signal (nearest: input.torque)"),
    ({"input": "input.acceleration"}, "only where the engine prescribes the speed"),
    ({"output": "output.sped,bla"}, "--output output.sped: unknown signal (nearest: output.speed)"),
    ({"frequencies": "0,5"}, "--frequencies: 0 Hz is no frequency of a sine"),
    ({"frequencies": "-5"}, "--frequencies: -5 Hz is no frequency of a sine"),
    ({"frequencies": "1:2"}, "must be START:STOP:COUNT or numbers with commas"),
    ({"method": "guess"}, "--method guess: unknown; choose one of hill, averaged"),
    ({"method": "averaged"}, "the shaft is compliant"),
    ({"speed": "3000 kg"}, "--speed: '3000 kg'"),
    ({"harmonics": 100}, "--harmonics 100: must be from 0 to 60"),
])
def test_bad_input(options: dict[str, Any], words: str) -> None:
    with pytest.raises(CardanError) as error:
        linearize(single(15.0), **{"speed": NATURAL, "frequencies": "10", **options})
    assert words in str(error.value)
