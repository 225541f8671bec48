"""Errors of the answers that a program with faults of the dictionary would give."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, cast

import numpy as np
from scipy.spatial.transform import Rotation

from mahovik.core.stand.model import Body, Stand
from mahovik.core.stand.state import Quaternion, State
from mahovik.errors import StateError
from mahovik.proof import reference
from mahovik.proof.diagnose.answer_vector import NOT_COMPARED, AnswerVector
from mahovik.proof.diagnose.fault import Case, Fault, Stage
from mahovik.proof.reference.array import Array, Values
from mahovik.proof.reference.bodies import bodies_of
from mahovik.proof.reference.pieces import Pieces
from mahovik.proof.reference.rotation import carrier_rotation
from mahovik.proof.verify.actuators import stand_at
from mahovik.proof.verify.states import Request


@dataclass(frozen=True)
class Part:
    """A fault of the dictionary; of one flywheel alone where `wheel` names it."""

    fault: Fault
    wheel: str | None = None

    def concerns(self, body: Body) -> bool:
        """Whether the program is wrong about a body."""
        return self.fault.concerns(body, self.wheel)


Suspect = tuple[Part, ...]
"""One fault, or two at once."""

EARLY: tuple[Stage, ...] = ("stand", "state", "attitude", "bodies")
"""Stages before the pieces."""

PiecesByState = dict[int, tuple[State, Pieces]]
"""Pieces by the identity of their state, which is held so that the identity stays its own."""


class FaultyProgram:
    """The literal reference with some faults at once, as a program that answers requests."""

    def __init__(self, stand: Stand, suspect: Suspect = (), known: PiecesByState | None = None) -> None:
        """`known`: pieces of states without a fault, for this and other programs of the stand."""
        self._stand = stand
        self._suspect = suspect
        early = any(edit.stage in EARLY for part in suspect for edit in part.fault.edits)
        self._known: PiecesByState = {} if early or known is None else known

    def answer(self, request: Request) -> Values:
        """Values that are numbers; none if it has no answer at the state."""
        (want,) = request.want
        try:
            with np.errstate(all="ignore"):
                return self._values(request.state, want)
        except (StateError, np.linalg.LinAlgError, ArithmeticError, ValueError):
            return {}

    def _values(self, given: State, want: str) -> Values:
        stand, state = stand_at(self._stand, given), given
        for part in self._suspect:
            case = Case(stand, state, want, part.concerns)
            stand = _apply("stand", stand, part, case)
            state = _apply("state", state, part, replace(case, stand=stand))
        if id(given) not in self._known:
            self._known[id(given)] = given, self._pieces(stand, state, want)
        _, at = self._known[id(given)]
        cases = [(part, Case(stand, state, want, part.concerns)) for part in self._suspect]
        for part, case in cases:
            at = _apply("pieces", at, part, case)
        values = reference.evaluate(stand, state, (want,), at)
        for part, case in cases:
            values = _apply("values", values, part, case, at)
        return {name: value for name, value in values.items() if name not in NOT_COMPARED}

    def _pieces(self, stand: Stand, state: State, want: str) -> Pieces:
        """Pieces of the state, before changes of the stage `pieces`."""
        bodies, C = bodies_of(stand), carrier_rotation(stand, state)
        for part in self._suspect:
            case = Case(stand, state, want, part.concerns)
            bodies = _apply("bodies", bodies, part, case)
            turned = _apply("attitude", C, part, case)
            if turned is not C:
                C, state = turned, _with_attitude(state, turned)
        return reference.pieces(stand, state, bodies)


def _with_attitude(state: State, C: Array) -> State:
    """The state with the attitude C (3x3)."""
    x, y, z, w = Rotation.from_matrix(C).as_quat()
    return replace(state, angles=None, quaternion=cast(Quaternion, (w, x, y, z)))


def _apply(stage: Stage, right: Any, part: Part, case: Case, *more: object) -> Any:
    """Result of a stage after the changes of one fault."""
    for edit in part.fault.edits:
        if edit.stage == stage:
            right = edit.change(right, *more, case)
    return right


class Predictions:
    """Errors that suspects would make, cached, for each is needed many times."""

    def __init__(self, stand: Stand, whole: AnswerVector, first: int) -> None:
        """`first`: the number of requests that the search begins with."""
        self._stand = stand
        self._whole, self._first, self._rest = whole, whole.head(first), whole.without_first(first)
        self._pieces: PiecesByState = {}
        self._errors: dict[tuple[Suspect, bool], Array] = {}

    @cached_property
    def _right(self) -> Array:
        """Answers without a fault, so that a fault without effect makes an error of exactly zero."""
        return self._answers(self._whole, ())

    def error(self, suspect: Suspect, whole: bool) -> Array:
        """Error over scale, of the whole vector or of its first requests."""
        key = (suspect, whole)
        if key not in self._errors:
            found = self._answers(self._rest if whole else self._first, suspect)
            error = self._whole.over_scale(found - self._right[: found.size])
            if whole:
                first = self.error(suspect, False)
                error[: first.size] = first
            self._errors[key] = error
        return self._errors[key]

    def _answers(self, vector: AnswerVector, suspect: Suspect) -> Array:
        return vector.fill(FaultyProgram(self._stand, suspect, self._pieces).answer)


def single_faults(faults: Sequence[Fault]) -> list[Suspect]:
    """Each fault for itself, in all bodies that it concerns."""
    return [(Part(fault),) for fault in faults]
