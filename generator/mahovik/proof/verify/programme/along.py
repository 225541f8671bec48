"""States of a stand along a motion and a programme, and the reference's pieces there: one state at a time."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache
from typing import cast

from mahovik.core.motion.programme import Angles
from mahovik.core.motion.required import Course
from mahovik.core.stand.model import Stand, Vec3, Vec6
from mahovik.core.stand.state import State
from mahovik.proof import reference
from mahovik.proof.reference import Pieces
from mahovik.proof.reference.array import Array
from mahovik.proof.reference.bodies import Bodies, bodies_of
from mahovik.proof.reference.inverse import demand
from mahovik.proof.reference.rotation import kinematic_matrix, kinematic_matrix_rate
from mahovik.proof.reference.torque import torque


def pieces_at(stand: Stand, q: Array, V: Array, phi: Array, phi_dot: Array) -> Pieces:
    """Pieces of (1)-(11) at q (6; m, rad), V (6), phi, phi' (N)."""
    zeros = (0.0,) * len(phi)
    state = State(
        position=cast(Vec3, tuple(q[:3].tolist())),
        angles=cast(Vec3, tuple(q[3:].tolist())),
        quaternion=None,
        V=cast(Vec6, tuple(V.tolist())),
        phi=tuple(phi.tolist()),
        phi_dot=tuple(phi_dot.tolist()),
        phi_ddot=zeros,
        V_dot=(0.0,) * 6,
        tau=zeros,
    )
    return reference.pieces(stand, state, _bodies(stand))


@lru_cache(maxsize=4)
def _bodies(stand: Stand) -> Bodies:
    """Bodies of a stand, made once for the thousands of its states."""
    return bodies_of(stand)


def twist(stand: Stand, q: Array, q_dot: Array) -> Array:
    """V = A q' (6) of (10)."""
    return kinematic_matrix(stand.angles, q[3:]) @ q_dot


def twist_rate(stand: Stand, q: Array, q_dot: Array, q_ddot: Array) -> Array:
    """V* = A q'' + D q' (6) of (10)."""
    D = kinematic_matrix_rate(stand.angles, q[3:], q_dot[3:])
    return kinematic_matrix(stand.angles, q[3:]) @ q_ddot + D @ q_dot


@dataclass(frozen=True, eq=False)
class Instant:
    """The pieces at one time of the prescribed motion, with V* (6) and phi'' (N)."""

    at: Pieces
    V_dot: Array
    phi_ddot: Array

    def residual(self) -> Array:
        """F - K V_r* - M V_r - J phi' - I phi'' (6; N, N m) of (12)."""
        return demand(self.at, self.V_dot) - self.at.I @ self.phi_ddot

    def torque(self) -> Array:
        """tau (N, N m)."""
        return torque(self.at, self.V_dot, self.phi_ddot)


def instants(stand: Stand, course: Course, angles: Angles) -> Iterator[Instant]:
    """One Instant a row of the course and of the angles."""
    for q, q_dot, q_ddot, phi, phi_dot, phi_ddot in zip(*course, *angles, strict=True):
        at = pieces_at(stand, q, twist(stand, q, q_dot), phi, phi_dot)
        yield Instant(at, twist_rate(stand, q, q_dot, q_ddot), phi_ddot)
