"""Ripple orders of a four-stroke engine from the geometry of its cylinders.

Slider crank of radius r and rod length l; piston travel from top dead centre
``s(p) = r (1 - cos p) + l - sqrt(l^2 - r^2 sin^2 p)``. The n cylinders fire evenly, 4 pi / n apart, so that only the
orders that are multiples of n/2 add up, n times; the others cancel.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from cardan.models.parameters import ParameterError, check_ranges, integer, quantity
from cardan.models.ripple import Pair

POINTS = 1440  # samples of one working cycle (720 deg)
ATMOSPHERE = 1.013e5  # Pa, in the crank case


@dataclass(frozen=True, eq=False)
class Cylinder:
    """Geometry and working cycle of one cylinder.

    The cycle is a textbook one: polytropic compression from `intake_pressure` at bottom dead centre; heat released
    by Wiebe's function 1 - exp(-6.9 z^3) over `burn_duration` from `burn_start`; polytropic expansion; intake and
    exhaust at `intake_pressure` and ambient pressure without torque of their own. Pressure from heat is linear in
    the heat: ``p_fire V^g = (g - 1) integral V^(g-1) dQ`` (Heywood, Internal Combustion Engine Fundamentals, 1988,
    chapter 9), so the firing torque scales with the mean torque and the motoring torque does not.
    """

    stroke: float = quantity("m", "piston stroke", minimum=1e-6)
    bore: float = quantity("m", "cylinder bore", minimum=1e-6)
    rod: float = quantity("m", "length of the connecting rod", minimum=1e-6)
    reciprocating_mass: float = quantity("kg", "piston, pin and the rod's share, per cylinder", minimum=0.0)
    compression_ratio: float = quantity("1", "largest by smallest volume", 16.0, above=1.0, maximum=40.0)
    intake_pressure: float = quantity("Pa", "absolute pressure at the start of compression", ATMOSPHERE, minimum=0.0)
    polytropic_exponent: float = quantity("1", "of compression and expansion", 1.33, above=1.0, maximum=1.67)
    burn_start: float = quantity("rad", "crank angle from firing top dead centre", -0.1, minimum=-1.5, maximum=1.0)
    burn_duration: float = quantity("rad", "crank angle", 1.2, minimum=1e-6, maximum=2.0)
    orders: int = integer("number of multiples of n/2 kept", 6, minimum=1, maximum=40)

    def __post_init__(self) -> None:
        check_ranges(self)
        if self.rod <= 0.5 * self.stroke:
            raise ParameterError("rod", self.rod, "not longer than the crank radius", f"> {0.5 * self.stroke:g} m")

    def travel(self, angle: float) -> tuple[float, float]:
        """Return piston travel from top dead centre (m) and its derivative by the crank angle (m/rad)."""
        r, rod = 0.5 * self.stroke, self.rod
        s, c = math.sin(angle), math.cos(angle)
        root = math.sqrt(rod * rod - r * r * s * s)
        return r * (1.0 - c) + rod - root, r * s + r * r * s * c / root

    def inertia_orders(self, cylinders: int) -> dict[float, Pair]:
        """Return order -> amplitudes of the inertia torque per speed squared, N.m.s2/rad2.

        At constant speed ``T = -1/2 w^2 d/dp [n m <s'(p)^2>]``; the mean of m s'^2 belongs to the crank's inertia.
        """
        square = [self.reciprocating_mass * self.travel(4.0 * math.pi * i / POINTS)[1] ** 2 for i in range(POINTS)]
        orders = _multiples(square, cylinders, self.orders)
        return {k: (-0.5 * k * b, 0.5 * k * a) for k, (a, b) in orders.items()}

    def gas_orders(self, cylinders: int) -> tuple[dict[float, Pair], dict[float, Pair]]:
        """Return the orders of the motoring gas torque (N.m) and of the firing torque per mean torque (1)."""
        exponent = self.polytropic_exponent
        area = 0.25 * math.pi * self.bore * self.bore
        clearance = self.stroke / (self.compression_ratio - 1.0)
        largest = clearance + self.stroke
        motoring, firing = [0.0] * POINTS, [0.0] * POINTS
        heat = burnt = 0.0
        before = largest ** (exponent - 1.0)
        for i in range(POINTS // 2):  # compression and expansion: crank angle -pi .. pi
            angle = 4.0 * math.pi * i / POINTS - math.pi
            travel, slope = self.travel(angle)
            height = clearance + travel
            z = min(max((angle - self.burn_start) / self.burn_duration, 0.0), 1.0)
            now = 1.0 - math.exp(-6.9 * z**3)
            weight = height ** (exponent - 1.0)
            heat += 0.5 * (before + weight) * (now - burnt)
            burnt, before = now, weight
            place = (i - POINTS // 4) % POINTS
            pressure = self.intake_pressure * ((largest / height) ** exponent - 1.0)
            motoring[place] = pressure * area * slope
            firing[place] = heat / height**exponent * slope
        mean = sum(firing) / POINTS * cylinders
        return (_multiples(motoring, cylinders, self.orders),
                {k: (a / mean, b / mean) for k, (a, b) in _multiples(firing, cylinders, self.orders).items()})


def _multiples(samples: list[float], cylinders: int, count: int) -> dict[float, Pair]:
    """Return order -> (cosine, sine) amplitude of n evenly firing cylinders from one cylinder's cycle."""
    orders: dict[float, Pair] = {}
    points = len(samples)
    for multiple in range(1, count + 1):
        k = multiple * cylinders  # per cycle of 4 pi
        angles = [2.0 * math.pi * ((k * i) % points) / points for i in range(points)]
        scale = 2.0 * cylinders / points
        orders[0.5 * k] = (scale * sum(v * math.cos(a) for v, a in zip(samples, angles)),
                           scale * sum(v * math.sin(a) for v, a in zip(samples, angles)))
    return orders
