"""The search: which fault, or two at once, predict the error that was found."""

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
    exact   whether p leaves no more than rounding in every number of the quantities that are wrong
    """

    score: float
    rest: float
    absent: tuple[int, ...]
    exact: bool = False


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
    exact = bool((off[active & spoiled[block]] <= EXACT).all())
    return Match(rest + ABSENT * missing, rest, tuple(int(i) for i in np.flatnonzero(absent)), exact)


EXACT = 1e-6
"""Part of a number of the error that a fault may leave, besides rounding, and be the fault itself."""

PENALTY = 0.05
"""Added to the score of two faults: a whole single one that is as good comes first."""

ALIKE = 0.5
"""Part of the wrong quantities that a fault must spoil in all flywheels, to be tried in one flywheel."""

SHORT_LIST = 5
"""Number of suspects that are examined at all states."""

PAIR_CANDIDATES = 40
"""Number of single faults that are tried two at a time."""

TWIN = 1e-3
"""Largest score between the predictions of two faults that this stand cannot tell apart; or between their scores."""


@dataclass(frozen=True)
class Finding:
    """A suspect, and how well it explains what was found."""

    suspect: Suspect
    match: Match

    @property
    def cost(self) -> float:
        """Score plus penalties: for a second fault, for a fault of a single flywheel.

        So a whole fault of all flywheels comes first among explanations that fit alike.
        """
        alone = 0.01 * PENALTY * sum(part.wheel is not None for part in self.suspect)
        return self.match.score + PENALTY * (len(self.suspect) - 1) + alone

    @property
    def faults(self) -> set[Fault]:
        """The faults of its suspect, in whichever flywheels."""
        return {part.fault for part in self.suspect}

    def repeats(self, other: Finding) -> bool:
        """Whether it has the faults of the other: in other flywheels, or with one more."""
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

    def rank_suspects(self) -> list[Finding]:
        """Suspects, those that are exact first: wider and wider, until one is."""
        found: list[Finding] = []
        for stage in (self._of_all, self._of_one, self._pairs):
            found = self._confirm([*found, *stage(found)])
            if found and found[0].match.exact:
                break
        return found

    def invisible_faults(self) -> list[Suspect]:
        """Faults that change nothing at the requested states: with them a program looks correct."""
        return [each for each in single_faults(DICTIONARY) if not self._visible(each)]

    def equal_findings(self, finding: Finding, ranked: Sequence[Finding]) -> list[Finding]:
        """Findings as good as this one: each predicts the same at all states, or explains as much of what was found.

        Of one fault: all that were tried, and the same in one flywheel; of two: those of `ranked`.
        """
        found = {each.suspect: each for each in ranked}
        if len(finding.suspect) == 1:
            found |= {each: self._examine(each, True) for each in self._tried if self._alike(finding, each)}
            found |= {each: self._examine(each, True) for each in self._in_one(finding.suspect[0].fault)}
        return [
            each
            for each in found.values()
            if each.suspect != finding.suspect
            and len(each.suspect) == len(finding.suspect)
            and each.match.exact
            and (each.match.score <= finding.match.score + TWIN or self._same(finding, each, True))
        ]

    def _alike(self, finding: Finding, suspect: Suspect) -> bool:
        """Whether a suspect predicts the same as the finding at the first states."""
        return self._same(finding, self._examine(suspect, False), False)

    def _same(self, finding: Finding, other: Finding, whole: bool) -> bool:
        """Whether both predict the same."""
        noise, block = self._rounding(whole)
        own, others = (self._prediction(each.suspect, whole) for each in (finding, other))
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
        best = {each.suspect: each for each in found if each.cost <= costs[-1] + TWIN}
        confirmed = (self._examine(suspect, True) for suspect in best)
        return sorted(confirmed, key=lambda each: (not each.match.exact, each.cost))

    def _examine(self, suspect: Suspect, whole: bool) -> Finding:
        noise, block = self._rounding(whole)
        return Finding(suspect, match(self._e(whole), self._prediction(suspect, whole), noise, block))

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
