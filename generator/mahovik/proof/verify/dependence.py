"""Whether the answers of a stand depend on its pose: a program or a log without it may still be judged."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any, Literal

import numpy as np

from mahovik.core.stand.model import Stand
from mahovik.core.stand.random_state import random_state
from mahovik.proof import reference

POSES: Mapping[str, tuple[Any, Any]] = {
    "position": ((0.0, 0.0, 0.0), (0.3, -0.2, 0.1)),
    "quaternion": ((1.0, 0.0, 0.0, 0.0), (0.1, 0.7, 0.5, 0.5)),
}
"""Two poses that differ in one key of a state."""

SAME = 1e-12
"""Relative difference that is rounding."""


def depends_on(stand: Stand, wants: Sequence[str], key: Literal["position", "quaternion"]) -> bool:
    """Whether an answer differs between two attitudes, or positions, beyond rounding."""
    state = replace(random_state(stand, np.random.default_rng(1)), angles=None)
    for want in wants:
        first, second = (reference.evaluate(stand, replace(state, **{key: pose}), (want,)) for pose in POSES[key])
        for name, value in first.items():
            a, b = np.asarray(value), np.asarray(second[name])
            if not np.allclose(a, b, rtol=SAME, atol=SAME * float(np.abs(a).max(initial=0.0))):
                return True
    return False
