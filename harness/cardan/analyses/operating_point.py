"""The operating point of a linearization: the periodic steady state with its stability."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from cardan.analyses.floquet import Floquet, floquet
from cardan.analyses.periodic import HOW_TO, Motion, NoSteadyState, periodic_motion
from cardan.analyses.plant import Plant
from cardan.errors import InputError


@dataclass(frozen=True)
class OperatingPoint:
    """A periodic steady state.

    Attributes
    ----------
    motion : Motion
        The motion over one period with its Jacobians.
    floquet : Floquet
        Multipliers and exponents.
    """

    motion: Motion
    floquet: Floquet

    @property
    def speed(self) -> float:
        """Mean input speed, rad/s."""
        return self.motion.speed

    @property
    def mean_torque(self) -> float:
        """Mean torque of the drive over time, N.m."""
        return self.motion.mean_torque

    @property
    def residual(self) -> float:
        """Largest defect of the equations, relative."""
        return self.motion.residual

    @property
    def stable(self) -> bool:
        """Whether no perturbation grows."""
        return self.floquet.stable

    @property
    def warning(self) -> str:
        """What is wrong with the point; empty for a stable one."""
        if self.stable:
            return ""
        rate = self.floquet.growth_rate
        return (f"the steady state at {self.speed * 30.0 / math.pi:.6g} rpm is unstable: perturbations grow with "
                f"{rate:.6g} 1/s (by {rate * 2.0 * math.pi / self.speed:.3g} per turn, as an exponent); no run stays "
                "there and a response has no meaning for measurements")

    def summary(self) -> dict[str, Any]:
        """Return all figures, ready for JSON."""
        motion = self.motion
        return {
            "speed": self.speed, "mean_torque": self.mean_torque, "added_torque": motion.added,
            "period": motion.period, "fundamental_hz": 1.0 / motion.period, "residual": motion.residual,
            "points": len(motion.states), "stable": self.stable, "growth_rate": self.floquet.growth_rate,
            "growth_per_turn": self.floquet.growth_rate * 2.0 * math.pi / self.speed,
            "multipliers": [[float(m.real), float(m.imag)] for m in self.floquet.multipliers],
            "exponents": [[float(x.real), float(x.imag)] for x in self.floquet.exponents],
            "free_phase": self.floquet.free_phase, "warning": self.warning,
        }

    def __str__(self) -> str:
        return (f"mean speed {self.speed * 30.0 / math.pi:.6g} rpm, mean torque {self.mean_torque:.6g} N.m, residual "
                f"{self.residual:.1e}, {'stable' if self.stable else 'UNSTABLE'}, growth rate "
                f"{self.floquet.growth_rate:.6g} 1/s")


def operating_point(plant: Plant, speed: float | None = None) -> OperatingPoint:
    """Find the periodic steady state.

    Parameters
    ----------
    plant : Plant
        The scene's equations.
    speed : float, optional
        Mean input speed, rad/s: the torque that holds it is added to the engine's (a load or an engine that controls
        the speed gets it as its target). None takes the speed at which the scene's engine and load balance.

    Raises
    ------
    NoSteadyState
        If there is none, or it was not found.
    InputError
        If the speed is no speed.
    """
    if speed is not None and not (math.isfinite(speed) and speed > 0.0):
        raise InputError(f"--speed = {speed:g} rad/s: must be a speed above 0")
    if plant.driven:
        mean = speed if speed is not None else abs(plant.scenario.engine.command(1e9)[0])
        if mean <= 0.0:
            raise NoSteadyState("the prescribed input speed is 0: nothing turns; give a speed above 0")
        motion = periodic_motion(plant, mean)
        return OperatingPoint(motion, floquet(motion))
    controlled = _controlled(plant, speed)
    if controlled is not None:
        plant.surrounding.aim(controlled)
        motion = periodic_motion(plant, controlled, hold=False)
    elif speed is not None:
        motion = periodic_motion(plant, speed)
    else:
        motion = _free_running(plant)
    point = OperatingPoint(motion, floquet(motion))
    _check_determined(point)
    return point


def _controlled(plant: Plant, speed: float | None) -> float | None:
    """Return the speed at which a controller outside holds the shaft; None where there is none."""
    target = plant.surrounding.target
    return None if target is None else (speed if speed is not None else target)


def _check_determined(point: OperatingPoint) -> None:
    """Refuse a steady state that nothing holds: a second neutral multiplier."""
    near = np.abs(point.floquet.multipliers - 1.0)
    if point.floquet.free_phase and near.size and float(near.min()) < 1e-9:
        raise NoSteadyState("there is no steady state to linearize about: nothing resists the rotation (no load that "
                            f"depends on speed, no damping), so any speed may last and none returns; {HOW_TO}")


def _free_running(plant: Plant) -> Motion:
    """Find the motion whose speed the torques themselves hold."""
    guess = balanced_speed(plant)
    try:
        return periodic_motion(plant, guess, hold=False)
    except NoSteadyState:
        pass
    # What the shaft's damping takes is not in the balance: go to where no torque has to be added (secant method).
    try:
        last = periodic_motion(plant, guess)
        here = periodic_motion(plant, guess * (0.97 if last.added > 0.0 else 1.03), guess=last)
        for _ in range(25):
            slope = (here.added - last.added) / (here.speed - last.speed)
            target = here.speed - here.added / slope if slope > 0.0 else here.speed * (0.9 if here.added > 0.0 else 1.1)
            target = min(max(target, 0.8 * here.speed), 1.25 * here.speed)
            if abs(target - here.speed) < 1e-3 * here.speed:
                return periodic_motion(plant, target, hold=False, guess=here)
            last, here = here, periodic_motion(plant, target, guess=here)
    except NoSteadyState as error:
        raise NoSteadyState(f"{error} (looked for from {guess * 30.0 / math.pi:.6g} rpm on, where engine and load "
                            "balance; --speed finds the torque for a given speed)") from None
    raise NoSteadyState(f"there is no steady state: at no speed do engine, load and damping balance; {HOW_TO}")


def balanced_speed(plant: Plant) -> float:
    """Return the mean speed (rad/s) where engine and load balance, from the scene's start speed on.

    Raises
    ------
    NoSteadyState
        If they balance nowhere below 1e4 rad/s, or everywhere.
    """
    drag = plant.values["input.damping"] + plant.values["output.damping"]

    def balance(speed: float) -> float:
        return plant.surrounding.balance(speed) - drag * speed

    start = plant.values["initial.speed"] if plant.values["initial.speed"] > 1.0 else 100.0
    here = balance(start)
    factor = 1.05 if here > 0.0 else 1.0 / 1.05
    low = high = start
    if here == 0.0:
        if abs(balance(1.1 * start)) < 1e-12:
            raise NoSteadyState("there is no single steady state: torques balance at any speed; give --speed, or "
                                f"{HOW_TO}")
        return start
    while 1e-3 < high < 1e4:
        low, high = high, high * factor
        if (balance(high) > 0.0) != (here > 0.0):
            break
    else:
        side = "drives more than the load takes" if here > 0.0 else "drives less than the load takes"
        raise NoSteadyState(f"there is no steady state: the engine {side} at every speed from {start:.4g} rad/s on "
                            f"({here:.4g} N.m there); {HOW_TO}, or use --speed, which finds the torque")
    for _ in range(60):
        middle = 0.5 * (low + high)
        if (balance(middle) > 0.0) == (here > 0.0):
            low = middle
        else:
            high = middle
    return 0.5 * (low + high)
