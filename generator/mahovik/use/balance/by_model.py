"""Correction masses of the flywheels of a stand, without trial weights: influences come from the linear model.

A unit static unbalance U at angle a from the flywheel's second axis, in the plane at x on its axis, turns with it:

    w = Re(U exp(i (phi + a)) W),  W = (phi'^2 f, (o + x e1) x phi'^2 f + f x g),  f = e2 - i e3

on the carrier about O1 in E1, with the flywheel's axes e1, e2, e3 at phase zero, its origin o and gravity g there. The
carrier's linear response to it (`use.vibration.plant`) gives the influence on each channel. What was measured is the
first order of each flywheel, x = Re(X exp(i phi)), by least squares over a recording; regressors are a constant, a
drift, and cos, sin of each flywheel's phase and of twice it.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from mahovik.core.stand.masses import grade, pose
from mahovik.core.stand.model import Stand
from mahovik.errors import BalanceError
from mahovik.use.balance.influence import INDEPENDENT
from mahovik.use.measured.clocks import Recording
from mahovik.use.measured.headers import AXES, LETTERS
from mahovik.use.numeric.se3 import Array, Complex
from mahovik.use.study.linear import places
from mahovik.use.vibration.lines import size_of
from mahovik.use.vibration.plant import Plant, Scene
from mahovik.use.vibration.view import View

HALF_WIDTH = 1.959963984540054
"""Standard errors of half a 95 % interval."""

RADIUS = math.sqrt(-2.0 * math.log(0.05))
"""Standard errors of one component in the radius of a circle that has 95 % of a plane's normal distribution."""

VARIES, PARTS = 0.01, 8
"""Largest relative change of a speed between the parts of a recording, and how many parts."""

LEAST = 1.0
"""rad/s: slower flywheels stand still."""

UNEXPLAINED = 10.0
"""Fit above which what is left is no noise: the model does not explain the data, and there are no intervals."""

FLOOR = 1e-9
"""Smallest standard error, as a part of the largest amplitude of a quantity."""


@dataclass(frozen=True, eq=False)
class FirstOrders:
    """First orders X (K, N) in the K channels of a recording, at speeds (N, rad/s; 0 where a flywheel has no phase).

    error   (K, N): standard error of each of the two components of X
    """

    speeds: Array
    channels: tuple[str, ...]
    X: Complex
    error: Array


def first_orders(recording: Recording, stand: Stand) -> FirstOrders:
    """First orders of a recording at constant speeds, none that of another or twice it. Raises BalanceError."""
    channels = tuple(label for label in recording.frame if quantity_of(label))
    if not channels:
        what = "a point" if stand.hold is None else "a point, and no reaction of the hold,"
        raise BalanceError([f"{recording.source}: no acceleration or rate of {what} of {stand.name}"])
    names, N = [wheel.name for wheel in stand.flywheels], len(stand.flywheels)
    phases = [recording.get(f"{name}.phase") for name in names]
    speeds = np.array([_speed(recording, name, phase) for name, phase in zip(names, phases, strict=True)])
    turning = np.flatnonzero(speeds).tolist()
    if not turning:
        raise BalanceError([f"{recording.source}: no flywheel turns; give phase, count or tacho of those that do"])
    _require_apart(recording, names, speeds)
    t = recording.t - recording.t.mean()
    columns = [np.ones(len(t)), t / (np.abs(t).max() or 1.0)]
    turned = [np.asarray(phases[s]) for s in turning]
    columns += [f(order * phase) for order in (1, 2) for phase in turned for f in (np.cos, np.sin)]
    regressors = np.column_stack(columns)
    X, error = np.zeros((len(channels), N), dtype=np.complex128), np.full((len(channels), N), np.inf)
    first = slice(2, 2 + 2 * len(turning), 2), slice(3, 3 + 2 * len(turning), 2)
    for k, label in enumerate(channels):
        values = recording.frame[label].to_numpy()
        there = np.isfinite(values) & np.isfinite(regressors).all(axis=1)
        R, x = regressors[there], values[there]
        if len(x) < 2 * R.shape[1]:
            many = f"{len(x)} samples with every phase, expected at least {2 * R.shape[1]}"
            raise BalanceError([f"{recording.source}: {label}: {many}; record for longer"])
        c = np.linalg.lstsq(R, x, rcond=None)[0]
        variance = float(np.sum((x - R @ c) ** 2)) / (len(x) - R.shape[1])
        spread = np.sqrt(variance * np.diag(np.linalg.pinv(R.T @ R)))
        X[k, turning] = c[first[0]] - 1j * c[first[1]]
        error[k, turning] = np.maximum(spread[first[0]], spread[first[1]])
    kinds = np.array([quantity_of(label) for label in channels])
    for kind in np.unique(kinds):
        rows = kinds == kind
        error[rows] = np.maximum(error[rows], FLOOR * np.abs(X[rows]).max(initial=0.0) or 1e-300)
    return FirstOrders(speeds, channels, X, error)


def quantity_of(label: str) -> str:
    """Quantity of a channel: acceleration, rate, force or moment; "" of others."""
    quantity, _, component = label.partition(".")[2].partition(".")
    if quantity == "reaction":
        return "force" if component in AXES else "moment"
    return quantity if component else ""


def _speed(recording: Recording, name: str, phase: Array | None) -> float:
    """Mean speed, rad/s; 0 if the flywheel stands still. Raises BalanceError: it is not constant."""
    there = np.flatnonzero(np.isfinite(phase)) if phase is not None else np.zeros(0, dtype=int)
    if phase is None or len(there) < 2 * PARTS:
        return 0.0
    ends = there[np.linspace(0, len(there) - 1, PARTS + 1).astype(int)]
    parts = np.diff(phase[ends]) / np.diff(recording.t[ends])
    mean = float((phase[ends[-1]] - phase[ends[0]]) / (recording.t[ends[-1]] - recording.t[ends[0]]))
    if abs(mean) < LEAST:
        return 0.0
    change = float(np.abs(parts / mean - 1.0).max())
    if change > VARIES:
        words = f"speed changes by {100 * change:.3g} %, expected at most {100 * VARIES:g} %; record at constant speed"
        raise BalanceError([f"{recording.source}: {name}: {words}"])
    return mean


def _require_apart(recording: Recording, names: Sequence[str], speeds: Array) -> None:
    """Raise BalanceError if the recording cannot tell a flywheel from another, or from twice the phase of another."""
    beat, size = 2.0 * np.pi / float(np.ptp(recording.t)), np.abs(speeds)
    advice = f"{beat:.3g} rad/s, one beat; let one turn faster, or record longer"
    turning = np.flatnonzero(speeds).tolist()
    for s in turning:
        for r in turning:
            if s < r and abs(size[s] - size[r]) < beat:
                reason = f"{names[s]} and {names[r]}: speeds differ by less than {advice}"
                raise BalanceError([f"{recording.source}: {reason}"])
            if abs(2.0 * size[r] - size[s]) < beat:
                reason = f"{names[s]} turns at twice the speed of {names[r]} within {advice}"
                raise BalanceError([f"{recording.source}: {reason}"])


@dataclass(frozen=True, eq=False)
class WheelBalance:
    """Corrections of one flywheel, kg m, in planes at positions (P, m) on its axis.

    speed     the fastest of the recordings, rad/s
    w         (P): corrections; their angle is counted from the flywheel's second axis
    covariance  (P, P): of w; a component of w_k has the variance covariance_kk
    fit       root of the mean square of what is left of the channels, in standard errors of their noise
    vibration   by quantity: largest length of the vector of the first order, at the place where it is largest, as
                measured and with the corrections, SI; and half its 95 % interval, at the fastest of the recordings
    """

    name: str
    mass: float
    speed: float
    positions: tuple[float, ...]
    w: Complex
    covariance: Complex
    fit: float
    vibration: Mapping[str, tuple[float, float, float]]

    @property
    def residual(self) -> Array:
        """Unbalance (P, kg m) of each plane that is not exceeded after correction, with 95 % confidence."""
        return np.asarray(RADIUS * self.error)

    @property
    def static_residual(self) -> float:
        """Static unbalance, kg m, likewise."""
        return RADIUS * self.static_error

    @property
    def error(self) -> Array:
        """Standard error of each component of w (P), kg m; NaN where the model does not explain the data."""
        return np.asarray(np.sqrt(np.diag(self.covariance).real))

    @property
    def warning(self) -> str:
        """What speaks against the corrections, and what to do; "" if nothing does."""
        more = [
            f"{kind} rises from {before:.3g} to {after:.3g}"
            for kind, (before, after, noise) in self.vibration.items()
            if after > before + noise
        ]
        if self.fit > UNEXPLAINED:
            more.insert(0, f"what the corrections leave is {self.fit:.0f} times the noise of the data")
        if not more:
            return ""
        plane = len(self.positions) == 1
        advice = (
            f"one plane cannot remove a dynamic unbalance: give plane {self.name}=a,b"
            if plane
            else ("the stand is not that of the data: compare its numbers, places of sensors and speeds")
        )
        return f"{self.name}: {', '.join(more)}; {advice}"

    @property
    def static(self) -> complex:
        """Static unbalance of the flywheel as it was measured, kg m."""
        return -complex(self.w.sum())

    @property
    def static_error(self) -> float:
        """Standard error of each component of `static`, kg m."""
        return math.sqrt(np.maximum(float(self.covariance.sum().real), 0.0))

    def grade(self, unbalance: float) -> str:
        """ISO 21940-11 grade of a static unbalance (kg m) at the flywheel's speed; "-" without mass or unbalance."""
        return grade(unbalance / self.mass * abs(self.speed)) if self.mass and unbalance > 0.0 else "-"


def balance_wheels(
    stand: Stand, recordings: Sequence[Recording], planes: Mapping[str, Sequence[float]]
) -> tuple[WheelBalance, ...]:
    """Corrections of all flywheels that turn in the recordings, from their first orders in all channels.

    planes   positions (m) on its axis by flywheel; others have one plane, at the flywheel's origin

    Raises BalanceError, CheckError: the stand has no equilibrium.
    """
    measured = [first_orders(recording, stand) for recording in recordings]
    scene = Scene.of(stand)
    plant = Plant.of(scene)
    turning = np.flatnonzero(np.any([recording.speeds != 0.0 for recording in measured], axis=0)).tolist()
    return tuple(_wheel(scene, plant, s, planes.get(stand.flywheels[s].name, (0.0,)), measured) for s in turning)


def _wheel(
    scene: Scene, plant: Plant, s: int, positions: Sequence[float], measured: Sequence[FirstOrders]
) -> WheelBalance:  # fmt: skip
    flywheel, P = scene.stand.flywheels[s], len(positions)
    seen = sorted((orders for orders in measured if orders.speeds[s]), key=lambda orders: -abs(orders.speeds[s]))
    alpha = np.vstack([influences(scene, plant, s, positions, orders) for orders in seen])
    X, error = (np.concatenate([getattr(orders, key)[:, s] for orders in seen]) for key in ("X", "error"))
    weighted, M = alpha / error[:, None], len(X)
    size = np.linalg.norm(weighted, axis=0)
    sigma = np.linalg.svd(weighted / np.where(size, size, 1.0), compute_uv=False)
    if M < P or not np.all(size) or sigma[-1] < INDEPENDENT * sigma[0]:
        at = ", ".join(f"{1e3 * x:g} mm" for x in positions)
        words = f"planes at {at} act alike on these channels; use fewer planes or more sensors"
        raise BalanceError([f"{flywheel.name}: {words}"])
    w = np.linalg.lstsq(weighted, -X / error, rcond=None)[0]
    fit = math.sqrt(float(np.sum(np.abs((X + alpha @ w) / error) ** 2)) / (2.0 * (M - P))) if M > P else 0.0
    widened = max(fit, 1.0) if fit <= UNEXPLAINED else math.nan
    covariance = np.asarray(np.linalg.inv(weighted.conj().T @ weighted) * widened**2, dtype=np.complex128)
    speed = float(seen[0].speeds[s])
    after = X + alpha @ w
    vectors: dict[str, dict[str, list[int]]] = {}  # channels of each vector, by quantity and place
    for k, label in enumerate(seen[0].channels):
        vectors.setdefault(quantity_of(label), {}).setdefault(label.partition(".")[0], []).append(k)
    vibration = {}
    for kind, rows in vectors.items():
        before, left = (max(float(size_of(values[of])) for of in rows.values()) for values in (X, after))
        vibration[kind] = before, left, HALF_WIDTH * max(float(np.linalg.norm(error[of])) for of in rows.values())
    return WheelBalance(flywheel.name, flywheel.mass, speed, tuple(positions), w, covariance, fit, vibration)


def influences(scene: Scene, plant: Plant, s: int, positions: Sequence[float], measured: FirstOrders) -> Complex:
    """Influence (K, P) of 1 kg m at angle zero in each plane on the channels, at the speeds of a recording."""
    speeds, speed = measured.speeds[None], float(measured.speeds[s])
    omega = np.abs(speeds[:, [s]])
    origin, axes = pose(scene.stand, scene.stand.flywheels[s])
    gravity = scene.chart.frame.C.T @ np.array(scene.stand.gravity)
    f = axes[:, 1] - 1j * axes[:, 2]
    force = speed**2 * f
    moments = [np.cross(origin + x * axes[:, 0], force) + np.cross(f, gravity) for x in positions]
    wrench = np.array([np.concatenate([force, moment]) for moment in moments]).T[None, None]
    if speed < 0.0:
        wrench = wrench.conj()
    moved = plant.pose(speeds, omega, wrench)
    motion = moved[0, 0].T  # (P, 6)
    rows = []
    for name, quantity, component in (label.split(".") for label in measured.channels):
        if quantity == "reaction":
            rows.append(plant.reaction(speeds, omega, moved, wrench)[0, 0][LETTERS.index(component)])
            continue
        (where,) = places(scene.stand, [name])
        values = View.of(where, quantity).by_pose(motion, omega[0])
        if quantity == "acceleration":  # specific force: the point's axes turn against gravity
            values = values + np.cross(View.of(where, "angle").by_pose(motion, omega[0]), where.axes.T @ gravity)
        rows.append(values[:, AXES.index(component)])
    influence = np.array(rows)
    return influence.conj() if speed < 0.0 else influence
