"""What the names of units say: SI Brochure for the units, FMI 2.0 section 2.2.2 for the base units."""

from __future__ import annotations

import math

import pytest
from cardan.check.unit_names import BASE, readings
from cardan_kernel.variables import UNITS


def powers(**given: int) -> tuple[int, ...]:
    return tuple(given.get(name, 0) for name in BASE)


@pytest.mark.parametrize(("name", "factor", "exponents"), [
    ("N.m.s/rad", 1.0, powers(kg=1, m=2, s=-1, rad=-1)),
    ("kg.m2", 1.0, powers(kg=1, m=2)),
    ("rad/s2", 1.0, powers(rad=1, s=-2)),
    ("rpm", math.pi / 30.0, powers(rad=1, s=-1)),
    ("rev/min", math.pi / 30.0, powers(rad=1, s=-1)),
    ("1/min", 1.0 / 60.0, powers(s=-1)),
    ("km/h", 1.0 / 3.6, powers(m=1, s=-1)),
    ("1", 1.0, powers()), ("", 1.0, powers()), ("%", 0.01, powers()),
    ("deg", math.pi / 180.0, powers(rad=1)),
    ("kN", 1e3, powers(kg=1, m=1, s=-2)),
    ("W/(m2.K)", 1.0, powers(kg=1, s=-3, K=-1)),
    ("W/m2/K", 1.0, powers(kg=1, s=-3, K=-1)),
    ("J/(kg.K)", 1.0, powers(m=2, s=-2, K=-1)),
    ("m.s-2", 1.0, powers(m=1, s=-2)), ("m/s^2", 1.0, powers(m=1, s=-2)), ("m/s**2", 1.0, powers(m=1, s=-2)),
    ("m/s\N{SUPERSCRIPT TWO}", 1.0, powers(m=1, s=-2)),
    ("N m", 1.0, powers(kg=1, m=2, s=-2)), ("Nm", 1.0, powers(kg=1, m=2, s=-2)),
    ("N\N{MIDDLE DOT}m", 1.0, powers(kg=1, m=2, s=-2)),
    ("mm", 1e-3, powers(m=1)), ("min", 60.0, powers(s=1)), ("ms", 1e-3, powers(s=1)), ("Mg", 1e3, powers(kg=1)),
    ("V.s/A", 1.0, powers(kg=1, m=2, s=-2, A=-2)), ("Ohm", 1.0, powers(kg=1, m=2, s=-3, A=-2)),
    ("F", 1.0, powers(kg=-1, m=-2, s=4, A=2)), ("T", 1.0, powers(kg=1, s=-2, A=-1)),
    ("H", 1.0, powers(kg=1, m=2, s=-2, A=-2)),
    ("mol/m3", 1.0, powers(mol=1, m=-3)), ("cd", 1.0, powers(cd=1)), ("l/min", 1e-3 / 60.0, powers(m=3, s=-1)),
    ("bar", 1e5, powers(kg=1, m=-1, s=-2)), ("kW.h", 3.6e6, powers(kg=1, m=2, s=-2)),
])
def test_names(name: str, factor: float, exponents: tuple[int, ...]) -> None:
    reading = readings(name)[0]
    assert reading.exponents == exponents
    assert reading.factor == pytest.approx(factor, rel=1e-14)
    assert reading.offset == 0.0


def test_temperatures_have_an_offset_alone_but_not_in_products() -> None:
    assert readings("degC")[0].offset == 273.15
    assert readings("degF")[0].factor * 212.0 + readings("degF")[0].offset == pytest.approx(373.15, rel=1e-14)
    assert readings("W/degC")[0].offset == 0.0


def test_an_open_fraction_has_two_readings() -> None:
    assert {each.exponents for each in readings("J/kg.K")} == {powers(m=2, s=-2, K=1), powers(m=2, s=-2, K=-1)}
    assert len(readings("N.m/rad")) == 1


@pytest.mark.parametrize("name", ["foo", "m//s", "m/", "(m", "m)", "2m", "m.", "kfoo", "mmin"])
def test_unknown_names_are_not_guessed(name: str) -> None:
    assert readings(name) == []


def test_the_units_of_the_driveline_are_what_their_names_say() -> None:
    for name, unit in UNITS.items():
        assert readings(name)[0].exponents == powers(**unit.exponents)
        assert readings(name)[0].factor == 1.0
        for display, factor in unit.displays:
            assert 1.0 / readings(display)[0].factor == pytest.approx(factor, rel=1e-14)
