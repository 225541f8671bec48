"""Held carrier, V_r* = S u* + d: (8) along the freedoms, S^T K S u* = S^T (b - K d), and what the hold exerts.

b = F - M V_r - J phi' - I phi'', d = (omega x C^T u, 0) of a stream. A column of S is a twist of O1 at u = 1, constant
in E1; the reaction is R = K V_r* - b.
"""

from __future__ import annotations

import sympy as sp

from mahovik.core.derive.attitude import quaternion_product
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


def from_home() -> sp.Matrix:
    """h* q: the turn from the home attitude h to the attitude q, quaternions with w first."""
    home = vector("home", 4)
    return quaternion_product(sp.Matrix([home[0], -home[1], -home[2], -home[3]]), vector("q", 4))


def turned_home() -> sp.Matrix:
    """h q: the attitude after the turn q from the home attitude h."""
    return quaternion_product(vector("home", 4), vector("q", 4))


def turning_rate() -> sp.Matrix:
    """b + omega x a: R times it is the rate of R a, with R* = R <omega> and b the rate of a."""
    return vector("b") + cross(vector("omega")) * vector("a")


def rate_before_turning() -> sp.Matrix:
    """b - omega x a: the rate of a, with b = R^T times the rate of R a."""
    return vector("b") - cross(vector("omega")) * vector("a")
