"""Derivatives of R of (12) and of the drive torques by the carrier's pose, twist V and its derivative V*, exact.

The pose changes by a small translation and rotation vector, both on the axes of E1: O1 += C d, C exp<r>.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple, Protocol

import numpy as np

from mahovik.core.lower.law_arrays import TwistLaws
from mahovik.use.numeric.array import Array
from mahovik.use.numeric.carrier import Base
from mahovik.use.numeric.flywheels import Tables, f, waves
from mahovik.use.numeric.kinematics import Twists, in_E1
from mahovik.use.numeric.prescribed_motion import Mechanics
from mahovik.use.numeric.se3 import block_diagonal, motor_cross, skew, turn
from mahovik.use.numeric.stream import uniform_stream


class Slopes(NamedTuple):
    """Derivatives by a small pose (translation, rotation vector on E1) and by V: (M, 6, 6) each."""

    by_pose: Array
    by_twist: Array


class FlywheelSums(Protocol):
    """Sums over the flywheels at M moments, in E1 about O1: as `Drive` of the carrier's course has them."""

    @property
    def Theta(self) -> Array:
        """(M, 6, 6): inertia."""

    @property
    def Theta_dot(self) -> Array:
        """(M, 6, 6): its derivative by time."""

    @property
    def h(self) -> Array:
        """(M, 6): sum I_s phi_s'."""

    @property
    def weight(self) -> Array:
        """(M, 6, 3): wrench of the net weight by gravity."""

    @property
    def phi(self) -> Array:
        """(M, N; rad)."""

    @property
    def phi_dot(self) -> Array:
        """(M, N; rad/s)."""


@dataclass(frozen=True, eq=False)
class ByCarrier:
    """R (6; N, N m) and tau (N; N m) by the carrier's motion, at M moments; flywheels as they move.

    by_pose, by_twist, by_twist_dot               (M, 6, 6): of R; the last is -K
    tau_by_pose, tau_by_twist, tau_by_twist_dot   (M, N, 6): of tau; the last is I^T
    """

    by_pose: Array
    by_twist: Array
    by_twist_dot: Array
    tau_by_pose: Array
    tau_by_twist: Array
    tau_by_twist_dot: Array


def by_carrier(mechanics: Mechanics, at: Twists, phi: Array, phi_dot: Array) -> ByCarrier:
    """Slopes by the carrier's motion at M twists of it, for flywheel motions phi, phi' (M, N each; rad, s).

    Where a damping law with magnitudes has a kink, the slope is the mean of its two sides. StateError: a law is
    undefined.
    """
    own = _slopes_of_base(mechanics.base, at)
    wheels = _flywheels(mechanics.tables, at, phi, phi_dot)
    R = [x - y.sum(axis=1) for x, y in zip(own, wheels, strict=True)]
    tau = [np.einsum("si,msij->msj", mechanics.tables.spin, x) for x in wheels]
    by_pose, by_twist = _with_ties(mechanics.base, at, _through_stream(mechanics, at, *R))
    tau_by_pose, tau_by_twist = _through_stream(mechanics, at, *tau)
    return ByCarrier(by_pose, by_twist, R[1], tau_by_pose, tau_by_twist, tau[1])


def slopes_of_residual(mechanics: Mechanics, at: Twists, wheels: FlywheelSums) -> Slopes:
    """`by_pose` and `by_twist` of R as of `by_carrier`, from the sums of the flywheels: a fraction of its work.

    StateError: a law is undefined.
    """
    by_V_r, by_rate, by_g = _slopes_of_base(mechanics.base, at)
    momentum = (wheels.Theta @ at.V_r[:, :, None])[:, :, 0] + wheels.h
    by_V_r -= motor_cross(at.V_r) @ wheels.Theta + momentum_cross(momentum) + wheels.Theta_dot
    for s, damping in enumerate(mechanics.tables.damping):
        if damping is not None:
            by_V_r += _damping_slopes(mechanics.tables, s, damping, at, wheels.phi, wheels.phi_dot)
    slopes = _through_stream(mechanics, at, by_V_r, by_rate - wheels.Theta, by_g + wheels.weight)
    return _with_ties(mechanics.base, at, slopes)


def _slopes_of_base(base: Base, at: Twists) -> tuple[Array, Array, Array]:
    """Derivatives for carrier and instruments, without ties: by V_r, V_r*, and gravity in E1 (M, 6, 3)."""
    momentum = at.V_r @ base.K
    by_V_r = -motor_cross(at.V_r) @ base.K - momentum_cross(momentum)
    for L, damping in base.twist_laws:
        by_V_r += L @ damping.rate(at.V_r @ L) @ L.T
    M = len(at.V)
    return by_V_r, np.tile(-base.K, (M, 1, 1)), np.tile(base.heavy, (M, 1, 1))


def _flywheels(tables: Tables, at: Twists, phi: Array, phi_dot: Array) -> tuple[Array, Array, Array]:
    """Derivatives of W_s (M, N, 6, 6): by V_r, V_r*, and gravity in E1 (M, N, 6, 3)."""
    h, slopes = waves(phi)
    Theta = np.einsum("hms,hsij->msij", h, tables.Theta)
    Theta_dot = np.einsum("hms,hsij->msij", slopes * phi_dot, tables.Theta)
    spun = np.einsum("hms,hsi->msi", h * phi_dot, tables.coupling)
    momentum = (Theta @ at.V_r[:, None, :, None])[..., 0] + spun
    by_V_r = motor_cross(at.V_r)[:, None] @ Theta + momentum_cross(momentum) + Theta_dot
    for s, damping in enumerate(tables.damping):
        if damping is not None:
            by_V_r[:, s] -= _damping_slopes(tables, s, damping, at, phi, phi_dot)
    return by_V_r, Theta, -np.einsum("hms,hsij->msij", h, tables.weight)


def _damping_slopes(tables: Tables, s: int, damping: TwistLaws, at: Twists, phi: Array, phi_dot: Array) -> Array:
    """Derivative (M, 6, 6) of the damping wrench of flywheel s by V_r, in E1 about O1."""
    L = tables.Lm[s] @ block_diagonal(turn(0, phi[:, s]))
    twist = (at.V_r[:, None, :] @ L)[:, 0, :] + phi_dot[:, s, None] * f
    return np.asarray(L @ damping.rate(twist) @ np.swapaxes(L, 1, 2))


def momentum_cross(Z: Array) -> Array:
    """[[0, -<p>], [-<p>, -<h>]] (..., 6, 6) of Z = (p, h): Phi(V) Z is it times V."""
    X = np.zeros((*Z.shape, 6))
    X[..., :3, 3:] = X[..., 3:, :3] = -skew(Z[..., :3])
    X[..., 3:, 3:] = -skew(Z[..., 3:])
    return X


def _through_stream(mechanics: Mechanics, at: Twists, by_V_r: Array, by_rate: Array, by_g: Array) -> Slopes:
    """Derivatives by pose and V, from those by V_r = V - (u, 0), V_r* = V* + (omega x u, 0) and g; u, g fixed in E0."""
    M = len(at.V)
    among = (M,) + (1,) * (by_g.ndim - 3) + (3, 3)  # flywheels, where there are any, share the carrier's pose
    gravity, u = (
        in_E1(at.C, np.broadcast_to(x, (M, 3))) for x in (mechanics.stand.gravity, uniform_stream(mechanics.stand))
    )
    turned_u = skew(u)
    by_twist = by_V_r.copy()
    by_twist[..., 3:] -= by_rate[..., :3] @ turned_u.reshape(among)
    by_pose = np.zeros_like(by_V_r)
    by_pose[..., 3:] = by_g @ skew(gravity).reshape(among)
    by_pose[..., 3:] -= by_V_r[..., :3] @ turned_u.reshape(among)
    by_pose[..., 3:] += by_rate[..., :3] @ (skew(at.V[:, 3:]) @ turned_u).reshape(among)
    return Slopes(by_pose, by_twist)


def _with_ties(base: Base, at: Twists, slopes: Slopes) -> Slopes:
    """With those of the laws between E0 and the carrier. StateError: a law is undefined there."""
    if not base.laws.ties:
        return slopes
    tied = base.laws.tied_slopes(at.O1, at.C, at.V)
    return Slopes(slopes.by_pose + tied[..., :6], slopes.by_twist + tied[..., 6:])
