"""Amplitude of a channel over orders of a flywheel and its speed, from windows of whole turns.

    X(o) = 2 sum w (x - mean) exp(-i o phi) / sum w,  w = Hann window over the angle, times the step of angle

so a vibration a cos(o phi) shows the amplitude a at its order o, at changing speed as well.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from mahovik.errors import InputError
from mahovik.use.measured.quantities import si_unit
from mahovik.use.measured.recording import Array, Channel, Recording

TURNS = 16
"""Turns of a window; lines of the map are 1/TURNS apart, and 2/TURNS wide at each side."""

LEAST_TURNS = 4
TOP = 4.0
"""Highest order by default."""

FEWEST = 32
"""Samples of a window."""

SHARE = 0.9
"""Part of half the sampling rate up to which orders are shown."""

TURN = 2.0 * np.pi


@dataclass(frozen=True, eq=False)
class OrderMap:
    """Amplitudes (S, R) in `unit` at speeds (S, rad/s, rising, without sign) and orders (R) of a flywheel.

    NaN above the sampling rate.
    """

    flywheel: str
    channel: str
    unit: str
    speed: Array
    orders: Array
    amplitude: Array

    @property
    def spectrum(self) -> Array:
        """(R,) Root of the mean square over the speeds, of those that have a value; NaN where none has."""
        square = np.nan_to_num(self.amplitude) ** 2
        count = np.isfinite(self.amplitude).sum(axis=0)
        return np.asarray(np.sqrt(square.sum(axis=0) / np.where(count, count, np.nan)))


def order_map(
    recording: Recording, flywheel: str, channel: Channel, values: Array | None = None, top: float = TOP
) -> OrderMap:
    """The map of a channel up to order `top`; of other values (T,) at its times, such as a model's, if given.

    Windows overlap by half. Raises InputError: the flywheel has no phase, or turns too little.
    """
    phase = recording.find(flywheel, "phase")
    if phase is None:
        raise InputError(f"{recording.source}: no phase of {flywheel}; give its phase, count or tacho")
    x = channel.values if values is None else values
    kept = np.isfinite(phase.values) & np.isfinite(channel.values) & np.isfinite(x)
    angle, x = np.abs(phase.values[kept] - phase.values[kept][:1]), x[kept]
    t = recording.t[kept]
    turns = float(angle[-1]) / TURN if len(angle) else 0.0
    if turns < LEAST_TURNS:
        few = f"{turns:.3g} turns with samples of {channel.label}, expected {LEAST_TURNS} or more"
        raise InputError(f"{recording.source}: {flywheel}: {few}")
    length = TURN * min(TURNS, turns)
    orders = np.arange(1, round(top * TURNS) + 1) / TURNS
    weight = np.abs(np.gradient(angle))
    speeds, rows = [], []
    for start in np.arange(0.0, angle[-1] - length * (1.0 - 1e-9), 0.5 * length):
        inside = np.flatnonzero((angle >= start) & (angle <= start + length))
        if len(inside) < FEWEST:
            continue
        phi = angle[inside]
        w = weight[inside] * (0.5 - 0.5 * np.cos(TURN * (phi - start) / length))
        own = x[inside] - w @ x[inside] / w.sum()
        amplitude = np.abs(np.exp(-1j * np.outer(orders, phi)) @ (w * own)) * 2.0 / w.sum()
        speed = float((phi[-1] - phi[0]) / (t[inside[-1]] - t[inside[0]]))
        rows.append(np.where(orders * speed <= SHARE * np.pi / recording.step, amplitude, np.nan))
        speeds.append(speed)
    if not rows:
        raise InputError(f"{recording.source}: {flywheel}: fewer than {FEWEST} samples in {TURNS} turns")
    sequence = np.argsort(speeds, kind="stable")
    return OrderMap(
        flywheel, channel.label, si_unit(channel), np.array(speeds)[sequence], orders, np.array(rows)[sequence]
    )


def merge_maps(maps: Sequence[OrderMap], rows: int = 24) -> OrderMap:
    """One map of several of the same channel and orders, with at most this many speeds.

    Speeds in the same part of the range are one row: the root of the mean square of their amplitudes.
    """
    speed = np.concatenate([each.speed for each in maps])
    amplitude = np.concatenate([each.amplitude for each in maps])
    low, span = float(speed.min()), float(np.ptp(speed))
    part = np.zeros(len(speed), dtype=int)
    if span > 0.01 * speed.max():
        part = np.minimum((rows * (speed - low) / span).astype(int), rows - 1)
    first = maps[0]
    found = [
        OrderMap(first.flywheel, first.channel, first.unit, speed[part == k], first.orders, amplitude[part == k])
        for k in np.unique(part)
    ]
    return OrderMap(
        first.flywheel,
        first.channel,
        first.unit,
        np.array([each.speed.mean() for each in found]),
        first.orders,
        np.array([each.spectrum for each in found]),
    )
