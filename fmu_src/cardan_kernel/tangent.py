"""Exact Jacobians of the equations of motion.

`Tangent.along` follows `Motion.evaluate` line by line and gives the change of every quantity along one
direction of states and inputs; the unit directions give A, B, C and D.
"""

from .bends import Bends


class Tangent:
    """Change of an evaluated `Motion` along a direction.

    Attributes
    ----------
    dwa, dwy, dw3 : float
        Changes of the speeds of half a, half b and output, rad/s.
    adw1, adwa, adwy, adw3 : float
        Changes of the accelerations, rad/s2.
    dts, dtin, dtout : float
        Changes of shaft torque, drive torque (reaction where speed is prescribed) and load, N.m.
    dangle : float
        Change of the output angle, rad.
    """

    def __init__(self, motion):
        self.motion = motion
        self.bends1 = Bends()
        self.bends2 = Bends()
        self.dp = self.dtwist = self.dw1 = 0.0
        self.dwa = self.dwy = self.dw3 = self.dangle = 0.0
        self.adw1 = self.adwa = self.adwy = self.adw3 = 0.0
        self.dts = self.dtin = self.dtout = 0.0

    def take(self):
        """Prepare at the state that `motion` was last evaluated at."""
        m = self.motion
        self.bends1.take(m.joint1, m.w1)
        self.bends2.take(m.joint2, m.wy)

    def along(self, dp, dtwist, dw1, dwy, dtin, dtout, adw1):
        """Go along a direction.

        Parameters
        ----------
        dp, dtwist, dw1, dwy : float
            Changes of the states: input angle, twist (rad), input speed, speed of half b (rad/s).
            Twist and wy of a rigid driveline follow from the others.
        dtin, dtout : float
            Changes of input torque and load torque at constant speeds, N.m.
        adw1 : float
            Change of the input acceleration where the speed is prescribed, rad/s2.
        """
        m = self.motion
        one = m.joint1
        two = m.joint2
        r1 = one.r
        r2 = two.r
        if m.rigid:
            dtwist = 0.0
        dr1 = one.rp * dp
        dwa = dr1 * m.w1 + r1 * dw1 + one.rb * one.beta1 * dp
        if m.rigid:
            dwy = dwa
        dx = r1 * dp - dtwist
        dr2 = two.rp * dx
        dw3 = dr2 * m.wy + r2 * dwy + two.rb * two.beta1 * dx
        dbias1 = self.bends1.bias_p * dp + self.bends1.bias_w * dw1
        dbias2 = self.bends2.bias_p * dx + self.bends2.bias_w * dwy
        dtin = dtin + m.hold_in.slope * dw1
        dtout = dtout + m.hold_out.slope * dw3
        dm1 = one.jcp * dp
        dm2 = two.jcp * dx + 2.0 * m.j3 * r2 * dr2
        dbefore = ((0.5 * self.bends1.jcpp * m.w1 * m.w1 + self.bends1.drag_p) * dp
                   + (one.jcp * m.w1 + self.bends1.drag_w + m.c_in) * dw1)
        dbehind = ((0.5 * self.bends2.jcpp * m.wy * m.wy + self.bends2.drag_p) * dx
                   + (two.jcp * m.wy + self.bends2.drag_w) * dwy
                   + dr2 * (m.j3 * m.bias2 + m.tout + m.c_out * m.w3)
                   + r2 * (m.j3 * dbias2 + dtout + m.c_out * dw3))
        if m.rigid:
            mass = m.j2a + m.m2
            if not m.driven:
                adw1 = (dtin - dbefore - dr1 * (mass * m.bias1 + m.behind)
                        - r1 * (dm2 * m.bias1 + mass * dbias1 + dbehind)
                        - m.dw1 * (dm1 + dm2 * r1 * r1 + 2.0 * mass * r1 * dr1)) / (m.m1 + mass * r1 * r1)
            adwa = dr1 * m.dw1 + r1 * adw1 + dbias1
            adwy = adwa
            dts = dm2 * m.dwy + m.m2 * adwy + dbehind
        else:
            dts = m.k * dtwist + m.d * (dwa - dwy)
            adwy = (dts - dbehind - m.dwy * dm2) / m.m2
            if not m.driven:
                adw1 = (dtin - dbefore - dr1 * (m.j2a * m.bias1 + m.ts) - r1 * (m.j2a * dbias1 + dts)
                        - m.dw1 * (dm1 + 2.0 * m.j2a * r1 * dr1)) / (m.m1 + m.j2a * r1 * r1)
            adwa = dr1 * m.dw1 + r1 * adw1 + dbias1
        if m.driven:
            dtin = (dm1 * m.dw1 + m.m1 * adw1 + dbefore + dr1 * (m.j2a * m.dwa + m.ts)
                    + r1 * (m.j2a * adwa + dts))
        self.dp = dp
        self.dtwist = dtwist
        self.dw1 = dw1
        self.dwa = dwa
        self.dwy = dwy
        self.dw3 = dw3
        self.adw1 = adw1
        self.adwa = adwa
        self.adwy = adwy
        self.adw3 = dr2 * m.dwy + r2 * adwy + dbias2
        self.dts = dts
        self.dtin = dtin
        self.dtout = dtout
        self.dangle = r2 * dx

    def state_column(self, column, place):
        """Write the change of (p', twist', w1', wy') into ``column[place:place + 4]``."""
        column[place] = self.dw1
        column[place + 1] = 0.0 if self.motion.rigid else self.dwa - self.dwy
        column[place + 2] = self.adw1
        column[place + 3] = self.adwy

    def output_column(self, column, place):
        """Write the changes of the outputs, ordered as `JACOBIAN_OUTPUTS`, into ``column[place:place + 15]``."""
        m = self.motion
        column[place] = self.dp
        column[place + 1] = self.dw1
        column[place + 2] = self.adw1
        column[place + 3] = self.dtin
        column[place + 4] = self.dangle
        column[place + 5] = self.dw3
        column[place + 6] = self.adw3
        column[place + 7] = self.dts
        column[place + 8] = self.dtwist
        column[place + 9] = self.dwa
        column[place + 10] = self.dwy
        column[place + 11] = self.dtin - m.j1 * self.adw1 - m.c_in * self.dw1
        column[place + 12] = self.dts + m.j2a * self.adwa
        column[place + 13] = self.dts - m.j2b * self.adwy
        column[place + 14] = self.dtout + m.c_out * self.dw3 + m.j3 * self.adw3


JACOBIAN_STATES = ("input.angle", "shaft.twist", "input.speed", "shaft.speed_b")
JACOBIAN_INPUTS = ("input.torque", "output.torque", "input.acceleration")
JACOBIAN_OUTPUTS = (
    "input.angle", "input.speed", "input.acceleration", "input.reaction_torque", "output.angle", "output.speed",
    "output.acceleration", "shaft.torque", "shaft.twist", "shaft.speed_a", "shaft.speed_b", "joint1.torque_in",
    "joint1.torque_out", "joint2.torque_in", "joint2.torque_out",
)
