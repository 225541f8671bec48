"""The functions of a stand for many states side by side, made of those for one: no formula is written again."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace

from mahovik.contract.functions import BATCHED
from mahovik.contract.quantities import shared
from mahovik.core.program.function import Function, Program
from mahovik.core.program.inline import Inliner
from mahovik.core.program.refusal import without_returns
from mahovik.core.program.walk import reachable
from mahovik.core.program.wide import Wide
from mahovik.core.program.widen import RESERVED, Widener

PREPARED = {"table": "prepare", "mounting": "prepare_mounts"}
"""Arguments that hold the numbers of a stand, with the function that makes each."""


@dataclass(frozen=True)
class Batch:
    """One function for n states: `narrow` as for one state, `wide` for a block; `each`: one table per state."""

    narrow: Function
    wide: Function
    each: bool


@dataclass(frozen=True)
class Batches:
    """The wide program: its functions in order, lanes of a block, and what makes the batches.

    preparing  the functions of PREPARED that the program has, of n stands with parameters of their own
    """

    program: Program
    batches: tuple[Batch, ...]
    preparing: tuple[Batch, ...]
    widener: Widener

    @property
    def lanes(self) -> int:
        return self.widener.wide.lanes


def batches(program: Program) -> Batches:
    """Wide forms of the functions of a program that have a batch."""
    public = {f.name: f for f in program.functions if f.public}
    entries = [public[name] for name in BATCHED if name in public]
    preparing = [public[name] for name in PREPARED.values() if name in public] if entries else []
    needed = reachable(tuple(replace(f, public=f in (*entries, *preparing)) for f in program.functions))
    refusing = without_returns(tuple(program.function(f.name) for f in needed), program.precision)
    inliner = Inliner(refusing, RESERVED)
    widener = Widener(Wide(program.precision), inliner.__getitem__)

    def batch(narrow: Function, varying: Iterable[str], each: bool) -> Batch:
        return Batch(narrow, widener.function(inliner[narrow.name], varying), each)

    found = []
    for each in (False, True):
        for narrow in entries:
            varying = [a.name for a in narrow.arguments if not shared(a.name) or (each and a.name in PREPARED)]
            found.append(batch(narrow, varying, each))
    made = tuple(batch(f, [a.name for a in f.arguments], True) for f in preparing)
    wide = Program(program.name, program.precision, (), (), widener.functions)
    return Batches(wide, tuple(found), made, widener)
