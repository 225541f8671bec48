"""Comparison of measured costs with accepted ones."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from mahovik.proof.cost.measure import Costs, TargetCost

RISE = 0.02
"""Least relative rise that counts: figures of one compiler are the same in every run, without noise."""

COMPARED_FIGURES = ("instructions", "stack", "code")
"""Figures of a function that are compared."""


@dataclass(frozen=True)
class Comparison:
    """`rises`: a line each; `missing`: what has no accepted figures and should, or is not there any more; `compared`:
    targets with the compiler of the accepted figures; `other`: why the rest was not compared.
    """

    rises: tuple[str, ...]
    missing: tuple[str, ...]
    compared: tuple[str, ...]
    other: tuple[str, ...]


def compare(
    costs: Costs, accepted: Sequence[Mapping[str, Any]], required: Sequence[tuple[str, str]] = ()
) -> Comparison:
    """Each target against the accepted figures of that target, element type and compiler.

    `required`: targets and element types that must have accepted figures, measured or not.
    """
    rises: list[str] = []
    compared, other = [], []
    before = {(old["target"], old["real"]): old for old in accepted}
    missing = [f"{target}, {real}" for target, real in dict.fromkeys(required) if (target, real) not in before]
    for new in costs.targets:
        name = f"{new.target}, {new.real}"
        old = before.get((new.target, new.real))
        if old is None:
            if name not in missing:
                other.append(f"{name}: no accepted figures")
        elif old["compiler"] != new.compiler:
            other.append(f"{name}: accepted figures are of {old['compiler']}, this is {new.compiler}")
        else:
            compared.append(name)
            rises += (f"{name}: {line}" for line in _rises(old, new))
            missing += (f"{name}: {line}" for line in _missing(old, new))
    return Comparison(tuple(rises), tuple(missing), tuple(compared), tuple(other))


def _rises(old: Mapping[str, Any], new: TargetCost) -> Iterator[str]:
    before = {f["function"]: f for f in old["functions"]}
    for function in new.functions:
        accepted = before.get(function.function, {})
        for what in COMPARED_FIGURES:
            yield from _rise(f"{function.function}, {what}", accepted.get(what), getattr(function, what))
    yield from _rise("code of the whole file", old["text"], new.text)
    for table, size in new.constants.items():
        yield from _rise(f"constants {table}", old["constants"].get(table), size)


def _rise(what: str, old: int | None, new: int) -> Iterator[str]:
    if old is not None and new > old * (1 + RISE):
        more = f"{100 * (new - old) / old:.1f} % more" if old else "there was none"
        yield f"{what}: {old} accepted, now {new}, {more}"


def _missing(old: Mapping[str, Any], new: TargetCost) -> Iterator[str]:
    """Functions, their figures and tables that only one side has."""
    before = {f["function"]: f for f in old["functions"]}
    now = [f.function for f in new.functions]
    yield from (f"{name}, {what}" for name in now for what in COMPARED_FIGURES if what not in before.get(name, {}))
    yield from (f"{name}, which is not there any more" for name in before if name not in now)
    yield from (f"constants {table}" for table in new.constants if table not in old["constants"])
