"""Derivatives of a joint's ratio, cross inertia and friction by its angle, for exact Jacobians.

All are derivatives by hand of the expressions in `joint` (docs/PHYSICS.md section 2), taken at the
angle, speed and bend that the joint was last evaluated at.
"""

from math import sqrt

from .joint import SMOOTHING_RATE


class Bends:
    """How one joint's quantities change with p and with its input speed w.

    Attributes
    ----------
    bias_p, bias_w : float
        Derivatives of `Joint.bias` by p and w, rad/s2 per rad and per rad/s.
    jcpp : float
        Second derivative of the cross inertia by p, kg.m2.
    drag_p, drag_w : float
        Derivatives of the friction torque by p (N.m/rad) and w (N.m.s/rad).
    """

    def __init__(self):
        self.bias_p = 0.0
        self.bias_w = 0.0
        self.jcpp = 0.0
        self.drag_p = 0.0
        self.drag_w = 0.0

    def take(self, joint, w):
        """Evaluate at the state of `joint` and the speed `w` (rad/s) of its input shaft."""
        c = joint.c
        s = joint.s
        sp = joint.sp
        cp = joint.cp
        D = joint.D
        d2 = D * D
        d3 = d2 * D
        both = sp * cp
        s2 = s * s
        twice = cp * cp - sp * sp
        dD = 2.0 * s2 * both
        b1 = joint.beta1
        rpp = -2.0 * c * s2 * twice / d2 + 8.0 * c * s2 * s2 * both * both / d3
        rbp = -2.0 * s * both * ((1.0 + c * c) / d2 + 2.0 * s2 * (c * c * cp * cp - sp * sp) / d3)
        swell = 1.0 + s2 * cp * cp
        gbp = c * (twice * swell - 2.0 * s2 * both * both) / d2 - 4.0 * c * s2 * both * both * swell / d3
        self.bias_p = rpp * w * w + (2.0 * rbp * w + gbp * b1) * b1 + joint.rb * joint.beta2
        self.bias_w = 2.0 * (joint.rp * w + joint.rb * b1)
        self.jcpp = 0.0
        if joint.crossed:
            ddD = 2.0 * s2 * twice
            plane = joint.inertia_b * s2 * sp * sp + joint.inertia_m * c * c
            lean = joint.inertia_b * D - joint.inertia_a * c * c
            top = joint.inertia_a * s2 * c * c * cp * cp + plane * D
            dtop = 2.0 * both * s2 * lean + plane * dD
            ddtop = 2.0 * s2 * (twice * lean + 2.0 * both * joint.inertia_b * dD) + plane * ddD
            self.jcpp = (ddtop - (4.0 * dtop * dD + 2.0 * top * ddD) / D + 6.0 * top * dD * dD / d2) / d2
        self.drag_p = 0.0
        self.drag_w = 0.0
        if joint.rough:
            self.take_friction(joint, w, dD)

    def take_friction(self, joint, w, dD):
        """Derivatives of the trunnion friction, with dD = dD/dp."""
        D = joint.D
        root = sqrt(D)
        sp = joint.sp
        cp = joint.cp
        b1 = joint.beta1
        a = joint.rate_a
        b = joint.rate_b
        moment_a = joint.damping_a * a
        moment_b = joint.damping_b * b
        slope_a = joint.damping_a
        slope_b = joint.damping_b
        if joint.coulomb != 0.0:
            v2 = SMOOTHING_RATE * SMOOTHING_RATE
            size_a = sqrt(a * a + v2)
            size_b = sqrt(b * b + v2)
            moment_a += joint.coulomb * a / size_a
            moment_b += joint.coulomb * b / size_b
            slope_a += joint.coulomb * v2 / (size_a * size_a * size_a)
            slope_b += joint.coulomb * v2 / (size_b * size_b * size_b)
        along_a = joint.along_a
        along_b = joint.along_b
        along_ap = joint.s * (joint.rp * cp - joint.r * sp)
        along_bp = joint.s * (cp - 0.5 * sp * dD / D) / root
        a_p = along_ap * w + (cp - sp * dD / D) / D * b1
        b_p = along_bp * w + joint.c * (sp + 0.5 * cp * dD / D) / root * b1
        self.drag_p = slope_a * a_p * along_a + moment_a * along_ap + slope_b * b_p * along_b + moment_b * along_bp
        self.drag_w = slope_a * along_a * along_a + slope_b * along_b * along_b
