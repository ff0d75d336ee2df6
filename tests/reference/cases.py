"""Parameter sets of the reference cases, under the FMU's own names, with their laws in time.

One dictionary feeds the independent model (``tests.reference.model``) and the FMU or kernel under test. Every
law here is one that the FMU reproduces exactly from its inputs at any communication points: a torque
``T = value + der1 t + by_speed w``, and polynomials of degree two for the joint angles and the driven speed.
"""

from __future__ import annotations

from math import radians
from typing import NamedTuple

DEFAULTS: dict[str, float] = {
    "model.fidelity": 2, "model.drive": 0,
    "input.inertia": 0.2, "output.inertia": 1.5, "input.damping": 0.0, "output.damping": 0.0,
    "shaft.inertia_a": 0.0044, "shaft.inertia_b": 0.0044, "shaft.stiffness": 2e4, "shaft.damping": 2.0,
    "shaft.yoke_phase": 0.0, "shaft.plane_twist": 0.0,
    **{f"joint{j}.{name}": 0.0 for j in (1, 2) for name in
       ("cross.inertia_a", "cross.inertia_b", "cross.inertia_m",
        "trunnion.damping_a", "trunnion.damping_b", "trunnion.friction")},
    "initial.angle": 0.0, "initial.speed": 0.0, "initial.twist": 0.0, "initial.twist_rate": 0.0,
}
"""FMI.md's start values of every parameter that enters the motion; a case lists what differs."""


class Torque(NamedTuple):
    """Torque law ``value + der1 t + by_speed w`` of the shaft end it acts on, in N.m, N.m/s, N.m.s/rad."""

    value: float = 0.0
    der1: float = 0.0
    by_speed: float = 0.0


class Polynomial(NamedTuple):
    """Law ``value + der1 t + der2 t**2 / 2`` of a joint angle in rad or a driven speed in rad/s."""

    value: float = 0.0
    der1: float = 0.0
    der2: float = 0.0

    def at(self, t: float) -> Polynomial:
        """Return value, first and second derivative at `t` in s."""
        return Polynomial(self.value + t * (self.der1 + t * self.der2 / 2), self.der1 + t * self.der2, self.der2)


class Case(NamedTuple):
    """One reference case: its fixed parameters and the laws of its inputs."""

    name: str
    title: str
    given: dict[str, float]
    joint1_angle: Polynomial
    joint2_angle: Polynomial = Polynomial()
    input_torque: Torque = Torque()
    output_torque: Torque = Torque()
    speed_command: Polynomial = Polynomial()

    @property
    def parameters(self) -> dict[str, float]:
        """All fixed and tunable FMU parameters of the case, FMI.md's start values included."""
        return DEFAULTS | self.given

    def law_texts(self) -> list[str]:
        """Return one line for each law in time, for the comments of a reference file."""
        laws: dict[str, Polynomial | Torque] = {
            "joint1.angle": self.joint1_angle, "joint2.angle": self.joint2_angle, "input.torque": self.input_torque,
            "output.torque": self.output_torque, "input.speed_command": self.speed_command}
        return [f"law of {name}: " + ", ".join(f"{key} = {value!r}" for key, value in law._asdict().items())
                for name, law in laws.items()]

    def inputs(self, t: float, input_speed: float, output_speed: float) -> dict[str, float]:
        """Return the FMU's continuous inputs at a communication point.

        Parameters
        ----------
        t : float
            Time of the communication point in s.
        input_speed, output_speed : float
            The FMU's ``input.speed`` and ``output.speed`` at `t` in rad/s; they only matter where a torque
            law has ``by_speed``, and the FMU subtracts that part again. At `t` = 0 take them from the first
            row of the case's CSV.
        """
        values: dict[str, float] = {}
        for name, law in (("joint1.angle", self.joint1_angle), ("joint2.angle", self.joint2_angle),
                          ("input.speed_command", self.speed_command)):
            values[name], values[f"{name}.der1"], values[f"{name}.der2"] = law.at(t)
        for name, torque, speed in (("input.torque", self.input_torque, input_speed),
                                    ("output.torque", self.output_torque, output_speed)):
            values[name] = torque.value + torque.der1 * t + torque.by_speed * speed
            values[f"{name}.der1"] = torque.der1
            values[f"{name}.by_speed"] = torque.by_speed
        return values


def _crosses(first: tuple[float, float, float], second: tuple[float, float, float]) -> dict[str, float]:
    return {f"joint{j}.cross.inertia_{axis}": value
            for j, inertias in ((1, first), (2, second)) for axis, value in zip("abm", inertias, strict=True)}


def _trunnions(first: tuple[float, float, float], second: tuple[float, float, float]) -> dict[str, float]:
    return {f"joint{j}.trunnion.{name}": value for j, row in ((1, first), (2, second))
            for name, value in zip(("damping_a", "damping_b", "friction"), row, strict=True)}


CASES: dict[str, Case] = {case.name: case for case in (
    Case("single_compliant", "one joint, compliant, torque rising in time, load proportional to speed",
         {"input.inertia": 0.05, "output.inertia": 0.08, "shaft.inertia_a": 0.003, "shaft.inertia_b": 0.002,
          "shaft.stiffness": 8000.0, "shaft.damping": 1.0, "initial.angle": 0.3, "initial.speed": 100.0,
          "initial.twist": 0.004, "initial.twist_rate": -1.5},
         joint1_angle=Polynomial(radians(20.0)),
         input_torque=Torque(50.0, 20.0), output_torque=Torque(0.0, 0.0, 0.5)),
    Case("double_compliant", "double joint 20/15 deg at 3000 rpm, compliant: the case of NUMERICS.md without ripple",
         {"initial.angle": 0.1, "initial.speed": 314.1592653589793, "initial.twist": 0.01},
         joint1_angle=Polynomial(radians(20.0)), joint2_angle=Polynomial(radians(15.0)),
         input_torque=Torque(200.0), output_torque=Torque(0.0, 0.0, 0.6)),
    Case("spatial", "spatial double joint: yoke phase and plane twist not equal, compliant",
         {"input.inertia": 0.12, "output.inertia": 0.4, "shaft.inertia_a": 0.006, "shaft.inertia_b": 0.004,
          "shaft.stiffness": 12000.0, "shaft.damping": 1.5, "shaft.yoke_phase": radians(25.0),
          "shaft.plane_twist": radians(40.0), "initial.angle": -1.1, "initial.speed": 150.0,
          "initial.twist": -0.003, "initial.twist_rate": 0.8},
         joint1_angle=Polynomial(radians(20.0)), joint2_angle=Polynomial(radians(35.0)),
         input_torque=Torque(70.0, -25.0, -0.05), output_torque=Torque(10.0, 15.0, 0.3)),
    Case("crossed_inertia", "spatial double joint with the inertia of both crosses, compliant",
         {"input.inertia": 0.15, "output.inertia": 0.25, "shaft.inertia_a": 0.005, "shaft.inertia_b": 0.007,
          "shaft.stiffness": 15000.0, "shaft.damping": 1.0, "shaft.yoke_phase": radians(-30.0),
          "shaft.plane_twist": radians(50.0), "initial.angle": 0.7, "initial.speed": 120.0,
          "initial.twist": 0.002, "initial.twist_rate": 1.0,
          **_crosses((0.011, 0.017, 0.023), (0.009, 0.004, 0.012))},
         joint1_angle=Polynomial(radians(30.0)), joint2_angle=Polynomial(radians(25.0)),
         input_torque=Torque(40.0, 10.0), output_torque=Torque(5.0, 0.0, 0.35)),
    Case("damped", "double joint with bearing drag, shaft damping and viscous trunnions, compliant",
         {"input.inertia": 0.1, "output.inertia": 0.3, "input.damping": 0.12, "output.damping": 0.21,
          "shaft.inertia_a": 0.004, "shaft.inertia_b": 0.006, "shaft.stiffness": 9000.0, "shaft.damping": 6.0,
          "shaft.yoke_phase": radians(15.0), "shaft.plane_twist": radians(-20.0),
          "initial.angle": 2.5, "initial.speed": 140.0, "initial.twist": 0.02, "initial.twist_rate": -3.0,
          **_trunnions((0.4, 0.9, 0.0), (0.7, 0.3, 0.0))},
         joint1_angle=Polynomial(radians(25.0)), joint2_angle=Polynomial(radians(30.0)),
         input_torque=Torque(60.0, 30.0), output_torque=Torque(8.0, -5.0)),
    Case("frictional", "double joint with Coulomb friction in both crosses, slow, compliant",
         {"input.inertia": 0.1, "output.inertia": 0.2, "shaft.inertia_a": 0.004, "shaft.inertia_b": 0.003,
          "shaft.stiffness": 5000.0, "shaft.damping": 3.0, "shaft.yoke_phase": radians(10.0),
          "shaft.plane_twist": radians(35.0), "initial.angle": 0.4, "initial.speed": 12.0,
          "initial.twist": 0.001, **_trunnions((0.0, 0.0, 1.5), (0.0, 0.0, 2.5))},
         joint1_angle=Polynomial(radians(25.0)), joint2_angle=Polynomial(radians(20.0)),
         input_torque=Torque(9.0, 4.0), output_torque=Torque(2.0, 0.0, 0.3)),
    Case("speed_driven", "double joint, compliant, input speed prescribed as a polynomial of degree two",
         {"model.drive": 1, "input.inertia": 0.1, "output.inertia": 0.5, "input.damping": 0.05,
          "output.damping": 0.02, "shaft.inertia_a": 0.006, "shaft.inertia_b": 0.005, "shaft.stiffness": 10000.0,
          "shaft.damping": 4.0, "shaft.yoke_phase": radians(-10.0), "shaft.plane_twist": radians(20.0),
          "initial.angle": 0.9, "initial.speed": 80.0, "initial.twist": 0.003, "initial.twist_rate": 0.5,
          **_crosses((0.008, 0.012, 0.016), (0.007, 0.003, 0.01)), **_trunnions((0.2, 0.3, 0.0), (0.25, 0.1, 0.0))},
         joint1_angle=Polynomial(radians(22.0)), joint2_angle=Polynomial(radians(33.0)),
         output_torque=Torque(15.0, 10.0, 0.25), speed_command=Polynomial(80.0, 120.0, -150.0)),
    Case("moving_angle", "double joint, compliant, both joint angles moving, with crosses and viscous trunnions",
         {"input.inertia": 0.14, "output.inertia": 0.35, "input.damping": 0.03, "output.damping": 0.04,
          "shaft.inertia_a": 0.02, "shaft.inertia_b": 0.015, "shaft.stiffness": 14000.0, "shaft.damping": 2.5,
          "shaft.yoke_phase": radians(20.0), "shaft.plane_twist": radians(-15.0),
          "initial.angle": -0.6, "initial.speed": 130.0, "initial.twist": 0.002, "initial.twist_rate": 0.4,
          **_crosses((0.01, 0.014, 0.02), (0.006, 0.009, 0.013)), **_trunnions((0.3, 0.2, 0.0), (0.15, 0.35, 0.0))},
         joint1_angle=Polynomial(0.15, 0.9, -0.8), joint2_angle=Polynomial(0.55, -0.7, 0.9),
         input_torque=Torque(45.0, 25.0), output_torque=Torque(6.0, 0.0, 0.3)),
    Case("rigid_double", "spatial double joint, rigid, with crosses, drag and viscous trunnions",
         {"model.fidelity": 1, "input.inertia": 0.18, "output.inertia": 0.3, "input.damping": 0.05,
          "output.damping": 0.06, "shaft.inertia_a": 0.01, "shaft.inertia_b": 0.02,
          "shaft.yoke_phase": radians(35.0), "shaft.plane_twist": radians(-25.0),
          "initial.angle": 1.3, "initial.speed": 110.0,
          **_crosses((0.012, 0.008, 0.021), (0.01, 0.006, 0.015)), **_trunnions((0.2, 0.3, 0.0), (0.1, 0.25, 0.0))},
         joint1_angle=Polynomial(radians(28.0)), joint2_angle=Polynomial(radians(18.0)),
         input_torque=Torque(35.0, 40.0, -0.02), output_torque=Torque(4.0, 12.0, 0.2)),
    Case("rigid_moving", "double joint, rigid, both joint angles moving",
         {"model.fidelity": 1, "input.inertia": 0.09, "output.inertia": 0.22, "output.damping": 0.03,
          "shaft.inertia_a": 0.015, "shaft.inertia_b": 0.01, "shaft.yoke_phase": radians(-12.0),
          "shaft.plane_twist": radians(30.0), "initial.angle": 0.2, "initial.speed": 95.0,
          **_crosses((0.009, 0.007, 0.014), (0.011, 0.005, 0.01)), **_trunnions((0.1, 0.2, 0.0), (0.15, 0.1, 0.0))},
         joint1_angle=Polynomial(0.2, 0.7, 0.6), joint2_angle=Polynomial(0.6, -0.8, 0.5),
         input_torque=Torque(30.0, 20.0), output_torque=Torque(3.0, 5.0, 0.25)),
)}
"""Every reference case by name."""
