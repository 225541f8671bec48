"""Units that are none, or none of the key, with the one that is meant."""

from __future__ import annotations

import pytest

from mahovik.core.stand.unit_spellings import _WORDS, NAMES
from mahovik.core.stand.units import (
    ANGLE,
    INERTIA,
    LENGTH,
    MASS,
    RESISTANCE,
    SPEED,
    TIME,
    TORQUE,
    VOLTAGE,
    Dimension,
    QuantityError,
    number,
)

FIELD = Dimension("a magnetic field", "T")
HINTS = (
    ("kilos", MASS, "kg"), ("kilo", MASS, "kg"), ("kgs", MASS, "kg"), ("Kg", MASS, "kg"), ("G", MASS, "g"),
    ("grammes", MASS, "g"), ("kilogrm", MASS, "kilogram"), ("Metres", LENGTH, "m"), ("metrs", LENGTH, "meter"),
    ("MM", LENGTH, "mm"), ("Seconds", TIME, "s"), ("secnds", TIME, "second"), ("Degrees", ANGLE, "deg"),
    ("Volt", VOLTAGE, "V"), ("R", RESISTANCE, "ohm"), ("RPM", SPEED, "rpm"), ("u/min", SPEED, "rpm"),
    ("nm", TORQUE, "N m"), ("kilos m^2", INERTIA, "kg m^2"), ("gm cm^2", INERTIA, "g cm^2"), ("Tesla", FIELD, "T"),
)  # fmt: skip


def refusal(unit: str, dimension: Dimension) -> str:
    with pytest.raises(QuantityError) as found:
        number(f"20 {unit}", dimension)
    return str(found.value)


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


@pytest.mark.parametrize(
    ("unit", "dimension"), [("m", MASS), ("ms", LENGTH), ("amps", VOLTAGE), ("kg", LENGTH), ("degree", SPEED)]
)
def test_a_unit_of_something_else_is_no_slip_of_the_pen(unit: str, dimension: Dimension) -> None:
    assert refusal(unit, dimension) == (f'unit "{unit}" does not fit, expected {dimension.words} ({dimension.si})')


def test_a_hint_is_a_unit() -> None:
    """Every unit that may be suggested is one of some dimension, which a message on a wrong dimension shows."""
    for unit in {*NAMES, *_WORDS.values()}:
        with pytest.raises(QuantityError, match="does not fit"):
            number(f"1 {unit}", Dimension("an illuminance", "lx"))


@pytest.mark.parametrize("unit", ["gr", "gr mm", "gr/cm^3"])
def test_grams_are_not_taken_for_grains(unit: str) -> None:
    dimension = MASS if unit == "gr" else Dimension("a static unbalance", "kg m")
    assert '"gr" may be grams or grains, write g or grain' in refusal(unit, dimension)
    assert number("20 grain", MASS) == 1.2959782e-3
