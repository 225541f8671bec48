"""R of (12) and the drive torques for M moments at once, with exact derivatives by flywheels and carrier; their norm.

Flywheel s takes from the carrier the wrench (in E1 about O1; V, V* relative to the fluid)

    W_s = Theta_s V* + I_s phi'' + phi' Theta_s,phi (V + e_s phi') + Phi(V) Theta_s (V + e_s phi') - weight,

with e_s the twist of a unit spin. Sorted by harmonics h of phi and by powers of speed:

    W_s = sum_h h(phi) (A_h + C_h phi' + I_h phi'' + I'_h phi'^2),

A_h, C_h of the carrier's motion alone, I_h, I'_h constant. (8) is then R = balance - sum_s W_s, and tau_s its part
about the axis.
"""

from __future__ import annotations

from dataclasses import dataclass, fields

import numpy as np

from mahovik.core.motion.functions import Course
from mahovik.use.numeric.frame import Twists, in_E1, uniform_stream
from mahovik.use.numeric.mechanics import Mechanics, f, slope, waves, with_torque
from mahovik.use.numeric.se3 import Array, block_diagonal, motor_cross, skew

_SPIN = block_diagonal(skew(f[3:]))  # [<e>] of (5)


@dataclass(frozen=True, eq=False)
class PrescribedMotion:
    """Coefficients of (12) at M times: linear in the harmonics of each angle, quadratic in its speed.

    balance (M, 6; N, N m): of the base, everything but the flywheels
    fixed   (5, 7, M, N): A_h
    moving  (5, 7, M, N): C_h; seventh row: see Mechanics
    V_r     (M, 6): twist relative to the fluid, for flywheels with damping
    """

    mechanics: Mechanics
    balance: Array
    fixed: Array
    moving: Array
    V_r: Array

    def locked_wrench(self) -> Array:
        """P of (12) (M, 6): wrench needed, flywheels locked in their mounts and axisymmetric, of mean inertia."""
        return np.asarray(self.balance - self.fixed[0, :6].sum(axis=2).T)

    def __getitem__(self, times: slice) -> PrescribedMotion:
        """The coefficients at some of the times."""
        fixed, moving = self.fixed[:, :, times], self.moving[:, :, times]
        return PrescribedMotion(self.mechanics, self.balance[times], fixed, moving, self.V_r[times])

    def repeat(self, K: int) -> PrescribedMotion:
        """The same times K times over."""
        fixed, moving = (np.tile(x, (1, 1, K, 1)) for x in (self.fixed, self.moving))
        return PrescribedMotion(self.mechanics, np.tile(self.balance, (K, 1)), fixed, moving, np.tile(self.V_r, (K, 1)))


def prescribe(mechanics: Mechanics, course: Course, bias: Array | float = 0.0) -> PrescribedMotion:
    """Prescribed at the times of `course`, shifted by `bias` (6, or M x 6; m, rad). StateError: a law is undefined."""
    return prescribed_at(mechanics, mechanics.frame.twists(course._replace(q=course.q + bias)))


def prescribed_at(mechanics: Mechanics, at: Twists) -> PrescribedMotion:
    """Prescribed at M twists of the carrier. StateError: a law is undefined."""
    tables, stand = mechanics.tables, mechanics.stand
    M, N = len(at.V), mechanics.N
    across, flat = np.swapaxes(motor_cross(at.V_r), 1, 2), tables.Theta.reshape(-1, 6)  # rows h, s, i
    momentum = (at.V_r @ flat.T).reshape(M, 5 * N, 6)
    fixed = (at.V_r_dot @ flat.T).reshape(M, 5 * N, 6) + momentum @ across
    if any(stand.gravity):
        fixed -= (in_E1(at.C, stand.gravity) @ tables.weight.reshape(-1, 3).T).reshape(M, 5 * N, 6)
    moving = np.moveaxis((tables.coupling.reshape(5 * N, 6) @ across).reshape(M, 5, N, 6), 0, 2)
    moving = moving + slope(np.moveaxis(momentum.reshape(M, 5, N, 6), 0, 2))  # (5, N, M, 6)
    fixed = np.moveaxis(fixed.reshape(M, 5, N, 6), 0, 2)
    A, C = (with_torque(np.ascontiguousarray(np.transpose(x, (0, 3, 2, 1))), tables) for x in (fixed, moving))
    return PrescribedMotion(mechanics, mechanics.base.balance(at), A, C, at.V_r)


@dataclass(frozen=True, eq=False)
class Linear:
    """R (M, 6; N, N m) = F - K V* - M V - J phi' - I phi'' and tau (M, N; N m), with derivatives.

    by_phi, by_phi_dot, by_phi_ddot   (M, 6, N): of R by the angle, speed, acceleration of each flywheel
    tau_by_...                        (M, N): of tau_s by those of flywheel s itself; others do not enter
    """

    R: Array
    tau: Array
    by_phi: Array
    by_phi_dot: Array
    by_phi_ddot: Array
    tau_by_phi: Array
    tau_by_phi_dot: Array
    tau_by_phi_ddot: Array

    def where(self, rows: Array, other: Linear) -> Linear:
        """Values of `other` at the moments `rows` (M, bool), these elsewhere."""
        pairs = ((getattr(other, field.name), getattr(self, field.name)) for field in fields(self))
        return Linear(*(np.where(rows.reshape(-1, *(1,) * (a.ndim - 1)), a, b) for a, b in pairs))


def residual(at: PrescribedMotion, phi: Array, phi_dot: Array, phi_ddot: Array) -> Array:
    """R (M, 6; N, N m) of (12), zero where the programme is exact; angles (M, N each; rad, s)."""
    return np.asarray(at.balance - flywheel_wrenches(at, phi, phi_dot, phi_ddot)[:6].sum(axis=2).T)


def torques(at: PrescribedMotion, phi: Array, phi_dot: Array, phi_ddot: Array) -> Array:
    """tau (M, N; N m): drive torques at the prescribed motion."""
    return np.asarray(flywheel_wrenches(at, phi, phi_dot, phi_ddot)[6])


def flywheel_wrenches(at: PrescribedMotion, phi: Array, phi_dot: Array, phi_ddot: Array) -> Array:
    """W_s in E1 about O1 and, seventh, tau_s: (7, M, N)."""
    h, _ = waves(phi)
    W: Array = np.einsum("himn,hmn->imn", _coefficients(at, phi_dot, phi_ddot), h)
    for s in range(at.mechanics.N):
        damped = flywheel_damping(at.mechanics, s, at.V_r, phi[:, s], phi_dot[:, s])
        if damped is not None:
            W[:, :, s] -= damped[0]
    return W


def linear(at: PrescribedMotion, phi: Array, phi_dot: Array, phi_ddot: Array) -> Linear:
    """R and tau with all their derivatives, exact; angles (M, N each; rad, s)."""
    h, slopes = waves(phi)
    mechanics = at.mechanics
    coefficients = _coefficients(at, phi_dot, phi_ddot)
    W = np.einsum("himn,hmn->imn", coefficients, h)
    by_phi = np.einsum("himn,hmn->imn", coefficients, slopes)
    by_phi_dot = np.einsum("himn,hmn->imn", at.moving + (2.0 * phi_dot) * mechanics.coupling_slope, h)
    by_phi_ddot = np.einsum("hin,hmn->imn", mechanics.coupling[:, :, 0], h)
    for s in range(mechanics.N):
        damped = flywheel_damping(mechanics, s, at.V_r, phi[:, s], phi_dot[:, s])
        if damped is not None:
            for target, value in zip((W, by_phi, by_phi_dot), damped, strict=True):
                target[:, :, s] -= value
    R = at.balance - W[:6].sum(axis=2).T
    a, b, c = (-np.swapaxes(x[:6], 0, 1) for x in (by_phi, by_phi_dot, by_phi_ddot))
    return Linear(R, W[6], a, b, c, by_phi[6], by_phi_dot[6], by_phi_ddot[6])


def _coefficients(at: PrescribedMotion, phi_dot: Array, phi_ddot: Array) -> Array:
    """(5, 7, M, N): what multiplies each harmonic of the angle."""
    mechanics = at.mechanics
    return np.asarray(
        at.fixed + at.moving * phi_dot + mechanics.coupling * phi_ddot + mechanics.coupling_slope * (phi_dot * phi_dot)
    )


def flywheel_damping(
    mechanics: Mechanics, s: int, V_r: Array, phi: Array, phi_dot: Array
) -> tuple[Array, Array, Array] | None:
    """Damping wrench on flywheel s in E1 with its part about the axis (7, M), and its derivatives by phi, phi'.

    None: it has no damping. V_r (M, 6): twist of the carrier relative to the fluid; phi, phi' (M) of the flywheel.
    """
    twist_lawses = mechanics.tables.damped(s, V_r, phi, phi_dot)
    if twist_lawses is None:
        return None
    damping, L, v = twist_lawses
    P, rate = damping.wrench(v), damping.rate(v)
    by_phi = P @ _SPIN.T - (rate @ (v @ _SPIN.T)[:, :, None])[:, :, 0]  # L' = L [<e>]
    in_frame = ((L @ x[:, :, None])[:, :, 0].T for x in (P, by_phi, rate @ f))
    wrench, first, second = (np.vstack([x, mechanics.tables.spin[s] @ x]) for x in in_frame)
    return wrench, first, second


@dataclass(frozen=True, eq=False)
class Drive:
    """Sums over the flywheels at times of any shape (...), in E1 about O1.

    mobility    (..., m, 6): rates of the speeds by a wrench, (S^T K S)^-1 S^T; of a free carrier K^-1
    Theta, Theta_dot   (..., 6, 6): sum Ls Theta_s Ls^T and its derivative
    h           (..., 6): sum I_s phi_s'
    push        (..., 6): sum I_s phi_s'' + I_s,phi (phi_s')^2
    weight      (..., 6, 3): wrench of the net weight by gravity in E1
    phi, phi_dot   (..., N): for flywheels with damping
    """

    mobility: Array
    Theta: Array
    Theta_dot: Array
    h: Array
    push: Array
    weight: Array
    phi: Array
    phi_dot: Array

    def __getitem__(self, index: object) -> Drive:
        return Drive(*(x[index] for x in vars(self).values()))


def drive(mechanics: Mechanics, phi: Array, phi_dot: Array, phi_ddot: Array) -> Drive:
    """Sums of the motions phi, phi', phi'' (..., N each; rad, s)."""
    tables, shape, N = mechanics.tables, phi.shape[:-1], mechanics.N
    moments = int(np.prod(shape))
    h, slopes = (np.moveaxis(x, 0, -2).reshape(moments, 5 * N) for x in waves(phi))
    speed, acceleration = (np.tile(x.reshape(moments, N), (1, 5)) for x in (phi_dot, phi_ddot))
    Theta_of, weight_of, coupling = (
        x.reshape(5 * N, np.prod(x.shape[2:], dtype=int)) for x in (tables.Theta, tables.weight, tables.coupling)
    )  # fmt: skip
    Theta = (h @ Theta_of).reshape(*shape, 6, 6)
    K, S = Theta + mechanics.base.K, mechanics.freedoms
    return Drive(
        mobility=np.linalg.inv(S.T @ K @ S) @ S.T,
        Theta=Theta,
        Theta_dot=((slopes * speed) @ Theta_of).reshape(*shape, 6, 6),
        h=((h * speed) @ coupling).reshape(*shape, 6),
        push=((h * acceleration + slopes * speed**2) @ coupling).reshape(*shape, 6),
        weight=(h @ weight_of).reshape(*shape, 6, 3),
        phi=phi,
        phi_dot=phi_dot,
    )


@dataclass(frozen=True, eq=False)
class Slopes:
    """Derivatives of wrenches (M, 6) or torques (M, N) by the carrier's motion; flywheels as they move.

    The pose changes by a small translation and rotation vector, both on the axes of E1: O1 += C d, C exp<r>.
    by_pose, by_twist, by_twist_dot   (M, 6 or N, 6): the last is -K of R, and I^T of tau
    """

    by_pose: Array
    by_twist: Array
    by_twist_dot: Array


def slopes_of_residual(mechanics: Mechanics, at: Twists, drive: Drive) -> Slopes:
    """Slopes of the residual R of (12) by pose, twist and its rate, from the sums of the flywheels.

    Where a damping law with magnitudes has a kink, the slope is the mean of its two sides. StateError: a law is
    undefined.
    """
    base = mechanics.base
    by_V_r, by_rate, by_g = _by_motion(at, drive.Theta + base.K, drive.Theta_dot, drive.h, drive.weight + base.heavy)
    for L, damping in base.damped:
        by_V_r += L @ damping.rate(at.V_r @ L) @ L.T
    for s in range(mechanics.N):
        by_V_r += _damping_slopes(mechanics, s, at, drive.phi, drive.phi_dot)
    slopes = _through_stream(mechanics, at, by_V_r, by_rate, by_g)
    if not base.laws.ties:
        return slopes
    tied = base.laws.tied_slopes(at.O1, at.C, at.V)
    return Slopes(slopes.by_pose + tied[..., :6], slopes.by_twist + tied[..., 6:], by_rate)


def slopes_of_torques(mechanics: Mechanics, at: Twists, phi: Array, phi_dot: Array) -> Slopes:
    """Slopes of the drive torques tau at phi, phi' (M, N each; rad, rad/s). Kinks as in `slopes_of_residual`."""
    tables, (h, slopes) = mechanics.tables, waves(phi)
    Theta = np.einsum("hms,hsij->msij", h, tables.Theta)
    Theta_dot = np.einsum("hms,hsij->msij", slopes * phi_dot, tables.Theta)
    spun = np.einsum("hms,hsi->msi", h * phi_dot, tables.coupling)
    weight = np.einsum("hms,hsij->msij", h, tables.weight)
    result = []
    for s in range(mechanics.N):
        by_V_r, by_rate, by_g = _by_motion(at, Theta[:, s], Theta_dot[:, s], spun[:, s], weight[:, s])
        by_V_r += _damping_slopes(mechanics, s, at, phi, phi_dot)
        by = _through_stream(mechanics, at, by_V_r, by_rate, by_g)
        result.append([-tables.spin[s] @ x for x in (by.by_pose, by.by_twist, by.by_twist_dot)])
    shape = (mechanics.N, 3, len(at.V), 6)
    return Slopes(*np.moveaxis(np.array(result).reshape(shape), (0, 1), (2, 0)))


def _by_motion(at: Twists, Theta: Array, Theta_dot: Array, h: Array, weight: Array) -> tuple[Array, Array, Array]:
    """Derivatives of weight g - Theta V_r* - Theta' V_r - Phi(V_r) (Theta V_r + h) by V_r, V_r*, and g in E1."""
    momentum = (Theta @ at.V_r[:, :, None])[:, :, 0] + h
    by_V_r = -motor_cross(at.V_r) @ Theta - momentum_cross(momentum) - Theta_dot
    return by_V_r, -Theta, weight


def _damping_slopes(mechanics: Mechanics, s: int, at: Twists, phi: Array, phi_dot: Array) -> Array | float:
    """Derivative (M, 6, 6) of the damping wrench of flywheel s by V_r, in E1 about O1; 0 without damping."""
    twist_lawses = mechanics.tables.damped(s, at.V_r, phi[:, s], phi_dot[:, s])
    if twist_lawses is None:
        return 0.0
    damping, L, twist = twist_lawses
    return np.asarray(L @ damping.rate(twist) @ np.swapaxes(L, 1, 2))


def momentum_cross(Z: Array) -> Array:
    """[[0, -<p>], [-<p>, -<h>]] (..., 6, 6) of Z = (p, h): Phi(V) Z is it times V."""
    X = np.zeros((*Z.shape, 6))
    X[..., :3, 3:] = X[..., 3:, :3] = -skew(Z[..., :3])
    X[..., 3:, 3:] = -skew(Z[..., 3:])
    return X


def _through_stream(mechanics: Mechanics, at: Twists, by_V_r: Array, by_rate: Array, by_g: Array) -> Slopes:
    """Derivatives by pose and V, from those by V_r = V - (u, 0), V_r* = V* + (omega x u, 0) and g; u, g fixed in E0."""
    turned_u = skew(in_E1(at.C, uniform_stream(mechanics.stand)))
    by_twist = by_V_r.copy()
    by_twist[..., 3:] -= by_rate[..., :3] @ turned_u
    by_pose = np.zeros_like(by_V_r)
    by_pose[..., 3:] = by_g @ skew(in_E1(at.C, mechanics.stand.gravity)) - by_V_r[..., :3] @ turned_u
    by_pose[..., 3:] += by_rate[..., :3] @ (skew(at.V[:, 3:]) @ turned_u)
    return Slopes(by_pose, by_twist, by_rate)


_HELD_STILL = 1e-9
"""Part of what the unbalance can do at the motion's frequency, below which a carrier counts as held still."""


@dataclass(frozen=True, eq=False)
class Norm:
    """max_t |root R(t)| / demand: the same for any units, origin and axes.

    root    (m, 6) of Mechanics: what a hold takes does not count
    demand  max_t |root (P(t) - mean P)|, P the wrench needed at locked flywheels
    """

    root: Array
    demand: float

    @staticmethod
    def of(at: PrescribedMotion, span: float) -> Norm:
        """The norm of a motion prescribed at uniform times, for its period or duration (s).

        For a carrier to be held still: sum mu_s Omega^2 / sqrt(m) in place of the demand; without unbalance
        as well, what spinning inertias do at that frequency.
        """
        root = at.mechanics.root
        P = at.locked_wrench() @ root.T
        demand = float(np.linalg.norm(P - P.mean(axis=0), axis=1).max())
        able = at.mechanics.able(2.0 * np.pi / span)
        return Norm(root, demand if demand > _HELD_STILL * able else able)

    def dimensionless(self, R: Array) -> Array:
        """root R / demand (M, 6; of a held carrier M, m), dimensionless."""
        return np.asarray(R @ (self.root.T / self.demand))

    def relative(self, R: Array) -> float:
        """Relative residual of R (M, 6)."""
        return float(np.linalg.norm(self.dimensionless(R), axis=1).max())
