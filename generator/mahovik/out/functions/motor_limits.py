"""Warnings on speeds given as options: beyond the no-load speeds of motors, or in rad/s where rpm may be meant."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import TYPE_CHECKING

from mahovik.contract.quantities import RPM
from mahovik.out.functions.notices import warn

if TYPE_CHECKING:
    from mahovik.core.stand.model import Stand

FAST = 1000.0
"""Speed in rad/s, 9549 rpm, above which a number without unit is asked about."""

_EXPONENT = re.compile(r"[eE][+-]?\d+")


def warn_of_speeds(stand: Stand, speeds: Sequence[float], texts: Sequence[str]) -> None:
    """Warn of `speeds` in rad/s, one per flywheel, beyond those of their motors.

    `texts` are the speeds as the user gave them: a number without unit is asked about if it is above FAST, or if rpm
    would bring it within.
    """
    given = list(zip(stand.flywheels, map(abs, speeds), texts, strict=True))
    beyond = [
        (wheel.name, speed, wheel.motor.speed, text)
        for wheel, speed, text in given
        if wheel.motor is not None and wheel.motor.speed is not None and speed > wheel.motor.speed * (1 + 1e-9)
    ]
    asked = ""
    if beyond:
        name, speed, limit, text = beyond[0]
        words = f"{name} turns at up to {RPM * speed:.6g} rpm, its motor at most at {RPM * limit:.6g}"
        if len(beyond) > 1:
            words += f"; {len(beyond)} flywheels in all are too fast"
        if _is_plain(text) and (speed / RPM <= limit or speed > FAST):
            asked = rpm_question(speed)
        warn(f"{words}{asked}")
    fast = [(wheel.name, speed) for wheel, speed, text in given if speed > FAST and _is_plain(text)]
    if fast and not asked:
        name, speed = fast[0]
        warn(f"{name} turns at up to {RPM * speed:.6g} rpm{rpm_question(speed)}")


def rpm_question(speed: float) -> str:
    """End of a warning: was a number without unit meant in rpm?"""
    return f"; numbers without unit are rad/s, {speed:.6g} rpm?"


def _is_plain(text: str) -> bool:
    """Whether a number was given, and without a unit."""
    return bool(text) and not any(letter.isalpha() for letter in _EXPONENT.sub("", text))
