"""Changes of results where one flywheel is exchanged for another on the same axis.

What a flywheel adds to (2)-(9) is linear in its Theta and P. So the difference of two flywheels at one state is what
a flywheel adds whose Theta and P are the differences of theirs: the other bodies are not looked at again, and nothing
cancels.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from mahovik.core.stand.model import Flywheel
from mahovik.core.stand.state import State
from mahovik.proof.reference.array import Array, solve_symmetric
from mahovik.proof.reference.assembly import body_wrenches, run_time_wrench
from mahovik.proof.reference.bodies import Bodies, PlacedBody, spatial_inertia
from mahovik.proof.reference.motion import mounts_on_flywheels
from mahovik.proof.reference.pieces import (
    Pieces,
    body_wrench,
    coupling,
    coupling_bias,
    mass_matrix,
    mass_matrix_rate,
    velocity_matrix,
)
from mahovik.proof.reference.rotation import C1
from mahovik.proof.reference.screw import block_diagonal


@dataclass(frozen=True, eq=False)
class Exchange:
    """Another flywheel in the place of one.

    number  of the flywheel
    body    the other
    Theta   6x6, the other's about its origin, less the flywheel's
    """

    number: int
    body: Flywheel
    Theta: Array

    @classmethod
    def of(cls, number: int, flywheel: Flywheel, other: Flywheel) -> Exchange:
        """The exchange of a flywheel for `other`, which has the same mount, axis and zero."""
        return cls(number, other, spatial_inertia(other) - spatial_inertia(flywheel))

    def changes(self, at: Pieces, state: State, V_dot: Array) -> Mapping[str, Array]:
        """Changes of V_dot (6), Z (6) and of the flywheel's own mount_wrench (6), by want.

        `V_dot`: (6) of `forward` before.
        """
        s, phi_ddot = at.flywheels[self.number], state.phi_ddot[self.number]
        speed = np.array([s.phi_dot])
        d = Bodies((self.body,), s.L[None], self.Theta[None], s.Lambda[None], np.array([s.phi]), speed)
        P = self._wrench(at, state, s)
        K, I = mass_matrix(d), coupling(d)[:, 0]
        M, J = velocity_matrix(K, mass_matrix_rate(d), at.V_r), coupling_bias(d, at.V_r)[:, 0]
        # (K + dK) (V* + dV*) = right + d right, where K V* = right
        right = s.L @ P - M @ at.V_r - J * s.phi_dot - I * phi_ddot - K @ at.V_r_dot(V_dot)
        mount = mounts_on_flywheels(d, P, at.V, np.array(state.V_dot), np.array([phi_ddot]))[0]
        return {
            "forward": solve_symmetric(at.K + K, right),
            "momentum": K @ at.V + I * s.phi_dot,
            "mounts": block_diagonal(C1(s.phi)) @ mount,
        }

    def _wrench(self, at: Pieces, state: State, s: PlacedBody) -> Array:
        """The other's P of (7), in its frame about its origin, less the flywheel's."""
        kinds = body_wrenches(self.body, s.L[:3, :3].T @ at.gravity, s.twist(at.V_r), run_time_wrench(state, self.body))
        return body_wrench(kinds) - at.P[s.body.name]
