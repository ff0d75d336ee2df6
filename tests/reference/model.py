"""The driveline in absolute angles, independent of the kernel: virtual power over the bodies.

Coordinates are the input angle phi and the angle y of shaft half b; the kernel has the joint angle, the twist
and two speeds. Each body's acceleration comes from :mod:`tests.reference.joint` by automatic differentiation;
d'Alembert's principle then sums inertia times acceleration times virtual speed. See README.md for the maths.
"""

from __future__ import annotations

from typing import NamedTuple

from tests.reference.arithmetic import Arithmetic, Number
from tests.reference.cases import Case, Polynomial, Torque
from tests.reference.dual import Dual
from tests.reference.joint import Bend, JointMotion, Trunnions, cross_inertia, joint_motion, output_angle

State = list[Number]
"""phi, y in rad; w1, wy in rad/s; then supplied, delivered, dissipated energy and work of the angle drives in J."""


class Motion(NamedTuple):
    """Everything the driveline does at one instant; SI units, signs of docs/PHYSICS.md section 1."""

    first: JointMotion
    second: JointMotion
    input_speed: Number
    input_acceleration: Number
    speed_y: Number
    acceleration_a: Number
    acceleration_y: Number
    output_acceleration: Number
    twist: Number
    shaft_torque: Number
    input_torque: Number       # engine's or drive's torque on the input shaft
    output_torque: Number      # load's torque, without the bearing drag


class Driveline:
    """The driveline of one case in one arithmetic.

    Parameters
    ----------
    case : Case
        Parameters and laws in time.
    arithmetic : Arithmetic
        The numbers to compute in; parameters enter as the exact binary values of the case's floats.
    """

    def __init__(self, case: Case, arithmetic: Arithmetic) -> None:
        self.arithmetic = arithmetic
        number = arithmetic.number
        value = {name: number(x) for name, x in case.parameters.items()}
        self.zero = number(0.0)
        self.compliant = case.parameters["model.fidelity"] == 2
        self.driven = case.parameters["model.drive"] == 1
        self.j1, self.j3 = value["input.inertia"], value["output.inertia"]
        self.ja, self.jb = value["shaft.inertia_a"], value["shaft.inertia_b"]
        self.k, self.d = value["shaft.stiffness"], value["shaft.damping"]
        self.drag1, self.drag3 = value["input.damping"], value["output.damping"]
        self.phase = value["shaft.yoke_phase"] - value["shaft.plane_twist"] + arithmetic.pi / 2
        self.trunnions = tuple(Trunnions(*(value[f"joint{j}.{name}"] for name in (
            "cross.inertia_a", "cross.inertia_b", "cross.inertia_m",
            "trunnion.damping_a", "trunnion.damping_b", "trunnion.friction"))) for j in (1, 2))
        self.start = [value[f"initial.{name}"] for name in ("angle", "speed", "twist", "twist_rate")]
        self.angle1, self.angle2 = self._law(case.joint1_angle), self._law(case.joint2_angle)
        self.command = self._law(case.speed_command)
        self.torque_in, self.torque_out = self._torque(case.input_torque), self._torque(case.output_torque)

    def _law(self, law: Polynomial) -> Bend:
        return Bend(*(self.arithmetic.number(x) for x in law))

    def _torque(self, law: Torque) -> tuple[Number, Number, Number]:
        value, der1, by_speed = (self.arithmetic.number(x) for x in law)
        return value, der1, by_speed

    def bends(self, t: Number) -> tuple[Bend, Bend]:
        """Return both joint angles with their rates and accelerations at time `t` in s."""
        return _at(self.angle1, t), _at(self.angle2, t)

    def initial_state(self) -> State:
        """Return the state at time 0 from the FMU's initial angle, speed, twist and twist rate."""
        angle, speed, twist, twist_rate = self.start
        if self.driven:
            speed = self.command.angle
        bend, _ = self.bends(self.zero)
        first = joint_motion(angle, speed, bend, self.trunnions[0], self.arithmetic)
        y = output_angle(angle, bend.angle, self.arithmetic)
        wy = first.speed
        if self.compliant:
            y, wy = y - twist, wy - twist_rate
        return [angle, y, speed, wy, *[self.zero] * 4]

    def engine_torque(self, t: Number, speed: Number) -> Number:
        """Return the engine's torque in N.m at time `t` in s and input speed in rad/s."""
        value, der1, by_speed = self.torque_in
        return value + der1 * t + by_speed * speed

    def load_torque(self, t: Number, speed: Number) -> Number:
        """Return the load's torque in N.m at time `t` in s and output speed in rad/s."""
        value, der1, by_speed = self.torque_out
        return value + der1 * t + by_speed * speed

    def motion(self, t: Number, state: State) -> Motion:
        """Return the motion at time `t` in s; only phi, y, w1, wy of `state` matter (rigid: phi and w1)."""
        phi, y, w1, wy = state[:4]
        bend1, bend2 = self.bends(t)
        w1_dot = None
        if self.driven:
            w1, w1_dot, _ = _at(self.command, t)
        first = joint_motion(phi, w1, bend1, self.trunnions[0], self.arithmetic)
        phi_a = output_angle(phi, bend1.angle, self.arithmetic)
        if not self.compliant:
            y, wy = phi_a, first.speed
        twist = phi_a - y
        second = joint_motion(y + self.phase, wy, bend2, self.trunnions[1], self.arithmetic)

        engine, load = self.engine_torque(t, w1), self.load_torque(t, second.speed)
        # Half b and what lies behind it, as inertia and torque about y; half a and the input, about phi.
        inertia_y = self.jb + second.inertia + self.j3 * second.ratio * second.ratio
        torque_y = (second.inertia_slope * wy * wy / 2 + second.resistance
                    + second.ratio * (self.j3 * second.steady + self.drag3 * second.speed + load))
        inertia_1 = self.j1 + first.inertia
        torque_1 = first.inertia_slope * w1 * w1 / 2 + first.resistance + self.drag1 * w1
        r1 = first.ratio
        if self.compliant:
            shaft = self.k * twist + self.d * (first.speed - wy)
            wy_dot = (shaft - torque_y) / inertia_y
            if w1_dot is None:
                w1_dot = ((engine - torque_1 - r1 * (shaft + self.ja * first.steady))
                          / (inertia_1 + self.ja * r1 * r1))
        else:
            behind = self.ja + inertia_y
            if w1_dot is None:
                w1_dot = ((engine - torque_1 - r1 * (torque_y + behind * first.steady))
                          / (inertia_1 + behind * r1 * r1))
            wy_dot = first.steady + r1 * w1_dot
            shaft = torque_y + inertia_y * wy_dot
        wa_dot = first.steady + r1 * w1_dot
        if self.driven:
            engine = inertia_1 * w1_dot + torque_1 + r1 * (shaft + self.ja * wa_dot)
        return Motion(first, second, w1, w1_dot, wy, wa_dot, wy_dot, second.steady + second.ratio * wy_dot,
                      twist, shaft, engine, load)

    def derivative(self, t: Number, state: State) -> State:
        """Return the time derivative of `state`, the four energies (powers in W) included."""
        move = self.motion(t, state)
        return [move.input_speed, move.speed_y, move.input_acceleration, move.acceleration_y,
                move.input_torque * move.input_speed, move.output_torque * move.second.speed, self.loss(move),
                self.bending_power(t, state, move)]

    def loss(self, move: Motion) -> Number:
        """Return the power in W turned into heat by trunnions, bearing drag and shaft damping."""
        slip = move.first.speed - move.speed_y
        drag = self.drag1 * move.input_speed * move.input_speed + self.drag3 * move.second.speed * move.second.speed
        return move.first.dissipation + move.second.dissipation + drag + self.d * slip * slip

    def bending_power(self, t: Number, state: State, move: Motion) -> Number:
        """Return the power in W that whoever moves the joint angles puts into the driveline.

        The torque on a joint angle is the virtual power of all bodies over beta'; the cross, taken at its
        momentary angle, stores 1/2 Jc w^2 and takes up 1/2 dJc/dbeta w^2 beta'.
        """
        bend1, bend2 = self.bends(t)
        _, torque_a, _, torque_3 = self.joint_torques(move)
        power = self.zero
        for joint, bend, trunnions, p, w, torque in (
                (move.first, bend1, self.trunnions[0], state[0], move.input_speed, torque_a),
                (move.second, bend2, self.trunnions[1], self.shaft_end(t, state) + self.phase, move.speed_y, torque_3)):
            if bend.rate:
                power += bend.rate * (joint.swing * torque + joint.resistance_bend)
                slope = cross_inertia(Dual(p, self.zero), Dual(bend.angle, self.zero + 1), trunnions, self.arithmetic)
                power += bend.rate * slope.slope * w * w / 2
        return power

    def joint_torques(self, move: Motion) -> tuple[Number, Number, Number, Number]:
        """Return the torques in N.m into and out of joint 1, into and out of joint 2.

        Each is what the neighbouring body does not take: the joint's own cross inertia and trunnion friction
        act between its input and its output torque.
        """
        return (move.input_torque - self.drag1 * move.input_speed - self.j1 * move.input_acceleration,
                move.shaft_torque + self.ja * move.acceleration_a,
                move.shaft_torque - self.jb * move.acceleration_y,
                move.output_torque + self.drag3 * move.second.speed + self.j3 * move.output_acceleration)

    def shaft_end(self, t: Number, state: State) -> Number:
        """Return y, the angle of shaft half b at joint 2 in rad."""
        return state[1] if self.compliant else output_angle(state[0], _at(self.angle1, t).angle, self.arithmetic)

    def output_angle(self, t: Number, state: State) -> Number:
        """Return FMI.md's ``output.angle``: the output trunnion's angle less 90 deg less (psi - theta), in rad."""
        _, bend2 = self.bends(t)
        return output_angle(self.shaft_end(t, state) + self.phase, bend2.angle, self.arithmetic) - self.phase

    def energies(self, move: Motion) -> tuple[Number, Number]:
        """Return kinetic and strain energy in J; the crosses count 1/2 Jc w^2."""
        kinetic = (self.j1 + move.first.inertia) * move.input_speed * move.input_speed
        kinetic += self.ja * move.first.speed * move.first.speed
        kinetic += (self.jb + move.second.inertia) * move.speed_y * move.speed_y
        kinetic += self.j3 * move.second.speed * move.second.speed
        strain = self.k * move.twist * move.twist if self.compliant else self.zero
        return kinetic / 2, strain / 2


def _at(law: Bend, t: Number) -> Bend:
    return Bend(law.angle + t * (law.rate + t * law.acceleration / 2), law.rate + t * law.acceleration,
                law.acceleration)
