"""Has the cost risen? Figures of today against accepted ones."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from mahovik.study.cost.measure import Costs, TargetCost

RISE = 0.02
"""A larger part more is a rise: figures of one compiler are the same in every run, so nothing less hides noise."""


@dataclass(frozen=True)
class Comparison:
    """`rises`: a line each; `compared`: targets with the compiler of the accepted figures; `other`: why the rest
    was not compared.
    """

    rises: tuple[str, ...]
    compared: tuple[str, ...]
    other: tuple[str, ...]


def compare(costs: Costs, accepted: Sequence[Mapping[str, Any]]) -> Comparison:
    """Each target against the accepted figures of that target, element type and compiler."""
    rises: list[str] = []
    compared, other = [], []
    before = {(old["target"], old["real"]): old for old in accepted}
    for new in costs.targets:
        name = f"{new.target}, {new.real}"
        old = before.get((new.target, new.real))
        if old is None:
            other.append(f"{name}: no accepted figures")
        elif old["compiler"] != new.compiler:
            other.append(f"{name}: accepted figures are of {old['compiler']}, this is {new.compiler}")
        else:
            compared.append(name)
            rises += (f"{name}: {line}" for line in _rises(old, new))
    return Comparison(tuple(rises), tuple(compared), tuple(other))


def _rises(old: Mapping[str, Any], new: TargetCost) -> Iterator[str]:
    before = {f["function"]: f for f in old["functions"]}
    for function in new.functions:
        accepted = before.get(function.function, {})
        for what in ("instructions", "stack", "code"):
            yield from _rise(f"{function.function}, {what}", accepted.get(what), getattr(function, what))
    yield from _rise("code of the whole file", old["text"], new.text)
    for table, size in new.constants.items():
        yield from _rise(f"constants {table}", old["constants"].get(table), size)


def _rise(what: str, old: int | None, new: int) -> Iterator[str]:
    if old and new > old * (1 + RISE):
        yield f"{what}: {old} accepted, now {new}, {100 * (new - old) / old:.1f} % more"
