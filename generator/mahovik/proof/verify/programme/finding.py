"""What one item of the verification found, and the limits of the items."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from mahovik.core.stand.model import Stand


@dataclass(frozen=True)
class Finding:
    """One item: `value` against `limit` (of the same unit, mostly a share), whether it `passed`, and words about it.

    An item that warns has passed with a value above its limit. `multipliers`: of the item Floquet all twelve, the
    largest modulus first; `value` is that modulus.
    """

    name: str
    value: float
    limit: float
    passed: bool
    words: str
    multipliers: tuple[complex, ...] = ()

    @property
    def warns(self) -> bool:
        """Passed, but with something to know."""
        return self.passed and not self.value <= self.limit

    def as_item(self) -> dict[str, Any]:
        """The finding for JSON, without `multipliers`; a value that is not finite is null."""
        value = self.value if math.isfinite(self.value) else None
        return {"name": self.name, "value": value, "limit": self.limit, "passed": self.passed, "words": self.words}


def judged(name: str, value: float, limit: float, words: str = "") -> Finding:
    """Passed where the value is within the limit; a value that is not a number is not."""
    return Finding(name, value, limit, value <= limit, words)


def as_object(stand: str, motion: str, findings: Sequence[Finding]) -> dict[str, Any]:
    """All as JSON has it; `floquet` is null where no multipliers were asked for."""
    return {
        "stand": stand,
        "motion": motion,
        "passed": all(each.passed for each in findings),
        "findings": [each.as_item() for each in findings],
        "floquet": floquet_of(findings),
    }


def floquet_of(findings: Sequence[Finding]) -> list[list[float]] | None:
    """The twelve Floquet multipliers among findings, real and imaginary part each; None: they have none."""
    found = [[z.real, z.imag] for each in findings for z in each.multipliers]
    return found or None


@dataclass(frozen=True)
class Tolerance:
    """residual, error   of the equations and of the carrier's motion by simulation, shares
    runup           of the carrier's state at the end of a run-up or run-down, share of the amplitude
    table           of phi', phi'' in a table, share of their peaks: what its neighbours foretell of a row
    joint           of two courses that meet, share of peaks; rad for phi
    multiplier      largest Floquet multiplier without a warning
    """

    residual: float
    error: float
    runup: float
    table: float = 0.03
    joint: float = 1e-6
    multiplier: float = 1.001


SMOOTH, KINKED, RUNUP = 1e-6, 1e-5, 1e-5
"""Shares. A stand with V|V| has forces of class C1 only, and over a period a mean that nothing may balance."""

DRIFT = 20
"""(2 pi)^2 / 2: amplitudes that a constant residual, of one amplitude's share, moves a floating carrier in a period."""


def tolerance_for(stand: Stand, given: float | None) -> Tolerance:
    """The limits for a stand; `given` replaces that of the residual, and the others follow from it."""
    quadratic = any(b.damping is not None and (b.damping.quadratic or b.damping.terms) for b in stand.bodies)
    if given is None and not quadratic:
        return Tolerance(SMOOTH, SMOOTH, RUNUP)
    share = KINKED if given is None else given
    return Tolerance(share, DRIFT * share, max(DRIFT * share, RUNUP))
