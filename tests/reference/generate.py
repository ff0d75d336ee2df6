"""Make the reference trajectories: ``python -m tests.reference.generate [case...]``.

Each case runs twice, with other digits, other tolerance and other order; the file keeps the first run and says
how far the second one is from it. About 15 s to a minute a case.
"""

from __future__ import annotations

import argparse
import math
from collections.abc import Callable
from decimal import Decimal

from tests.reference.arithmetic import Number, decimal_arithmetic
from tests.reference.cases import CASES, Case
from tests.reference.extrapolation import integrate
from tests.reference.model import Driveline, Motion, State
from tests.reference.table import save

SAMPLES = 10
STOP_TIME = 1

COLUMNS: dict[str, Callable[[Driveline, Number, State, Motion], Number]] = {
    "input.angle [rad]": lambda line, t, x, move: x[0],
    "input.speed [rad/s]": lambda line, t, x, move: move.input_speed,
    "input.acceleration [rad/s2]": lambda line, t, x, move: move.input_acceleration,
    "shaft.twist [rad]": lambda line, t, x, move: move.twist,
    "shaft.torque [N.m]": lambda line, t, x, move: move.shaft_torque,
    "shaft.speed_a [rad/s]": lambda line, t, x, move: move.first.speed,
    "shaft.speed_b [rad/s]": lambda line, t, x, move: move.speed_y,
    "output.angle [rad]": lambda line, t, x, move: line.output_angle(t, x),
    "output.speed [rad/s]": lambda line, t, x, move: move.second.speed,
    "output.acceleration [rad/s2]": lambda line, t, x, move: move.output_acceleration,
    "input.reaction_torque [N.m]": lambda line, t, x, move: move.input_torque,
    "joint1.torque_in [N.m]": lambda line, t, x, move: line.joint_torques(move)[0],
    "joint1.torque_out [N.m]": lambda line, t, x, move: line.joint_torques(move)[1],
    "joint2.torque_in [N.m]": lambda line, t, x, move: line.joint_torques(move)[2],
    "joint2.torque_out [N.m]": lambda line, t, x, move: line.joint_torques(move)[3],
    "joint1.ratio [1]": lambda line, t, x, move: move.first.ratio,
    "joint2.ratio [1]": lambda line, t, x, move: move.second.ratio,
    "joint1.trunnion.rate_in [rad/s]": lambda line, t, x, move: move.first.rate_a,
    "joint1.trunnion.rate_out [rad/s]": lambda line, t, x, move: -move.first.rate_b,
    "joint2.trunnion.rate_in [rad/s]": lambda line, t, x, move: move.second.rate_a,
    "joint2.trunnion.rate_out [rad/s]": lambda line, t, x, move: -move.second.rate_b,
    "power.loss [W]": lambda line, t, x, move: line.loss(move),
    "energy.kinetic [J]": lambda line, t, x, move: line.energies(move)[0],
    "energy.strain [J]": lambda line, t, x, move: line.energies(move)[1],
    "work.supplied [J]": lambda line, t, x, move: x[4],
    "work.delivered [J]": lambda line, t, x, move: x[5],
    "work.dissipated [J]": lambda line, t, x, move: x[6],
    "work.angles [J]": lambda line, t, x, move: x[7],
}
"""What is recorded. ``work.*`` are integrals from time 0 and no FMU variables: by input torque, by load, as heat,
and by whoever moves the joint angles."""


def trajectory(case: Case, digits: int, tolerance: float, columns: int) -> list[list[Decimal]]:
    """Return one row per sample: the time in s, then :data:`COLUMNS`."""
    line = Driveline(case, decimal_arithmetic(digits))
    times = [Decimal(STOP_TIME * i) / SAMPLES for i in range(SAMPLES + 1)]
    scale = [1.0, 1.0, 100.0, 100.0, *[math.inf] * 4]
    rows = []
    for t, x in zip(times, integrate(line.derivative, times, line.initial_state(), scale, tolerance, columns),
                    strict=True):
        move = line.motion(t, x)
        rows.append([t, *(column(line, t, x, move) for column in COLUMNS.values())])
    return rows


def residual(rows: list[list[Decimal]]) -> float:
    """Return the largest energy residual in J: supplied - delivered - dissipated - stored, relative to time 0."""
    at = {head.partition(" [")[0]: i + 1 for i, head in enumerate(COLUMNS)}

    def total(row: list[Decimal]) -> Decimal:
        stored = row[at["energy.kinetic"]] + row[at["energy.strain"]]
        gained = row[at["work.supplied"]] + row[at["work.angles"]]
        return gained - row[at["work.delivered"]] - row[at["work.dissipated"]] - stored

    return max(abs(float(total(row) - total(rows[0]))) for row in rows)


def generate(case: Case) -> None:
    """Compute, confirm and write one case."""
    rows = trajectory(case, 34, 1e-20, 12)
    again = trajectory(case, 44, 1e-23, 14)
    heads = ["time [s]", *COLUMNS]
    worst = {head: max(float(abs(a[i] - b[i])) for a, b in zip(rows, again, strict=True))
             for i, head in enumerate(heads)}
    by_unit: dict[str, float] = {}
    for head, error in worst.items():
        unit = head.partition(" [")[2].rstrip("]")
        by_unit[unit] = max(error, by_unit.get(unit, 0.0))
    comments = [
        f"{case.name}: {case.title}",
        f"command: python -m tests.reference.generate {case.name}",
        "method: tests/reference/model.py in 34-digit decimal, Gragg-Bulirsch-Stoer of order 24, "
        "tolerance 1e-20 per step",
        "confirmed by 44 digits, order 28, tolerance 1e-23; largest difference of any column: "
        + ", ".join(f"{error:.0e} {unit}" for unit, error in by_unit.items() if unit != "s"),
        f"energy residual: {residual(rows):.0e} J (work.angles counted as supplied)",
        *(f"{name} = {value!r}" for name, value in case.parameters.items()),
        *case.law_texts(),
    ]
    path = save(case.name, comments, heads, [[f"{+row[0]}", *(f"{x:.20g}" for x in row[1:])] for row in rows])
    print(f"{path.name}: confirmed to {max(by_unit.values()):.0e}", flush=True)


def main() -> None:
    """Generate the named cases, or all."""
    parser = argparse.ArgumentParser(description="Make the reference trajectories of the driveline.")
    parser.add_argument("cases", nargs="*", metavar="case", help=f"any of {', '.join(CASES)}; all without one")
    names = parser.parse_args().cases or list(CASES)
    unknown = [name for name in names if name not in CASES]
    if unknown:
        parser.error(f"unknown case {', '.join(unknown)}: choose from {', '.join(CASES)}")
    for name in names:
        generate(CASES[name])


if __name__ == "__main__":
    main()
