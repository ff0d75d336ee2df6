"""Stability of a scene over speed and joint angle: growth, regions of instability, critical damping."""

from __future__ import annotations

import csv
import math
import os
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from cardan.analyses.critical_damping import CriticalDamping
from cardan.analyses.periodic import NoSteadyState
from cardan.analyses.plant import Plant
from cardan.analyses.ranges import read_range
from cardan.analyses.stability_row import Row, row_elsewhere, row_of
from cardan.analyses.transitions import Resonance, Transition
from cardan.errors import InputError

Array = NDArray[np.float64]
Progress = Callable[[float], None]

POINTS = 100  # speeds of a chart where none are counted
SERIAL = 400  # points below which further processes cost more than they save
JOINTS = ("scene", "1", "2", "both")
DAMPINGS = ("output.damping", "input.damping", "shaft.damping", "none")


@dataclass(frozen=True)
class Stability:
    """A stability chart.

    Attributes
    ----------
    speeds : ndarray, shape (S,)
        Mean input speeds, rad/s.
    angles : ndarray, shape (A,)
        Joint angles, rad.
    joints : str
        Which joints have that angle, in words.
    growth_per_turn : ndarray, shape (A, S)
        Logarithm of the growth of the worst perturbation over one turn of the input shaft; NaN where no periodic
        motion was found.
    transitions : list of Transition
        Regions of instability, by angle.
    resonances : list of Resonance
        Speeds at which the motion itself resonates.
    critical_damping : list of CriticalDamping
        What ends the principal region, by angle.
    natural_frequency : float
        Of the shaft between straight joints, rad/s.
    title : str
    warnings : list of str
    """

    speeds: Array
    angles: Array
    joints: str
    growth_per_turn: Array
    transitions: list[Transition]
    resonances: list[Resonance]
    critical_damping: list[CriticalDamping]
    natural_frequency: float
    title: str = ""
    warnings: list[str] = field(default_factory=list)

    def summary(self) -> dict[str, Any]:
        """Return all figures, ready for JSON."""
        grown = self.growth_per_turn[np.isfinite(self.growth_per_turn)]
        return {
            "title": self.title, "joints": self.joints, "natural_frequency": self.natural_frequency,
            "speeds": [float(v) for v in self.speeds], "angles": [float(v) for v in self.angles],
            "transitions": [t.summary() for t in self.transitions],
            "resonances": [vars(r) for r in self.resonances],
            "critical_damping": [vars(c) for c in self.critical_damping],
            "unstable_points": int((grown > 1e-9).sum()), "points": int(self.growth_per_turn.size),
            "failed_points": int(self.growth_per_turn.size - grown.size),
            "largest_growth_per_turn": float(grown.max()) if grown.size else None,
            "growth_is": "natural logarithm of the amplitude's growth over one turn of the input shaft",
            "warnings": self.warnings,
        }

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the chart as CSV: ``angle_rad, speed_rad_per_s, growth_per_turn``."""
        from cardan.storage import written_beside

        with written_beside(Path(path)) as beside, open(beside, "w", encoding="utf-8", newline="") as stream:
            writer = csv.writer(stream, lineterminator="\n")
            writer.writerow(("angle_rad", "speed_rad_per_s", "growth_per_turn"))
            for angle, row in zip(self.angles, self.growth_per_turn):
                writer.writerows((repr(float(angle)), repr(float(s)), repr(float(g))) for s, g in zip(self.speeds, row))

    def plot(self, path: str | os.PathLike[str] | None = None) -> Any:
        """Draw the chart with its transition curves."""
        from cardan.analyses.plots_stability import plot_stability

        return plot_stability(self, path)

    def __str__(self) -> str:
        regions = sorted({t.region for t in self.transitions})
        most = float(np.nanmax(self.growth_per_turn, initial=-math.inf))
        return (f"{self.title}: {len(self.angles)} angles, {len(self.speeds)} speeds, {len(self.transitions)} "
                f"stretches of instability in regions {regions}, largest growth {most:.3g} per turn")


def stability(scenario: Any, speed: Any = None, angle: Any = None, *, joints: str = "scene",
              damping: str | None = None, processes: int | None = None, progress: Progress | None = None) -> Stability:
    """Chart the stability of a scene.

    Parameters
    ----------
    scenario : Scenario
        ``[engine] type = "speed"`` prescribes the input speed that is swept; under torques it is the mean speed, and
        the torque that holds it is found.
    speed : str or array, optional
        ``"500 rpm:6000 rpm:100"``; rad/s. By default 0.2 to 1.6 of the natural frequency.
    angle : str or array, optional
        ``"1 deg:40 deg:40"``; rad. By default the angles of the scene.
    joints : str
        Which joints take the angle: ``scene`` (those that the scene bends; with two different angles the first takes
        the angle and the second keeps its ratio to it; both where the scene bends none), ``1``, ``2``, ``both``.
    damping : str, optional
        Parameter whose critical value is found: ``output.damping``, ``input.damping``, ``shaft.damping`` or ``none``;
        by default ``output.damping`` under a prescribed speed, else ``shaft.damping``.
    processes : int, optional
        Parallel processes; as many as there are processors by default.
    progress : callable, optional
        Called with the fraction done.

    Returns
    -------
    Stability

    Raises
    ------
    InputError
        For ranges, joints and parameters that cannot be used.
    """
    if joints not in JOINTS:
        raise InputError(f"--joints {joints}: choose one of {', '.join(JOINTS)}")
    plant = Plant(scenario)
    if plant.rigid:
        raise InputError("model.fidelity = 1: a rigid driveline has no twist that could grow; set "
                         "driveline.model.fidelity = \"compliant\" for a stability chart")
    if damping is None:
        damping = "output.damping" if plant.driven else "shaft.damping"
    if damping not in DAMPINGS:
        raise InputError(f"--damping {damping}: choose one of {', '.join(DAMPINGS)}")
    natural = plant.natural_frequency()
    speeds = np.unique(read_range(speed, "rad/s", "--speed")) if speed is not None else np.linspace(
        0.2 * natural, 1.6 * natural, POINTS)
    if not np.all(speeds > 0.0):
        raise InputError(f"--speed: {speeds.min():g} rad/s: all speeds must be above 0")
    ratios, words = _ratios(plant, joints)
    angles = np.unique(read_range(angle, "rad", "--angle")) if angle is not None else np.array([max(plant.joints())])
    if not np.all((angles >= 0.0) & (angles * max(ratios) < 0.5 * math.pi)):
        raise InputError(f"--angle: {math.degrees(angles.min()):g} .. {math.degrees(angles.max()):g} deg: joint angles "
                         "must be at least 0 and below 90 deg")
    tables = (scenario.to_dict(), str(scenario.base), scenario.name)
    jobs = [(tables, tuple(float(s) for s in speeds), tuple(float(a * r) for r in ratios), float(a), damping)
            for a in angles]
    rows = _run(jobs, scenario, processes, progress)
    growth = np.array([row.growth for row in rows])
    lost = [row.lost for row in rows if row.lost]
    if np.isnan(growth).all():
        raise NoSteadyState(f"no point of the chart has a steady state: {lost[-1]}")
    warnings = []
    if scenario.driver is not None:
        warnings.append(f"the scene's driver is left out: the throttle stays at {plant.surrounding.bus.throttle:g}")
    if lost:
        warnings.append(f"{int(np.isnan(growth).sum())} of {growth.size} points have no motion, such as: {lost[-1]}")
    return Stability(speeds, angles, words, growth, [t for row in rows for t in row.transitions],
                     [r for row in rows for r in row.resonances],
                     [row.critical for row in rows if row.critical is not None], natural, scenario.title,
                     warnings)


def _ratios(plant: Plant, joints: str) -> tuple[tuple[float, float], str]:
    """Return both joint angles by the one that is swept, and say so."""
    one, two = plant.joints()
    if joints == "scene" and one > 0.0 and two > 0.0 and abs(one - two) > 1e-12:
        return (1.0, two / one), f"joint 1; joint 2 at {two / one:.6g} of it"
    if joints == "1" or (joints == "scene" and one > 0.0 and two == 0.0):
        return (1.0, 0.0), "joint 1; joint 2 straight" if joints == "scene" else "joint 1"
    if joints == "2" or (joints == "scene" and two > 0.0 and one == 0.0):
        return (0.0, 1.0), "joint 2; joint 1 straight" if joints == "scene" else "joint 2"
    return (1.0, 1.0), "both joints"


def _run(jobs: list[Any], scenario: Any, processes: int | None, progress: Progress | None) -> list[Row]:
    count = min(processes or _processors(), len(jobs))
    points = sum(len(job[1]) for job in jobs)
    if count <= 1 or points < SERIAL:
        rows = []
        for i, job in enumerate(jobs):
            rows.append(row_of(scenario, *job[1:]))
            if progress is not None:
                progress((i + 1) / len(jobs))
        return rows
    import multiprocessing

    with ProcessPoolExecutor(count, mp_context=multiprocessing.get_context("spawn")) as pool:
        futures = [pool.submit(row_elsewhere, *job) for job in jobs]
        rows = []
        for i, future in enumerate(futures):
            rows.append(future.result())
            if progress is not None:
                progress((i + 1) / len(jobs))
    return rows


def _processors() -> int:
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
