"""Poses, twists and vectors of many samples at many times: components come before the samples.

Sums are written out, so that the bits of a sample do not depend on how many others are beside it.

A vector is (..., 3, n), a matrix (..., 3, 3, n), with n samples last. What is the same at all times has no axis of
times.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def rotation(q: Array) -> Array:
    """C (..., 3, 3, n) of quaternions (..., 4, n), w first, of any length but zero."""
    w, x, y, z = (q[..., i, :] for i in range(4))
    s = 2.0 / (w * w + x * x + y * y + z * z)
    found = np.empty((*q.shape[:-2], 3, 3, q.shape[-1]))
    sx, sy, sz = s * x, s * y, s * z
    wx, wy, wz = w * sx, w * sy, w * sz
    xx, xy, xz = x * sx, x * sy, x * sz
    yy, yz, zz = y * sy, y * sz, z * sz
    rows = (
        (1.0 - (yy + zz), xy - wz, xz + wy),
        (xy + wz, 1.0 - (xx + zz), yz - wx),
        (xz - wy, yz + wx, 1.0 - (xx + yy)),
    )
    for i, row in enumerate(rows):
        for j, value in enumerate(row):
            found[..., i, j, :] = value
    return found


def turn(C: Array, v: Array) -> Array:
    """C v of n samples: C (..., 3, 3, n), v (..., 3, n). Not by `@`, whose order of summation may depend on n."""
    return np.stack([_sum(C[..., i, 0, :], C[..., i, 1, :], C[..., i, 2, :], v) for i in range(3)], axis=-2)


def turn_back(C: Array, v: Array) -> Array:
    """C^T v of n samples, as `turn`."""
    return np.stack([_sum(C[..., 0, i, :], C[..., 1, i, :], C[..., 2, i, :], v) for i in range(3)], axis=-2)


def _sum(a: Array, b: Array, c: Array, v: Array) -> Array:
    return np.asarray(a * v[..., 0, :] + b * v[..., 1, :] + c * v[..., 2, :])


def cross(a: Array, b: Array) -> Array:
    """a x b."""
    (a1, a2, a3), (b1, b2, b3) = ((v[..., 0, :], v[..., 1, :], v[..., 2, :]) for v in (a, b))
    found = np.empty(np.broadcast_shapes(a.shape, b.shape))
    for i, (left, right) in enumerate((((a2, b3), (a3, b2)), ((a3, b1), (a1, b3)), ((a1, b2), (a2, b1)))):
        np.multiply(*left, out=found[..., i, :])
        found[..., i, :] -= right[0] * right[1]
    return found


def product(A: Array, v: Array) -> Array:
    """A v of a matrix (m, k, n), a matrix of each sample, and v (..., k, n)."""
    rows = []
    for row in A:
        found: Any = row[0] * v[..., 0, :]
        for j in range(1, len(row)):
            found = found + row[j] * v[..., j, :]
        rows.append(found)
    return np.stack(rows, axis=-2)


def conjugate(q: Array) -> Array:
    """The quaternion (..., 4, n) of the opposite rotation."""
    return np.asarray(q * np.array([1.0, -1.0, -1.0, -1.0])[:, None])


def compose(p: Array, q: Array) -> Array:
    """The quaternion p q: first q, then p."""
    (a, b, c, d), (w, x, y, z) = (tuple(r[..., i, :] for i in range(4)) for r in (p, q))
    return np.stack(
        [
            a * w - b * x - c * y - d * z,
            a * x + b * w + c * z - d * y,
            a * y - b * z + c * w + d * x,
            a * z + b * y - c * x + d * w,
        ],
        axis=-2,
    )


def rotation_vector(q: Array) -> Array:
    """Rotation vector (..., 3, n) of length at most pi of quaternions (..., 4, n)."""
    sign = np.where(q[..., 0, :] < 0.0, -1.0, 1.0)
    w, v = sign * q[..., 0, :], sign[..., None, :] * q[..., 1:, :]
    sine = np.sqrt(v[..., 0, :] ** 2 + v[..., 1, :] ** 2 + v[..., 2, :] ** 2)
    small = sine < 1e-12
    factor = np.where(small, 2.0, 2.0 * np.arctan2(sine, w) / np.where(small, 1.0, sine))
    return np.asarray(factor[..., None, :] * v)


def small_rotation(r: Array) -> Array:
    """The quaternion (4, n) of rotation vectors (3, n)."""
    angle = np.sqrt(r[0] ** 2 + r[1] ** 2 + r[2] ** 2)
    half = 0.5 * np.sinc(angle / (2.0 * np.pi))
    return np.stack([np.cos(0.5 * angle), half * r[0], half * r[1], half * r[2]])


def square(v: Array) -> Array:
    """v . v (..., n), of any number of components."""
    found: Any = v[..., 0, :] ** 2
    for i in range(1, v.shape[-2]):
        found = found + v[..., i, :] ** 2
    return np.asarray(found)
