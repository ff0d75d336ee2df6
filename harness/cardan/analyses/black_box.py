"""The equations of an FMU, through FMI alone: what `Plant` takes from the kernel, by differences here.

In initialization mode an FMU of this interface shows its outputs for any initial state and inputs. Its saved state is
returned to before each point, so that no point depends on the one before. The rates of the states follow from outputs:

    p' = input.speed,  twist' = shaft.speed_a - shaft.speed_b,  w1' = input.acceleration,
    wy' = (output.acceleration - d(joint2.ratio)/dx wy^2) / joint2.ratio,   x the angle of joint 2,

and the Jacobians are central differences of fourth order of them and of the outputs. Nothing of the FMU's inside is
used; `period_map` steps it over a period and tells how far the equations found so are its own.
"""

from __future__ import annotations

import os
from types import TracebackType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from cardan.analyses.plant import TWIST, W1, WY, P, Plant
from cardan.analyses.signals import output_units
from cardan.errors import FmuError
from cardan.instance import Instance

Array = NDArray[np.float64]

ANGLE_STEP = 1e-3  # rad
STENCIL = ((1, 8.0 / 12.0), (-1, -8.0 / 12.0), (2, -1.0 / 12.0), (-2, 1.0 / 12.0))


class BlackBox(Plant):
    """A plant whose equations come from an FMU.

    Use as a context manager: the FMU is freed at the end.

    Parameters
    ----------
    scenario : Scenario
    fmu : path-like
        An FMU of this interface.
    changes : dict, optional
        FMU variables that differ from the scene's, SI.

    Raises
    ------
    FmuError
        If the FMU lacks variables of the interface or cannot save its state.
    """

    noise = 1e-9  # of differences

    def __init__(self, scenario: Any, fmu: str | os.PathLike[str], changes: dict[str, float] | None = None) -> None:
        super().__init__(scenario, changes)
        self.path = fmu
        self.instance = Instance(fmu)
        try:
            self._open()
        except BaseException:
            self.instance.close()
            raise

    def __enter__(self) -> BlackBox:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None,
                 trace: TracebackType | None) -> None:
        self.instance.close()

    def _open(self) -> None:
        about = self.instance.description
        outputs = list(output_units())
        inputs = ["initial.angle", "initial.speed", "initial.twist", "initial.twist_rate", "input.torque",
                  "output.torque", "input.speed_command", "input.speed_command.der1"]
        missing = [name for name in (*outputs, "joint2.ratio", *inputs, "model.drive") if name not in about.variables]
        if missing:
            raise FmuError(f"{about.path.name} is no FMU of this interface: it lacks {', '.join(missing)}")
        if not about.can_get_set_state:
            raise FmuError(f"{about.path.name} cannot save and restore its state, which --method fmu needs")
        fixed = set(inputs)
        for name, value in self.values.items():
            if name in about.variables and name not in fixed:
                self.instance.set(name, int(value) if about[name].type in ("Integer", "Enumeration") else value)
        self.instance.setup(0.0, None, 1e-12)
        self._inputs = self.instance.plan(inputs)
        self._first = self.instance.plan(["shaft.speed_a"])
        self._ratio = self.instance.plan(["joint2.ratio"])
        self._outputs = self.instance.plan([*outputs, "joint2.ratio"])
        self._initial = self.instance.get_state()

    def _run(self, points: Array, values: Array) -> None:
        """Take the kernel's place in `Plant.fields`."""
        for i, point in enumerate(points):
            values[i] = self._point(point)

    def _output_speeds(self, points: Array, values: Array) -> Array:
        speed = list(output_units()).index("output.speed")
        return np.array([self._read(point[:4], np.zeros(2), 0.0)[speed] for point in points])

    def _point(self, point: Array) -> Array:
        values = np.zeros((8, 19))
        state = point[:4].copy()
        torque = np.array([point[4], point[7]])
        values[0] = self._evaluate(state, torque)
        columns = values[1:]
        scale = max(1.0, abs(float(point[2])))
        for j in range(4):
            step = ANGLE_STEP * (1.0 if j in (P, TWIST) else scale)
            columns[j] = sum(weight * self._evaluate(state + count * step * np.eye(4)[j], torque)
                             for count, weight in STENCIL) / step
        for j in range(2):
            step = 1.0 + abs(float(torque[j]))
            shift = step * np.eye(2)[j]
            above, below = self._evaluate(state, torque + shift), self._evaluate(state, torque - shift)
            columns[4 + j] = (above - below) / (2.0 * step)
        if self.driven:
            columns[4] = 0.0  # a torque has no effect on a prescribed speed
            columns[6] = (self._evaluate(state, torque, scale) - self._evaluate(state, torque, -scale)) / (2.0 * scale)
        self._close(point, columns)
        return values.reshape(152)

    def _close(self, point: Array, columns: Array) -> None:
        """Let the torques follow the speeds and the angle, as `Bundle.fields` does."""
        by_engine, by_load = columns[4].copy(), columns[5].copy()
        speed_out = 4 + list(output_units()).index("output.speed")
        for j in range(4):
            into = point[5] * (1.0 if j == W1 else 0.0) + (point[6] if j == P else 0.0)
            columns[j] += by_engine * into + by_load * (point[8] * columns[j, speed_out])

    def _evaluate(self, state: Array, torque: Array, acceleration: float = 0.0) -> Array:
        """Return the rates of the four states and the 15 outputs."""
        out = self._read(state, torque, acceleration)
        rates = np.zeros(4)
        rates[P] = out[1]
        rates[W1] = out[2]
        if not self.rigid:
            speed = state[WY]
            ratio = out[15]
            slope = -sum(weight * self._ratio_at(state, count * ANGLE_STEP) for count, weight in STENCIL) / ANGLE_STEP
            rates[TWIST] = out[9] - out[10]
            rates[WY] = (out[6] - slope * speed * speed) / ratio
        return np.concatenate([rates, out[:15]])

    def _read(self, state: Array, torque: Array, acceleration: float) -> Array:
        self._write(state, 0.0, torque, acceleration)
        if not self.rigid:
            speed_a = self._first.read()[0]
            self._inputs.values[3] = speed_a - state[WY]
            self._inputs.write()
        return np.array(self._outputs.read())

    def _ratio_at(self, state: Array, more_twist: float) -> float:
        self._inputs.values[2] = state[TWIST] + more_twist
        self._inputs.write()
        return float(self._ratio.read()[0])

    def _write(self, state: Array, twist_rate: float, torque: Array, acceleration: float) -> None:
        self.instance.set_state(self._initial)
        values = self._inputs.values
        values[0], values[1], values[2], values[3] = state[P], state[W1], state[TWIST], twist_rate
        values[4], values[5] = torque
        values[6], values[7] = state[W1], acceleration
        self._inputs.write()
