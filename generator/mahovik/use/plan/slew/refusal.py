"""Why there is no slew, in words: which motion the flywheels do not give."""

from __future__ import annotations

import numpy as np

from mahovik.core.motion.required import Slew
from mahovik.use.numeric.se3 import Array


class NoSlewError(Exception):
    """Why there is no programme: reason and words of `Plan`; without a reason the attitude is singular."""

    def __init__(self, reason: str | None, words: str) -> None:
        super().__init__(words)
        self.reason, self.words = reason, words


def unreached_motion(slew: Slew, S: Array, twist: Array, left: Array) -> NoSlewError:
    """The flywheels do no work on a twist (6, in E1), though the rows S (m, 6) need it; left (m): what the rows miss.

    A moment or a force where rows turn; else the acceleration of the point whose rows these are.
    """
    places = {row.of or "O1" for row in slew.task.rows}
    if slew.kind == "still" and len(places) == 1:
        words = f"they give no acceleration of {places.pop()} along ({_direction(left @ S[:, :3])}) of E1"
    else:
        turns = float(np.linalg.norm(twist[3:])) > 1e-6 * float(np.linalg.norm(twist[:3]))
        along = "moment about" if turns else "force along"
        words = f"they give no {along} ({_direction(twist[3:] if turns else twist[:3])}) of E1"
    return NoSlewError("SPAN", f"the flywheels do not reach the task {slew.task.name}: {words}")


def _direction(x: Array) -> str:
    unit = x / np.linalg.norm(x)
    return ", ".join(f"{x:.4g}" for x in np.where(np.abs(unit) > 1e-9, unit, 0.0) + 0.0)
