"""Random stands judged three ways: the generated C, the literal reference, the second derivation."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from mahovik.contract.limits import LIMITS
from mahovik.core.stand.model import Stand
from mahovik.core.stand.random import BARE, EVERYTHING, SEQUENCES, Features, random_stand
from mahovik.proof.second import Second
from mahovik.proof.verify.backends import with_all_inputs
from mahovik.proof.verify.c_backend import CBackend
from mahovik.proof.verify.check import Report, report
from mahovik.proof.verify.draw import draw
from mahovik.proof.verify.harness import judge

COUNTS = (0, 1, 5, 6, 7, 12, 64, 3, 2, 8, 4, 10)
"""Flywheels of the stands, in turn: every kind of inverse problem, none, and many."""

WHAT_MATTERS = 7
"""Leading stands, which have the counts that matter: 0, 1, 5, 6, 7, 12, 64."""

KINDS = (EVERYTHING, Features(), BARE, Features())
"""Features of the stands, in turn; of those drawn, every second takes run-time wrenches on all bodies."""


FLOW_FROM = 50
"""Number of the first stand with strips, fins, propellers and fading damping. Kept results have those before it."""


def random_stands(count: int) -> Iterator[Stand]:
    """The first `count` stands of the campaign: always the same ones."""
    for number in range(count):
        kind = KINDS[(number + number // len(COUNTS)) % len(KINDS)]
        features = replace(kind, angles=SEQUENCES[number % len(SEQUENCES)], flow=number >= FLOW_FROM)
        flywheels = COUNTS[number % len(COUNTS)]
        stand = random_stand(np.random.default_rng(number), flywheels, features, f"random{number}")
        yield stand if number % 2 else with_all_inputs(stand)


def verify_random(
    stand: Stand, states: int, seed: int = 1, real: str = "double", backend: CBackend | None = None
) -> Report:
    """Compiled C against both derivations; `backend`: where it is compiled already."""
    backend = backend or CBackend(stand, real)
    drawn = draw(stand, seed, states, real)
    rows = judge(stand, backend, drawn, backend.wants, LIMITS[real], second=Second(stand))
    return report(stand, "generated C", seed, states, LIMITS[real].value, rows)
