"""Wrench by which a hold makes the carrier move as it does, (8): what a force table under the carrier reads."""

from __future__ import annotations

import numpy as np

from mahovik.core.stand.model import Stand
from mahovik.core.stand.state import State
from mahovik.errors import StateError
from mahovik.proof.reference.array import Array, Values, vector
from mahovik.proof.reference.forward import bias
from mahovik.proof.reference.pieces import Pieces


def reaction(at: Pieces, V_dot: Array, phi_ddot: Array) -> Array:
    """R = K V_r* + M V_r + I phi'' + J phi' - F (6; N, N m), of the hold on the carrier, in E1 about O1."""
    return np.asarray(at.K @ at.V_r_dot(V_dot) + bias(at) + at.I @ phi_ddot - at.F)


def answer(at: Pieces, stand: Stand, state: State) -> Values:
    """reaction (6) for the V_dot and phi_ddot of the state. StateError: the carrier is free."""
    if stand.hold is None:
        raise StateError('want: "reaction" is of held carriers, and the stand has no [hold]: ask for forward')
    return {"reaction": reaction(at, vector(state.V_dot), vector(state.phi_ddot))}
