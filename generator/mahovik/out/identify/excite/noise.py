"""Noise of the sensors of an experiment: white, one standard deviation per channel and sample."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fnmatch import fnmatchcase

import numpy as np
from numpy.typing import NDArray

from mahovik.core.stand.units import ACCELERATION, SPEED
from mahovik.errors import UsageError
from mahovik.nearest import suggestion
from mahovik.out.functions.given import Number, quantity
from mahovik.out.identify.channels import KINDS, Channel

Array = NDArray[np.float64]

DEFAULT: Mapping[str, float] = {"acceleration": 0.02, "rate": 0.002}
"""m/s2 and rad/s in each sample: a small IMU at a kilohertz."""

DIMENSIONS = {"acceleration": ACCELERATION, "rate": SPEED}


def noise_of_channels(channels: Sequence[Channel], given: Mapping[str, Number]) -> Array:
    """Noise (C) of channels, SI. `given`: by kind, `rate`, or by sensor and kind, `imu.rate`. Raises UsageError."""
    found = np.array([DEFAULT[channel.kind] for channel in channels])
    for name, value in given.items():
        pattern = name if "." in name else f"*.{name}"
        kind = pattern.rpartition(".")[2]
        own = [c for c, each in enumerate(channels) if fnmatchcase(f"{each.point}.{each.kind}", pattern)]
        if not own:
            known = [*KINDS, *dict.fromkeys(f"{each.point}.{each.kind}" for each in channels)]
            raise UsageError(f'--noise: unknown channel "{name}"{suggestion(name, known)}')
        number = quantity(f"--noise of {name}", value, DIMENSIONS[kind])
        if not number > 0.0:
            raise UsageError(f"--noise of {name}: {value}: expected a number above 0")
        found[own] = number
    return found
