"""Equations of motion of the driveline (docs/PHYSICS.md section 3).

Input inertia J1 - joint 1 - shaft half a - spring k, damper d - shaft half b - joint 2 - output
inertia J3. States: p (input shaft angle), twist, w1 (input speed) and wy (speed of half b). In the
rigid model the halves are one, so twist = 0 and wy = wa; with a prescribed input speed p and w1 are
known functions of time.
"""

from math import cos, sin, sqrt

from .hold import Hold
from .joint import INFINITE_TIME, Joint


class Motion:
    """The driveline at an instant: `evaluate` finds speeds, torques and accelerations.

    Attributes
    ----------
    w1, wa, wy, w3 : float
        Speeds of input, half a, half b, output, rad/s.
    dw1, dwa, dwy, dw3 : float
        Their accelerations, rad/s2.
    ts, tin, tout : float
        Torque of the shaft, of the drive (the reaction where speed is prescribed), of the load, N.m.
    net_power : float
        Rate of the stored energy, W: supplied less delivered less lost, with the work of moving the
        joint angles.
    """

    def __init__(self):
        self.joint1 = Joint()
        self.joint2 = Joint()
        self.hold_in = Hold()
        self.hold_out = Hold()
        self.rigid = False
        self.driven = False
        self.moving = False
        self.straight1 = True
        self.straight2 = True
        self.j1 = 1.0
        self.j2a = 0.0
        self.j2b = 0.0
        self.j3 = 1.0
        self.k = 0.0
        self.d = 0.0
        self.c_in = 0.0
        self.c_out = 0.0
        self.offset = 0.0
        self.w1 = self.wa = self.wy = self.w3 = 0.0
        self.dw1 = self.dwa = self.dwy = self.dw3 = 0.0
        self.ts = self.tin = self.tout = self.net_power = 0.0
        self.p = self.twist = 0.0
        self.m1 = self.m2 = 1.0
        self.before = self.behind = 0.0
        self.bias1 = self.bias2 = 0.0
        self.steer(0.0, 0.0, 0.0, 0.0)
        self.a0 = self.a1 = self.a2 = 0.0
        self.b0 = self.b1 = self.b2 = 0.0

    def steer(self, p0, v0, v1, v2):
        """Prescribe the input speed v0 + v1 s + v2 s^2/2 (rad/s) from the angle p0 (rad)."""
        self.p0 = p0
        self.v0 = v0
        self.v1 = v1
        self.v2 = v2

    def swing(self, a0, a1, a2, b0, b1, b2):
        """Set both joint angles over the step: a0 + a1 s + a2 s^2/2 and b0 + b1 s + b2 s^2/2 (rad)."""
        if (a0 == self.a0 and a1 == self.a1 and a2 == self.a2 and b0 == self.b0 and b1 == self.b1 and b2 == self.b2
                and not self.moving):
            return
        self.a0 = a0
        self.a1 = a1
        self.a2 = a2
        self.b0 = b0
        self.b1 = b1
        self.b2 = b2
        self.moving = a1 != 0.0 or a2 != 0.0 or b1 != 0.0 or b2 != 0.0
        self.straight1 = a0 == 0.0 and a1 == 0.0 and a2 == 0.0
        self.straight2 = b0 == 0.0 and b1 == 0.0 and b2 == 0.0
        self.bend(0.0)
        if self.straight1:
            self.joint1.turn(0.0, 1.0)
        if self.straight2:
            self.joint2.turn(0.0, 1.0)

    def unbend(self):
        """Forget the joint angles, so that the next `swing` sets them anew."""
        self.a0 = -1.0

    def bend(self, s):
        """Bend both joints as they are at the time `s` (s) of the step."""
        self.joint1.bend(self.a0 + s * (self.a1 + 0.5 * s * self.a2), self.a1 + s * self.a2, self.a2)
        self.joint2.bend(self.b0 + s * (self.b1 + 0.5 * s * self.b2), self.b1 + s * self.b2, self.b2)

    def turn(self, p, twist):
        """Turn both joints: input shaft at `p` (rad), shaft twisted by `twist` (rad).

        With phi_a the output angle of joint 1, sin phi_a = sin p / sqrt(D) and cos phi_a = c cos p / sqrt(D);
        joint 2's input trunnion stands at x = phi_a - twist + psi - theta + 90 deg.
        """
        self.p = p
        self.twist = twist
        if self.straight1 and self.straight2:
            return
        sp = sin(p)
        cp = cos(p)
        one = self.joint1
        if not self.straight1:
            one.turn(sp, cp)
        if not self.straight2:
            root = sqrt(one.D)
            sa = sp / root
            ca = one.c * cp / root
            alpha = self.offset - twist
            sd = sin(alpha)
            cd = cos(alpha)
            self.joint2.turn(ca * cd - sa * sd, -(sa * cd + ca * sd))

    def evaluate(self, s, p, twist, w1, wy):
        """Evaluate everything at the time `s` of the step and the states p, twist, w1, wy."""
        one = self.joint1
        two = self.joint2
        if self.moving:
            self.bend(s)
        if self.driven:
            p = self.p0 + s * (self.v0 + s * (0.5 * self.v1 + s * self.v2 / 6.0))
            w1 = self.v0 + s * (self.v1 + 0.5 * s * self.v2)
            self.dw1 = self.v1 + s * self.v2
        self.turn(p, twist)
        r1 = one.r
        r2 = two.r
        wa = r1 * w1 + one.g * one.beta1
        if self.rigid:
            wy = wa
        w3 = r2 * wy + two.g * two.beta1
        self.bias1 = one.bias(w1)
        self.bias2 = two.bias(wy)
        if one.rough:
            one.friction(w1)
        if two.rough:
            two.friction(wy)
        tin = self.hold_in.rest(s) + self.hold_in.slope * w1
        tout = self.hold_out.rest(s) + self.hold_out.slope * w3
        # Inertia and resisting torque in front of half a and behind the spring, at zero acceleration.
        self.m1 = self.j1 + one.jc
        self.before = 0.5 * one.jcp * w1 * w1 + one.drag + self.c_in * w1
        self.m2 = self.j2b + two.jc + self.j3 * r2 * r2
        self.behind = 0.5 * two.jcp * wy * wy + two.drag + r2 * (self.j3 * self.bias2 + tout + self.c_out * w3)
        if self.rigid:
            m = self.j2a + self.m2
            if not self.driven:
                self.dw1 = (tin - self.before - r1 * (m * self.bias1 + self.behind)) / (self.m1 + m * r1 * r1)
            self.dwa = r1 * self.dw1 + self.bias1
            self.dwy = self.dwa
            self.ts = self.m2 * self.dwy + self.behind
        else:
            self.ts = self.k * twist + self.d * (wa - wy)
            self.dwy = (self.ts - self.behind) / self.m2
            if not self.driven:
                self.dw1 = (tin - self.before - r1 * (self.j2a * self.bias1 + self.ts)) / (self.m1 + self.j2a * r1 * r1)
            self.dwa = r1 * self.dw1 + self.bias1
        self.dw3 = r2 * self.dwy + self.bias2
        if self.driven:
            tin = self.m1 * self.dw1 + self.before + r1 * (self.j2a * self.dwa + self.ts)
        self.w1 = w1
        self.wa = wa
        self.wy = wy
        self.w3 = w3
        self.tin = tin
        self.tout = tout
        slip = wa - wy
        self.net_power = (w1 * (tin - self.c_in * w1 - one.drag) - w3 * (tout + self.c_out * w3)
                          - self.d * slip * slip - two.drag * wy)
        if self.moving:
            self.net_power += (
                one.beta1 * (one.g * (self.ts + self.j2a * self.dwa) + 0.5 * one.jcb * w1 * w1)
                + two.beta1 * (two.g * (tout + self.c_out * w3 + self.j3 * self.dw3) + 0.5 * two.jcb * wy * wy)
            )

    def derivative(self, s, y, dy, place):
        """Write the derivative of y = (p, twist, w1, wy) and the net power to ``dy[place:place + 5]``."""
        self.evaluate(s, y[0], y[1], y[2], y[3])
        dy[place + 1] = 0.0
        if self.driven:
            dy[place] = 0.0
            dy[place + 2] = 0.0
        else:
            dy[place] = self.w1
            dy[place + 2] = self.dw1
        if self.rigid:
            dy[place + 3] = 0.0
        else:
            dy[place + 1] = self.wa - self.wy
            dy[place + 3] = self.dwy
        dy[place + 4] = self.net_power

    def reach(self):
        """Time (s) over which Coulomb friction of both joints stays smooth; see `Joint.reach`."""
        longest = INFINITE_TIME
        if self.joint1.coulomb != 0.0 and self.joint1.s > 0.0:
            longest = self.joint1.reach(self.w1, self.dw1)
        if self.joint2.coulomb != 0.0 and self.joint2.s > 0.0:
            other = self.joint2.reach(self.wy, self.dwy)
            if other < longest:
                longest = other
        return longest

    def loss(self):
        """Power lost in bearings, shaft and trunnions, W."""
        slip = self.wa - self.wy
        return (self.c_in * self.w1 * self.w1 + self.c_out * self.w3 * self.w3 + self.d * slip * slip
                + self.joint1.drag_power + self.joint2.drag_power)

    def kinetic(self):
        """Kinetic energy, J."""
        return 0.5 * ((self.j1 + self.joint1.jc) * self.w1 * self.w1 + self.j2a * self.wa * self.wa
                      + (self.j2b + self.joint2.jc) * self.wy * self.wy + self.j3 * self.w3 * self.w3)

    def strain(self):
        """Strain energy of the shaft, J."""
        return 0.5 * self.k * self.twist * self.twist

    def frequency(self):
        """Natural frequency of the shaft with the joints straight, rad/s; an upper bound of the time scale."""
        if self.rigid:
            return 0.0
        behind = self.j2b + self.j3
        before = self.j1 + self.j2a
        stiffness = self.k / behind
        damping = self.d / behind
        if not self.driven:
            stiffness += self.k / before
            damping += self.d / before
        fast = sqrt(stiffness)
        return fast if fast > damping else damping
