"""Accuracy with lanes and for speed: every example stand against both derivations, by the tolerances of one lane."""

from __future__ import annotations

import numpy as np
import pytest

from mahovik.core.emit.generate import LANES
from mahovik.core.stand import load
from mahovik.core.stand.random import BARE, random_stand
from mahovik.proof.verify.bounds import DOUBLE
from mahovik.proof.verify.c_backend import CBackend
from mahovik.proof.verify.draw import draw
from mahovik.proof.verify.harness import judge, verify_c
from mahovik.stands import names, path


@pytest.mark.slow
@pytest.mark.parametrize("name", names())
@pytest.mark.parametrize("lanes", LANES[1:])
def test_every_example_stand_with_lanes(name: str, lanes: int) -> None:
    assert verify_c(load(path(name)), count=30, lanes=lanes).passed


@pytest.mark.slow
@pytest.mark.parametrize("name", names())
@pytest.mark.parametrize(("lanes", "real"), [(1, "double"), (4, "double"), (8, "float")])
def test_every_example_stand_for_speed(name: str, lanes: int, real: str) -> None:
    assert verify_c(load(path(name)), count=30, lanes=lanes, fast=True, real=real).passed


@pytest.mark.slow
@pytest.mark.parametrize("lanes", [1, 8])
def test_a_thousand_flywheels(lanes: int) -> None:
    """No term is lost in long sums, and nothing but time grows."""
    stand = random_stand(np.random.default_rng(1), 1000, BARE, "many")
    backend = CBackend(stand, lanes=lanes)
    rows = judge(stand, backend, draw(stand, 1, 2), ("matrices", "forward", "coupled", "torque"), DOUBLE)
    assert {row.verdict for row in rows} == {"ok"}
    assert max(row.worst for row in rows) < 1e-13
