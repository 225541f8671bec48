"""Results against reference and second derivation: the worst difference of every quantity over its natural scale."""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from mahovik.contract.functions import FUNCTIONS
from mahovik.core.stand.model import Stand
from mahovik.core.stand.state import State
from mahovik.errors import StateError
from mahovik.proof import reference
from mahovik.proof.reference.excess import motor_shares
from mahovik.proof.reference.hold import acceleration, allocation, free_equations
from mahovik.proof.reference.inverse import inverse_root
from mahovik.proof.second import Second
from mahovik.proof.verify.actuators import stand_at
from mahovik.proof.verify.bounds import DOUBLE, Bounds
from mahovik.proof.verify.program_backend import is_beyond
from mahovik.proof.verify.scales import scales
from mahovik.proof.verify.scales.magnitudes import Magnitudes
from mahovik.proof.verify.scales.wants import inverse as inverse_scales
from mahovik.proof.verify.states import Request

EXCESS_MARGIN = 1e-3
"""Relative distance of what a flywheel needs from what it has below which rounding may decide EXCESSIVE."""


@dataclass(frozen=True)
class Differences:
    """Differences of the three pairs at one state, as in Row; of judged and reference alone, the others are None."""

    worst: float
    second: float | None = None
    between: float | None = None

    def odd_one(self, tolerance: float, derivations: float, judged: str) -> str:
        """The one of the three that differs: the two that are nearest agree, if they do within what is accepted."""
        pairs = (
            ((self.between or 0.0) / tolerance, f"{judged} and second agree, reference differs"),
            ((self.second or 0.0) / derivations, f"reference and second agree, {judged} differs"),
            (self.worst / tolerance, f"{judged} and reference agree, second differs"),
        )
        nearest, words = min(pairs)
        return words if nearest <= 1 else "no two agree"


@dataclass
class Row:
    """One line of the verdict. Differences are relative; `state` is where they were worst for what is accepted.

    worst         judged - reference
    second        second derivation - reference; None where the second derivation has no such quantity
    between       judged - second derivation; None likewise
    disagreement  which of the three differs, where they do not all agree
    tolerance     accepted of `worst` and `between`, where it is not the report's
    derivations   accepted of `second`, where it is not the tolerance
    at_state      the differences at `state`
    """

    want: str
    quantity: str
    states: int = 0
    worst: float = 0.0
    state: str = ""
    request: Request | None = None
    verdict: str = ""
    reason: str = ""
    second: float | None = None
    between: float | None = None
    disagreement: str = ""
    tolerance: float | None = None
    derivations: float | None = None
    at_state: Differences | None = None

    @property
    def failed(self) -> bool:
        """Whether this row makes the whole verification fail."""
        return self.verdict not in ("ok", "not offered", "not compared")

    @property
    def excess(self) -> float:
        """The largest difference of any pair over what is accepted of it."""
        difference, accepted, _ = self.nearest()
        return difference / accepted

    def nearest(self, at: Differences | None = None) -> tuple[float, float, str]:
        """Difference of the pair that is nearest to its bound, the accepted difference, and the names of the pair.

        `at`: of these differences, by default of the largest.
        """
        found, tolerance = at or Differences(self.worst, self.second, self.between), self.tolerance or 1.0
        pairs = (
            (found.worst, tolerance, "judged and reference"),
            (found.second or 0.0, self.derivations or tolerance, "second and reference"),
            (found.between or 0.0, tolerance, "judged and second"),
        )
        return max(pairs, key=lambda pair: pair[0] / pair[1])

    def note(self, at: Differences, request: Request, reason: str = "") -> None:
        """Count one state; its request is kept where none before was worse."""
        self.states += 1
        difference, accepted, _ = self.nearest(at)
        if self.request is None or difference / accepted > self.excess:
            self.request, self.reason, self.at_state = request, reason, at
            self.state = str(request.id).partition(",")[0]
        self.worst = max(self.worst, at.worst)
        if at.second is not None and at.between is not None:
            self.second, self.between = max(self.second or 0.0, at.second), max(self.between or 0.0, at.between)


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
        self._rows: dict[tuple[str, str], Row] = {}
        self._last: tuple[State | None, str, dict[str, Any] | None] = (None, "", None)
        self._pieces: tuple[State | None, reference.Pieces | None] = (None, None)
        self._undecided = False
        self._answered: set[str] = set()
        self._one_sided: dict[str, list[tuple[Row, float, Request, str]]] = {}

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
        reason: str = "",
    ) -> None:
        """Note the differences of one state, but of what is `left_out`.

        `found`: the judged values; None where the state was refused, for the `reason`.
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
            off, words, between = math.inf, reason, math.inf
            if found is not None:
                off, words = difference(found.get(quantity), value, natural[quantity], floor)
            row = self._row(want, quantity)
            if refusal and found is None:
                row.note(Differences(off, math.inf, 0.0), request, f"{reason}; {refusal}")
            elif refusal:
                self._one_sided.setdefault(want, []).append((row, off, request, refusal))
            elif quantity in second:
                self._answered.add(want)
                other, more = difference(second[quantity], value, natural[quantity], floor)
                if found is not None:
                    between = difference(found.get(quantity), second[quantity], natural[quantity], floor)[0]
                row.note(Differences(off, other, between), request, words or more)
            else:
                row.note(Differences(off), request, words)

    def _compare_at_its_rank(self, request: Request, found: Mapping[str, Any], left_out: Collection[str]) -> None:
        """Note sigma, and phi_ddot and residual for the rank that was found; status and rank depend on rounding.

        Where even the largest sigma is within the accepted difference of zero, it may be taken as zero.
        """
        state, at, cuts = request.state, self._at(request.state), self._bounds.cuts
        sigma, rank = allocation(at, self._stand, np.array(state.V_dot), cuts).sigma, found.get("rank")
        largest = sigma[0] if sigma.size else 0.0
        cut = cuts.rank * largest
        noise = np.max(self._bounds.of("inverse", "sigma") * self._scales(state, "inverse")["sigma"], initial=0.0)
        least, most = int(np.sum(sigma > 10 * cut)) if largest > noise else 0, int(np.sum(sigma > cut / 10))
        if not isinstance(rank, int) or not least <= rank <= most:
            words = f"rank {rank}, expected {least} to {most}"
            self._row("inverse", "rank").note(Differences(math.inf), request, words)
            return
        expected = vars(allocation(at, self._stand, np.array(state.V_dot), cuts, rank))
        natural = inverse_scales(Magnitudes(stand_at(self._stand, state), state, at, cuts), rank)
        for quantity in ("phi_ddot", "residual", "sigma"):
            if quantity not in left_out:
                off, words = difference(found.get(quantity), expected[quantity], natural[quantity], self._bounds.floor)
                self._row("inverse", quantity).note(Differences(off), request, words)

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

    def rows(self) -> list[Row]:
        """All rows with their verdicts, in the order in which the quantities came."""
        skipped = [self._settle(want) for want in self._one_sided]
        self._one_sided = {}
        for row in self._rows.values():
            row.verdict = "ok" if row.states and row.excess <= 1 else "FAILED"
            if row.failed and row.at_state is not None and row.second is not None:
                tolerance = self._bounds.of(row.want, row.quantity)
                row.disagreement = row.at_state.odd_one(tolerance, self._bounds.derivations, self._judged)
        return [*self._rows.values(), *(row for row in skipped if row is not None)]

    def _settle(self, want: str) -> Row | None:
        """Count the states of a want that the second derivation refused; a row of its own where it refused them all."""
        refused = self._one_sided[want]
        for row, off, request, refusal in refused:
            if want in self._answered:
                row.note(Differences(off, math.inf, math.inf), request, refusal)
            else:
                row.note(Differences(off), request)
        if want in self._answered:
            return None
        return Row(want, "second derivation", verdict="not compared", reason=f"{refused[0][-1]}; so at every state")

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

    def _row(self, want: str, quantity: str) -> Row:
        row = Row(want, quantity, tolerance=self._bounds.of(want, quantity), derivations=self._bounds.derivations)
        return self._rows.setdefault((want, quantity), row)


def difference(found: Any, expected: Any, natural: Any, floor: float = DOUBLE.floor) -> tuple[float, str]:
    """Largest |found - expected| / scale over the components, and a reason if the values cannot be compared."""
    if found is None:
        return math.inf, "missing"
    if isinstance(expected, dict):
        return _of_parts(found, expected, natural, floor)
    if natural is None:
        return (0.0, "") if found == expected else (math.inf, f"{found} where the reference has {expected}")
    try:
        numbers = np.array(found, dtype=np.float64)
    except (ValueError, TypeError, OverflowError):
        return math.inf, "no array of numbers"
    wanted = np.asarray(expected, dtype=np.float64)
    if not numbers.size and not wanted.size:
        return 0.0, ""  # an empty list in JSON has no second length
    if numbers.shape != wanted.shape:
        return math.inf, f"shape {list(numbers.shape)}, expected {list(wanted.shape)}"
    if not np.isfinite(numbers).all():
        return math.inf, "not finite"
    with np.errstate(over="ignore"):
        relative = np.abs(numbers - wanted) / np.maximum(natural, floor)
    return float(relative.max()), ""


def _of_parts(found: Any, expected: dict[str, Any], natural: Any, floor: float) -> tuple[float, str]:
    """Difference of the worst part of a nested object, and its words with the name of the part."""
    if not isinstance(found, Mapping):
        return math.inf, "no object"
    worst, words = 0.0, ""
    for name, value in expected.items():
        off, reason = difference(found.get(name), value, natural[name], floor)
        if off > worst:
            worst, words = off, f"{name}: {reason}" if reason else name
    return worst, words


def same_bits(first: Any, second: Any) -> bool:
    """Whether two results hold the same numbers, bit for bit."""
    if isinstance(first, Mapping):
        return first.keys() == second.keys() and all(same_bits(first[name], second[name]) for name in first)
    if isinstance(first, Sequence | np.ndarray) and not isinstance(first, str):
        return len(first) == len(second) and all(map(same_bits, first, second))
    if isinstance(first, float | np.floating):
        return np.float64(first).tobytes() == np.float64(second).tobytes()
    return bool(first == second)
