"""The search: which fault, or part of one, or two, predict the error that was found."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from mahovik.core.stand.model import Stand
from mahovik.proof.diagnose.answer_vector import Numbers
from mahovik.proof.diagnose.fault import Fault
from mahovik.proof.diagnose.faults import DICTIONARY
from mahovik.proof.diagnose.predict import Part, Predictions, Suspect, single_faults
from mahovik.proof.reference.array import Array

ABSENT = 0.1
"""Weight of quantities that a fault would spoil and that are right: a program may have it in one function only."""


@dataclass(frozen=True)
class Match:
    """Likeness of a predicted error p and the error e that was found.

    score   0: p is e to rounding; 1: it explains nothing of it
    rest    the same over the quantities that are wrong, without what is right and should not be
    absent  indices of the quantities that p would spoil and that are right
    """

    score: float
    rest: float
    absent: tuple[int, ...]


def match(e: Array, p: Array, noise: Array, block: NDArray[np.int64]) -> Match:
    """Number by number, so that a small term counts as much as a large one; the mean of each quantity, then of all.

    Numbers that are within `noise` in both are not counted. A p that is not a number explains nothing.
    """
    wrong, predicted = np.abs(e) > noise, ~(np.abs(p) <= noise)
    count = int(block.max()) + 1 if block.size else 0
    with np.errstate(all="ignore"):
        off = (np.abs(e - p) - noise) / np.maximum(np.abs(e), np.abs(p))
    off = np.clip(np.nan_to_num(off, nan=1.0, posinf=1.0), 0.0, 1.0)
    active = wrong | predicted
    of_block = np.bincount(block[active], minlength=count)
    mean = np.bincount(block[active], weights=off[active], minlength=count) / np.maximum(of_block, 1)
    spoiled = np.bincount(block[wrong], minlength=count) > 0
    absent = (of_block > 0) & ~spoiled
    if not spoiled.any():
        return Match(1.0, 1.0, tuple(np.flatnonzero(absent)))
    rest = float(mean[spoiled].mean())
    missing = float(absent.sum() / (absent.sum() + spoiled.sum()))
    return Match(rest + ABSENT * missing, rest, tuple(int(i) for i in np.flatnonzero(absent)))


def share(e: Array, p: Array, noise: Array) -> float:
    """a of e = a p: least squares of each number over its size, without what is far from the middle; 0 where p is."""
    seen = np.isfinite(p) & (np.abs(p) > 10 * noise)
    if not seen.any():
        return 0.0
    ratios = e[seen] / p[seen]
    a = float(np.median(ratios))
    near = np.abs(ratios - a) <= 0.5 * abs(a)
    if not near.any():
        return a
    weight = 1.0 / np.maximum(np.abs(e[seen][near]), np.abs(p[seen][near])) ** 2
    product = float(np.sum(weight * e[seen][near] * p[seen][near]))
    return product / float(np.sum(weight * p[seen][near] ** 2))


EXACT = 1e-3
"""Scores below this are the fault itself: the search ends."""

NAMING_SCORE = 0.1
"""Largest score of what is named, a fault, a part of one, or two: it explains nine tenths of the error."""

PENALTY = 0.05
"""Added to the score of a part of a fault, or of two: a whole single one that is as good comes first."""

LEAST_SHARE, LARGEST_SHARE = 0.02, 50.0
"""Range of the parts of a fault in the search; smaller ones look like rounding."""

WHOLE = 1e-3
"""Largest distance from 1 of a share that counts as the whole."""

ALIKE = 0.5
"""Part of the wrong quantities that a fault must spoil in all flywheels, to be tried in one flywheel."""

BY_PLACE = ("position ignored", "stream ignored", "stream, sign", "stream not turned into E1")
"""Faults that some wrong profile of the stream resembles: with a profile they are named only if they are exact."""

LARGEST_PRINTED = 3.0
"""Largest multiple of a fault that is mentioned beside the cause or as the nearest: a larger one says nothing."""

SHORT_LIST = 5
"""Number of suspects that are examined at all states."""

PAIR_CANDIDATES = 40
"""Number of single faults that are tried two at a time."""

TWIN = 1e-3
"""Largest score between the predictions of two faults that this stand cannot tell apart; or between their scores."""


@dataclass(frozen=True)
class Finding:
    """A suspect, the share of its error that was found, and how well it explains what was found.

    by_profile  whether the stream of the stand depends on depth
    """

    suspect: Suspect
    share: float
    match: Match
    by_profile: bool = False

    @property
    def cost(self) -> float:
        """Score plus penalties: for a second fault, for a share that is not 1, for a fault of a single flywheel.

        So a whole fault of all flywheels comes first among explanations that fit alike.
        """
        alone = 0.01 * PENALTY * sum(part.wheel is not None for part in self.suspect)
        a_part = PENALTY * (1.0 + 0.1 * min(abs(self.share - 1.0), 1.0)) if self.share != 1.0 else 0.0
        return self.match.score + PENALTY * (len(self.suspect) - 1) + a_part + alone

    @property
    def can_be_named(self) -> bool:
        """Whether its score is low enough to name it; a likeness of a wrong profile of the stream must be exact."""
        if self.by_profile and any(fault.name in BY_PLACE for fault in self.faults):
            return self.share == 1.0 and self.match.score <= EXACT
        return self.match.score <= NAMING_SCORE

    @property
    def can_be_mentioned(self) -> bool:
        """Whether a reader can make something of its share."""
        return abs(self.share) <= LARGEST_PRINTED

    @property
    def faults(self) -> set[Fault]:
        """The faults of its suspect, in whichever flywheels."""
        return {part.fault for part in self.suspect}

    def repeats(self, other: Finding) -> bool:
        """Whether it has the faults of the other: in other flywheels, in another share, or with one more."""
        return other.faults <= self.faults


@dataclass(frozen=True)
class Evidence:
    """The error of a program over the scale, and what may be rounding; `first` numbers are enough to search by."""

    e: Array
    noise: Array
    block: Numbers
    first: int


class Search:
    """The search of one program's error through the dictionary."""

    def __init__(self, stand: Stand, evidence: Evidence, predictions: Predictions) -> None:
        self._stand = stand
        self._predictions = predictions
        self._tried: list[Suspect] = []  # single ones, so far
        answered = np.isfinite(evidence.e)
        self._asked = (answered[: evidence.first], answered)
        self._e_first, self._e_whole = (evidence.e[: asked.size][asked] for asked in self._asked)
        self._noise_first, self._noise_whole = (evidence.noise[: asked.size][asked] for asked in self._asked)
        self._blocks = tuple(evidence.block[: asked.size][asked] for asked in self._asked)
        self._early = bool(np.any(np.abs(self._e_first) > self._noise_first))

    def rank_suspects(self, freely: bool = True) -> list[Finding]:
        """Suspects, the best first: wider and wider, until one is exact. `freely`: parts and pairs as well."""
        found: list[Finding] = []
        for stage in (self._of_all, self._of_one, *((self._parts, self._pairs) if freely else ())):
            found = self._confirm([*found, *stage(found)])
            if found and found[0].match.score <= EXACT:
                break
        return found

    def invisible_faults(self) -> list[Suspect]:
        """Faults that change nothing at the requested states: with them a program looks correct."""
        return [each for each in single_faults(DICTIONARY) if not self._visible(each)]

    def equal_findings(self, finding: Finding, ranked: Sequence[Finding]) -> list[Finding]:
        """Findings as good as this one: each predicts the same at all states, or explains as much of what was found.

        Of a whole fault: all that were tried, whole, and the same in one flywheel; of a part of one, or of two: those
        of `ranked`.
        """
        found = {each.suspect: each for each in ranked if each.share == 1.0 or finding.share != 1.0}
        if len(finding.suspect) == 1 and finding.share == 1.0:
            found |= {each: self._examine(each, True) for each in self._tried if self._alike(finding, each)}
            found |= {each: self._examine(each, True) for each in self._in_one(finding.suspect[0].fault)}
        return [
            each
            for each in found.values()
            if each.suspect != finding.suspect
            and len(each.suspect) == len(finding.suspect)
            and (each.match.score <= finding.match.score + TWIN or self._same(finding, each, True))
        ]

    def _alike(self, finding: Finding, suspect: Suspect) -> bool:
        """Whether a suspect predicts the same as the finding at the first states."""
        return self._same(finding, self._examine(suspect, False), False)

    def _same(self, finding: Finding, other: Finding, whole: bool) -> bool:
        """Whether both predict the same."""
        noise, block = self._rounding(whole)
        own, others = (each.share * self._prediction(each.suspect, whole) for each in (finding, other))
        return match(own, others, noise, block).score <= TWIN

    def _of_all(self, found: Sequence[Finding]) -> Iterator[Finding]:
        """Every fault in all bodies that it concerns."""
        for each in single_faults(DICTIONARY):
            if self._visible(each):
                self._tried.append(each)
                yield self._examine(each, False)

    def _of_one(self, found: Sequence[Finding]) -> Iterator[Finding]:
        """Every fault of flywheels that spoils much the same quantities, in one flywheel alone.

        Not all of them: what flywheels do together may cancel where they mirror one another.
        """
        spoiled = self._spoiled_quantities(self._e(False))
        for (part,) in single_faults([fault for fault in DICTIONARY if fault.of_flywheels]):
            like = self._spoiled_quantities(self._prediction((part,), False))
            if len(spoiled & like) >= ALIKE * len(spoiled):
                for each in self._in_one(part.fault):
                    self._tried.append(each)
                    yield self._examine(each, False)

    def _in_one(self, fault: Fault) -> list[Suspect]:
        """A fault of flywheels in each of them alone, where there are others."""
        wheels = self._stand.flywheels if fault.of_flywheels else ()
        return [(Part(fault, wheel.name),) for wheel in wheels] if len(wheels) > 1 else []

    def _parts(self, found: Sequence[Finding]) -> Iterator[Finding]:
        """Shares of the faults tried so far."""
        e = self._e(False)
        noise, _ = self._rounding(False)
        for each in list(self._tried):
            a = share(e, self._prediction(each, False), noise)
            if LEAST_SHARE <= abs(a) <= LARGEST_SHARE and abs(a - 1.0) > WHOLE:
                yield self._examine(each, False, a)

    def _pairs(self, found: Sequence[Finding]) -> Iterator[Finding]:
        """Two at once: those whose errors add up to what was found, then as one program that has both."""
        e = self._e(False)
        noise, block = self._rounding(False)
        alone = [(self._examine(each, False).match.rest, each) for each in self._tried]
        alone.sort(key=lambda pair: pair[0])
        likely = [each for rest, each in alone[:PAIR_CANDIDATES] if rest < 1.0]
        sums = []
        for a, b in combinations(likely, 2):
            if a[0].fault is not b[0].fault:
                p = self._prediction(a, False) + self._prediction(b, False)
                sums.append((match(e, p, noise, block).score, (*a, *b)))
        sums.sort(key=lambda pair: pair[0])
        yield from (self._examine(both, False) for _, both in sums[:SHORT_LIST])

    def _confirm(self, found: Sequence[Finding]) -> list[Finding]:
        """The best of them at all states, then the best first; those that are as good as the last of the list too."""
        costs = [math.inf, *sorted(each.cost for each in found)[:SHORT_LIST]]
        best = {(each.suspect, each.share): each for each in found if each.cost <= costs[-1] + TWIN}
        return sorted(
            (self._examine(each.suspect, True, each.share) for each in best.values()), key=lambda each: each.cost
        )

    def _examine(self, suspect: Suspect, whole: bool, a: float = 1.0) -> Finding:
        noise, block = self._rounding(whole)
        found = match(self._e(whole), a * self._prediction(suspect, whole), noise, block)
        return Finding(suspect, a, found, self._stand.profile is not None)

    def _all_states(self, whole: bool) -> bool:
        """Whether all states are looked at: where the first ones show no error they are no use."""
        return whole or not self._early

    def _e(self, whole: bool) -> Array:
        return self._e_whole if self._all_states(whole) else self._e_first

    def _prediction(self, suspect: Suspect, whole: bool) -> Array:
        whole = self._all_states(whole)
        return self._predictions.error(suspect, whole)[self._asked[whole]]

    def _rounding(self, whole: bool) -> tuple[Array, Numbers]:
        """Noise and quantity of each number that the program has answered."""
        whole = self._all_states(whole)
        return self._noise_whole if whole else self._noise_first, self._blocks[whole]

    def _visible(self, suspect: Suspect) -> bool:
        noise, _ = self._rounding(False)
        return not np.all(np.abs(self._prediction(suspect, False)) <= noise)

    def _spoiled_quantities(self, error: Array) -> set[int]:
        """Quantities that an error of the first states is in."""
        noise, block = self._rounding(False)
        return set(np.unique(block[~(np.abs(error) <= noise)]).tolist())
