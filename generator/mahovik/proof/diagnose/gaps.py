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
    words       these in words
    shapes      of each quantity that has numbers in one wrong shape at all its states: this, and the expected one
    """

    want: str
    missing: int
    states: int
    components: Mapping[str, tuple[str, ...]]
    words: str
    shapes: Mapping[str, tuple[Shape, Shape]] = field(default_factory=dict)

    @property
    def everywhere(self) -> bool:
        """Whether no state has all numbers."""
        return self.missing == self.states

    def sentence(self) -> str:
        """The gap in a line."""
        what = "another shape" if self.shapes.keys() == self.components.keys() else "no number"
        return f"{self.want} answers {what} at {self.missing} of {self.states} states of the diagnosis ({self.words})"


def gaps_of(
    stand: Stand, vector: AnswerVector, numbers: Array, answers: Callable[[Request], Mapping[str, Any]]
) -> tuple[Gap, ...]:
    """Gaps in the `numbers` of a vector's requests.

    States that the program refused, and quantities that none of its answers has, are not counted.
    """
    answered: dict[str, list[tuple[Mapping[str, Any], Any]]] = {}
    for request, parts in zip(vector.requests, vector.parts, strict=True):
        answer = answers(request)
        if any(path[0] in answer for path, *_ in parts):
            answered.setdefault(request.want[0], []).append((answer, parts))
    gaps = []
    for want, rows in answered.items():
        absent: dict[str, list[Array]] = {}
        pairs: dict[str, set[tuple[Shape, Shape] | None]] = {}
        offered = {key for answer, _ in rows for key in answer}
        for answer, parts in rows:
            for path, shape, start in parts:
                if path[0] in offered:
                    name, there = ".".join(path), numbers_at(answer, path)
                    lost = ~np.isfinite(numbers[start : start + int(np.prod(shape))])
                    absent.setdefault(name, []).append(lost)
                    other = there is not None and there.shape != shape and bool(np.isfinite(there).all())
                    if lost.any():
                        pairs.setdefault(name, set()).add((there.shape, shape) if there is not None and other else None)
        table = {name: np.array(x) for name, x in absent.items()}
        shapes = {n: pair for n, (pair, *more) in pairs.items() if pair and not more and table[n].all()}
        components = {name: _names(stand, name, table[name].any(axis=0)) for name in pairs}
        words = []
        for name, lost_names in components.items():
            place = f"component{'s' if len(lost_names) > 1 else ''} {' '.join(lost_names)}"
            if name in shapes:
                place = "shape {}, expected {}".format(*map(list, shapes[name]))
            elif table[name].all():
                place = "all components"
            words.append(place if len(table) == 1 else f"{name}, {place}")
        if components:
            missing = int(np.any([x.any(axis=1) for x in table.values()], axis=0).sum())
            gaps.append(Gap(want, missing, len(rows), components, "; ".join(words), shapes))
    return tuple(gaps)


def _names(stand: Stand, quantity: str, lost: Any) -> tuple[str, ...]:
    if quantity in _BY_LETTER:
        names = list(WRENCH_LETTERS)
    else:
        wheels = [wheel.name for wheel in stand.flywheels]
        names = wheels if lost.size == len(wheels) else [str(i + 1) for i in range(lost.size)]
    return tuple(names[i] for i in np.flatnonzero(lost))
