"""One driveline in time: from the values in its memory to the next communication point."""

from array import array
from math import fabs, pow

from .history import History
from .integrator import DONE, Integrator, product_rest
from .jump import jump, settle
from .memory import (
    CARRY,
    END_ACCELERATION,
    END_BEND,
    END_IN,
    END_OUT,
    ENERGY,
    EVALUATIONS,
    FRESH_LAYOUT,
    FRESH_LOADS,
    FRESH_MOTION,
    MASTER_TOLERANCE,
    POINTS,
    PREVIOUS_ERROR,
    REJECTED,
    STEP,
    STEPS,
    TURNS,
    WORK,
)
from .motion import Motion
from .outputs import write_layout, write_loads, write_motion
from .places import (
    BEND1,
    BEND2,
    COMMAND,
    CROSS1,
    CROSS2,
    DAMPING,
    DAMPING_IN,
    DAMPING_OUT,
    DRIVE,
    FIDELITY,
    HOLD_DEGREE,
    INERTIA_A,
    INERTIA_B,
    INERTIA_IN,
    INERTIA_OUT,
    MEMORY,
    PLANE_TWIST,
    START_ANGLE,
    START_SPEED,
    START_TWIST,
    START_TWIST_RATE,
    STIFFNESS,
    TOLERANCE,
    TORQUE_IN,
    TORQUE_OUT,
    YOKE_PHASE,
)
from .tangent import Tangent


class Stepper:
    """Memory, equations and integrator of one driveline.

    Attributes
    ----------
    store : array of float
        The whole memory, laid out as in `memory`.
    motion : Motion
    integrator : Integrator
    """

    def __init__(self):
        self.store = array("d", bytes(8 * MEMORY))
        self.z = self.store
        self.motion = Motion()
        self.integrator = Integrator(self.motion)
        self.tangent = Tangent(self.motion)
        self.column = [0.0] * 16
        self.history = History(self.motion)

    def configure(self):
        """Take the parameters from memory into the equations and the integrator."""
        z = self.z
        m = self.motion
        m.rigid = z[FIDELITY] == 1.0
        m.driven = z[DRIVE] == 1.0
        m.j1 = z[INERTIA_IN]
        m.j2a = z[INERTIA_A]
        m.j2b = z[INERTIA_B]
        m.j3 = z[INERTIA_OUT]
        m.k = 0.0 if m.rigid else z[STIFFNESS]
        m.d = 0.0 if m.rigid else z[DAMPING]
        m.c_in = z[DAMPING_IN]
        m.c_out = z[DAMPING_OUT]
        m.offset = z[YOKE_PHASE] - z[PLANE_TWIST]
        m.joint1.equip(z[CROSS1], z[CROSS1 + 1], z[CROSS1 + 2], z[CROSS1 + 3], z[CROSS1 + 4], z[CROSS1 + 5])
        m.joint2.equip(z[CROSS2], z[CROSS2 + 1], z[CROSS2 + 2], z[CROSS2 + 3], z[CROSS2 + 4], z[CROSS2 + 5])
        m.unbend()
        fast = m.frequency()
        self.integrator.twist_floor = 1.0 / fast if fast > 0.0 else 1.0
        self.integrator.tolerance = z[MASTER_TOLERANCE] if z[MASTER_TOLERANCE] > 0.0 else z[TOLERANCE]

    def start(self):
        """Set the states from the initial values; the outputs follow."""
        z = self.z
        m = self.motion
        y = self.integrator.y
        self.configure()
        m.swing(z[BEND1], z[BEND1 + 1], z[BEND1 + 2], z[BEND2], z[BEND2 + 1], z[BEND2 + 2])
        y[0] = z[START_ANGLE]
        self.integrator.carry = 0.0
        self.integrator.turns = 0.0
        self.integrator.add_angle(0.0)
        y[1] = 0.0 if m.rigid else z[START_TWIST]
        y[2] = z[COMMAND] if m.driven else z[START_SPEED]
        if m.moving:
            m.bend(0.0)
        m.turn(y[0], y[1])
        y[3] = m.joint1.r * y[2] + m.joint1.g * m.joint1.beta1
        if not m.rigid:
            y[3] -= z[START_TWIST_RATE]
        y[4] = 0.0
        z[CARRY] = self.integrator.carry
        z[TURNS] = self.integrator.turns
        z[POINTS] = 0.0
        z[STEPS] = 0.0
        z[EVALUATIONS] = 0.0
        z[REJECTED] = 0.0
        z[PREVIOUS_ERROR] = 1e-4
        z[END_IN] = z[TORQUE_IN]
        z[END_OUT] = z[TORQUE_OUT]
        z[END_ACCELERATION] = z[COMMAND + 1]
        for i in range(3):
            z[END_BEND + i] = z[BEND1 + i]
            z[END_BEND + 3 + i] = z[BEND2 + i]
        for i in range(5):
            z[i] = y[i]
        settle(m, z, y)
        z[ENERGY] = m.kinetic() + m.strain()
        fast = m.frequency()
        if fast < 2.0 * fabs(y[2]):
            fast = 2.0 * fabs(y[2])
        if fast < 1.0:
            fast = 1.0
        z[STEP] = pow(self.integrator.tolerance, 0.125) / fast
        self.forget_outputs()

    def forget_outputs(self):
        """Outputs will be computed when they are asked for."""
        self.z[FRESH_MOTION] = 0.0
        self.z[FRESH_LOADS] = 0.0
        self.z[FRESH_LAYOUT] = 0.0

    def step(self, h):
        """Go on by the communication step `h` (s); nothing in memory changes unless ``DONE`` returns.

        Returns
        -------
        int
            Result of `Integrator.run`.
        """
        z = self.z
        m = self.motion
        it = self.integrator
        y = it.y
        for i in range(5):
            y[i] = z[i]
        it.carry = z[CARRY]
        it.turns = z[TURNS]
        it.h = z[STEP]
        it.previous_error = z[PREVIOUS_ERROR]
        it.steps = z[STEPS]
        it.evaluations = z[EVALUATIONS]
        it.rejected = z[REJECTED]
        v0 = z[COMMAND] if m.driven else y[2]
        if (z[BEND1] != z[END_BEND] or z[BEND1 + 1] != z[END_BEND + 1] or z[BEND2] != z[END_BEND + 3]
                or z[BEND2 + 1] != z[END_BEND + 4] or v0 != y[2]):
            jump(m, y, z, v0, z[BEND1], z[BEND1 + 1], z[BEND1 + 2], z[BEND2], z[BEND2 + 1], z[BEND2 + 2])
        else:
            m.swing(z[BEND1], z[BEND1 + 1], z[BEND1 + 2], z[BEND2], z[BEND2 + 1], z[BEND2 + 2])
        m.steer(y[0], y[2], z[COMMAND + 1], z[COMMAND + 2])
        points = self.history.hold(z, y, h)
        it.evaluations += self.history.evaluations
        result = DONE
        if not (m.rigid and m.driven):
            result = it.run(h)
        if result != DONE:
            return result
        self.remember(h, points)
        return DONE

    def remember(self, h, points):
        """Write the end of a step of length `h` (s), made with `points` earlier points, into memory."""
        z = self.z
        m = self.motion
        it = self.integrator
        y = it.y
        if m.driven:
            mean = m.v0 + h * (0.5 * m.v1 + h * m.v2 / 6.0)
            it.carry += product_rest(mean, h)
            it.add_angle(mean * h)
            y[2] = m.v0 + h * (m.v1 + 0.5 * h * m.v2)
        for i in range(5):
            z[i] = y[i]
        z[CARRY] = it.carry
        z[TURNS] = it.turns
        z[STEP] = it.h
        z[PREVIOUS_ERROR] = it.previous_error
        z[STEPS] = it.steps
        z[EVALUATIONS] = it.evaluations
        z[REJECTED] = it.rejected
        z[END_BEND] = m.a0 + h * (m.a1 + 0.5 * h * m.a2)
        z[END_BEND + 1] = m.a1 + h * m.a2
        z[END_BEND + 2] = m.a2
        z[END_BEND + 3] = m.b0 + h * (m.b1 + 0.5 * h * m.b2)
        z[END_BEND + 4] = m.b1 + h * m.b2
        z[END_BEND + 5] = m.b2
        z[END_ACCELERATION] = m.v1 + h * m.v2
        z[END_IN] = m.hold_in.rest(h) + m.hold_in.slope * y[2]
        z[END_OUT] = m.hold_out.rest(h)
        if m.hold_out.slope != 0.0:
            m.evaluate(h, y[0], y[1], y[2], y[3])
            z[END_OUT] += m.hold_out.slope * m.w3
        if z[HOLD_DEGREE] > 1.0:
            self.history.push(z, h, points)
        self.forget_outputs()
        if m.rigid and m.driven:
            # Nothing was integrated: the motion is exact and the drive supplies whatever it takes.
            settle(m, z, y)
            z[WORK] = m.kinetic() - z[ENERGY]

    def look(self):
        """Evaluate the equations at the end of the last step."""
        y = self.integrator.y
        for i in range(5):
            y[i] = self.z[i]
        settle(self.motion, self.z, y)

    def refresh(self, group):
        """Bring one group of outputs up to date: ``FRESH_MOTION``, ``FRESH_LOADS`` or ``FRESH_LAYOUT``."""
        if self.z[group] != 0.0:
            return
        self.look()
        if group == FRESH_MOTION:
            write_motion(self.motion, self.z)
        elif group == FRESH_LOADS:
            write_loads(self.motion, self.z)
        else:
            write_layout(self.motion, self.z)
        self.z[group] = 1.0

    def columns(self):
        """Columns of [A; C] for the unit directions of the states and of [B; D] for those of the inputs.

        Returns
        -------
        list of 7 lists of 19 float
            Changes of the state derivatives, then of `JACOBIAN_OUTPUTS`, at the end of the last step.
        """
        unit = [0.0] * 7
        self.look()
        z = self.z
        m = self.motion
        # The torques follow the speeds from here as they do within a step.
        m.hold_in.slope = z[TORQUE_IN + 2]
        m.hold_out.slope = z[TORQUE_OUT + 2]
        self.tangent.take()
        found = []
        for i in range(7):
            unit[i] = 1.0
            self.tangent.along(unit[0], unit[1], unit[2], unit[3], unit[4], unit[5], unit[6])
            unit[i] = 0.0
            self.tangent.state_column(self.column, 0)
            column = [self.column[j] for j in range(4)]
            self.tangent.output_column(self.column, 0)
            column += [self.column[j] for j in range(15)]
            found.append(column)
        return found
