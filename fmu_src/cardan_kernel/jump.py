"""What happens at a communication point where a prescribed quantity jumps.

A joint angle, its rate or the prescribed speed may differ from the end of the last step. Then the
absolute shaft angles and the momenta go on and the speeds follow: the limit of a fast change. The
energy that the jump brings counts as supplied.
"""

from .memory import END_ACCELERATION, END_BEND, END_IN, END_OUT


def settle(motion, z, y):
    """Evaluate `motion` at the end of the last step: inputs remembered in `z`, states in `y`."""
    motion.hold_in.line(z[END_IN], 0.0, 0.0, 0.0)
    motion.hold_out.line(z[END_OUT], 0.0, 0.0, 0.0)
    motion.swing(z[END_BEND], z[END_BEND + 1], z[END_BEND + 2], z[END_BEND + 3], z[END_BEND + 4], z[END_BEND + 5])
    motion.steer(y[0], y[2], z[END_ACCELERATION], 0.0)
    motion.evaluate(0.0, y[0], y[1], y[2], y[3])


def momentum_out(motion):
    """Momentum (N.m.s) behind the spring, by the speed wy."""
    return (motion.j2b + motion.joint2.jc) * motion.wy + motion.joint2.r * motion.j3 * motion.w3


def momentum_in(motion):
    """Momentum (N.m.s) in front of the spring, by w1; of the whole driveline where it is rigid."""
    behind = motion.j2a * motion.wa
    if motion.rigid:
        behind += momentum_out(motion)
    return (motion.j1 + motion.joint1.jc) * motion.w1 + motion.joint1.r * behind


def jump(motion, y, z, v0, a0, a1, a2, b0, b1, b2):
    """Carry the states `y` over a jump of the joint angles or the prescribed speed `v0` (rad/s).

    Parameters
    ----------
    a0, a1, a2, b0, b1, b2 : float
        New angle, rate and acceleration of joint 1 and joint 2, rad, rad/s, rad/s2.
    """
    one = motion.joint1
    two = motion.joint2
    settle(motion, z, y)
    first = momentum_in(motion)
    second = momentum_out(motion)
    energy = motion.kinetic() + motion.strain()
    lead = one.lead()
    motion.swing(a0, a1, a2, b0, b1, b2)
    if motion.moving:
        motion.bend(0.0)
    motion.turn(y[0], y[1])
    if not motion.rigid:
        y[1] += one.lead() - lead
        motion.turn(y[0], y[1])
    kick1 = one.g * one.beta1
    kick2 = two.g * two.beta1
    behind = motion.j2b + two.jc + motion.j3 * two.r * two.r
    inertia = motion.j2a
    offset = motion.j2a * kick1
    if motion.rigid:
        inertia += behind
        offset += behind * kick1 + two.r * motion.j3 * kick2
    if motion.driven:
        y[2] = v0
    else:
        y[2] = (first - one.r * offset) / (motion.j1 + one.jc + inertia * one.r * one.r)
    if motion.rigid:
        y[3] = one.r * y[2] + kick1
    else:
        y[3] = (second - two.r * motion.j3 * kick2) / behind
    motion.steer(y[0], v0, 0.0, 0.0)
    motion.evaluate(0.0, y[0], y[1], y[2], y[3])
    y[4] += motion.kinetic() + motion.strain() - energy
