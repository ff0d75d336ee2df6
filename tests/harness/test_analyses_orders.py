"""Order spectra against the Fourier series of the joint, order tracking, and the Campbell diagram."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from cardan.analyses.campbell import campbell, engine_orders
from cardan.analyses.order_spectrum import orders
from cardan.analyses.plant import Plant
from cardan.errors import InputError
from cardan.result import Result, RunInfo

from tests.harness.analysis_scenes import scene, single


def ramp(columns: Any, stop: float = 2.0, count: int = 8001, with_angle: bool = True) -> Result:
    """Make a run-up: 50 to 150 rad/s, columns as functions of time, angle and speed."""
    t = np.linspace(0.0, stop, count)
    speed = 50.0 + 50.0 * t
    angle = 50.0 * t + 25.0 * t * t
    made = {"input.angle": angle} if with_angle else {}
    made |= {"input.speed": speed} | {name: f(t, angle, speed) for name, f in columns.items()}
    units = dict.fromkeys(made, "N.m") | {"input.angle": "rad", "input.speed": "rad/s"}
    return Result(t, made, {n: units[n] for n in made}, RunInfo(title="ramp"))


def test_orders_of_a_joint_are_those_of_its_series() -> None:
    # r = 1 + 2 sum q^n cos 2np (docs/PHYSICS.md section 2), at any course of the speed
    q = math.tan(math.radians(15.0)) ** 2
    c, s = math.cos(math.radians(30.0)), math.sin(math.radians(30.0))
    run = ramp({"ratio": lambda t, p, w: c / (1.0 - (s * np.cos(p)) ** 2)})
    found = orders(run, "ratio", highest=8.0)
    for n in range(1, 5):
        assert found.amplitude("ratio", 2 * n) == pytest.approx(2.0 * q**n, rel=1e-7)
        assert np.angle(found.lines["ratio"][4 * n]) == pytest.approx(0.0, abs=1e-6)
    assert found.lines["ratio"][0].real == pytest.approx(1.0, rel=1e-12)
    others = [o for o in found.orders[1:] if o % 2.0]
    assert max(found.amplitude("ratio", o) for o in others) < 1e-9  # no leakage
    assert found.turns == 30


def test_half_orders_and_phases() -> None:
    run = ramp({"torque": lambda t, p, w: 7.0 + 3.0 * np.cos(1.5 * p + 0.4) - 2.0 * np.sin(4.0 * p)})
    found = orders(run, "torque")
    assert found.lines["torque"][0].real == pytest.approx(7.0, rel=1e-9)
    assert found.amplitude("torque", 1.5) == pytest.approx(3.0, rel=1e-9)
    assert np.angle(found.lines["torque"][3]) == pytest.approx(0.4, abs=1e-8)
    assert np.angle(found.lines["torque"][8]) == pytest.approx(0.5 * math.pi, abs=1e-7)
    assert found.leading("torque", 2) == [(1.5, pytest.approx(3.0)), (4.0, pytest.approx(2.0))]


def test_angle_from_the_speed_where_none_was_recorded() -> None:
    signal = {"torque": lambda t, p, w: 3.0 * np.cos(2.0 * p)}
    assert orders(ramp(signal, with_angle=False), "torque").amplitude("torque", 2) == pytest.approx(3.0, rel=1e-8)


def test_tracking_follows_an_amplitude_over_a_run_up() -> None:
    run = ramp({"torque": lambda t, p, w: 1e-3 * w * w * np.cos(2.0 * p) + 5.0 * np.cos(4.0 * p) + 0.3 * w})
    found = orders(run, "torque", track="2,4", window=4)
    second, fourth = found.tracks
    assert second.order == 2.0
    # w^2 grows by 2 a per angle (a = 50 rad/s2), so its mean over a window is (mean w)^2 + (change of w)^2 / 4
    change = 2.0 * 50.0 * 8.0 * math.pi / (2.0 * second.speeds)
    assert second.amplitudes == pytest.approx(1e-3 * (second.speeds**2 + 0.25 * change**2), rel=1e-2)
    assert fourth.amplitudes == pytest.approx(5.0, rel=1e-2)
    assert np.all(np.diff(second.speeds) > 0.0)
    assert second.speeds[-1] > 140.0


def test_file_and_picture(tmp_path: Path) -> None:
    found = orders(ramp({"torque": lambda t, p, w: np.cos(2.0 * p)}), track=[2.0])
    found.save(tmp_path / "orders.csv")
    found.plot(tmp_path / "orders.png")
    lines = (tmp_path / "orders.csv").read_text().splitlines()
    assert lines[0] == "order,signal,unit,amplitude,phase_rad"
    assert len(lines) == 1 + 2 * 25  # input.speed and torque, orders 0 to 12 by 0.5
    assert (tmp_path / "orders.png").stat().st_size > 10_000


@pytest.mark.parametrize(("options", "words"), [
    ({"signals": "torqe"}, "--signal torqe: was not recorded; recorded are input.angle, input.speed, torque"),
    ({"track": "2,x"}, "--track 2,x: must be orders with commas"),
    ({"track": "1.3"}, "--track 1.3: orders are multiples of 0.5"),
    ({"highest": 500.0}, "points per turn, too few for order 500"),
    ({"highest": 0.0}, "--max-order 0"),
    ({"window": 0}, "--window 0"),
])
def test_bad_input(options: dict[str, Any], words: str) -> None:
    with pytest.raises(InputError) as error:
        orders(ramp({"torque": lambda t, p, w: p}), **options)
    assert words in str(error.value)


def test_runs_without_orders() -> None:
    t = np.linspace(0.0, 1.0, 200)
    with pytest.raises(InputError, match=r"0\.159 turns; orders need at least two"):
        orders(Result(t, {"input.angle": t}, {"input.angle": "rad"}))
    with pytest.raises(InputError, match=r"turns back at t = 1 s"):
        orders(Result(t, {"input.angle": 50.0 * (t - 0.55 * t * t)}, {"input.angle": "rad"}))
    with pytest.raises(InputError, match=r"neither input\.angle nor input\.speed"):
        orders(Result(t, {"x": t}, {"x": "1"}))


def test_campbell_diagram_lists_its_crossings() -> None:
    engine = {"type": "four_stroke", "torque": 50.0, "orders": [2, 4, 1.5], "amplitudes": [30.0, 10.0, 3.0]}
    made = scene({"joint1.angle": "10 deg", "shaft.damping": 1.0}, engine, {"type": "linear", "coefficient": 0.1})
    assert engine_orders(Plant(made)) == [1.5, 2.0, 4.0]
    found = campbell(made, "400 rpm:3000 rpm:14")
    assert found.orders == {1.5: "engine", 2.0: "joints and engine", 4.0: "joints and engine", 6.0: "joints"}
    k, j1, j3 = 2e4, 0.2044, 1.5044
    natural = math.sqrt(k * (1.0 / j1 + 1.0 / j3))
    assert found.straight == pytest.approx(natural, rel=1e-3)  # damped, and slightly by the load
    assert [(c.order, c.source) for c in found.crossings] == [(6.0, "joints"), (4.0, "joints and engine"),
                                                              (2.0, "joints and engine"), (1.5, "engine")]
    for c in found.crossings:
        assert c.speed == pytest.approx(found.straight / c.order, rel=1e-12)
    # as it turns, away from resonances, perturbations keep nearly that frequency
    assert np.nanmedian(found.frequencies) == pytest.approx(natural, rel=1e-2)


def test_frequency_of_perturbations_from_the_rotation_number(tmp_path: Path) -> None:
    made = single(0.01, damping=0.0)
    found = campbell(made, [80.0, 130.0, 210.0, 290.0])
    assert found.frequencies == pytest.approx(100.0 * math.pi, rel=1e-4)
    found.plot(tmp_path / "campbell.png")
    assert (tmp_path / "campbell.png").stat().st_size > 10_000
