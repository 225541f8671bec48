"""The motion of a slew by the exact coupled equations: demanded rows as the path says, all else by the dynamics.

With R0 the residual of (12) at V* = 0 and phi'' = 0, V* = K^-1 (R0 - I phi'') and a = S V* + s, so that

    S K^-1 I phi'' = S K^-1 R0 + s - a

at every time; of the flywheels' accelerations that solve it the one nearest to a wanted share, in the norm of Theta_ff.
Accelerations at all nodes at once give speeds and positions by integrals of splines, and these the accelerations, until
nothing changes: Picard's iteration, which converges since the accelerations hardly depend on the positions.
"""

from __future__ import annotations

import warnings
from dataclasses import dataclass

import numpy as np
from scipy.interpolate import make_interp_spline
from scipy.spatial.transform import Rotation

from mahovik.core.motion.functions import Angles, Course
from mahovik.core.motion.required import Slew
from mahovik.core.stand.task import places_of
from mahovik.errors import StateError
from mahovik.use.numeric.frame import in_E1
from mahovik.use.numeric.mechanics import Mechanics
from mahovik.use.numeric.residual import linear, prescribe, prescribed_at, torques
from mahovik.use.numeric.se3 import EULER, Array
from mahovik.use.plan.slew.share import Mean, NoSlewError, unreached_motion

_ROUNDS = 60
_LAST_CHANGE = 1e-12
"""Change of the flywheels' angles (over 1 + the largest) that ends the iteration."""

_RANK = 1e-9
_WEAK = 1e-3
"""Part of the best reach of flywheels without unbalance below which a row counts as out of reach."""

SLOWER = 'expected slower flywheels, or unbalance = "averaged"'
_REACH = 1e-8


@dataclass(frozen=True, eq=False)
class Demand:
    """A path at M times: sigma, sigma', sigma'' (M) that the rows follow, and the wanted phi'' (M, N)."""

    t: Array
    sigma: Array
    speed: Array
    acceleration: Array
    phi_ddot: Array


@dataclass(frozen=True, eq=False)
class SlewMotion:
    """The motion at times t (M, s): course of the carrier, angles of the flywheels, drive torques (M, N; N m).

    missing   what the flywheels do not give, where the demand was missed most; None: reached
    """

    t: Array
    course: Course
    angles: Angles
    tau: Array
    missing: NoSlewError | None


@dataclass(frozen=True, eq=False)
class Exact:
    """The exact equations of a slew; S (m, 6)."""

    mechanics: Mechanics
    slew: Slew
    S: Array

    def follow(self, demand: Demand) -> SlewMotion:
        """The motion whose demanded rows follow the path. Raises StateError, NoSlewError: it does not settle."""
        t, slew = demand.t, self.slew
        M = len(t)
        phi_dot = np.tile(slew.phi_dot, (M, 1))
        phi = slew.phi + t[:, None] * phi_dot
        position, velocity = np.tile(np.array(slew.position), (M, 1)), np.zeros((M, 3))
        C = slew.path(demand.sigma) @ slew.start
        if slew.kind == "attitude":
            omega = demand.speed[:, None] * slew.axis
        else:
            omega = in_E1(C, demand.speed[:, None] * slew.normal)
        theta = self._angles(C)
        missing: NoSlewError | None
        unreached: NoSlewError | None
        missing, unreached, previous = None, None, np.inf
        for _ in range(_ROUNDS):
            rates = self._rates(theta, omega)
            q = np.hstack([position, theta])
            q_dot = np.hstack([velocity, rates])
            V_dot, phi_ddot, missing = self._accelerations(demand, Course(q, q_dot, np.zeros_like(q)), phi, phi_dot)
            unreached = unreached or missing
            before = phi
            gained = _integral(t, phi_ddot)
            new_dot = np.array(slew.phi_dot) + gained
            # angles of many turns would lose digits that the distances between the rows need
            phi = slew.phi + t[:, None] * slew.phi_dot + _integral(t, gained)
            change = max(_change(phi, before), _change(new_dot, phi_dot))
            phi_dot = new_dot
            at = self.mechanics.frame.twists(Course(q, q_dot, np.zeros_like(q)))
            in_E0 = (at.C @ (V_dot[:, :3] + np.cross(omega, at.V[:, :3]))[:, :, None])[:, :, 0]
            velocity = _integral(t, in_E0)
            moved = slew.position + _integral(t, velocity)
            change = max(change, float(np.abs(moved - position).max()))
            position = moved
            if slew.kind != "attitude":
                new_omega = _integral(t, V_dot[:, 3:])
                new_theta = theta[0] + _integral(t, self._rates(theta, new_omega))
                change = max(change, _change(new_theta, theta), _change(new_omega, omega))
                omega, theta = new_omega, new_theta
            if not np.isfinite(change) or change > 1e6:
                break
            if change < _LAST_CHANGE or (change < 1e-10 and change > 0.5 * previous):
                return self._end(t, position, velocity, theta, omega, V_dot, phi, phi_dot, phi_ddot, missing)
            previous = change
        if unreached is not None:
            raise unreached
        raise self._why_not()

    def _angles(self, C: Array) -> Array:
        """psi, theta, phi (M, 3; rad) of attitudes (M, 3, 3); where they are singular any that fit."""
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", UserWarning)  # singular attitudes are refused by name
            angles = Rotation.from_matrix(C).as_euler(EULER[self.mechanics.stand.angles])
        return np.asarray(np.unwrap(angles, axis=0))

    def _why_not(self) -> Exception:
        """Why the motion does not settle: unbalance alone would have to reach a row, or something acts too strongly."""
        mean, rows = Mean.of(self.mechanics, self.S), len(self.S)
        norm = np.linalg.inv(np.linalg.cholesky(self.S @ np.linalg.solve(mean.K0, self.S.T)))
        U, sigma, _ = np.linalg.svd(norm @ mean.A / np.sqrt(mean.Theta_ff))
        if len(sigma) < rows or sigma[-1] < _WEAK * sigma[0]:
            left = np.linalg.solve(norm, U[:, -1])
            twist = np.linalg.solve(mean.K0, self.S.T @ (norm.T @ U[:, -1]))
            return unreached_motion(self.slew, self.S, twist, left)
        stand = self.mechanics.stand
        acting = bool(stand.laws) or any(stand.gravity) or any(body.laws for body in stand.bodies)
        why = "the carrier's surroundings, or the flywheels' own unbalance, act" if acting else "unbalance acts"
        words = f"the motion of the slew does not settle: {why} too strongly on what the rows demand"
        resisted = self.slew.unbalance == "resisted"
        return StateError(f"{words}; {SLOWER}" if resisted else words)

    def _accelerations(
        self, demand: Demand, course: Course, phi: Array, phi_dot: Array
    ) -> tuple[Array, Array, NoSlewError | None]:
        """V* (M, 6), phi'' (M, N), and what is missing most."""
        mechanics = self.mechanics
        at = mechanics.frame.twists(course)
        u = at.V[:, :3] - at.V_r[:, :3]
        still = at._replace(V_r_dot=np.hstack([np.cross(at.V[:, 3:], u), np.zeros_like(u)]))
        equations = linear(prescribed_at(mechanics, still), phi, phi_dot, np.zeros_like(phi))
        I = -equations.by_phi_ddot
        K, _ = mechanics.mass_and_coupling(phi)
        to_motion = np.linalg.solve(K, np.concatenate([equations.R[:, :, None], I], axis=2))
        free, by_phi_ddot = to_motion[:, :, 0], to_motion[:, :, 1:]
        a, s = self._demand(demand, at.C, at.V)
        A = self.S @ by_phi_ddot
        c = free @ self.S.T + s - a
        root = np.sqrt(mechanics.tables.Theta_ff)
        left = c - (A @ demand.phi_ddot[:, :, None])[:, :, 0]
        more = (np.linalg.pinv(A / root, rcond=_RANK) @ left[:, :, None])[:, :, 0] / root
        phi_ddot = demand.phi_ddot + more
        V_dot = free - (by_phi_ddot @ phi_ddot[:, :, None])[:, :, 0]
        return V_dot, phi_ddot, self._missing(K, a, free @ self.S.T + s - a, a - V_dot @ self.S.T - s)

    def _missing(self, K: Array, a: Array, c: Array, left: Array) -> NoSlewError | None:
        """The part of the demand a that is left where this is most; None: nothing is.

        c: what the flywheels are to add, so that a demand to stay at rest has a size, too; (M, m) each.
        """
        G = self.S @ np.linalg.solve(K, np.broadcast_to(self.S.T, (len(K), *self.S.T.shape)))
        wrenches = np.linalg.solve(G, np.stack([left, a, c], axis=2))
        sizes = np.sqrt(np.maximum(np.einsum("mi,mi->m", left, wrenches[:, :, 0]), 0.0))
        demands = np.einsum("mik,mik->mk", np.stack([a, c], axis=2), wrenches[:, :, 1:])
        whole = np.sqrt(np.maximum(demands, 0.0)).max()
        k = int(np.argmax(sizes))
        if sizes[k] <= _REACH * whole or sizes[k] == 0.0:
            return None
        twist = np.asarray(np.linalg.solve(K[k], self.S.T @ wrenches[k, :, 0]))
        return unreached_motion(self.slew, self.S, twist, left[k])

    def _demand(self, demand: Demand, C: Array, V: Array) -> tuple[Array, Array]:
        """a, s (M, m each) of a = S V* + s."""
        slew = self.slew
        omega = V[:, 3:]
        if slew.kind == "attitude":
            angular = demand.acceleration[:, None] * slew.axis
        else:
            normal = in_E1(C, np.tile(slew.normal, (len(C), 1)))
            angular = demand.acceleration[:, None] * normal - demand.speed[:, None] * np.cross(omega, normal)
        a, s = np.zeros((2, len(C), len(slew.task.rows)))
        places = places_of(self.mechanics.stand.instruments, self.mechanics.stand.points)
        for i, row in enumerate(slew.task.rows):
            if row.component.startswith("w"):
                a[:, i] = angular @ self.S[i, 3:]
            elif row.of:
                v = V[:, :3] + np.cross(omega, places[row.of][0])
                s[:, i] = np.cross(omega, v) @ self.S[i, :3]
        return a, s

    def _rates(self, theta: Array, omega: Array) -> Array:
        """theta' (M, 3) of omega (M, 3) in E1."""
        return np.asarray(np.linalg.solve(self._columns(theta), omega[:, :, None])[:, :, 0])

    def _columns(self, theta: Array) -> Array:
        """B (M, 3, 3) of omega = B theta'."""
        return self.mechanics.frame.slopes(np.hstack([np.zeros_like(theta), theta]))[2][:, 3:, 3:]

    def _end(
        self, t: Array, position: Array, velocity: Array, theta: Array, omega: Array, V_dot: Array,
        phi: Array, phi_dot: Array, phi_ddot: Array, missing: NoSlewError | None,
    ) -> SlewMotion:  # fmt: skip
        rates = self._rates(theta, omega)
        q, q_dot = np.hstack([position, theta]), np.hstack([velocity, rates])
        at = self.mechanics.frame.twists(Course(q, q_dot, np.zeros_like(q)))
        turning = np.linalg.solve(self._columns(theta), (V_dot[:, 3:] - at.V_r_dot[:, 3:])[:, :, None])[:, :, 0]
        straight = (at.C @ (V_dot[:, :3] + np.cross(omega, at.V[:, :3]))[:, :, None])[:, :, 0]
        course = Course(q, q_dot, np.hstack([straight, turning]))
        angles = Angles(phi, phi_dot, phi_ddot)
        tau = torques(prescribe(self.mechanics, course), *angles)
        return SlewMotion(t, course, angles, tau, missing)


def _integral(t: Array, values: Array) -> Array:
    """Integrals (M, n) from t[0] of values (M, n) at t (M)."""
    spline = make_interp_spline(t, values, k=5).antiderivative()
    return np.asarray(spline(t) - spline(t[0]))


def _change(new: Array, old: Array) -> float:
    return float(np.abs(new - old).max(initial=0.0) / (1.0 + np.abs(new).max(initial=0.0)))
