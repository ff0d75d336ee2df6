"""Held values, both sides at once (Jacobi)."""

from __future__ import annotations

from cardan.coupling.base import Scheme
from cardan.coupling.master import Master
from cardan.coupling.motion import held


class Held(Scheme):
    """FMU and models advance independently with what they knew at the start of the step.

    The FMU holds the torques of the start; the models' own states follow the shafts' speeds of the start.
    This is what any FMI master does without further information. A held torque acts as a delay of half a step:
    it feeds energy into a vibration of frequency w_n at the rate w_n^2 h/4.

    Order 1. Cost per step: one FMU step, one evaluation of the models.

    Source: docs/NUMERICS.md, "Coupling engine and load outside the FMU"; docs/PHYSICS.md section 6.
    """

    name = "held"
    order = 1

    def step(self, master: Master, t: float, end: float) -> None:
        """Do one communication step from t to end, s."""
        if master.moving:
            master.move_models(t, end, held(master.shaft_in), held(master.shaft_out))
        master.step(t, end)
        master.send(end)
