"""Initial states near a nominal one: of a free carrier any, of a held one those that its freedoms reach."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from mahovik.core.stand.hold import twists
from mahovik.core.stand.model import Stand
from mahovik.core.stand.state import State
from mahovik.out.campaign.pose import compose, cross, rotation, small_rotation, turn

Array = NDArray[np.float64]

POSE, RATES = np.repeat([1e-2, 1e-1], 3), np.repeat([1e-1, 1.0], 3)
"""Natural sizes of a shift (m) and a turn (rad), and of the two parts of a twist (m/s, rad/s)."""


class Deviations:
    """Numbers by which an initial state differs from a nominal one, and their natural sizes.

    Of a free carrier 12: shift of O1 in E0, small turn in E1, twist. Of one with m freedoms 2 m: how far it is moved
    along each from the nominal pose, and how fast. Of a clamped one none.
    """

    def __init__(self, stand: Stand) -> None:
        self._S = None if stand.hold is None else twists(stand.hold)
        if self._S is None:
            self.scale = np.concatenate([POSE, RATES])
        else:
            turns = np.any(self._S[3:] != 0.0, axis=0)
            self.scale = np.concatenate([np.where(turns, size[3], size[0]) for size in (POSE, RATES)])

    @property
    def count(self) -> int:
        """How many numbers."""
        return len(self.scale)

    def states(self, start: State, deviation: Array) -> Array:
        """Position, attitude and twist (13, n) of n deviations (count, n) from a state without angles."""
        n = deviation.shape[1]
        position, V = np.array(start.position)[:, None], np.array(start.V)[:, None]
        q = np.repeat(np.array(start.quaternion or (1.0, 0.0, 0.0, 0.0))[:, None], n, axis=1)
        if self._S is None:
            moved, turned, rates = position + deviation[:3], deviation[3:6], deviation[6:]
        else:
            m = self._S.shape[1]
            step, rates = self._S @ deviation[:m], self._S @ deviation[m:]
            turned = step[3:]
            moved = position + turn(rotation(q), _shift(step[:3], turned))
        return np.concatenate([np.broadcast_to(moved, (3, n)), compose(q, small_rotation(turned)), V + rates])


def _shift(v: Array, r: Array) -> Array:
    """Shift (3, n; m) of the screw motion with the twist (v, r): it turns about its axis, which stays where it is."""
    angle = np.sqrt(r[0] ** 2 + r[1] ** 2 + r[2] ** 2)
    first = 0.5 * np.sinc(0.5 * angle / np.pi) ** 2  # (1 - cos angle) / angle^2
    small = angle < 1e-3
    size = np.where(small, 1.0, angle)
    second = np.where(small, 1.0 / 6.0 - angle**2 / 120.0, (size - np.sin(size)) / size**3)
    across = cross(r, v)
    return np.asarray(v + first * across + second * cross(r, across))
