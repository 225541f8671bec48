"""Collocation of ordinary differential equations at uniform nodes, blocks of four intervals (order 6): linear part.

On a block y_j = y_0 + d sum_k a_jk y'_k, j = 1..4, k = 0..4, with a_jk the integrals of the Lagrange polynomials: all
nodes of a course are evaluated at once, and only products of small matrices go from block to block.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mahovik.use.plan.array import Array

INTERVALS = 4
"""Intervals per block."""


def _integrals() -> Array:
    """a (4, 5): integral from 0 to j of the Lagrange polynomial of node k, spacing 1."""
    nodes = np.arange(INTERVALS + 1.0)
    powers = np.vander(nodes, increasing=True)  # rows: node; columns: power
    integrals = powers[1:] * nodes[1:, None] / (nodes + 1.0)
    return np.asarray(integrals @ np.linalg.inv(powers))


WEIGHTS = _integrals()


def split_blocks(values: Array) -> Array:
    """Values (B, 5, ...) of each block, first node included, from values at 4 B + 1 nodes."""
    B = (len(values) - 1) // INTERVALS
    first = values[:-1].reshape(B, INTERVALS, *values.shape[1:])
    return np.concatenate([first, values[INTERVALS::INTERVALS][:, None]], axis=1)


def integrate(rates: Array, spacing: float) -> Array:
    """Integrals (B, 4, ...) of rates at 4 B + 1 nodes (M, ...), from the first node of each block to the others."""
    return np.asarray(spacing * np.einsum("jk,bk...->bj...", WEIGHTS, split_blocks(rates)))


@dataclass(frozen=True, eq=False)
class Eliminated:
    """x' = A x + g at 4 B + 1 nodes, eliminated block by block, for any g and start.

    inverse    (B, 4 n, 4 n): inverse of each block's equations
    carried    (B, 4 n, n): nodes of a block as functions of its first node
    """

    spacing: float
    inverse: Array
    carried: Array

    @staticmethod
    def of(A: Array, spacing: float) -> Eliminated:
        """Eliminate A (4 B + 1, n, n; 1/s) at nodes `spacing` (s) apart."""
        at = split_blocks(A)
        B, n = len(at), A.shape[1]
        own = -spacing * np.einsum("jk,bkmn->bjmkn", WEIGHTS[:, 1:], at[:, 1:]).reshape(B, INTERVALS * n, INTERVALS * n)
        own[:, range(INTERVALS * n), range(INTERVALS * n)] += 1.0
        inverse = np.linalg.inv(own)
        first = spacing * np.einsum("j,bmn->bjmn", WEIGHTS[:, 0], at[:, 0]) + np.eye(n)
        return Eliminated(spacing, inverse, inverse @ first.reshape(B, INTERVALS * n, n))

    def solve(self, defects: Array, start: Array) -> Array:
        """x (4 B + 1, n, P) from `start` (n, P); `defects` (B, 4, n, P) are the right sides of the block equations."""
        B, n, P = len(self.inverse), *start.shape
        particular = self.inverse @ defects.reshape(B, INTERVALS * n, P)
        found = [start[None]]
        for carried, own in zip(self.carried, particular, strict=True):
            found.append((carried @ found[-1][-1] + own).reshape(INTERVALS, n, P))
        return np.concatenate(found)
