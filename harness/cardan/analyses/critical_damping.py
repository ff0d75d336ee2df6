"""How much damping ends the principal region of instability."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

from cardan.analyses.periodic import NoSteadyState
from cardan.analyses.plant import Plant
from cardan.analyses.shooting import Shooter
from cardan.analyses.transitions import Transition

MOST = 10.0  # damping ratio up to which it is looked for


@dataclass(frozen=True)
class CriticalDamping:
    """The value of a damping parameter from which on the principal region is stable.

    Attributes
    ----------
    angle : float
        Joint angle, rad.
    parameter : str
        FMU variable.
    value : float
        N.m.s/rad.
    ratio : float
        As damping ratio: value / (2 J w_n) of a bearing on the inertia J behind the shaft (or in front of it, for
        ``input.damping``), value w_n / (2 k) of the shaft.
    speed : float
        Where the region ends last, rad/s.
    """

    angle: float
    parameter: str
    value: float
    ratio: float
    speed: float


def critical_damping(scenario: Any, changes: dict[str, float], region: Transition,
                     parameter: str) -> CriticalDamping | None:
    """Find it by root finding on the least determinant over the region.

    Parameters
    ----------
    scenario : Scenario
    changes : dict
        FMU variables that differ from the scene's.
    region : Transition
        The principal region with the scene's damping.
    parameter : str
        ``output.damping``, ``input.damping`` or ``shaft.damping``; what the scene has of it counts in.

    Returns
    -------
    CriticalDamping or None
        None where no damping up to ten times the aperiodic one does it, or a border of the region is not known.
    """
    from scipy.optimize import brentq, minimize_scalar

    if not (math.isfinite(region.speed_low) and math.isfinite(region.speed_high)):
        return None
    plant = Plant(scenario, changes)
    unit = _unit(plant, parameter)
    width = region.speed_high - region.speed_low
    shooter = Shooter(plant, region.speed_low, region.speed_high)
    low, high = region.speed_low - 0.5 * width, region.speed_high + 0.5 * width
    worst = region.speed_worst
    start = plant.values[parameter]

    def least(value: float) -> float:
        nonlocal worst
        plant.values[parameter] = value
        plant.bundle.put(_reference(parameter), value)
        found = minimize_scalar(lambda s: shooter.section(s).distance(-1.0), bounds=(low, high), method="bounded",
                                options={"xatol": 1e-9 * worst, "maxiter": 60})
        worst = float(found.x)
        return float(found.fun)

    try:
        ratio = max(1e-6, region.growth_per_turn / 10.0)
        while least(start + ratio * unit) < 0.0:
            ratio *= 2.0
            if ratio > MOST:
                return None
        value = float(brentq(least, start, start + ratio * unit, xtol=1e-10 * unit, rtol=1e-12))
        least(value)
    except (NoSteadyState, ValueError):
        return None
    return CriticalDamping(region.angle, parameter, value, value / unit, worst)


def _unit(plant: Plant, parameter: str) -> float:
    """Damping of ratio 1, N.m.s/rad."""
    v, natural = plant.values, plant.natural_frequency()
    if parameter == "shaft.damping":
        return 2.0 * v["shaft.stiffness"] / natural
    if parameter == "input.damping":
        return 2.0 * natural * (v["input.inertia"] + v["shaft.inertia_a"])
    return 2.0 * natural * (v["output.inertia"] + v["shaft.inertia_b"])


def _reference(name: str) -> int:
    from cardan_kernel import INDEX

    return int(INDEX[name])
