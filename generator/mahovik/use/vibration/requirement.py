"""Requirements on jitter: limits of RMS, RSS or worst case, in all or within a band; met or not, margin, worst speed.

As a text, "rms 0.1 arcsec" or "worst 2 um 10..200Hz", or as a CSV file with a row per limit:
sum, from [Hz], to [Hz], limit [arcsec].
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from mahovik.core.stand.content import is_file
from mahovik.core.stand.units import Dimension, QuantityError, number
from mahovik.errors import UsageError
from mahovik.use.numeric import Array
from mahovik.use.vibration.csv_table import TEXT, read_columns, refuse
from mahovik.use.vibration.study import Jitter
from mahovik.use.vibration.view import Quantity

SUMS = ("rms", "rss", "worst")

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


@dataclass(frozen=True)
class Requirement:
    """A limit (SI) of a sum, on every axis; from `low` to `high` Hz."""

    sum: str
    limit: float
    low: float = 0.0
    high: float = np.inf

    @property
    def text(self) -> str:
        """In words, without its limit."""
        return self.sum if self.low == 0.0 and self.high == np.inf else f"{self.sum} {self.low:g}..{self.high:g} Hz"


@dataclass(frozen=True, eq=False)
class Verdict:
    """How a requirement is met.

    value    largest over speeds and axes; margin: limit / value - 1, below 0 where it fails
    step, axis   where it is largest; share (S): largest value over the axes at each speed, part of the limit
    """

    requirement: Requirement
    value: float
    step: int
    axis: int
    share: Array

    @property
    def met(self) -> bool:
        """Whether the value is within the limit."""
        return self.value <= self.requirement.limit

    @property
    def margin(self) -> float:
        """limit / value - 1."""
        return self.requirement.limit / self.value - 1.0 if self.value else np.inf


_TEXT = re.compile(r"\s*(\w+)\s+([-+\d.eE]+\s*[^\d\s.eE+-].*?)(?:\s+([\d.eE+-]+)\s*\.\.\s*([\d.eE+-]+)\s*Hz)?\s*")


def read_requirements(texts: Sequence[str], quantity: Quantity) -> tuple[Requirement, ...]:
    """Requirements from texts and files of a mask. Raises UsageError, JitterFileError."""
    found: list[Requirement] = []
    for text in texts:
        path = Path(text)
        if path.suffix.lower() == ".csv" or is_file(path):
            found += _read_mask(path, quantity)
        else:
            found.append(_read_text(text, quantity))
    return tuple(found)


def _read_text(text: str, quantity: Quantity) -> Requirement:
    parts = _TEXT.fullmatch(text)
    if parts is None or parts[1].lower() not in SUMS:
        raise UsageError(
            f'--require {text}: expected rms, rss or worst and a limit with a unit, as "rms 0.1 arcsec", or a CSV file'
        )
    if ".." in parts[2]:
        raise UsageError(f'--require {text}: expected a band with its unit at the end, as "10..200Hz"')
    try:
        limit = number(parts[2], _dimension(quantity))
        low, high = (float(parts[3]), float(parts[4])) if parts[3] else (0.0, np.inf)
    except (QuantityError, ValueError) as error:
        raise UsageError(f"--require {text}: {error}") from None
    if not (limit > 0.0 and 0.0 <= low < high):
        raise UsageError(f"--require {text}: expected a limit above 0, and the lower frequency first")
    return Requirement(parts[1].lower(), limit, low, high)


def _dimension(quantity: Quantity) -> Dimension:
    return Dimension(WORDS[quantity.unit], quantity.unit.replace("s2", "s^2"))


def _read_mask(path: Path, quantity: Quantity) -> list[Requirement]:
    hertz = Dimension("a frequency", "Hz")
    known = {"sum": TEXT, "from": hertz, "to": hertz, "limit": _dimension(quantity)}
    table = read_columns(path, known.get, ["sum", "limit"], list(known), ["sum"])
    found = []
    for i, name in enumerate(table.texts["sum"]):
        low = float(table.get("from")[i])
        high = float(table.numbers["to"][i]) if "to" in table.numbers and table.numbers["to"][i] else np.inf
        limit = float(table.numbers["limit"][i])
        if name.lower() not in SUMS or not (limit > 0.0 and 0.0 <= low < high):
            raise refuse(path, i, f'"{name}": expected rms, rss or worst, a limit above 0, the lower frequency first')
        found.append(Requirement(name.lower(), limit, low, high))
    return found


def judge(found: Jitter, requirement: Requirement) -> Verdict:
    """Whether jitter meets a requirement at all its speeds, with the makers' tolerances; not at one with a problem."""
    found = found.toleranced
    values = found.sums((requirement.low, requirement.high))[requirement.sum]
    values += np.nan_to_num(found.remainder)  # what the balance leaves out, with any phases
    values[[i for i, _ in found.problems]] = np.inf
    values = np.where(np.isfinite(values), values, np.inf)
    step, axis = np.unravel_index(int(np.argmax(values)), values.shape)
    share = values.max(axis=1) / requirement.limit
    return Verdict(requirement, float(values.max()), int(step), int(axis), share)
