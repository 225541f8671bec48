"""Results against reference and second derivation: the worst difference of every quantity over its measured scale."""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping, Sequence
from contextlib import suppress
from typing import Any

import numpy as np

from mahovik.contract.functions import FUNCTIONS
from mahovik.contract.limits import DOUBLE, Limits
from mahovik.core.stand.model import Stand
from mahovik.core.stand.state import State
from mahovik.errors import StateError
from mahovik.proof.second import Second
from mahovik.proof.verify.backends import CasadiBackend, is_beyond
from mahovik.proof.verify.check import Check, difference
from mahovik.proof.verify.scales import ROUNDINGS, Scales
from mahovik.proof.verify.states import Request

HALF_TURN = 1e-9
"""Distance from half a turn, rad, at which its angle may be of either sign; or what is accepted, where that is more."""

LAST_PLACES, NEIGHBOURS = 2.0**-51, 3
"""Relative distance of states by which rounding is measured, and how many there are."""


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


class Judge:
    """Compares results of one stand with the reference and keeps the worst of every quantity.

    With `second`, the second derivation is compared as well where it has the want. A state that the reference refuses
    tests nothing; one where rounding decides a word of the answer is left out of the checks of this want, which say so.
    Where the second derivation refuses a want at every state, the others are compared without it, and a check says why;
    where it refuses some states only, the want fails. A reaction of accelerations that are out of range is not
    compared: its function does not take them.
    """

    def __init__(
        self, stand: Stand, limits: Limits = DOUBLE, second: Second | None = None, judged: str = "C",
        scales: Scales | None = None,
    ) -> None:  # fmt: skip
        self._stand, self._limits, self._judged = stand, limits, judged
        self._second = None if second is None else CasadiBackend(stand, second)
        self.scales = scales or Scales(stand, limits.real)
        self._checks: dict[tuple[str, str], Check] = {}
        self._answered: set[str] = set()
        self._one_sided: dict[str, list[tuple[Check, float, Request, str]]] = {}

    def compare(
        self,
        request: Request,
        want: str,
        answer: Mapping[str, Any] | None,
        left_out: Collection[str] = (),
        words: str = "",
    ) -> None:
        """Note the differences of one state, but of what is `left_out`.

        `answer`: the judged values; None where the state was refused, for the reason in `words`.
        """
        measured = self.scales.want(request.state, want)
        if measured is None:
            return
        values = {name: value for name, value in measured.values.items() if name not in left_out}
        if is_beyond(measured.values):
            values.pop("reaction", None)
        if measured.undecided and answer is not None:
            for quantity in values:
                self._check(want, quantity).skip("rounding decides a word of the answer", _name(request))
            return
        second, refusal = self._second_values(request.state, want)
        for quantity, value in values.items():
            off, reason, between = math.inf, words, math.inf
            scale, floor = measured.scales[quantity], self._limits.floor
            if answer is not None:
                if quantity in ("q", "orientation") and self._stand.hold is not None:
                    near = max(HALF_TURN, self._limits.value)
                    answer = {**answer, quantity: _half_turns_as(quantity, value, answer.get(quantity), near)}
                off, reason = difference(answer.get(quantity), value, scale, floor)
            check = self._check(want, quantity)
            check.note_scale(quantity, value, scale)
            if refusal and answer is None:
                self._note(check, (off, math.inf, 0.0), request, f"{reason}; {refusal}")
            elif refusal:
                self._one_sided.setdefault(want, []).append((check, off, request, refusal))
            elif quantity in second:
                self._answered.add(want)
                other, more = difference(second[quantity], value, scale, floor)
                if other > check.accepted_of_second and other <= self._noise(request.state, want, quantity, scale):
                    check.note(off, _name(request), reason, request)
                    continue
                if answer is not None:
                    between = difference(answer.get(quantity), second[quantity], scale, floor)[0]
                self._note(check, (off, other, between), request, reason or more)
            else:
                check.note(off, _name(request), reason, request)

    def _note(self, check: Check, differences: tuple[float, float, float], request: Request, reason: str) -> None:
        """Count a state by its differences: judged and reference, second and reference, judged and second."""
        off, other, between = differences
        accepted = max(check.limit, check.accepted_of_second)
        odd = odd_one(off / check.limit, other / check.accepted_of_second, between / accepted, self._judged)
        check.note(off, _name(request), ": ".join(filter(None, (odd, reason))), request, other)

    def _second_values(self, state: State, want: str) -> tuple[dict[str, Any], str]:
        """Values of the second derivation, none where it does not offer the want, and the words of a refusal."""
        if self._second is None or "second" not in FUNCTIONS[want].judges:
            return {}, ""
        try:
            return self._second.evaluate(state, (want,)), ""
        except StateError as error:
            return {}, f"second derivation refused: {error}"

    def _noise(self, state: State, want: str, quantity: str, scale: Any) -> float:
        """Rounding of the second derivation over a scale, measured: by states that are some last places away.

        It differentiates energies: at the highest speeds terms cancel there that the equations do not have.
        """
        assert self._second is not None
        noise, center = 0.0, self._second.evaluate(state, (want,))[quantity]
        for _ in range(NEIGHBOURS):
            with suppress(StateError):
                moved = self._second.evaluate(self.scales.moved(state, LAST_PLACES), (want,))[quantity]
                noise = max(noise, difference(moved, center, scale, self._limits.floor)[0])
        return ROUNDINGS * noise

    def checks(self) -> list[Check]:
        """All checks, in the order in which the quantities came."""
        skipped = [self._settle(want) for want in self._one_sided]
        self._one_sided = {}
        for check in self._checks.values():
            check.settle()
        return [*self._checks.values(), *(check for check in skipped if check is not None)]

    def _settle(self, want: str) -> Check | None:
        """Count the states of a want that the second derivation refused; a check of its own if it refused them all."""
        refused = self._one_sided[want]
        for check, off, request, refusal in refused:
            if want in self._answered:
                self._note(check, (off, math.inf, math.inf), request, refusal)
            else:
                check.note(off, _name(request), "", request)
        if want in self._answered:
            return None
        return Check(want, "second derivation", words=f"{refused[0][-1]}; so at every state")

    def _check(self, want: str, quantity: str) -> Check:
        check = Check(want, quantity, self._limits.value, second_limit=self._limits.second)
        return self._checks.setdefault((want, quantity), check)


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
