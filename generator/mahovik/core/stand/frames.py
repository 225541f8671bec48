"""Placement of bodies in the frames of their mounts; code of its own, shared with no derivation."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from mahovik.core.stand.model import Body, Flywheel, Instrument, MountingAngles, Stand

Array = NDArray[np.float64]


def mount_of(stand: Stand, body: Instrument | Flywheel) -> Instrument | None:
    """The instrument that a flywheel stands on; None for what stands on the carrier."""
    if isinstance(body, Instrument):
        return None
    return next((instrument for instrument in stand.instruments if instrument.name == body.mount), None)


def placement(body: Instrument | Flywheel) -> tuple[Array, Array]:
    """Origin of a body in the frame of its mount, m, and its axes there as columns (a flywheel's at phi_s = 0)."""
    position = np.array(body.position)
    if isinstance(body, Flywheel):
        return position, _axes(body)
    psi, theta, phi = body.angles
    return position, turn(2, psi) @ turn(1, theta) @ turn(0, phi)


def pose(stand: Stand, body: Body) -> tuple[Array, Array]:
    """Origin of a body in E1, m, and its axes there as columns; flywheels at phase zero."""
    if not isinstance(body, Instrument | Flywheel):
        return np.zeros(3), np.eye(3)
    origin, C = placement(body)
    mount = mount_of(stand, body)
    if mount is not None:
        below, axes = placement(mount)
        origin, C = below + axes @ origin, axes @ C
    return origin, C


def transfer(position: Array, C: Array) -> Array:
    """Transfer of wrenches (6, 6) from a frame with that origin, m, and axes C (columns) to its mount's frame."""
    return blocks(C, np.zeros((3, 3)), cross(position) @ C, C)


def blocks(A: Array, B: Array, C: Array, D: Array) -> Array:
    """[[A, B], [C, D]] (6, 6) of four 3x3. As np.block, which takes ten times as long."""
    found: Array = np.empty((6, 6))
    found[:3, :3], found[:3, 3:], found[3:, :3], found[3:, 3:] = A, B, C, D
    return found


def _axes(flywheel: Flywheel) -> Array:
    """Axes of Es at phi_s = 0 in the mount's frame, as columns."""
    mounting = flywheel.mounting
    if isinstance(mounting, MountingAngles):
        return turn(2, mounting.psi) @ turn(1, mounting.theta) @ turn(0, mounting.zero)
    axis, zero = (np.array(v) / np.abs(v).max() for v in (mounting.axis, mounting.zero))
    axis /= np.linalg.norm(axis)
    second = zero - axis * (axis @ zero)
    second /= np.linalg.norm(second)
    return np.array([axis, second, cross(axis) @ second]).T


def turn(axis: int, angle: float) -> Array:
    """Active elementary rotation C1, C2, C3 (axis 0, 1, 2)."""
    c, s = np.cos(angle), np.sin(angle)
    j, k = (axis + 1) % 3, (axis + 2) % 3
    C = np.eye(3)
    C[j, j] = C[k, k] = c
    C[k, j], C[j, k] = s, -s
    return C


def cross(a: Array) -> Array:
    """Cross-product matrix: cross(a) @ b is a x b."""
    return np.array([[0.0, -a[2], a[1]], [a[2], 0.0, -a[0]], [-a[1], a[0], 0.0]])
