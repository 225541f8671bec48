"""Rotations, transfers, inertias of 6-vectors (linear; angular), for constants of a stand and for M times at once."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from mahovik.core.stand.model import Body, Flywheel, MountingAngles, Sequence, Stand, Vec3

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]

AXES: dict[Sequence, tuple[int, int, int]] = {"ship": (2, 1, 0), "aircraft": (1, 2, 0), "euler": (2, 0, 2)}
"""Axes (0..2) that psi, theta, phi turn about, first to last."""

SMALL = 1e-2
"""rad: below it a series is more exact."""


def turn(axis: int, angle: Array | float) -> Array:
    """Active elementary rotations (..., 3, 3) about an axis, by angles (...) in rad."""
    c, s = np.cos(angle), np.sin(angle)
    C = np.zeros((*np.shape(angle), 3, 3))
    i, j = (axis + 1) % 3, (axis + 2) % 3
    C[..., axis, axis] = 1.0
    C[..., i, i] = C[..., j, j] = c
    C[..., i, j], C[..., j, i] = -s, s
    return C


def attitude(sequence: Sequence, angles: Array) -> Array:
    """C (..., 3, 3) of psi, theta, phi (..., 3; rad) in the stand's sequence."""
    a, b, c = AXES[sequence]
    return np.asarray(turn(a, angles[..., 0]) @ turn(b, angles[..., 1]) @ turn(c, angles[..., 2]))


def skew(a: Array) -> Array:
    """<a> (..., 3, 3) of a (..., 3): <a> b = a x b."""
    S = np.zeros((*a.shape, 3))
    S[..., 0, 1], S[..., 0, 2], S[..., 1, 2] = -a[..., 2], a[..., 1], -a[..., 0]
    S[..., 1, 0], S[..., 2, 0], S[..., 2, 1] = a[..., 2], -a[..., 1], a[..., 0]
    return S


def motor_cross(V: Array) -> Array:
    """Phi(V) (..., 6, 6) of V = (v, omega) (..., 6): [[<omega>, 0], [<v>, <omega>]], (4)."""
    P = np.zeros((*V.shape, 6))
    P[..., :3, :3] = P[..., 3:, 3:] = skew(V[..., 3:])
    P[..., 3:, :3] = skew(V[..., :3])
    return P


def block_diagonal(C: Array) -> Array:
    """diag(C, C) (..., 6, 6) of C (..., 3, 3)."""
    D = np.zeros((*C.shape[:-2], 6, 6))
    D[..., :3, :3] = D[..., 3:, 3:] = C
    return D


def transfer(O: Vec3 | Array, C: Array) -> Array:
    """L (6, 6) of a child frame at O (3, m) with axes C (3, 3): wrenches child to parent; L^T twists to the child."""
    L = block_diagonal(C)
    L[3:, :3] = skew(np.asarray(O, dtype=np.float64)) @ C
    return L


def place(L: Array) -> Array:
    """O (3, m) of a transfer [[C, 0], [<O> C, C]]."""
    S = L[3:, :3] @ L[:3, :3].T
    return np.array([S[2, 1], S[0, 2], S[1, 0]])


def fixed_axes(angles: Vec3) -> Array:
    """C (3, 3) of an instrument: C3(psi) C2(theta) C1(phi), whatever the carrier's sequence."""
    return attitude("ship", np.array(angles))


def mount_axes(flywheel: Flywheel) -> Array:
    """C (3, 3) of a flywheel at phi_s = 0 in its mount: first axis is the spin axis."""
    mounting = flywheel.mounting
    if isinstance(mounting, MountingAngles):
        return fixed_axes((mounting.psi, mounting.theta, mounting.zero))
    first = np.array(mounting.axis) / np.linalg.norm(mounting.axis)
    across = np.array(mounting.zero) - first * (first @ np.array(mounting.zero))
    second = across / np.linalg.norm(across)
    return np.stack([first, second, np.cross(first, second)], axis=1)


def flywheel_transfer(stand: Stand, flywheel: Flywheel) -> Array:
    """Lm (6, 6) of a flywheel at phi_s = 0 to E1; it does not turn. Through its instrument, where one bears it."""
    own = transfer(flywheel.position, mount_axes(flywheel))
    for instrument in stand.instruments:
        if instrument.name == flywheel.mount:
            return np.asarray(transfer(instrument.position, fixed_axes(instrument.angles)) @ own)
    return own


def first_moment(body: Body) -> Array:
    """mu = m r_c (3, kg m) in the body's frame, about its origin."""
    return body.mass * np.array(body.center_of_mass)


def inertia(body: Body) -> Array:
    """Theta (6, 6; kg, kg m, kg m2) about the origin of the body's frame."""
    mu = skew(first_moment(body))
    J = np.array(body.inertia)
    if body.inertia_about != "origin":
        J = J - mu @ skew(np.array(body.center_of_mass))
    return spatial_inertia(np.array(body.mass), first_moment(body), J)


def spatial_inertia(mass: Array, moment: Array, J: Array) -> Array:
    """[[m E, -<mu>], [<mu>, J]] (..., 6, 6) of mass (...), first moment (..., 3), inertia at the origin (..., 3, 3)."""
    mu = skew(moment)
    Theta = np.zeros((*mass.shape, 6, 6))
    Theta[..., :3, :3] = mass[..., None, None] * np.eye(3)
    Theta[..., :3, 3:], Theta[..., 3:, :3], Theta[..., 3:, 3:] = -mu, mu, J
    return Theta


def gravity_wrench_matrix(mass: Array | float, moment: Array) -> Array:
    """Matrix (..., 6, 3) that makes a wrench of gravity: (mass g; moment x g), `moment` (..., 3; kg m)."""
    H = np.zeros((*np.shape(mass), 6, 3))
    H[..., :3, :], H[..., 3:, :] = np.asarray(mass)[..., None, None] * np.eye(3), skew(moment)
    return H


def net_weight(body: Body) -> tuple[float, Array]:
    """What gravity acts on: mass (kg) and first moment (3, kg m) in its frame, less those of the displaced fluid."""
    moment = sum((mass * np.array(center) for mass, center in body.displaced), np.zeros(3))
    return body.mass - sum(mass for mass, _ in body.displaced), first_moment(body) - moment


def rotation_vector_rate(r: Array) -> Array:
    """B (M, 3, 3): r' = B omega of a rotation vector r (M, 3), omega on the turned axes."""
    angle = np.linalg.norm(r, axis=1)[:, None, None]
    with np.errstate(divide="ignore", invalid="ignore"):
        k = (1.0 - angle / 2.0 / np.tan(angle / 2.0)) / angle**2
    k = np.where(angle < SMALL, 1.0 / 12.0 + angle**2 / 720.0 + angle**4 / 30240.0, k)
    turned = skew(r)
    return np.asarray(np.eye(3) + 0.5 * turned + k * (turned @ turned))
