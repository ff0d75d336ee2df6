"""Held torques, models after the FMU (Gauss-Seidel)."""

from __future__ import annotations

from cardan.coupling.base import Scheme
from cardan.coupling.master import Master
from cardan.coupling.motion import interpolated


class GaussSeidel(Scheme):
    """The FMU advances first with held torques; the models then follow the motion that it has found.

    The models' own states see the shafts between start and end of the step (cubic Hermite interpolant), so only
    the torques are held. Without own states of the models it is the same as ``held``.

    Order 1. Cost per step: one FMU step, one evaluation of the models.

    Source: docs/NUMERICS.md, "Coupling engine and load outside the FMU".
    """

    name = "gauss-seidel"
    order = 1
    interpolates = True
    motion = staticmethod(interpolated)  # what the models' own states follow

    def step(self, master: Master, t: float, end: float) -> None:
        """Do one communication step from t to end, s."""
        before_in, before_out = master.shaft_in, master.shaft_out
        master.step(t, end)
        if master.moving:
            h = end - t
            master.move_models(t, end, self.motion(before_in, master.shaft_in, h),
                               self.motion(before_out, master.shaft_out, h))
        master.send(end)
