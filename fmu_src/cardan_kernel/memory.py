"""Where everything that a driveline remembers stands in its one array of doubles.

The whole state is this array, so saving, restoring and serializing are copies of it. The variables of
the interface follow at ``VARS`` by value reference.
"""

P = 0
TWIST = 1
W1 = 2
WY = 3
WORK = 4
CARRY = 5
TURNS = 6
STEP = 7  # proposed integrator step
PREVIOUS_ERROR = 8
STEPS = 9
EVALUATIONS = 10
REJECTED = 11
MODE = 12
ENERGY = 13  # stored energy at the start
MASTER_TOLERANCE = 14  # 0: none given
# Inputs as they were at the end of the last step: outputs belong to that instant.
END_IN = 15
END_OUT = 16
END_ACCELERATION = 17
END_BEND = 18  # .. 23: angle, rate, acceleration of joint 1, then of joint 2
# History of the torques: number of earlier points, times between them, then value, total rate, speed and
# acceleration at the last and the last but one point for the drive, then for the load.
POINTS = 24
GAP = 25
GAP2 = 26
PAST_IN = 27
PAST_OUT = 35
# Which outputs are up to date.
FRESH_MOTION = 43
FRESH_LOADS = 44
FRESH_LAYOUT = 45
UNCHECKED = 46  # parameters were set and not yet judged
MARK = 47  # tells a state of this layout from other bytes

VARS = 48

# MODE
INSTANTIATED = 0
INITIALIZING = 1
LEFT_INITIALIZATION = 2  # parameters may still be found wrong
RUNNING = 3
TERMINATED = 4

# Value of MARK; a new one for each change of the layout.
LAYOUT = 20261.0
