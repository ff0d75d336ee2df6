"""Inputs as masters may give them: jumps, odd steps, no numbers, rollbacks, lies."""

from __future__ import annotations

import math
import random
from collections.abc import Iterator

from cardan_kernel import Driveline

from .outcome import Outcome, hard_case, start, step

BASE = {"joint1.angle": math.radians(20), "joint2.angle": math.radians(15), "initial.speed": 100.0}


@hard_case(9, "a torque step of 500 N.m inside a communication interval")
def torque_step() -> Iterator[Outcome]:
    """A master that knows the time places a point there; one that does not is late by up to its step."""
    exact = stepped(1e-3, 0.0123)
    yield Outcome(abs(stepped(3e-3, 0.0123) / exact - 1.0), 1e-8, "1",
                  "output speed, point at the step: 3 ms against 1 ms")
    late = [abs(stepped(h, None) / exact - 1.0) for h in (4e-3, 1e-3, 2.5e-4)]
    yield Outcome(late[-1] / late[0], 0.125, "1", "error without a point there shrinks with the step, 4 ms to 0.25 ms")


def stepped(h: float, event: float | None) -> float:
    """Output speed after 0.05 s with 0 -> 500 N.m at 12.3 ms."""
    driveline = start({**BASE, "output.damping": 0.3})
    points = [i * h for i in range(math.ceil(0.05 / h - 1e-9))] + [0.05]
    if event is not None:
        points = sorted({*points, event})
    for a, b in zip(points, points[1:]):
        driveline.set("input.torque", 500.0 if a >= 0.0123 else 0.0)
        step(driveline, a, b - a)
    return driveline.get("output.speed")


@hard_case(10, "communication steps from 1e-9 s to 1 s")
def odd_steps() -> Iterator[Outcome]:
    """With constant inputs the communication points do not matter."""
    values = {**BASE, "input.torque": 60.0, "output.torque": 40.0, "shaft.damping": 5.0}
    whole = start(values)
    step(whole, 0.0, 1.0)
    reference = whole.get("input.angle"), whole.get("output.speed")
    chance = random.Random(7)
    for name, steps in (("1 ms", [1e-3] * 1000), ("1e-9 s first, then the rest", [1e-9] * 1000 + [1.0 - 1e-6]),
                        ("random", [10 ** chance.uniform(-9, -1) for _ in range(400)])):
        driveline = start(values)
        t = 0.0
        for h in steps:
            h = min(h, 1.0 - t)
            if h > 0.0:
                step(driveline, t, h)
                t += h
        if t < 1.0:
            step(driveline, t, 1.0 - t)
        yield Outcome(abs(driveline.get("input.angle") - reference[0]), 2e-8, "rad", f"input angle after 1 s, {name}")
        yield Outcome(abs(driveline.get("output.speed") - reference[1]), 1e-6, "rad/s",
                      f"output speed after 1 s, {name}")


@hard_case(14, "NaN, infinite and subnormal inputs")
def no_numbers() -> Iterator[Outcome]:
    """Refused with the state kept, or taken and correct."""
    names = ("input.torque", "input.torque.der1", "input.torque.by_speed", "output.torque", "output.torque.by_speed",
             "joint1.angle", "joint2.angle.der1", "input.speed_command")
    driveline = start(BASE)
    wrong = 0
    for i, name in enumerate(names):
        for bad in (math.nan, math.inf, -math.inf):
            state, value = driveline.get_state(), driveline.get(name)
            driveline.set(name, bad)
            taken = driveline.do_step(i, 1e-3)
            driveline.set(name, value)
            wrong += int(taken or driveline.get_state() != state)
        step(driveline, i, 1e-3)
    yield Outcome(wrong, 0, "1", f"of {3 * len(names)} bad inputs, taken or with a changed state")
    tiny, plain = start({**BASE, "joint2.angle": 0.0}), start({**BASE, "joint2.angle": 0.0})
    for name in ("input.torque", "input.torque.der1", "output.torque", "joint2.angle"):
        tiny.set(name, 5e-324)
    for driveline in (tiny, plain):
        step(driveline, 0.0, 1e-2)
    yield Outcome(abs(tiny.get("output.speed") - plain.get("output.speed")), 1e-13 * 100, "rad/s",
                  "subnormal inputs against zero")


def storm(seed: int, actions: int = 60) -> bool:
    """Whether a random sequence of save, restore and step ends bit for bit where a straight run does."""
    chance = random.Random(seed)
    driveline, straight = (start({**BASE, "hold.degree": 5, "joint1.trunnion.friction": 0.2}) for _ in range(2))
    path: list[float] = []
    saved: list[tuple[int, bytes]] = [(0, driveline.get_state())]
    for _ in range(actions):
        choice = chance.random()
        if choice < 0.25:
            saved.append((len(path), driveline.get_state()))
        elif choice < 0.5:
            length, state = chance.choice(saved)
            del path[length:]
            saved = [entry for entry in saved if entry[0] <= length]
            driveline.set_state(state)
        else:
            h = 10 ** chance.uniform(-6, -2.5)
            path.append(h)
            push(driveline, len(path), h)
    for count, h in enumerate(path, start=1):
        push(straight, count, h)
    # The last inputs set are part of the memory: give both the same before comparing.
    for one in (driveline, straight):
        push(one, len(path) + 1, 1e-4)
    return driveline.get_state() == straight.get_state()


def push(driveline: Driveline, count: int, h: float) -> None:
    """A step with torques that depend on its number alone."""
    driveline.set("input.torque", 100.0 * math.sin(count))
    driveline.set("input.torque.der1", 1e3 * math.cos(count))
    step(driveline, 0.0, h)


@hard_case(15, "rollback storm")
def rollback_storm() -> Iterator[Outcome]:
    """Random sequences of save, restore and step give the bits of the straight run."""
    broken = sum(not storm(seed) for seed in range(1000))
    yield Outcome(broken, 0, "1", "of 1000 sequences of 60 actions, those that differ in any bit")


@hard_case(18, "an input derivative that lies")
def lying_derivative() -> Iterator[Outcome]:
    """der1 = 1e12 N.m/s for one step of 1 ms: the impulse is what was said, no more; an absurd one is refused."""
    driveline = start({**BASE, "model.fidelity": 1, "joint1.angle": 0.0, "joint2.angle": 0.0})
    inertia = 0.2 + 2 * 0.0044 + 1.5
    driveline.set("input.torque.der1", 1e12)
    step(driveline, 0.0, 1e-3)
    said = 100.0 + 0.5 * 1e12 * 1e-3**2 / inertia
    yield Outcome(abs(driveline.get("input.speed") / said - 1.0), 1e-9, "1", "speed against the impulse of the lie")
    compliant = start({**BASE, "hold.degree": 5})
    state = compliant.get_state()
    compliant.set("input.torque.der1", 1e12)
    bounded = compliant.do_step(0.0, 1e-3)
    finite = all(math.isfinite(compliant.get(name)) for name in ("input.speed", "output.speed", "shaft.torque"))
    yield Outcome(float(not finite), 0.0, "1", "compliant: 0 if every output stays finite" if bounded else "refused")
    compliant.set_state(state)
    compliant.set("input.torque.der1", 1e308)
    refused = not compliant.do_step(0.0, 1.0)
    yield Outcome(float(not (refused and "der1" in compliant.last_error)), 0.0, "1",
                  "1e308 N.m/s: 0 if refused by name")
