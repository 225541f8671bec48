"""What a program with faults of the dictionary would answer, as errors on a sheet."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from mahovik.core.stand.model import Stand
from mahovik.errors import StateError
from mahovik.proof.diagnose.equations import Equations, Values
from mahovik.proof.diagnose.fault import Fault
from mahovik.proof.diagnose.sheet import Sheet
from mahovik.proof.reference.array import Array
from mahovik.proof.verify.states import Request


@dataclass(frozen=True)
class Part:
    """A fault of the dictionary; of one flywheel alone where `wheel` names it."""

    fault: type[Fault]
    wheel: str | None = None


Suspect = tuple[Part, ...]
"""One fault, or two at once."""


class Faulty:
    """The equations with some faults at once, as a program that answers requests."""

    def __init__(self, stand: Stand, suspect: Suspect = ()) -> None:
        self._stand = stand
        kinds = tuple(part.fault for part in suspect)
        self._equations: type[Equations] = type("Several", kinds, {}) if len(kinds) > 1 else (*kinds, Equations)[0]
        self._wheels = {part.fault: part.wheel for part in suspect if part.wheel is not None}
        self._at: tuple[object, Equations | None] = (None, None)

    def answer(self, request: Request) -> Values:
        """Its values; none where it has no answer to the state."""
        (want,) = request.want
        try:
            with np.errstate(all="ignore"):
                return self._equations_at(request).evaluate(want)
        except (StateError, np.linalg.LinAlgError, ArithmeticError, ValueError):
            return {}

    def _equations_at(self, request: Request) -> Equations:
        state, found = self._at
        if found is None or state is not request.state:
            found = self._equations(self._stand, request.state, self._wheels)
            self._at = (request.state, found)
        return found


class Predictions:
    """Predicted errors of suspects, kept: each is asked for again and again."""

    def __init__(self, stand: Stand, whole: Sheet, first: int) -> None:
        """`first`: so many requests are enough to search by."""
        self._stand = stand
        self._whole, self._first = whole, whole.head(first)
        self._rest = whole.tail(first)
        self._known: dict[tuple[Suspect, bool], Array] = {}

    @cached_property
    def _right(self) -> Array:
        """Of the equations without a fault: so that a fault without effect predicts exactly zero."""
        return self._whole.filled(Faulty(self._stand).answer)

    def of(self, suspect: Suspect, whole: bool) -> Array:
        """Error over scale, on the whole sheet or on its first requests."""
        key = (suspect, whole)
        if key not in self._known:
            found = self._first.filled(Faulty(self._stand, suspect).answer) if not whole else self._completed(suspect)
            error = self._whole.over_scale(found - self._right[: found.size])
            if whole:
                first = self.of(suspect, False)
                error[: first.size] = first
            self._known[key] = error
        return self._known[key]

    def _completed(self, suspect: Suspect) -> Array:
        """Numbers after the first requests; none there."""
        return self._rest.filled(Faulty(self._stand, suspect).answer)


def singles(faults: Sequence[type[Fault]]) -> list[Suspect]:
    """Each fault for itself, in all bodies that it concerns."""
    return [(Part(fault),) for fault in faults]
