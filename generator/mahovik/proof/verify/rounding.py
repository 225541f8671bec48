"""True error of the C over states: the exact answer of the literal equations, enclosed by ball arithmetic."""

from __future__ import annotations

import math
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
from flint import arb, ctx

from mahovik.contract.functions import wants_of
from mahovik.contract.limits import LIMITS
from mahovik.core.stand.model import Stand
from mahovik.errors import StateError, UsageError
from mahovik.proof import rigorous
from mahovik.proof.reference.array import Array
from mahovik.proof.rigorous import BITS, Balls, enclose
from mahovik.proof.verify.backends import is_beyond, public_names
from mahovik.proof.verify.c_backend import CBackend
from mahovik.proof.verify.check import Check, Report, report
from mahovik.proof.verify.draw import draw
from mahovik.proof.verify.harness import Progress
from mahovik.proof.verify.scales import Scales
from mahovik.proof.verify.states import Request

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
    scales, limits, checks = Scales(stand, real, seed), LIMITS[real], dict[tuple[str, str], Check]()
    states = draw(stand, seed, count, real, wrenches=against is None)
    for done, (name, state) in enumerate(states):
        exact_at = cache(lambda bits, state=state: rigorous.exact_at(stand, state, bits))
        for want in wants:
            measured, request = scales.want(state, want), Request(name, state, (want,))
            if measured is None:
                continue
            sizes = {key: np.maximum(scale, limits.floor) for key, scale in measured.scales.items()}
            if is_beyond(measured.values):  # of these accelerations the C gives no reaction
                sizes.pop("reaction", None)

            def exact(bits: int, want: str = want, at: Any = exact_at) -> Balls:
                return rigorous.evaluate(at(bits), want)

            def narrow(balls: Balls, sizes: dict[str, Array] = sizes) -> bool:
                return all(_is_narrow(balls[key], size) for key, size in sizes.items())

            try:
                answer, balls, words = backend.evaluate(state, (want,)), enclose(exact, narrow), ""
            except StateError as refusal:
                answer, words = {}, str(refusal)
            for key, size in sizes.items():
                check = checks.setdefault((want, key), Check(want, key, limits.rigorous))
                check.note(math.inf if words else error(answer[key], balls[key], size), name, words, request)
        if progress is not None:
            progress(done + 1, len(states))
    judged_words = f"{real} C" if against is None else f"{real} C in {against}"
    judged_words += f", only {', '.join(public_names(backend.program))}" if backend.left_out else ""
    return report(stand, judged_words, seed, len(states), limits.rigorous, list(checks.values()))


def error(answer: Any, balls: Any, size: Array) -> float:
    """Upper bound of the largest error of numbers, over their scales; inf where they are none, or too many."""
    numbers, exact = np.array(answer, dtype=np.float64), _flat(balls)
    if numbers.size != len(exact) or not np.isfinite(numbers).all():
        return math.inf
    with ctx.workprec(BITS):
        off = [float(abs(arb(float(x)) - ball).upper()) for x, ball in zip(numbers.flat, exact, strict=True)]
    return float(np.max(np.array(off) / np.broadcast_to(size, numbers.shape).ravel(), initial=0.0))


def _is_narrow(balls: Any, size: Array) -> bool:
    exact = _flat(balls)
    pairs = zip(exact, np.broadcast_to(size, np.shape(size) or (len(exact),)).ravel(), strict=True)
    return all(ball.is_finite() and float(ball.rad()) <= NARROW * float(scale) for ball, scale in pairs)


def _flat(balls: Any) -> list[arb]:
    return [balls] if isinstance(balls, arb) else [x for ball in balls for x in _flat(ball)]
