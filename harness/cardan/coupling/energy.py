"""Energy that the coupling makes or loses at the interface."""

from __future__ import annotations

from cardan.coupling.base import Torques

# Parts of the power exchanged: departure from a line, and change with the speed, that end an extrapolation.
BENT = 0.5
STEEP = 0.03


class EnergyMeter:
    """Power sent by the models minus power received by the FMU, summed over the run.

    Between two points the FMU works with its own continuation of the torques that it was sent; at the end of the
    step the models know the true ones. The gap between both grows from zero over the step as a power of the time
    that the coupling scheme knows (its `share`), so its work is ``share h (true - received) w``. That is what the
    coupling takes out of the run (adds to it, where negative).

    Source: Sadjina, Kyllingstad, Skjong and Pedersen, Energy conservation and power bonds in co-simulations:
    non-iterative adaptive step size control and error estimation, Engineering with Computers 33 (2017).

    Attributes
    ----------
    residual_in, residual_out : float
        Residual at the engine's and at the load's end, J.
    step : float
        Size of the last step's contributions, J.
    bent : bool
        Whether the last step was too long for an extrapolation from its history: the torques left the line through
        their value and rate by more than half their size, or a steep one has followed a change of speed.
    supplied, taken : float
        What the engine has delivered and the load has taken, J: the sizes to compare the residuals with.
    """

    __slots__ = ("residual_in", "residual_out", "step", "bent", "supplied", "taken", "_speeds", "_power")

    def __init__(self) -> None:
        self.residual_in = self.residual_out = self.step = self.supplied = self.taken = 0.0
        self.bent = False
        self._speeds = (0.0, 0.0)
        self._power = 0.0

    @property
    def residual(self) -> float:
        """Residual of both ends, J."""
        return self.residual_in + self.residual_out

    def begin(self, speed_in: float, speed_out: float) -> None:
        """Take the shaft speeds at the start of the run, rad/s."""
        self._speeds = speed_in, speed_out

    def count(self, h: float, sent: Torques, true: Torques, speed_in: float, speed_out: float, slopes: bool,
              share: float, received: tuple[float, float] | None) -> None:
        """Add one step.

        Parameters
        ----------
        h : float
            Length of the step, s.
        sent, true : tuple of Torque
            Torques of engine and load sent at its start, and at its end by the models, before any jump there.
        speed_in, speed_out : float
            Shaft speeds at its end, rad/s.
        slopes : bool
            Whether rates and derivatives by speed were sent too.
        share : float
            `Scheme.share`.
        received : tuple of float or None
            Power that the FMU received from the engine and delivered to the load at the end, W; None where it follows
            from what was sent.
        """
        (old_in, rate_in, by_in), (old_out, rate_out, by_out) = sent
        from_in, from_out = self._speeds
        power_in, power_out = true[0][0] * speed_in, true[1][0] * speed_out
        old_power = abs(old_in * from_in) + abs(old_out * from_out)
        half = 0.5 * h
        self.supplied += half * (old_in * from_in + power_in)
        self.taken += half * (old_out * from_out + power_out)
        followed = 0.0
        if slopes:
            by_in *= speed_in - from_in
            by_out *= speed_out - from_out
            followed = abs(by_in * speed_in) + abs(by_out * speed_out)
            old_in += rate_in * h + by_in
            old_out += rate_out * h + by_out
        line_in, line_out = old_in * speed_in, old_out * speed_out
        if received is None:
            received = line_in, line_out
        gap_in, gap_out = power_in - received[0], received[1] - power_out
        lost_in, lost_out = share * h * gap_in, share * h * gap_out
        size = max(abs(power_in) + abs(power_out), old_power)
        self.bent = followed > STEEP * size or abs(power_in - line_in) + abs(line_out - power_out) > BENT * size
        self.residual_in += lost_in
        self.residual_out += lost_out
        self.step = abs(lost_in) + abs(lost_out)
        self._speeds = speed_in, speed_out

    def count_drive(self, h: float, reaction: float, speed: float, gap: float) -> None:
        """Add one step of a prescribed input speed to the engine's end.

        Parameters
        ----------
        h : float
            Length of the step, s.
        reaction : float
            Torque that the drive supplies at its end, N.m.
        speed : float
            Input speed at its end, rad/s.
        gap : float
            Prescribed speed minus its continuation in the FMU, at the end of the step, rad/s.
        """
        power = reaction * speed
        self.supplied += 0.5 * h * (self._power + power)
        self.residual_in += 0.5 * h * reaction * gap
        self._power = power

    def save(self) -> tuple[object, ...]:
        """Return everything, for `restore`."""
        return tuple(getattr(self, name) for name in self.__slots__)

    def restore(self, saved: tuple[object, ...]) -> None:
        """Go back to what `save` returned."""
        for name, value in zip(self.__slots__, saved):
            setattr(self, name, value)
