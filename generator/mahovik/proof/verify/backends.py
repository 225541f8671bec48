"""Backends evaluate states: one interface for the generated C, the interpreter, the references, foreign programs."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Protocol

import numpy as np

from mahovik.core.stand.model import Stand
from mahovik.core.stand.state import State
from mahovik.errors import StateError
from mahovik.proof import reference
from mahovik.proof.verify.actuators import stand_at


class Backend(Protocol):
    """An evaluator of states of one stand."""

    @property
    def name(self) -> str:
        """Name in tables and messages."""

    def evaluate(self, state: State, want: Sequence[str]) -> dict[str, Any]:
        """Quantities of `want`, by the names of the contract. Raises StateError."""


class NumpyBackend:
    """The literal reference of (1)-(13)."""

    name = "numpy"

    def __init__(self, stand: Stand) -> None:
        self._stand = stand

    def evaluate(self, state: State, want: Sequence[str]) -> dict[str, Any]:
        """See Backend."""
        try:
            return reference.evaluate(stand_at(self._stand, state), state, want)
        except (np.linalg.LinAlgError, ArithmeticError) as error:  # masses of 1e200 and the like
            raise StateError(f"the equations have no finite solution at this state: {error}") from None


class CasadiBackend:
    """The second derivation; with the deflections and speeds of a state it is made again."""

    name = "casadi"

    def __init__(self, stand: Stand) -> None:
        from mahovik.proof.second import Second

        self._stand, self._make = stand, Second
        self._own = Second(stand)

    def evaluate(self, state: State, want: Sequence[str]) -> dict[str, Any]:
        """See Backend."""
        of = self._make(stand_at(self._stand, state)) if state.actuators else self._own
        return of.evaluate(state, want)
