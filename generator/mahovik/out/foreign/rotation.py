"""Rotations as other formats write them, and as a stand file does."""

from __future__ import annotations

import math

import numpy as np

from mahovik.out.foreign.model import Array


def of_rpy(roll: float, pitch: float, yaw: float) -> Array:
    """Axes (3x3) turned by roll, pitch, yaw about fixed x, y, z: C3(yaw) C2(pitch) C1(roll), rad."""
    a, b, c = math.cos(roll), math.cos(pitch), math.cos(yaw)
    p, q, r = math.sin(roll), math.sin(pitch), math.sin(yaw)
    return np.array(
        [
            [c * b, c * q * p - r * a, c * q * a + r * p],
            [r * b, r * q * p + c * a, r * q * a - c * p],
            [-q, b * p, b * a],
        ]
    )


def about(axis: Array, angle: float) -> Array:
    """Rotation (3x3) by an angle, rad, about an axis of any length but 0."""
    e = axis / np.linalg.norm(axis)
    cross = np.array([[0, -e[2], e[1]], [e[2], 0, -e[0]], [-e[1], e[0], 0]])
    return np.asarray(np.eye(3) + math.sin(angle) * cross + (1 - math.cos(angle)) * (cross @ cross))


def angles_of(axes: Array) -> tuple[float, float, float]:
    """psi, theta, phi, rad, of axes = C3(psi) C2(theta) C1(phi); as exact at theta = +-pi/2 as elsewhere."""
    psi = math.atan2(axes[1, 0], axes[0, 0])
    theta = math.atan2(-axes[2, 0], math.hypot(axes[0, 0], axes[1, 0]))
    s, c = math.sin(psi), math.cos(psi)
    # the rest of the rotation is about the first axis for any psi, which compensates rounding of psi
    phi = math.atan2(s * axes[0, 2] - c * axes[1, 2], c * axes[1, 1] - s * axes[0, 1])
    return psi, theta, phi


def across(axis: Array) -> Array:
    """A direction across an axis: the coordinate axis that follows its largest component in turn, x y z x."""
    found = np.zeros(3)
    found[(int(np.argmax(np.abs(axis))) + 1) % 3] = 1.0
    return found


def spin_axes(axis: Array, zero: Array) -> Array:
    """Axes (3x3, columns) of a flywheel: the first along `axis`, the second the part of `zero` across it."""
    first = axis / np.linalg.norm(axis)
    second = zero - (zero @ first) * first
    second = second - (second @ first) * first  # once more: what rounding left along the axis of a nearly parallel zero
    second = second / np.linalg.norm(second)
    return np.column_stack([first, second, np.cross(first, second)])
