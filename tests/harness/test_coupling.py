"""Coupling schemes and the master: order, energy at the interface, jumps, moving angles, rollback.

Exact cases (rigid straight shaft of J = 0.5 kg.m2, see `shaft_scene`):

- constant torque T against a quadratic load c w^2: w = w1 tanh(t/tau), w1 = sqrt(T/c), tau = J/sqrt(T c);
- constant torque against a linear load c w: w = T/c (1 - exp(-c t/J));
- a torque step at time s: w = T (t - s)/J.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
import pytest
from cardan import Instance, Scenario, simulate
from cardan.coupling import SCHEMES, Master, scheme
from cardan.coupling.motion import held, interpolated
from cardan.errors import FmuError, InputError
from cardan.models.base import Shaft
from cardan.models.surroundings import Surroundings

Make = Callable[..., Scenario]
INERTIA = 0.5
QUADRATIC = {"type": "quadratic", "coefficient": 0.01}


def tanh_speed(t: float) -> float:
    return math.sqrt(100.0 / 0.01) * math.tanh(t * math.sqrt(100.0 * 0.01) / INERTIA)


@pytest.mark.parametrize("name", ["held", "gauss-seidel", "slope"])
def test_order_in_the_step(name: str, shaft_scene: Make, fmu: Path) -> None:
    """Slope of log error over log step, smooth case."""
    steps = [0.05, 0.025, 0.0125]
    errors = []
    for step in steps:
        result = simulate(shaft_scene(name, step, 0.5, load=QUADRATIC), fmu=fmu)
        errors.append(abs(result["output.speed"][-1] - tanh_speed(0.5)))
    fitted = np.polyfit(np.log(steps), np.log(errors), 1)[0]
    assert fitted == pytest.approx(SCHEMES[name].order, abs=0.15)


def test_slope_is_exact_for_a_torque_linear_in_speed(shaft_scene: Make, fmu: Path) -> None:
    """The derivative by speed is inside the FMU's integration: no coupling error at any step."""
    scenario = shaft_scene("slope", 0.1, load={"type": "linear", "coefficient": 2.0})
    result = simulate(scenario, fmu=fmu)
    exact = 50.0 * (1.0 - np.exp(-2.0 * result.time / INERTIA))
    np.testing.assert_allclose(result["output.speed"], exact, rtol=1e-10, atol=1e-10)
    assert abs(result.info.energy_residual) < 1e-7


def test_models_with_states_follow_the_shaft(shaft_scene: Make, fmu: Path) -> None:
    """The dynamometer's integral of the speed error: Gauss-Seidel sees the motion of the step, held does not."""
    load = {"type": "dyno", "speed": 20.0, "gain": 1.0, "integral_gain": 10.0, "torque_limit": 1e3}
    outputs = ("output.speed", "output.torque")

    def final(name: str, step: float) -> float:
        return float(simulate(shaft_scene(name, step, 0.5, load=load, outputs=outputs), fmu=fmu)["output.speed"][-1])

    exact = final("slope", 5e-4)
    # held motion loses half a step of acceleration in the integral; with slopes the order shows it
    errors = [abs(final("slope", step) - exact) for step in (0.04, 0.02, 0.01)]
    assert errors[0] / errors[1] == pytest.approx(4.0, rel=0.25)
    assert errors[1] / errors[2] == pytest.approx(4.0, rel=0.25)
    assert abs(final("held", 0.01) - exact) > 3.0 * errors[2]


@pytest.mark.parametrize("name", ["held", "gauss-seidel", "slope"])
def test_energy_residual_closes_the_balance(name: str, shaft_scene: Make, fmu: Path) -> None:
    """supplied - taken - kinetic energy gained = residual, up to the trapezoidal rule's O(h^2)."""
    result = simulate(shaft_scene(name, 1e-3, 0.5, load=QUADRATIC), fmu=fmu)
    info = result.info
    gained = 0.5 * INERTIA * result["output.speed"][-1] ** 2
    missing = info.energy_supplied - info.energy_taken - gained
    rule = 1e-3**2 / 12.0 * 2e6  # h^2/12 times the change of d(power)/dt over the run
    assert missing == pytest.approx(info.energy_residual, abs=rule)
    if name != "slope":
        assert abs(info.energy_residual) > 3.0 * rule  # so the line above says something
    else:
        assert abs(info.energy_residual) < 1e-2


@pytest.mark.parametrize(("name", "order"), [("held", 1.0), ("slope", 2.0)])
def test_energy_residual_shrinks_with_the_order(name: str, order: float, shaft_scene: Make, fmu: Path) -> None:
    residuals = [abs(simulate(shaft_scene(name, step, 0.5, load=QUADRATIC), fmu=fmu).info.energy_residual)
                 for step in (0.02, 0.01)]
    assert math.log2(residuals[0] / residuals[1]) == pytest.approx(order, abs=0.2)


@pytest.mark.parametrize("time", [0.3, 0.35, 0.6])
def test_a_known_jump_is_hit_exactly(time: float, shaft_scene: Make, fmu: Path) -> None:
    """0.35 lies inside a communication interval; 3 * 0.1 is a little above 0.3."""
    engine = {"type": "step", "after": 100.0, "time": time}
    result = simulate(shaft_scene("slope", 0.1, engine=engine), fmu=fmu)
    np.testing.assert_allclose(result["output.speed"], 200.0 * np.maximum(0.0, result.time - time), atol=1e-11)
    assert abs(result.info.energy_residual) < 1e-9


def test_a_jump_at_a_communication_point_is_not_missed_by_rounding(shaft_scene: Make, fmu: Path) -> None:
    """The product i h falls just below the decimal fraction: the held torque must be the one after the jump."""
    step = 0.009
    time = next(i * 9 / 1000 for i in range(1, 100) if i * step < i * 9 / 1000)
    engine = {"type": "step", "after": 100.0, "time": time}
    result = simulate(shaft_scene("held", step, time + 0.1, engine=engine), fmu=fmu)
    np.testing.assert_allclose(result["output.speed"], 200.0 * np.maximum(0.0, result.time - time), atol=1e-11)
    assert abs(result.info.energy_residual) < 1e-9


def test_steep_loads_need_the_slope(shaft_scene: Make, fmu: Path) -> None:
    """A load of slope K is unstable under a held torque where K h/J > 2; with its derivative it is not."""
    load = {"type": "linear", "coefficient": 200.0}  # K h/J = 4: the error triples per step
    held_speed = simulate(shaft_scene("held", 0.01, 0.12, load=load), fmu=fmu)["output.speed"]
    slope_speed = simulate(shaft_scene("slope", 0.01, 0.12, load=load), fmu=fmu)["output.speed"]
    assert np.abs(held_speed).max() > 1e3
    np.testing.assert_allclose(slope_speed[6:], 0.5, rtol=1e-9)


def test_joint_angles_move_as_the_scene_says(shaft_scene: Make, fmu: Path) -> None:
    polynomial = {"joint1.angle": 0.1, "joint1.angle.der1": 0.3, "joint1.angle.der2": -0.2}
    outputs = ("joint1.angle", "joint1.angle.der1", "joint1.angle.der2", "output.speed", "ratio")
    result = simulate(shaft_scene("held", 0.05, outputs=outputs, **polynomial), fmu=fmu)
    np.testing.assert_allclose(result["joint1.angle"], 0.1 + 0.3 * result.time - 0.1 * result.time**2, rtol=1e-14)
    np.testing.assert_allclose(result["joint1.angle.der1"], 0.3 - 0.2 * result.time, atol=1e-15)
    assert np.all(result["joint1.angle.der2"] == -0.2)
    coarse = simulate(shaft_scene("held", 0.5, outputs=outputs, **polynomial), fmu=fmu)
    assert result["output.speed"][-1] == pytest.approx(coarse["output.speed"][-1], rel=1e-9)


def test_prescribed_speed_is_followed_and_its_work_counted(shaft_scene: Make, fmu: Path) -> None:
    """w = 10 + 40 t from 0.2 s on (a corner inside a step): the drive supplies the kinetic energy gained."""
    engine = {"type": "speed", "speed": 10.0, "final_speed": 42.0, "ramp_start": 0.2, "ramp_time": 0.8}
    outputs = ("input.speed", "input.reaction_torque", "input.speed_command")
    result = simulate(shaft_scene("slope", 0.03, 0.99, engine=engine, outputs=outputs), fmu=fmu)
    wanted = 10.0 + 40.0 * np.maximum(0.0, result.time - 0.2)
    np.testing.assert_allclose(result["input.speed"], wanted, rtol=1e-12)
    np.testing.assert_allclose(result["input.speed_command"], wanted, rtol=1e-12)
    assert result["input.reaction_torque"][-1] == pytest.approx(0.5 * 40.0, rel=1e-12)
    gained = 0.5 * INERTIA * (wanted[-1] ** 2 - 100.0)
    assert result.info.energy_supplied == pytest.approx(gained, rel=0.02)  # power jumps at the corner: O(h)


def test_unknown_schemes_are_told_with_the_choices() -> None:
    with pytest.raises(InputError, match=r"'jacoby'.*choose one of .*gauss-seidel"):
        scheme("jacoby")


@pytest.fixture
def master(shaft_scene: Make, fmu: Path) -> Iterator[Master]:
    load = {"type": "dyno", "speed": 20.0, "gain": 1.0, "integral_gain": 10.0, "torque_limit": 1e3}
    scenario = shaft_scene("slope", 0.01, load=load, **{"model.fidelity": 2, "joint1.angle": 0.3})
    with Instance(fmu) as instance:
        yield Master(instance, Surroundings(scenario), scheme("slope"), 0.01, scenario.driveline, ["shaft.torque"])


def test_a_restored_point_repeats_bit_for_bit(master: Master) -> None:
    def run() -> list[object]:
        for i in range(3, 8):
            master.scheme.advance(master, i * 0.01, (i + 1) * 0.01)
        energy = master.energy
        return [*master.outputs.values, *master.inputs.values, *master.surroundings.x, master.shaft_out,
                energy.residual, energy.supplied, energy.taken]

    master.begin(0.0, 1.0, 1e-9)
    for i in range(3):
        master.scheme.advance(master, i * 0.01, (i + 1) * 0.01)
    point = master.save()
    there = [*master.outputs.values, *master.inputs.values]
    first = run()
    master.restore(point)
    assert [*master.outputs.values, *master.inputs.values] == there
    again = run()
    master.forget(point)
    assert first == again


def test_a_contradicting_drive_is_refused(shaft_scene: Make, fmu: Path) -> None:
    scenario = shaft_scene()
    with Instance(fmu) as instance, pytest.raises(InputError, match=r"model\.drive = 1 contradicts"):
        Master(instance, Surroundings(scenario), scheme("held"), 0.01, {"model.drive": 1})


def test_an_fmu_of_another_interface_is_told_what_it_lacks(shaft_scene: Make, foreign_fmu: Path) -> None:
    with pytest.raises(InputError, match=r"Foreign\.fmu has no variable 'output.speed'"):
        simulate(shaft_scene(), fmu=foreign_fmu)


def test_rollback_needs_an_fmu_with_states(shaft_scene: Make, foreign_fmu: Path,
                                           monkeypatch: pytest.MonkeyPatch) -> None:
    method = scheme("held")
    monkeypatch.setattr(type(method), "rolls_back", True)
    with Instance(foreign_fmu) as instance, pytest.raises(FmuError, match="saves and restores its state"):
        Master(instance, Surroundings(shaft_scene()), method, 0.01)


def test_interpolated_motion_is_exact_for_cubics() -> None:
    """Angle a(s) = s^3 - 2 s^2 + 3 s + 4: speed and acceleration are its derivatives."""

    def shaft(s: float) -> Shaft:
        return Shaft(s**3 - 2.0 * s**2 + 3.0 * s + 4.0, 3.0 * s**2 - 4.0 * s + 3.0, 6.0 * s - 4.0)

    motion = interpolated(shaft(0.0), shaft(0.7), 0.7)
    for s in (0.0, 0.1, 0.35, 0.7):
        np.testing.assert_allclose(motion(s), shaft(s), rtol=1e-13, atol=1e-13)


def test_held_motion_keeps_the_speed() -> None:
    assert held(Shaft(1.0, 2.0, 5.0))(0.25) == Shaft(1.5, 2.0, 5.0)
