"""Jacobians of the equations of motion: ``python -m tests.reference.jacobian`` writes ``jacobian.json``.

Central differences of the independent model in 50 digits with steps of 1e-15: the error of a difference, h^2 f'''/6,
stays some ten digits below a double's. States are the kernel's, (p, twist, w1, wy), rigid (p, w1), and with given
input speed (p, twist, wy). A includes the torques' ``by_speed`` parts, T = rest + K w; B and D are derivatives by the
rest, which at fixed states is the derivative by the FMU inputs ``input.torque`` and ``output.torque``.
"""

from __future__ import annotations

import json
from math import radians
from random import Random
from typing import Any

import mpmath

from tests.reference.arithmetic import Number, multiple_precision
from tests.reference.cases import CASES, Case, Polynomial, Torque
from tests.reference.generate import COLUMNS
from tests.reference.joint import joint_motion, output_angle
from tests.reference.model import Driveline
from tests.reference.table import FOLDER

DIGITS = 50
STEP = "1e-15"
SEED = 20240229
POINTS = 2
OUTPUTS = ("shaft.torque", "shaft.speed_a", "output.angle", "output.speed", "input.acceleration", "output.acceleration",
           "input.reaction_torque", "joint1.torque_in", "joint1.torque_out", "joint2.torque_in", "joint2.torque_out")

_EVERYTHING = {
    "input.inertia": 0.11, "output.inertia": 0.27, "input.damping": 0.04, "output.damping": 0.07,
    "shaft.inertia_a": 0.012, "shaft.inertia_b": 0.009, "shaft.stiffness": 11000.0, "shaft.damping": 2.2,
    "shaft.yoke_phase": radians(22.0), "shaft.plane_twist": radians(-31.0),
    **{f"joint{j}.{name}": value for j, shift in ((1, 0.0), (2, 0.003)) for name, value in (
        ("cross.inertia_a", 0.008 + shift), ("cross.inertia_b", 0.013 - shift), ("cross.inertia_m", 0.018 + shift),
        ("trunnion.damping_a", 0.2 + shift), ("trunnion.damping_b", 0.35 - shift),
        ("trunnion.friction", 1.5 + 100 * shift))},
}
EXTRA = [Case(f"everything_{kind}", "crosses, all frictions, drags, moving angles and torques by speed",
              {**_EVERYTHING, **changes}, Polynomial(0.4, 0.5, -0.6), Polynomial(0.3, -0.4, 0.7),
              Torque(0.0, 0.0, -0.3), Torque(0.0, 0.0, 0.4), Polynomial(60.0, 30.0, 0.0))
         for kind, changes in (("compliant", {"model.fidelity": 2}), ("rigid", {"model.fidelity": 1}),
                               ("driven", {"model.drive": 1}),
                               ("driven_rigid", {"model.drive": 1, "model.fidelity": 1}))]


class Point:
    """One operating point: state, inputs and the functions of them to be differentiated.

    Parameters
    ----------
    case : Case
        Parameters; the laws' values are replaced by random ones at the point.
    random : random.Random
        Source of the point.
    slow : bool
        Put w1 near 0.5 rad/s, so that trunnion rates fall inside the width of the smoothed friction.
    """

    def __init__(self, case: Case, random: Random, slow: bool = False) -> None:
        speed = random.uniform(0.1, 0.6) if slow else random.choice((-1, 1)) * random.uniform(5.0, 250.0)
        twist, rate = (random.uniform(-0.02, 0.02), random.uniform(-4.0, 4.0)) if not slow else (1e-3, 0.01)
        if case.parameters["model.fidelity"] == 1:
            twist, rate = 0.0, 0.0
        angle = random.uniform(-0.01, 0.01) if slow else random.uniform(-9.0, 9.0)
        at = random.random()
        case = case._replace(
            joint1_angle=case.joint1_angle.at(at), joint2_angle=case.joint2_angle.at(at),
            speed_command=Polynomial(speed, random.uniform(-50.0, 50.0), 0.0),
            given=case.given | {"initial.angle": angle, "initial.speed": speed, "initial.twist": twist,
                                "initial.twist_rate": rate})
        self.case = case
        self.line = line = Driveline(case, multiple_precision())
        bend = line.angle1
        self.wa = joint_motion(mpmath.mpf(angle), mpmath.mpf(speed), bend, line.trunnions[0], line.arithmetic).speed
        self.states = (["p", "twist", "wy"] if line.driven else ["p", "twist", "w1", "wy"]) if line.compliant else (
            ["p"] if line.driven else ["p", "w1"])
        self.inputs = ["output.torque"]
        self.inputs[:0] = ["input.speed_command", "input.speed_command.der1"] if line.driven else ["input.torque"]
        start = {"p": angle, "twist": twist, "w1": speed, "wy": self.wa - mpmath.mpf(rate)}
        self.x = [mpmath.mpf(start[name]) for name in self.states]
        output_speed = self._evaluate(self.x, [mpmath.mpf(0)] * len(self.inputs), command=speed)["output.speed"]
        self.fmu_inputs = case.inputs(0.0, speed, float(output_speed))
        for name in ("input.torque", "output.torque"):
            self.fmu_inputs[name] = random.uniform(-80.0, 80.0)
        # What the FMU holds is its input less by_speed times its own speed.
        held = {"input.torque": speed, "output.torque": output_speed}
        self.u = [mpmath.mpf(self.fmu_inputs[name]) - (self.fmu_inputs[f"{name}.by_speed"] * held[name] if name in held
                                                       else 0) for name in self.inputs]

    def _evaluate(self, x: list[Number], u: list[Number], command: float | None = None) -> dict[str, Number]:
        line, zero = self.line, mpmath.mpf(0)
        state, given = dict(zip(self.states, x, strict=True)), dict(zip(self.inputs, u, strict=True))
        if line.driven:
            speed = given["input.speed_command"] if command is None else mpmath.mpf(command)
            line.command = line.command._replace(angle=speed, rate=given["input.speed_command.der1"])
            state["w1"] = speed
        line.torque_in = (given.get("input.torque", zero), zero, line.torque_in[2])
        line.torque_out = (given["output.torque"], zero, line.torque_out[2])
        end = output_angle(state["p"], line.angle1.angle, line.arithmetic) - state.get("twist", zero)
        full = [state["p"], end, state["w1"], state.get("wy", zero), *[zero] * 4]
        move = line.motion(zero, full)
        values = {head.partition(" [")[0]: column(line, zero, full, move) for head, column in COLUMNS.items()}
        values |= {"p'": move.input_speed, "twist'": move.first.speed - move.speed_y, "w1'": move.input_acceleration,
                   "wy'": move.acceleration_y}
        return values

    def record(self) -> dict[str, Any]:
        """Return the point with its derivative, outputs and Jacobians as plain lists of floats."""
        rates = [f"{name}'" for name in self.states]
        h = mpmath.mpf(STEP)
        columns: list[dict[str, Number]] = []
        for i in range(len(self.x) + len(self.u)):
            ends = []
            for sign in (1, -1):
                z = [*self.x, *self.u]
                z[i] += sign * h
                ends.append(self._evaluate(z[:len(self.x)], z[len(self.x):]))
            columns.append({name: (ends[0][name] - ends[1][name]) / (2 * h) for name in (*rates, *OUTPUTS)})
        value = self._evaluate(self.x, self.u)
        by_state, by_input = columns[:len(self.x)], columns[len(self.x):]

        def matrix(names: tuple[str, ...] | list[str], by: list[dict[str, Number]]) -> list[list[float]]:
            return [[float(column[name]) for column in by] for name in names]

        return {"case": self.case.name, "parameters": self.case.parameters, "inputs": self.fmu_inputs,
                "states": self.states, "state": [float(v) for v in self.x], "by": self.inputs, "outputs": OUTPUTS,
                "derivative": [float(value[name]) for name in rates],
                "values": [float(value[name]) for name in OUTPUTS],
                "A": matrix(rates, by_state), "B": matrix(rates, by_input),
                "C": matrix(OUTPUTS, by_state), "D": matrix(OUTPUTS, by_input)}


def main() -> None:
    """Write ``jacobian.json``: two random points of every case, and one slow one where there is Coulomb friction."""
    random = Random(SEED)
    points = []
    with mpmath.workdps(DIGITS):
        for case in [*CASES.values(), *EXTRA]:
            slow = case.parameters["joint1.trunnion.friction"] > 0
            points += [Point(case, random, slow=slow and i == POINTS).record() for i in range(POINTS + slow)]
    head = {"command": "python -m tests.reference.jacobian", "digits": DIGITS, "step": STEP, "seed": SEED}
    lines = ",\n".join(json.dumps(point) for point in points)
    (FOLDER / "jacobian.json").write_text(json.dumps(head)[:-1] + f',\n"points": [\n{lines}\n]}}\n', encoding="ascii")
    print(f"jacobian.json: {len(points)} points")


if __name__ == "__main__":
    main()
