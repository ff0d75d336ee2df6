"""What values the driveline takes, and the words it refuses others with."""

from math import isfinite
from typing import Callable, List, Optional

from .variables import DEGREES, HALF_PI, INDEX, RPM, VARIABLES, Variable

HOLD_DEGREES = (0, 1, 3, 5)
# A joint angle that a master lets end at zero may miss it by rounding, rad.
ROUNDING = 1e-12


def shown(value: float, unit: str) -> str:
    """Value with its unit, angles and speeds also in degrees and rpm."""
    text = f"{value:.10g} {unit}".rstrip()
    if unit == "rad" and isfinite(value):
        return f"{text} ({value * DEGREES:.6g} deg)"
    if unit == "rad/s" and isfinite(value):
        return f"{text} ({value * RPM:.6g} rpm)"
    return text


def allowed(variable: Variable) -> str:
    """The allowed range of a variable in words."""
    if variable.name == "hold.degree":
        return "one of 0, 1, 3, 5"
    low, high = variable.minimum, variable.maximum
    if high is not None and low is not None:
        bound = "below 1.570796327 rad (90 deg)" if variable.unit == "rad" and high < HALF_PI else f"at most {high:g}"
        return f"at least {low:g} and {bound}"
    if low is not None:
        return f"a finite number of at least {low:g}"
    if high is not None:
        return f"a finite number of at most {high:g}"
    return "a finite number"


def problem(variable: Variable, value: float) -> Optional[str]:
    """Why `value` cannot be taken by `variable`; None where it can.

    Parameters
    ----------
    variable : Variable
        Entry of `variables.VARIABLES`.
    value : float
        Value in the variable's unit.
    """
    low, high = variable.minimum, variable.maximum
    if low is not None and variable.name in ("joint1.angle", "joint2.angle"):
        low -= ROUNDING
    good = isfinite(value) and (low is None or value >= low) and (high is None or value <= high)
    if variable.name == "hold.degree":
        good = value in HOLD_DEGREES
    if good:
        return None
    text = f"{variable.name} = {shown(value, variable.unit)} is refused: it must be {allowed(variable)}"
    if variable.name in ("joint1.angle", "joint2.angle") and value < 0.0:
        text += "; bending the other way is a plane twist of 180 deg (shaft.plane_twist)"
    return text


def all_problems(value_of: Callable[[int], float]) -> List[str]:
    """Every reason against the present parameters and inputs, as messages.

    Parameters
    ----------
    value_of : callable
        Gives the value of a value reference.
    """
    found = []
    for reference, variable in enumerate(VARIABLES):
        if variable.causality != "output":
            text = problem(variable, value_of(reference))
            if text:
                found.append(text)
    if not found:
        found.extend(inertia_problems(lambda name: value_of(INDEX[name])))
    return found


def inertia_problems(value: Callable[[str], float]) -> List[str]:
    """Reasons against the inertias: no free part of the driveline may be without inertia."""
    front = value("input.inertia") + value("shaft.inertia_a") + value("joint1.cross.inertia_m")
    back = value("output.inertia") + value("shaft.inertia_b") + value("joint2.cross.inertia_m")
    rigid, driven = value("model.fidelity") == 1, value("model.drive") == 1
    found = []
    if rigid and not driven and front + back <= 0.0:
        found.append("input.inertia = 0 kg.m2 and all other inertias are 0: at least one must be positive")
    if not rigid and not driven and front <= 0.0:
        found.append("input.inertia = 0 kg.m2 and shaft.inertia_a = 0 kg.m2: one of them must be positive")
    if not rigid and back <= 0.0:
        found.append("output.inertia = 0 kg.m2 and shaft.inertia_b = 0 kg.m2: one of them must be positive")
    return found


def bend_problem(joint: int, angle: float, rate: float, acceleration: float, step: float) -> Optional[str]:
    """Why a joint angle cannot move as given over a step; None where it can.

    Parameters
    ----------
    joint : int
        1 or 2.
    angle, rate, acceleration : float
        Polynomial of the joint angle over the step, rad, rad/s, rad/s2.
    step : float
        Length of the step, s.
    """
    times = [0.0, step]
    if acceleration != 0.0 and 0.0 < -rate / acceleration < step:
        times.append(-rate / acceleration)
    for s in times:
        at = angle + s * (rate + 0.5 * s * acceleration)
        if not -ROUNDING <= at < HALF_PI:
            return (f"joint{joint}.angle reaches {shown(at, 'rad')} at {s:.6g} s of the step, from "
                    f"{shown(angle, 'rad')} with der1 = {rate:g} rad/s, der2 = {acceleration:g} rad/s2: it must be at "
                    f"least 0 and below 90 deg; give a smaller rate or a shorter step")
    return None

