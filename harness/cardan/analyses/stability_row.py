"""Everything about the stability of a scene at one joint angle."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

from cardan.analyses.critical_damping import CriticalDamping, critical_damping
from cardan.analyses.periodic import NoSteadyState
from cardan.analyses.plant import Plant
from cardan.analyses.section import Section
from cardan.analyses.shooting import Shooter
from cardan.analyses.transitions import Resonance, Transition, find_regions

Tables = tuple[dict[str, Any], str, str]  # of a scene: tables, folder, name


@dataclass(frozen=True)
class Row:
    """All that is known of one joint angle."""

    growth: list[float]
    transitions: list[Transition]
    resonances: list[Resonance]
    critical: CriticalDamping | None
    lost: str


def row_elsewhere(tables: Tables, speeds: tuple[float, ...], bends: tuple[float, float], angle: float,
                  damping: str) -> Row:
    """Do one row in a process of its own, where the scene is read again."""
    from cardan.scenario import Scenario

    return row_of(Scenario.from_dict(tables[0], tables[1], name=tables[2]), speeds, bends, angle, damping)


def row_of(scenario: Any, speeds: tuple[float, ...], bends: tuple[float, float], angle: float, damping: str) -> Row:
    changes = {"joint1.angle": bends[0], "joint2.angle": bends[1]}
    plant = Plant(scenario, changes)
    shooter = Shooter(plant, min(speeds), max(speeds))
    sections: list[Section | None] = []
    lost = ""
    for speed in speeds:
        try:
            sections.append(shooter.section(speed))
        except NoSteadyState as error:
            sections.append(None)
            lost = str(error)
    growth = [math.nan if s is None else s.growth_per_turn for s in sections]
    transitions, resonances = find_regions(shooter.section, list(speeds), sections, angle, plant.period_angle)
    critical = None
    if damping != "none":
        principal = [t for t in transitions if t.region == 1]
        if principal:
            critical = critical_damping(scenario, changes, principal[0], damping)
    return Row(growth, transitions, resonances, critical, lost)
