"""Only a tolerance is given."""

from __future__ import annotations

from cardan.coupling.adaptive import Adaptive

# Shares of the wanted tolerance. The FMU's integrator and the models' own integration work below it, so that the
# coupling decides the error; a relative tolerance below the smallest that the FMU takes is not asked for.
INTEGRATOR = 0.1
MODELS = 0.01
SMALLEST = 1e-13


class Auto(Adaptive):
    """``adaptive``, with the tolerances of everything that works under it chosen for the scene's tolerance.

    The FMU's integrator gets a tenth of it, the models' own states are integrated with error control at a hundredth.
    Where no torque is exchanged that depends on the motion the steps are as long as the scene's communication step.

    Order and cost per step: as ``adaptive``.
    """

    name = "auto"

    def fmu_tolerance(self, tolerance: float) -> float:
        """Return the tolerance for the FMU's integrator."""
        return max(SMALLEST, INTEGRATOR * tolerance)

    def model_tolerance(self, tolerance: float) -> float:
        """Return the tolerance for the models' own states."""
        return max(SMALLEST, MODELS * tolerance)
