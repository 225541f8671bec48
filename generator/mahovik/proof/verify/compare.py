"""Results against reference and second derivation: the worst difference of every quantity over its measured scale."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from mahovik.contract.functions import FUNCTIONS
from mahovik.contract.limits import Limits
from mahovik.contract.status import STATUS_VALUES, status_words
from mahovik.core.stand.model import Stand, State
from mahovik.errors import StateError
from mahovik.proof.reference.algebra import Array
from mahovik.proof.second import Second
from mahovik.proof.verify.backends import CasadiBackend, is_beyond
from mahovik.proof.verify.c_backend import CBackend
from mahovik.proof.verify.check import Check, difference
from mahovik.proof.verify.scales import LAST_PLACE, ROUNDINGS, Equation, Laws, Measured, Scales, bits_of
from mahovik.proof.verify.states import Request


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


FAR_SIDES = (0.6, 1.6)
"""Parts of its bound at which a number is that decides a bit and is small in the arithmetic, so that rounding moves it:
a singular value, an error, a pivot."""

HALF_TURN = 1e-9
"""Distance from half a turn, rad, at which its angle may be of either sign; or what is accepted, where that is more."""


def _half_turns_as(name: str, expected: Any, result: Any, near: float) -> Any:
    """`q` or `orientation` with the sign of the expected where both are half a turn, as far as `near` tells: rounding
    decides between pi and -pi, and between a quaternion and its negative.
    """
    if np.shape(result) != np.shape(expected):
        return result
    if name == "orientation":
        is_half = max(abs(expected[0]), abs(result[0])) < near
        return np.copysign(1.0, np.dot(expected, result)) * np.asarray(result) if is_half else result
    half = (np.abs(np.abs(expected) - np.pi) < near) & (np.abs(np.abs(result) - np.pi) < near)
    return np.where(half, np.copysign(result, expected), result)


def odd_one(judged: float, second: float, between: float, words: str) -> str:
    """The one of three derivations that differs, by their differences over what is accepted; "" where all agree.

    The two that are nearest agree, if they do within what is accepted. `words`: what is judged.
    """
    if max(judged, second, between) <= 1:
        return ""
    nearest, pair = min(
        (between, f"{words} and second agree, reference differs"),
        (second, f"reference and second agree, {words} differs"),
        (judged, f"{words} and reference agree, second differs"),
    )
    return pair if nearest <= 1 else "no two agree"


class Rows:
    """Checks of one function or want, a check for each quantity of its results, by the limits of the contract.

    A state that the reference refuses tests nothing. One where rounding decides the rank of an answer, or whether there
    is one, is left out; of a status that differs the bit alone that rounding decides. The checks count both, and fail
    where they are many. UNREACHABLE is then judged by the residual of the answer, which is compared itself.

    limits  of the contract, by kind
    scales  the reference with its scales, or laws with theirs; None where the judge measures scales by itself
    judged  name of the function or want
    kind    of all checks that have no other
    second  the second derivation, compared as well where it has the want. Where it refuses the want at every state, the
            others are compared without it, and a check says why; where it refuses some states only, the want fails
    by      what is judged, in words
    """

    def __init__(
        self, limits: Limits, scales: Scales | Laws | None, judged: str, kind: str = "value",
        second: CasadiBackend | None = None, by: str = "C",
    ) -> None:  # fmt: skip
        self.limits, self.function = limits, judged
        self._measures, self._kind, self._second, self._by = scales, kind, second, by
        self._checks: dict[str, Check] = {}
        self._one_sided: list[tuple[Check, float, Request, str]] = []
        self._second_answers, self._by_rounding = False, Counter[str]()

    @property
    def _scales(self) -> Scales:
        """The reference with its scales."""
        assert isinstance(self._measures, Scales)
        return self._measures

    @property
    def _kind_of_values(self) -> str:
        """Kind of the checks of what equations or laws give."""
        return "law" if self._kind == "law" else "value"

    def checks(self) -> list[Check]:
        """All checks, in the order in which their quantities came."""
        more, refused = list[Check](), self._one_sided
        self._one_sided = []
        for check, off, request, refusal in refused:
            if self._second_answers:
                self._note(check, (off, math.inf, math.inf), request, refusal)
            else:
                check.note(off, _name(request), "", request)
        if refused and not self._second_answers:
            more = [Check(self.function, "second derivation", words=f"{refused[0][-1]}; so at every state")]
        for check in self._checks.values():
            check.settle()
        for quantity, count in self._by_rounding.items():
            if not (check := self.check(quantity)).words:
                check.words = f"rounding decides UNREACHABLE at {count} of the states"
        return [*self._checks.values(), *more]

    def add(self, check: Check) -> None:
        """A check with a limit of its own kind, such as one that a file states."""
        self._checks[check.quantity] = check

    def check(self, quantity: str, kind: str = "") -> Check:
        """The check of a quantity."""
        limit, second = getattr(self.limits, kind or self._kind), self.limits.second
        check = Check(self.function, quantity, limit, second_limit=second, floor=self.limits.floor)
        return self._checks.setdefault(quantity, check)

    def demand(self, quantity: str, right: bool, state: str, words: str = "") -> None:
        """Count one state at which only equality is right."""
        self.check(quantity, "exact").demand(right, state, words)

    def judge_reach(
        self, name: str, measured: Measured | None, root: Array, left: Array, most: float, has: bool
    ) -> None:
        """Whether a status `has` UNREACHABLE where the scaled residual root `left` is longer than `most`.

        The solver decides it by what it has left, which is off by rounding from the residual that is given: where that
        decides it, either is right, and the check counts these states.

        `measured`: the residual with its scale.
        """
        error = float(np.linalg.norm(root @ left))
        scale = np.zeros(len(left)) if measured is None else measured.scales["residual"][: len(left)]
        in_doubt = abs(error - most) <= ROUNDINGS * LAST_PLACE[self.limits.real] * np.linalg.norm(root * scale)
        if in_doubt and has != (error > most):
            self._by_rounding["UNREACHABLE"] += 1
        words = f"the error is {error:.1e}, of {most:.1e} accepted"
        self.demand("UNREACHABLE", bool(in_doubt) or has == (error > most), name, words)

    def compare(
        self, name: str, state: Any, equation: Any, answer: Mapping[str, Any], suffix: str = "",
        least_squares: bool = False, weak: Sequence[str] = (),
    ) -> Measured | None:  # fmt: skip
        """Compare results with the answer of an equation at a state, or a law's of inputs, with measured scales.

        None: a state where the reference has no answer is left out. `weak`: quantities of which a solver regularises a
        part, of the kind `optimality`.
        """
        assert self._measures is not None
        try:
            measured = self._measures.measure(state, equation, least_squares)
        except (StateError, np.linalg.LinAlgError) as error:
            self.check(f"answer{suffix}").skip(f"the reference has none: {error}", name)
            return None
        for check, _, _, off, words in self._differences(name, measured, answer, suffix=suffix, weak=weak):
            check.note(off, name, words)
        return measured

    def balance(self, quantity: str, name: str, state: State, sides: Equation, floor: float = 0.0) -> None:
        """Compare the two sides (2xn) of each equation that an answer must solve, over the largest scale in them."""
        measured = self._scales.measure(state, sides, least_squares=True)
        for key, (left, right) in measured.values.items():
            scale = np.full(left.shape, np.max(measured.scales[key], initial=0.0) + floor)
            self.check(quantity, "value").compare(left, right, scale, name)

    def compare_want(
        self, request: Request, answer: Mapping[str, Any] | None, left_out: Collection[str] = (), words: str = ""
    ) -> None:
        """Compare the answer to a want of `eval` at one state, but what is `left_out`, and the second derivation's.

        `answer`: None where the state was refused, for the reason in `words`. A reaction of accelerations that are out
        of range is not compared: its function does not take them. Nor is a refusal with RANGE where phi_ddot of
        `inverse` is beyond the largest number of the element type: there the C may divide by what is too small.
        """
        measured = self._scales.want(request.state, self.function)
        if measured is None or (answer is None and "RANGE" in words and self._is_unbounded(measured)):
            return
        if self.function == "inverse" and not request.state.task and answer is not None:
            measured = self._reached(request.state, measured, answer)
        left_out = (*left_out, *(("reaction",) if is_beyond(measured.values) else ()))
        second, refusal = self._second_values(request.state)
        for check, quantity, result, off, reason in self._differences(
            _name(request), measured, answer, left_out=left_out, words=words
        ):
            if refusal and answer is None:
                self._note(check, (off, math.inf, 0.0), request, f"{reason}; {refusal}")
            elif refusal:
                self._one_sided.append((check, off, request, refusal))
            elif quantity in second:
                self._second_answers = True
                value, scale, between = measured.values[quantity], measured.scales[quantity], math.inf
                other, more = difference(second[quantity], value, scale, check.floor)
                if answer is not None:
                    between = difference(result, second[quantity], scale, check.floor)[0]
                self._note(check, (off, other, between), request, reason or more)
            else:
                check.note(off, _name(request), reason, request)

    def _reached(self, state: State, measured: Measured, answer: Mapping[str, Any]) -> Measured:
        """What is expected, with UNREACHABLE by the residual of the answer where rounding decides it.

        Beyond the largest number of the element type phi_ddot is LIMITED to it.
        """
        due, bits = self._scales.reach(state, measured, answer.get("residual")), bits_of(measured.values["status"])
        if due is not None and due != ("UNREACHABLE" in bits):
            self._by_rounding["status"] += 1
            bits ^= {"UNREACHABLE"}
        if self._is_unbounded(measured):
            bits |= {"LIMITED"}
        status = status_words(sum(STATUS_VALUES[bit] for bit in bits))
        return replace(measured, values={**measured.values, "status": status})

    def _is_unbounded(self, measured: Measured) -> bool:
        """Whether phi_ddot of `inverse` is beyond the largest number of the element type."""
        most = np.max(np.abs(measured.values.get("phi_ddot", 0.0)), initial=0.0)
        return self.function == "inverse" and bool(most > self._scales.precision.largest)

    def _differences(
        self, name: str, measured: Measured, answer: Mapping[str, Any] | None, suffix: str = "",
        weak: Sequence[str] = (), left_out: Collection[str] = (), words: str = "",
    ) -> Iterator[tuple[Check, str, Any, float, str]]:  # fmt: skip
        """Check, quantity, result, difference and words on it, of all quantities of an answer that are compared."""
        for quantity, value in measured.values.items():
            if quantity in left_out:
                continue
            kind, of_weak = ("optimality", ", of weak directions") if quantity in weak else (self._kind_of_values, "")
            check, scale = self.check(f"{quantity}{of_weak}{suffix}", kind), measured.scales[quantity]
            if answer is None:
                check.note_scale(quantity, value, scale)
                yield check, quantity, None, math.inf, words
                continue
            result, bits = answer.get(quantity), set[str]()
            if measured.undecided:
                check.skip("rounding decides a word of the answer", name)
                continue
            if quantity == "status" and isinstance(result, str):
                bits = bits_of(result) ^ bits_of(value)
            if bits and bits <= measured.in_doubt:
                check.skip(f"rounding decides {', '.join(sorted(bits))}", name)
                continue
            check.note_scale(quantity, value, scale)
            if quantity in ("q", "orientation") and self._kind != "law" and self._scales.stand.hold is not None:
                result = _half_turns_as(quantity, value, result, max(HALF_TURN, self.limits.value))
            yield check, quantity, result, *difference(result, measured.exact.get(quantity, value), scale, check.floor)

    def _note(self, check: Check, differences: tuple[float, float, float], request: Request, reason: str) -> None:
        """Count a state by its differences: judged and reference, second and reference, judged and second."""
        off, other, between = differences
        accepted = max(check.limit, check.accepted_of_second)
        odd = odd_one(off / check.limit, other / check.accepted_of_second, between / accepted, self._by)
        check.note(off, _name(request), ": ".join(filter(None, (odd, reason))), request, other)

    def _second_values(self, state: State) -> tuple[dict[str, Any], str]:
        """Values of the second derivation, none where it does not offer the want, and the words of a refusal."""
        if self._second is None or "second" not in FUNCTIONS[self.function].judges:
            return {}, ""
        try:
            return self._second.evaluate(state, (self.function,)), ""
        except StateError as error:
            return {}, f"second derivation refused: {error}"


def _name(request: Request) -> str:
    """Name of the state of a request."""
    return str(request.id).partition(",")[0]


def same_bits(first: Any, second: Any) -> bool:
    """Whether two results hold the same numbers, bit for bit."""
    if isinstance(first, Mapping):
        return first.keys() == second.keys() and all(same_bits(first[name], second[name]) for name in first)
    if isinstance(first, Sequence | np.ndarray) and not isinstance(first, str):
        return len(first) == len(second) and all(map(same_bits, first, second))
    if isinstance(first, float | np.floating):
        return np.float64(first).tobytes() == np.float64(second).tobytes()
    return bool(first == second)
