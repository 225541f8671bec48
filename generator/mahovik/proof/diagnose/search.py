"""The search: which fault, or part of one, or two, predict the error that was found."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np

from mahovik.core.stand.model import Stand
from mahovik.proof.diagnose.faults import DICTIONARY
from mahovik.proof.diagnose.match import Match, match, share
from mahovik.proof.diagnose.predict import Part, Predictions, Suspect, singles
from mahovik.proof.diagnose.sheet import Numbers
from mahovik.proof.reference.array import Array

EXACT = 1e-3
"""A score below this is the fault itself: no other has to be looked for."""

NAMED = 0.3
"""A single fault with a higher score is not named."""

NAMED_AS_PART = 0.2
"""Nor a part of a fault, which has more freedom to fit what it is not (and is not always a part of the error)."""

NAMED_AS_TWO = 0.1
"""Nor two at once, with more freedom still."""

PENALTY = 0.05
"""On the score of a part of a fault, or two: a whole single one that is as good comes first."""

LEAST_SHARE, LARGEST_SHARE = 0.02, 50.0
"""Parts of a fault that are looked for; smaller ones are what rounding looks like."""

WHOLE = 1e-3
"""A share that is as near to 1 is the whole."""

ALIKE = 0.5
"""Part of the wrong quantities that a fault must spoil in all flywheels, to be tried in one flywheel."""

SHORT_LIST = 5
"""Number of suspects that are examined at all states."""

PAIRED = 40
"""Number of single faults that are tried two at a time."""

TWIN = 1e-3
"""Two faults whose predictions are as near as this are one as far as the stand can tell."""


@dataclass(frozen=True)
class Finding:
    """A suspect, the share of its error that was found, and how well it explains what was found."""

    suspect: Suspect
    share: float
    match: Match

    @property
    def cost(self) -> float:
        """Its score, and what it must be better by than a whole single fault; of parts, those of a half to all.

        Of a fault in all flywheels and in one that look the same, that in all comes first.
        """
        alone = 0.01 * PENALTY * sum(part.wheel is not None for part in self.suspect)
        a_part = PENALTY * (1.0 + 0.1 * min(abs(self.share - 1.0), 1.0)) if self.share != 1.0 else 0.0
        return self.match.score + PENALTY * (len(self.suspect) - 1) + a_part + alone

    @property
    def named(self) -> bool:
        """Whether it is good enough to be named."""
        if len(self.suspect) > 1:
            return self.match.score <= NAMED_AS_TWO
        return self.match.score <= (NAMED if self.share == 1.0 else NAMED_AS_PART)

    def repeats(self, other: Finding) -> bool:
        """Whether it says no more than the other: the same in another share, or with something more."""
        return set(other.suspect) <= set(self.suspect)


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

    def ranked(self, freely: bool = True) -> list[Finding]:
        """Suspects, the best first: wider and wider, until one is exact. `freely`: parts and pairs as well."""
        found: list[Finding] = []
        for stage in (self._of_all, self._of_one, *((self._parts, self._pairs) if freely else ())):
            found = self._confirm([*found, *stage(found)])
            if found and found[0].match.score <= EXACT:
                break
        return found

    def unseen(self) -> list[Suspect]:
        """Faults that change nothing at the states that were asked: with them a program looks correct."""
        return [each for each in singles(DICTIONARY) if not self._visible(each)]

    def twins(self, finding: Finding, others: Sequence[Finding]) -> list[Finding]:
        """Others that are the same as the finding at all states."""
        noise, block = self._rounding(True)
        own = finding.share * self._prediction(finding.suspect, True)
        return [
            other
            for other in others
            if match(own, other.share * self._prediction(other.suspect, True), noise, block).score <= TWIN
        ]

    def _of_all(self, found: Sequence[Finding]) -> Iterator[Finding]:
        """Every fault in all bodies that it concerns."""
        for each in singles(DICTIONARY):
            if self._visible(each):
                self._tried.append(each)
                yield self._examine(each, False)

    def _of_one(self, found: Sequence[Finding]) -> Iterator[Finding]:
        """Every fault of flywheels that spoils much the same quantities, in one flywheel alone.

        Not all of them: what flywheels do together may cancel where they mirror one another.
        """
        if len(self._stand.flywheels) < 2:
            return
        spoiled = self._spoiled_quantities(self._e(False))
        for (part,) in singles([fault for fault in DICTIONARY if fault.of_flywheels]):
            like = self._spoiled_quantities(self._prediction((part,), False))
            if len(spoiled & like) >= ALIKE * len(spoiled):
                for wheel in self._stand.flywheels:
                    self._tried.append((Part(part.fault, wheel.name),))
                    yield self._examine(self._tried[-1], False)

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
        likely = [each for rest, each in alone[:PAIRED] if rest < 1.0]
        sums = []
        for a, b in combinations(likely, 2):
            if a[0].fault is not b[0].fault:
                p = self._prediction(a, False) + self._prediction(b, False)
                sums.append((match(e, p, noise, block).score, (*a, *b)))
        sums.sort(key=lambda pair: pair[0])
        yield from (self._examine(both, False) for _, both in sums[:SHORT_LIST])

    def _confirm(self, found: Sequence[Finding]) -> list[Finding]:
        """The best of them at all states, then the best first."""
        best = {(each.suspect, each.share): each for each in sorted(found, key=lambda each: each.cost)[:SHORT_LIST]}
        return sorted(
            (self._examine(each.suspect, True, each.share) for each in best.values()), key=lambda each: each.cost
        )

    def _examine(self, suspect: Suspect, whole: bool, a: float = 1.0) -> Finding:
        noise, block = self._rounding(whole)
        return Finding(suspect, a, match(self._e(whole), a * self._prediction(suspect, whole), noise, block))

    def _e(self, whole: bool) -> Array:
        return self._e_whole if whole else self._e_first

    def _prediction(self, suspect: Suspect, whole: bool) -> Array:
        return self._predictions.error(suspect, whole)[self._asked[whole]]

    def _rounding(self, whole: bool) -> tuple[Array, Numbers]:
        """Noise and quantity of each number that the program has answered."""
        return self._noise_whole if whole else self._noise_first, self._blocks[whole]

    def _visible(self, suspect: Suspect) -> bool:
        return not np.all(np.abs(self._prediction(suspect, False)) <= self._noise_first)

    def _spoiled_quantities(self, error: Array) -> set[int]:
        """Quantities that an error of the first states is in."""
        noise, block = self._rounding(False)
        return set(np.unique(block[~(np.abs(error) <= noise)]).tolist())
