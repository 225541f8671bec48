"""What is known at one time of output, and what a backend must offer."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from mahovik.core.stand.state import State

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Moment:
    """A time, the state there (with V_dot, phi_ddot) and phases counted through.

    `tau`: N; `points`: readings by name; `mounts`: N x 6, or None where not asked for.
    """

    t: float
    state: State
    phi: Array
    tau: Array
    points: dict[str, Any]
    mounts: Array | None


class Motion(Protocol):
    """A backend: yields the moments of its case in order."""

    def moments(self, mounts: bool) -> Iterator[Moment]:
        """One for every time of output. Raises StateError where the motion leaves what can be computed."""
