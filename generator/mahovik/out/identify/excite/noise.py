"""Noise of the sensors of an experiment: white, one standard deviation per channel and sample."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fnmatch import fnmatchcase

import numpy as np
from numpy.typing import NDArray

from mahovik.core.stand.units import ACCELERATION, FORCE, SPEED, TORQUE
from mahovik.errors import UsageError
from mahovik.nearest import suggestion
from mahovik.out.functions.given import Number, quantity
from mahovik.out.identify.channels import REACTION, Channel

Array = NDArray[np.float64]

DEFAULT: Mapping[str, float] = {"acceleration": 0.02, "rate": 0.002, "force": 0.02, "moment": 0.002}
"""m/s2, rad/s, N and N m in each sample: a small IMU and a small force table at a kilohertz."""

DIMENSIONS = {"acceleration": ACCELERATION, "rate": SPEED, "force": FORCE, "moment": TORQUE}


def noise_of_channels(channels: Sequence[Channel], given: Mapping[str, Number]) -> Array:
    """Noise (C) of channels, SI.

    `given`: by kind, `rate`, `force`, or by sensor and kind, `imu.rate`, `hold.moment`. Raises UsageError.
    """
    names = [f"{channel.point}.{_kind(channel)}" for channel in channels]
    found = np.array([DEFAULT[_kind(channel)] for channel in channels])
    for name, value in given.items():
        pattern = name if "." in name else f"*.{name}"
        kind = pattern.rpartition(".")[2]
        own = [c for c, each in enumerate(names) if fnmatchcase(each, pattern)]
        if not own:
            known = list(dict.fromkeys([*(each.rpartition(".")[2] for each in names), *names]))
            raise UsageError(f'--noise: unknown channel "{name}"{suggestion(name, known)}')
        number = quantity(f"--noise of {name}", value, DIMENSIONS[kind])
        if not number > 0.0:
            raise UsageError(f"--noise of {name}: {value}: expected a number above 0")
        found[own] = number
    return found


def _kind(channel: Channel) -> str:
    """Key of DEFAULT: of a reaction whether it is a force or a moment, which have noise of their own."""
    if channel.kind == REACTION:
        return "force" if channel.axis < 3 else "moment"
    return channel.kind
