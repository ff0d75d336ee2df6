"""Figures of the shipped scenes against the literature as docs/PHYSICS.md corrects it, and against common sense."""

from __future__ import annotations

import math

import numpy as np
import pytest
from cardan import Result, Scenario, simulate

from tests import systems


def run(name: str, **changes: object) -> Result:
    result = simulate(Scenario.load(name).with_overrides({key.replace("__", "."): value
                                                          for key, value in changes.items()}))
    assert result.info.completed
    assert result.info.note == ""
    return result


@pytest.mark.parametrize(("degrees", "acceleration"), [(10, 3019.6), (20, 12321.1), (30, 29043.5)])
def test_fligiel(degrees: int, acceleration: float) -> None:
    """Speed range, acceleration extremes, inertia torque and impulse at 314 rad/s (PHYSICS.md 5)."""
    result = run("fligiel", driveline__joint1__angle=f"{degrees} deg")
    c = math.cos(math.radians(degrees))
    assert result["output.speed"].max() == pytest.approx(314 / c, rel=1e-5)
    assert result["output.speed"].min() == pytest.approx(314 * c, rel=1e-5)
    assert result["output.acceleration"].max() == pytest.approx(acceleration, rel=1e-4)
    assert result["output.acceleration"].min() == pytest.approx(-acceleration, rel=1e-4)
    exact = systems.fligiel(math.radians(degrees), 314.0, 0.008794)
    assert result["inertia_torque"].max() == pytest.approx(0.008794 * acceleration, rel=1e-4)
    impulse = 0.008794 * (result["output.speed"].max() - result["output.speed"].min())
    assert impulse == pytest.approx(0.008794 * 314 * (1 / c - c), rel=1e-4)
    assert float(exact.acceleration) == pytest.approx(acceleration, rel=2e-6)


@pytest.mark.parametrize(("psi", "theta", "uniform"), [
    (0, 0, True), (0, 180, True), (40, 40, True), (-30, 150, True), (90, 0, False), (0, 90, False), (30, -30, False)])
def test_brezetic(psi: int, theta: int, uniform: bool) -> None:
    """Pairs at 15 deg over one turn: homokinetic where psi - theta = 0 (mod 180 deg), else within 1/kappa .. kappa."""
    result = run("brezetic", driveline__shaft__yoke_phase=f"{psi} deg", driveline__shaft__plane_twist=f"{theta} deg")
    ratio = result["ratio"]
    c2 = math.cos(math.radians(15)) ** 2
    delta = math.radians(psi - theta)
    sum_of_both = (2 * c2 * math.cos(delta) ** 2 + (1 + c2 * c2) * math.sin(delta) ** 2) / c2
    kappa = (sum_of_both + math.sqrt(max(0.0, sum_of_both**2 - 4))) / 2
    assert result["input.angle"][-1] == pytest.approx(2 * math.pi, rel=1e-12)
    if uniform:
        assert np.abs(ratio - 1).max() < 1e-13
        assert result["layout.nonuniformity"].max() < 1e-15
    else:
        assert ratio.max() == pytest.approx(kappa, rel=1e-4)
        assert ratio.min() == pytest.approx(1 / kappa, rel=1e-4)
        assert result["layout.nonuniformity"][0] == pytest.approx(kappa - 1 / kappa, rel=1e-12)
        assert result["layout.equivalent_angle"][0] == pytest.approx(math.acos(1 / kappa), rel=1e-12)


def test_engine_start_passes_the_resonance() -> None:
    """The second order meets w_n = sqrt(k (1/J1 + 1/J3)) at half its speed: the twist is largest near there."""
    result = run("engine_start")
    natural = math.sqrt(2500.0 * (1 / 0.2544 + 1 / 1.0044))
    speed = np.convolve(result["input.speed"], np.ones(41) / 41, mode="same")
    twist = result["shaft.twist"] - np.convolve(result["shaft.twist"], np.ones(401) / 401, mode="same")
    late = result.time > 0.3
    at_peak = speed[late][np.argmax(np.abs(twist[late]))]
    assert at_peak == pytest.approx(natural / 2, rel=0.25)
    assert result["input.speed"][-1] > 1.3 * natural / 2
    assert np.abs(twist[late]).max() > 3 * np.abs(twist[-400:-200]).max()


def test_propshaft_reaches_its_speed() -> None:
    result = run("propshaft_highspeed", scene__communication_step="1 ms")
    assert result["input.speed"].max() == pytest.approx(20000 * math.pi / 30, rel=1e-6)
    assert abs(result["energy.residual"][-1]) < 1e-6 * 20000


def test_pickup_follows_the_schedule() -> None:
    """200 s of the UDDS: speed error, all the gears of a town, standstill without creep, no stalling."""
    result = run("pickup_udds")
    error = result["vehicle.speed"] - result["driver.target_speed"]
    assert math.sqrt(float(np.mean(error**2))) < 0.3
    assert np.abs(error).max() < 1.0
    assert {1, 2, 3} <= set(np.round(result["gearbox.gear"]).astype(int))
    assert result["engine.speed"].min() > 60.0
    still = (result.time > 130) & (result.time < 160)
    assert np.abs(result["vehicle.speed"][still]).max() < 1e-3
    assert abs(result["energy.residual"][-1]) < 1e-3
