"""What turns in a scene, ready for analysis: the kernel's equations closed by the laws of engine and load.

States are those of the kernel that move, followed by the own states of engine and load. All points of a period are
evaluated at once; the kernel gives the driveline with its exact Jacobians, the models give torques with their
partial derivatives.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from cardan.analyses.laws import Surrounding, angle_period
from cardan.errors import InputError

Array = NDArray[np.float64]

KERNEL_STATES = ("input.angle", "shaft.twist", "input.speed", "shaft.speed_b")
STATE_UNITS = {"input.angle": "rad", "shaft.twist": "rad", "input.speed": "rad/s", "shaft.speed_b": "rad/s"}
P, TWIST, W1, WY = range(4)


@dataclass(frozen=True)
class Fields:
    """Equations and Jacobians at N points; n states, m inputs, 15 outputs of the kernel.

    Attributes
    ----------
    rates : ndarray, shape (N, n)
        Time derivatives of the states.
    outputs : ndarray, shape (N, 15)
        ``JACOBIAN_OUTPUTS``.
    a, b, c, d : ndarray, shapes (N, n, n), (N, n, m), (N, 15, n), (N, 15, m)
        Exact Jacobians; the laws of engine and load are part of them.
    torques : ndarray, shape (N, 2)
        Torque of engine (with the added torque) and load, N.m.
    kernel : int
        How many of the states are the kernel's; they come first.
    """

    rates: Array
    outputs: Array
    a: Array
    b: Array
    c: Array
    d: Array
    torques: Array
    kernel: int


class Plant:
    """A scene's driveline, engine and load as one periodic system.

    Parameters
    ----------
    scenario : Scenario
        The scene; a driver is left out (the throttle stays as the scene gives it).
    changes : dict, optional
        FMU variables that differ from the scene's, SI.

    Attributes
    ----------
    rigid, driven : bool
        Whether the shaft is rigid, whether the input speed is prescribed.
    active : tuple of int
        Kernel states that move.
    states : tuple of str
        Names of all states; own states carry the names that their models give them.
    inputs : tuple of str
        Inputs of the Jacobians: torque (or acceleration) of the input shaft, and torque of the load.
    period_angle : float
        Turn of the input shaft after which everything repeats, rad.
    bundle : cardan_kernel.analysis.Bundle
        The kernel's equations.
    noise : float
        Relative size of what the equations may contain without meaning.
    """

    noise = 1e-12

    def __init__(self, scenario: Any, changes: dict[str, float] | None = None) -> None:
        from cardan_kernel import INDEX, VARIABLES
        from cardan_kernel.analysis import Bundle

        self.scenario = scenario
        self.values: dict[str, float] = {v.name: float(v.start or 0.0) for v in VARIABLES if v.causality != "output"}
        self.values.update({name: float(value) for name, value in scenario.driveline.items()})
        self.values.update(changes or {})
        _check_still(self.values)
        self.bundle = Bundle(self.bundle_state())
        self._index = INDEX
        self.rigid = self.values["model.fidelity"] == 1.0
        self.driven = self.values["model.drive"] == 1.0
        if self.rigid:
            self.active: tuple[int, ...] = () if self.driven else (P, W1)
        else:
            self.active = (TWIST, WY) if self.driven else (P, TWIST, W1, WY)
        self.surrounding = Surrounding(scenario)
        self.own: tuple[str, ...] = self.surrounding.states
        self.states: tuple[str, ...] = tuple(KERNEL_STATES[i] for i in self.active) + self.own
        self.inputs: tuple[str, ...] = ("input.acceleration" if self.driven else "input.torque", "output.torque")
        self.period_angle = angle_period(self.surrounding)

    def put(self, **values: float) -> None:
        """Change FMU variables (dots written as two underscores), SI."""
        for key, value in values.items():
            name = key.replace("__", ".")
            self.values[name] = value
            self.bundle.put(self._index[name], value)

    def bundle_state(self) -> bytes:
        """Return a kernel state with the present parameters, for another `Bundle`."""
        from cardan_kernel import Driveline

        driveline = Driveline()
        for name, value in self.values.items():
            driveline.set(name, value)
        return driveline.get_state()

    def joints(self) -> tuple[float, float]:
        """Return both joint angles, rad."""
        return self.values["joint1.angle"], self.values["joint2.angle"]

    def natural_frequency(self) -> float:
        """Return the natural frequency of the shaft between straight joints, rad/s; 0 for a rigid driveline."""
        if self.rigid:
            return 0.0
        v = self.values
        behind = v["shaft.inertia_b"] + v["output.inertia"]
        before = math.inf if self.driven else v["input.inertia"] + v["shaft.inertia_a"]
        return math.sqrt(v["shaft.stiffness"] * (1.0 / behind + 1.0 / before))

    def inertia(self) -> float:
        """Return the inertia of all that turns, kg.m2, with straight joints."""
        v = self.values
        return v["input.inertia"] + v["shaft.inertia_a"] + v["shaft.inertia_b"] + v["output.inertia"]

    def fields(self, kernel_states: Array, own: Array, added: float = 0.0,
               active: tuple[int, ...] | None = None) -> Fields:
        """Evaluate the closed equations.

        Parameters
        ----------
        kernel_states : ndarray, shape (N, 4)
            ``KERNEL_STATES``, SI, moving or not.
        own : ndarray, shape (N, k)
            Own states of engine and load.
        added : float
            Constant torque that is added to the engine's, N.m.
        active : tuple of int, optional
            Kernel states to take as states; those that move by default.
        """
        count, k = len(kernel_states), len(self.own)
        points = np.zeros((count, 9))
        points[:, :4] = kernel_states
        values = np.empty((count, 152))
        outside = self.surrounding.evaluate(kernel_states, own, self._output_speeds(points, values))
        points[:, 4] = outside.engine + added
        points[:, 5] = outside.engine_by_speed
        points[:, 6] = outside.engine_by_angle
        points[:, 7] = outside.load
        points[:, 8] = outside.load_by_speed
        self._run(points, values)
        columns = values[:, 19:].reshape(count, 7, 19)
        chosen = list(self.active if active is None else active)
        forced = [6 if self.driven else 4, 5]
        n = len(chosen)
        a = np.zeros((count, n + k, n + k))
        b = np.zeros((count, n + k, 2))
        c = np.zeros((count, 15, n + k))
        a[:, :n, :n] = columns[:, chosen][:, :, chosen].transpose(0, 2, 1)
        b[:, :n] = columns[:, forced][:, :, chosen].transpose(0, 2, 1)
        c[:, :, :n] = columns[:, chosen, 4:].transpose(0, 2, 1)
        d = columns[:, forced, 4:].transpose(0, 2, 1).copy()
        rates = np.concatenate([values[:, chosen], outside.rates], axis=1)
        if k:
            by_engine, by_load = columns[:, 4], columns[:, 5]
            through = (by_engine[:, :, None] * outside.engine_by_own[:, None, :]
                       + by_load[:, :, None] * outside.load_by_own[:, None, :])
            a[:, :n, n:] = through[:, chosen]
            c[:, :, n:] = through[:, 4:]
            full = np.zeros((count, k, 4))
            full[:, :, P] = outside.rates_by_angle
            full[:, :, W1] = outside.rates_by_input_speed
            full += outside.rates_by_output_speed[:, :, None] * columns[:, None, :4, 4 + 5]
            a[:, n:, :n] = full[:, :, chosen]
            a[:, n:, n:] = outside.rates_by_own
        return Fields(rates, values[:, 4:19].copy(), a, b, c, d, points[:, (4, 7)].copy(), n)

    def _output_speeds(self, points: Array, values: Array) -> Array:
        self._run(points, values)
        return values[:, 9].copy()

    def _run(self, points: Array, values: Array) -> None:
        # numbers taken from a memoryview are plain floats, from an array they would be slow numpy scalars
        self.bundle.fields(_flat(points), _flat(values), len(points))


def _flat(array: Array) -> Any:
    whole: Any = array
    return memoryview(whole).cast("B").cast("d")


def _check_still(values: dict[str, float]) -> None:
    moving = [name for name, value in values.items() if ".angle.der" in name and value != 0.0]
    if moving:
        raise InputError([f"{name} = {values[name]:g}: a moving joint angle has no periodic motion; leave it out for "
                          "this analysis" for name in moving])
