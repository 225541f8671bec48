"""No sign in the program is free: every assignment of every function of mechanics is negated once, and caught."""

from __future__ import annotations

import pytest

from mahovik.core.stand import load
from mahovik.core.stand.model import Stand
from mahovik.stands import path
from verify.build import caught, everything, flipped, generated, signs

FUNCTIONS = (
    "sum_mass",
    "sum_spin",
    "sum_steady_spin",
    "momentum_screw",
    "subtract_rates",
    "factor_carrier",
    "solve_carrier",
    "factor3",
    "solve3",
    "rotation",
    "rotate_back",
    "damp",
    "own_wrench",
    "suspend",
    "add_leg",
    "external",
    "matrices",
    "velocity_matrix",
    "momentum",
    "products",
)


@pytest.mark.slow
@pytest.mark.parametrize("name", FUNCTIONS)
def test_every_sign_counts(name: str) -> None:
    assert survivors(everything(), name) == []


@pytest.mark.slow
def test_every_sign_counts_where_no_body_has_added_mass() -> None:
    assert survivors(load(path("demo3")), "solve_carrier_once") == []


def survivors(stand: Stand, name: str) -> list[int]:
    """Signs of a function whose change nothing notices."""
    made = generated(stand)
    count = signs(made.program.function(name))
    assert count > 0
    found = []
    for number in range(count):
        made_wrong = type(made)(made.layout, flipped(made.program, name, number), made.values, {})
        if not caught(stand, made_wrong):
            found.append(number)
    return found
