"""The plant of optimal control, (13): flywheels in two parts, N - 6 independent (minus), 6 dependent (plus)."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from mahovik.proof.reference.array import Array, solve
from mahovik.proof.reference.inverse import demand
from mahovik.proof.reference.pieces import Pieces


def dependent_acceleration(at: Pieces, V_dot: Array, plus: Sequence[int], u: Array) -> Array:
    """phi_+'' = I+^-1 (P(t) - I- u - J phi') (6, rad/s2), (13), for the carrier's V_dot (6) relative to E0.

    `plus` (6) are the indices of the dependent flywheels, in the order of the answer; u = phi_-'' (N - 6, rad/s2)
    those of the others, in the file's order. det I+ = 0 raises numpy.linalg.LinAlgError.
    """
    minus = [s for s in range(len(at.flywheels)) if s not in plus]
    return solve(at.I[:, list(plus)], demand(at, V_dot) - at.I[:, minus] @ u)


def determinant(at: Pieces, plus: Sequence[int]) -> float:
    """det I+ of (13): in units of kg^6 m^9, its sign is what matters."""
    return float(np.linalg.det(at.I[:, list(plus)]))
