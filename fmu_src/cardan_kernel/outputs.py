"""Outputs of the driveline at an instant, written to the variables in its memory.

Three groups, each computed when one of its variables is asked for: the motion, the loads in joints
and shafts with powers and energies, and the layout of the pair (docs/PHYSICS.md sections 2 to 4).
"""

from math import atan, cos, sin, sqrt

from .integrator import TURN, TURN_REST
from .memory import CARRY, ENERGY, TURNS, VARS, WORK
from .variables import INDEX

OUT_ANGLE_IN = VARS + INDEX["input.angle"]
OUT_SPEED_IN = VARS + INDEX["input.speed"]
OUT_ACCELERATION_IN = VARS + INDEX["input.acceleration"]
OUT_REACTION = VARS + INDEX["input.reaction_torque"]
OUT_ANGLE = VARS + INDEX["output.angle"]
OUT_SPEED = VARS + INDEX["output.speed"]
OUT_ACCELERATION = VARS + INDEX["output.acceleration"]
OUT_SHAFT_TORQUE = VARS + INDEX["shaft.torque"]
OUT_TWIST = VARS + INDEX["shaft.twist"]
OUT_SPEED_A = VARS + INDEX["shaft.speed_a"]
OUT_SPEED_B = VARS + INDEX["shaft.speed_b"]
OUT_RATIO1 = VARS + INDEX["joint1.ratio"]
OUT_RATIO2 = VARS + INDEX["joint2.ratio"]
OUT_RATIO = VARS + INDEX["ratio"]
OUT_JOINT1 = VARS + INDEX["joint1.torque_in"]
OUT_JOINT2 = VARS + INDEX["joint2.torque_in"]
OUT_INERTIA_TORQUE = VARS + INDEX["inertia_torque"]
OUT_POWER_IN = VARS + INDEX["power.input"]
OUT_POWER_OUT = VARS + INDEX["power.output"]
OUT_POWER_LOSS = VARS + INDEX["power.loss"]
OUT_KINETIC = VARS + INDEX["energy.kinetic"]
OUT_STRAIN = VARS + INDEX["energy.strain"]
OUT_RESIDUAL = VARS + INDEX["energy.residual"]
OUT_NONUNIFORMITY = VARS + INDEX["layout.nonuniformity"]
OUT_EQUIVALENT = VARS + INDEX["layout.equivalent_angle"]
RADIUS1 = VARS + INDEX["joint1.trunnion.radius"]
RADIUS2 = VARS + INDEX["joint2.trunnion.radius"]


def write_motion(motion, z):
    """Angles, speeds, accelerations, shaft torque and ratios of the evaluated `motion` into `z`."""
    whole = z[TURNS] * TURN
    rest = z[TURNS] * TURN_REST + z[CARRY] + motion.p
    z[OUT_ANGLE_IN] = whole + rest
    z[OUT_SPEED_IN] = motion.w1
    z[OUT_ACCELERATION_IN] = motion.dw1
    z[OUT_REACTION] = motion.tin
    z[OUT_ANGLE] = whole + (rest + (motion.joint1.lead() - motion.twist + motion.joint2.lead()))
    z[OUT_SPEED] = motion.w3
    z[OUT_ACCELERATION] = motion.dw3
    z[OUT_SHAFT_TORQUE] = motion.ts
    z[OUT_TWIST] = motion.twist
    z[OUT_SPEED_A] = motion.wa
    z[OUT_SPEED_B] = motion.wy
    z[OUT_RATIO1] = motion.joint1.r
    z[OUT_RATIO2] = motion.joint2.r
    z[OUT_RATIO] = motion.joint1.r * motion.joint2.r


def write_joint(joint, speed, torque_in, torque_out, radius, z, place):
    """Torques, secondary couples, cross rates and trunnion force of one joint into ``z[place:place + 7]``."""
    joint.slide(speed)
    z[place] = torque_in
    z[place + 1] = torque_out
    z[place + 2] = joint.couple_in(torque_in)
    z[place + 3] = joint.couple_out(torque_out)
    z[place + 4] = joint.rate_a
    z[place + 5] = joint.rate_b
    z[place + 6] = joint.trunnion_force(torque_in, torque_out, radius)


def write_loads(motion, z):
    """Torques through the joints, powers and energies of the evaluated `motion` into `z`."""
    kinetic = motion.kinetic()
    strain = motion.strain()
    write_joint(motion.joint1, motion.w1, motion.tin - motion.j1 * motion.dw1 - motion.c_in * motion.w1,
                motion.ts + motion.j2a * motion.dwa, z[RADIUS1], z, OUT_JOINT1)
    write_joint(motion.joint2, motion.wy, motion.ts - motion.j2b * motion.dwy,
                motion.tout + motion.c_out * motion.w3 + motion.j3 * motion.dw3, z[RADIUS2], z, OUT_JOINT2)
    z[OUT_INERTIA_TORQUE] = motion.j3 * (motion.joint2.r * motion.bias1 + motion.bias2)
    z[OUT_POWER_IN] = motion.tin * motion.w1
    z[OUT_POWER_OUT] = motion.tout * motion.w3
    z[OUT_POWER_LOSS] = motion.loss()
    z[OUT_KINETIC] = kinetic
    z[OUT_STRAIN] = strain
    z[OUT_RESIDUAL] = z[ENERGY] + z[WORK] - (kinetic + strain)


def write_layout(motion, z):
    """Non-uniformity and equivalent angle of the pair (PHYSICS.md section 4) into `z`.

    With Q = kappa + 1/kappa, Q - 2 = [(c1 - c2)^2 cos^2 delta + (1 - c1 c2)^2 sin^2 delta] / (c1 c2) has no
    cancellation for nearly homokinetic pairs.
    """
    c1 = motion.joint1.c
    c2 = motion.joint2.c
    cd = cos(motion.offset)
    sd = sin(motion.offset)
    one = motion.joint1.versine + motion.joint2.versine - motion.joint1.versine * motion.joint2.versine
    apart = motion.joint1.versine - motion.joint2.versine
    q = (apart * apart * cd * cd + one * one * sd * sd) / (c1 * c2)
    u = sqrt(q * (q + 4.0))
    excess = 0.5 * (q + u)
    z[OUT_NONUNIFORMITY] = u
    z[OUT_EQUIVALENT] = 2.0 * atan(sqrt(excess / (excess + 2.0)))
