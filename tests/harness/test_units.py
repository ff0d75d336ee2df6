"""Text with a unit to SI: exact factors of the SI brochure and of the FMU's unit table."""

from __future__ import annotations

import math

import pytest
from cardan.units import UnitError, examples, from_si, parse_unit, split_heading, to_si
from cardan_kernel.variables import UNITS, VARIABLES
from hypothesis import given
from hypothesis import strategies as st

CASES = [
    ("3000 rpm", "rad/s", 100.0 * math.pi),
    ("80 N.m", "N.m", 80.0),
    ("80 Nm", "N.m", 80.0),
    ("80 N m", "N.m", 80.0),
    ("0.4 kN.m", "N.m", 400.0),
    ("20 deg", "rad", math.pi / 9.0),
    ("20\N{DEGREE SIGN}", "rad", math.pi / 9.0),
    ("-20deg", "rad", -math.pi / 9.0),
    ("2 ms", "s", 2e-3),
    ("5 us", "s", 5e-6),
    ("2 min", "s", 120.0),
    ("36 km/h", "m/s", 10.0),
    ("10 mph", "m/s", 4.4704),
    ("1.5 m", "m", 1.5),
    ("32 mm", "m", 0.032),
    ("8000 N.m/rad", "N.m/rad", 8000.0),
    ("1e7 N.m/rad", "N.m/rad", 1e7),
    ("140 N.m/deg", "N.m/rad", 140.0 * 180.0 / math.pi),
    ("2 N.m.s/rad", "N.m.s/rad", 2.0),
    ("0.2 kg.m2", "kg.m2", 0.2),
    ("0.2 kg.m^2", "kg.m2", 0.2),
    ("200 kg.cm2", "kg.m2", 0.02),
    ("5 %", "1", 0.05),
    ("5 %", "", 0.05),
    ("135 kW", "W", 135e3),
    ("2325 kg", "kg", 2325.0),
    ("800 g", "kg", 0.8),
    ("2.8 l", "m3", 2.8e-3),
    ("0.5 bar", "Pa", 5e4),
    ("50 rpm/s", "rad/s2", 50.0 * math.pi / 30.0),
    ("16 kN", "N", 16e3),
    ("0.43 N.s2/m2", "N.s2/m2", 0.43),
    ("1.2 kg/m3", "kg/m3", 1.2),
    ("42", "N.m", 42.0),
    (" 7 ", "1", 7.0),
    (".5e1 s", "s", 5.0),
]


@pytest.mark.parametrize(("text", "unit", "value"), CASES)
def test_text_becomes_si(text: str, unit: str, value: float) -> None:
    assert to_si(text, unit) == pytest.approx(value, rel=4e-16)


def test_numbers_are_si_already() -> None:
    assert to_si(80, "N.m") == 80.0
    assert to_si(0.35, "rad") == 0.35


@pytest.mark.parametrize(("text", "unit"), [
    ("80 N.m", "N.m/rad"),  # the plane angle counts: a stiffness is no torque
    ("3 kg", "rad/s"), ("20 deg", "1"), ("314 1/s", "rad/s"), ("5 %", "rad"), ("1 N", "N.m"),
])
def test_wrong_dimension_names_text_unit_and_examples(text: str, unit: str) -> None:
    with pytest.raises(UnitError) as caught:
        to_si(text, unit)
    message = str(caught.value)
    assert repr(text) in message
    assert ("a plain number" if unit == "1" else unit) in message
    assert examples(unit)[0] in message


@pytest.mark.parametrize("text", ["", "fast", "N.m", "3 parsec", "3 rad//s", "3 rad/", "3 .m", "1,5 m", "3 m!"])
def test_no_quantity_is_refused(text: str) -> None:
    with pytest.raises(UnitError, match="expected unit rad/s, for example '3000 rpm'"):
        to_si(text, "rad/s")


@pytest.mark.parametrize("value", [True, None, [1.0]])
def test_other_types_are_refused(value: object) -> None:
    with pytest.raises(UnitError):
        to_si(value, "m")  # type: ignore[arg-type]


def test_infinity_and_nan_pass_for_the_range_check_to_refuse() -> None:
    assert to_si("inf s", "s") == math.inf
    assert math.isnan(to_si("nan", "s"))


def test_examples_are_accepted_by_every_unit_of_the_interface() -> None:
    for unit in {v.unit for v in VARIABLES if v.unit}:
        for text in examples(unit):
            assert math.isfinite(to_si(text, unit))


def test_the_units_of_the_fmu_agree_with_this_table() -> None:
    for name, declared in UNITS.items():
        ours = parse_unit(name)
        assert ours.factor == 1.0
        assert ours.exponents == tuple(declared.exponents.get(base, 0) for base in ("kg", "m", "s", "rad"))
        for display, factor in declared.displays:
            assert from_si(1.0, name, display) == pytest.approx(factor, rel=4e-16)


@given(st.floats(-1e12, 1e12), st.sampled_from(["rpm", "deg/s", "rev/min", "mrad/s"]))
def test_display_and_back(value: float, unit: str) -> None:
    assert to_si(f"{from_si(value, 'rad/s', unit)!r} {unit}", "rad/s") == pytest.approx(value, rel=1e-15)


def test_display_unit_of_another_dimension_is_refused() -> None:
    with pytest.raises(UnitError, match="'kg' is no unit for 'rad/s'"):
        from_si(1.0, "rad/s", "kg")


@pytest.mark.parametrize("text", ["1 km999", "1 1/mm999", "1 km100.km100", "1 m" + "9" * 5000, "1 mm400/mm400",
                                  "\u0663", "\u00b2", "\u0131nf"])
def test_numbers_beyond_floats_and_foreign_digits_are_refused(text: str) -> None:
    with pytest.raises(UnitError):
        to_si(text, "m")


def test_whole_numbers_beyond_floats_are_refused() -> None:
    for value in (10**400, -10**5000):
        with pytest.raises(UnitError, match="beyond"):
            to_si(value, "m")


def test_headings() -> None:
    assert split_heading(" T [kN.m] ") == ("T", "kN.m")
    assert split_heading("T") == ("T", "")
    assert split_heading("T[0] x") == ("T[0] x", "")
