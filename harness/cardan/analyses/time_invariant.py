"""Time-invariant stand-ins for the periodic linearization, each right in its own limit (docs/PHYSICS.md section 7)."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from cardan.analyses.operating_point import OperatingPoint, operating_point
from cardan.analyses.plant import W1, Plant
from cardan.analyses.signals import check_outputs, control_name, output_units
from cardan.analyses.trigonometric import differentiation, interpolate
from cardan.errors import InputError

Array = NDArray[np.float64]

AVERAGED_OUTPUTS = ("input.angle", "input.speed", "output.angle", "output.speed")


def state_space(matrices: tuple[Array, Array, Array, Array], inputs: tuple[str, ...], outputs: tuple[str, ...],
                states: tuple[str, ...], name: str, units: dict[str, str]) -> Any:
    """Return a python-control StateSpace with names; units by those names as its attribute ``units``."""
    import control

    made = control.ss(*matrices, inputs=[control_name(n) for n in inputs], outputs=[control_name(n) for n in outputs],
                      states=[control_name(n) for n in states], name=name)
    made.units = {control_name(n): u for n, u in units.items()}
    return made


def ignored(scenario: Any, point: OperatingPoint, place: int, outputs: tuple[str, ...]) -> tuple[Array, ...]:
    """Return A, B, C, D with both joints straight, at the same speed.

    Parameters
    ----------
    scenario : Scenario
    point : OperatingPoint
        Of the driveline as it is.
    place : int
        Number of the input.
    outputs : tuple of str
        Names of outputs.
    """
    plant = Plant(scenario, {**point.motion.plant.values, "joint1.angle": 0.0, "joint2.angle": 0.0})
    straight = operating_point(plant, point.speed)
    rows = _rows(outputs)
    f = straight.motion.fields
    return (f.a.mean(axis=0), f.b.mean(axis=0)[:, [place]], f.c.mean(axis=0)[rows],
            f.d.mean(axis=0)[np.ix_(rows, [place])])


def frozen(point: OperatingPoint, angle: float, place: int, outputs: tuple[str, ...]) -> tuple[Array, ...]:
    """Return A, B, C, D as they are when the input shaft passes an angle.

    Parameters
    ----------
    angle : float
        Input shaft angle, rad.
    """
    motion = point.motion
    plant = motion.plant
    states, own = _at_angle(point, angle)
    f = plant.fields(states[None, :], own[None, :], motion.added)
    rows = _rows(outputs)
    return f.a[0], f.b[0][:, [place]], f.c[0][rows], f.d[0][np.ix_(rows, [place])]


def averaged(point: OperatingPoint, place: int, outputs: tuple[str, ...]) -> tuple[tuple[Array, ...], tuple[str, ...]]:
    """Return A, B, C, D of the averaged rigid driveline, and the names of its states.

    M(p) w' + M'/2 w^2 + b w = T has the slow variable v = sqrt(M) w, and averaging over the time of a turn gives
    ``J_eff w' + b_eff w = T`` for the mean speed, J_eff = <sqrt M>^2, b_eff = <sqrt M><b / sqrt M>; a torque that acts
    through the ratio g(p) counts with <g>.

    Raises
    ------
    InputError
        If the driveline is not rigid or driven by torque, or an output has no averaged law.
    """
    plant = point.motion.plant
    if not plant.rigid or plant.driven or plant.own:
        reason = ("engine or load have states of their own" if plant.own else "the input speed is prescribed"
                  if plant.driven else "the shaft is compliant")
        raise InputError(f"--method averaged: the closed form holds for the rigid driveline under torques ({reason}); "
                         "set driveline.model.fidelity = \"rigid\", or use --method hill")
    wrong = [name for name in outputs if name not in AVERAGED_OUTPUTS]
    if wrong:
        raise InputError([f"--output {name}: has no averaged law; allowed with --method averaged: "
                          f"{', '.join(AVERAGED_OUTPUTS)}" for name in wrong])
    inertia, drag, reach = _rigid_laws(plant, point)
    root = np.sqrt(inertia)
    j = root.mean() ** 2
    b = root.mean() * (drag / root).mean()
    gain = reach[:, place].mean()
    angles = any(name.endswith("angle") for name in outputs)
    a = np.array([[0.0, 1.0], [0.0, -b / j]]) if angles else np.array([[-b / j]])
    entry = np.array([[0.0], [gain / j]]) if angles else np.array([[gain / j]])
    c = np.array([[float(name.endswith("angle")), float(name.endswith("speed"))] for name in outputs])
    states = ("input.angle", "input.speed")
    return ((a, entry, c if angles else c[:, 1:], np.zeros((len(outputs), 1))), states if angles else states[1:])


def _rigid_laws(plant: Plant, point: OperatingPoint) -> tuple[Array, Array, Array]:
    """Return M, b (of the closed loop) and the torques' ratios over one period of the angle."""
    count = 513
    states = np.zeros((count, 4))
    states[:, 0] = plant.period_angle * np.arange(count) / count
    states[:, W1] = 1.0
    own = np.zeros((count, 0))
    inertia = 1.0 / plant.fields(states, own).b[:, 1, 0]
    root = np.sqrt(inertia)
    # the speed over the angle where v = sqrt(M) w is constant
    states[:, W1] = point.speed * root.mean() / root
    fields = plant.fields(states, own)
    spectrum = np.fft.rfft(inertia)
    slope = np.fft.irfft(2j * math.pi / plant.period_angle * np.arange(len(spectrum)) * spectrum, count)
    drag = -inertia * fields.a[:, 1, 1] - slope * states[:, W1]
    return inertia, drag, inertia[:, None] * fields.b[:, 1]


def _at_angle(point: OperatingPoint, angle: float) -> tuple[Array, Array]:
    """Return the states of a motion when the input shaft passes an angle, by trigonometric interpolation."""
    motion = point.motion
    plant, count = motion.plant, len(motion.states)
    turn = plant.period_angle
    values = np.concatenate([motion.states, motion.own], axis=1)
    values[:, 0] -= turn * np.arange(count) / count
    slopes = differentiation(count) @ values[:, 0] * 2.0 * math.pi
    target = angle % turn
    share = target / turn
    for _ in range(50):
        there = interpolate(values, np.array([share]))[0]
        rate = turn + float(interpolate(slopes, np.array([share]))[0])
        miss = float(there[0]) + turn * share - target
        share -= miss / rate
        if abs(miss) < 1e-14 * turn:
            break
    there[0] = target
    return there[:4], there[4:]


def _rows(outputs: tuple[str, ...]) -> list[int]:
    known = list(output_units())
    return [known.index(name) for name in check_outputs(outputs)]
