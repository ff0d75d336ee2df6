"""The variables of the driveline: one table for the FMU, its documentation and the harness.

The value reference of a variable is its place in `VARIABLES`. Names, units and meaning are those of
the interface; every other module looks them up here.
"""

from typing import Dict, NamedTuple, Optional, Tuple, Union

HALF_PI = 1.5707963267948966
BELOW_HALF_PI = 1.5707963267948963  # the largest double below 90 deg; cos stays positive


class Unit(NamedTuple):
    """A unit of the interface.

    Attributes
    ----------
    exponents : dict
        Exponents of the SI base units (and ``rad``) by their FMI 2.0 attribute names.
    displays : tuple of (str, float)
        Display units and the factor: value in display unit = factor * value in this unit.
    """

    exponents: Dict[str, int]
    displays: Tuple[Tuple[str, float], ...] = ()


DEGREES = 57.29577951308232  # deg per rad
RPM = 9.549296585513721  # rpm per rad/s

UNITS = {
    "1": Unit({}, (("%", 100.0),)),
    "rad": Unit({"rad": 1}, (("deg", DEGREES),)),
    "rad/s": Unit({"rad": 1, "s": -1}, (("rpm", RPM), ("deg/s", DEGREES))),
    "rad/s2": Unit({"rad": 1, "s": -2}),
    "rad/s3": Unit({"rad": 1, "s": -3}),
    "m": Unit({"m": 1}, (("mm", 1000.0),)),
    "kg.m2": Unit({"kg": 1, "m": 2}),
    "N": Unit({"kg": 1, "m": 1, "s": -2}, (("kN", 1e-3),)),
    "N.m": Unit({"kg": 1, "m": 2, "s": -2}),
    "N.m/s": Unit({"kg": 1, "m": 2, "s": -3}),
    "N.m/rad": Unit({"kg": 1, "m": 2, "s": -2, "rad": -1}),
    "N.m.s/rad": Unit({"kg": 1, "m": 2, "s": -1, "rad": -1}),
    "W": Unit({"kg": 1, "m": 2, "s": -3}, (("kW", 1e-3),)),
    "J": Unit({"kg": 1, "m": 2, "s": -2}, (("kJ", 1e-3),)),
}

Start = Union[float, int, bool, None]


class Variable(NamedTuple):
    """One variable of the interface.

    Attributes
    ----------
    name : str
        Structured FMI name.
    type : str
        ``"Real"``, ``"Integer"`` or ``"Boolean"``.
    causality : str
        ``"parameter"``, ``"input"`` or ``"output"``.
    variability : str
        ``"fixed"``, ``"tunable"``, ``"continuous"`` or ``"discrete"``.
    unit : str
        Key of `UNITS`; empty for Integer and Boolean.
    start : float, int, bool or None
        Start value; None for outputs.
    minimum, maximum, nominal : float or None
        Allowed range (inclusive) and typical size, in `unit`.
    display : str
        Display unit, one of ``UNITS[unit].displays``; empty where the unit itself serves.
    description : str
        One line of meaning.
    """

    name: str
    type: str
    causality: str
    variability: str
    unit: str
    start: Start
    minimum: Optional[float]
    maximum: Optional[float]
    nominal: Optional[float]
    display: str
    description: str


def _parameter(name: str, unit: str, start: float, text: str, minimum: Optional[float] = None,
               maximum: Optional[float] = None, nominal: Optional[float] = None, display: str = "",
               tunable: bool = False) -> Variable:
    return Variable(name, "Real", "parameter", "tunable" if tunable else "fixed", unit, start, minimum, maximum,
                    nominal, display, text)


def _choice(name: str, start: int, minimum: int, maximum: int, text: str) -> Variable:
    return Variable(name, "Integer", "parameter", "fixed", "", start, minimum, maximum, None, "", text)


def _input(name: str, unit: str, text: str, nominal: Optional[float] = None, display: str = "",
           minimum: Optional[float] = None, maximum: Optional[float] = None) -> Variable:
    return Variable(name, "Real", "input", "continuous", unit, 0.0, minimum, maximum, nominal, display, text)


def _output(name: str, unit: str, text: str, nominal: Optional[float] = None, display: str = "",
            minimum: Optional[float] = None) -> Variable:
    return Variable(name, "Real", "output", "continuous", unit, None, minimum, None, nominal, display, text)


def _count(name: str, text: str) -> Variable:
    return Variable(name, "Integer", "output", "discrete", "", None, 0, None, None, "", text)


def _joint_parameters(j: int) -> Tuple[Variable, ...]:
    damping, inertia = "N.m.s/rad", "kg.m2"
    return (
        *(_parameter(f"joint{j}.cross.inertia_{axis}", inertia, 0.0, f"Cross of joint {j}: inertia about {about}",
                     minimum=0.0, nominal=1e-3)
          for axis, about in (("a", "its input trunnion"), ("b", "its output trunnion"), ("m", "the normal of both"))),
        *(_parameter(f"joint{j}.trunnion.damping_{axis}", damping, 0.0,
                     f"Joint {j}: viscous damping about the {side} trunnion", minimum=0.0, nominal=1e-2, tunable=True)
          for axis, side in (("a", "input"), ("b", "output"))),
        _parameter(f"joint{j}.trunnion.friction", "N.m", 0.0,
                   f"Joint {j}: Coulomb friction moment about each trunnion, smoothed over 0.01 rad/s",
                   minimum=0.0, nominal=1.0, tunable=True),
        _parameter(f"joint{j}.trunnion.radius", "m", 0.03, f"Joint {j}: lever of the trunnion force",
                   minimum=1e-6, nominal=0.03, display="mm"),
    )


def _joint_inputs(j: int) -> Tuple[Variable, ...]:
    return (
        _input(f"joint{j}.angle", "rad", f"Bend angle of joint {j} at the start of the step; below 90 deg",
               nominal=0.3, display="deg", minimum=0.0, maximum=BELOW_HALF_PI),
        _input(f"joint{j}.angle.der1", "rad/s", f"Rate of joint {j}'s bend angle over the step", nominal=1.0,
               display="deg/s"),
        _input(f"joint{j}.angle.der2", "rad/s2", f"Acceleration of joint {j}'s bend angle over the step", nominal=10.0),
    )


def _joint_outputs(j: int) -> Tuple[Variable, ...]:
    return (
        _output(f"joint{j}.torque_in", "N.m", f"Torque entering joint {j}, cross inertia and friction included", 100.0),
        _output(f"joint{j}.torque_out", "N.m", f"Torque leaving joint {j}", 100.0),
        _output(f"joint{j}.couple_in", "N.m", f"Secondary couple of joint {j} on its input shaft, along e_in x a",
                30.0),
        _output(f"joint{j}.couple_out", "N.m", f"Secondary couple of joint {j} on its output shaft, along e_out x b",
                30.0),
        _output(f"joint{j}.trunnion.rate_in", "rad/s", f"Rate of joint {j}'s cross about the input trunnion", 100.0),
        _output(f"joint{j}.trunnion.rate_out", "rad/s", f"Rate of joint {j}'s cross about the output trunnion", 100.0),
        _output(f"joint{j}.trunnion.force", "N", f"Force on each trunnion of joint {j}", 1000.0, "kN", minimum=0.0),
    )


def _torque_inputs(name: str, text: str, by: str) -> Tuple[Variable, ...]:
    return (
        _input(name, "N.m", text, nominal=100.0),
        _input(f"{name}.der1", "N.m/s", f"Time derivative of {name} at constant {by}", nominal=1e4),
        _input(f"{name}.by_speed", "N.m.s/rad", f"Partial derivative of {name} by {by}", nominal=1.0),
    )


VARIABLES: Tuple[Variable, ...] = (
    # what is modelled
    _choice("model.fidelity", 2, 1, 2, "1 rigid, 2 compliant intermediate shaft"),
    _choice("model.drive", 0, 0, 1, "0 input torque given, 1 input speed given"),
    _parameter("model.tolerance", "1", 1e-9,
               "Relative tolerance of the integrator; a tolerance given by the master wins", 1e-13, 0.1),
    # parameters
    _parameter("input.inertia", "kg.m2", 0.2, "J1, inertia in front of joint 1", minimum=0.0, nominal=0.1),
    _parameter("output.inertia", "kg.m2", 1.5, "J3, inertia behind joint 2", minimum=0.0, nominal=1.0),
    _parameter("input.damping", "N.m.s/rad", 0.0, "Bearing drag of the input shaft to ground", minimum=0.0,
               nominal=0.1, tunable=True),
    _parameter("output.damping", "N.m.s/rad", 0.0, "Bearing drag of the output shaft to ground", minimum=0.0,
               nominal=0.1, tunable=True),
    _parameter("shaft.inertia_a", "kg.m2", 0.0044, "J2a, half of the intermediate shaft at joint 1", minimum=0.0,
               nominal=0.01),
    _parameter("shaft.inertia_b", "kg.m2", 0.0044, "J2b, half of the intermediate shaft at joint 2", minimum=0.0,
               nominal=0.01),
    _parameter("shaft.stiffness", "N.m/rad", 2e4, "k, torsional stiffness of the intermediate shaft", minimum=0.0,
               nominal=1e4, tunable=True),
    _parameter("shaft.damping", "N.m.s/rad", 2.0, "d, torsional damping of the intermediate shaft", minimum=0.0,
               nominal=1.0, tunable=True),
    _parameter("shaft.yoke_phase", "rad", 0.0, "psi, joint 1's output trunnion to joint 2's input trunnion",
               nominal=1.0, display="deg"),
    _parameter("shaft.plane_twist", "rad", 0.0, "theta, plane of joint 1 to plane of joint 2 (0 W layout, 180 deg Z)",
               nominal=1.0, display="deg"),
    *_joint_parameters(1),
    *_joint_parameters(2),
    _parameter("initial.angle", "rad", 0.0, "Input shaft angle at start; 0 has the input trunnion in the joint plane",
               nominal=1.0, display="deg"),
    _parameter("initial.speed", "rad/s", 0.0, "Input shaft speed at start (model.drive = 0)", nominal=100.0,
               display="rpm"),
    _parameter("initial.twist", "rad", 0.0, "Twist of the intermediate shaft at start (compliant)", nominal=0.01,
               display="deg"),
    _parameter("initial.twist_rate", "rad/s", 0.0, "Twist rate of the intermediate shaft at start (compliant)",
               nominal=1.0, display="deg/s"),
    _choice("hold.degree", 1, 0, 5,
            "Torque between communication points: 0 held, 1 linear with .der1, 3 or 5 Hermite through the last points"),
    # inputs
    *_torque_inputs("input.torque", "Driving torque on the input shaft", "input.speed"),
    _input("input.speed_command", "rad/s", "Input speed at the start of the step (model.drive = 1)", 100.0, "rpm"),
    _input("input.speed_command.der1", "rad/s2", "First time derivative of input.speed_command", 100.0),
    _input("input.speed_command.der2", "rad/s3", "Second time derivative of input.speed_command", 1000.0),
    *_torque_inputs("output.torque", "Load torque on the output shaft; positive resists positive speed",
                    "output.speed"),
    *_joint_inputs(1),
    *_joint_inputs(2),
    Variable("hold.restart", "Boolean", "input", "discrete", "", False, None, None, None, "",
             "True at a point where a torque jumped: the history of hold.degree is dropped"),
    # outputs
    _output("input.angle", "rad", "Input shaft angle, counting turns", 100.0, "deg"),
    _output("input.speed", "rad/s", "Input shaft speed", 100.0, "rpm"),
    _output("input.acceleration", "rad/s2", "Input shaft acceleration", 1000.0),
    _output("input.reaction_torque", "N.m", "Torque that the drive supplies; input.torque where that is given", 100.0),
    _output("output.angle", "rad", "Output shaft angle, counting turns; input.angle for a homokinetic pair", 100.0,
            "deg"),
    _output("output.speed", "rad/s", "Output shaft speed", 100.0, "rpm"),
    _output("output.acceleration", "rad/s2", "Output shaft acceleration", 1000.0),
    _output("shaft.torque", "N.m", "Torque in the intermediate shaft", 100.0),
    _output("shaft.twist", "rad", "Twist of the intermediate shaft", 0.01, "deg"),
    _output("shaft.speed_a", "rad/s", "Speed of the intermediate shaft at joint 1", 100.0, "rpm"),
    _output("shaft.speed_b", "rad/s", "Speed of the intermediate shaft at joint 2", 100.0, "rpm"),
    _output("joint1.ratio", "1", "Speed ratio of joint 1 at its present angle", 1.0, minimum=0.0),
    _output("joint2.ratio", "1", "Speed ratio of joint 2 at its present angle", 1.0, minimum=0.0),
    _output("ratio", "1", "Speed ratio of both joints, output by input", 1.0, minimum=0.0),
    *_joint_outputs(1),
    *_joint_outputs(2),
    _output("inertia_torque", "N.m", "Output inertia's torque from the joints' non-uniformity, at the output shaft",
            100.0),
    _output("power.input", "W", "Power received from the drive", 1e4, "kW"),
    _output("power.output", "W", "Power delivered to the load", 1e4, "kW"),
    _output("power.loss", "W", "Power lost in bearings, shaft and trunnions", 100.0, "kW", minimum=0.0),
    _output("energy.kinetic", "J", "Kinetic energy", 1e4, "kJ", minimum=0.0),
    _output("energy.strain", "J", "Strain energy of the intermediate shaft", 10.0, "kJ", minimum=0.0),
    _output("energy.residual", "J", "Supplied - delivered - dissipated - stored since the start: integration error",
            1e-3),
    _output("layout.nonuniformity", "1", "U = kappa - 1/kappa of the pair at the present joint angles", 0.1, "%",
            minimum=0.0),
    _output("layout.equivalent_angle", "rad", "Angle of the one joint that the pair behaves as", 0.1, "deg",
            minimum=0.0),
    _count("solver.steps", "Accepted integrator steps since the start"),
    _count("solver.evaluations", "Evaluations of the equations of motion since the start"),
    _count("solver.rejected", "Rejected integrator steps since the start"),
)

INDEX: Dict[str, int] = {variable.name: place for place, variable in enumerate(VARIABLES)}
