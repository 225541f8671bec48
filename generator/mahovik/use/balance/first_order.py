"""First order of each flywheel in measured channels: x = Re(X exp(i phi)), least squares over one recording.

Regressors are a constant, a drift, and cos, sin of each flywheel's phase and of twice it. The flywheels turn at
constant speeds; none is that of another, or twice it.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mahovik.core.stand.model import Stand
from mahovik.errors import BalanceError
from mahovik.use.balance.polar import Array, Complex
from mahovik.use.measured import Channel, Recording

VARIES = 0.01
"""Largest relative change of a speed, between the parts of a recording."""

PARTS = 8
LEAST = 1.0
"""rad/s: slower flywheels stand still."""

FLOOR = 1e-9
"""Smallest standard error, as a part of the largest amplitude of a quantity."""


@dataclass(frozen=True, eq=False)
class FirstOrder:
    """First orders X (K, N) in the K channels of a recording, at speeds (N, rad/s; 0 where a flywheel has no phase).

    error   (K, N): standard error of each of the two components of X
    """

    source: str
    speeds: Array
    channels: tuple[Channel, ...]
    X: Complex
    error: Array


def first_order(recording: Recording, stand: Stand) -> FirstOrder:
    """First orders of a recording. Raises BalanceError."""
    channels = tuple(c for c in recording.channels if c.quantity in ("acceleration", "rate", "reaction"))
    if not channels:
        what = "a point" if stand.hold is None else "a point, and no reaction of the hold,"
        raise BalanceError([f"{recording.source}: no acceleration or rate of {what} of {stand.name}"])
    phases = {s: c.values for s, f in enumerate(stand.flywheels) if (c := recording.find(f.name, "phase")) is not None}
    speeds = np.zeros(len(stand.flywheels))
    for s, phase in phases.items():
        speeds[s] = _speed(recording, stand.flywheels[s].name, phase)
    turning = [int(s) for s in np.flatnonzero(speeds)]
    if not turning:
        raise BalanceError([f"{recording.source}: no flywheel turns; give phase, count or tacho of those that do"])
    _separate(recording, stand, speeds, turning)
    t = recording.t - recording.t.mean()
    columns = [np.ones(len(t)), t / (np.abs(t).max() or 1.0)]
    for order in (1, 2):
        columns += [f(order * phases[s]) for s in turning for f in (np.cos, np.sin)]
    regressors = np.column_stack(columns)
    X = np.zeros((len(channels), len(speeds)), dtype=np.complex128)
    error = np.full(X.shape, np.inf)
    for k, channel in enumerate(channels):
        X[k, turning], error[k, turning] = _fit(recording, regressors, channel, len(turning))
    for quantity in ("acceleration", "rate", "force", "moment"):
        rows = [k for k, c in enumerate(channels) if _kind(c) == quantity]
        if rows:
            error[rows] = np.maximum(error[rows], FLOOR * np.abs(X[rows]).max(initial=0.0) or 1e-300)
    return FirstOrder(recording.source, speeds, channels, X, error)


def _kind(channel: Channel) -> str:
    """Quantity of a channel; of a reaction force or moment."""
    if channel.quantity != "reaction":
        return channel.quantity
    return "force" if channel.component in "xyz" else "moment"


def _fit(recording: Recording, regressors: Array, channel: Channel, count: int) -> tuple[Complex, Array]:
    kept = np.isfinite(channel.values) & np.isfinite(regressors).all(axis=1)
    R, x = regressors[kept], channel.values[kept]
    if len(x) < 2 * R.shape[1]:
        many = f"{len(x)} samples with every phase, expected at least {2 * R.shape[1]}"
        raise BalanceError([f"{recording.source}: {channel.label}: {many}; record for longer"])
    coefficients = np.linalg.lstsq(R, x, rcond=None)[0]
    variance = float(np.sum((x - R @ coefficients) ** 2)) / (len(x) - R.shape[1])
    spread = np.sqrt(variance * np.diag(np.linalg.pinv(R.T @ R)))
    c, s = coefficients[2 : 2 + 2 * count : 2], coefficients[3 : 3 + 2 * count : 2]
    return np.asarray(c - 1j * s), np.maximum(spread[2 : 2 + 2 * count : 2], spread[3 : 3 + 2 * count : 2])


def _speed(recording: Recording, name: str, phase: Array) -> float:
    """Mean speed, rad/s; 0 if the flywheel stands still. Raises BalanceError: it is not constant."""
    kept = np.flatnonzero(np.isfinite(phase))
    if len(kept) < 2 * PARTS:
        return 0.0
    ends = kept[np.linspace(0, len(kept) - 1, PARTS + 1).astype(int)]
    parts = np.diff(phase[ends]) / np.diff(recording.t[ends])
    mean = float((phase[ends[-1]] - phase[ends[0]]) / (recording.t[ends[-1]] - recording.t[ends[0]]))
    if abs(mean) < LEAST:
        return 0.0
    change = float(np.abs(parts / mean - 1.0).max())
    if change > VARIES:
        words = f"speed changes by {100 * change:.3g} %, expected at most {100 * VARIES:g} %; record at constant speed"
        raise BalanceError([f"{recording.source}: {name}: {words}"])
    return mean


def _separate(recording: Recording, stand: Stand, speeds: Array, turning: list[int]) -> None:
    """Raise BalanceError if the recording cannot tell a flywheel from another, or from twice the phase of another."""
    beat = 2.0 * np.pi / float(np.ptp(recording.t))
    for i, s in enumerate(turning):
        for r in turning[i + 1 :]:
            if abs(abs(speeds[s]) - abs(speeds[r])) < beat:
                names = f"{stand.flywheels[s].name} and {stand.flywheels[r].name}"
                words = f"speeds differ by less than {beat:.3g} rad/s, one beat; let one turn faster, or record longer"
                raise BalanceError([f"{recording.source}: {names}: {words}"])
    for s in turning:
        for r in turning:
            if abs(2.0 * abs(speeds[r]) - abs(speeds[s])) < beat:
                names = f"{stand.flywheels[s].name} turns at twice the speed of {stand.flywheels[r].name}"
                words = f"within {beat:.3g} rad/s, one beat; let one turn faster, or record longer"
                raise BalanceError([f"{recording.source}: {names} {words}"])
