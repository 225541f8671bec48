"""Where names stand in a drawing, so that none covers another."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

HEIGHT = 12.0
"""px of a line of words."""

WIDTH = 6.3
"""px of a letter, more rather than less: the font of the reader is not known."""


@dataclass(frozen=True)
class Box:
    """A rectangle, px: from (x0, y0) to (x1, y1), y downwards."""

    x0: float
    y0: float
    x1: float
    y1: float

    def shared(self, others: Array) -> float:
        """Area in common with others (M, 4: x0, y0, x1, y1), px2, summed over them."""
        width = np.minimum(self.x1, others[:, 2]) - np.maximum(self.x0, others[:, 0])
        height = np.minimum(self.y1, others[:, 3]) - np.maximum(self.y0, others[:, 1])
        return float(np.maximum(width, 0.0) @ np.maximum(height, 0.0))

    def inside(self, other: Box) -> bool:
        """Whether it is wholly within another."""
        return self.x0 >= other.x0 and self.y0 >= other.y0 and self.x1 <= other.x1 and self.y1 <= other.y1


class Places:
    """Finds free places one after another inside `frame`; `busy` are boxes that words had better not cover."""

    def __init__(self, frame: Box, busy: list[Box]) -> None:
        self.frame = frame
        self._busy = _rows(busy)
        self._taken: list[Box] = []

    def take(self, box: Box) -> None:
        """Keeps a place free of later words."""
        self._taken.append(box)

    def find(self, words: str, anchor: Array, away: Array, radius: float) -> Box | None:
        """A place for words beside a thing of `radius` px at `anchor`, best in the direction `away`; None: no room.

        What is found is taken.
        """
        width, first = WIDTH * len(words) + 2, math.atan2(away[1], away[0])
        best: tuple[float, Box] | None = None
        taken = _rows(self._taken)
        for step, distance in enumerate((radius + 5.0, radius + 15.0, radius + 28.0, radius + 44.0)):
            for k in range(16):
                turn = (k + 1) // 2 * (1 if k % 2 else -1) * math.pi / 8
                dx, dy = math.cos(first + turn), math.sin(first + turn)
                x = float(anchor[0]) + distance * dx - width / 2 * (1 - dx)
                y = float(anchor[1]) + distance * dy - HEIGHT / 2 * (1 - dy)
                box = Box(x, y, x + width, y + HEIGHT)
                price = 0.35 * step + 0.08 * abs(turn)
                if (best is not None and price >= best[0]) or not box.inside(self.frame) or box.shared(taken):
                    continue
                price += box.shared(self._busy) / (width * HEIGHT)
                if best is None or price < best[0]:
                    best = (price, box)
        if best is None:
            return None
        self.take(best[1])
        return best[1]


def _rows(boxes: list[Box]) -> Array:
    return np.array([(b.x0, b.y0, b.x1, b.y1) for b in boxes], dtype=np.float64).reshape(-1, 4)
