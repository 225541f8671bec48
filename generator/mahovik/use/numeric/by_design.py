"""R of (12) and drive torques differentiated by what a builder of flywheels chooses: place, mounting, mass, inertia.

A small change of place or mounting carries a flywheel's tables by a motor X of E1: Lm becomes (1 + X) Lm, so that
Theta_h changes by X Theta_h + Theta_h X^T, I_h by X I_h, the weight by X W_h + W_h X_C^T; mass properties enter Theta
linearly. The derivatives are tables again, of one more flywheel for each parameter, as in `PrescribedMotion`.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mahovik.core.motion.functions import Course
from mahovik.core.stand.model import Flywheel, Stand
from mahovik.use.numeric.array import Array
from mahovik.use.numeric.evaluate import flywheel_wrenches
from mahovik.use.numeric.flywheels import Tables, f, inertia_harmonics, slope, waves, weight_harmonics
from mahovik.use.numeric.kinematics import Twists, twists
from mahovik.use.numeric.prescribed_motion import Mechanics, PrescribedMotion, harmonics_at
from mahovik.use.numeric.se3 import (
    block_diagonal,
    flywheel_transfer,
    mount_axes,
    place,
    skew,
    spatial_inertia,
    transfer,
    turn,
)

PARAMETERS = (
    "position 1", "position 2", "position 3", "turn 1", "turn 2", "turn 3", "mass",
    "center 1", "center 2", "center 3", "J11", "J22", "J33", "J12", "J13", "J23",
)  # fmt: skip
"""Parameters of each flywheel, in this order:

position  Os in the mount's frame, m
turn      small rotation of its axes at phi = 0 about its own axes, rad: 1 shifts the phase, 2 and 3 tilt the axis
mass      kg; center of mass and inertia as they are
center    of mass in its frame, m: 1 along the axis, 2 and 3 across: the unbalance, divided by the mass
Jij       inertia of the stand, about the point named in the stand, kg m2; Jji with it
"""
PLACING, MASSES = 6, 10
"""How many of them place the flywheel, and how many are of its mass."""

_ENTRIES = ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))


@dataclass(frozen=True, eq=False)
class TableRates:
    """Derivatives of `Tables` by the parameters of each flywheel; N flywheels, K = len(PARAMETERS).

    Theta     (5, N, K, 6, 6), coupling (5, N, K, 6), weight (5, N, K, 6, 3), spin (N, K, 6)
    motor     (N, 6, 6, 6): X of each of the first six
    """

    Theta: Array
    coupling: Array
    weight: Array
    spin: Array
    motor: Array


def table_rates(stand: Stand, tables: Tables) -> TableRates:
    """Derivatives of the tables of a stand's flywheels."""
    N, K = len(stand.flywheels), len(PARAMETERS)
    Theta, weight = np.zeros((5, N, K, 6, 6)), np.zeros((5, N, K, 6, 3))
    coupling, spin, motor = np.zeros((5, N, K, 6)), np.zeros((N, K, 6)), np.zeros((N, PLACING, 6, 6))
    for s, wheel in enumerate(stand.flywheels):
        X = motors(stand, wheel)
        motor[s] = X
        own = tables.Theta[:, s, None]
        Theta[:, s, :PLACING] = X @ own + own @ np.swapaxes(X, 1, 2)
        load = tables.weight[:, s, None]
        weight[:, s, :PLACING] = X @ load + load @ np.swapaxes(X[:, :3, :3], 1, 2)
        spin[s, :PLACING] = -np.einsum("i,kij->kj", tables.spin[s], X)
        coupling[:, s, :PLACING] = np.einsum("kij,hj->hki", X, tables.coupling[:, s])
        mass, moment, J = mass_rates(wheel)
        Theta[:, s, PLACING:] = inertia_harmonics(spatial_inertia(mass, moment, J), tables.Lm[s])
        weight[:, s, PLACING:] = weight_harmonics(mass, moment, tables.Lm[s])
        coupling[:, s, PLACING:] = Theta[:, s, PLACING:] @ tables.spin[s]
    return TableRates(Theta, coupling, weight, spin, motor)


def motors(stand: Stand, wheel: Flywheel) -> Array:
    """X (6, 6, 6) in E1 about O1: of moves along the mount's axes (m), of turns about the flywheel's own (rad)."""
    Lm = flywheel_transfer(stand, wheel)
    C, O = Lm[:3, :3], place(Lm)
    mount = C @ mount_axes(wheel).T  # of the mount's axes to E1
    X = np.zeros((PLACING, 6, 6))
    X[:3, 3:, :3] = skew(mount.T)
    T, back = transfer(O, np.eye(3)), transfer(-O, np.eye(3))
    X[3:] = T @ block_diagonal(skew(C.T)) @ back
    return X


def mass_rates(wheel: Flywheel) -> tuple[Array, Array, Array]:
    """Derivatives by MASSES: of mass (10), first moment (10, 3) and inertia about the origin (10, 3, 3)."""
    m, center = wheel.mass, np.array(wheel.center_of_mass)
    mass, moment, J = np.zeros(MASSES), np.zeros((MASSES, 3)), np.zeros((MASSES, 3, 3))
    mass[0], moment[0], moment[1:4] = 1.0, center, m * np.eye(3)
    if wheel.inertia_about != "origin":
        across, each = skew(center), skew(np.eye(3))
        J[0] = -across @ across
        J[1:4] = -m * (each @ across + across @ each)
    for k, (i, j) in enumerate(_ENTRIES, start=4):
        J[k, i, j] = J[k, j, i] = 1.0
    return mass, moment, J


@dataclass(frozen=True, eq=False)
class DesignRates:
    """Derivatives by PARAMETERS of every flywheel, those of the stand that `at` is of.

    R    (M, 6, N, K): of R of (12); a parameter of flywheel s reaches R through its own wrench alone
    tau  (M, N, K): of tau_s by the parameters of flywheel s; others do not enter
    """

    R: Array
    tau: Array


def by_design(
    at: PrescribedMotion, course: Course, bias: Array | float, phi: Array, phi_dot: Array, phi_ddot: Array
) -> DesignRates:
    """Derivatives, exact, at a motion: `at` is `prescribe(mechanics, course, bias)`; angles (M, N each; rad, s)."""
    own = at.mechanics
    moving = twists(own.stand, course._replace(q=course.q + bias))
    rates = table_rates(own.stand, own.tables)
    W = _wrench_rates(own, moving, rates, phi, phi_dot, phi_ddot)
    spin = own.tables.spin
    tau = np.einsum("si,imsk->msk", spin, W)
    tau += np.einsum("ski,ims->msk", rates.spin, flywheel_wrenches(at, phi, phi_dot, phi_ddot)[:6])
    for s, damping in enumerate(own.tables.damping):
        if damping is not None:
            rate = _damping_rates(own.tables, rates, s, at.V_r, phi[:, s], phi_dot[:, s])
            W[:, :, s, :PLACING] -= rate
            tau[:, s, :PLACING] -= np.einsum("i,imk->mk", spin[s], rate)
    return DesignRates(-np.swapaxes(W, 0, 1), tau)


def _wrench_rates(
    own: Mechanics, moving: Twists, rates: TableRates, phi: Array, phi_dot: Array, phi_ddot: Array
) -> Array:
    """Derivatives (6, M, N, K) of W_s in E1, without damping."""
    N, K, M = own.N, len(PARAMETERS), len(phi)
    coupling = rates.coupling.reshape(5, N * K, 6)
    fixed, along = harmonics_at(
        own.stand, moving, rates.Theta.reshape(5, N * K, 6, 6), rates.weight.reshape(5, N * K, 6, 3), coupling
    )
    still = np.transpose(coupling, (0, 2, 1))[:, :, None, :]
    h, first, second = (np.repeat(x, K, axis=-1) for x in (waves(phi)[0], phi_dot, phi_ddot))
    A = fixed + along * first + still * second + slope(still) * (first * first)
    return np.asarray(np.einsum("himn,hmn->imn", A, h).reshape(6, M, N, K))


def _damping_rates(tables: Tables, rates: TableRates, s: int, V_r: Array, phi: Array, phi_dot: Array) -> Array:
    """Derivatives (6, M, 6) by place and mounting of the damping wrench of flywheel s in E1."""
    damping, Lm, X = tables.damping[s], tables.Lm[s], rates.motor[s]
    assert damping is not None
    R = block_diagonal(turn(0, phi))  # (M, 6, 6)
    v = ((V_r @ Lm)[:, None, :] @ R)[:, 0, :] + phi_dot[:, None] * f
    wrench = (Lm @ (R @ damping.wrench(v)[:, :, None]))[:, :, 0]
    felt = np.einsum("mi,kij->mkj", V_r, X) @ Lm  # X^T V_r in the frame at phi = 0
    change = np.einsum("mij,mjk->mik", damping.rate(v), np.swapaxes(felt @ R, 1, 2))
    found = np.einsum("kij,mj->imk", X, wrench) + np.moveaxis(Lm @ (R @ change), 1, 0)
    return np.asarray(found)
