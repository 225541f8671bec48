"""Points: pose, twist and what an accelerometer reads, at every instrument and named point."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from mahovik.core.stand.model import Stand
from mahovik.core.stand.state import State
from mahovik.proof.reference.array import Array, Values, vector
from mahovik.proof.reference.bodies import instrument_transfer, mount_transfer
from mahovik.proof.reference.pieces import Pieces
from mahovik.proof.reference.rotation import fixed_rotation
from mahovik.proof.reference.screw import cross, wrench_to_parent


def point_transfers(stand: Stand) -> Iterator[tuple[str, Array]]:
    """Name and L (6x6) to E1 about O1 of every instrument, then of every point, in the file's order."""
    for instrument in stand.instruments:
        yield instrument.name, instrument_transfer(instrument)
    for point in stand.points:
        in_mount = wrench_to_parent(vector(point.position), fixed_rotation(*point.angles))
        yield point.name, mount_transfer(stand, point.mount) @ in_mount


def point_values(at: Pieces, L: Array, V_dot: Array) -> dict[str, Array]:
    """Values of one frame fixed on the carrier, L (6x6) its transfer to E1; V_dot (6) of the carrier.

    position (3, m, E0); C (3x3, own axes to E0); in own axes: twist (6, relative to E0), specific_force (3, m/s2,
    acceleration less gravity), angular_acceleration (3, rad/s2).
    """
    to_E0 = at.L1 @ L
    C = to_E0[:3, :3]
    O_cross = to_E0[3:, :3] @ C.T  # <O> of L = T [C]
    V_p, V_p_dot = L.T @ at.V, L.T @ V_dot
    v, omega = V_p[:3], V_p[3:]
    return {
        "position": np.array([O_cross[2, 1], O_cross[0, 2], O_cross[1, 0]]),
        "C": C,
        "twist": V_p,
        "specific_force": V_p_dot[:3] + cross(omega) @ v - L[:3, :3].T @ at.gravity,
        "angular_acceleration": V_p_dot[3:],
    }


def points(at: Pieces, stand: Stand, V_dot: Array) -> dict[str, dict[str, Array]]:
    """Values of every instrument and point by name."""
    return {name: point_values(at, L, V_dot) for name, L in point_transfers(stand)}


def answer(at: Pieces, stand: Stand, state: State) -> Values:
    """Values of every instrument and point by name."""
    return {"points": points(at, stand, vector(state.V_dot))}
