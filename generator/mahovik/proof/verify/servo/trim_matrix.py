"""The matrix of a trim from its definition, by the literal reference: harmonic balance along the required motion.

The stand follows the programme but for small corrections c of mean and harmonics of each flywheel. By (8), with
a, b, ... derivatives of q'' along the required motion, a change e of the angles changes the carrier's coordinates by d:

    d'' = a d + b d' + r e + n e' + m e''.

d is the trigonometric polynomial that satisfies this at uniform times of a period. Its harmonics by c are G, of which
the matrix takes back a part, the gain, at least cost: see `least_cost_matrix`.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

import numpy as np

from mahovik.core.motion.programme import Programme
from mahovik.core.motion.required import RequiredMotion
from mahovik.core.motion.servo import Trim
from mahovik.core.stand.model import Stand
from mahovik.errors import StateError
from mahovik.proof.reference.array import Array
from mahovik.proof.reference.screw import twists
from mahovik.proof.verify.programme.mechanics import free_acceleration, moment
from mahovik.proof.verify.servo.law import coefficients, waves

PROTECTED, WEIGHT = 2, 30.0
"""Harmonics above the corrected ones that cost, and the weight of their size in the largest effect on those."""

REACH = 1e-3
"""Part of the largest effect from which a direction of the error counts as in reach."""

DOUBT = 1e-4
"""Relative distance from REACH below which rounding may decide."""

FREE, STILL = 1e-11, 1e-6
"""Part of the largest singular value of the balance below which a motion of the carrier is free, and the largest
harmonics of such a motion of size 1 at which the others are determined nevertheless."""

STEP = 1e-5
"""Difference of a coordinate (m, rad), and of its change in a radian of the period; central differences."""


def trim_matrix(stand: Stand, motion: RequiredMotion, programme: Programme, trim: Trim) -> tuple[Array, Array]:
    """The matrix (N T, C T): correction by the error, T = 1 + 2 H terms of each flywheel and coordinate; its scale.

    Raises StateError: the reference has no answer on the way, or harmonics of the carrier are not determined.
    """
    highest = max([trim.harmonics + PROTECTED, *motion.harmonics, *(2 * abs(n) for n in programme.winding)])
    M, radian = 4 * highest + 25, motion.span / (2.0 * math.pi)
    t = motion.span * np.arange(M) / M
    effect = responses(slopes(stand, motion, programme, t, range(5), lambda _: STEP, radian), trim.harmonics)
    units = _units(stand)[list(trim.coordinates)]
    measured = np.moveaxis(effect[:, list(trim.coordinates)], 1, 0) / units[:, None, None]
    T, columns = 2 * trim.harmonics + 1, effect.shape[-1]
    G, above = measured[:, 1:T].reshape(-1, columns), measured[:, T:].reshape(-1, columns)
    matrix = np.zeros((columns, len(units), T))
    matrix[:, :, 1:] = (trim.gain * least_cost_matrix(G, above, trim.harmonics)).reshape(columns, len(units), T - 1)
    scale = np.full(matrix.shape, np.abs(matrix).max())
    return tuple((each / units[:, None]).reshape(columns, -1) for each in (matrix, scale))  # type: ignore[return-value]


def least_cost_matrix(G: Array, above: Array, harmonics: int) -> Array:
    """The c (N T) that has the effect e at least cost, by e: N^-1 G^T (G N^-1 G^T)^+.

    The cost c^T N c weighs each harmonic k by 1 + k^2, and the effect `above` on higher harmonics by
    (WEIGHT / |G|)^2. Directions of e that need more than (1 / REACH)^2 of the easiest one's cost are left out.

    Raises StateError: rounding decides whether a direction is left out.
    """
    k = np.array([0, *np.repeat(np.arange(1, harmonics + 1), 2)], dtype=np.float64)
    cost = np.diag(np.tile(1.0 + k**2, G.shape[1] // len(k)))
    cost += (WEIGHT / np.linalg.norm(G, 2)) ** 2 * above.T @ above
    back = np.linalg.solve(cost, G.T)
    size, directions = np.linalg.eigh(G @ back)
    share = np.sqrt(np.maximum(size, 0.0) / size.max())
    if np.any(np.abs(share / REACH - 1.0) < DOUBT):
        raise StateError("a direction of the error is at the limit of reach")
    kept = share > REACH
    return np.asarray(back @ (directions[:, kept] / size[kept]) @ directions[:, kept].T)


def responses(of: Sequence[Array], harmonics: int) -> Array:
    """Harmonics (1 + 2 H.., m, N T) of the carrier's coordinates by the corrections, mean, cos, sin, ... in turn.

    `of`: `slopes` by all five at M uniform times, M odd, a radian of the period as the unit. Raises StateError: a free
    motion of the carrier has such harmonics, so that they are not determined.
    """
    from scipy.linalg import block_diag

    M, m, _ = of[2].shape
    k, phase, highest = np.fft.fftfreq(M, 1.0 / M), np.arange(M) / M, harmonics + PROTECTED
    # of the trigonometric polynomial through M values: the values, its derivatives by the phase
    values, first, second = (
        np.fft.ifft((1j * k[:, None]) ** n * np.fft.fft(np.eye(M), axis=0), axis=0).real for n in range(3)
    )
    pose, speed = (block_diag(*part) for part in of[:2])
    left = np.kron(second, np.eye(m)) - speed @ np.kron(first, np.eye(m)) - pose
    waved = waves(phase, harmonics).T
    forced = sum(
        np.einsum("ikl,ij->iklj", part, order @ waved)
        for part, order in zip(of[2:], (values, first, second), strict=True)
    )
    U, size, Vt = np.linalg.svd(left)
    kept = size >= FREE * size[0]
    free = coefficients(Vt[~kept].T.reshape(M, m, -1), phase, highest)
    if np.any(np.abs(free[1:]) > STILL):
        raise StateError("a free motion of the carrier changes the harmonics")
    d = Vt[kept].T @ ((U[:, kept].T @ np.reshape(forced, (m * M, -1))) / size[kept][:, None])
    return coefficients(d.reshape(M, m, -1), phase, highest)


def _slope(function: Callable[..., Array], given: Sequence[Array], number: int, step: Array | float) -> Array:
    """Derivatives (K, n) of a function (K) by its argument of this number (n), by central differences of `step`."""
    columns = []
    for way in np.eye(len(given[number])) * step:
        ends = [function(*given[:number], given[number] + aside, *given[number + 1 :]) for aside in (way, -way)]
        columns.append((ends[0] - ends[1]) / (2 * np.abs(way).max()))
    return np.array(columns).T


def slopes(
    stand: Stand, motion: RequiredMotion, programme: Programme, t: Array, numbers: Sequence[int],
    step: Callable[[Array], Array | float], unit: float = 1.0,
) -> list[Array]:  # fmt: skip
    """Derivatives (M, m, n) of q'' by those of q, q', phi, phi', phi'' with these numbers, at times t (M, s) along the
    required motion. `unit` (s): of time in them; `step`: of a difference, by what is changed.
    """
    powers = (0, 1, 0, 1, 2)

    def acceleration(*scaled: Array) -> Array:
        return unit**2 * free_acceleration(stand, *(x / unit**n for x, n in zip(scaled, powers, strict=True)))

    course, rows = motion.at(t, programme.bias), []
    for values in zip(course.q, course.q_dot, *programme.at(t), strict=True):
        scaled = [x * unit**n for x, n in zip(values, powers, strict=True)]
        rows.append([_slope(acceleration, scaled, k, step(scaled[k])) for k in numbers])
    return [np.array(column) for column in zip(*rows, strict=True)]


def _units(stand: Stand) -> Array:
    """Metres and rotations (6; rad) that are worth a metre, by K of (2), mean over the flywheels' angles.

    Of a held carrier (m) what moves along each freedom with the same energy as a metre, by the mass.
    """
    m, N = 6 if stand.hold is None else len(stand.hold.freedoms), len(stand.flywheels)
    turns = [np.full(N, 2.0 * math.pi * j / 8) for j in range(8)]
    K = np.mean([moment(stand, np.zeros(m), np.zeros(m), phi, np.zeros(N)).at.K for phi in turns], axis=0)
    if stand.hold is None:
        return np.repeat([1.0, math.sqrt(K[0, 0] / (np.trace(K[3:, 3:]) / 3.0))], 3)
    return np.array([math.sqrt(K[0, 0] / (column @ K @ column)) for column in twists(stand.hold).T])
