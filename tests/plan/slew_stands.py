"""Satellites with balanced wheels, whose bang-bang limits are known, and slews of them."""

from __future__ import annotations

import json
from collections.abc import Sequence
from functools import cache
from typing import Any

import numpy as np

from mahovik import stands
from mahovik.core.motion.motion_file import read_motion_or_slew
from mahovik.core.motion.required import Slew
from mahovik.core.stand import Stand, load, loads

PYRAMID = ((1, 1, 1), (-1, 1, 1), (-1, -1, 1), (1, -1, 1))
ATTITUDE = ["wx", "wy", "wz"]


def satellite(axes: Sequence[Sequence[float]], motor: str = "{ torque = 0.2 }", extra: str = "") -> Stand:
    """50 kg with balanced wheels through the centre of mass; `sensor` is off it, `middle` at it."""
    text = (
        'schema = 1\nname = "sat"\n[carrier]\nmass = 50\n'
        "inertia = [[2.4, 0.1, -0.05], [0.1, 2.2, 0.08], [-0.05, 0.08, 1.9]]\n"
        '[[point]]\nname = "sensor"\nposition = [0, 0.1, 0.3]\n[[point]]\nname = "middle"\nposition = [0, 0, 0]\n'
    )
    for k, axis in enumerate(axes):
        zero = np.eye(3)[int(np.argmin(np.abs(axis)))].tolist()
        text += (
            f'[[flywheel]]\nname = "w{k + 1}"\naxis = {list(map(float, axis))}\nzero = {zero}\nmass = 2\n'
            f"spin_inertia = 0.02\ntransverse_inertia = 0.011\nmotor = {motor}\n"
        )
    return loads(text + extra)


@cache
def sat4() -> Stand:
    return load(stands.path("sat4"))


def slew(stand: Stand, **keys: Any) -> Slew:
    motion = read_motion_or_slew(json.dumps({"schema": 1, "type": "slew", "rows": ATTITUDE} | keys), stand, "turn")
    assert isinstance(motion, Slew)
    return motion


def about(axis: Sequence[float] | np.ndarray, angle: float) -> dict[str, list[float]]:
    """`end` after a turn by an angle (rad) about an axis of E1, from the attitude of E0."""
    unit = np.array(axis) / np.linalg.norm(axis)
    return {"quaternion": [float(np.cos(angle / 2)), *(np.sin(angle / 2) * unit).tolist()]}


def inertia(stand: Stand) -> np.ndarray:
    """Inertia about the centre of mass less that of the spins, which drive torques turn (3, 3; kg m2)."""
    J = np.array(stand.carrier.inertia)
    for wheel in stand.flywheels:
        mounting = np.array(wheel.mounting.axis)  # type: ignore[union-attr]
        unit = mounting / np.linalg.norm(mounting)
        J = J + 0.011 * (np.eye(3) - np.outer(unit, unit))
    return J
