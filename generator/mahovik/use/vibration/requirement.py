"""Requirements on a vibration: a limit of its RMS, peak or worst case, in all or within a band."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from mahovik.core.stand.units import Dimension, QuantityError, number
from mahovik.errors import UsageError
from mahovik.use.vibration.lines import Sums
from mahovik.use.vibration.view import Observable

WORDS = {
    "rad": "an angle",
    "rad/s": "an angular speed",
    "m": "a length",
    "m/s": "a velocity",
    "m/s2": "an acceleration",
    "rad/s2": "an angular acceleration",
    "N": "a force",
    "N m": "a moment",
}

_TEXT = re.compile(r"\s*(\w+)\s+([-+\d.eE]+\s*[^\d\s.eE+-].*?)(?:\s+([\d.eE+-]+)\s*\.\.\s*([\d.eE+-]+)\s*Hz)?\s*")


@dataclass(frozen=True)
class Requirement:
    """A limit (SI) of a sum, rms, peak or worst, on every axis and at every speed; band in Hz, None: all."""

    text: str
    sum: str
    limit: float
    band: tuple[float, float] | None = None


def read_requirements(texts: Sequence[str], seen: Observable) -> tuple[Requirement, ...]:
    """Requirements from texts, as "rms 0.1 arcsec" or "worst 2 um 10..200Hz". Raises UsageError."""
    unit = seen.measure.unit
    if texts and unit not in WORDS:
        raise UsageError(f"require: {seen.name} of a basis has no unit; expected another freedom, a point or a load")
    return tuple(_read(text, Dimension(WORDS[unit], unit.replace("s2", "s^2"))) for text in texts)


def _read(text: str, dimension: Dimension) -> Requirement:
    parts = _TEXT.fullmatch(text)
    if parts is None or parts[1].lower() not in Sums._fields:
        raise UsageError(
            f'require {text}: expected rms, peak or worst and a limit with a unit, as "rms 0.1 arcsec 10..200Hz"'
        )
    if ".." in parts[2]:
        raise UsageError(f'require {text}: expected a band with its unit at the end, as "10..200Hz"')
    try:
        limit = number(parts[2], dimension)
        band = (float(parts[3]), float(parts[4])) if parts[3] else None
    except (QuantityError, ValueError) as error:
        raise UsageError(f"require {text}: {error}") from None
    if not (limit > 0.0 and (band is None or 0.0 <= band[0] < band[1] < np.inf)):
        raise UsageError(f"require {text}: expected a limit above 0, and the lower frequency first")
    return Requirement(" ".join(text.split()), parts[1].lower(), limit, band)
