"""Backends evaluate states: one interface for the generated C, the interpreter, the references, foreign programs."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Protocol

import numpy as np

from mahovik.core.stand.model import Stand
from mahovik.core.stand.state import State
from mahovik.errors import StateError
from mahovik.proof import reference


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
            return reference.evaluate(self._stand, state, want)
        except (np.linalg.LinAlgError, ArithmeticError) as error:  # masses of 1e200 and the like
            raise StateError(f"the equations have no finite solution at this state: {error}") from None
