"""What every coupling scheme is."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import TYPE_CHECKING, ClassVar

from cardan.models.base import Torque

if TYPE_CHECKING:
    from cardan.coupling.master import Master

Torques = tuple[Torque, Torque]  # engine, load


class Scheme(ABC):
    """A way to bring the FMU and its surroundings from one communication point to the next.

    Before a call of `advance` everything stands at time t: the FMU's outputs are read, the models' states belong
    to t, the inputs for t are sent. After it everything stands at the end in the same way.

    Attributes
    ----------
    name : str
        Name in scene files.
    order : int
        Order of the error in the communication step, for smooth torques.
    slopes : bool
        Whether the torques' rates and derivatives by speed are sent with the values.
    degree : int
        ``hold.degree`` of the FMU.
    splits : bool
        Whether known jumps (`Surroundings.next_event`) become communication points of their own.
    interpolates : bool
        Whether the models' own states follow a motion made of the shafts' accelerations too.
    accelerates : bool
        Whether the scheme itself needs the shafts' accelerations.
    listens : bool
        Whether the power that the FMU has received is read back: where the master cannot know how the FMU continues
        the torques.
    energetic : bool
        Whether the kinetic energy is read: the measure of an error in energy.
    share : float
        Part of the step's length by which the gap between true and received power at its end makes the energy of the
        step: 1/2 for a gap that grows linearly, 1/3 for a quadratic one, ...
    rolls_back : bool
        Whether the FMU must be able to save and restore its state.
    """

    name: ClassVar[str]
    order: ClassVar[int]
    slopes: ClassVar[bool] = False
    degree: ClassVar[int] = 0
    splits: ClassVar[bool] = False
    interpolates: ClassVar[bool] = False
    accelerates: ClassVar[bool] = False
    listens: ClassVar[bool] = False
    energetic: ClassVar[bool] = False
    share: ClassVar[float] = 0.5
    rolls_back: ClassVar[bool] = False

    def fmu_tolerance(self, tolerance: float) -> float:
        """Return the tolerance for the FMU's integrator where the scene wants `tolerance`."""
        return tolerance

    def model_tolerance(self, tolerance: float) -> float:
        """Return the tolerance for the models' own states; 0 for steps of fixed length."""
        return 0.0

    def sent(self, master: Master, t: float, torques: Torques) -> Torques:
        """Return what is sent to the FMU for the models' torques at time t, s; their own derivatives by default."""
        return torques

    @abstractmethod
    def step(self, master: Master, t: float, end: float) -> None:
        """Do one communication step from t to end, s."""

    def advance(self, master: Master, t: float, end: float) -> None:
        """Go from one communication point of the scene to the next, in one step or in several.

        Parameters
        ----------
        master : Master
            What is moved.
        t, end : float
            Times, s; end > t.

        Raises
        ------
        StepRefused
            If the FMU does not do a step.
        """
        if self.splits:
            while master.event < end - master.snap:
                event = master.event
                self.step(master, t, event)
                t = event
        self.step(master, t, end)
