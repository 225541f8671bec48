"""Momentum screw (2), (1), kinetic energy, centre of mass and its velocity. Bodies move at V; the fluid at V_r."""

from __future__ import annotations

from typing import Any

import numpy as np

from mahovik.core.stand.model import Stand
from mahovik.errors import StateError
from mahovik.proof.reference.array import Array, times, vector
from mahovik.proof.reference.pieces import Pieces
from mahovik.proof.reference.screw import cross


def momentum(at: Pieces) -> Array:
    """Z = K V + sum_s I_s phi_s' (6; kg m/s, kg m2/s) in E1 about O1, (2); Lambda takes V_r."""
    return at.K_bodies @ at.V + at.Lambda @ at.V_r + at.I @ at.phi_dot


def momentum_in_E0(at: Pieces) -> Array:
    """Z0 = L1 Z (6) in E0 about its origin, (1)."""
    return at.L1 @ momentum(at)


def kinetic_energy(at: Pieces) -> Any:
    """Half the sum of V_k^T Theta_k V_k over all bodies k, and of V_r^T Lambda V_r (J)."""
    V_k = at.bodies.twists(at.V)
    return 0.5 * ((V_k * times(at.bodies.Theta, V_k)).sum() + at.V_r @ at.Lambda @ at.V_r)


def center_of_mass(at: Pieces) -> Array:
    """Centre of mass (3, m) of all bodies, in E1; added mass is no body. StateError where nothing has mass."""
    m, m_rc = at.K_bodies[0, 0], at.K_bodies[3:, :3]  # m E and <m rc>
    if m == 0.0:
        raise StateError("momentum: no body of the stand has a mass, so there is no center_of_mass")
    return np.array([m_rc[2, 1] / m, m_rc[0, 2] / m, m_rc[1, 0] / m])


def center_of_mass_velocity(at: Pieces, stand: Stand) -> Array:
    """Velocity (3, m/s) of the centre of mass in E0: sum_k m_k C C_k v_k over the mass.

    v_k + omega_k x r_k is the velocity of the mass centre of a body in its own frame.
    """
    mass = vector([body.mass for body in stand.bodies])
    V_k, r_k = at.bodies.twists(at.V), vector([body.center_of_mass for body in stand.bodies])
    velocity = V_k[:, :3] + times(cross(V_k[:, 3:]), r_k)
    in_E1 = times(at.bodies.L[:, :3, :3], mass[:, None] * velocity).sum(axis=0)
    return np.asarray(at.C @ in_E1 / mass.sum())
