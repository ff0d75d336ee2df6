"""Linearization of a scene about its periodic steady state, by any of the methods."""

from __future__ import annotations

import math
import os
from collections.abc import Callable, Iterable
from contextlib import ExitStack
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from cardan.analyses.hill import Lift, Periodic, lift, lift_to_tolerance
from cardan.analyses.linearization import Linearization
from cardan.analyses.operating_point import OperatingPoint, operating_point
from cardan.analyses.plant import KERNEL_STATES, STATE_UNITS, TWIST, W1, WY, P, Plant
from cardan.analyses.ranges import read_range
from cardan.analyses.response import Response, check_frequencies, flagged
from cardan.analyses.signals import check_input, check_outputs, control_name, input_units, output_units
from cardan.analyses.time_invariant import averaged, frozen, ignored, state_space
from cardan.errors import InputError
from cardan.units import UnitError, to_si

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
Progress = Callable[[float], None]

METHODS = ("hill", "averaged", "ignored", "frozen", "fmu")
TOLERANCE = 1e-8
SIDEBANDS = 3
PROBES = 12


def linearize(scenario: Any, input: str = "input.torque", output: str | Iterable[str] = ("output.speed",), *,
              method: str = "hill", speed: float | str | None = None, frequencies: Any = "1:200:400",
              harmonics: int | None = None, tolerance: float = TOLERANCE, angle: float | str = 0.0,
              sidebands: int = SIDEBANDS, measure: bool | Iterable[float] | str = False,
              fmu: str | os.PathLike[str] | None = None, progress: Progress | None = None) -> Linearization:
    """Linearize a scene about its periodic steady state.

    Parameters
    ----------
    scenario : Scenario
        The scene; joint angles, engine and load as they stand in it, without its driver.
    input : str
        ``input.torque``, ``output.torque``, or ``input.acceleration`` where the engine prescribes the speed.
    output : str or iterable of str
        Outputs, such as ``"output.speed,shaft.torque"``.
    method : str
        ``hill`` (harmonic lift, exact), ``averaged`` (closed form, rigid driveline), ``ignored`` (joints straight),
        ``frozen`` (at one angle), ``fmu`` (harmonic lift of an FMU through FMI alone).
    speed : float or str, optional
        Mean input speed, rad/s; the torque that holds it is found. None takes the balance of the scene.
    frequencies : str or array
        Hz; ``"1:200:400"`` or ``"10,20,50"``.
    harmonics : int, optional
        Of the lift; None takes as many as `tolerance` asks for.
    tolerance : float
        Largest relative change of G_0 that more harmonics may make.
    angle : float or str
        Input shaft angle for ``frozen``, rad.
    sidebands : int
        Lines -k .. k in the response.
    measure : bool or frequencies
        Measure the FMU with small sines at up to 12 of the frequencies, or at those given.
    fmu : path-like, optional
        FMU for ``fmu`` and `measure`; the driveline of this installation by default.
    progress : callable, optional
        Called with the fraction of a measurement done.

    Returns
    -------
    Linearization

    Raises
    ------
    InputError
        For unknown signals, methods, frequencies.
    NoSteadyState
        If there is nothing to linearize about.
    """
    if method not in METHODS:
        raise InputError(f"--method {method}: unknown; choose one of {', '.join(METHODS)}")
    outputs = check_outputs(output.replace(" ", "").split(",") if isinstance(output, str) else output)
    asked = check_frequencies(read_range(frequencies, "Hz", "--frequencies"))
    if harmonics is not None and not 0 <= harmonics <= 60:
        raise InputError(f"--harmonics {harmonics}: must be from 0 to 60")
    wanted = None if speed is None else _quantity(speed, "rad/s", "--speed")
    turned = _quantity(angle, "rad", "--at-angle")
    with ExitStack() as stack:
        plant = _plant(scenario, method, fmu, stack)
        check_input(input, plant.driven)
        place = plant.inputs.index(input)
        point = operating_point(plant, wanted)
        made = _build(scenario, method, point, place, outputs, asked, harmonics, tolerance, turned, sidebands)
        if method == "fmu":
            made.warnings.extend(_checked_by_steps(plant, point))
    if measure is not False and measure is not None:
        from cardan.analyses.measured import measured

        made = measured(scenario, made, measure, fmu, progress)
    return made


def _quantity(value: float | str, unit: str, option: str) -> float:
    try:
        return to_si(value, unit)
    except UnitError as error:
        raise InputError(f"{option}: {error}") from None


def default_fmu(fmu: str | os.PathLike[str] | None) -> Path:
    """Return the FMU to use: the given one, or the driveline of this installation."""
    if fmu is not None:
        return Path(fmu)
    from cardan_build import default_fmu as built

    return Path(built())


def _plant(scenario: Any, method: str, fmu: str | os.PathLike[str] | None, stack: ExitStack) -> Plant:
    if method != "fmu":
        return Plant(scenario)
    from cardan.analyses.black_box import BlackBox

    return stack.enter_context(BlackBox(scenario, default_fmu(fmu)))


def _checked_by_steps(plant: Plant, point: OperatingPoint) -> list[str]:
    from cardan.analyses.period_map import check_by_steps

    return check_by_steps(plant, point)


def periodic_system(point: OperatingPoint, place: int, outputs: tuple[str, ...]) -> tuple[Periodic, tuple[str, ...]]:
    """Return the linear periodic system from one input to outputs, and its states' names.

    Where the speed is prescribed and the acceleration is the input, angle and speed of the input shaft are states too.
    """
    motion = point.motion
    plant, fields = motion.plant, motion.fields
    states = plant.states
    if plant.driven and place == 0:
        active = (P, W1) if plant.rigid else (P, TWIST, W1, WY)
        fields = plant.fields(motion.states, motion.own, motion.added, active)
        states = tuple(KERNEL_STATES[i] for i in active) + plant.own
    rows = [list(output_units()).index(name) for name in outputs]
    system = Periodic(fields.a, fields.b[:, :, [place]], fields.c[:, rows], fields.d[:, rows][:, :, [place]],
                      motion.fundamental)
    return system, states


def _build(scenario: Any, method: str, point: OperatingPoint, place: int, outputs: tuple[str, ...], frequencies: Array,
           harmonics: int | None, tolerance: float, angle: float, sidebands: int) -> Linearization:
    plant = point.motion.plant
    source = plant.inputs[place]
    units = {source: input_units(plant.driven)[source], **{name: output_units()[name] for name in outputs}}
    warnings = [point.warning] if point.warning else []
    if scenario.driver is not None:
        warnings.append("the scene's driver is left out: the throttle stays at "
                        f"{plant.surrounding.bus.throttle:g}, whatever the schedule says")
    fundamental = point.motion.fundamental / (2.0 * math.pi)
    flags = flagged(frequencies, fundamental)
    omega = 2.0 * math.pi * frequencies
    if method in ("hill", "fmu"):
        system, states = periodic_system(point, place, outputs)
        exact = point.floquet.exponents if method == "hill" else None  # differences leave noise in the poles
        made, truncation = _lifted(system, omega, flags, harmonics, tolerance, exact)
        lines = min(sidebands, made.harmonics)
        middle = made.harmonics
        values = made.response(omega)[:, middle - lines:middle + lines + 1, :, 0]
        response = Response(frequencies, source, outputs, units, tuple(range(-lines, lines + 1)), values, fundamental,
                            flags, method)
        return Linearization(method, source, outputs, units, point, _lifted_space(made, source, outputs, states, units,
                             method, lines), made.poles(), response, made.harmonics, truncation, warnings)
    names: tuple[str, ...] = plant.states
    if method == "averaged":
        matrices, names = averaged(point, place, outputs)
    elif method == "ignored":
        matrices = ignored(scenario, point, place, outputs)
    else:
        matrices = frozen(point, angle, place, outputs)
    a, b, c, d = matrices
    space = state_space((a, b, c, d), (source,), outputs, names, method, _state_units(units, names))
    values = np.array([c @ np.linalg.solve(1j * w * np.eye(len(a)) - a, b) + d for w in omega])[:, None, :, 0]
    response = Response(frequencies, source, outputs, units, (0,), values, 0.0, flags, method)
    if method == "frozen":
        warnings.append(_how_wrong(point, place, outputs, omega[~flags], values[~flags, 0], angle))
    return Linearization(method, source, outputs, units, point, space, np.linalg.eigvals(a).astype(complex), response,
                         0, math.nan, warnings)


def _lifted(system: Periodic, omega: Array, flags: NDArray[np.bool_], harmonics: int | None,
            tolerance: float, exponents: Complex | None) -> tuple[Lift, float]:
    if harmonics is not None:
        return lift(system, harmonics), math.nan
    good = omega[~flags]
    if not len(good):
        good = omega * (1.0 + 1e-3)
    probes = np.unique(good[np.linspace(0, len(good) - 1, min(PROBES, len(good))).astype(int)])
    return lift_to_tolerance(system, probes, tolerance, exponents)


def _lifted_space(made: Lift, source: str, outputs: tuple[str, ...], states: tuple[str, ...], units: dict[str, str],
                  name: str, lines: int) -> Any:
    a, b, c, d = made.real()

    def named(signals: tuple[str, ...], count: int) -> tuple[str, ...]:
        plain = [control_name(signal) for signal in signals]
        parts = [f"_{part}{k}" for k in range(1, count + 1) for part in ("cos", "sin")]
        return tuple([*plain, *(f"{signal}{part}" for part in parts for signal in plain)])

    all_states = named(states, made.harmonics)
    all_outputs = named(outputs, lines)
    every = {**units, **_state_units({}, states)}
    found = {label: every[signal] for group, signals in ((all_states, states), (all_outputs, outputs))
             for label, signal in zip(group, [s for _ in range(len(group) // max(1, len(signals))) for s in signals])}
    found[control_name(source)] = units[source]
    rows = len(outputs) * (2 * lines + 1)
    return state_space((a, b, c[:rows], d[:rows]), (source,), all_outputs, all_states, name, found)


def _state_units(units: dict[str, str], states: tuple[str, ...]) -> dict[str, str]:
    found = dict(units)
    for name in states:
        plain, bracket, rest = name.partition(" [")
        found[name] = rest[:-1] if bracket else STATE_UNITS.get(plain, "1")
    return found


def _how_wrong(point: OperatingPoint, place: int, outputs: tuple[str, ...], omega: Array, values: Complex,
               angle: float) -> str:
    """Say how far a frozen model is from the periodic one."""
    text = (f"frozen at {math.degrees(angle):g} deg: a driveline that turns has no stiffness against its angle; this "
            "model is for comparison only")
    if not len(omega):
        return text
    system, _ = periodic_system(point, place, outputs)
    made, _ = lift_to_tolerance(system, omega[:: max(1, len(omega) // PROBES)], 1e-6)
    right = made.response(omega)[:, made.harmonics, :, 0]
    with np.errstate(divide="ignore", invalid="ignore"):
        ratio = np.abs(values) / np.abs(right)
    ratio = np.where(np.isfinite(ratio) & (ratio > 0.0), ratio, 1.0)
    worst = np.unravel_index(np.argmax(np.maximum(ratio, 1.0 / ratio)), ratio.shape)
    factor = float(ratio[worst])
    times = f"{factor:.3g} times too large" if factor >= 1.0 else f"{1.0 / factor:.3g} times too small"
    return f"{text}; here it is up to {times} ({outputs[int(worst[1])]} at {omega[worst[0]] / (2.0 * math.pi):.4g} Hz)"
