"""Options of a plan."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from mahovik.core.motion.required import Winding

Method = Literal["fourier", "ocp-partition", "ocp"]


@dataclass(frozen=True)
class PlanOptions:
    """Options of a plan.

    seed     of all random numbers; the same file and seed give the same programme
    seconds  time limit; None: only the budget of starts and steps ends the search
    winding  replaces the motion file's
    keep     programmes to return, best first
    enough   programmes of each kind of winding to choose from
    verify   whether to verify the programmes independently
    steps    limit of steps of search and optimisation
    method   fourier; or (13) by IPOPT from its result: with the partition, or with (12) as constraints
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
        """Time limit of the search, s: half of the time is kept for IPOPT if the method needs it."""
        return self.seconds if self.seconds is None or self.method == "fourier" else self.seconds / 2.0
