"""Torques between communication points: order of the hold, steep laws, restart after a jump."""

import math

import cardan_kernel
import pytest

from tests.kernel.runs import start

RIGID = {"model.fidelity": 1, "input.inertia": 1.0, "output.inertia": 0.0, "shaft.inertia_a": 0.0,
         "shaft.inertia_b": 0.0, "model.tolerance": 1e-13}
FREQUENCY = 40.0
START_UP = (1 / 64, 1 / 64, 1 / 32, 1 / 16, 1 / 8, 1 / 4, 1 / 2)


def flywheel_error(degree, step, give_rate=True, start_up=True):
    """Speed error after 1 s of a flywheel J = 1 under T = sin(40 t): exact w = (1 - cos 40 t) / 40."""
    driveline = start(cardan_kernel.Driveline, {**RIGID, "hold.degree": degree})
    t = 0.0
    steps = [step * part for part in START_UP] if start_up else [step]
    steps += [step] * (round(1.0 / step) - 1)
    for h in steps:
        driveline.set("input.torque", math.sin(FREQUENCY * t))
        driveline.set("input.torque.der1", FREQUENCY * math.cos(FREQUENCY * t) if give_rate else 0.0)
        assert driveline.do_step(t, h), driveline.last_error
        t += h
    return abs(driveline.get("input.speed") - (1 - math.cos(FREQUENCY * t)) / FREQUENCY)


@pytest.mark.parametrize(("degree", "order", "steps"), [
    (0, 1, (200, 400, 800)), (1, 2, (200, 400, 800)), (3, 4, (200, 400, 800)), (5, 6, (200, 400, 800))])
def test_order(degree, order, steps):
    """Fitted slope of error against step: 1 held, 2 linear, 4 and 6 Hermite through two and three points."""
    errors = [flywheel_error(degree, 1.0 / n) for n in steps]
    slope = math.log(errors[0] / errors[-1]) / math.log(steps[-1] / steps[0])
    assert slope == pytest.approx(order, abs=0.2)


def test_plain_master_gets_plain_fmi():
    """Degree 1 without der1 and by_speed is degree 0, bit for bit."""
    assert flywheel_error(1, 0.01, give_rate=False, start_up=False) == flywheel_error(0, 0.01, False, False)


def test_steep_load_stays_stable():
    """T = 3000 w^4 at 10 ms: held it explodes, with by_speed it settles at w = (100 / 3000)^(1/4)."""
    equilibrium = (100 / 3000) ** 0.25
    final = {}
    for by_speed in (False, True):
        driveline = start(cardan_kernel.Driveline, {**RIGID, "input.torque": 100.0, "initial.speed": 0.1})
        for i in range(300):
            w = driveline.get("output.speed")
            driveline.set("output.torque", 3000 * w**4)
            driveline.set("output.torque.by_speed", 12000 * w**3 if by_speed else 0.0)
            if not driveline.do_step(i * 0.01, 0.01):
                break
        final[by_speed] = driveline.get("output.speed")
    assert abs(final[False]) > 100 * equilibrium
    assert final[True] == pytest.approx(equilibrium, rel=1e-9)


def test_changing_by_speed_keeps_the_order():
    """Quintic hold with a by_speed that changes at every point: re-expressed, the order stays (at least) 6."""
    errors = []
    for n in (100, 200, 400):
        driveline = start(cardan_kernel.Driveline, {**RIGID, "hold.degree": 5, "initial.speed": 1.0})
        t = 0.0
        for h in [part / n for part in START_UP] + [1.0 / n] * (n - 1):
            w = driveline.get("output.speed")
            slope = 3.0 + math.sin(25.0 * t)  # any number may be given; the law itself is 3 w + sin 20 t
            driveline.set("output.torque", 3.0 * w + math.sin(20.0 * t))
            driveline.set("output.torque.by_speed", slope)
            total = 20.0 * math.cos(20.0 * t) + 3.0 * (-3.0 * w - math.sin(20.0 * t))  # dT/dt with w' = -T
            driveline.set("output.torque.der1", total - slope * (-3.0 * w - math.sin(20.0 * t)))
            assert driveline.do_step(t, h)
            t += h
        a, b = 3.0, 20.0  # w' = -3 w - sin 20 t, w(0) = 1
        size = a * a + b * b
        exact = (1.0 - b / size) * math.exp(-a * t) - (a * math.sin(b * t) - b * math.cos(b * t)) / size
        errors.append(abs(driveline.get("output.speed") - exact))
    assert math.log2(errors[0] / errors[-1]) / 2 > 5.8
    assert errors[-1] < 1e-11


def test_restart_drops_the_history():
    """After a jump the quintic through the old points would ring; with hold.restart the step is the new value's."""
    ends = {}
    for restart in (False, True):
        driveline = start(cardan_kernel.Driveline, {**RIGID, "hold.degree": 5})
        for i in range(10):
            driveline.set("input.torque", 10.0 if i < 6 else -10.0)
            driveline.set("hold.restart", restart and i == 6)
            assert driveline.do_step(i * 0.1, 0.1)
        ends[restart] = driveline.get("input.speed")
    assert ends[True] == pytest.approx(10 * 0.6 - 10 * 0.4, abs=1e-12)
    assert abs(ends[False] - 2.0) > 0.1


def test_long_step_after_short_ones_does_not_extrapolate_far():
    """A step of 1 s after history points 1e-9 s apart uses value and slope only: noise is not blown up."""
    driveline = start(cardan_kernel.Driveline, {**RIGID, "hold.degree": 5})
    for i, step in enumerate([1e-9, 1e-9, 1e-9, 1.0]):
        driveline.set("input.torque", 5.0 + 1e-13 * (-1) ** i)
        assert driveline.do_step(0.0, step)
    assert driveline.get("input.speed") == pytest.approx(5.0, rel=1e-8)
