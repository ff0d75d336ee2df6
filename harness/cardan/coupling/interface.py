"""Which variables of the FMU the master exchanges: names in one place, plans for one run."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import NamedTuple

from cardan.instance import Instance
from cardan.plan import Plan

MOTION = ("input.angle", "input.speed", "output.angle", "output.speed")
ACCELERATIONS = ("input.acceleration", "output.acceleration")
POWERS = ("power.input", "power.output")
ENERGY = "energy.kinetic"
REACTION = "input.reaction_torque"
BENDING = ("joint1.angle", "joint2.angle")


class Course(NamedTuple):
    """A joint angle that moves on its own: ``value + rate s + acceleration s^2/2``, s since the start of the run."""

    name: str
    value: float
    rate: float
    acceleration: float

    def at(self, s: float) -> tuple[float, float]:
        """Return angle and rate s seconds after the start of the run."""
        return self.value + s * (self.rate + 0.5 * s * self.acceleration), self.rate + s * self.acceleration


def courses(settings: Mapping[str, float | int | bool]) -> list[Course]:
    """Return the joint angles that move during the run, from the scene's driveline values."""
    moving = []
    for name in BENDING:
        value, rate, acceleration = (float(settings.get(name + tail, 0.0)) for tail in ("", ".der1", ".der2"))
        if rate or acceleration:
            moving.append(Course(name, value, rate, acceleration))
    return moving


def sending(instance: Instance, drive: int, slopes: bool, moving: Iterable[Course]) -> Plan:
    """Make the plan of the inputs sent at every communication point.

    Parameters
    ----------
    instance : Instance
        The FMU.
    drive : int
        1 where the input speed is prescribed, 0 where the engine gives a torque.
    slopes : bool
        Whether rates and derivatives by speed are sent too.
    moving : iterable of Course
        Joint angles that move.
    """
    tails = ("", ".der1", ".by_speed") if slopes else ("",)
    names = [f"input.speed_command{tail}" for tail in ("", ".der1", ".der2")] if drive else []
    names += [f"{side}.torque{tail}" for side in (("output",) if drive else ("input", "output")) for tail in tails]
    names += [f"{course.name}{tail}" for course in moving for tail in ("", ".der1")]
    return instance.plan(names)


def receiving(instance: Instance, accelerations: bool, powers: bool, drive: int, names: Iterable[str]) -> Plan:
    """Make the plan of what is read at every communication point.

    Parameters
    ----------
    instance : Instance
        The FMU.
    accelerations : bool
        Whether the shafts' accelerations follow after their angles and speeds.
    powers : bool
        Whether the powers received and delivered follow next.
    drive : int
        1 where the reaction torque of a prescribed speed follows next.
    names : iterable of str
        What else is wanted, last.
    """
    wanted = (*MOTION, *(ACCELERATIONS if accelerations else ()), *(POWERS if powers else ()),
              *((REACTION,) if drive else ()), *names)
    return instance.plan(dict.fromkeys(wanted))
