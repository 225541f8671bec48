"""A stand, its program and some ordinary states: what every judge of a function starts from."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from types import MappingProxyType
from typing import Any

import numpy as np

from mahovik.contract.status import status_words
from mahovik.core.stand.model import Stand
from mahovik.core.stand.state import State
from mahovik.errors import StateError
from mahovik.proof import reference
from mahovik.proof.reference.array import Array
from mahovik.proof.second import Second
from mahovik.proof.verify.bounds import Bounds
from mahovik.proof.verify.c_backend import CBackend


class Setting:
    """The stand, accepted differences, second derivation, element type and seed of a judge of a task."""

    stand: Stand
    bounds: Bounds
    second: Second
    seed: int

    @property
    def real(self) -> str:
        """Element type of the program, "double" or "float"."""
        return "double"

    @property
    def count(self) -> int:
        """Number of flywheels."""
        return len(self.stand.flywheels)

    @property
    def unit(self) -> float:
        """Unit in the last place of 1 in the element type."""
        return float(np.finfo(np.float32 if self.real == "float" else np.float64).eps)

    def nearest_numbers(self, numbers: Array) -> Array:
        """The nearest numbers that the element type has."""
        return np.asarray(numbers, dtype=np.float32 if self.real == "float" else np.float64).astype(np.float64)

    def random(self, number: int = 0) -> np.random.Generator:
        """A generator of its own for each use, the same for the same seed."""
        return np.random.default_rng((self.seed, number))

    def at(self, state: State) -> reference.Pieces:
        """Pieces of the literal reference at a state."""
        return reference.pieces(self.stand, state)


@dataclass(frozen=True)
class Case(Setting):
    """The C under judgement, and the states at which it is judged.

    backend  the compiled C: its functions are called by name
    states   ordinary states by name, with run-time wrenches on the bodies that take one
    bounds   accepted differences of the element type
    second   the second derivation of the same stand
    seed     of the random numbers that a judge needs besides the states
    """

    stand: Stand
    backend: CBackend
    states: Sequence[tuple[str, State]]
    bounds: Bounds
    second: Second
    seed: int

    @property
    def numbers(self) -> int:
        """Numbers of a state of the program."""
        return 13 + 2 * self.count

    @property
    def real(self) -> str:
        """Element type of the program, "double" or "float"."""
        return self.backend.layout.precision.name

    def call(self, function: str, inputs: Mapping[str, Any]) -> dict[str, Any]:
        """Results of a function, members of a struct of results by their names. Raises StateError if it refuses."""
        status, outputs = self.backend.call(function, inputs)
        if status < 0:
            raise StateError(f"{function} refused with status {status_words(status)}")
        found: dict[str, Any] = outputs.get("out", outputs)
        return found


def ordinary(states: Sequence[tuple[str, State]], inputs: Sequence[str], most: int) -> list[tuple[str, State]]:
    """The first ordinary states, with run-time wrenches only on bodies that take one (`inputs`)."""
    chosen = [(name, state) for name, state in states if name.startswith(("random", "wrenched"))][:most]
    return [
        (name, replace(state, wrench=MappingProxyType({b: w for b, w in state.wrench.items() if b in inputs})))
        for name, state in chosen
    ]
