"""Held carrier, V_r* = S u* + d: (8) along the freedoms, S^T K S u* = S^T (b - K d), and what the hold exerts.

b = F - M V_r - J phi' - I phi'', d = (omega x C^T u, 0) of a stream. A column of S is a twist of O1 at u = 1, constant
in E1; the reaction is R = K V_r* - b.
"""

from __future__ import annotations

import sympy as sp

from mahovik.core.derive.carrier import mass_matrix, mu
from mahovik.core.derive.screw import blocks, cross
from mahovik.core.derive.symbols import symmetric, vector

twist = vector("twist", 6)


def mass_times(added_mass: bool) -> sp.Matrix:
    """K times a twist or its rate, `twist` (6), in the sums A (or m), mu, G, J."""
    return mass_matrix(added_mass) * twist


def harmonic_times() -> sp.Matrix:
    """One harmonic of K, with mu and J of the harmonic, times a twist: no mass changes with a phase."""
    return blocks(sp.zeros(3), cross(mu).T, cross(mu), symmetric("J")) * twist


def mass_times_drift(added_mass: bool) -> sp.Matrix:
    """K d, d = (drift, 0)."""
    return mass_matrix(added_mass) * vector("drift").col_join(sp.zeros(3, 1))
