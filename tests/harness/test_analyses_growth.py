"""A run of the FMU on an unstable point grows with the Floquet exponent that the analysis gives."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from cardan.analyses.closed_loop import ClosedLoop
from cardan.analyses.operating_point import operating_point
from cardan.analyses.plant import Plant
from cardan.instance import Instance

from tests.harness.analysis_scenes import homokinetic, single

W = math.sqrt(2e4 / 1.5)


@pytest.mark.parametrize(("angle", "nu"), [(5.0, 1.0), (15.0, 1.0), (30.0, 1.04)])
def test_homokinetic_pair_in_its_principal_region(angle: float, nu: float, fmu: Path) -> None:
    speed = nu * W
    exact = operating_point(Plant(homokinetic(angle)), speed).floquet.growth_rate
    turns = math.ceil(12.0 / (exact * 2.0 * math.pi / speed))  # to e^12 of the start
    half = math.pi / speed
    with Instance(fmu) as driveline:
        for name, value in homokinetic(angle).driveline.items():
            driveline.set(name, int(value) if name.startswith("model.") else value)
        driveline.set("input.speed_command", speed)
        driveline.set("initial.twist", 1e-8)
        driveline.setup(0.0, None, 1e-12)
        driveline.initialize()
        twist = []
        for i in range(2 * turns):
            driveline.step(i * half, half)
            twist.append(abs(driveline.get("shaft.twist")))
    # once per half turn at the same shaft angle; the first half is left to the motions that die away
    x = np.arange(len(twist)) * half
    late = slice(len(twist) // 2, None)
    growth = np.polyfit(x[late], np.log(twist[late]), 1)[0]
    assert growth == pytest.approx(exact, rel=1e-4)


def test_driveline_under_torque_with_a_load(fmu: Path) -> None:
    # unstable at 3000 rpm; the steady state is left along the growing motion
    point = operating_point(Plant(single(30.0, damping=2.0)), 100.0 * math.pi)
    motion, plant = point.motion, point.motion.plant
    count, halves = 32, 60
    with ClosedLoop(plant, fmu, motion.added) as loop:
        values, vectors = np.linalg.eig(point.floquet.monodromy)
        mode = vectors[:, np.argmax(np.abs(values))].real
        ends = []
        for sign in (1.0, -1.0):
            start = motion.states[0] + sign * 1e-7 * mode / np.abs(mode[:2]).max()
            ends.append(loop.run(start, motion.own[0], motion.period / count, count * halves, None,
                                 np.zeros((1, 15, 2))))
    away = np.abs(ends[0] - ends[1])[count - 1::count, 7]  # shaft torque, once per period
    growth = np.polyfit(np.arange(halves) * motion.period, np.log(away), 1)[0]
    assert growth == pytest.approx(point.floquet.growth_rate, rel=1e-4)
