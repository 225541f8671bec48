"""What the caller wants of a plan."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from mahovik.core.motion.required import Winding

Method = Literal["fourier", "ocp-partition", "ocp"]


@dataclass(frozen=True)
class Wishes:
    """What the caller wants of a plan.

    seed     of all draws; the same file and seed give the same programme
    seconds  a cut-off; None: only the budget of starts and steps ends the search
    winding  in place of the motion file's
    keep     programmes that are given, best first
    enough   programmes of each kind of winding to choose from
    verify   whether the programmes are put through the independent verification
    steps    of search and optimisation that may be taken
    method   fourier; or (13) by IPOPT from what that gives: with the partition, or with (12) as constraints
    partition   names of the six dependent flywheels, None: the best
    """

    seed: int = 0
    seconds: float | None = None
    winding: Winding | None = None
    keep: int = 1
    enough: int = 1
    verify: bool = True
    steps: int = 20_000
    method: Method = "fourier"
    partition: tuple[str, ...] | None = None

    @property
    def seconds_of_search(self) -> float | None:
        """The cut-off of the search: half of the time is for IPOPT where that is the method."""
        return self.seconds if self.seconds is None or self.method == "fourier" else self.seconds / 2.0
