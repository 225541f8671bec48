"""A contestant: one library of a program, with the works it has."""

from __future__ import annotations

from dataclasses import dataclass

from mahovik_bench.build import Effort, Recipe

NONE = Effort(0.0, 0.0)


@dataclass(frozen=True)
class Peer:
    """One build of a program for one case.

    `program` is whose it is, `build` how it was made; `model` is the file that `peer_setup` reads; `generation` what
    writing its code took; `counted`: callgrind can run it and its figures are shown; `timed`: its times are;
    `states`: of one call, which lie by component in its records and results where they are more than one.
    """

    program: str
    build: str
    works: tuple[str, ...]
    recipe: Recipe
    model: str = ""
    generation: Effort = NONE
    counted: bool = False
    timed: bool = True
    states: int = 1

    @property
    def name(self) -> str:
        """Name of the peer in tables."""
        return f"{self.program} {self.build}"
