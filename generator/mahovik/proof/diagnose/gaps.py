"""Numbers that a program leaves out: NaN, infinity, null or another shape, in wants that it answers."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from mahovik.core.stand.model import WRENCH_LETTERS, Stand
from mahovik.proof.diagnose.answers import AnswerVector, numbers_at
from mahovik.proof.reference.array import Array
from mahovik.proof.verify.states import Request

Shape = tuple[int, ...]

_BY_LETTER = ("V_dot", "Z", "Z0", "residual")


@dataclass(frozen=True)
class Gap:
    """A want in whose answers numbers are missing.

    missing     number of states with an answer that is not all numbers; states: of those with an answer
    components  of each quantity with gaps, its components there, by letter, flywheel or index from 1
    whole       quantities of which no component is ever a number
    only        whether the want has one quantity
    shapes      of each quantity that has numbers in one wrong shape at all its states: this, and the expected one
    """

    want: str
    missing: int
    states: int
    components: Mapping[str, tuple[str, ...]]
    whole: tuple[str, ...]
    only: bool
    shapes: Mapping[str, tuple[Shape, Shape]] = field(default_factory=dict)

    @property
    def everywhere(self) -> bool:
        """Whether no state has all numbers."""
        return self.missing == self.states

    def sentence(self) -> str:
        """The gap in a line."""
        places = "; ".join(
            f"{'' if self.only else quantity + ', '}{self._place(quantity, names)}"
            for quantity, names in self.components.items()
        )
        what = "another shape" if self.shapes.keys() == self.components.keys() else "no number"
        return f"{self.want} answers {what} at {self.missing} of {self.states} states of the diagnosis ({places})"

    def _place(self, quantity: str, names: tuple[str, ...]) -> str:
        if quantity in self.shapes:
            found, expected = self.shapes[quantity]
            return f"shape {list(found)}, expected {list(expected)}"
        if quantity in self.whole:
            return "all components"
        return f"component{'s' if len(names) > 1 else ''} {' '.join(names)}"


def gaps_of(
    stand: Stand, vector: AnswerVector, found: Array, answers: Callable[[Request], Mapping[str, Any]]
) -> tuple[Gap, ...]:
    """Gaps in the numbers `found` of a vector's requests.

    States that the program refused, and quantities that none of its answers has, are not counted.
    """
    asked: dict[str, list[tuple[Mapping[str, Any], set[str], tuple[Any, ...]]]] = {}
    for request, parts in zip(vector.requests, vector.parts, strict=True):
        answer = answers(request)
        given = {path[0] for path, _, _ in parts} & answer.keys()
        if given:
            asked.setdefault(request.want[0], []).append((answer, given, parts))
    gaps = []
    for want, rows in asked.items():
        offered = set().union(*(given for _, given, _ in rows))
        shapes: dict[str, set[tuple[Shape, Shape] | None]] = {}
        lost: dict[str, set[int]] = {}
        sizes: dict[str, int] = {}
        there: set[str] = set()
        missing = 0
        for answer, _, parts in rows:
            incomplete = False
            for path, shape, start in parts:
                if path[0] not in offered:
                    continue
                name, size = ".".join(path), int(np.prod(shape))
                absent = np.flatnonzero(~np.isfinite(found[start : start + size])).tolist()
                sizes[name] = size
                if len(absent) < size:
                    there.add(name)
                if absent:
                    lost.setdefault(name, set()).update(absent)
                    shapes.setdefault(name, set()).add(_wrong_shape(answer, path, shape))
                    incomplete = True
            missing += incomplete
        if missing:
            components = {name: _names(stand, name, sizes[name], sorted(lost[name])) for name in lost}
            whole = tuple(name for name in lost if name not in there)
            other = {name: pair for name, (pair, *more) in shapes.items() if pair and not more and name in whole}
            gaps.append(Gap(want, missing, len(rows), components, whole, len(sizes) == 1, other))
    return tuple(gaps)


def _wrong_shape(answer: Mapping[str, Any], path: tuple[str, ...], shape: Shape) -> tuple[Shape, Shape] | None:
    """The shape of finite numbers that is not the expected one, and this; None where the shape is no fault."""
    numbers = numbers_at(answer, path)
    wrong = numbers is not None and numbers.shape != shape and bool(np.isfinite(numbers).all())
    return (numbers.shape, shape) if numbers is not None and wrong else None


def _names(stand: Stand, quantity: str, size: int, indices: list[int]) -> tuple[str, ...]:
    if quantity in _BY_LETTER:
        return tuple(WRENCH_LETTERS[i] for i in indices)
    if size == len(stand.flywheels):
        return tuple(stand.flywheels[i].name for i in indices)
    return tuple(str(i + 1) for i in indices)
