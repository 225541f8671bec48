"""Numbers and arrays of the reference, its answers, its linear solves. Shapes are in each docstring.

The equations hold for whatever stands in for a number: a float, or an object that brings its own arithmetic and the
functions below, such as the balls of `proof/rigorous.py`, which come in arrays of objects. So no equation calls `math`,
writes numbers into zeros, or makes a float of a number.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

Values = dict[str, Any]
"""Results by the names of the contract: arrays, floats; a status is a string, a rank an int."""


def vector(numbers: Sequence[Any]) -> Array:
    """Numbers of a stand or state, nested as they are, as an array."""
    result = np.array(numbers)
    return result if result.dtype.kind in "fO" else result.astype(np.float64)


def stack(vectors: Sequence[Array], *shape: int) -> Array:
    """Arrays of a shape one after the other (n x shape); there may be none."""
    return vector(vectors).reshape(len(vectors), *shape)


def times(A: Array, x: Array) -> Array:
    """A x of every matrix (n x m x k) and every vector (n x k): n x m."""
    return np.asarray((A @ x[..., None])[..., 0])


def transpose(A: Array) -> Array:
    """A^T of every matrix (n x m x k)."""
    return np.swapaxes(A, -1, -2)


def _function(of_floats: Callable[..., Any], name: str) -> Callable[..., Any]:
    """A function of floats, or of an array of one; of other numbers the one that their type has under the name."""

    def function(*numbers: Any) -> Any:
        for x in numbers:
            if isinstance(x, np.ndarray):
                return vector([function(number) for number in x])
            if not isinstance(x, float | int):
                return getattr(type(x), name)(*numbers)
        return of_floats(*numbers)

    return function


sin = _function(math.sin, "sin")
cos = _function(math.cos, "cos")
exp = _function(math.exp, "exp")
sqrt = _function(math.sqrt, "sqrt")
hypot = _function(math.hypot, "hypot")
arctan2 = _function(math.atan2, "arctan2")
larger = _function(max, "larger")
smaller = _function(min, "smaller")
with_sign = _function(math.copysign, "with_sign")  # of a size and of the number that has the sign
pi_like = _function(lambda _: math.pi, "pi_like")  # pi, as a number like another
estimate = _function(float, "estimate")  # a float nearby, to choose among formulas that are all right
angle_over_sine = _function(lambda s, c: math.atan2(s, c) / s if s else 1.0 / c, "angle_over_sine")  # atan2(s, c)/s


def solve(S: Array, b: Array) -> Array:
    """x of S x = b, S (nxn) regular, b (n or nxm). Rows and columns are scaled first: units mix metres and radians."""
    if object in (S.dtype, b.dtype):
        return _solve_exactly(S, b)
    rows = 1.0 / np.max(np.abs(S), axis=1)
    columns = 1.0 / np.max(np.abs(S * rows[:, None]), axis=0)
    return np.asarray((columns * np.linalg.solve(rows[:, None] * S * columns, (rows * b.T).T).T).T, dtype=np.float64)


def solve_symmetric(S: Array, b: Array) -> Array:
    """x of S x = b, S (nxn) symmetric and regular, b (n). Scaled to a unit diagonal first, rows as columns.

    A row of small numbers, such as that of a flywheel beside a carrier of 1e12 kg, then stays small: scaled up on its
    own it would become a pivot, and with it the error of its numbers the error of all.
    """
    if not len(b):
        return b
    if object in (S.dtype, b.dtype):
        return _solve_exactly(S, b)
    scale = 1.0 / np.sqrt(np.abs(np.diag(S)))
    return np.asarray(scale * np.linalg.solve(S * np.outer(scale, scale), scale * b), dtype=np.float64)


def _solve_exactly(S: Array, b: Array) -> Array:
    """x of S x = b, by the solver of the number type (balls)."""
    kind = next(type(x) for x in (*S.flat, *b.flat) if not isinstance(x, float | int))
    result: Array = kind.solve(S, b)
    return result
