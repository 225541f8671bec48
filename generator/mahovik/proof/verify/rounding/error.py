"""Upper bounds on the error of an answer, from balls that hold the exact one."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np
from flint import arb, ctx
from numpy.typing import NDArray

Array = NDArray[np.float64]
Balls = NDArray[np.object_]

NARROW = 2.0**-16
"""Largest radius of a ball, ulp of the scale: it adds nothing visible to an error."""

SCREWS = ("V_dot", "F", "Z", "Z0", "mount_wrench", "reaction")
"""Their last index is that of a screw: three linear components, three angular."""

SCREW_ROWS = ("K", "K_dot", "M", "I", "J")
"""Their rows are: three linear, three angular."""

SCREW_COLUMNS = ("K", "K_dot", "M", *SCREWS)


@dataclass(frozen=True)
class Error:
    """Errors of one quantity at one state, the worst component of each.

    ulps   in units of the last place of its natural scale
    scale  over the natural scale
    own    over the largest of the components that have its unit; inf where these are zero and it is not
    """

    ulps: float
    scale: float
    own: float


MISSING = Error(math.inf, math.inf, math.inf)
"""No answer, or one that is not finite."""


def ulp(scale: float, significand: int) -> float:
    """Unit in the last place of a number whose significand has this many bits, the hidden one counted."""
    return math.ldexp(1.0, math.frexp(scale)[1] - significand)


def units(natural: Any, floor: float, significand: int) -> Array:
    """ulp of every scale, those below the floor raised to it."""
    raised = np.maximum(np.asarray(natural, dtype=np.float64), floor)
    return np.asarray(np.vectorize(ulp, otypes=[np.float64])(raised, significand), dtype=np.float64)


def is_narrow(balls: Any, unit: Array) -> bool:
    """Whether every ball of a quantity is finite and narrow for its unit."""
    pairs = zip(_flat(balls), np.broadcast_to(unit, _shape(balls)).flat, strict=True)
    return all(ball.is_finite() and ball.rad() <= NARROW * float(u) for ball, u in pairs)


def error(quantity: str, found: Any, balls: Any, natural: Any, floor: float, significand: int) -> Error:
    """Error of the found values. `natural`: scales, in the same shape."""
    shape = _shape(balls)
    numbers = np.array(found, dtype=np.float64)
    if numbers.shape != shape or not np.isfinite(numbers).all():
        return MISSING
    if not numbers.size:
        return Error(0.0, 0.0, 0.0)
    exact = _flat(balls)
    apart = [abs(arb(float(x)) - ball) for x, ball in zip(numbers.flat, exact, strict=True)]
    off = np.array([_above(distance) for distance in apart]).reshape(shape)
    raised = np.maximum(np.broadcast_to(natural, shape), floor)
    unit = units(raised, floor, significand)
    return Error(
        float((off / unit).max()),
        float((off / raised).max()),
        _own(quantity, _reshape(apart, shape), _reshape(exact, shape)),
    )


def _own(quantity: str, apart: Balls, exact: Balls) -> float:
    """The worst error over the largest component of the same unit."""
    parts = [(apart, exact)]
    if quantity in SCREW_ROWS:
        parts = [pair for a, b in parts for pair in zip(np.split(a, 2), np.split(b, 2), strict=True)]
    if quantity in SCREW_COLUMNS:
        parts = [pair for a, b in parts for pair in zip(np.split(a, 2, -1), np.split(b, 2, -1), strict=True)]
    return max(_ratio(a.ravel().tolist(), b.ravel().tolist()) for a, b in parts)


def _ratio(apart: Iterable[arb], exact: Iterable[arb]) -> float:
    off = max((x.upper() for x in apart), default=arb(0))
    size = max((abs(x).lower() for x in exact), default=arb(0))
    if size > 0:
        return _above(off / size)
    return math.inf if off > 0 else 0.0


def _above(x: arb) -> float:
    """A float that is no smaller than any number of a ball."""
    with ctx.workprec(64):
        return math.nextafter(float(x.upper()), math.inf) if not x.is_zero() else 0.0


def _shape(balls: Any) -> tuple[int, ...]:
    if isinstance(balls, arb):
        return ()
    return (len(balls), *(_shape(balls[0]) if len(balls) else ()))


def _flat(balls: Any) -> list[arb]:
    return [balls] if isinstance(balls, arb) else [x for each in balls for x in _flat(each)]


def _reshape(balls: list[arb], shape: tuple[int, ...]) -> Balls:
    found = np.empty(shape, dtype=object)
    found.ravel()[:] = balls  # a view: the array is new
    return found
