"""Wrench of the suspension, in balls."""

from __future__ import annotations

from flint import arb_mat

from mahovik.core.stand.model import Stand
from mahovik.core.stand.state import State
from mahovik.errors import StateError
from mahovik.laws.suspension.data import Suspension
from mahovik.proof.rigorous.ball import column, matrix
from mahovik.proof.rigorous.rotation import SEQUENCE, rotation_product, rotation_vector
from mahovik.proof.rigorous.screw import screw_of_parts


def wrenches(stand: Stand, state: State, O1: arb_mat, C: arb_mat, V: arb_mat) -> list[arb_mat]:
    """-(stiffness x + damping V) (6; N, N m), x = (C^T (O1 - position), rotation vector of C_eq^T C).

    Raises StateError at half a turn from equilibrium, where there are two rotation vectors.
    """
    law = stand.law(Suspension)
    if law is None:
        return []
    C_eq = rotation_product(SEQUENCE[stand.angles], law.angles)
    try:
        rotation = rotation_vector(C_eq.transpose() * C)
    except StateError as error:
        raise StateError(f"suspension: {error}") from None
    x = screw_of_parts(C.transpose() * (O1 - column(law.position)), rotation)
    return [-(matrix(law.stiffness) * x + matrix(law.damping) * V)]
