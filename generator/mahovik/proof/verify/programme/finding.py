"""Findings of a verification: value, limit and words; their limits; and the first item, whose programme it is."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from mahovik.core.motion.programme import Programme
from mahovik.core.motion.required import RequiredMotion
from mahovik.core.stand.coordinates import FREE, coordinates_of
from mahovik.core.stand.identity import identities
from mahovik.core.stand.model import Stand
from mahovik.errors import above_zero
from mahovik.proof.reference.array import Array


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
    def has_warning(self) -> bool:
        """Whether it has passed with a value above its limit."""
        return self.passed and not self.value <= self.limit

    def as_item(self) -> dict[str, Any]:
        """The finding for JSON, without `multipliers`; a value that is not finite is null."""
        value = self.value if math.isfinite(self.value) else None
        return {"name": self.name, "value": value, "limit": self.limit, "passed": self.passed, "words": self.words}


def largest(values: Array) -> float:
    """Largest magnitude; 0 if there are no values."""
    return float(np.abs(values).max(initial=0.0))


def check_limit(name: str, value: float, limit: float, words: str = "") -> Finding:
    """Finding that passes if the value is within the limit; a value that is not a number fails."""
    return Finding(name, value, limit, value <= limit, words)


def findings_object(stand: str, motion: str, findings: Sequence[Finding]) -> dict[str, Any]:
    """All findings for JSON; `floquet` is null if there are no multipliers."""
    return {
        "stand": stand,
        "motion": motion,
        "passed": all(each.passed for each in findings),
        "findings": [each.as_item() for each in findings],
        "floquet": floquet_multipliers(findings),
    }


def floquet_multipliers(findings: Sequence[Finding]) -> list[list[float]] | None:
    """The twelve Floquet multipliers among findings, real and imaginary part each; None: they have none."""
    found = [[z.real, z.imag] for each in findings for z in each.multipliers]
    return found or None


@dataclass(frozen=True)
class Tolerance:
    """residual, error   of the equations and of the carrier's motion by simulation, shares
    runup           of the carrier's state at the end of a run-up or run-down, share of the amplitude
    table           of phi', phi'' in a table, share of their peaks: each row against its prediction by its neighbours
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
"""Tolerances. A stand with V|V| has forces of class C1 only, and over a period a mean that nothing may balance."""

DRIFT = 20
"""(2 pi)^2 / 2: amplitudes that a constant residual, of one amplitude's share, moves a floating carrier in a period."""


def tolerance_for(stand: Stand, given: float | None) -> Tolerance:
    """Limits for a stand; `given` replaces that of the residual, and the others follow from it."""
    if given is not None:
        above_zero("tolerance", given)
    nonlinear = any(law.nonlinear for body in stand.bodies for law in body.laws)
    if given is None and not nonlinear:
        return Tolerance(SMOOTH, SMOOTH, RUNUP)
    share = KINKED if given is None else given
    return Tolerance(share, DRIFT * share, max(DRIFT * share, RUNUP))


def stand_finding(stand: Stand, programme: Programme) -> Finding:
    """Finding on the number of name, structure, physics and flywheels that are of another stand."""
    own = identities(stand)
    pairs = {
        "name": (programme.stand, stand.name),
        "structure": (programme.structure, own.structure),
        "physics": (programme.physics, own.physics),
        "flywheels": (", ".join(programme.flywheels), ", ".join(s.name for s in stand.flywheels)),
        "coordinates": (", ".join(programme.coordinates or FREE), ", ".join(coordinates_of(stand).names)),
    }
    other = [f"{key} is {theirs}, of the stand {ours}" for key, (theirs, ours) in pairs.items() if theirs != ours]
    words = "programme of another stand: " + "; ".join(other) if other else f"{own.structure} {own.physics}"
    return check_limit("stand", len(other), 0, words)


def same_flywheels(stand: Stand, programme: Programme) -> bool:
    """Whether the programme has flywheels and coordinates of the stand, without which it cannot be verified."""
    same = len(programme.bias) == coordinates_of(stand).count
    return same and programme.flywheels == tuple(s.name for s in stand.flywheels)


def motion_finding(motion: RequiredMotion, programme: Programme) -> Finding:
    """Finding on the number of name, kind, period (duration) and unbalance that are of another motion."""
    kind = {True: "periodic", False: "finite"}
    other = []
    if programme.motion != motion.name:
        other.append(f"name is {programme.motion}, of the motion {motion.name}")
    if programme.periodic != motion.periodic:
        other.append(f"it is {kind[programme.periodic]}, the motion {kind[motion.periodic]}")
    elif abs(programme.span - motion.span) > 1e-12 * motion.span:
        word = "period" if motion.periodic else "duration"
        other.append(f"{word} is {programme.span:.12g} s, of the motion {motion.span:.12g} s")
    wanted = "resisted" if motion.slew is None else motion.slew.unbalance
    if programme.unbalance != wanted:
        other.append(f"unbalance is {programme.unbalance}, of the motion {wanted}")
    words = "programme of another motion: " + "; ".join(other) if other else motion.name
    return check_limit("motion", len(other), 0, words)
