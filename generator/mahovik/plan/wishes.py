"""What the caller wants of a plan."""

from __future__ import annotations

from dataclasses import dataclass

from mahovik.motion.required import Winding


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
    """

    seed: int = 0
    seconds: float | None = None
    winding: Winding | None = None
    keep: int = 1
    enough: int = 1
    verify: bool = True
    steps: int = 20_000
