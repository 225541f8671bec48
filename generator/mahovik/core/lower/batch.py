"""The functions of a stand for many states side by side, made of those for one: no formula is written again."""

from __future__ import annotations

from dataclasses import dataclass, replace

from mahovik.contract.functions import BATCHED
from mahovik.contract.quantities import shared
from mahovik.core.program.function import Function, Program
from mahovik.core.program.inline import Inliner
from mahovik.core.program.refusal import without_returns
from mahovik.core.program.walk import reachable
from mahovik.core.program.wide import Wide
from mahovik.core.program.widen import RESERVED, Widener


@dataclass(frozen=True)
class Batch:
    """One function for n states: `narrow` as for one state, `wide` for a block; `each`: one table per state."""

    narrow: Function
    wide: Function
    each: bool


@dataclass(frozen=True)
class Batches:
    """The wide program: its functions in order, lanes of a block, and what makes the batches."""

    program: Program
    batches: tuple[Batch, ...]
    widener: Widener

    @property
    def lanes(self) -> int:
        return self.widener.wide.lanes


def batches(program: Program) -> Batches:
    """Wide forms of the functions of a program that have a batch."""
    entries = [f for f in program.functions if f.public and f.name in BATCHED]
    needed = reachable(tuple(replace(f, public=f in entries) for f in program.functions))
    refusing = without_returns(tuple(program.function(f.name) for f in needed), program.precision)
    inliner = Inliner(refusing, RESERVED)
    widener = Widener(Wide(program.precision), inliner.__getitem__)
    found = []
    for each in (False, True):
        for narrow in sorted(entries, key=lambda f: BATCHED.index(f.name)):
            varying = [a.name for a in narrow.arguments if not shared(a.name) or (each and a.name == "table")]
            found.append(Batch(narrow, widener.function(inliner[narrow.name], varying), each))
    wide = Program(program.name, program.precision, (), (), widener.functions)
    return Batches(wide, tuple(found), widener)
