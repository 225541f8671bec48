"""The matrix of a trim from its definition, by the literal reference: harmonic balance along the required motion.

The stand follows the programme but for small corrections c of mean and harmonics of each flywheel. By (11), with
a, b, ... derivatives of q'' along the required motion, a change e of the angles changes the carrier's coordinates by d:

    d'' = a d + b d' + r e + n e' + m e''.

d is the trigonometric polynomial that satisfies this at uniform times of a period. Its harmonics by c are G, of which
the matrix takes back a part, the gain, at least cost: see `least_cost_matrix`.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
from scipy.spatial.transform import Rotation

from mahovik.core.motion.programme import Programme
from mahovik.core.motion.required import RequiredMotion
from mahovik.core.motion.servo import Trim
from mahovik.core.stand.model import Hold, Stand
from mahovik.core.stand.state import State, rest_state
from mahovik.errors import StateError
from mahovik.proof import reference
from mahovik.proof.reference.bodies import Bodies, bodies_of, spinning_bodies
from mahovik.proof.reference.coordinates import pose_of, rates_at
from mahovik.proof.reference.generalized import generalized
from mahovik.proof.reference.hold import held_forward
from mahovik.proof.reference.hold import twists as freedom_twists
from mahovik.proof.reference.mass import mass_matrix
from mahovik.proof.reference.rotation import attitude, kinematic_matrix
from mahovik.proof.verify.servo.law import Array

PROTECTED, WEIGHT = 2, 30.0
"""Harmonics above the corrected ones that cost, and the weight of their size in the largest effect on those."""

REACH = 1e-3
"""Part of the largest effect from which a direction of the error counts as in reach."""

DOUBT = 1e-4
"""Relative distance from REACHED below which rounding may decide."""

FREE, STILL = 1e-11, 1e-6
"""Part of the largest singular value of the balance below which a motion of the carrier is free, and the largest
harmonics of such a motion of size 1 at which the others are determined nevertheless."""

STEP = 1e-5
"""Difference of a coordinate (m, rad), and of its change in a radian of the period; central differences."""


@dataclass(frozen=True)
class Balance:
    """Linear equations at M uniform times of a period, by the phase (rad) in place of time.

    pose, speed          (M, 6, 6; held M, m, m): derivatives of q'' by q and q'
    angle, rate, change  (M, 6, N; held M, m, N): by phi, phi' and phi'' of the flywheels
    """

    pose: Array
    speed: Array
    angle: Array
    rate: Array
    change: Array


def trim_matrix(stand: Stand, motion: RequiredMotion, programme: Programme, trim: Trim) -> tuple[Array, Array]:
    """The matrix (N T, C T): correction by the error, T = 1 + 2 H terms of each flywheel and coordinate; its scale.

    Raises StateError: the reference has no answer on the way, or harmonics of the carrier are not determined.
    """
    highest = max([trim.harmonics + PROTECTED, *motion.harmonics, *(2 * abs(n) for n in programme.winding)])
    found = responses(balance(stand, motion, programme, 4 * highest + 25), trim.harmonics)
    units = _units(stand)[list(trim.coordinates)]
    measured = np.moveaxis(found[:, list(trim.coordinates)], 1, 0) / units[:, None, None]
    T, columns = 2 * trim.harmonics + 1, found.shape[-1]
    G, above = measured[:, 1:T].reshape(-1, columns), measured[:, T:].reshape(-1, columns)
    least = trim.gain * least_cost_matrix(G, above, trim.harmonics)
    matrix = np.zeros((columns, len(units), T))
    matrix[:, :, 1:] = least.reshape(columns, len(units), T - 1)
    scale = np.full(matrix.shape, np.abs(matrix).max())
    own, largest = ((each / units[:, None]).reshape(columns, -1) for each in (matrix, scale))
    return own, largest


def least_cost_matrix(G: Array, above: Array, harmonics: int) -> Array:
    """The c (N T) that has the effect e at least cost, by e: N^-1 G^T (G N^-1 G^T)^+.

    The cost c^T N c weighs each harmonic k by 1 + k^2, and the effect `above` on higher harmonics by
    (WEIGHT / |G|)^2. Directions of e that need more than (1 / REACHED)^2 of the easiest one's cost are left out.

    Raises StateError: rounding decides whether a direction is left out.
    """
    k = np.array([0, *np.repeat(np.arange(1, harmonics + 1), 2)], dtype=np.float64)
    own = np.tile(1.0 + k**2, G.shape[1] // len(k))
    heavy = (WEIGHT / np.linalg.norm(G, 2)) ** 2
    back = np.linalg.solve(np.diag(own) + heavy * above.T @ above, G.T)
    size, directions = np.linalg.eigh(G @ back)
    share = np.sqrt(np.maximum(size, 0.0) / size.max())
    if np.any(np.abs(share / REACH - 1.0) < DOUBT):
        raise StateError("a direction of the error is at the limit of reach")
    kept = share > REACH
    return np.asarray(back @ (directions[:, kept] / size[kept]) @ directions[:, kept].T)


def responses(of: Balance, harmonics: int) -> Array:
    """Harmonics (1 + 2 H.., 6, N T) of the carrier's coordinates by the corrections, mean, cos, sin, ... in turn.

    Of a held carrier m in place of 6.

    Raises StateError: a free motion of the carrier has such harmonics, so that they are not determined.
    """
    M, n, N = of.angle.shape
    T = 2 * harmonics + 1
    first, second = (_differentiation(M, order) for order in (1, 2))
    left = np.einsum("ij,kl->ikjl", second, np.eye(n)) - np.einsum("ij,ikl->ikjl", first, of.speed)
    for i in range(M):
        left[i, :, i, :] -= of.pose[i]
    phase = 2.0 * math.pi * np.arange(M) / M
    forced = np.zeros((M, n, N, T))
    for j in range(T):
        k, sine = (j + 1) // 2, j > 0 and j % 2 == 0
        wave = np.sin(k * phase) if sine else np.cos(k * phase)
        slope = k * (np.cos(k * phase) if sine else -np.sin(k * phase))
        forced[:, :, :, j] = (
            of.angle * wave[:, None, None] + of.rate * slope[:, None, None] - of.change * (k**2 * wave)[:, None, None]
        )
    U, size, Vt = np.linalg.svd(left.reshape(n * M, n * M))
    free = size < FREE * size[0]
    own = _harmonics(Vt[free].T.reshape(M, n, -1), harmonics + PROTECTED)
    if np.any(np.abs(own[1:]) > STILL):
        raise StateError("a free motion of the carrier changes the harmonics")
    kept = ~free
    d = Vt[kept].T @ ((U[:, kept].T @ forced.reshape(n * M, -1)) / size[kept][:, None])
    return _harmonics(d.reshape(M, n, -1), harmonics + PROTECTED)


def balance(stand: Stand, motion: RequiredMotion, programme: Programme, M: int) -> Balance:
    """Derivatives of q'' by (11), at M times of a period of the required motion; time in periods / 2 pi."""
    unit = motion.span / (2.0 * math.pi)
    t = motion.span * np.arange(M) / M
    course, angles, bodies = motion.at(t, programme.bias), programme.at(t), bodies_of(stand)
    found: list[list[Array]] = [[], [], [], [], []]
    for q, q_dot, phi, phi_dot, phi_ddot in zip(course.q, course.q_dot, *angles, strict=True):
        given = (q, q_dot * unit, phi, phi_dot * unit, phi_ddot * unit**2)
        for number, each in enumerate(_derivatives(stand, bodies, given, unit)):
            found[number].append(each)
    return Balance(*(np.array(each) for each in found))


def _derivatives(stand: Stand, bodies: Bodies, given: tuple[Array, ...], unit: float) -> Iterator[Array]:
    """Derivatives (6, n) of q'' by each of q, q', phi, phi', phi''."""
    for number, values in enumerate(given):
        columns = []
        for i in range(len(values)):
            ends = []
            for sign in (1, -1):
                aside = [each.copy() for each in given]
                aside[number][i] += sign * STEP
                ends.append(_acceleration(stand, bodies, aside, unit))
            columns.append((ends[0] - ends[1]) / (2.0 * STEP))
        yield np.array(columns).T


def _acceleration(stand: Stand, bodies: Bodies, given: list[Array], unit: float) -> Array:
    """q'' (6) by (11); of a held carrier (m) by its equations with multipliers."""
    q, q_dot, phi, phi_dot, phi_ddot = given
    if stand.hold is not None:
        return _held_acceleration(stand, stand.hold, bodies, given, unit)
    angles = q[3:]
    V = kinematic_matrix(stand.angles, angles) @ (q_dot / unit)
    state = replace(
        rest_state(stand), position=tuple(q[:3]), angles=tuple(angles), V=tuple(V), phi=tuple(phi),
        phi_dot=tuple(phi_dot / unit), phi_ddot=tuple(phi_ddot / unit**2),
    )  # fmt: skip
    at = reference.pieces(stand, state, bodies)
    return generalized(at, stand.angles, state).q_ddot * unit**2


def _held_acceleration(stand: Stand, hold: Hold, bodies: Bodies, given: list[Array], unit: float) -> Array:
    """q'' (m) of the freedoms' coordinates."""
    q, q_dot, phi, phi_dot, phi_ddot = given
    at = pose_of(hold, stand.angles, q, None, q_dot / unit, np.zeros(len(q)))
    u = np.asarray(np.linalg.lstsq(freedom_twists(hold), at.V, rcond=None)[0], dtype=np.float64)
    x, y, z, w = Rotation.from_matrix(at.C).as_quat()
    state = replace(
        rest_state(stand), position=tuple(at.position), quaternion=(w, x, y, z), V=tuple(at.V), u=tuple(u),
        phi=tuple(phi), phi_dot=tuple(phi_dot / unit), phi_ddot=tuple(phi_ddot / unit**2),
    )  # fmt: skip
    u_dot = held_forward(reference.pieces(stand, state, bodies), hold, phi_ddot / unit**2).u_dot
    R = attitude(stand.angles, *hold.angles).T @ at.C
    return rates_at(hold, R, u, np.asarray(u_dot, dtype=np.float64))[1] * unit**2


def _differentiation(M: int, order: int) -> Array:
    """(M, M): derivative by the phase of the trigonometric polynomial through M values, M odd."""
    k = np.fft.fftfreq(M, 1.0 / M)
    return np.asarray(np.fft.ifft((1j * k[:, None]) ** order * np.fft.fft(np.eye(M), axis=0), axis=0).real)


def _harmonics(d: Array, highest: int) -> Array:
    """Mean, cos 1, sin 1, ... (1 + 2 H, ...) of values (M, ...) at uniform times of a period."""
    found = np.fft.fft(d, axis=0) / len(d)
    parts = [found[0].real]
    for k in range(1, highest + 1):
        parts += [2.0 * found[k].real, -2.0 * found[k].imag]
    return np.array(parts)


def _units(stand: Stand) -> Array:
    """Metres and rotations (6; rad) that are worth a metre, by K of (2), mean over the flywheels' angles.

    Of a held carrier (m) what moves along each freedom with the same energy as a metre, by the mass.
    """
    bodies, rest = bodies_of(stand), rest_state(stand)
    turns = [2.0 * math.pi * j / 8 for j in range(8)]
    states: list[State] = [replace(rest, phi=(turn,) * len(stand.flywheels)) for turn in turns]
    K = np.mean([mass_matrix(bodies.fixed, spinning_bodies(bodies.mounted, each)) for each in states], axis=0)
    if stand.hold is None:
        return np.repeat([1.0, math.sqrt(K[0, 0] / (np.trace(K[3:, 3:]) / 3.0))], 3)
    return np.array([math.sqrt(K[0, 0] / (column @ K @ column)) for column in freedom_twists(stand.hold).T])
