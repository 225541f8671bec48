"""Measured data for tests of identification: full equations in the steady state, read by the literal reference."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

import mahovik
from mahovik.out.api.stands import Stand, example
from mahovik.proof.reference import pieces
from mahovik.proof.reference.motion import points
from mahovik.stands import path
from mahovik.use.vibration.steady import quasiperiodic

Array = NDArray[np.float64]

SPEEDS = (150.0, -171.0)
AXES = "xyz"
POINT = """
[[point]]
name = "imu"  # six axes
position = ["10 cm", "5 cm", "2 cm"]
angles = [0.3, 0.2, 0.1]
"""
COUNTS = 4096

HEADER = ("time [s]", *(f"imu.acceleration.{x} [m/s2]" for x in AXES), *(f"imu.rate.{x} [rad/s]" for x in AXES))


@cache
def stand_text(flywheels: int = 2) -> str:
    """Text of bench8 with its first flywheels, encoders and an IMU."""
    parts = path("bench8").read_text(encoding="utf-8").split("[[flywheel]]")[: flywheels + 1]
    encoder = f"[flywheel.encoder]\ncounts = {COUNTS}\n\n"
    return "[[flywheel]]".join([parts[0], *(f"{part.rstrip()}\n{encoder}" for part in parts[1:])]) + POINT


def recorded(stand: Stand, speeds: Sequence[float] = SPEEDS, duration: float = 1.0, every: float = 2e-3) -> Array:
    """Time, six channels and phases (T, 7 + N), without noise, in the periodic steady state of constant speeds."""
    motion = quasiperiodic(stand, tuple(speeds))
    t = np.arange(0.0, duration, every)
    theta = 0.3 + 0.7 * np.arange(len(speeds)) + np.array(speeds) * t[:, None]
    rates = motion.scene.twist(motion.at(theta)[2][:, motion.scene.count :])
    rows = []
    for i in range(len(t)):
        seen = points(pieces(stand, motion.state(theta[i])), stand, rates[i])["imu"]
        rows.append([t[i], *seen["specific_force"], *seen["twist"][3:], *theta[i]])
    return np.array(rows)


def with_noise(rows: Array, ratio: float, seed: int) -> Array:
    """The rows with white noise of 1 / ratio of the rms of each channel, and phases as counts."""
    noisy = rows.copy()
    rng = np.random.default_rng(seed)
    sensors = noisy[:, 1:7]
    sensors += rng.normal(size=sensors.shape) * sensors.std(axis=0) / ratio
    noisy[:, 7:] = np.floor(noisy[:, 7:] * COUNTS / (2.0 * np.pi))
    return noisy


def write_csv(file: Path, rows: Array, quantity: str = "count") -> Path:
    """A file of data; the phases as `quantity`."""
    names = [*HEADER, *(f"w{i + 1}.{quantity}" for i in range(rows.shape[1] - 7))]
    lines = [",".join(names), *(",".join("" if np.isnan(x) else repr(x) for x in row) for row in rows.tolist())]
    file.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return file


def bench8(flywheels: int = 8) -> Stand:
    """bench8 with an IMU, of its first flywheels."""
    keys = example("bench8").to_dict()
    keys["flywheel"] = keys["flywheel"][:flywheels]
    keys["point"] = [{"name": "imu", "position": [0.15, 0.12, 0.08], "angles": [0.3, -0.2, 0.1]}]
    return Stand.from_dict(keys)


class Number(NamedTuple):
    """A row of the result of `identify`."""

    value: float
    standard_error: float
    before: float


def identified(
    stand: Stand | str, data: Path | str, free: str | Sequence[str], loss: Any = "linear"
) -> tuple[dict[str, Number], Any]:
    """Numbers by path, and the whole result."""
    result = mahovik.identify(stand, data=data, free=free, loss=loss)
    rows = zip(*(result[key].tolist() for key in ("path", "value", "standard_error", "before")), strict=True)
    return {path: Number(*figures) for path, *figures in rows}, result
