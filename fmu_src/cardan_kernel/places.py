"""Places of single variables of the interface in the memory of a driveline."""

from .memory import VARS
from .variables import INDEX, VARIABLES

MEMORY = VARS + len(VARIABLES)

FIDELITY = VARS + INDEX["model.fidelity"]
DRIVE = VARS + INDEX["model.drive"]
TOLERANCE = VARS + INDEX["model.tolerance"]
INERTIA_IN = VARS + INDEX["input.inertia"]
INERTIA_OUT = VARS + INDEX["output.inertia"]
DAMPING_IN = VARS + INDEX["input.damping"]
DAMPING_OUT = VARS + INDEX["output.damping"]
INERTIA_A = VARS + INDEX["shaft.inertia_a"]
INERTIA_B = VARS + INDEX["shaft.inertia_b"]
STIFFNESS = VARS + INDEX["shaft.stiffness"]
DAMPING = VARS + INDEX["shaft.damping"]
YOKE_PHASE = VARS + INDEX["shaft.yoke_phase"]
PLANE_TWIST = VARS + INDEX["shaft.plane_twist"]
CROSS1 = VARS + INDEX["joint1.cross.inertia_a"]  # then b, m, damping a, b, friction
CROSS2 = VARS + INDEX["joint2.cross.inertia_a"]
START_ANGLE = VARS + INDEX["initial.angle"]
START_SPEED = VARS + INDEX["initial.speed"]
START_TWIST = VARS + INDEX["initial.twist"]
START_TWIST_RATE = VARS + INDEX["initial.twist_rate"]
HOLD_DEGREE = VARS + INDEX["hold.degree"]
HOLD_RESTART = VARS + INDEX["hold.restart"]
TORQUE_IN = VARS + INDEX["input.torque"]  # then der1, by_speed
TORQUE_OUT = VARS + INDEX["output.torque"]
COMMAND = VARS + INDEX["input.speed_command"]  # then der1, der2
BEND1 = VARS + INDEX["joint1.angle"]  # then der1, der2
BEND2 = VARS + INDEX["joint2.angle"]
