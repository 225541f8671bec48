"""True error of the C over states: judged as ever, against the exact answer, enclosed by ball arithmetic."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
from flint import arb

from mahovik.contract.functions import wants_of
from mahovik.contract.limits import LIMITS
from mahovik.core.stand.model import Stand, State
from mahovik.errors import StateError, UsageError
from mahovik.proof import rigorous
from mahovik.proof.reference.algebra import Array
from mahovik.proof.verify.backends import public_names
from mahovik.proof.verify.c_backend import CBackend
from mahovik.proof.verify.check import Report, report
from mahovik.proof.verify.draw import draw
from mahovik.proof.verify.harness import Progress, judge
from mahovik.proof.verify.scales import Measured, Scales

NARROW = 2.0**-70
"""Largest radius of a ball, a part of the scale: it adds nothing visible to an error."""


def measure_rounding(
    stand: Stand,
    *,
    seed: int = 1,
    count: int = 200,
    real: str = "double",
    against: Path | None = None,
    progress: Progress | None = None,
    backend: CBackend | None = None,
) -> Report:
    """Errors of the generated C, fresh or in the folder `against`, over the states of `verify`, as parts of the scales.

    They are upper bounds: the balls hold the exact answer to the numbers of stand and state, and are narrow.
    `backend`: where it is compiled already. Raises ToolchainError where it does not compile, CheckError where it is of
    another stand, UsageError where none of its functions has an enclosure.
    """
    backend = backend or CBackend(stand, real, against)
    wants = [want for want in wants_of("rigorous") if want in backend.wants]
    if not wants:
        there, expected = ", ".join(public_names(backend.program)), ", ".join(wants_of("rigorous"))
        raise UsageError(f"--rigorous: {against} holds {there}, expected one of {expected}: no other has enclosures")
    limits = replace(LIMITS[real], value=LIMITS[real].rigorous)
    states = draw(stand, seed, count, real)
    rows = judge(stand, backend, states, wants, limits, progress, scales=EnclosedScales(stand, real, seed))
    judged_words = f"{real} C" if against is None else f"{real} C in {against}"
    judged_words += f", only {', '.join(public_names(backend.program))}" if backend.left_out else ""
    return report(stand, judged_words, seed, len(states), limits.value, rows)


class EnclosedScales(Scales):
    """Answers of the literal reference with their scales, and balls that hold the exact answers."""

    def _try_want(self, state: State, want: str) -> Measured | None:
        measured = super()._try_want(state, want)
        if measured is None:
            return None
        sizes, exact_at = measured.scales, cache(lambda bits: rigorous.exact_at(self.stand, state, bits))

        def narrow(balls: rigorous.Balls) -> bool:
            return all(_is_narrow(balls[name], np.maximum(size, NARROW**4)) for name, size in sizes.items())

        try:
            exact = rigorous.enclose(lambda bits: rigorous.evaluate(exact_at(bits), want), narrow)
        except StateError:  # no error is known: it counts as infinite
            exact = {name: np.full(np.shape(value), np.nan) for name, value in measured.values.items()}
        return replace(measured, exact={name: np.array(balls) for name, balls in exact.items()})


def _is_narrow(balls: Any, size: Array) -> bool:
    exact = np.array(balls).ravel()
    pairs: list[tuple[arb, float]] = list(zip(exact, np.broadcast_to(size, np.shape(balls)).ravel(), strict=True))
    return all(ball.is_finite() and float(ball.rad()) <= NARROW * float(scale) for ball, scale in pairs)
