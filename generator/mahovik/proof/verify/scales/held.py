"""Scales of the motion and the reaction of a held carrier, through the magnitudes of what is solved for."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from mahovik.core.stand.model import Hold
from mahovik.proof.reference.coordinates import sine_and_cosine, unit
from mahovik.proof.reference.hold import held_coupled as reference_coupled
from mahovik.proof.reference.hold import held_forward as reference_forward
from mahovik.proof.reference.rotation import attitude
from mahovik.proof.verify.scales.magnitudes import Array, Magnitudes, geometric_mean, inverse_magnitude
from mahovik.proof.verify.scales.parts import length

ROUNDING = 2.0**-10
"""Part of the whole right-hand side of (8) that a component has for a scale at least.

Where nothing acts along a freedom, its own terms have no size, but whoever solves for motion and reaction together, or
turns the terms into other axes, leaves some units in the last place of the others: 1e-12 of this part is about four.
"""


def held_forward(m: Magnitudes) -> dict[str, Any]:
    """Scales of u_dot (m), V_dot (6), reaction (6): |(S^T K S)^-1| |S^T| times that of the right-hand side of (8)."""
    assert m.stand.hold is not None
    moved = reference_forward(m.at, m.stand.hold, np.array(m.state.phi_ddot, dtype=np.float64))
    right = m.S_bias + m.S_I @ m.acceleration + m.S_K @ (np.abs(moved.V_dot) + m.stream_rate)
    right = _above_rounding(right, np.diag(m.at.K))
    u_dot = m.free.K_inverse @ m.free.S.T @ right
    return _motion(m, u_dot, right)


def held_coupled(m: Magnitudes, hold: Hold, on_flywheels: Array, locked: Array) -> dict[str, Any]:
    """Scales of u_dot (m), V_dot (6), reaction (6), phi_ddot (N), by the matrix of m + N unknowns.

    `on_flywheels` (N, N m): of drive torques and what else acts about the axes; `locked` (N, bool).
    """
    motion, phi_ddot = reference_coupled(m.at, hold, np.array(m.state.tau, dtype=np.float64), locked)
    count = len(hold.freedoms)
    free = np.concatenate([np.full(count, True), np.logical_not(locked)])
    whole = np.block([[m.free.K, m.free.I], [m.free.I.T, m.at.Theta_ff]])[np.ix_(free, free)]
    right = np.concatenate([m.S_bias + m.S_K @ m.stream_rate, on_flywheels + m.S_I.T @ m.stream_rate])
    right = _above_rounding(right, np.concatenate([np.diag(m.at.K), np.diag(m.at.Theta_ff)]))
    given = np.concatenate([m.free.S.T @ right[:6], right[6:]])[free]
    solution = np.abs(np.concatenate([motion.u_dot, phi_ddot]))[free]
    found = np.zeros(len(free))
    found[free] = inverse_magnitude(whole) @ (given + geometric_mean(np.diag(whole)) @ solution)
    spun = right[:6] + m.S_I @ (np.abs(phi_ddot) + found[count:])
    return _motion(m, found[:count], spun + m.S_K @ np.abs(motion.V_dot)) | {"phi_ddot": found[count:]}


def _above_rounding(right: Array, inertias: Array) -> Array:
    """Scale of a right-hand side, each component at least ROUNDING of the whole, in units in which `inertias` are 1."""
    root = np.sqrt(np.abs(inertias))
    whole = length(np.divide(right, root, out=np.zeros_like(right), where=root > 0))
    return np.maximum(right, ROUNDING * whole * root)


def _motion(m: Magnitudes, u_dot: Array, right: Array) -> dict[str, Any]:
    """Scales of what belongs to those of u_dot (m) and of the right-hand side of (8) (6)."""
    return {
        "u_dot": u_dot,
        "V_dot": twist_magnitudes(m) @ u_dot,
        "reaction": right + m.S_K @ m.free.S @ u_dot,
    }


ANY = 1e30
"""Scale of what is compared with nothing."""

AT_HALF_TURN = 1e-3
"""rad, to half a turn from the home pose: rounding decides the side of an angle, or the sign of a quaternion."""


def held_generalized(m: Magnitudes) -> dict[str, Any]:
    """Scales of q, orientation, q_dot, q_ddot; of an angle by how far off its axis the carrier is turned."""
    hold, u_dot = m.stand.hold, held_forward(m)["u_dot"]
    assert hold is not None
    turns = [freedom for freedom in hold.freedoms if freedom.kind == "turn"]
    place = length(np.array(m.state.position)) + length(np.array(hold.position)) + 2 * length(np.array(hold.pivot))
    R, off, angle = attitude(m.stand.angles, *hold.angles).T @ m.at.C, 1.0, 1.0
    found: dict[str, Any] = {}
    if len(turns) == 1:
        sine, cosine = sine_and_cosine(R, unit(turns[0]))
        off = 4.0 / max(math.hypot(sine, cosine), 1e-12)
        angle = off if math.pi - abs(math.atan2(sine, cosine)) > AT_HALF_TURN else ANY
    own = [freedom for freedom in hold.freedoms if freedom.kind == "slide" or len(turns) == 1]
    if own:
        found["q"] = np.array([place if freedom.kind == "slide" else angle for freedom in own])
    if len(turns) == 3:  # the trace is 4 w^2 - 1
        found["orientation"] = np.full(4, 1.0 if 1 + np.trace(R) > AT_HALF_TURN**2 else ANY)
    arms = np.array(hold.pivot)
    sliding = [freedom.kind == "slide" for freedom in hold.freedoms]
    speed, omega = length(m.at.V[:3]) + length(arms) * length(m.at.V[3:]), length(m.at.V[3:])
    moved = reference_forward(m.at, hold, np.array(m.state.phi_ddot, dtype=np.float64))
    known = length(np.array([x for x, slides in zip(moved.u_dot, sliding, strict=True) if slides]))
    spread = length(np.array([x for x, slides in zip(u_dot, sliding, strict=True) if slides]))
    found["q_dot"] = np.array([off * speed if slides else omega for slides in sliding])
    rates = off * (known + omega * speed) + spread
    found["q_ddot"] = np.where(sliding, rates, u_dot + omega**2)  # of a turn: the axes turn, and these terms cancel
    return found


def twist_magnitudes(m: Magnitudes) -> Array:
    """Scale of S (6xm): of pivot x e the sum of its terms, since these may cancel."""
    assert m.stand.hold is not None
    found = m.free.S.copy()
    x, y, z = np.abs(np.array(m.stand.hold.pivot))
    arms = np.array([[0.0, z, y], [z, 0.0, x], [y, x, 0.0]])
    for k, freedom in enumerate(m.stand.hold.freedoms):
        if freedom.kind == "turn":
            found[:3, k] = arms @ found[3:, k]
    return found
