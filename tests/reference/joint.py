"""One Cardan joint from the geometry of its cross, in vectors, without the formulas of docs/PHYSICS.md section 2.

In the frame ``(u, n, e1)`` -- e1 the input shaft, n the plane normal, u = n x e1 -- the input trunnion is
``a = (cos p, sin p, 0)`` and the output shaft ``e2 = (sin beta, 0, cos beta)``. The output trunnion is normal
to both a and e2, ``b = e2 x a``, and ``m = a x b``. Yoke 2 turns relative to yoke 1 only about a and b, so

    (w_out e2 + beta' n - w_in e1) . m = 0,

which gives w_out, and its components on a and on b are the relative rates of the cross.
"""

from __future__ import annotations

from typing import NamedTuple

from tests.reference.arithmetic import Arithmetic, Number
from tests.reference.dual import Dual, cos_sin

FRICTION_SPEED = 0.01
"""Relative rate in rad/s over which Coulomb friction is smoothed: M_f rate / sqrt(rate^2 + v^2)."""


class Trunnions(NamedTuple):
    """Cross inertias about a, b, m in kg.m2; viscous dampings in N.m.s/rad; Coulomb torque in N.m."""

    inertia_a: Number
    inertia_b: Number
    inertia_m: Number
    damping_a: Number
    damping_b: Number
    friction: Number


class Bend(NamedTuple):
    """Joint angle in rad, its rate in rad/s and its acceleration in rad/s2."""

    angle: Number
    rate: Number
    acceleration: Number


class JointMotion(NamedTuple):
    """What one joint contributes to the equations of motion at one instant."""

    ratio: Number              # d w_out / d w_in
    swing: Number              # d w_out / d beta'
    speed: Number              # w_out in rad/s
    steady: Number             # w_out' in rad/s2 while w_in' = 0
    inertia: Number            # Jc in kg.m2
    inertia_slope: Number      # dJc/dp in kg.m2/rad at the momentary joint angle
    resistance: Number         # trunnion friction as a torque on the input shaft, in N.m
    resistance_bend: Number    # the same as a torque on the joint angle, in N.m
    dissipation: Number        # W
    rate_a: Number             # relative rate about the input trunnion in rad/s
    rate_b: Number             # about the output trunnion


def output_angle(p: Number, beta: Number, arithmetic: Arithmetic) -> Number:
    """Return the angle of the output trunnion from n in rad, continuous over any number of turns."""
    cp, sp = arithmetic.cos_sin(p)
    c, _ = arithmetic.cos_sin(beta)
    # b has the components c cp on n and sp on e2 x n, up to its length; its angle less p is within a quarter turn.
    return p + arithmetic.atan((1 - c) * sp * cp / (c * cp * cp + sp * sp))


def cross_inertia(p: Dual, beta: Dual, trunnions: Trunnions, arithmetic: Arithmetic) -> Dual:
    """Return Jc = sum of J_i (omega_i / w_in)^2 over the cross's own axes, in kg.m2."""
    cp, sp = cos_sin(p, arithmetic)
    c, s = cos_sin(beta, arithmetic)
    length = c.square() + (s * sp).square()                        # |b|^2 = |m|^2
    on_a = c * s * cp / length                                     # w_out e2.a / w_in
    on_b = (s * sp).square() / length                              # (e1.b)^2 / |b|^2
    on_m = c.square() / length                                     # (e1.m)^2 / |m|^2
    inertia: Dual = on_a.square() * trunnions.inertia_a + on_b * trunnions.inertia_b + on_m * trunnions.inertia_m
    return inertia


def joint_motion(p: Number, w: Number, bend: Bend, trunnions: Trunnions, arithmetic: Arithmetic) -> JointMotion:
    """Return the motion of a joint whose input trunnion stands at `p` rad and turns at `w` rad/s.

    Time derivatives are the dual parts: p carries w, the joint angle carries its rate, the rate its acceleration.
    """
    zero = p * 0
    cp, sp = cos_sin(Dual(p, w), arithmetic)
    c, s = cos_sin(Dual(bend.angle, bend.rate), arithmetic)
    e2_m = c.square() + (s * sp).square()
    n_m = -(s * cp * sp)
    speed = (c * w - n_m * Dual(bend.rate, bend.acceleration)) / e2_m

    length = arithmetic.sqrt(e2_m.value)                           # |b|, the square root of the same number
    ratio, swing = c.value / e2_m.value, -n_m.value / e2_m.value
    rate_a = speed.value * s.value * cp.value + bend.rate * sp.value
    rate_b = (bend.rate * c.value * cp.value - w * s.value * sp.value) / length
    torque_a = _trunnion_torque(rate_a, trunnions.damping_a, trunnions.friction, arithmetic)
    torque_b = _trunnion_torque(rate_b, trunnions.damping_b, trunnions.friction, arithmetic)
    # Virtual power: what a unit of w_in, and a unit of beta', turns the two trunnions by.
    resistance = torque_a * ratio * s.value * cp.value - torque_b * s.value * sp.value / length
    resistance_bend = torque_a * (swing * s.value * cp.value + sp.value) + torque_b * c.value * cp.value / length

    inertia = Dual(zero, zero)
    if trunnions.inertia_a or trunnions.inertia_b or trunnions.inertia_m:
        inertia = cross_inertia(Dual(p, zero + 1), Dual(bend.angle, zero), trunnions, arithmetic)
    return JointMotion(ratio, swing, speed.value, speed.slope, inertia.value, inertia.slope, resistance,
                       resistance_bend, torque_a * rate_a + torque_b * rate_b, rate_a, rate_b)


def _trunnion_torque(rate: Number, damping: Number, friction: Number, arithmetic: Arithmetic) -> Number:
    torque = damping * rate
    if friction:
        width = type(rate)(FRICTION_SPEED)
        torque = torque + friction * rate / arithmetic.sqrt(rate * rate + width * width)
    return torque
