"""Units: exact to the last bit, of the right dimension, or refused with the unit that is meant."""

from __future__ import annotations

import subprocess
import sys
import time
from decimal import Decimal
from fractions import Fraction
from itertools import product

import mpmath
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mahovik.core.stand.units import (
    ACCELERATION,
    ANGLE,
    DYNAMIC_UNBALANCE,
    INERTIA,
    LENGTH,
    MASS,
    RESISTANCE,
    SPEED,
    STATIC_UNBALANCE,
    TIME,
    TORQUE,
    TORQUE_CONSTANT,
    UNITS,
    VISCOUS,
    VOLTAGE,
    Dimension,
    QuantityError,
    _registry,
    _root,
    number,
)
from mahovik.stands import path

DECIMALS = st.decimals(allow_nan=False, allow_infinity=False, places=6, min_value=-(10**6), max_value=10**6)


@pytest.mark.parametrize(
    ("text", "dimension", "expected"),
    [
        ("120 mm", LENGTH, 0.12),
        ("2.5 kg cm^2", INERTIA, 0.00025),
        ("2.5 kg*cm^2", INERTIA, 0.00025),
        ("2.5 N/(m/s)^2", Dimension("a quadratic damping", "N s^2/m^2"), 2.5),
        ("50 µs", TIME, 5e-5),
        ("30 mV s/rad", TORQUE_CONSTANT, 0.03),
        ("1e-5 N m s", VISCOUS, 1e-5),
        ("1e-5 N m s/rad", VISCOUS, 1e-5),
        ("1 inch", LENGTH, 0.0254),
        (".5 m", LENGTH, 0.5),
        ("-2e3 mm", LENGTH, -2.0),
    ],
)
def test_a_unit_gives_the_float_of_the_si_literal(text: str, dimension: Dimension, expected: float) -> None:
    assert expected == number(text, dimension)


@given(DECIMALS)
def test_millimetres_are_exact(x: Decimal) -> None:
    assert float(x / 1000) == number(f"{x} mm", LENGTH) == number(x, LENGTH, "mm")


@given(DECIMALS)
def test_angles_are_correctly_rounded(x: Decimal) -> None:
    with mpmath.workdps(60):
        degree = mpmath.mpf(str(x)) * mpmath.pi / 180
        rpm = mpmath.mpf(str(x)) * mpmath.pi / 30
        assert float(degree) == number(f"{x} deg", ANGLE)
        assert float(rpm) == number(f"{x} rpm", SPEED)


@pytest.mark.parametrize("unit", ["m/", "^2", "m^x", "(m", "m m)", "m^99", "__import__", "m;m", "", "1e9 m", "lambda"])
def test_nonsense_is_no_unit(unit: str) -> None:
    with pytest.raises(QuantityError):
        number(f"1 {unit}", LENGTH)


@pytest.mark.parametrize(
    "unit",
    [
        *("kg^9^9^9", "kg**9**9", "9^9^9^9 kg", "kg^99999999", "kg^-99999999", "kg9999999", "1e99999999", "kg²³²³²³²³"),
        *("((((kg^9)^9)^9)^9)^9", "sq square cubic kg cubed squared", "kg squared squared squared", "kg^0.5", "kg^^2"),
    ],
)
def test_a_power_that_would_take_hours_is_no_unit(unit: str) -> None:
    begun = time.process_time()
    with pytest.raises(QuantityError, match=r"is not a (known )?unit"):
        number(f"1 {unit}", MASS)
    assert time.process_time() - begun < 3.0  # pint starts in half a second


SHEETS = (
    ("gcm²", INERTIA, "1e-7"), ("gcm2", INERTIA, "1e-7"), ("gcm^2", INERTIA, "1e-7"), ("g-cm^2", INERTIA, "1e-7"),
    ("g⋅cm²", INERTIA, "1e-7"), ("kg-m^2", INERTIA, "1"), ("kgm2", INERTIA, "1"), ("kgm²", INERTIA, "1"),
    ("gmm²", DYNAMIC_UNBALANCE, "1e-9"), ("gmm", STATIC_UNBALANCE, "1e-6"), ("g-mm", STATIC_UNBALANCE, "1e-6"),
    ("gcm", STATIC_UNBALANCE, "1e-5"), ("mN-m", TORQUE, "0.001"), ("mNm", TORQUE, "0.001"), ("Nmm", TORQUE, "0.001"),
    ("oz-in", TORQUE, "0.0070615518142260443750"), ("oz in", TORQUE, "0.0070615518142260443750"),
    ("oz-in/A", TORQUE_CONSTANT, "0.0070615518142260443750"), ("oz-in", STATIC_UNBALANCE, "0.000720077887375"),
    ("oz-in^2", INERTIA, "0.000018289978339325"), ("oz-in-s^2", INERTIA, "0.0070615518142260443750"),
    ("lb-in", TORQUE, "0.11298482902761671"), ("µm", LENGTH, "1e-6"), ("μm", LENGTH, "1e-6"),
    ("kg/m³", Dimension("a density", "kg/m^3"), "1"), ("kg m⁻³", Dimension("a density", "kg/m^3"), "1"),
    ("1/min", Dimension("a frequency", "Hz"), "1/60"), ("cpm", Dimension("a frequency", "Hz"), "1/60"),
    ("lbm", MASS, "0.45359237"), ("lbm ft^2", INERTIA, "0.0421401100938048"),
)  # fmt: skip


@pytest.mark.parametrize(("unit", "dimension", "factor"), SHEETS)
def test_units_of_data_sheets(unit: str, dimension: Dimension, factor: str) -> None:
    assert number(f"7 {unit}", dimension) == float(7 * Fraction(factor))
    assert number(Decimal(7), dimension, unit) == float(7 * Fraction(factor))


@pytest.mark.parametrize("unit", ["RPM", "cpm", "tr/min", "1/min", "r/min", "U/min", "min^-1", "min-1", "min⁻¹"])
def test_per_minute_is_rpm_where_a_speed_is_asked(unit: str) -> None:
    assert number(f"3000 {unit}", SPEED) == number("3000 rpm", SPEED)


@pytest.mark.parametrize(
    ("unit", "dimension", "words"),
    [
        ("gcm", INERTIA, 'unit "gcm", read as "g cm", does not fit, expected a moment of inertia'),
        ("gm", MASS, 'did you mean "g" or "g m"?'),
        ("kg-cm", TORQUE, 'did you mean "kgf cm"?'),
        ("g cm", TORQUE, 'did you mean "gf cm"?'),
        ("1/s", SPEED, "write rpm or rad/s"),
        ("Hz", SPEED, "write rpm or rad/s"),
        ("oz-in", LENGTH, 'read as "oz in"'),
        ("foo", MASS, '"foo" is not a known unit, expected a mass (kg)'),
    ],
)
def test_a_unit_that_does_not_fit_is_refused_with_a_hint(unit: str, dimension: Dimension, words: str) -> None:
    with pytest.raises(QuantityError) as refusal:
        number(f"1 {unit}", dimension)
    assert words in str(refusal.value)


FIELD = Dimension("a magnetic field", "T")


HINTS = (
    ("kilos", MASS, "kg"), ("kilo", MASS, "kg"), ("kgs", MASS, "kg"), ("Kg", MASS, "kg"), ("G", MASS, "g"),
    ("grammes", MASS, "g"), ("kilogrm", MASS, "kilogram"), ("Metres", LENGTH, "m"), ("metrs", LENGTH, "meter"),
    ("MM", LENGTH, "mm"), ("Seconds", TIME, "s"), ("secnds", TIME, "second"), ("Degrees", ANGLE, "deg"),
    ("Volt", VOLTAGE, "V"), ("R", RESISTANCE, "ohm"), ("Rpm", SPEED, "rpm"), ("u/min", SPEED, "rpm"),
    ("nm", TORQUE, "N m"), ("kilos m^2", INERTIA, "kg m^2"), ("gm cm^2", INERTIA, "g cm^2"), ("Tesla", FIELD, "T"),
)  # fmt: skip


def refusal(unit: str, dimension: Dimension) -> str:
    with pytest.raises(QuantityError) as refusal:
        number(f"20 {unit}", dimension)
    return str(refusal.value)


@pytest.mark.parametrize(("unit", "dimension", "meant"), HINTS)
def test_what_is_meant_is_named_after_what_is_expected(unit: str, dimension: Dimension, meant: str) -> None:
    text = refusal(unit, dimension)
    assert text.endswith(f'expected {dimension.words} ({dimension.si}), did you mean "{meant}"?')
    number(f"20 {meant}", dimension)


@pytest.mark.parametrize(("unit", "tesla"), [("G", 1e-4), ("gauss", 1e-4), ("Gauss", 1e-4), ("mG", 1e-7), ("kG", 0.1)])
def test_gauss_is_answered_by_tesla(unit: str, tesla: float) -> None:
    text = refusal(unit, FIELD)
    assert "power" not in text
    before, _, answer = text.rpartition(f", 1 {unit} is ")
    assert before.endswith("expected a magnetic field (T)")
    assert number(answer, FIELD) == tesla


def test_g_of_an_acceleration_is_answered_in_si() -> None:
    assert refusal("g", ACCELERATION).endswith("expected an acceleration (m/s^2), 1 g is 9.80665 m/s^2")


@pytest.mark.parametrize("unit", ["gr", "gr mm", "gr/cm^3"])
def test_grams_are_not_taken_for_grains(unit: str) -> None:
    dimension = MASS if unit == "gr" else Dimension("a static unbalance", "kg m")
    assert '"gr" may be grams or grains, write g or grain' in refusal(unit, dimension)
    assert number("20 grain", MASS) == 1.2959782e-3


FORMS = (
    "{0}",
    "{0}^-2",
    "1/{0}",
    "{0}/{1} {2}",
    "{0}*{1}/({2} {0}^2)",
    "({0}/{1})^2 {2}",
    "{0} {1}^2",
    "{0}^3  {1} / {2}^2",
)


@pytest.mark.parametrize("form", FORMS)
def test_the_table_is_pints(form: str) -> None:
    registry = _registry()
    names = list(UNITS)
    for k, (first, second) in enumerate(product(names, names)):
        unit = form.format(first, second, names[k % len(names)])
        scale, root = registry.get_root_units(registry.parse_units(unit))
        assert _root(unit) == (scale, {name: int(power) for name, power in root._units.items()}), unit


def test_a_stand_with_usual_units_needs_no_pint() -> None:
    code = "import sys; from mahovik.core.stand import load; load(sys.argv[1]); sys.exit('pint' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code, path("sat4")], check=False).returncode == 0
