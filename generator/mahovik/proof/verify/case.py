"""A stand, its program and some ordinary states: what every judge of a function starts from."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from mahovik.contract.limits import Limits
from mahovik.contract.status import status_words
from mahovik.core.stand.model import Stand, State
from mahovik.errors import StateError
from mahovik.proof.reference.algebra import Array
from mahovik.proof.second import Second
from mahovik.proof.verify.c_backend import CBackend
from mahovik.proof.verify.scales import Scales


@dataclass(frozen=True)
class Case:
    """The C under judgement, and the states at which it is judged.

    backend  the compiled C: its functions are called by name
    states   ordinary states by name, with run-time wrenches on the bodies that take one
    limits   accepted differences of the element type
    second   the second derivation of the same stand
    scales   the reference with its scales, of the same stand
    seed     of the random numbers that a judge needs besides the states
    """

    stand: Stand
    backend: CBackend
    states: Sequence[tuple[str, State]]
    limits: Limits
    second: Second
    scales: Scales
    seed: int

    @property
    def count(self) -> int:
        """Number of flywheels."""
        return len(self.stand.flywheels)

    @property
    def public(self) -> list[str]:
        """Names of the public functions."""
        return [function.name for function in self.backend.program.functions if function.public]

    def takes(self, function: str, argument: str) -> bool:
        """Whether a function of the C has an argument of a name."""
        return any(a.name == argument for a in self.backend.program.function(function).arguments)

    @property
    def real(self) -> str:
        """Element type of the program, "double" or "float"."""
        return self.limits.real

    @property
    def unit(self) -> float:
        """Unit in the last place of 1 in the element type."""
        return float(np.finfo(np.float32 if self.real == "float" else np.float64).eps)

    @property
    def none(self) -> list[float]:
        """No limit, for each flywheel."""
        return [self.backend.layout.precision.largest] * self.count

    def nearest_numbers(self, numbers: Any) -> Array:
        """The nearest numbers that the element type has."""
        return np.asarray(numbers, dtype=np.float32 if self.real == "float" else np.float64).astype(np.float64)

    def random(self, number: int = 0) -> np.random.Generator:
        """A generator of its own for each use, the same for the same seed."""
        return np.random.default_rng((self.seed, number))

    def normal(self, rng: np.random.Generator, *shape: int) -> Any:
        """Normal numbers as the element type has them, as lists."""
        return self.nearest_numbers(rng.normal(size=shape)).tolist()

    def call(self, function: str, inputs: Mapping[str, Any]) -> dict[str, Any]:
        """Results of a function, members of a struct of results by their names. Raises StateError if it refuses."""
        return self.call_with_status(function, inputs)[1]

    def call_with_status(self, function: str, inputs: Mapping[str, Any]) -> tuple[int, dict[str, Any]]:
        """Status and results, likewise."""
        status, outputs = self.backend.call(function, inputs)
        if status < 0:
            raise StateError(f"{function} refused with status {status_words(status)}")
        result: dict[str, Any] = outputs.get("out", outputs)
        return status, result

    def lock_pattern(self, number: int) -> Array:
        """Locked flywheels (N, bool): every second, the others, all but one, all, in turn."""
        order = np.arange(self.count)
        return np.asarray(
            (order % 2 == 0, order % 2 == 1, order != number % max(self.count, 1), order >= 0)[number % 4]
        )


def ordinary(states: Sequence[tuple[str, State]], most: int) -> list[tuple[str, State]]:
    """The first ordinary states."""
    return [(name, state) for name, state in states if name.startswith("random")][:most]
