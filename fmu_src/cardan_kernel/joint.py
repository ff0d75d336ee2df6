"""One universal joint: kinematics, cross inertia and trunnion friction at a given angle.

Symbols and signs are those of docs/PHYSICS.md, sections 1 and 2: beta is the bend angle, p the angle
of the input trunnion from the joint plane, c = cos beta, s = sin beta, D = c^2 cos^2 p + sin^2 p
(which is 1 - s^2 cos^2 p without its cancellation near 90 deg).
"""

from math import atan2, cos, fabs, sin, sqrt

# Coulomb friction is smoothed over this trunnion rate, rad/s: M = M_f rate / sqrt(rate^2 + RATE^2).
SMOOTHING_RATE = 0.01
INFINITE_TIME = 1e300


class Joint:
    """A universal joint; `bend` sets its bend angle, `turn` its rotation, `friction` its speed.

    Attributes
    ----------
    beta, beta1, beta2 : float
        Bend angle and its first two time derivatives, rad, rad/s, rad/s2.
    r, rp : float
        Speed ratio d phi_out / d p and its derivative by p.
    g : float
        d phi_out / d beta: output speed per rate of the bend angle.
    rb, gb : float
        Derivatives of r and g by beta.
    jc, jcp, jcb : float
        Cross inertia referred to the input shaft and its derivatives by p and beta, kg.m2.
    rate_a, rate_b : float
        Rates of the cross about its input and output trunnion, rad/s.
    drag, drag_power : float
        Trunnion friction torque on the input shaft, N.m, and its power, W.
    """

    def __init__(self):
        self.rate_a = 0.0
        self.rate_b = 0.0
        self.equip(0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
        self.bend(0.0, 0.0, 0.0)
        self.turn(0.0, 1.0)

    def equip(self, inertia_a, inertia_b, inertia_m, damping_a, damping_b, coulomb):
        """Set cross inertias (kg.m2), trunnion damping (N.m.s/rad) and Coulomb moment (N.m)."""
        self.inertia_a = inertia_a
        self.inertia_b = inertia_b
        self.inertia_m = inertia_m
        self.damping_a = damping_a
        self.damping_b = damping_b
        self.coulomb = coulomb
        self.crossed = inertia_a != 0.0 or inertia_b != 0.0 or inertia_m != 0.0
        self.jc = 0.0
        self.jcp = 0.0
        self.jcb = 0.0
        self.rough = damping_a != 0.0 or damping_b != 0.0 or coulomb != 0.0
        self.drag = 0.0
        self.drag_power = 0.0

    def bend(self, beta, beta1, beta2):
        """Set the bend angle (rad) and its first two time derivatives (rad/s, rad/s2)."""
        self.beta = beta
        self.beta1 = beta1
        self.beta2 = beta2
        self.swinging = beta1 != 0.0 or beta2 != 0.0
        self.rb = 0.0
        self.gb = 0.0
        self.c = cos(beta)
        self.s = sin(beta)
        half = sin(0.5 * beta)
        self.versine = 2.0 * half * half

    def turn(self, sp, cp):
        """Evaluate the joint at the angle p with sine `sp` and cosine `cp` (PHYSICS.md section 2)."""
        c = self.c
        s = self.s
        self.sp = sp
        self.cp = cp
        if s == 0.0:
            self.D = 1.0
        else:
            self.D = c * c * cp * cp + sp * sp
        over = 1.0 / self.D
        both = sp * cp * over
        self.r = c * over
        self.rp = -2.0 * c * s * s * both * over
        self.g = s * both
        if self.swinging:
            self.rb = s * (c * c * cp * cp - sp * sp) * over * over
            self.gb = c * both * over * (1.0 + s * s * cp * cp)
        if self.crossed:
            self._turn_cross(sp, cp, self.D * self.D)

    def _turn_cross(self, sp, cp, d2):
        c = self.c
        s = self.s
        D = self.D
        plane = self.inertia_b * s * s * sp * sp + self.inertia_m * c * c
        top = self.inertia_a * s * s * c * c * cp * cp + plane * D
        dD = 2.0 * s * s * sp * cp
        dtop = 2.0 * sp * cp * s * s * (self.inertia_b * D - self.inertia_a * c * c) + plane * dD
        self.jc = top / d2
        self.jcp = (dtop - 2.0 * top * dD / D) / d2
        bD = -2.0 * s * c * cp * cp
        btop = 2.0 * s * c * (self.inertia_a * cp * cp * (c * c - s * s)
                              + (self.inertia_b * sp * sp - self.inertia_m) * D) + plane * bD
        self.jcb = (btop - 2.0 * top * bD / D) / d2

    def bias(self, w):
        """Output acceleration (rad/s2) at input speed `w` (rad/s) and zero input acceleration."""
        if not self.swinging:
            return self.rp * w * w
        b1 = self.beta1
        return self.rp * w * w + (2.0 * self.rb * w + self.gb * b1) * b1 + self.g * self.beta2

    def slide(self, w):
        """Evaluate the cross rates (rad/s) at input speed `w` (rad/s)."""
        root = sqrt(self.D)
        self.along_a = self.r * self.s * self.cp
        self.along_b = self.s * self.sp / root
        self.rate_a = self.along_a * w + self.sp / self.D * self.beta1
        self.rate_b = self.along_b * w - self.c * self.cp / root * self.beta1

    def friction(self, w):
        """Evaluate trunnion friction at input speed `w` (rad/s): `drag` and `drag_power`."""
        self.slide(w)
        a = self.rate_a
        b = self.rate_b
        moment_a = self.damping_a * a
        moment_b = self.damping_b * b
        if self.coulomb != 0.0:
            moment_a += self.coulomb * a / sqrt(a * a + SMOOTHING_RATE * SMOOTHING_RATE)
            moment_b += self.coulomb * b / sqrt(b * b + SMOOTHING_RATE * SMOOTHING_RATE)
        self.drag = moment_a * self.along_a + moment_b * self.along_b
        self.drag_power = moment_a * a + moment_b * b

    def reach(self, w, dw):
        """Time (s) over which Coulomb friction stays smooth at the speed `w` and acceleration `dw`.

        A trunnion rate changes sign at every quarter turn and where the shaft reverses. Seen from here the
        nearest singularity of the smoothed law lies at that distance, or at the smoothing width sideways;
        a step of the order of this radius is resolved, a longer one would step over the reversal and its
        error estimate could miss it. Leaving a reversal twice the distance is still safe.
        """
        speed = fabs(w)
        width = SMOOTHING_RATE / self.s
        if speed == 0.0:
            turning = INFINITE_TIME
        else:
            leaving = self.sp * self.cp * w > 0.0
            near = fabs(self.sp)
            if fabs(self.cp) < near:
                near = fabs(self.cp)
                leaving = not leaving
            turning = sqrt(near * near + (width / speed) * (width / speed)) / speed
            turning *= 2.0 if leaving else 0.8
        if dw == 0.0:
            return turning
        reversing = sqrt(speed * speed + width * width) / fabs(dw)
        reversing *= 2.0 if w * dw > 0.0 else 0.8
        return turning if turning < reversing else reversing

    def lead(self):
        """phi_out - p, rad: bounded, continuous over any number of turns."""
        return atan2(self.versine * self.sp * self.cp, self.c * self.cp * self.cp + self.sp * self.sp)

    def couple_in(self, torque):
        """Secondary couple (N.m) on the input shaft for the torque (N.m) entering the joint."""
        return torque * self.s / self.c * self.sp

    def couple_out(self, torque):
        """Secondary couple (N.m) on the output shaft for the torque (N.m) leaving the joint."""
        return torque * self.s * self.cp / sqrt(self.D)

    def trunnion_force(self, torque_in, torque_out, radius):
        """Force (N) on each trunnion at the lever `radius` (m); the larger of both pairs.

        The couple across a trunnion pair is the shaft torque with its secondary couple:
        T sqrt(1 + tan^2 beta sin^2 p), at most T / cos beta (Ivanovic et al., corrected in PHYSICS.md 5).
        """
        t = self.s / self.c
        a = t * self.sp
        b = self.s * self.cp
        into = fabs(torque_in) * sqrt(1.0 + a * a)
        out = fabs(torque_out) * sqrt(1.0 + b * b / self.D)
        return (into if into > out else out) / (2.0 * radius)
