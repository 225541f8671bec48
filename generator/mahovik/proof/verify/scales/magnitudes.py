"""Magnitudes of the pieces of the equations at one state: the terms of which the scales are sums."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from mahovik.core.stand.model import Stand
from mahovik.core.stand.state import State
from mahovik.proof.reference import Pieces
from mahovik.proof.reference.hold import free_equations
from mahovik.proof.reference.inverse import CUTS, Cuts
from mahovik.proof.verify.scales.parts import length, stream_scale
from mahovik.proof.verify.scales.wrenches import wrench_scale

Array = NDArray[np.float64]


def screw(linear: float, angular: float) -> Array:
    """Six numbers of a turned screw: one length for its linear components, one for its angular ones."""
    return np.repeat([linear, angular], 3)


def origin(L: Array) -> Array:
    """O (3) of L = T [C]."""
    skew = L[3:, :3] @ L[:3, :3].T
    return np.array([skew[2, 1], skew[0, 2], skew[1, 0]])


def phi_magnitude(V: Array) -> Array:
    """|Phi(V)| (6x6), element by element, of magnitudes V >= 0 (6)."""
    v, omega = (np.array([[0, a[2], a[1]], [a[2], 0, a[0]], [a[1], a[0], 0]]) for a in (V[:3], V[3:]))
    return np.block([[omega, np.zeros((3, 3))], [v, omega]])


def geometric_mean(diagonal: Array) -> Array:
    """sqrt(d_i d_j): bound on the elements of a semidefinite matrix with that diagonal."""
    root = np.sqrt(np.abs(diagonal))
    return np.outer(root, root)


def inverse_magnitude(S: Array) -> Array:
    """|S^-1|, element by element, of a symmetric positive definite S; scaled first, for units mix."""
    scale = 1.0 / np.sqrt(np.diag(S))
    return np.asarray(np.abs(np.linalg.inv(S * np.outer(scale, scale))) * np.outer(scale, scale))


@dataclass(frozen=True, eq=False)
class FreeMagnitudes:
    """Magnitudes along what is free, of a free carrier in all six directions; m rows.

    S (6xm)        magnitudes of S; a wrench's scale along the freedoms is S^T times it, a twist's S times that of u
    K, I           S^T K S (mxm), S^T I (mxN) themselves
    S_K, S_I       their scales
    K_inverse      |(S^T K S)^-1|
    """

    S: Array
    K: Array
    I: Array
    S_K: Array
    S_I: Array
    K_inverse: Array


class Magnitudes:
    """The magnitudes at a state; every attribute S_x belongs to the x of `Pieces`, in the same shape."""

    def __init__(self, stand: Stand, state: State, at: Pieces, cuts: Cuts = CUTS) -> None:
        self.stand = stand
        self.state = state
        self.at = at
        self.cuts = cuts
        self.speed = np.abs(at.phi_dot)
        self.acceleration = np.abs(np.array(state.phi_ddot, dtype=np.float64))

    @cached_property
    def stream(self) -> float:
        """|u|, and with a profile the magnitude of its terms."""
        return stream_scale(self.stand, self.state.position, self.at.u)

    @cached_property
    def S_V(self) -> Array:
        """Scale of V and of V_r = V - (C^T u, 0) (6)."""
        return np.abs(self.at.V) + screw(self.stream, 0.0)

    @cached_property
    def K_inverse(self) -> Array:
        """|K^-1|."""
        return inverse_magnitude(self.at.K)

    @cached_property
    def free(self) -> FreeMagnitudes:
        """What stands along the freedoms."""
        free = free_equations(self.at, self.stand)
        S = np.abs(free.S)
        return FreeMagnitudes(S, free.K, free.I, S.T @ self.S_K @ S, S.T @ self.S_I, inverse_magnitude(free.K))

    @cached_property
    def S_K(self) -> Array:
        """sqrt(K_ii K_jj)."""
        return geometric_mean(np.diag(self.at.K))

    @cached_property
    def flywheel_diagonals(self) -> Sequence[Array]:
        """Diagonal of Ls Theta_s Ls^T; a flywheel turns, so its axes share the trace of its tensor about O1."""
        found = []
        for s in self.at.flywheels:
            diagonal = np.diag(s.L @ s.Theta @ s.L.T)
            found.append(screw(float(diagonal[0]), float(diagonal[3:].sum())))
        return found

    @cached_property
    def S_K_dot(self) -> Array:
        """sum_s |phi_s'| sqrt(Theta_ii Theta_jj)."""
        total = np.zeros((6, 6))
        for speed, diagonal in zip(self.speed, self.flywheel_diagonals, strict=True):
            total += speed * geometric_mean(diagonal)
        return total

    @cached_property
    def S_M(self) -> Array:
        """|Phi| S_K + S_K_dot."""
        return phi_magnitude(self.S_V) @ self.S_K + self.S_K_dot

    @cached_property
    def S_I(self) -> Array:
        """sqrt(Theta_ii Theta_ff) (6xN)."""
        found = np.zeros((6, len(self.speed)))
        for column, diagonal in enumerate(self.flywheel_diagonals):
            found[:, column] = np.sqrt(diagonal * self.at.Theta_ff[column, column])
        return found

    @cached_property
    def S_J(self) -> Array:
        """|Phi| S_I + |phi'| S_I (6xN)."""
        return np.asarray(phi_magnitude(self.S_V) @ self.S_I + self.S_I * self.speed)

    @cached_property
    def S_F(self) -> Array:
        """Sum over bodies and kinds of wrench, each by its magnitude."""
        return wrench_scale(self.stand, self.state, self.at)

    @cached_property
    def S_bias(self) -> Array:
        """Scale of F - M V - J phi' (6)."""
        return np.asarray(self.S_F + self.S_M @ self.S_V + self.S_J @ self.speed)

    @cached_property
    def stream_rate(self) -> Array:
        """Scale of (omega x C^T u, 0) (6)."""
        return screw(length(self.at.V[3:]) * self.stream, 0.0)
