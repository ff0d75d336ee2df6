"""Engines against their equations: maps at their points, slider-crank series, exact lag and governor, programs."""

from __future__ import annotations

import math
from pathlib import Path

import pytest
from cardan.models.base import Bus, Shaft
from cardan.models.csv_torque import CsvTorque
from cardan.models.cylinder import ATMOSPHERE, Cylinder
from cardan.models.four_stroke import FourStroke
from cardan.models.governor import IdleGovernor
from cardan.models.parameters import ParameterError
from cardan.models.prescribed_speed import PrescribedSpeed
from cardan.models.torque_map import TorqueMap

SPEEDS, THROTTLES = (0.0, 100.0, 250.0, 400.0), (0.0, 0.3, 1.0)
TORQUES = ((-10.0, -20.0, -30.0, -50.0), (50.0, 90.0, 110.0, 40.0), (90.0, 200.0, 240.0, 150.0))


@pytest.mark.parametrize("interpolation", ["smooth", "linear"])
def test_map_passes_through_its_points_and_holds_beyond(interpolation: str) -> None:
    engine = TorqueMap(SPEEDS, THROTTLES, TORQUES, interpolation=interpolation)
    for throttle, row in zip(THROTTLES, TORQUES):
        for speed, torque in zip(SPEEDS, row):
            assert engine.value(0.0, [], Shaft(0, speed, 0), Bus(throttle)) == pytest.approx(torque, abs=1e-12)
    outside = engine.torque(0.0, [], Shaft(0, 900.0, 0), Bus(1.0))
    assert outside == (pytest.approx(150.0), 0.0, 0.0)


def test_map_between_points() -> None:
    """Bilinear: the mean of four corners in the middle; smooth: monotone along each axis and without a slope jump."""
    middle = Shaft(0, 175.0, 0)
    linear = TorqueMap(SPEEDS, THROTTLES, TORQUES, interpolation="linear").value(0.0, [], middle, Bus(0.65))
    assert linear == pytest.approx((90.0 + 110.0 + 200.0 + 240.0) / 4.0, rel=1e-14)
    smooth = TorqueMap(SPEEDS, THROTTLES, TORQUES)
    rising = [smooth.value(0.0, [], Shaft(0, 100.0 + 1.5 * i, 0), Bus(1.0)) for i in range(101)]
    assert all(a < b for a, b in zip(rising, rising[1:]))
    for speed in SPEEDS[1:-1]:
        below, above = (smooth.torque(0.0, [], Shaft(0, speed + e, 0), Bus(0.8)).by_speed for e in (-1e-9, 1e-9))
        assert below == pytest.approx(above, abs=1e-8)


def test_lag_follows_first_order_step_exactly_in_its_derivative() -> None:
    engine = TorqueMap(SPEEDS, THROTTLES, TORQUES, lag=0.2)
    shaft, bus = Shaft(0, 100.0, 0), Bus(1.0)
    assert engine.derivative(0.0, [120.0], shaft, bus) == [pytest.approx((200.0 - 120.0) / 0.2)]
    assert engine.start(0.0, shaft, bus) == [pytest.approx(200.0)]
    assert engine.time_scale() == pytest.approx(0.04)


@pytest.mark.parametrize("ratio", [0.2, 0.3, 0.4])
def test_inertia_torque_against_the_classical_series(ratio: float) -> None:
    """T = m r^2 w^2 sum B_k sin k p; Biezeno and Grammel, Technische Dynamik II, 1953, chapter XIII: coefficients in
    lambda = r/l to fifth order. The next terms are lambda^6 and lambda^7, below 3 lambda^6 here."""
    m, r = 0.5, 0.045
    cylinder = Cylinder(stroke=2 * r, bore=0.08, rod=r / ratio, reciprocating_mass=m, orders=8)
    found = cylinder.inertia_orders(1)  # multiples of 1/2
    q = ratio
    expected = {1: q / 4 + q**3 / 16 + 15 * q**5 / 512, 2: -1 / 2 - q**4 / 32,
                3: -(3 * q / 4 + 9 * q**3 / 32 + 81 * q**5 / 512), 4: -(q**2 / 4 + q**4 / 8)}
    for k, b in expected.items():
        assert found[k][0] == pytest.approx(0.0, abs=1e-15)
        assert found[k][1] == pytest.approx(m * r * r * b, abs=3 * q**6 * m * r * r)
    assert all(abs(v) < 1e-15 for k in (0.5, 1.5, 2.5) for v in found[k])  # two strokes: whole orders only


def test_even_firing_keeps_multiples_of_half_the_number_of_cylinders() -> None:
    cylinder = Cylinder(stroke=0.09, bore=0.085, rod=0.15, reciprocating_mass=0.6)
    single = Cylinder(stroke=0.09, bore=0.085, rod=0.15, reciprocating_mass=0.6, orders=12).inertia_orders(1)
    four = cylinder.inertia_orders(4)
    assert sorted(four) == [2.0, 4.0, 6.0, 8.0, 10.0, 12.0]
    assert four[2.0][1] == pytest.approx(4.0 * single[2.0][1], rel=1e-12)
    assert sorted(cylinder.inertia_orders(3))[:2] == [1.5, 3.0]


def test_gas_torque_from_its_orders_is_the_cycle_of_four_pressures() -> None:
    """The orders of four cylinders, summed, against p(V) dV/dp of the cycle evaluated directly, where motored."""
    cylinder = Cylinder(stroke=0.09, bore=0.085, rod=0.15, reciprocating_mass=0.6, orders=40)
    motoring, firing = cylinder.gas_orders(4)
    area, clearance = math.pi / 4 * 0.085**2, 0.09 / 15.0

    def gas(p: float) -> float:  # of one cylinder, p = 0 firing top dead centre, compression from -pi, expansion to pi
        p = (p + math.pi) % (4.0 * math.pi) - math.pi
        if p > math.pi:
            return 0.0
        travel, slope = cylinder.travel(p)
        return ATMOSPHERE * (((clearance + 0.09) / (clearance + travel)) ** 1.33 - 1.0) * area * slope

    for angle in (0.2, 1.0, 2.9):
        direct = sum(gas(angle + i * math.pi) for i in range(4))
        series = sum(a * math.cos(k * angle) + b * math.sin(k * angle) for k, (a, b) in motoring.items())
        assert series == pytest.approx(direct, abs=0.02)  # corners of the cycle at the dead centres: 40 orders
    assert math.hypot(*firing[2.0]) > math.hypot(*firing[4.0]) > math.hypot(*firing[8.0]) > 0.0


def test_ripple_lists_and_phase() -> None:
    """T = M + sum (A + R (M + friction)) cos(k p - phase_k), p = angle + phase."""
    engine = FourStroke(torque_=100.0, orders=(2.0, 4.0), amplitudes=(60.0, 10.0), relative_amplitudes=(0.2, 0.0),
                        phases=(0.5, 0.0), phase=0.3, friction=10.0)
    for angle in (0.0, 1.1, 1e3):
        p = angle + 0.3
        expected = 100.0 + (60.0 + 0.2 * 110.0) * math.cos(2 * p - 0.5) + 10.0 * math.cos(4 * p)
        assert engine.value(0.0, [], Shaft(angle, 50.0, 0.0), Bus()) == pytest.approx(expected, rel=1e-12)
    assert FourStroke(torque_=5.0).torque(0.0, [], Shaft(1, 2, 3), Bus()) == (5.0, 0.0, 0.0)


def test_governor_is_a_pi_controller_inside_its_limits_and_unwinds_at_them() -> None:
    governor = IdleGovernor(speed=80.0, gain=2.0, integral_gain=4.0, torque_high=1e6, torque_low=-1e6, rounding=1e-3)
    assert governor.value(0.0, [7.0], Shaft(0, 75.0, 0), Bus()) == pytest.approx(2.0 * 5.0 + 7.0, abs=1e-9)
    assert governor.derivative(0.0, [7.0], Shaft(0, 75.0, 0), Bus()) == [pytest.approx(20.0, abs=1e-9)]
    limited = IdleGovernor(speed=80.0, gain=2.0, integral_gain=4.0, torque_high=50.0)
    assert limited.value(0.0, [900.0], Shaft(0, 79.0, 0), Bus()) == pytest.approx(50.0, abs=0.01)
    assert limited.derivative(0.0, [900.0], Shaft(0, 79.0, 0), Bus())[0] < -1000.0  # wound up: comes back fast
    assert limited.value(0.0, [0.0], Shaft(0, 300.0, 0), Bus()) == pytest.approx(0.0, abs=0.01)


def test_speed_programs() -> None:
    """Constant; straight ramp with two corners; quintic ramp whose derivatives are those of its polynomial."""
    assert PrescribedSpeed(speed=314.0).command(3.0) == (314.0, 0.0, 0.0)
    assert PrescribedSpeed(speed=314.0).next_event(0.0) == math.inf
    ramp = PrescribedSpeed(speed=10.0, final_speed=110.0, ramp_start=1.0, ramp_time=2.0)
    assert ramp.drive == 1
    assert [ramp.command(t) for t in (0.5, 1.0, 2.0, 3.0)] == [(10, 0, 0), (10, 50, 0), (60, 50, 0), (110, 0, 0)]
    assert [ramp.next_event(t) for t in (0.0, 1.0, 3.0)] == [1.0, 3.0, math.inf]
    smooth = PrescribedSpeed(speed=10.0, final_speed=110.0, ramp_start=1.0, ramp_time=2.0, shape="smooth")
    assert smooth.next_event(0.0) == math.inf
    d = 1e-4
    for t in (1.3, 2.0, 2.8):
        before, here, after = (smooth.command(t + s)[0] for s in (-d, 0.0, d))
        assert smooth.command(t)[1] == pytest.approx((after - before) / (2 * d), rel=1e-6)
        assert smooth.command(t)[2] == pytest.approx((after - 2 * here + before) / d**2, rel=1e-4, abs=1e-3)
    assert smooth.torque(0.0, [], Shaft(0, 1, 0), Bus()) == (0.0, 0.0, 0.0)


def test_csv_series(tmp_path: Path) -> None:
    path = tmp_path / "m.csv"
    path.write_text("# from a test\ntime,torque,other\n0,10,1\n1,30,1\n2,20,1\n4,20,1\n")
    linear = CsvTorque(file=path, column="torque", interpolation="linear")
    at = [linear.value(t, [], Shaft(0, 0, 0), Bus()) for t in (-1.0, 0.5, 1.5, 9.0)]
    assert at == [10.0, 20.0, 25.0, 20.0]
    assert [linear.next_event(t) for t in (-1.0, 0.0, 1.5, 4.0)] == [0.0, 1.0, 2.0, math.inf]
    smooth = CsvTorque(file=path, column="torque")
    values = [smooth.value(1e-3 * i, [], Shaft(0, 0, 0), Bus()) for i in range(4001)]
    assert min(values) == 10.0 and max(values) == 30.0  # a monotone cubic does not overshoot
    assert smooth.next_event(0.0) == 4.0


@pytest.mark.parametrize(("make", "key"), [
    (lambda: TorqueMap((0.0, 1.0), (0.0, 1.0), ((1.0, 2.0),)), "torques"),
    (lambda: TorqueMap((0.0, 0.0), (0.0, 1.0), TORQUES), "speeds"),
    (lambda: TorqueMap((0.0, 1.0), (1.0, 0.0), TORQUES), "throttles"),
    (lambda: FourStroke(torque_=1.0, map=TorqueMap(SPEEDS, THROTTLES, TORQUES)), "torque"),
    (lambda: FourStroke(orders=(2.0, 2.0)), "orders"),
    (lambda: FourStroke(orders=(0.7,)), "orders"),
    (lambda: FourStroke(orders=(2.0,), amplitudes=(1.0, 2.0)), "amplitudes"),
    (lambda: FourStroke(cylinders=0), "cylinders"),
    (lambda: Cylinder(stroke=0.1, bore=0.1, rod=0.04, reciprocating_mass=1.0), "rod"),
    (lambda: IdleGovernor(speed=80.0, gain=1.0, integral_gain=1.0, torque_high=-1.0), "torque_high"),
    (lambda: PrescribedSpeed(speed=math.nan), "speed"),
    (lambda: PrescribedSpeed(speed=1.0, shape="round"), "shape"),
    (lambda: CsvTorque(file=Path("no such file.csv"), column="x"), "file"),
])
def test_what_does_not_fit_is_named(make: object, key: str) -> None:
    with pytest.raises(ParameterError) as caught:
        make()  # type: ignore[operator]
    assert caught.value.key == key
    assert key in str(caught.value)


@pytest.mark.parametrize(("text", "key", "word"), [
    ("t,M\n0,1\n1,x\n", "file", "data row 2"),
    ("t,M\n0,1\n0,2\n", "file", "does not increase"),
    ("t,M\n0,1\n1,nan\n", "file", "not finite"),
    ("t,torque\n0,1\n1,2\n", "column", "nearest: torque"),
    ("t,M\n", "file", "header line and at least one row"),
])
def test_broken_series_say_where(tmp_path: Path, text: str, key: str, word: str) -> None:
    path = tmp_path / "m.csv"
    path.write_text(text)
    with pytest.raises(ParameterError, match=word) as caught:
        CsvTorque(file=path, column="torgue" if key == "column" else "M")
    assert caught.value.key == key


def test_units_in_the_headings_of_a_series(tmp_path: Path) -> None:
    path = tmp_path / "m.csv"
    path.write_text("t [ms],T [kN.m],p [bar],x [what]\n0,1,1,1\n1000,2,1,1\n")
    for column in ("T [kN.m]", "T"):
        engine = CsvTorque(file=path, column=column, interpolation="linear")
        assert engine.torque(0.5, [], Shaft(0.0, 0.0, 0.0), Bus()) == pytest.approx((1500.0, 1000.0, 0.0))
    for column in ("p", "x"):
        with pytest.raises(ParameterError, match="unit") as caught:
            CsvTorque(file=path, column=column)
        assert caught.value.key == "column"


def test_rows_at_nearly_the_same_time_are_refused(tmp_path: Path) -> None:
    path = tmp_path / "m.csv"
    path.write_text("t,T\n0,1\n1e-320,2\n")
    with pytest.raises(ParameterError, match="less than 1e-09 s at data row 2"):
        CsvTorque(file=path, column="T")


def test_an_engine_without_torque_and_orders_without_amplitudes_are_refused() -> None:
    with pytest.raises(ParameterError, match="no torque at all"):
        FourStroke()
    with pytest.raises(ParameterError, match="without amplitudes"):
        FourStroke(torque_=1.0, orders=(2.0,))
