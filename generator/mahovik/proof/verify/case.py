"""A stand, its program and some ordinary states: what every judge of a function starts from; and the rows it fills."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from types import MappingProxyType
from typing import Any

import numpy as np

from mahovik.contract.limits import Limits
from mahovik.contract.status import status_words
from mahovik.core.stand.model import Stand
from mahovik.core.stand.state import State
from mahovik.errors import StateError
from mahovik.proof.reference.array import Array
from mahovik.proof.second import Second
from mahovik.proof.verify.c_backend import CBackend
from mahovik.proof.verify.check import Check, difference
from mahovik.proof.verify.scales import Equation, Scales


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


class Rows:
    """Checks of one function, one for each quantity of its results. Limits are those of the contract, by kind (Limits).

    kind    kind of the judge, of all checks that have no other
    scales  the reference with its scales; None where the judge measures scales by itself
    """

    def __init__(self, limits: Limits, scales: Scales | None, function: str, kind: str = "value") -> None:
        self.limits, self.function = limits, function
        self._scales, self._kind = scales, kind
        self._checks: dict[str, Check] = {}

    def checks(self) -> list[Check]:
        """All checks, in the order in which their quantities came."""
        for check in self._checks.values():
            check.settle()
        return [*self._checks.values()]

    def add(self, check: Check) -> None:
        """A check with a limit of its own kind, such as one that a file states."""
        self._checks[check.quantity] = check

    def check(self, quantity: str, kind: str = "") -> Check:
        """The check of a quantity."""
        limit = getattr(self.limits, kind or self._kind)
        return self._checks.setdefault(quantity, Check(self.function, quantity, limit, floor=self.limits.floor))

    def demand(self, quantity: str, right: bool, state: str, words: str = "") -> None:
        """Count one state at which only equality is right."""
        self.check(quantity, "exact").demand(right, state, words)

    def compare(
        self, name: str, state: State, equation: Equation, answer: Mapping[str, Any], suffix: str = "",
        least_squares: bool = False, weak: Sequence[str] = (),
    ) -> None:  # fmt: skip
        """Compare results with the answer of an equation, each of its quantities, with measured scales.

        A state where the reference has no answer, or where rounding decides a word of it, is left out. `weak`:
        quantities of which a solver regularises a part, of the kind `optimality`.
        """
        assert self._scales is not None
        try:
            measured = self._scales.measure(state, equation, least_squares)
        except (StateError, np.linalg.LinAlgError) as error:
            self.check(f"answer{suffix}").skip(f"the reference has none: {error}", name)
            return
        for quantity, value in measured.values.items():
            kind, words = ("optimality", ", of weak directions") if quantity in weak else ("value", "")
            check, scale = self.check(f"{quantity}{words}{suffix}", kind), measured.scales[quantity]
            if measured.undecided:
                check.skip("rounding decides a word of the answer", name)
                continue
            check.note_scale(quantity, value, scale)
            off, words = difference(answer.get(quantity), value, scale, check.floor)
            check.note(off, name, words)

    def balance(self, quantity: str, name: str, state: State, sides: Equation, floor: float = 0.0) -> None:
        """Compare the two sides (2xn) of each equation that an answer must solve, over the largest scale in them."""
        assert self._scales is not None
        measured = self._scales.measure(state, sides, least_squares=True)
        for key, (left, right) in measured.values.items():
            scale = np.full(left.shape, np.max(measured.scales[key], initial=0.0) + floor)
            self.check(quantity, "value").compare(left, right, scale, name)


def ordinary(states: Sequence[tuple[str, State]], inputs: Sequence[str], most: int) -> list[tuple[str, State]]:
    """The first ordinary states, with run-time wrenches only on bodies that take one (`inputs`)."""
    chosen = [(name, state) for name, state in states if name.startswith(("random", "wrenched"))][:most]
    return [
        (name, replace(state, wrench=MappingProxyType({b: w for b, w in state.wrench.items() if b in inputs})))
        for name, state in chosen
    ]
