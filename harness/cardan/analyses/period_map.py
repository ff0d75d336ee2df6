"""The period of an FMU, stepped: whether a periodic motion closes, and multipliers by periodic differences.

From the saved start of the period the FMU is stepped through it with each state moved a little to both sides; the
differences of where it ends are the monodromy matrix, with nothing but FMI in between.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from cardan.analyses.black_box import BlackBox
from cardan.analyses.closed_loop import ClosedLoop
from cardan.analyses.floquet import return_map
from cardan.analyses.operating_point import OperatingPoint
from cardan.analyses.plant import TWIST, P, Plant

Array = NDArray[np.float64]

STEPS = 64  # of a half turn
CLOSED = 1e-6
MATCH = 1e-5


def period_map(plant: Plant, point: OperatingPoint, fmu: object) -> tuple[float, Array]:
    """Step an FMU through the period of a motion.

    Parameters
    ----------
    plant : Plant
    point : OperatingPoint
        The motion.
    fmu : path-like

    Returns
    -------
    gap : float
        How far the motion is from closing, relative.
    matrix : ndarray, shape (n, n)
        Monodromy matrix over moving kernel states and own states.
    """
    motion = point.motion
    count = STEPS * max(1, round(plant.period_angle / np.pi))
    h = motion.period / count
    none = np.zeros((1, 15, 2))
    k = len(plant.own)
    start = np.concatenate([motion.states[0], motion.own[0]])
    active = [*plant.active, *range(4, 4 + k)]
    scale = np.array([1.0 if j in (P, TWIST) else motion.speed for j in range(4)]
                     + [max(1.0, abs(float(v))) for v in motion.own[0]])
    with ClosedLoop(plant, fmu, motion.added) as loop:  # type: ignore[arg-type]

        def end(state: Array) -> Array:
            loop.run(state[:4], state[4:], h, count, None, none)
            return np.concatenate([loop.final(), loop.models.x])

        reached = end(start)
        reached[P] -= plant.period_angle if not plant.driven else reached[P] - start[P]
        gap = float((np.abs(reached - start) / scale)[active].max(initial=0.0))
        columns = []
        for j in active:
            move = np.zeros(4 + k)
            move[j] = 1e-4 * scale[j]
            columns.append((8.0 * (end(start + move) - end(start - move))
                            - (end(start + 2.0 * move) - end(start - 2.0 * move)))[active] / (12.0 * move[j]))
    return gap, np.array(columns).T


def check_by_steps(plant: Plant, point: OperatingPoint) -> list[str]:
    """Compare the equations that were found from an FMU with its own steps; returns warnings."""
    assert isinstance(plant, BlackBox)
    if not plant.states:
        return []
    gap, matrix = period_map(plant, point, plant.path)
    section = return_map(matrix, point.motion.fields.rates[0]) if point.floquet.free_phase else matrix
    stepped = np.linalg.eigvals(section)
    warnings = []
    if gap > CLOSED:
        warnings.append(f"the FMU does not repeat after the period of the motion: it misses by {gap:.1e}")
    size = max(1.0, float(np.abs(stepped).max(initial=0.0)))
    worst = max((float(np.abs(point.floquet.multipliers - m).min()) for m in stepped), default=0.0)
    if worst > MATCH * size:
        warnings.append(f"multipliers of the FMU's own steps differ by {worst:.1e} from those of its outputs' "
                        "derivatives")
    return warnings
