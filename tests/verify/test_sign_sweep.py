"""No sign in the program is free: every assignment of every function of mechanics is negated once, and caught."""

from __future__ import annotations

import pytest

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
    stand = everything()
    made = generated(stand)
    count = signs(made.program.function(name))
    assert count > 0
    survivors = []
    for number in range(count):
        made_wrong = type(made)(made.layout, flipped(made.program, name, number), made.values, {})
        if not caught(stand, made_wrong):
            survivors.append(number)
    assert survivors == []
