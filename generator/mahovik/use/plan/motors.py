"""Peaks of a programme above the limits of the motors in the stand file, in words."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from mahovik.core.stand.model import Stand

_PARTS = {"runup": "in the run-up", "rundown": "in the run-down"}


def motor_warnings(stand: Stand, report: Mapping[str, Any]) -> tuple[str, ...]:
    """One line for each peak torque (N m) or peak speed (rad/s) of a report that is above that of the motor.

    Peaks are compared with the motor's numbers, as they are in the file: its torque at speed is less, and its friction
    comes on top. A flywheel without a motor, or whose motor has no limit, has no line.
    """
    result = list(_exceeding(stand, report["peak_torque"], report["peak_speed"], ""))
    for key, where in _PARTS.items():
        if peak := report.get(key, {}).get("peak"):
            result += _exceeding(stand, peak["torque"], peak["speed"], f" {where}")
    return tuple(result)


def _exceeding(stand: Stand, torques: Sequence[float], speeds: Sequence[float], where: str) -> Iterator[str]:
    for flywheel, torque, speed in zip(stand.flywheels, torques, speeds, strict=True):
        motor = flywheel.motor
        if motor is None:
            continue
        asked = (("torque", "N m", torque, motor.peak), ("speed", "rad/s", speed, motor.no_load))
        for kind, unit, value, most in asked:
            if most is not None and value > most:
                yield (
                    f"{flywheel.name}: peak {kind}{where} {value:.4g} {unit} is above its motor's {most:.4g} {unit}, "
                    f"which the search does not heed: add {kind} to the bounds of the motion, or ask for less"
                )
