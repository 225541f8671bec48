"""Results against reference and second derivation: the worst difference of every quantity over its natural scale."""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping, Sequence
from typing import Any

import numpy as np

from mahovik.contract.functions import FUNCTIONS
from mahovik.core.stand.model import Stand
from mahovik.core.stand.state import State
from mahovik.errors import StateError
from mahovik.proof import reference
from mahovik.proof.reference.hold import acceleration, free_equations
from mahovik.proof.reference.inverse import inverse, inverse_root, motor_shares
from mahovik.proof.second import Second
from mahovik.proof.verify.actuators import stand_at
from mahovik.proof.verify.bounds import Bounds
from mahovik.proof.verify.check import Check, difference
from mahovik.proof.verify.program_backend import is_beyond
from mahovik.proof.verify.scales import scales
from mahovik.proof.verify.scales.magnitudes import Magnitudes
from mahovik.proof.verify.scales.wants import inverse as inverse_scales
from mahovik.proof.verify.states import Request

EXCESS_MARGIN = 1e-3
"""Relative distance of what a flywheel needs from what it has below which rounding may decide EXCESSIVE."""


def odd_one(judged: float, second: float, between: float, words: str) -> str:
    """Which of three derivations differs, by their differences over what is accepted; "" where all agree.

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

    With `second`, the second derivation, all three are compared with one another where it has the want.
    A state that the reference refuses tests nothing, and `expected` is None there. Where the rank or status of
    `inverse` depends on the last digits of a singular value, the rank of the judged program is taken if it is one of
    those that rounding allows, and its answer is compared with that of the reference for this rank.
    Where the second derivation refuses a want at every state, the others are compared without it, and a row says why;
    where it refuses some states only, the want fails. A reaction of accelerations that are out of range is not
    compared: its function does not take them.
    """

    def __init__(self, stand: Stand, bounds: Bounds, second: Second | None = None, judged: str = "C") -> None:
        self._stand = stand
        self._bounds = bounds
        self._second = second
        self._judged = judged
        self._seconds: dict[tuple[tuple[str, float], ...], Second] = {}
        self._rows: dict[tuple[str, str], Check] = {}
        self._last: tuple[State | None, str, dict[str, Any] | None] = (None, "", None)
        self._pieces: tuple[State | None, reference.Pieces | None] = (None, None)
        self._undecided = False
        self._answered: set[str] = set()
        self._one_sided: dict[str, list[tuple[Check, float, Request, str]]] = {}

    def _second_of(self, state: State) -> Second:
        """The second derivation with the deflections and speeds of a state, which are numbers in its expressions."""
        assert self._second is not None
        if not state.actuators:
            return self._second
        return self._seconds.setdefault(tuple(state.actuators.items()), Second(stand_at(self._stand, state)))

    def expected_answer(self, state: State, want: str) -> dict[str, Any] | None:
        """Answer of the reference, or None."""
        if self._last[0] is not state or self._last[1] != want:
            found: dict[str, Any] | None
            try:
                found = reference.evaluate(
                    stand_at(self._stand, state), state, [want], self._at(state), self._bounds.cuts
                )
            except (StateError, np.linalg.LinAlgError, ArithmeticError):
                found = None
            self._undecided = found is not None and want == "inverse" and self._ambiguous(found, state)
            self._last = (state, want, found)
        return self._last[2]

    def compare(
        self,
        request: Request,
        want: str,
        found: Mapping[str, Any] | None,
        left_out: Collection[str] = (),
        words: str = "",
    ) -> None:
        """Note the differences of one state, but of what is `left_out`.

        `found`: the judged values; None where the state was refused, for the reason in `words`.
        """
        expected = self.expected_answer(request.state, want)
        if expected is None:
            return
        if self._undecided and found is not None:
            self._compare_at_its_rank(request, found, left_out)
            return
        natural, floor = self._scales(request.state, want), self._bounds.floor
        second, refusal = self._second_values(request.state, want)
        for quantity, value in expected.items():
            if quantity in left_out or (quantity == "reaction" and is_beyond(expected)):
                continue
            off, reason, between = math.inf, words, math.inf
            if found is not None:
                off, reason = difference(found.get(quantity), value, natural[quantity], floor)
            row = self._row(want, quantity)
            if refusal and found is None:
                self._note(row, (off, math.inf, 0.0), request, f"{reason}; {refusal}")
            elif refusal:
                self._one_sided.setdefault(want, []).append((row, off, request, refusal))
            elif quantity in second:
                self._answered.add(want)
                other, more = difference(second[quantity], value, natural[quantity], floor)
                if found is not None:
                    between = difference(found.get(quantity), second[quantity], natural[quantity], floor)[0]
                self._note(row, (off, other, between), request, reason or more)
            else:
                row.note(off, _name(request), reason, request)

    def _note(self, row: Check, differences: tuple[float, float, float], request: Request, reason: str) -> None:
        """Count a state by its differences: judged and reference, second and reference, judged and second."""
        off, other, between = differences
        odd = odd_one(off / row.limit, other / row.accepted_of_second, between / row.limit, self._judged)
        row.note(off, _name(request), ": ".join(filter(None, (odd, reason))), request, other)

    def _compare_at_its_rank(self, request: Request, found: Mapping[str, Any], left_out: Collection[str]) -> None:
        """Note sigma, and phi_ddot and residual for the rank that was found; status and rank depend on rounding.

        Where even the largest sigma is within the accepted difference of zero, it may be taken as zero.
        """
        state, at, cuts = request.state, self._at(request.state), self._bounds.cuts
        sigma, rank = inverse(at, self._stand, np.array(state.V_dot), cuts).sigma, found.get("rank")
        largest = sigma[0] if sigma.size else 0.0
        cut = cuts.rank * largest
        noise = np.max(self._bounds.of("inverse", "sigma") * self._scales(state, "inverse")["sigma"], initial=0.0)
        least, most = int(np.sum(sigma > 10 * cut)) if largest > noise else 0, int(np.sum(sigma > cut / 10))
        if not isinstance(rank, int) or not least <= rank <= most:
            words = f"rank {rank}, expected {least} to {most}"
            self._row("inverse", "rank").note(math.inf, _name(request), words, request)
            return
        expected = vars(inverse(at, self._stand, np.array(state.V_dot), cuts, rank))
        natural = inverse_scales(Magnitudes(stand_at(self._stand, state), state, at, cuts), rank)
        for quantity in ("phi_ddot", "residual", "sigma"):
            if quantity not in left_out:
                off, words = difference(found.get(quantity), expected[quantity], natural[quantity], self._bounds.floor)
                self._row("inverse", quantity).note(off, _name(request), words, request)

    def _ambiguous(self, found: Mapping[str, Any], state: State) -> bool:
        """Whether rank or status of `inverse` depends on rounding.

        That is, a singular value within a factor of ten of a threshold, or so near to it as the accepted difference
        of `sigma`; or a residual as near to UNREACHABLE as the accepted difference of `residual`; or a flywheel that
        needs what it has, within EXCESS_MARGIN.
        """
        sigma = np.asarray(found["sigma"])
        if sigma.size and sigma[0] == 0.0:
            return False
        bounds, natural, at = self._bounds, self._scales(state, "inverse"), self._at(state)
        ratios = sigma / sigma[0] if sigma.size else sigma
        apart = bounds.of("inverse", "sigma") * natural["sigma"] / sigma[0] if sigma.size else sigma
        for cut in (bounds.cuts.rank, bounds.cuts.near_singular):
            near = (ratios > cut / 10) & (ratios < cut * 10) | (np.abs(ratios - cut) < apart)
            if np.any(near):
                return True
        moved = acceleration(at, self._stand, found["phi_ddot"])
        needed = motor_shares(self._stand, at, moved, found["phi_ddot"])
        if np.any(np.abs(needed - 1.0) < EXCESS_MARGIN):
            return True
        free = free_equations(at, self._stand)
        root = inverse_root(free.K)
        left = np.asarray(found["residual"])
        demand = float(np.linalg.norm(root @ (left + free.I @ found["phi_ddot"])))
        off = float(np.linalg.norm(np.abs(root) @ (bounds.of("inverse", "residual") * natural["residual"])))
        return abs(float(np.linalg.norm(root @ left)) - bounds.cuts.reached * demand) < off

    def _second_values(self, state: State, want: str) -> tuple[dict[str, Any], str]:
        """Values of the second derivation, none where it does not offer the want, and the words of a refusal."""
        if self._second is None or "second" not in FUNCTIONS[want].judges:
            return {}, ""
        try:
            return self._second_of(state).evaluate(state, (want,)), ""
        except StateError as error:
            return {}, f"second derivation refused: {error}"

    def rows(self) -> list[Check]:
        """All rows with their verdicts, in the order in which the quantities came."""
        skipped = [self._settle(want) for want in self._one_sided]
        self._one_sided = {}
        return [*self._rows.values(), *(row for row in skipped if row is not None)]

    def _settle(self, want: str) -> Check | None:
        """Count the states of a want that the second derivation refused; a row of its own where it refused them all."""
        refused = self._one_sided[want]
        for row, off, request, refusal in refused:
            if want in self._answered:
                self._note(row, (off, math.inf, math.inf), request, refusal)
            else:
                row.note(off, _name(request), "", request)
        if want in self._answered:
            return None
        return Check(want, "second derivation", words=f"{refused[0][-1]}; so at every state")

    def _scales(self, state: State, want: str) -> dict[str, Any]:
        with np.errstate(all="ignore"):
            return scales(stand_at(self._stand, state), state, self._at(state), want, self._bounds.cuts)

    def _at(self, state: State) -> reference.Pieces:
        """Pieces of a state, kept for its other wants."""
        known, at = self._pieces
        if known is not state or at is None:
            with np.errstate(all="ignore"):
                at = reference.pieces(stand_at(self._stand, state), state)
            self._pieces = (state, at)
        return at

    def _row(self, want: str, quantity: str) -> Check:
        row = Check(want, quantity, self._bounds.of(want, quantity), second_limit=self._bounds.derivations)
        return self._rows.setdefault((want, quantity), row)


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
