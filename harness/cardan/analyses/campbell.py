"""Campbell diagram: natural frequencies over the speed with the orders of joints and engine, and their crossings."""

from __future__ import annotations

import math
import os
from dataclasses import dataclass
from types import SimpleNamespace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from cardan.analyses.laws import LATE
from cardan.analyses.operating_point import operating_point
from cardan.analyses.periodic import NoSteadyState
from cardan.analyses.plant import Plant
from cardan.analyses.ranges import read_range
from cardan.analyses.shooting import Shooter
from cardan.errors import InputError
from cardan.models.base import Shaft
from cardan.models.constant import ConstantTorque

Array = NDArray[np.float64]

JOINT_ORDERS = (2.0, 4.0, 6.0)
POINTS = 41


@dataclass(frozen=True)
class Crossing:
    """A speed at which an order meets a natural frequency.

    Attributes
    ----------
    order : float
    source : str
        ``joints``, ``engine`` or ``joints and engine``.
    speed : float
        Mean input speed, rad/s.
    frequency : float
        rad/s.
    """

    order: float
    source: str
    speed: float
    frequency: float


@dataclass(frozen=True)
class Campbell:
    """Natural frequencies and orders.

    Attributes
    ----------
    speeds : ndarray, shape (S,)
        Mean input speed, rad/s.
    frequencies : ndarray, shape (S,)
        Frequency of twist perturbations of the driveline as it turns (from their rotation number), rad/s; NaN where
        no motion was found.
    straight : float
        Natural frequency between straight joints, rad/s.
    orders : dict of float to str
        Orders with their source.
    crossings : list of Crossing
        With the natural frequency between straight joints.
    title : str
    """

    speeds: Array
    frequencies: Array
    straight: float
    orders: dict[float, str]
    crossings: list[Crossing]
    title: str = ""

    def summary(self) -> dict[str, Any]:
        """Return all figures, ready for JSON."""
        return {"title": self.title, "natural_frequency": self.straight,
                "orders": [{"order": o, "source": s} for o, s in self.orders.items()],
                "crossings": [vars(c) for c in self.crossings], "speeds": self.speeds.tolist(),
                "frequencies": [float(v) if math.isfinite(v) else None for v in self.frequencies]}

    def plot(self, path: str | os.PathLike[str] | None = None) -> Any:
        """Draw the diagram."""
        from cardan.analyses.plots_orders import plot_campbell

        return plot_campbell(self, path)

    def __str__(self) -> str:
        lines = [f"{self.title}: natural frequency {self.straight / (2.0 * math.pi):.5g} Hz"]
        lines += [f"  order {c.order:g} ({c.source}) at {c.speed * 30.0 / math.pi:.6g} rpm" for c in self.crossings]
        return "\n".join(lines)


def campbell(scenario: Any, speed: Any = None) -> Campbell:
    """Make the Campbell diagram of a scene.

    Parameters
    ----------
    scenario : Scenario
    speed : str or array, optional
        ``"500 rpm:6000 rpm:60"``; by default from a twentieth of the natural frequency to the natural frequency.

    Raises
    ------
    InputError
        For a rigid driveline, or speeds that cannot be used.
    """
    plant = Plant(scenario)
    if plant.rigid:
        raise InputError("model.fidelity = 1: a rigid driveline has no natural frequency; set "
                         "driveline.model.fidelity = \"compliant\" for a Campbell diagram")
    natural = plant.natural_frequency()
    speeds = np.unique(read_range(speed, "rad/s", "--speed")) if speed is not None else np.linspace(
        natural / 20.0, 1.1 * natural, POINTS)
    if not np.all(speeds > 0.0):
        raise InputError(f"--speed: {speeds.min():g} rad/s: all speeds must be above 0")
    shooter = Shooter(_quiet(scenario, plant), float(speeds[0]), float(speeds[-1]))
    turning = np.array([_frequency(shooter, float(s)) for s in speeds])
    straight = damped_frequency(scenario, plant, float(speeds[-1]))
    sources = {order: "joints" for order in JOINT_ORDERS if any(angle > 0.0 for angle in plant.joints())}
    for order in engine_orders(plant):
        sources[order] = "joints and engine" if order in sources else "engine"
    orders = dict(sorted(sources.items()))
    crossings = [Crossing(order, source, straight / order, straight) for order, source in orders.items()
                 if speeds[0] <= straight / order <= speeds[-1]]
    return Campbell(speeds, turning, straight, orders, sorted(crossings, key=lambda c: c.speed), scenario.title)


def _quiet(scenario: Any, plant: Plant) -> Plant:
    """Return the plant with the ripple of its engine left out: a resonance with it is a crossing of the diagram."""
    if not plant.surrounding.turns:
        return plant
    still = SimpleNamespace(driveline=scenario.driveline, engine=ConstantTorque(torque_=0.0), load=scenario.load)
    return Plant(still)


def damped_frequency(scenario: Any, plant: Plant, speed: float) -> float:
    """Return the frequency of the twist's oscillation between straight joints, rad/s (0 where it is overdamped)."""
    level = Plant(_quiet(scenario, plant).scenario, {**plant.values, "joint1.angle": 0.0, "joint2.angle": 0.0})
    try:
        point = operating_point(level, speed)
    except NoSteadyState:
        return plant.natural_frequency()  # nothing outside damps the twist then
    return float(np.abs(np.linalg.eigvals(point.motion.fields.a.mean(axis=0)).imag).max())


def engine_orders(plant: Plant, least: float = 1e-3) -> list[float]:
    """Return the orders that the engine's torque has, larger than `least` of the largest.

    They are found in the torque over two turns, whatever model gives it.
    """
    around = plant.surrounding
    if not around.turns:
        return []
    x = around.start(100.0)[:around.split]
    angles = 4.0 * math.pi * np.arange(512) / 512
    torque = [around.engine.value(LATE, x, Shaft(float(a), 100.0, 0.0), around.bus) for a in angles]
    size = np.abs(np.fft.rfft(torque))[1:]
    return [0.5 * (i + 1) for i in np.flatnonzero(size > max(least * float(size.max()), 1e-9 * 512))]


def _frequency(shooter: Shooter, speed: float) -> float:
    try:
        section = shooter.section(speed)
    except NoSteadyState:
        return math.nan
    return section.rotation / section.period
