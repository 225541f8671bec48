"""A flywheel by data sheet whose transverse inertia no body can have is refused with the least one."""

from __future__ import annotations

import pytest

from mahovik.core.stand import loads
from stand.test_refusals import BASE, refusal

THIN = '[[flywheel]]\nname = "w1"\nmass = "120 g"\nspin_inertia = "450 g cm^2"\ntransverse_inertia = {}\n'
UNBALANCE = 'unbalance = { static = "30 g mm", dynamic = "200 g cm^2" }\n'


@pytest.mark.parametrize(
    ("unbalance", "least", "words"),
    [
        ("", "2.25e-05", "spin_inertia/2 = 2.25e-05 kg m^2 across its axis: for"),
        (
            UNBALANCE,
            "4.02838e-05",
            "spin_inertia/2 = 2.25e-05 kg m^2 across its axis, with this unbalance 4.02838e-05: for",
        ),
    ],
)
def test_a_disc_thinner_than_any_is_told_the_least_transverse_inertia(unbalance: str, least: str, words: str) -> None:
    (line,) = refusal(BASE + THIN.format('"200 g cm^2"') + unbalance)
    assert "break the triangle inequality" in line
    assert words in line
    assert line.endswith(f"for a thin disc write transverse_inertia = {least}")
    loads(BASE + THIN.format(least) + unbalance)
    assert refusal(BASE + THIN.format(f"{0.9999 * float(least)}") + unbalance)


def test_a_wheel_longer_than_any_gets_no_such_advice() -> None:
    (line,) = refusal(BASE + THIN.format('["900 g cm^2", "1 g cm^2"]'))
    assert "break the triangle inequality" in line
    assert "thin disc" not in line


def test_a_missing_transverse_inertia_is_that_of_a_thin_disc() -> None:
    sheet = THIN.partition("transverse")[0]
    (line,) = refusal(BASE + sheet)
    assert line.endswith(
        "transverse_inertia: required with spin_inertia, but missing; a thin disc has spin_inertia/2 = 2.25e-05 kg m^2 "
        "across its axis: for a thin disc write transverse_inertia = 2.25e-05"
    )
    (line,) = refusal(BASE + sheet + UNBALANCE)
    assert line.endswith("for a thin disc write transverse_inertia = 4.02838e-05")


def test_a_shape_is_answered_by_the_inertia_of_a_thin_disc() -> None:
    (line,) = refusal(BASE + THIN.format('"300 g cm^2"') + 'shape = "thin disc"\n')
    assert 'unknown key "shape": a flywheel has numbers in the place of a shape' in line
    assert line.endswith("for a thin disc transverse_inertia = spin_inertia/2")
