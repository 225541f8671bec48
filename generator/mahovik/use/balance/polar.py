"""Complex numbers as balancers write them: amplitude@degrees."""

from __future__ import annotations

import cmath
import math
import re

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]

_NUMBER = r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?"
_POLAR = re.compile(rf"\s*({_NUMBER})\s*@\s*({_NUMBER})\s*")

LARGEST = 1e12
"""Largest amplitude and angle that are accepted."""


def read_polar(text: str) -> complex | None:
    """The number of "170@112"; None if the text is no such number, its amplitude is negative or it is too large."""
    found = _POLAR.fullmatch(text)
    if found is None:
        return None
    amplitude, degrees = float(found[1]), float(found[2])
    if not (0.0 <= amplitude <= LARGEST and abs(degrees) <= LARGEST):
        return None
    return cmath.rect(amplitude, math.radians(degrees))


def write_polar(value: complex, zero: float = 0.0) -> str:
    """The number with four digits and an angle of 0 to 360 deg to a tenth; "0@0" where it is not above `zero`."""
    if abs(value) <= zero:
        return "0@0"
    degrees = round(math.degrees(cmath.phase(value)) % 360.0, 1) % 360.0
    return f"{float(f'{abs(value):.4g}'):.12g}@{degrees:.10g}"
