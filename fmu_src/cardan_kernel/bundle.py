"""A driveline for the analysis of periodic motions: its equations with torque laws, and their directions.

Directions, the columns of a fundamental matrix, are numbered like the states and inputs of the exact
Jacobians: 0 to 3 are those of ``JACOBIAN_STATES``, 4 to 6 those of ``JACOBIAN_INPUTS``.
"""

from .law import Law
from .memory import VARS
from .places import BEND1, BEND2
from .stepper import Stepper

POINT_IN = 9  # numbers per point that `fields` takes
POINT_OUT = 152  # and gives: 4 rates, 15 outputs, then 7 columns of 4 and 15


class Bundle:
    """Equations of one driveline with fixed joint angles.

    Parameters
    ----------
    state : bytes
        From `Driveline.get_state`: only parameters and joint angles are taken.

    Attributes
    ----------
    evaluations : float
        Counter.
    """

    def __init__(self, state):
        self.stepper = Stepper()
        memoryview(self.stepper.store).cast("B")[:] = state
        self.motion = self.stepper.motion
        self.tangent = self.stepper.tangent
        self.law_in = Law()
        self.law_out = Law()
        self.kinds = [0] * 7
        self.count = 0
        self.column = [0.0] * 19
        self.evaluations = 0.0
        self.stale = True

    def put(self, reference, value):
        """Set a parameter or a joint angle by value reference."""
        self.stepper.z[VARS + reference] = value
        self.stale = True

    def load(self, output, c0, c1, c2):
        """Set the torque c0 + c1 w + c2 w |w| of the drive, or of the load where `output` is true."""
        law = self.law_out if output else self.law_in
        law.polynomial(c0, c1, c2)

    def load_series(self, output, order, rest, gain):
        """Add R(p) + K(p) w to that torque; see `Law.series`. Empty lists take it away."""
        law = self.law_out if output else self.law_in
        law.series(order, rest, gain)

    def prepare(self):
        """Take parameters, joint angles and constant parts of the torques into the equations."""
        z = self.stepper.z
        if self.stale:
            self.stepper.configure()
            self.motion.swing(z[BEND1], 0.0, 0.0, z[BEND2], 0.0, 0.0)
            self.stale = False
        self.law_in.by_angle = 0.0
        self.law_out.by_angle = 0.0
        self.motion.hold_in.line(self.law_in.c0, 0.0, self.law_in.c1, 0.0)
        self.motion.hold_out.line(self.law_out.c0, 0.0, self.law_out.c1, 0.0)

    def torques(self, s, p, twist, w1, wy):
        """Put the torques at an instant, and how they follow the speeds, into the equations."""
        m = self.motion
        law_in = self.law_in
        law_out = self.law_out
        if m.driven:
            p = m.p0 + s * m.v0
        if not law_in.plain:
            law_in.take(p, w1)
            m.hold_in.c0 = law_in.value - law_in.slope * w1
            m.hold_in.slope = law_in.slope
        if not law_out.plain:
            m.turn(p, twist)
            w3 = m.joint2.r * (m.joint1.r * w1 if m.rigid else wy)
            law_out.take(p, w3)
            m.hold_out.c0 = law_out.value - law_out.slope * w3
            m.hold_out.slope = law_out.slope

    def slopes(self, s, y, f, place):
        """Write the derivatives of `y`, states and columns, at the time `s` (s) to ``f[place:]``."""
        m = self.motion
        t = self.tangent
        if not (self.law_in.plain and self.law_out.plain):
            self.torques(s, y[0], y[1], y[2], y[3])
        m.evaluate(s, y[0], y[1], y[2], y[3])
        f[place] = m.w1
        f[place + 2] = m.dw1
        if m.rigid:
            f[place + 1] = 0.0
            f[place + 3] = 0.0
        else:
            f[place + 1] = m.wa - m.wy
            f[place + 3] = m.dwy
        self.evaluations += 1.0
        if self.count == 0:
            return
        t.take()
        for j in range(self.count):
            o = 4 + 4 * j
            kind = self.kinds[j]
            t.along(y[o], y[o + 1], y[o + 2], y[o + 3], self.law_in.by_angle * y[o] + (1.0 if kind == 4 else 0.0),
                    self.law_out.by_angle * y[o] + (1.0 if kind == 5 else 0.0), 1.0 if kind == 6 else 0.0)
            t.state_column(f, place + o)
            if m.rigid:
                f[place + o + 3] = 0.0

    def fields(self, points, values, count):
        """Evaluate the equations and their exact Jacobians at many points at once.

        Parameters
        ----------
        points : buffer of float, shape (count, 9)
            p, twist (rad), w1, wy (rad/s), drive torque (N.m) and its partial derivatives by speed and by p, load
            torque (N.m) and its partial derivative by speed. Where the speed is prescribed it is w1 there.
        values : buffer of float, shape (count, 152)
            Takes per point the rates of the four states, the ``JACOBIAN_OUTPUTS``, and for each of the seven
            directions the changes of both.
        """
        m = self.motion
        t = self.tangent
        self.prepare()
        for i in range(count):
            a = POINT_IN * i
            o = POINT_OUT * i
            m.steer(points[a], points[a + 2], 0.0, 0.0)
            m.hold_in.slope = 0.0
            m.hold_in.c0 = points[a + 4]
            m.hold_out.slope = 0.0
            m.hold_out.c0 = points[a + 7]
            m.evaluate(0.0, points[a], points[a + 1], points[a + 2], points[a + 3])
            m.hold_in.slope = points[a + 5]
            m.hold_out.slope = points[a + 8]
            values[o] = m.w1
            values[o + 1] = 0.0 if m.rigid else m.wa - m.wy
            values[o + 2] = m.dw1
            values[o + 3] = m.dwy
            values[o + 4] = m.p
            values[o + 5] = m.w1
            values[o + 6] = m.dw1
            values[o + 7] = m.tin
            values[o + 8] = m.p + (m.joint1.lead() - m.twist + m.joint2.lead())
            values[o + 9] = m.w3
            values[o + 10] = m.dw3
            values[o + 11] = m.ts
            values[o + 12] = m.twist
            values[o + 13] = m.wa
            values[o + 14] = m.wy
            values[o + 15] = m.tin - m.j1 * m.dw1 - m.c_in * m.w1
            values[o + 16] = m.ts + m.j2a * m.dwa
            values[o + 17] = m.ts - m.j2b * m.dwy
            values[o + 18] = m.tout + m.c_out * m.w3 + m.j3 * m.dw3
            t.take()
            for j in range(7):
                o += 19
                t.along(1.0 if j == 0 else 0.0, 1.0 if j == 1 else 0.0, 1.0 if j == 2 else 0.0, 1.0 if j == 3 else 0.0,
                        points[a + 6] if j == 0 else (1.0 if j == 4 else 0.0), 1.0 if j == 5 else 0.0,
                        1.0 if j == 6 else 0.0)
                t.state_column(self.column, 0)
                t.output_column(self.column, 4)
                for k in range(19):
                    values[o + k] = self.column[k]
        self.evaluations += count
