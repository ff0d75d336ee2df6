"""Torques with their slopes."""

from __future__ import annotations

from cardan.coupling.gauss_seidel import GaussSeidel


class Slope(GaussSeidel):
    """As ``gauss-seidel``, but each torque goes with its rate and its derivative by shaft speed.

    The FMU follows ``T + rate s + K (w(s) - w(0))`` over the step instead of holding T: what depends on the
    speed is inside its integration, so steep loads stay stable, and the rest is extrapolated linearly. Known jumps
    of the torques become communication points.

    Order 2. Cost per step: one FMU step, one evaluation of the models.

    Source: docs/NUMERICS.md, "Coupling engine and load outside the FMU"; docs/FMI.md, torque inputs.
    """

    name = "slope"
    order = 2
    slopes = True
    degree = 1
    splits = True
    share = 1 / 3
