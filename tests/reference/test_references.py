"""The references checked against closed forms, against models of other authors, and against their own files."""

from __future__ import annotations

import csv
import json
import math
from decimal import Decimal
from random import Random

import mpmath
import pytest

from tests import systems
from tests.reference import jacobian
from tests.reference.arithmetic import Number, decimal_arithmetic, multiple_precision
from tests.reference.cases import CASES, Case, Polynomial, Torque
from tests.reference.extrapolation import integrate
from tests.reference.generate import trajectory
from tests.reference.hill import coefficient
from tests.reference.joint import Bend, Trunnions, joint_motion, output_angle
from tests.reference.model import Driveline
from tests.reference.table import FOLDER, load

SCALE = [1.0, 1.0, 100.0, 100.0, *[math.inf] * 4]


def run(line: Driveline, times: list[float], start: list[Number] | None = None) -> list[list[Decimal]]:
    """Integrate to 1e-17 per step."""
    numbers = [Decimal(t) for t in times]
    return list(integrate(line.derivative, numbers, start or line.initial_state(), SCALE, 1e-17, 9))


def test_decimal_functions_equal_mpmath() -> None:
    """40-digit cosine, sine and arctangent; an angle of 400 rad costs three digits behind the point."""
    arithmetic, random = decimal_arithmetic(40), Random(1)
    with mpmath.workdps(60):
        for _ in range(100):
            x, tangent = Decimal(random.uniform(-400, 400)), Decimal(random.gauss(0, 2))
            got = (*arithmetic.cos_sin(x), arithmetic.atan(tangent))
            want = (*mpmath.cos_sin(mpmath.mpf(str(x))), mpmath.atan(mpmath.mpf(str(tangent))))
            for a, b in zip(got, want, strict=True):
                assert abs(mpmath.mpf(str(a)) - b) < 1e-36


@pytest.mark.parametrize("seed", range(8))
def test_joint_from_vectors_equals_the_closed_forms(seed: int) -> None:
    """docs/PHYSICS.md section 2 and 3: phi_out, r, g, w_a', Jc and its slope, rates; 40 digits on both sides."""
    random = Random(seed)
    p, w, beta = random.uniform(-9, 9), random.uniform(-200, 200), random.uniform(0.05, 1.4)
    rate, acceleration = random.uniform(-3, 3), random.uniform(-20, 20)
    inertias = [random.random() for _ in range(3)]
    damping = [random.random() for _ in range(2)]
    with mpmath.workdps(40):
        arithmetic, mpf = multiple_precision(), mpmath.mpf
        trunnions = Trunnions(*(mpf(x) for x in (*inertias, *damping, 0.0)))
        moving = joint_motion(mpf(p), mpf(w), Bend(mpf(beta), mpf(rate), mpf(acceleration)), trunnions, arithmetic)
        fixed = joint_motion(mpf(p), mpf(w), Bend(mpf(beta), mpf(0), mpf(0)), trunnions, arithmetic)
        angle = output_angle(mpf(p), mpf(beta), arithmetic)
    exact = systems.exact
    w, rate = exact.mpf(w), exact.mpf(rate)                              # no product below is one of doubles
    r, g = systems.joint_ratio(p, beta), systems.joint_swing(p, beta)
    slope = exact.diff(lambda q: systems.cross_inertia(q, beta, *inertias), exact.mpf(p), h=exact.mpf(10) ** -12)
    r_beta = exact.diff(lambda b: systems.joint_ratio(p, b), exact.mpf(beta))
    g_beta = exact.diff(lambda b: systems.joint_swing(p, b), exact.mpf(beta))
    steady = (systems.joint_ratio_slope(p, beta) * w**2 + 2 * r_beta * w * rate + g_beta * rate**2 + g * acceleration)
    rate_a, rate_b = systems.trunnion_rates(p, beta, w)
    d = exact.cos(beta) / r
    s, c = exact.sin(beta), exact.cos(beta)
    viscous = w * s**2 * (damping[0] * r**2 * exact.cos(p) ** 2
                          + damping[1] * exact.sin(systems.joint_output(p, beta)) ** 2)
    pairs = [(angle, systems.joint_output(p, beta)), (moving.ratio, r), (moving.swing, g),
             (moving.speed, r * w + g * rate), (moving.steady, steady),
             (moving.inertia, systems.cross_inertia(p, beta, *inertias)),
             (moving.inertia_slope, slope), (fixed.rate_a, rate_a), (fixed.rate_b, -rate_b),
             (moving.rate_a, rate_a + exact.sin(p) / d * rate),
             (moving.rate_b, c * exact.cos(p) / exact.sqrt(d) * rate - rate_b), (fixed.resistance, viscous)]
    for got, want in pairs:
        assert abs(exact.mpf(got) - want) < 1e-18 * (1 + abs(want))      # the numerical derivatives' own error


@pytest.mark.parametrize("damping", [0.0, 3.0, 900.0])
def test_straight_driveline_equals_the_torsional_shaft(damping: float) -> None:
    """All joint angles zero: two inertias on a spring, under- and overdamped, torques rising in time."""
    case = Case("straight", "", {"input.inertia": 0.2, "output.inertia": 0.5, "shaft.inertia_a": 0.01,
                                 "shaft.inertia_b": 0.02, "shaft.stiffness": 3000.0, "shaft.damping": damping,
                                 "initial.angle": 0.4, "initial.speed": 7.0, "initial.twist": 0.02,
                                 "initial.twist_rate": -1.0},
                Polynomial(), Polynomial(), Torque(10.0, 5.0), Torque(3.0, -2.0))
    line = Driveline(case, decimal_arithmetic(30))
    time = 0.3
    end = run(line, [0.0, time])[-1]
    exact = systems.torsional_shaft(time, exact_sum(0.2, 0.01), exact_sum(0.5, 0.02), 3000.0, damping,
                                    (0.4, 7.0, 0.02, -1.0), (10.0, 5.0), (3.0, -2.0))
    wanted = (exact.input_angle, exact.output_angle, exact.input_speed, exact.output_speed)
    for got, want in zip(end, wanted, strict=False):
        assert abs(mpmath.mpf(str(got)) - want) < 1e-15
    energy = line.energies(line.motion(Decimal(time), end))
    start = line.energies(line.motion(Decimal(0), line.initial_state()))
    assert abs(sum(energy) - sum(start) - (end[4] - end[5] - end[6])) < 1e-14


def exact_sum(a: float, b: float) -> systems.Real:
    """Return a + b without rounding to a double."""
    return systems.exact.mpf(a) + b


def test_rigid_joint_rotates_freely() -> None:
    """w = w0 sqrt(M0/M) at the time that quadrature gives."""
    case = Case("free", "", {"model.fidelity": 1, "input.inertia": 0.2, "output.inertia": 0.3, "shaft.inertia_a": 0.0,
                             "shaft.inertia_b": 0.0, "initial.angle": 0.3, "initial.speed": 10.0}, Polynomial(1.1))
    end = run(Driveline(case, decimal_arithmetic(30)), [0.0, 0.4])[-1]
    p = systems.exact.mpf(str(end[0]))
    assert abs(systems.free_rotation_time(p, 0.3, 10.0, 1.1, 0.2, 0.3) - 0.4) < 1e-16
    assert abs(systems.free_rotation(p, 0.3, 10.0, 1.1, 0.2, 0.3) - systems.exact.mpf(str(end[2]))) < 1e-14


class SineDriven(Driveline):
    """The engine of driven_single.csv: 50 + 20 sin(80 pi t) N.m."""

    def engine_torque(self, t: Number, speed: Number) -> Number:
        """Return the torque in N.m at time `t` in s."""
        return 50 + 20 * self.arithmetic.cos_sin(80 * self.arithmetic.pi * t)[1]


def _given_rows(name: str) -> list[dict[str, float]]:
    lines = (FOLDER / f"{name}.csv").read_text(encoding="ascii").splitlines()
    return [{key: float(value) for key, value in row.items()} for row in csv.DictReader(lines[1:])]


def test_model_equals_the_multibody_check_values() -> None:
    """driven_single.csv has 15 digits, angles good to 1e-12, speeds to 1e-10; torques by k = 8000 N.m/rad to 1e-8."""
    rows = _given_rows("driven_single")
    case = Case("driven", "", {"input.inertia": 0.05, "output.inertia": 0.08, "shaft.inertia_a": 0.0,
                               "shaft.inertia_b": 0.0, "shaft.stiffness": 8000.0, "shaft.damping": 1.0,
                               "initial.speed": 100.0},
                Polynomial(math.radians(20.0)), output_torque=Torque(0.0, 0.0, 0.5))
    line = SineDriven(case, decimal_arithmetic(30))
    start = line.initial_state()
    start[3] = Decimal(100)
    times = [row["t_s"] for row in rows]
    for t, x, row in zip(times, run(line, times, start), rows, strict=True):
        move = line.motion(Decimal(t), x)
        torque_in, torque_out, _, _ = line.joint_torques(move)
        phi2 = x[1] + move.twist
        tangent = math.tan(math.radians(20.0))
        for got, key, tolerance in ((x[0], "phi1_rad", 1e-12), (phi2, "phi2_rad", 1e-12), (x[2], "w1_rad_s", 1e-10),
                                    (move.first.speed, "w2_rad_s", 1e-10), (move.second.speed, "w3_rad_s", 1e-10),
                                    (line.output_angle(Decimal(t), x), "theta3_rad", 1e-12),
                                    (move.shaft_torque, "Tshaft_Nm", 1e-8),
                                    (float(torque_in) * tangent * math.sin(x[0]), "B1_Nm", 1e-8),
                                    (float(torque_out) * tangent * math.cos(phi2), "B2_Nm", 1e-8)):
            assert abs(float(got) - row[key]) < tolerance, (t, key)


def test_spatial_pair_equals_the_multibody_check_values() -> None:
    """spatial_pair.csv, 15 digits: psi minus theta inside the joint-2 angle."""
    psi, theta = math.radians(25.0), math.radians(40.0)
    for row in _given_rows("spatial_pair"):
        pair = systems.pair(row["phi1_rad"], math.radians(20.0), math.radians(35.0), psi, theta)
        assert abs(pair.shaft - row["phi2_rad"]) < 2e-14
        assert abs(pair.output + psi - theta + systems.exact.pi / 2 - row["phi3_rad"]) < 2e-14
        assert abs(pair.ratio * row["w1_rad_s"] - row["w3_rad_s"]) < 2e-12


def test_literature_corrected() -> None:
    """docs/PHYSICS.md section 5 (Fligiel at 314 rad/s), and section 4, to the printed digits."""
    for degrees, acceleration, angle in ((10, 3019.6, 44.12), (20, 12321.1, 41.46), (30, 29043.5, 37.02)):
        figures = systems.fligiel(math.radians(degrees), 314.0, 0.008794)
        assert abs(figures.acceleration - acceleration) < 0.06
        assert abs(math.degrees(figures.angle) - angle) < 0.006
    kappa = systems.layout(math.radians(25), math.radians(25), math.radians(-40), math.radians(40)).kappa
    assert abs(kappa - 1.2138) < 5e-5
    assert systems.layout(0.4, 0.4, 0.7, 0.7).nonuniformity < 1e-19


@pytest.mark.parametrize("name", CASES)
def test_file_matches_its_case_and_balances(name: str) -> None:
    """The CSV was made from these parameters; its energies balance; a coarser run of 0.1 s gives its second row."""
    case, table = CASES[name], load(name)
    for key, value in case.parameters.items():
        assert f"{key} = {value!r}" in table.comments
    assert set(case.law_texts()) <= set(table.comments)
    stored = [a + b for a, b in zip(table["energy.kinetic"], table["energy.strain"], strict=True)]
    for i, energy in enumerate(stored):
        gained = table["work.supplied"][i] + table["work.angles"][i]
        lost = table["work.delivered"][i] + table["work.dissipated"][i]
        assert abs(energy - stored[0] - gained + lost) < 1e-15 * (energy + gained + lost)    # rounding of doubles
    line = Driveline(case, decimal_arithmetic(26))
    x = run(line, [0.0, 0.1])[-1]
    want = table.row(1)
    t = Decimal("0.1")
    for got, key in ((x[0], "input.angle"), (line.motion(t, x).input_speed, "input.speed"),
                     (line.output_angle(t, x), "output.angle"), (line.motion(t, x).shaft_torque, "shaft.torque")):
        assert abs(float(got) - want[key]) < 2e-14 * (1 + abs(want[key])), key


def test_trajectory_starts_at_the_files_first_row() -> None:
    """Every column of the first row, from the present code, in the order of the header."""
    rows = trajectory(CASES["rigid_double"], 20, 1e-12, 6)
    table = load("rigid_double")
    assert len(rows[0]) == len(table.columns)
    for got, (key, column) in zip(rows[0], table.columns.items(), strict=True):
        assert abs(float(got) - column[0]) <= 1e-14 * (1 + abs(column[0])), key


def _monodromy_trace(beta: float, nu: float) -> Decimal:
    """Return the trace of the map over one period pi of y'' + nu^-2 r^2 y = 0."""
    arithmetic = decimal_arithmetic(30)
    c, s = arithmetic.cos_sin(Decimal(beta))
    square = Decimal(nu) ** 2

    def f(p: Number, x: list[Number]) -> list[Number]:
        r = c / (1 - (s * arithmetic.cos_sin(p)[0]) ** 2)
        return [x[1], -r * r / square * x[0], x[3], -r * r / square * x[2]]

    start = [Decimal(1), Decimal(0), Decimal(0), Decimal(1)]
    end = list(integrate(f, [Decimal(0), arithmetic.pi], start, [1.0] * 4, 1e-19, 10, first=0.1))[-1]
    return Decimal(end[0] + end[3])


def test_hill_edges_have_trace_two() -> None:
    """On a transition curve the monodromy matrix over pi has the trace 2 (-1)^region."""
    table = load("hill_edges")
    for i, (angle, region) in enumerate(zip(table["angle"], table["region"], strict=True)):
        for edge in ("nu_low", "nu_high"):
            trace = _monodromy_trace(angle, table[edge][i])
            assert abs(trace - 2 * (-1) ** int(region)) < 3e-14, (angle, region, edge)   # nu rounded to a double


def test_hill_growth_equals_the_monodromy() -> None:
    """2 cosh(pi mu) = |trace| where unstable, |trace| < 2 where the table says 0."""
    table = load("hill_growth")
    for angle, nu, mu in zip(table["angle"], table["nu"], table["growth"], strict=True):
        trace = abs(_monodromy_trace(angle, nu))
        assert abs(2 * math.cosh(math.pi * mu) - float(trace)) < 2e-15 if mu else trace < 2, (angle, nu)


def test_hill_coefficients_are_the_fourier_coefficients() -> None:
    """A_m against the integral of r^2 exp(-2imp)."""
    beta = 0.7
    q = mpmath.tan(mpmath.mpf(beta) / 2) ** 2
    for m in range(4):
        integral = systems.exact.quad(lambda p, m=m: systems.joint_ratio(p, beta) ** 2 * systems.exact.cos(2 * m * p),
                                      systems.exact.linspace(0, systems.exact.pi, 9)) / systems.exact.pi
        assert abs(integral - coefficient(m, q)) < 1e-14


def test_jacobian_file_is_made_by_the_present_code() -> None:
    """The first points again, from the same seed; the rest of the file repeats the same procedure."""
    points = json.loads((FOLDER / "jacobian.json").read_text(encoding="ascii"))["points"]
    random = Random(jacobian.SEED)
    with mpmath.workdps(jacobian.DIGITS):
        for want in points[:4]:
            got = jacobian.Point(CASES[want["case"]], random).record()
            assert json.loads(json.dumps(got)) == want
    assert {point["case"] for point in points} == {*CASES, *(case.name for case in jacobian.EXTRA)}


def test_straight_shaft_jacobian_is_the_textbook_one() -> None:
    """Joint angles zero: A of two inertias, spring, dampers, and torques by speed."""
    case = Case("straight", "", {"input.inertia": 0.2, "output.inertia": 0.5, "shaft.inertia_a": 0.1,
                                 "shaft.inertia_b": 0.2, "shaft.stiffness": 3000.0, "shaft.damping": 4.0,
                                 "input.damping": 0.3, "output.damping": 0.7},
                Polynomial(), Polynomial(), Torque(0.0, 0.0, -0.2), Torque(0.0, 0.0, 0.6))
    with mpmath.workdps(jacobian.DIGITS):
        record = jacobian.Point(case, Random(3)).record()
    a, b = 0.3, 0.7
    want = [[0, 0, 1, 0], [0, 0, 1, -1],
            [0, -3000 / a, (-4 - 0.3 - 0.2) / a, 4 / a], [0, 3000 / b, 4 / b, (-4 - 0.7 - 0.6) / b]]
    for got_row, row in zip(record["A"], want, strict=True):
        assert got_row == pytest.approx(row, rel=1e-14, abs=1e-20)
    assert record["B"][2] == pytest.approx([1 / a, 0]) and record["B"][3] == pytest.approx([0, -1 / b])
