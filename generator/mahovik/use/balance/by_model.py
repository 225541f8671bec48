"""Correction masses of the flywheels of a stand, without trial weights: influences come from the linear model.

A unit static unbalance U at angle a from the flywheel's second axis, in the plane at x on its axis, turns with it:

    w = Re(U exp(i (phi + a)) W),  W = (phi'^2 f, (o + x e1) x phi'^2 f + f x g),  f = e2 - i e3

on the carrier about O1 in E1, with the flywheel's axes e1, e2, e3 at phase zero, its origin o and gravity g there. The
carrier's linear response to it (`use.vibration.plant`) gives the influence on each channel.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from mahovik.core.stand.balance import grade
from mahovik.core.stand.frames import pose
from mahovik.core.stand.model import Stand
from mahovik.errors import BalanceError
from mahovik.use.balance.choices import Choice
from mahovik.use.balance.first_order import FirstOrder, first_order
from mahovik.use.balance.influence import INDEPENDENT, Influence
from mahovik.use.balance.pieces import Made, choose_pieces
from mahovik.use.balance.polar import Array, Complex
from mahovik.use.measured import Recording
from mahovik.use.study.linear.model import places
from mahovik.use.vibration.plant import Plant
from mahovik.use.vibration.scene import Scene
from mahovik.use.vibration.view import View

HALF_WIDTH = 1.959963984540054
"""Standard errors of half a 95 % interval."""

RADIUS = math.sqrt(-2.0 * math.log(0.05))
"""Standard errors of one component in the radius of a circle that has 95 % of a plane's normal distribution."""


WORTH = 1e-3
"""Part of the vibration by which a piece has to lower it."""

SECONDS = 10.0
"""Wall-clock limit of the choice of pieces for one flywheel."""

Change = tuple[tuple[str, float, float], ...]
"""Quantity, and amplitude before and after."""


@dataclass(frozen=True, eq=False)
class First:
    """First order of a flywheel in one recording.

    recording  its number; channels  labels (K)
    measured   (K): x = Re(measured exp(i phi)); influence  (K, P): of 1 kg m in each plane
    """

    recording: int
    speed: float
    channels: tuple[str, ...]
    measured: Complex
    influence: Complex


@dataclass(frozen=True)
class Planes:
    """Planes of a flywheel: positions (P, m) on its axis, and pieces that can be made in each (P, or none: any)."""

    positions: tuple[float, ...] = (0.0,)
    choices: tuple[Choice | None, ...] = ()


@dataclass(frozen=True, eq=False)
class WheelBalance:
    """Corrections of one flywheel, kg m, in planes at positions (P, m) on its axis.

    speed     the fastest of the recordings, rad/s
    w         (P): corrections; their angle is counted from the flywheel's second axis
    covariance  (P, P): of w; a component of w_k has the variance covariance_kk
    fit       root of the mean square of what is left of the channels, in standard errors of their noise
    vibration   amplitude of the first order of each quantity (root of the sum of squares over its channels) as
                measured and with the corrections, at the fastest of the recordings
    firsts      in each recording in which the flywheel turns
    made        pieces that stand for w; None where any correction can be made
    simulated   as `vibration`, by the full equations with the unbalance found; empty: not simulated
    """

    name: str
    mass: float
    speed: float
    positions: tuple[float, ...]
    w: Complex
    covariance: Complex
    fit: float
    vibration: Change = ()
    firsts: tuple[First, ...] = ()
    made: Made | None = None
    simulated: Change = ()

    @property
    def applied(self) -> Complex:
        """Corrections that are made (P), kg m: those of the pieces, else w."""
        return self.w if self.made is None else self.made.w

    @property
    def residual(self) -> Array:
        """Unbalance (P, kg m) of each plane that is not exceeded after correction, with 95 % confidence."""
        return np.asarray(np.abs(self.applied - self.w) + RADIUS * self.error)

    @property
    def static_residual(self) -> float:
        """Static unbalance, kg m, likewise."""
        return abs(complex((self.applied - self.w).sum())) + RADIUS * self.static_error

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
        return grade(unbalance / self.mass * abs(self.speed)) if self.mass and unbalance else "-"


def balance_wheels(
    stand: Stand, recordings: Sequence[Recording], planes: Mapping[str, Planes]
) -> tuple[WheelBalance, ...]:
    """Corrections of all flywheels that turn in the recordings, from their first orders in all channels.

    planes   by flywheel; others have one plane, at the flywheel's origin

    Raises BalanceError, CheckError: the stand has no equilibrium.
    """
    found = [first_order(each, stand) for each in recordings]
    scene = Scene.of(stand)
    plant = Plant.of(scene)
    turning = np.flatnonzero(np.any([each.speeds != 0.0 for each in found], axis=0))
    return tuple(_wheel(scene, plant, int(s), planes.get(stand.flywheels[s].name, Planes()), found) for s in turning)


def _wheel(scene: Scene, plant: Plant, s: int, planes: Planes, found: Sequence[FirstOrder]) -> WheelBalance:
    flywheel, positions = scene.stand.flywheels[s], planes.positions
    firsts = tuple(
        First(
            k,
            float(each.speeds[s]),
            tuple(channel.label for channel in each.channels),
            each.X[:, s],
            influences(scene, plant, s, positions, each),
        )
        for k, each in enumerate(found)
        if each.speeds[s]
    )
    alpha, X = np.vstack([each.influence for each in firsts]), np.concatenate([each.measured for each in firsts])
    error = np.concatenate([found[each.recording].error[:, s] for each in firsts])
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
    fastest = max(firsts, key=lambda each: abs(each.speed))
    wheel = WheelBalance(flywheel.name, flywheel.mass, fastest.speed, positions, w, covariance, fit, firsts=firsts)
    if any(each is not None for each in planes.choices):
        wheel = replace(wheel, made=choose_pieces(_problem(wheel, planes.choices), WORTH, SECONDS))
    after = fastest.measured + fastest.influence @ wheel.applied
    return replace(wheel, vibration=amplitudes(fastest.channels, fastest.measured, after))


def _problem(wheel: WheelBalance, choices: tuple[Choice | None, ...]) -> Influence:
    """What pieces make least: the modelled vibration in all channels and recordings, by its principal components.

    Each quantity counts as a part of its largest amplitude. With A = U S V^H of the influences, the vibration that is
    left by corrections c has the components S V^H (c - w), and their root of the sum of squares is that over all rows.
    """
    alpha = np.vstack([each.influence for each in wheel.firsts])
    labels = np.array([_quantity(label) for each in wheel.firsts for label in each.channels])
    before = np.abs(alpha @ wheel.w)
    size = np.array([before[labels == label].max() for label in labels])
    size[size == 0.0] = np.inf
    _, s, Vh = np.linalg.svd(alpha / size[:, None], full_matrices=False)
    influence = s[:, None] * Vh
    return Influence(-influence @ wheel.w, influence, None, np.full(len(wheel.w), np.inf), choices)


def amplitudes(channels: Sequence[str], before: Complex, after: Complex) -> Change:
    """Root of the sum of squares over the channels (K labels) of each quantity, of first orders (K)."""
    rows = []
    for quantity in ("acceleration", "rate", "force", "moment"):
        own = [k for k, label in enumerate(channels) if _quantity(label) == quantity]
        if own:
            rows.append((quantity, float(np.linalg.norm(before[own])), float(np.linalg.norm(after[own]))))
    return tuple(rows)


def _quantity(label: str) -> str:
    """Quantity of a channel by its label; of a reaction force or moment, which differ in their unit."""
    _, quantity, component = label.rsplit(".", 2)
    return quantity if quantity != "reaction" else "force" if component in "xyz" else "moment"


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
    moved = plant.pose(found.speeds[None], omega, wrench[None, None])
    motion = moved[0, 0].T  # (P, 6)
    rows = []
    for channel in found.channels:
        if channel.quantity == "reaction":
            reaction = plant.reaction(found.speeds[None], omega, moved, wrench[None, None])[0, 0]
            rows.append(reaction["xyzkmn".index(channel.component)])
            continue
        (where,) = places(scene.stand, [channel.name])
        values = View.of(where, channel.quantity).by_pose(motion, omega[0])
        if channel.quantity == "acceleration":  # specific force: the point's axes turn against gravity
            values = values + np.cross(View.of(where, "angle").by_pose(motion, omega[0]), where.axes.T @ gravity)
        rows.append(values[:, "xyz".index(channel.component)])
    influence = np.array(rows)
    return influence.conj() if speed < 0.0 else influence
