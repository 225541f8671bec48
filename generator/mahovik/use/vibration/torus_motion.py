"""A motion of the carrier on the torus of the flywheels' phases, as `balance` finds it."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np
from scipy.spatial.transform import Rotation

from mahovik.core.stand.state import State
from mahovik.proof.reference import pieces
from mahovik.proof.reference.motion import forward
from mahovik.use.numeric.se3 import Array, Complex
from mahovik.use.vibration.scene import Scene
from mahovik.use.vibration.torus import Torus
from mahovik.use.vibration.view import FullMotion

ROUNDING = 1e-15
"""m/s2, rad/s2: smaller amplitudes of V* count as zero."""

LITTLE = 1e-6
"""Part of the other below which a displacement or turning of the carrier is not judged."""


@dataclass(frozen=True, eq=False)
class Balance:
    """A motion on the torus of the flywheels that turn.

    speeds    (N, rad/s); turning: indices of those that turn, in the order of the torus' phases
    c         (n, 2 m): coefficients of states y = (xi, u)
    h         (n, f): constant numbers along the free directions that keep the mean place
    hold      (6; N, N m): the constant wrench in E1 that they are, mean over phases
    left_out  largest remaining acceleration by the literal reference at SAMPLES random phases, part of the largest
    missing   (m, 6): coefficients of the pose (x, r) left out, of all k up to `missing_order`; None: too many
    missing_c (m, 2 m): of the states
    missing_w (m; rad/s): their k . phi', 0 for constants
    short     why no higher order was found though this one leaves out too much; empty: it does not
    """

    scene: Scene
    torus: Torus
    order: int
    speeds: Array
    phases: Array
    turning: tuple[int, ...]
    c: Complex
    h: Complex
    hold: Array
    left_out: float
    missing: Complex | None = None
    missing_c: Complex | None = None
    missing_w: Array = field(default_factory=lambda: np.zeros(0))
    missing_order: int = 0
    short: str = ""

    @property
    def pose_left_out(self) -> float:
        """Sum of the amplitudes left out of the pose as a part of the sum of those found: of x or r, the larger.

        0 where they are not known.
        """
        if self.missing is None:
            return 0.0
        radius = gyration_radius(self.scene)
        left, whole = (
            [
                size * float(np.linalg.norm(np.abs(c[moving, i : i + 3]).sum(axis=0)))
                for i, size in ((0, 1.0), (3, radius))
            ]
            for c, moving in ((self.missing, self.missing_w != 0.0), (self.pose, (self.torus.k != 0).any(axis=1)))
        )
        least = LITTLE * max(whole)
        return max(a / max(b, least) for a, b in zip(left, whole, strict=True)) if least else 0.0

    @property
    def pose(self) -> Complex:
        """(n, 6): coefficients of the pose (x, r), to first order."""
        m = self.scene.count
        return self.c[:, :m] @ self.scene.twist(np.eye(m))

    @property
    def frequencies(self) -> Array:
        """k . phi' (n; rad/s), of either sign."""
        return self.torus.frequencies(self.speeds[list(self.turning)])

    def states(self, theta: Array) -> tuple[Array, Array]:
        """(x, r, V) (m, 12) and V* (m, 6) at phases theta (m, turning; rad) of the flywheels that turn."""
        u_dot = self.torus.at(1j * self.frequencies[:, None] * self.c[:, self.scene.count :], theta)
        return self.scene.whole(self.torus.at(self.c, theta)), self.scene.twist(u_dot)

    def at_nodes(self, torus: Torus, c: Complex) -> tuple[Array, Array]:
        """(x, r, V) (M, 12) and V* (M, 6) at the nodes of a torus of these phases, of coefficients c of states."""
        rates = 1j * torus.frequencies(self.speeds[list(self.turning)])[:, None] * c
        return self.scene.whole(torus.values(c)), self.scene.twist(torus.values(rates)[:, self.scene.count :])

    def motions(self, theta: Array) -> tuple[Array, Array]:
        """Phases and speeds (m, N each) of all flywheels at phases theta (m, turning; rad)."""
        phi = np.tile(self.phases, (len(theta), 1))
        phi[:, list(self.turning)] = theta
        return phi, np.tile(self.speeds, (len(theta), 1))

    def state(self, theta: Array) -> State:
        """The state as `eval` and `simulate` take it, at phases theta (turning; rad)."""
        y = self.scene.whole(self.torus.at(self.c, theta[None]))[0]
        return state_at(self.scene, y, self.motions(theta[None])[0][0], self.speeds)


def rounding_wrench(scene: Scene, speeds: Array) -> Array:
    """(6; N, N m): wrench on the carrier in E1 about O1 that is rounding, at speeds (N, rad/s).

    In a balanced stand inertia forces of the flywheels about O1 cancel, and so do weights.
    """
    still = np.zeros((1, len(speeds)))
    Theta = scene.drive(still, still).Theta[0]
    fastest, g = np.abs(speeds).max(initial=0.0), np.linalg.norm(scene.stand.gravity)
    size = fastest**2 * np.abs(Theta[:, 3:]).sum(axis=1) + g * np.abs(scene.K[:, :3]).sum(axis=1)
    return np.asarray(4.0 * np.finfo(float).eps * size)  # of some sums and products


def rounding_rates(scene: Scene, speeds: Array) -> Array:
    """(m; m/s2, rad/s2): rates of the speeds in a state by that wrench."""
    still = np.zeros((1, len(speeds)))
    return np.asarray(np.abs(scene.drive(still, still).mobility[0]) @ rounding_wrench(scene, speeds))


def gyration_radius(scene: Scene) -> float:
    """Radius of gyration, m."""
    return float(np.sqrt(np.trace(scene.K[3:, 3:]) / np.trace(scene.K[:3, :3])))


def state_at(scene: Scene, y: Array, phi: Array, phi_dot: Array) -> State:
    """The state as `eval` takes it, of y = (x, r, V) (12)."""
    at = scene.twists(y[None])
    w, i, j, k = Rotation.from_matrix(at.C[0]).as_quat(scalar_first=True).tolist()
    X, Y, Z = at.O1[0].tolist()
    u, v, a, p, q, r = y[6:].tolist()
    rates = () if scene.stand.hold is None else tuple((np.linalg.pinv(scene.S) @ y[6:]).tolist())
    return replace(
        scene.rest,
        position=(X, Y, Z),
        angles=None,
        quaternion=(w, i, j, k),
        V=(u, v, a, p, q, r),
        u=rates,
        phi=tuple(phi.tolist()),
        phi_dot=tuple(phi_dot.tolist()),
    )


SAMPLES = 64
"""Random phases at which the literal reference is evaluated."""


def left_out(balance: Balance) -> float:
    """Largest difference of V* from the reference, part of its largest; turning counts by the radius of gyration."""
    scene = balance.scene
    theta = np.random.default_rng(1).uniform(0.0, 2.0 * np.pi, (SAMPLES, len(balance.turning)))
    y, V_dot = balance.states(theta)
    phi, phi_dot = balance.motions(theta)
    push = scene.effect_of_wrench(scene.drive(phi, phi_dot)) @ balance.torus.at(balance.h, theta)[:, :, None]
    at = [pieces(scene.stand, state_at(scene, y[i], phi[i], balance.speeds)) for i in range(len(theta))]
    exact = np.array([forward(moment, np.zeros(phi.shape[1])) for moment in at])
    scale = np.repeat([1.0, gyration_radius(scene)], 3)
    off = np.linalg.norm((V_dot - exact - scene.twist(push[:, scene.count :, 0])) * scale, axis=1).max()
    most = float(np.linalg.norm(exact * scale, axis=1).max())
    rounding = np.linalg.norm(scene.twist(rounding_rates(scene, balance.speeds)) * scale)
    return float(off) / most if most > max(ROUNDING, scene.noise, float(rounding)) else 0.0


def full_motion(balance: Balance, torus: Torus, c: Complex, h: Complex) -> FullMotion:
    """Values at the nodes of a torus, of coefficients c of states on it and h of what keeps the mean place."""
    return FullMotion(
        balance.scene,
        *balance.motions(torus.nodes),
        *balance.at_nodes(torus, c),
        torus.values(h) @ balance.scene.wrench.T,
    )
