"""The tables of a scene file that are not models, and the keys of ``[scene]``."""

from __future__ import annotations

from dataclasses import dataclass

from cardan.models.parameters import ParameterError, check_ranges, choice, quantity, words

TABLES = ("scene", "driveline", "engine", "load", "driver")

COUPLINGS = ("held", "gauss-seidel", "slope", "linear", "hermite3", "hermite5", "iterated", "adaptive", "auto")


@dataclass(frozen=True)
class SceneTable:
    """``[scene]``: how long and how finely (``outputs`` is read apart)."""

    stop_time: float = quantity("s", "end of the run, which starts at 0", above=0.0)
    title: str = words("one line", "")
    communication_step: float = quantity("s", "time between communication points", 1e-3, above=0.0)
    coupling: str = choice(COUPLINGS, "what happens between communication points", "gauss-seidel")
    tolerance: float = quantity("1", "relative tolerance of the integrator", 1e-9, minimum=1e-13, maximum=0.1)

    def __post_init__(self) -> None:
        check_ranges(self)
        if self.communication_step > self.stop_time:
            raise ParameterError("communication_step", self.communication_step, "longer than the run",
                                 f"(0, {self.stop_time:g}] s")
