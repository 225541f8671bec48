"""A flywheel by data sheet whose transverse inertia no body can have is refused with the least one."""

from __future__ import annotations

import pytest

from mahovik.core.stand import loads
from stand.test_refusals import BASE, WHEEL, refusal

THIN = '[[flywheel]]\nname = "w1"\nmass = "120 g"\nspin_inertia = "450 g cm^2"\ntransverse_inertia = {}\n'
UNBALANCE = 'unbalance = { static = "30 g mm", dynamic = "200 g cm^2" }\n'


@pytest.mark.parametrize(
    ("unbalance", "least", "words"),
    [
        ("", "225", "spin_inertia/2 = 225 g cm^2 across its axis: for"),
        (UNBALANCE, "402.838", "spin_inertia/2 = 225 g cm^2 across its axis, with this unbalance 402.838 g cm^2: for"),
    ],
)
def test_a_disc_thinner_than_any_is_told_the_least_transverse_inertia(unbalance: str, least: str, words: str) -> None:
    (line,) = refusal(BASE + THIN.format('"200 g cm^2"') + unbalance)
    assert "break the triangle inequality" in line
    assert words in line
    advised = f'"{least} g cm^2"'
    assert line.endswith(f"for a thin disc write transverse_inertia = {advised}")
    loads(BASE + THIN.format(advised) + unbalance)
    assert refusal(BASE + THIN.format(f'"{0.9999 * float(least)} g cm^2"') + unbalance)


@pytest.mark.parametrize(("spin", "unbalance"), [("0.000045", ""), ("0.000073", ""), ("0.000045", UNBALANCE)])
def test_numbers_without_units_are_answered_by_such(spin: str, unbalance: str) -> None:
    sheet = THIN.replace('"450 g cm^2"', spin)
    (line,) = refusal(BASE + sheet.format("2e-5") + unbalance)
    assert f"spin_inertia = {spin} kg m^2, transverse_inertia = 0.00002 kg m^2: " in line
    advised = line.rpartition(" = ")[2]
    loads(BASE + sheet.format(advised) + unbalance)
    assert refusal(BASE + sheet.format(f"{0.9999 * float(advised)}") + unbalance)


@pytest.mark.parametrize(
    ("inertia", "place", "sides"),
    [
        ('{ value = [120, 60, 40], unit = "g cm^2" }', "[120, 60, 40] g cm^2", "40 + 60 < 120 g cm^2"),
        ('["1200 g mm^2", "6 gcm2", 0]', "[1200 g mm^2, 6 gcm2, 0]", "0 + 600 < 1200 g mm^2"),
        ("[0.5, 0.5, 1.00000001]", "[0.5, 0.5, 1.00000001] kg m^2", "0.5 + 0.5 < 1.00000001 kg m^2"),
    ],
)
def test_moments_are_shown_in_the_unit_of_the_file(inertia: str, place: str, sides: str) -> None:
    (line,) = refusal(BASE.replace("[1, 1, 1]", inertia))
    unit = sides.partition("< ")[2].partition(" ")[2]
    assert line.startswith(f"s.toml: carrier, inertia = {place}: principal moments ")
    assert f"inequality, {sides}, expected the smaller two to add up to at least " in line
    assert f" {unit}, such as " in line


def test_the_moments_that_a_message_names_are_those_of_a_body() -> None:
    """What stands after "such as", with the largest moment, is read without a refusal."""
    body = '{{ value = [{}, {}, {}], unit = "g cm^2" }}'
    (line,) = refusal(BASE.replace("[1, 1, 1]", body.format(120, 60, 40)))
    assert line.endswith("at least 120 g cm^2, such as 40 and 80")
    loads(BASE.replace("[1, 1, 1]", body.format(120, 80, 40)))
    assert refusal(BASE.replace("[1, 1, 1]", body.format(120, 79.999, 40)))


def test_a_wheel_longer_than_any_gets_no_such_advice() -> None:
    (line,) = refusal(BASE + THIN.format('["900 g cm^2", "1 g cm^2"]'))
    assert "break the triangle inequality" in line
    assert "thin disc" not in line


def test_a_missing_transverse_inertia_is_that_of_a_thin_disc() -> None:
    sheet = THIN.partition("transverse")[0]
    (line,) = refusal(BASE + sheet)
    assert line.endswith(
        "transverse_inertia: required with spin_inertia, but missing; a thin disc has spin_inertia/2 = 225 g cm^2 "
        'across its axis: for a thin disc write transverse_inertia = "225 g cm^2"'
    )
    (line,) = refusal(BASE + sheet + UNBALANCE)
    assert line.endswith('for a thin disc write transverse_inertia = "402.838 g cm^2"')


def test_a_shape_is_answered_by_the_inertia_of_a_thin_disc() -> None:
    (line,) = refusal(BASE + THIN.format('"300 g cm^2"') + 'shape = "thin disc"\n')
    assert 'unknown key "shape": a flywheel has numbers in the place of a shape' in line
    assert line.endswith("for a thin disc transverse_inertia = spin_inertia/2")


def test_flat_discs_and_rods_are_bodies() -> None:
    disc = BASE.replace("[1, 1, 1]", "[0.5, 0.5, 1.0000000004]")
    rod = BASE + WHEEL.replace("[0.02, 0.01, 0.01]", "[0.02, 0, 0.02]")
    assert loads(disc).carrier.inertia[2][2] == 1.0000000004
    assert loads(rod).flywheels[0].inertia[1][1] == 0.0
    assert refusal(BASE.replace("[1, 1, 1]", "[0.5, 0.5, 1.00000001]"))
