"""Hermite interpolation inside the FMU."""

from __future__ import annotations

from cardan.coupling.gauss_seidel import GaussSeidel
from cardan.coupling.master import Master
from cardan.coupling.motion import smooth

# The first steps after the start and after a jump, as parts of a communication step. With them the history grows from
# one point without ever stretching far, and the order of the method is kept.
START_UP = (1 / 64, 1 / 64, 1 / 32, 1 / 16, 1 / 8, 1 / 4, 1 / 2)


class Hermite(GaussSeidel):
    """Values and slopes at the last communication points, continued as a polynomial inside the FMU.

    The FMU keeps the history (``hold.degree``) and adds ``K w(s)`` itself, so only the rest of a torque is
    extrapolated. A jump of an engine or a load restarts the history with short steps, and a step that does not resolve
    the torques drops it.

    Source: docs/NUMERICS.md, "Coupling engine and load outside the FMU"; docs/FMI.md, torque inputs.
    """

    slopes = True
    splits = True
    listens = True
    motion = staticmethod(smooth)

    def __init__(self) -> None:
        self._bent = False

    def step(self, master: Master, t: float, end: float) -> None:
        """Do one communication step from t to end, s; in short steps after the start and after a jump."""
        if master.restart:
            h, done = end - t, 0.0
            for part in START_UP[:-1]:
                done += part
                self.go(master, master.time, t + done * h)
        self.go(master, master.time, end)

    def go(self, master: Master, t: float, end: float) -> None:
        """Do one step of the FMU from t to end, s; without history after a jump and where the torques bend too much.

        Where a step does not resolve the torques, as in the transient of a steep load, a polynomial through its history
        is worse than the line, which is the FMU's continuation without history.
        """
        drop = master.restart or self._bent
        if drop:
            master.instance.set("hold.restart", True)
        super().step(master, t, end)
        if drop:
            master.instance.set("hold.restart", False)
        self._bent = master.energy.bent


class Hermite3(Hermite):
    """The cubic through the last two points: order 4.

    Cost per step: one FMU step, one evaluation of the models; seven of each after the start and after a jump.
    """

    name = "hermite3"
    order = 4
    degree = 3
    share = 1 / 4  # of s^2 (s + h)^2


class Hermite5(Hermite):
    """The quintic through the last three points: order 6.

    Cost per step: one FMU step, one evaluation of the models; seven of each after the start and after a jump.
    """

    name = "hermite5"
    order = 6
    degree = 5
    share = 1 / 5  # of s^2 (s + h)^2 (s + 2 h)^2
