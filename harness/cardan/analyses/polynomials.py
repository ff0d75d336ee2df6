"""Torques of engine and load that are polynomials of the speed, as the kernel takes them."""

from __future__ import annotations

from typing import Any

import numpy as np

from cardan.analyses.laws import LATE
from cardan.analyses.plant import Plant
from cardan.models.base import Model, Shaft

Polynomial = tuple[float, float, float]


def polynomials(plant: Plant, low: float, high: float) -> tuple[Polynomial, Polynomial] | None:
    """Return c0, c1, c2 of engine and load where their torques are such polynomials of the speed, else None."""
    around = plant.surrounding
    engine, load = (_polynomial(model, around.bus, low, high) for model in (around.engine, around.load))
    return None if engine is None or load is None else (engine, load)


def _polynomial(model: Model, bus: Any, low: float, high: float) -> Polynomial | None:
    if model.drive == 1:
        return 0.0, 0.0, 0.0
    speeds = np.geomspace(low, high, 12)
    values = np.array([model.value(LATE, [], Shaft(0.0, float(w), 0.0), bus) for w in speeds])
    size = float(np.abs(values).max())
    basis = np.stack([np.ones(len(speeds)), speeds, speeds**2], axis=1)
    scale = np.abs(basis).max(axis=0)
    c = np.linalg.lstsq(basis / scale, values, rcond=None)[0] / scale
    if np.abs(basis @ c - values).max() > 1e-12 * size:
        return None
    c[np.abs(c) * scale < 1e-12 * size] = 0.0
    return float(c[0]), float(c[1]), float(c[2])
