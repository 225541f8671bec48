"""The warning on speeds, given as options, beyond the no-load speeds of motors."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from typing import TYPE_CHECKING

import click

if TYPE_CHECKING:
    from mahovik.core.stand.model import Stand

_RPM = 30 / math.pi
_EXPONENT = re.compile(r"[eE][+-]?\d+")


def warn_beyond_motors(stand: Stand, speeds: Sequence[float], texts: Sequence[str]) -> None:
    """Warn, in one line on standard error, of `speeds` in rad/s, one per flywheel, beyond those of their motors.

    `texts` are the speeds as the user gave them: a number without unit that rpm would bring within is asked about.
    """
    beyond = [
        (wheel.name, abs(speed), wheel.motor.speed, text)
        for wheel, speed, text in zip(stand.flywheels, speeds, texts, strict=True)
        if wheel.motor is not None and wheel.motor.speed is not None and abs(speed) > wheel.motor.speed * (1 + 1e-9)
    ]
    if not beyond:
        return
    name, speed, limit, text = beyond[0]
    words = f"{name} turns at up to {_RPM * speed:.6g} rpm, its motor at most at {_RPM * limit:.6g}"
    if len(beyond) > 1:
        words += f"; {len(beyond)} flywheels in all are too fast"
    if _is_plain(text) and speed / _RPM <= limit:
        words += f"; numbers without unit are rad/s, {speed:.6g} rpm?"
    click.echo(f"warning: {words}", err=True)


def _is_plain(text: str) -> bool:
    return not any(letter.isalpha() for letter in _EXPONENT.sub("", text))
