"""Linear extrapolation from past samples."""

from __future__ import annotations

from cardan.coupling.base import Torques
from cardan.coupling.gauss_seidel import GaussSeidel
from cardan.coupling.master import Master
from cardan.models.base import Torque


class Linear(GaussSeidel):
    """As ``gauss-seidel``, but each torque is continued along the line through its last two values.

    This is what a master can do with values alone. The slope is the difference quotient, sent as ``.der1``; after a
    jump the first step holds the new value. Explicit: a steep load needs short steps.

    Order 2. Cost per step: one FMU step, one evaluation of the models.

    Source: docs/NUMERICS.md, "Coupling engine and load outside the FMU".
    """

    name = "linear"
    order = 2
    slopes = True
    degree = 1
    splits = True
    share = 1 / 3

    def __init__(self) -> None:
        self._last: tuple[float, Torques] | None = None

    def sent(self, master: Master, t: float, torques: Torques) -> Torques:
        """Replace the models' own derivatives by the difference quotient of the last two values."""
        last = None if master.restart else self._last
        self._last = t, torques
        if last is None or t <= last[0]:
            return Torque(torques[0].value, 0.0, 0.0), Torque(torques[1].value, 0.0, 0.0)
        h = t - last[0]
        engine, load = torques
        return (Torque(engine.value, (engine.value - last[1][0].value) / h, 0.0),
                Torque(load.value, (load.value - last[1][1].value) / h, 0.0))
