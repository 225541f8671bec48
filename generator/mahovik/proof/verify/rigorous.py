"""Rigorous enclosures: the literal reference in ball arithmetic (Arb, by python-flint), and by it the true error of C.

A ball is a midpoint and a radius, and every operation gives a ball that holds the exact result for all numbers of its
operands. The reference runs over balls as it does over floats: so the balls that it answers hold the exact answer to
the numbers of stand and state, which are taken as the binary numbers that they are. The precision is doubled until the
balls are as narrow as was asked. Needs python-flint: the extra `rigorous`.

Source: F. Johansson, "Arb: efficient arbitrary-precision midpoint-radius interval arithmetic", 2017.
"""

from __future__ import annotations

import operator
from collections.abc import Callable, Mapping
from dataclasses import dataclass, fields, is_dataclass, replace
from functools import cache, reduce
from pathlib import Path
from types import MappingProxyType
from typing import Any

import numpy as np
from flint import arb, arb_mat, ctx

from mahovik.contract.functions import wants_of
from mahovik.contract.limits import LIMITS
from mahovik.core.stand.model import Stand, State
from mahovik.errors import StateError, UsageError
from mahovik.proof import reference
from mahovik.proof.reference.algebra import Array
from mahovik.proof.verify.backends import public_names
from mahovik.proof.verify.c_backend import CBackend
from mahovik.proof.verify.check import Report, report
from mahovik.proof.verify.draw import draw
from mahovik.proof.verify.harness import Progress, judge
from mahovik.proof.verify.scales import Measured, Scales

Balls = dict[str, Any]
"""Balls of Arb by the names of the contract: one, or nested lists of them."""

BITS = 256
"""The first precision."""

MOST_BITS = 8192
"""The last: balls that are still too wide hold no answer, such as the angle of half a turn."""


def _function(of_balls: Any) -> Any:
    """A function of balls, or of binary numbers beside them, which are exact. NumPy does arrays by itself."""

    def function(*numbers: Any) -> Any:
        return (
            NotImplemented if any(isinstance(x, np.ndarray) for x in numbers) else Ball(of_balls(*map(_arb, numbers)))
        )

    return function


def _comparison(certain: Callable[[Any, Any], bool], never: Callable[[Any, Any], bool]) -> Any:
    """A comparison that is certain, or never true; StateError where the balls overlap."""

    def compare(a: Ball, b: Any) -> bool:
        is_certain = certain(a.arb, _arb(b))
        if is_certain or never(a.arb, _arb(b)):
            return is_certain
        raise StateError("the balls do not tell which branch of a law applies")

    return compare


def _with_sign(size: arb, x: arb) -> arb:
    """Both signs where x may be zero."""
    return abs(size) if x > 0 else -abs(size) if x < 0 else abs(size).union(-abs(size))


def _angle_over_sine(sine: arb, cosine: arb) -> arb:
    """About sine 0, t = sine/cosine: 1 - t^2 <= atan(t)/t <= 1."""
    if sine > 0 or sine < 0:
        return arb.atan2(sine, cosine) / sine
    if not cosine > 0:
        raise StateError("at half a turn there are two rotation vectors")
    return arb(1).union(1 - (sine / cosine) * (sine / cosine)) / cosine


def _root(x: arb) -> arb:
    """A ball may reach below zero though its number does not."""
    return x.nonnegative_part().sqrt()


class Ball:
    """A number of the reference. It becomes no float by itself, and a comparison that it cannot decide is an error."""

    __slots__ = ("arb",)

    def __init__(self, ball: arb) -> None:
        self.arb = ball

    __add__, __sub__, __mul__, __truediv__, __neg__, __abs__ = map(
        _function, (operator.add, operator.sub, operator.mul, operator.truediv, operator.neg, abs)
    )
    __radd__, __rsub__, __rmul__, __rtruediv__ = map(
        _function, (operator.add, lambda a, b: b - a, operator.mul, lambda a, b: b / a)
    )
    __lt__, __ge__ = _comparison(operator.lt, operator.ge), _comparison(operator.ge, operator.lt)
    __gt__, __le__ = _comparison(operator.gt, operator.le), _comparison(operator.le, operator.gt)
    __eq__, __ne__ = _comparison(operator.eq, operator.ne), _comparison(operator.ne, operator.eq)
    __hash__ = None  # type: ignore[assignment]
    sin, cos, exp, arctan2, sqrt = map(_function, (arb.sin, arb.cos, arb.exp, arb.atan2, _root))
    hypot = staticmethod(_function(lambda *numbers: _root(sum((x * x for x in numbers), arb(0)))))
    larger, smaller, with_sign, angle_over_sine = map(
        staticmethod, map(_function, (arb.max, arb.min, _with_sign, _angle_over_sine))
    )
    pi_like = _function(lambda _: arb.pi())

    def __pow__(self, n: int) -> Ball:
        return Ball(reduce(operator.mul, [self.arb] * n))  # a power of a ball about zero is none in Arb

    def __bool__(self) -> bool:
        return bool(self != 0.0)

    def __format__(self, spec: str) -> str:
        return format(self.estimate(), spec)

    def estimate(self) -> float:
        return float(self.arb.mid())

    @staticmethod
    def solve(S: Array, b: Array) -> Array:
        """StateError where S may be singular."""
        try:
            result = arb_mat(_arbs(S)).solve(arb_mat(_arbs(b.reshape(len(b), -1))))
        except ZeroDivisionError:
            raise StateError("the mass matrix is singular, as far as this precision can tell") from None
        return np.array([Ball(x) for x in result.entries()], dtype=object).reshape(b.shape)


def _arb(x: Any) -> Any:
    return x.arb if isinstance(x, Ball) else arb(float(x))


def _arbs(balls: Any) -> Any:
    """Arb's balls of an answer: of one number, or of an array as nested lists."""
    if isinstance(balls, np.ndarray | list | tuple):
        return [_arbs(x) for x in balls]
    return {name: _arbs(x) for name, x in balls.items()} if isinstance(balls, dict) else _arb(balls)


def with_balls(data: Any) -> Any:
    """A stand, a state or a part of one, with balls for its numbers."""
    if isinstance(data, float):
        return Ball(arb(data))
    if isinstance(data, tuple):
        return tuple(map(with_balls, data))
    if isinstance(data, Mapping):
        return MappingProxyType({key: with_balls(x) for key, x in data.items()})
    if is_dataclass(data) and not isinstance(data, type):
        return replace(data, **{part.name: with_balls(getattr(data, part.name)) for part in fields(data)})
    return data


@dataclass(frozen=True, eq=False)
class Exact:
    """A stand and a state with balls for their numbers, and their pieces, at a number of bits."""

    stand: Stand
    state: State
    pieces: reference.Pieces
    bits: int


def exact_at(stand: Stand, state: State, bits: int = BITS) -> Exact:
    """A stand at a state in balls. StateError where a law is undefined, or where this precision cannot tell."""
    with ctx.workprec(bits):
        stand = with_balls(stand)
        state = reference.held_state(stand, with_balls(state))
        return Exact(stand, state, reference.pieces(stand, state), bits)


def evaluate(at: Exact, want: str) -> Balls:
    """Balls that hold the exact answer to the numbers of stand and state, by names of the contract.

    Raises StateError where there is no answer, or where this precision cannot tell (a singular matrix, half a turn).
    """
    with ctx.workprec(at.bits):
        result: Balls = _arbs(reference.evaluate(at.stand, at.state, [want], at.pieces))
        return result


def enclose(balls_at: Callable[[int], Balls], narrow: Callable[[Balls], bool]) -> Balls:
    """What `balls_at` gives for a number of bits, doubled from BITS until it is narrow.

    Raises StateError where even MOST_BITS give none.
    """
    bits, refusal = BITS, "the balls stay too wide"
    while bits <= MOST_BITS:
        try:
            if narrow(result := balls_at(bits)):
                return result
        except StateError as error:
            refusal = str(error)
        bits *= 2
    raise StateError(f"no enclosure with {MOST_BITS} bits: {refusal}")


# -- the error of C ----------------------------------------------------------------------------------------------------

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
        raise UsageError(f"rigorous: {against} holds {there}, expected one of {expected}: no other has enclosures")
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
        sizes, balls_at = measured.scales, cache(lambda bits: exact_at(self.stand, state, bits))

        def narrow(balls: Balls) -> bool:
            return all(_is_narrow(balls[name], np.maximum(size, NARROW**4)) for name, size in sizes.items())

        try:
            exact = enclose(lambda bits: evaluate(balls_at(bits), want), narrow)
        except StateError:  # no error is known: it counts as infinite
            exact = {name: np.full(np.shape(value), np.nan) for name, value in measured.values.items()}
        return replace(measured, exact={name: np.array(balls) for name, balls in exact.items()})


def _is_narrow(balls: Any, size: Array) -> bool:
    exact = np.array(balls).ravel()
    pairs: list[tuple[arb, float]] = list(zip(exact, np.broadcast_to(size, np.shape(balls)).ravel(), strict=True))
    return all(ball.is_finite() and float(ball.rad()) <= NARROW * float(scale) for ball, scale in pairs)
