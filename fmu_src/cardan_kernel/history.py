"""The history of both torques: what the holds of degree 3 and 5 are made from."""

from .memory import GAP, GAP2, PAST_IN, PAST_OUT, POINTS
from .places import HOLD_DEGREE, HOLD_RESTART, TORQUE_IN, TORQUE_OUT


class History:
    """Sets the holds of a `Motion` for a step, and keeps the step's start for later ones.

    Past points are kept as torque, its total rate, shaft speed and acceleration, so that the rest T - K w can be
    expressed with the derivative by speed K of the present point.

    Attributes
    ----------
    evaluations : float
        Evaluations of the equations of motion that the last `hold` took.
    """

    def __init__(self, motion):
        self.motion = motion
        self.evaluations = 0.0
        self.new_in = self.new_out = self.rate_in = self.rate_out = 0.0
        self.speed_in = self.speed_out = self.acceleration_in = self.acceleration_out = 0.0

    def hold(self, z, y, h):
        """Continue both torques over the step `h` (s) from the states `y`; returns how many earlier points served."""
        m = self.motion
        degree = z[HOLD_DEGREE]
        rate_in = z[TORQUE_IN + 1] if degree > 0.0 else 0.0
        rate_out = z[TORQUE_OUT + 1] if degree > 0.0 else 0.0
        slope_in = z[TORQUE_IN + 2]
        slope_out = z[TORQUE_OUT + 2]
        w3 = 0.0
        self.evaluations = 0.0
        if slope_out != 0.0 or degree > 1.0:
            m.hold_in.line(z[TORQUE_IN], 0.0, 0.0, 0.0)
            m.hold_out.line(z[TORQUE_OUT], 0.0, 0.0, 0.0)
            m.evaluate(0.0, y[0], y[1], y[2], y[3])
            self.evaluations = 1.0
            w3 = m.w3
        m.hold_in.line(z[TORQUE_IN], rate_in, slope_in, y[2])
        m.hold_out.line(z[TORQUE_OUT], rate_out, slope_out, w3)
        if degree <= 1.0:
            return 0.0
        points = 0.0 if z[HOLD_RESTART] != 0.0 else z[POINTS]
        raised = False
        for side in range(2):
            at = PAST_OUT if side == 1 else PAST_IN
            torque = m.hold_out if side == 1 else m.hold_in
            slope = torque.slope
            u1 = z[at] - slope * z[at + 2]
            m1 = z[at + 1] - slope * z[at + 3]
            raised = False
            if degree == 5.0 and points >= 2.0:
                u2 = z[at + 4] - slope * z[at + 6]
                m2 = z[at + 5] - slope * z[at + 7]
                raised = torque.hermite5(h, z[GAP], u1, m1, z[GAP2], u2, m2)
            if not raised and points >= 1.0:
                torque.hermite3(h, z[GAP], u1, m1)
        self.new_in = z[TORQUE_IN]
        self.new_out = z[TORQUE_OUT]
        self.rate_in = rate_in + slope_in * m.dw1
        self.rate_out = rate_out + slope_out * m.dw3
        self.speed_in = y[2]
        self.speed_out = w3
        self.acceleration_in = m.dw1
        self.acceleration_out = m.dw3
        return points

    def push(self, z, h, points):
        """Put the start of the step of length `h` (s) behind `points` earlier points into the history."""
        if points > 0.0:
            z[GAP2] = z[GAP]
            for i in range(4):
                z[PAST_IN + 4 + i] = z[PAST_IN + i]
                z[PAST_OUT + 4 + i] = z[PAST_OUT + i]
        z[GAP] = h
        z[PAST_IN] = self.new_in
        z[PAST_IN + 1] = self.rate_in
        z[PAST_IN + 2] = self.speed_in
        z[PAST_IN + 3] = self.acceleration_in
        z[PAST_OUT] = self.new_out
        z[PAST_OUT + 1] = self.rate_out
        z[PAST_OUT + 2] = self.speed_out
        z[PAST_OUT + 3] = self.acceleration_out
        z[POINTS] = points + 1.0 if points < 1.5 else 2.0
