"""The stands and states of the benchmark, with the reference's results and their natural scales."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from mahovik.core.stand.model import Stand, State
from mahovik.core.stand.random import BARE, random_stand, random_state
from mahovik.proof.reference.evaluate import evaluate
from mahovik.proof.verify.scales import scales_of
from mahovik_bench.works import Work

Array = NDArray[np.float64]

SEED = 1986
STATES = 16
"""So few that records of every peer stay in the first cache."""


@dataclass(frozen=True)
class Case:
    """A free carrier with N flywheels, every body a cloud of point masses, and states of it."""

    stand: Stand
    states: tuple[State, ...]

    @property
    def N(self) -> int:
        """Number of flywheels."""
        return len(self.stand.flywheels)

    @cached_property
    def flat(self) -> Array:
        """Inputs as native/peer.h has them, one row per state."""
        return np.array([[*s.V, *s.phi, *s.phi_dot, *s.phi_ddot, *s.tau, *s.V_dot] for s in self.states])

    def expected(self, work: Work) -> tuple[Array, Array]:
        """Results of the NumPy reference and their natural scales, one row per state."""
        rows, sizes = [], []
        for state in self.states:
            answers = evaluate(self.stand, state, [work.name])
            scale = scales_of(self.stand, state, work.name)
            rows.append(np.concatenate([np.ravel(answers[part]) for part in work.parts]))
            sizes.append(np.concatenate([np.ravel(scale[part]) for part in work.parts]))
        return np.array(rows), np.array(sizes)


def case(N: int) -> Case:
    """Case of N flywheels, equal on every machine. The carrier is aligned with E0, at its origin."""
    rng = np.random.default_rng([SEED, N])
    stand = random_stand(rng, N, BARE, name=f"free{N}")
    drawn = (random_state(stand, rng) for _ in range(STATES))
    states = tuple(replace(state, position=(0.0, 0.0, 0.0), angles=None, quaternion=None) for state in drawn)
    return Case(stand, states)
