"""Requirements on the servos of a stand, in SI. Gains are computed from it (use/control/servo.py)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

COORDINATES = ("x", "y", "z", "psi", "theta", "phi")
"""Coordinates of a free carrier: O1 in E0, then the three angles of the stand's sequence."""


@dataclass(frozen=True)
class Trim:
    """Slow correction of the programme by measured motion of the carrier, harmonic by harmonic.

    harmonics     the mean and harmonics 1..harmonics are corrected; of a programme's period
    gain          part of the measured error that one correction removes, above 0, at most 1
    coordinates   which are measured, rising: numbers in COORDINATES, of a held carrier of its freedoms
    settling      periods that the carrier has to settle after a correction
    averaging     periods over which is measured
    limit         largest magnitude of each corrected coefficient, rad
    """

    harmonics: int
    gain: float
    coordinates: tuple[int, ...]
    settling: int
    averaging: int
    limit: float


@dataclass(frozen=True)
class Servo:
    """A servo on each rotor: PI or P on the angle, P on the speed, with torques of the programme as feedforward.

    period         between samples, s
    latency        from a sample until its torque acts, s
    bandwidth      natural frequency of the loop's pair of poles, rad/s
    damping_ratio  of this pair
    integral       speed at which a steady error goes away, rad/s; None: no integral
    speed_filter   corner of a low-pass on the measured speed error, rad/s; None: none
    feedforward    are the drive torques of the programme added?
    friction       is the friction that the stand file tells made up for?
    torque_limit   of each flywheel, N m; infinite where there is none
    torque_rate    largest change of each torque in time, N m/s; infinite where there is none
    encoder        "stand": angles and speeds come from the encoders of the stand file; "ideal": they are exact
    trim           None: off
    """

    name: str
    period: float
    latency: float
    bandwidth: float
    damping_ratio: float
    integral: float | None
    speed_filter: float | None
    feedforward: bool
    friction: bool
    torque_limit: tuple[float, ...]
    torque_rate: tuple[float, ...]
    encoder: Literal["ideal", "stand"]
    trim: Trim | None = None
