"""Values at one time of output, and the interface of a backend."""

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
    """A time, the state there (with V_dot, phi_ddot), and phases that are not wrapped.

    `tau`: N; `points`: readings by name; `mounts`: N x 6, or None if not requested.
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
        """One moment for every time of output. Raises StateError if the motion leaves the computable range."""
