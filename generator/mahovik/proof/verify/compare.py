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
from mahovik.proof.reference.inverse import inverse_root
from mahovik.proof.second import Second
from mahovik.proof.verify.bounds import DOUBLE, Bounds
from mahovik.proof.verify.scales import scales
from mahovik.proof.verify.states import Request


@dataclass(frozen=True)
class Three:
    """Differences of the three pairs at one state; the names are those of Row."""

    worst: float
    second: float
    between: float

    def alone(self, tolerance: float, derivations: float, judged: str) -> str:
        """Who stands alone: the two that are nearest are taken to agree, if they do within what is accepted."""
        pairs = (
            (self.between / tolerance, f"{judged} and second agree, reference differs"),
            (self.second / derivations, f"reference and second agree, {judged} differs"),
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
    disagreement  who stands alone, where they do not all agree
    tolerance     accepted of `worst` and `between`, where it is not the report's
    derivations   accepted of `second`, where it is not the tolerance
    three         the differences of `state`
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
    three: Three | None = None

    @property
    def failed(self) -> bool:
        """Whether the whole verification fails by this row."""
        return self.verdict not in ("ok", "not offered", "not compared")

    @property
    def excess(self) -> float:
        """The largest difference of any pair over what is accepted of it."""
        return self._excess(Three(self.worst, self.second or 0.0, self.between or 0.0))

    def _excess(self, three: Three) -> float:
        return max(difference / accepted for difference, accepted, _ in self._pairs(three))

    def nearest(self) -> tuple[float, float, str]:
        """Difference of the pair that is nearest to its bound, the accepted difference, and the names of the pair."""
        three = Three(self.worst, self.second or 0.0, self.between or 0.0)
        return max(self._pairs(three), key=lambda pair: pair[0] / pair[1])

    def _pairs(self, three: Three) -> tuple[tuple[float, float, str], ...]:
        tolerance = self.tolerance or 1.0
        return (
            (three.worst, tolerance, "judged and reference"),
            (three.second, self.derivations or tolerance, "second and reference"),
            (three.between, tolerance, "judged and second"),
        )

    def note(self, difference: float, request: Request, reason: str = "") -> None:
        """Count one state, of what the second derivation does not have."""
        self.states += 1
        self._keep(Three(difference, 0.0, 0.0), request, reason)
        self.worst = max(self.worst, difference)

    def note_three(self, three: Three, request: Request, reason: str = "") -> None:
        """Count one state that all three have evaluated, or refused."""
        self.states += 1
        if self._keep(three, request, reason):
            self.three = three
        self.worst = max(self.worst, three.worst)
        self.second = max(self.second or 0.0, three.second)
        self.between = max(self.between or 0.0, three.between)

    def _keep(self, three: Three, request: Request, reason: str) -> bool:
        """Keep this state where none before was worse."""
        if self.request is not None and self._excess(three) <= self.excess:
            return False
        self.request, self.reason = request, reason
        self.state = str(request.id).partition(",")[0]
        return True


class Judge:
    """Compares results of one stand with the reference and keeps the worst of every quantity.

    With `second`, the second derivation, all three are compared with one another where it has the want.
    A state that the reference refuses is no test of anybody, and `expected` is None there; so is a state of
    `inverse` whose rank or status hangs on the last digits of a singular value.
    """

    def __init__(self, stand: Stand, bounds: Bounds, second: Second | None = None, judged: str = "C") -> None:
        self._stand = stand
        self._bounds = bounds
        self._second = second
        self._judged = judged
        self._rows: dict[tuple[str, str], Row] = {}
        self._last: tuple[State | None, str, dict[str, Any] | None] = (None, "", None)
        self._pieces: tuple[State | None, reference.Pieces | None] = (None, None)

    def expected(self, state: State, want: str) -> dict[str, Any] | None:
        """What the reference gives, or None."""
        if self._last[0] is not state or self._last[1] != want:
            self._last = (state, want, self._evaluated(state, want))
        return self._last[2]

    def _evaluated(self, state: State, want: str) -> dict[str, Any] | None:
        try:
            found = reference.evaluate(self._stand, state, [want], self._at(state), self._bounds.cuts)
        except (StateError, np.linalg.LinAlgError, ArithmeticError):
            return None
        return None if want == "inverse" and self._ambiguous(found, state) else found

    def compare(self, request: Request, want: str, found: Mapping[str, Any], left_out: Collection[str] = ()) -> float:
        """Note the differences of one state, but of what is `left_out`; returns the largest from the reference."""
        expected = self.expected(request.state, want)
        if expected is None:
            return 0.0
        natural, floor = self._scales(request.state, want), self._bounds.floor
        second, refusal = self._second_values(request.state, want)
        largest = 0.0
        for quantity, value in expected.items():
            if quantity in left_out:
                continue
            off, reason = difference(found.get(quantity), value, natural[quantity], floor)
            largest = max(largest, off)
            row = self._row(want, quantity)
            if refusal:
                row.note_three(Three(off, math.inf, math.inf), request, refusal)
            elif quantity in second:
                other, words = difference(second[quantity], value, natural[quantity], floor)
                apart = difference(found.get(quantity), second[quantity], natural[quantity], floor)[0]
                row.note_three(Three(off, other, apart), request, reason or words)
            else:
                row.note(off, request, reason)
        return largest

    def refused(self, request: Request, want: str, reason: str, left_out: Collection[str] = ()) -> None:
        """Note a state that was refused though the reference evaluates it; of what is `left_out`, nothing."""
        expected = self.expected(request.state, want)
        if expected is None:
            return
        natural, floor = self._scales(request.state, want), self._bounds.floor
        second, refusal = self._second_values(request.state, want)
        for quantity, value in expected.items():
            if quantity in left_out:
                continue
            row = self._row(want, quantity)
            if refusal:
                row.note_three(Three(math.inf, math.inf, 0.0), request, f"{reason}; {refusal}")
            elif quantity in second:
                other = difference(second[quantity], value, natural[quantity], floor)[0]
                row.note_three(Three(math.inf, other, math.inf), request, reason)
            else:
                row.note(math.inf, request, reason)

    def _ambiguous(self, found: Mapping[str, Any], state: State) -> bool:
        """Whether rank or status of `inverse` hangs on rounding.

        That is, a singular value within a factor of ten of a threshold, or so near to it as the accepted difference
        of `sigma`; or a residual as near to UNREACHABLE as the accepted difference of `residual`.
        """
        sigma = np.asarray(found["sigma"])
        if not sigma.size or sigma[0] == 0.0:
            return False
        bounds, natural, at = self._bounds, self._scales(state, "inverse"), self._at(state)
        ratios = sigma / sigma[0]
        apart = bounds.of("inverse", "sigma") * natural["sigma"] / sigma[0]
        for cut in (bounds.cuts.rank, bounds.cuts.near):
            near = (ratios > cut / 10) & (ratios < cut * 10) | (np.abs(ratios - cut) < apart)
            if np.any(near):
                return True
        root = inverse_root(at.K)
        left = np.asarray(found["residual"])
        demand = float(np.linalg.norm(root @ (left + at.I @ found["phi_ddot"])))
        off = float(np.linalg.norm(np.abs(root) @ (bounds.of("inverse", "residual") * natural["residual"])))
        return abs(float(np.linalg.norm(root @ left)) - bounds.cuts.reached * demand) < off

    def _second_values(self, state: State, want: str) -> tuple[dict[str, Any], str]:
        """Values of the second derivation, none where it does not offer the want, and the words of a refusal."""
        if self._second is None or "second" not in FUNCTIONS[want].judges:
            return {}, ""
        try:
            return self._second.evaluate(state, (want,)), ""
        except StateError as error:
            return {}, f"second derivation refused: {error}"

    def rows(self) -> list[Row]:
        """All rows with their verdicts, in the order in which the quantities came."""
        for row in self._rows.values():
            row.verdict = "ok" if row.states and row.excess <= 1 else "FAILED"
            if row.failed and row.three is not None:
                row.disagreement = row.three.alone(
                    self._bounds.of(row.want, row.quantity), self._bounds.derivations, self._judged
                )
        return list(self._rows.values())

    def _scales(self, state: State, want: str) -> dict[str, Any]:
        with np.errstate(all="ignore"):
            return scales(self._stand, state, self._at(state), want, self._bounds.cuts)

    def _at(self, state: State) -> reference.Pieces:
        """Pieces of a state, kept for all that is wanted of it."""
        known, at = self._pieces
        if known is not state or at is None:
            with np.errstate(all="ignore"):
                at = reference.pieces(self._stand, state)
            self._pieces = (state, at)
        return at

    def _row(self, want: str, quantity: str) -> Row:
        row = Row(want, quantity, tolerance=self._bounds.of(want, quantity), derivations=self._bounds.derivations)
        return self._rows.setdefault((want, quantity), row)


def difference(found: Any, expected: Any, natural: Any, floor: float = DOUBLE.floor) -> tuple[float, str]:
    """Largest |found - expected| / scale over the components, and words where there is more to say than that."""
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
    if numbers.shape != wanted.shape:
        return math.inf, f"shape {list(numbers.shape)}, expected {list(wanted.shape)}"
    if not numbers.size:
        return 0.0, ""
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
