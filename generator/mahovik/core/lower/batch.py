"""The functions of a stand for many states side by side, made of those for one: no formula is written again."""

from __future__ import annotations

from collections.abc import Collection, Iterable
from dataclasses import dataclass, replace

from mahovik.contract.functions import BATCH_FUNCTIONS, row_of, task_of
from mahovik.contract.quantities import is_shared
from mahovik.core.lower.flywheels import APART
from mahovik.core.program.call import Call
from mahovik.core.program.function import Function, Program
from mahovik.core.program.inline import Inliner
from mahovik.core.program.refusal import without_returns
from mahovik.core.program.statement import Do, Statement, Statements
from mahovik.core.program.types import Struct
from mahovik.core.program.walk import reachable, with_blocks, without_missing
from mahovik.core.program.widen import RESERVED, Wide, Widener

PREPARED = {"table": "prepare", "mounting": "prepare_mounts"}
"""Arguments that hold the numbers of a stand, with the function that makes each."""

BOTH = (False, True)
"""Batches in which all states are of one stand, and those in which each state has a table of its own."""


@dataclass(frozen=True)
class Batch:
    """One function for n states: `narrow` as for one state, `wide` for a block; `own_table`: one table per state."""

    narrow: Function
    wide: Function
    own_table: bool


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


def batches(whole: Program, own_tables: tuple[bool, ...] = BOTH, left_out: Collection[str] = ()) -> Batches:
    """Wide forms of the functions of a program that have a batch.

    own_tables  of one stand, of n stands, or BOTH
    left_out    functions that get none, nor their forms for tasks
    """
    program = _apart(replace(whole, functions=tuple(map(without_missing, whole.functions))))
    public = {f.name: f for f in program.functions if f.public}
    own_tables = tuple(own for own in own_tables if not own or "prepare" in public)  # which makes tables of n stands
    entries = [public[name] for name in BATCH_FUNCTIONS if name in public]
    entries += [f for name, f in public.items() if task_of(name) and row_of(name).batch]
    entries = [f for f in entries if not f.name.startswith(tuple(left_out))]
    preparing = [public[name] for name in PREPARED.values() if name in public] if entries and True in own_tables else []
    needed = reachable(tuple(replace(f, public=f in (*entries, *preparing)) for f in program.functions))
    refusing = without_returns(tuple(program.function(f.name) for f in needed), program.precision)
    inliner = Inliner(refusing, RESERVED)
    results = {a.type.name for f in entries for a in f.arguments if a.direction == "out" and isinstance(a.type, Struct)}
    widener = Widener(Wide(program.precision, results), inliner.__getitem__)

    def batch(narrow: Function, varying: Iterable[str], own_table: bool) -> Batch:
        return Batch(narrow, widener.function(inliner[narrow.name], varying), own_table)

    all_batches = []
    for own_table in own_tables:
        for narrow in entries:
            varying = [a.name for a in narrow.arguments if not is_shared(a.name) or (own_table and a.name in PREPARED)]
            all_batches.append(batch(narrow, varying, own_table))
    made = tuple(batch(f, [a.name for a in f.arguments], True) for f in preparing)
    wide = Program(program.name, program.precision, (), (), widener.functions)
    return Batches(wide, tuple(all_batches), made, widener)


def _apart(program: Program) -> Program:
    """The program with the calls of APART in place of those that they stand for."""
    spare = {f.name: f for f in program.spare}

    def body(block: Statements) -> Statements:
        statements: list[Statement] = []
        for s in block:
            last = statements[-1] if statements else None
            if isinstance(s, Do) and isinstance(last, Do):
                pair = APART.get((last.call.signature.name, s.call.signature.name))
                if pair is not None:
                    statements.pop()
                    calls = zip(pair, (last.call, s.call), strict=True)
                    statements += [Do(Call(spare[name].signature, call.arguments)) for name, call in calls]
                    continue
            statements.append(with_blocks(s, body))
        return tuple(statements)

    return replace(program, functions=(*program.spare, *(replace(f, body=body(f.body)) for f in program.functions)))
