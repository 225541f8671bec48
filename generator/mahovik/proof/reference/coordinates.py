"""Generalized coordinates: of a free carrier (10)-(11), q = (O1 in E0, psi, theta, phi); of a held one its freedoms'.

Those of freedoms are zero in the home pose. The pivot P of E1 is at O1 + C P; w is its way from the home pose in the
axes of that pose. R = C0^T C is the turn from there. V = S u gives the pivot the velocity C s, s = sum of u_k d_k over
what slides, so w' = R s and w'' = R (s* + omega x s). The turn about one axis has an angle, with R that of this angle;
three turns have no angles but R itself, as a quaternion, and as rates omega and omega*.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from mahovik.core.stand.model import Freedom, Hold, Sequence, Stand, State
from mahovik.errors import StateError
from mahovik.proof.reference.algebra import (
    AXES,
    ELEMENTARY,
    Array,
    E,
    Pose,
    T,
    Values,
    about,
    arctan2,
    attitude,
    blocks,
    carrier_rotation,
    cos,
    cross,
    quaternion_of,
    quaternion_rotation,
    sin,
    skew_part,
    solve,
    stack,
    unit,
    vector,
    zero,
)
from mahovik.proof.reference.motion import answer_forward
from mahovik.proof.reference.pieces import Pieces, velocity_matrix

SINGULAR = 1e-6
"""|cos theta| (Euler: |sin theta|) below this is an error of `generalized`."""


def angle_rates_to_omega(sequence: Sequence, angles: Array, rates: Array) -> tuple[Array, Array]:
    """B (3x3) of (10): omega = B (psi', theta', phi'), omega in E1; and B' (1/s) along the motion.

    Each rate turns about its own axis, carried to E1 by the rotations that come after it in the sequence, whose rates
    are R' = R <axis> angle'. `angles`, `rates` (3; rad, rad/s): psi, theta, phi; psi is not in B.
    """
    a, b, c = (E[axis] for axis in AXES[sequence])
    _, Rb, Rc = (ELEMENTARY[axis](angle) for axis, angle in zip(AXES[sequence], angles, strict=True))
    Rb_dot, Rc_dot = Rb @ cross(b) * rates[1], Rc @ cross(c) * rates[2]
    B = stack([Rc.T @ Rb.T @ a, Rc.T @ b, c], 3).T
    return B, stack([Rc_dot.T @ Rb.T @ a + Rc.T @ Rb_dot.T @ a, Rc_dot.T @ b, zero[0]], 3).T


def kinematic_matrix(sequence: Sequence, angles: Array) -> Array:
    """A = diag(C^T, B) (6x6) of (10): V = A q', q = (O1 in E0, psi, theta, phi)."""
    return blocks(attitude(sequence, *angles).T, zero, zero, angle_rates_to_omega(sequence, angles, zero[0])[0])


def kinematic_matrix_rate(sequence: Sequence, angles: Array, rates: Array) -> Array:
    """D = A' (6x6, 1/s) of (10) along the motion; `rates` (3, rad/s): psi', theta', phi'. C' = C <omega>."""
    B, B_dot = angle_rates_to_omega(sequence, angles, rates)
    C_dot = attitude(sequence, *angles) @ cross(B @ rates)
    return blocks(C_dot.T, zero, zero, B_dot)


def check_attitude(sequence: Sequence, angles: Array) -> None:
    """Raise StateError where A of (10) is singular, or so near to it that q' means nothing."""
    name, value = ("sin", sin(angles[1])) if sequence == "euler" else ("cos", cos(angles[1]))
    if abs(value) < SINGULAR:
        raise StateError(
            f"angles: singular attitude of the {sequence} sequence, |{name} theta| = {abs(value):.3g}; "
            f"`generalized` needs at least {SINGULAR:g}"
        )


def _answer_free(at: Pieces, stand: Stand, state: State) -> Values:
    """A, D of (10), I0, J0 of (11) at V (6x6), q_dot and q_ddot (6; m, rad, s).

    (10): V = A q', D = A'. (11): I0 q'' + J0 q' + I phi'' + J phi' = F, I0 = K A, J0 = K D + M A. StateError for a
    quaternion, or where A is singular.
    """
    if state.quaternion is not None:
        raise StateError("`generalized` needs `angles`, but the state has `quaternion`")
    angles = vector(state.angles or (0.0, 0.0, 0.0))
    check_attitude(stand.angles, angles)
    A = kinematic_matrix(stand.angles, angles)
    q_dot = solve(A, at.V)
    D = kinematic_matrix_rate(stand.angles, angles, q_dot[3:])
    I0, J0 = at.K @ A, at.K @ D + velocity_matrix(at.K, at.K_dot, at.V) @ A
    q_ddot = solve(I0, at.F - at.K @ D @ q_dot - at.bias - at.I @ vector(state.phi_ddot))
    return {"A": A, "D": D, "I0": I0, "J0": J0, "q_dot": q_dot, "q_ddot": q_ddot}


# Coordinates of freedoms.


@dataclass(frozen=True, eq=False)
class Coordinates:
    """Coordinates at a pose, and what turns there.

    q            ways (m) and an angle (rad) of the freedoms that have one, in their order
    orientation  quaternion (4), w first and not negative, of what turns about a point; else None
    R            3x3: turn from the home pose, of one axis by the angle
    """

    q: Array
    orientation: Array | None
    R: Array


def coordinates_at(stand: Stand, state: State) -> Coordinates:
    """Coordinates of a held carrier; what its pose is off the hold is left out. StateError: it has no coordinates."""
    hold = stand.hold
    assert hold is not None
    check_coordinates(hold)
    turns = _of_kind(hold, "turn")
    at = Pose(vector(state.position), carrier_rotation(stand, state), vector(state.V))
    numbered = [freedom for freedom in hold.freedoms if freedom.kind == "slide" or len(turns) == 1]
    q = vector([coordinate(hold, freedom, stand.angles, at) for freedom in numbered])
    R = attitude(stand.angles, *hold.angles).T @ at.C if turns else E
    if len(turns) == 1:
        R = about(unit(hold.freedoms[turns[0]]))(coordinate(hold, hold.freedoms[turns[0]], stand.angles, at))
    return Coordinates(q, quaternion_of(R) if len(turns) == 3 else None, R)


def rates_at(hold: Hold, R: Array, u: Array, u_dot: Array) -> tuple[Array, Array]:
    """q_dot and q_ddot (m each; m, rad, s) of u and u_dot, R being the turn from the home pose."""
    slides = _of_kind(hold, "slide")
    s, s_dot, omega = _sum(hold, "slide", u), _sum(hold, "slide", u_dot), _sum(hold, "turn", u)
    q_dot, q_ddot = u.copy(), u_dot.copy()
    for k in slides:
        q_dot[k] = unit(hold.freedoms[k]) @ R @ s
        q_ddot[k] = unit(hold.freedoms[k]) @ R @ (s_dot + cross(omega) @ s)
    return q_dot, q_ddot


@dataclass(frozen=True, eq=False)
class HeldPose:
    """Where coordinates and their rates put a carrier: O1 (3) in E0, attitude C (3x3), V and V* (6) in E1."""

    position: Array
    C: Array
    V: Array
    V_dot: Array


def pose_of(
    hold: Hold, sequence: Sequence, q: Array, orientation: Array | None, q_dot: Array, q_ddot: Array
) -> HeldPose:
    """C = C0 R, O1 + C P = O1_home + C0 (P + w); V = S u, V* = S u*: s = R^T w', s* = R^T w'' - omega x s.

    `orientation`: quaternion (4) of R of what turns about a point, else None. StateError: no coordinates.
    """
    check_coordinates(hold)
    slides = _of_kind(hold, "slide")
    C0, P, w, R, numbers = attitude(sequence, *hold.angles), vector(hold.pivot), np.zeros(3), np.eye(3), iter(q)
    for k, freedom in enumerate(hold.freedoms):
        if k in slides:
            w = w + next(numbers) * unit(freedom)
        elif orientation is None:
            R = about(unit(freedom))(next(numbers))
    R = R if orientation is None else quaternion_rotation(*orientation)
    omega, s = _sum(hold, "turn", q_dot), R.T @ _sum(hold, "slide", q_dot)
    s_dot = R.T @ _sum(hold, "slide", q_ddot) - cross(omega) @ s
    to_O1 = T(-P).T  # of the twist of the frame at the pivot
    V, V_dot = to_O1 @ np.concatenate([s, omega]), to_O1 @ np.concatenate([s_dot, _sum(hold, "turn", q_ddot)])
    return HeldPose(vector(hold.position) + C0 @ (P + w) - C0 @ R @ P, C0 @ R, V, V_dot)


def check_coordinates(hold: Hold) -> None:
    """StateError where the freedoms have no coordinates: their twists are not closed, or given as a basis."""
    slides, turns = ([unit(hold.freedoms[k]) for k in _of_kind(hold, kind)] for kind in ("slide", "turn"))
    plain = hold.freedoms and len(slides) + len(turns) == len(hold.freedoms)
    turned = [cross(axis) @ d for axis in turns for d in slides]
    rank = np.linalg.matrix_rank(np.array(slides), 1e-9) if slides else 0
    stays = not turned or np.linalg.matrix_rank(np.array([*slides, *turned]), 1e-9) == rank
    if not (plain and stays and len(turns) != 2):
        lacks = "the freedoms of [hold] have no coordinates" if hold.freedoms else "the carrier is clamped"
        raise StateError(f"generalized: {lacks}, expected a closed set by name")


def coordinate(hold: Hold, freedom: Freedom, sequence: Sequence, at: Pose) -> Any:
    """Way of the pivot from the home pose (m), or angle of turning about the axis from it (rad, within half a turn)."""
    C0, d = attitude(sequence, *hold.angles), unit(freedom)
    if freedom.kind == "slide":
        pivot = vector(hold.pivot)
        gone = at.O1 + at.C @ pivot - (vector(hold.position) + C0 @ pivot)
        return (C0 @ d) @ gone
    return arctan2(*sine_and_cosine(C0.T @ at.C, d))


def sine_and_cosine(R: Array, a: Array) -> tuple[Any, Any]:
    """Sine and cosine of the angle about a, times one factor: by the skew part of R, and by its part across a."""
    return a @ skew_part(R) / 2, np.trace((E - np.outer(a, a)) @ R) / 2


def _sum(hold: Hold, kind: str, rates: Array) -> Array:
    """Rates along the directions of what slides, or about those of what turns (3)."""
    return np.asarray(sum((rates[k] * unit(hold.freedoms[k]) for k in _of_kind(hold, kind)), np.zeros(3)))


def _of_kind(hold: Hold, kind: str) -> list[int]:
    return [k for k, freedom in enumerate(hold.freedoms) if freedom.kind == kind]


def _answer_held(at: Pieces, stand: Stand, state: State) -> Values:
    """q, orientation of what has them, q_dot, q_ddot (m; m, rad, s). StateError: no coordinates."""
    assert stand.hold is not None
    pose = coordinates_at(stand, state)
    u_dot = answer_forward(at, stand, state)["u_dot"]
    q_dot, q_ddot = rates_at(stand.hold, pose.R, vector(state.u), u_dot)
    values = {"q": pose.q, "orientation": pose.orientation, "q_dot": q_dot, "q_ddot": q_ddot}
    return {name: value for name, value in values.items() if value is not None and (name != "q" or len(value))}


def answer_generalized(at: Pieces, stand: Stand, state: State) -> Values:
    """The equations in generalized coordinates. StateError: no coordinates, or a singular attitude."""
    return (_answer_free if stand.hold is None else _answer_held)(at, stand, state)
