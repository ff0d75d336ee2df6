"""Which variable acts on which output, found by moving each of them in the kernel itself.

At random points inside every combination of ``model.fidelity`` and ``model.drive`` one input or
parameter is moved by a large amount and every output is watched. A change beyond rounding is a
dependency; with several points per combination a real one does not stay hidden. The points are made
of numbers of order one, so that nothing real is small against rounding.
"""

from __future__ import annotations

import random
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

POINTS = 4  # per combination; each structural zero of one point would have to repeat in all
ROUNDING = 1e-9  # relative; input.torque.by_speed w - by_speed w leaves rounding behind
STEP = 1e-3  # s, the step after which outputs are watched in step mode

Values = dict[str, float]


@dataclass(frozen=True)
class Dependencies:
    """Names by output name, in the order of the table.

    Attributes
    ----------
    initial : dict
        Inputs and parameters that act on an output in initialization mode.
    running : dict
        Inputs that act on an output at a communication point, without a step between.
    """

    initial: dict[str, tuple[str, ...]]
    running: dict[str, tuple[str, ...]]


def find(driveline: Callable[[], Any], variables: Sequence[Any]) -> Dependencies:
    """Find the dependencies.

    Parameters
    ----------
    driveline : callable
        Makes a fresh ``cardan_kernel.Driveline``.
    variables : sequence of Variable
        ``cardan_kernel.variables.VARIABLES``.
    """
    outputs = [variable.name for variable in variables if variable.causality == "output"]
    knowns = [variable for variable in variables if variable.causality != "output"]
    initial: dict[str, set[str]] = {name: set() for name in outputs}
    running: dict[str, set[str]] = {name: set() for name in outputs}
    for point in _points(knowns):
        base = _start(driveline, point)
        before = _read(base, outputs)
        for variable in knowns:
            moved = {**point, variable.name: _moved(variable, point[variable.name])}
            _note(variable.name, before, _read(_start(driveline, moved), outputs), initial)
        base.exit_initialization_mode()
        if not base.do_step(0.0, STEP):
            raise ArithmeticError(f"the driveline does not step at a test point: {base.last_error}")
        state, before = base.get_state(), _read(base, outputs)
        for variable in knowns:
            if variable.causality == "input":
                base.set(variable.name, _moved(variable, point[variable.name]))
                _note(variable.name, before, _read(base, outputs), running)
                base.set_state(state)
    order = [variable.name for variable in knowns]
    return Dependencies(_ordered(initial, order), _ordered(running, order))


def _points(knowns: Sequence[Any]) -> Iterator[Values]:
    """Random interior points, the same ones at every call."""
    chance = random.Random(20)
    for fidelity in (1, 2):
        for drive in (0, 1):
            for _ in range(POINTS):
                point = {variable.name: _draw(variable, chance) for variable in knowns}
                yield {**point, "model.fidelity": fidelity, "model.drive": drive}


def _draw(variable: Any, chance: random.Random) -> float:
    """A value of order one inside the limits; angles below 90 deg, choices at their start."""
    if variable.type != "Real" or variable.unit == "1":
        return float(variable.start)
    return chance.uniform(0.3, 1.2)


def _moved(variable: Any, value: float) -> float:
    """Another allowed value, far away."""
    if variable.type == "Boolean":
        return float(not value)
    if variable.type == "Integer":
        return float(variable.minimum if value != variable.minimum else variable.minimum + 1)
    return value * 1.15 + 0.01 if variable.unit != "1" else value * 10.0


def _start(driveline: Callable[[], Any], values: Values) -> Any:
    """A driveline in initialization mode."""
    made = driveline()
    made.setup_experiment(0.0)
    for name, value in values.items():
        made.set(name, value)
    made.enter_initialization_mode()
    return made


def _read(driveline: Any, names: Sequence[str]) -> Values:
    return {name: float(driveline.get(name)) for name in names}


def _note(name: str, before: Values, after: Values, into: dict[str, set[str]]) -> None:
    """Enter `name` for each output that changed."""
    for output, value in before.items():
        if not abs(after[output] - value) <= ROUNDING * (1.0 + abs(value)):
            into[output].add(name)


def _ordered(found: dict[str, set[str]], order: Sequence[str]) -> dict[str, tuple[str, ...]]:
    return {output: tuple(name for name in order if name in names) for output, names in found.items()}
