"""Natural scales: shaped as their quantities, never below them, and blind to the choice of units."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from laws.held_stands import HOLDS, held_stand
from mahovik.core.stand import Stand
from mahovik.core.stand.random import EVERYTHING, random_stand
from mahovik.errors import StateError
from mahovik.proof import reference
from mahovik.proof.verify.draw import draw
from mahovik.proof.verify.harness import applicable
from mahovik.proof.verify.scales import WANT_SCALES, scales

ROUNDING = 1 + 1e-9  # of the scale's own sums; the bound itself is exact


def pairs(found: dict[str, Any], natural: dict[str, Any]) -> list[tuple[str, Any, Any]]:
    flat = []
    for name, value in found.items():
        if isinstance(value, dict):
            flat += [(f"{name} {n}", v, s) for n, v, s in pairs(value, natural[name])]
        elif natural[name] is not None:
            flat.append((name, np.asarray(value), np.asarray(natural[name])))
    return flat


def check_bounds(stand: Stand, want: str, seed: int) -> int:
    checked = 0
    for _, state in draw(stand, seed, 8):
        if not applicable(state, want):
            continue
        try:
            found = reference.evaluate(stand, state, [want])
        except StateError:
            continue
        natural = scales(stand, state, reference.pieces(stand, state), want)
        assert set(natural) == set(found)
        for name, value, scale in pairs(found, natural):
            assert value.shape == scale.shape, name
            assert np.all(np.abs(value) <= scale * ROUNDING + 1e-290), name
            checked += 1
    return checked


OF_FREE = [want for want in WANT_SCALES if want != "reaction"]


@pytest.mark.parametrize("want", OF_FREE)
def test_a_quantity_is_never_larger_than_its_scale(want: str) -> None:
    assert sum(
        check_bounds(random_stand(np.random.default_rng(seed), 1 + seed, EVERYTHING), want, seed) for seed in range(7)
    )


@pytest.mark.parametrize("tables", HOLDS)
def test_a_reaction_is_never_larger_than_its_scale(tables: str) -> None:
    assert check_bounds(held_stand(tables), "reaction", 3)
