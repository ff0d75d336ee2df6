"""The tables of a scene file that are not models, and the keys of ``[scene]``."""

from __future__ import annotations

from dataclasses import dataclass

from cardan.models.parameters import ParameterError, check_ranges, choice, integer, quantity, words

TABLES = ("scene", "driveline", "engine", "load", "driver")

COUPLINGS = ("held", "gauss-seidel", "slope", "linear", "hermite3", "hermite5", "iterated", "adaptive", "auto")

# Tolerances where the scene gives none: of the integrator alone, and of a run that is controlled as a whole.
INTEGRATOR = 1e-9
WHOLE_RUN = 1e-6


@dataclass(frozen=True)
class SceneTable:
    """``[scene]``: how long and how finely (``outputs`` is read apart)."""

    stop_time: float = quantity("s", "end of the run, which starts at 0", above=0.0)
    title: str = words("one line", "")
    communication_step: float = quantity("s", "time between communication points", 1e-3, above=0.0)
    coupling: str = choice(COUPLINGS, "what happens between communication points", "gauss-seidel")
    tolerance: float | None = quantity("1", "relative tolerance of the integrator; with adaptive and auto of the "
                                       "whole run", None, minimum=1e-13, maximum=0.1)
    sweeps: int = integer("corrections per step of iterated", 1, minimum=1, maximum=50)
    sweep_tolerance: float = quantity("1", "change of the torques at which iterated ends its corrections", 0.0,
                                      minimum=0.0, maximum=1.0)
    shortest_step: float | None = quantity("s", "floor of the communication step of adaptive and auto", None, above=0.0)

    def __post_init__(self) -> None:
        check_ranges(self)
        if self.tolerance is None:
            object.__setattr__(self, "tolerance", WHOLE_RUN if self.coupling in ("adaptive", "auto") else INTEGRATOR)
        if self.shortest_step is not None and self.shortest_step > self.communication_step:
            raise ParameterError("shortest_step", self.shortest_step, "longer than the communication step",
                                 f"(0, {self.communication_step:g}] s")
        if self.communication_step > self.stop_time:
            raise ParameterError("communication_step", self.communication_step, "longer than the run",
                                 f"(0, {self.stop_time:g}] s")
