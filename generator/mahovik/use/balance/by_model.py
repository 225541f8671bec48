"""Correction masses of the flywheels of a stand, without trial weights: influences come from the linear model.

A unit static unbalance U at angle a from the flywheel's second axis, in the plane at x on its axis, turns with it:

    w = Re(U exp(i (phi + a)) W),  W = (phi'^2 f, (o + x e1) x phi'^2 f + f x g),  f = e2 - i e3

on the carrier about O1 in E1, with the flywheel's axes e1, e2, e3 at phase zero, its origin o and gravity g there. The
carrier's linear response to it (`use.study.jitter.plant`) gives the influence on each channel.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from mahovik.core.stand.balance import grade_words
from mahovik.core.stand.frames import pose
from mahovik.core.stand.model import Stand
from mahovik.errors import BalanceError
from mahovik.use.balance.first_order import FirstOrder, first_order
from mahovik.use.balance.influence import INDEPENDENT
from mahovik.use.balance.polar import Array, Complex
from mahovik.use.measured import Recording
from mahovik.use.study.jitter.plant import Plant
from mahovik.use.study.jitter.quantity import View
from mahovik.use.study.linear.model import places
from mahovik.use.study.response.scene import Scene

HALF_WIDTH = 1.959963984540054
"""Standard errors of half a 95 % interval."""

RADIUS = math.sqrt(-2.0 * math.log(0.05))
"""Standard errors of one component in the radius of a circle that has 95 % of a plane's normal distribution."""


@dataclass(frozen=True, eq=False)
class WheelBalance:
    """Corrections of one flywheel, kg m, in planes at positions (P, m) on its axis.

    speed     the fastest of the recordings, rad/s
    w         (P): corrections; their angle is counted from the flywheel's second axis
    covariance  (P, P): of w; a component of w_k has the variance covariance_kk
    fit       root of the mean square of what is left of the channels, in standard errors of their noise
    vibration   quantity, and amplitude of the first order (root of the sum of squares over its channels) as measured
                and with the corrections, at the fastest of the recordings
    """

    name: str
    mass: float
    speed: float
    positions: tuple[float, ...]
    w: Complex
    covariance: Complex
    fit: float
    vibration: tuple[tuple[str, float, float], ...] = ()

    @property
    def error(self) -> Array:
        """Standard error of each component of w (P), kg m."""
        return np.asarray(np.sqrt(np.diag(self.covariance).real))

    @property
    def static(self) -> complex:
        """Static unbalance that was found, kg m."""
        return -complex(self.w.sum())

    @property
    def static_error(self) -> float:
        """Standard error of each component of `static`, kg m."""
        return math.sqrt(max(float(self.covariance.sum().real), 0.0))

    def grade(self, unbalance: float) -> str:
        """ISO 21940-11 grade of a static unbalance (kg m) at the flywheel's speed; "-" without mass or unbalance."""
        return grade_words(1e3 * unbalance / self.mass * abs(self.speed)) if self.mass and unbalance else "-"


def balance_wheels(
    stand: Stand, recordings: Sequence[Recording], planes: Mapping[str, Sequence[float]]
) -> tuple[WheelBalance, ...]:
    """Corrections of all flywheels that turn in the recordings, from their first orders in all channels.

    planes   positions on the axis (m) by flywheel; others have one plane, at the flywheel's origin

    Raises BalanceError, CheckError: the stand has no equilibrium.
    """
    found = [first_order(each, stand) for each in recordings]
    scene = Scene.of(stand)
    plant = Plant.of(scene)
    turning = np.flatnonzero(np.any([each.speeds != 0.0 for each in found], axis=0))
    return tuple(
        _wheel(scene, plant, int(s), tuple(planes.get(stand.flywheels[s].name, (0.0,))), found) for s in turning
    )


def _wheel(
    scene: Scene, plant: Plant, s: int, positions: tuple[float, ...], found: Sequence[FirstOrder]
) -> WheelBalance:
    flywheel = scene.stand.flywheels[s]
    rows = [each for each in found if each.speeds[s]]
    alpha = np.vstack([influences(scene, plant, s, positions, each) for each in rows])
    X, error = (np.concatenate([getattr(each, name)[:, s] for each in rows]) for name in ("X", "error"))
    weighted, M, P = alpha / error[:, None], len(X), len(positions)
    size = np.linalg.norm(weighted, axis=0)
    sizes = np.linalg.svd(weighted / np.where(size, size, 1.0), compute_uv=False)
    if M < P or not np.all(size) or sizes[-1] < INDEPENDENT * sizes[0]:
        at = ", ".join(f"{1e3 * x:g} mm" for x in positions)
        words = f"planes at {at} act alike on these channels; use fewer planes or more sensors"
        raise BalanceError([f"{flywheel.name}: {words}"])
    w = np.linalg.lstsq(weighted, -X / error, rcond=None)[0]
    left = (X + alpha @ w) / error
    fit = math.sqrt(float(np.sum(np.abs(left) ** 2)) / (2.0 * (M - P))) if M > P else 0.0
    covariance = np.asarray(np.linalg.inv(weighted.conj().T @ weighted) * max(fit, 1.0) ** 2, dtype=np.complex128)
    speed = max((float(each.speeds[s]) for each in rows), key=abs)
    fastest = max(rows, key=lambda each: abs(each.speeds[s]))
    seen = _vibration(fastest, s, influences(scene, plant, s, positions, fastest) @ w)
    return WheelBalance(flywheel.name, flywheel.mass, speed, positions, w, covariance, fit, seen)


def _vibration(found: FirstOrder, s: int, change: Complex) -> tuple[tuple[str, float, float], ...]:
    """Quantity, amplitude before and after a change of the first order of flywheel s."""
    rows = []
    for quantity in ("acceleration", "rate"):
        own = [k for k, channel in enumerate(found.channels) if channel.quantity == quantity]
        if own:
            before, after = found.X[own, s], found.X[own, s] + change[own]
            rows.append((quantity, float(np.linalg.norm(before)), float(np.linalg.norm(after))))
    return tuple(rows)


def influences(scene: Scene, plant: Plant, s: int, positions: Sequence[float], found: FirstOrder) -> Complex:
    """Influence (K, P) of 1 kg m at angle zero in each plane on the channels, at the speeds of a recording."""
    speed, omega = float(found.speeds[s]), np.array([[abs(found.speeds[s])]])
    origin, axes = pose(scene.stand, scene.stand.flywheels[s])
    gravity = scene.chart.C.T @ np.array(scene.stand.gravity)
    f = axes[:, 1] - 1j * axes[:, 2]
    force = speed**2 * f
    moments = [np.cross(origin + x * axes[:, 0], force) + np.cross(f, gravity) for x in positions]
    wrench = np.array([np.concatenate([force, moment]) for moment in moments]).T
    if speed < 0.0:
        wrench = wrench.conj()
    motion = plant.pose(found.speeds[None], omega, wrench[None, None])[0, 0].T  # (P, 6)
    rows = []
    for channel in found.channels:
        (where,) = places(scene.stand, [channel.name])
        values = View.of(where, channel.quantity).by_pose(motion, omega[0])
        if channel.quantity == "acceleration":  # specific force: the point's axes turn against gravity
            values = values + np.cross(View.of(where, "angle").by_pose(motion, omega[0]), where.axes.T @ gravity)
        rows.append(values[:, "xyz".index(channel.component)])
    influence = np.array(rows)
    return influence.conj() if speed < 0.0 else influence
