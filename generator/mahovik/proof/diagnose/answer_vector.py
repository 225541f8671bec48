"""Results of many states as one vector: how far they are from the reference, in units of the natural scale."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mahovik.core.stand.model import Stand
from mahovik.errors import StateError
from mahovik.proof import reference
from mahovik.proof.reference.array import Array
from mahovik.proof.verify.actuators import stand_at
from mahovik.proof.verify.bounds import DOUBLE, Bounds
from mahovik.proof.verify.scales import scales
from mahovik.proof.verify.states import Request

FARTHEST = 1e100
"""Largest error over the scale, which may be zero; its square is still finite."""

NOT_COMPARED = ("status", "rank")

Numbers = NDArray[np.int64]


@dataclass(frozen=True, eq=False)
class AnswerVector:
    """Requests and the answers of the reference, as vectors of the same length.

    block      of each number, the index in `quantities` of its (want, quantity)
    expected   of the reference
    scale      natural scale
    parts      of each request, its slices: (quantity as a path, shape, start)
    """

    requests: tuple[Request, ...]
    quantities: tuple[tuple[str, str], ...]
    block: Numbers
    expected: Array
    scale: Array
    parts: tuple[tuple[tuple[tuple[str, ...], tuple[int, ...], int], ...], ...]

    def fill(self, answers: Callable[[Request], Mapping[str, Any]]) -> Array:
        """The same numbers from other answers; NaN if missing or of another shape."""
        found = np.full(self.expected.size, np.nan)
        for request, parts in zip(self.requests, self.parts, strict=True):
            if not parts:
                continue
            values = answers(request)
            for path, shape, start in parts:
                numbers = _value_at(values, path, shape)
                if numbers is not None:
                    found[start : start + numbers.size] = numbers.ravel()
        return found

    def over_scale(self, error: Array) -> Array:
        """An error of all numbers, or of the first ones, in units of their scale; none beyond FARTHEST."""
        with np.errstate(all="ignore"):
            return np.clip(error / self.scale[: error.size], -FARTHEST, FARTHEST)

    def head(self, count: int) -> AnswerVector:
        """The vector of the first requests: its numbers are the first ones of this."""
        end = next((start for parts in self.parts[count:] for _, _, start in parts), self.expected.size)
        cut = (self.block[:end], self.expected[:end], self.scale[:end], self.parts[:count])
        return AnswerVector(self.requests[:count], self.quantities, *cut)

    def without_first(self, count: int) -> AnswerVector:
        """The vector without its first requests; the other numbers keep their places."""
        return replace(self, parts=((),) * count + self.parts[count:])

    def noise(self, bounds: Bounds) -> Array:
        """Largest rounding error of each number, in units of the scale, by the bounds of an element type."""
        accepted = np.array([10 * bounds.of(*quantity) for quantity in self.quantities])
        return accepted[self.block]


def answer_vector(stand: Stand, requests: Sequence[Request]) -> AnswerVector:
    """The vector of one-want requests; those that the reference refuses are left out."""
    quantities: dict[tuple[str, str], int] = {}
    kept, parts, blocks, expected, scale = [], [], [], [], []
    start = 0
    for request in requests:
        (want,) = request.want
        try:
            own = stand_at(stand, request.state)
            at = reference.pieces(own, request.state)
            values = reference.evaluate(own, request.state, request.want, at)
        except (StateError, np.linalg.LinAlgError, ArithmeticError):
            continue
        natural = scales(own, request.state, at, want)
        places = []
        for path, value, size in _leaves(values, natural):
            places.append((path, value.shape, start))
            name = path[0] if len(path) == 1 else f"{path[0]}.{path[-1]}"
            blocks.append(np.full(value.size, quantities.setdefault((want, name), len(quantities))))
            expected.append(value.ravel())
            scale.append(np.maximum(np.broadcast_to(size, value.shape).ravel(), DOUBLE.floor))
            start += value.size
        kept.append(request)
        parts.append(tuple(places))
    return AnswerVector(
        tuple(kept),
        tuple(quantities),
        np.concatenate([*blocks, np.zeros(0)]).astype(np.int64),
        np.concatenate([*expected, np.zeros(0)]),
        np.concatenate([*scale, np.zeros(0)]),
        tuple(parts),
    )


def _leaves(
    values: Mapping[str, Any], natural: Mapping[str, Any], path: tuple[str, ...] = ()
) -> Iterator[tuple[tuple[str, ...], Array, Any]]:
    for name, value in values.items():
        if isinstance(value, Mapping):
            yield from _leaves(value, natural[name], (*path, name))
        elif name not in NOT_COMPARED:
            yield (*path, name), np.asarray(value, dtype=np.float64), natural[name]


def _value_at(values: Any, path: tuple[str, ...], shape: tuple[int, ...]) -> Array | None:
    numbers = numbers_at(values, path)
    return numbers if numbers is not None and numbers.shape == shape else None


def numbers_at(values: Any, path: tuple[str, ...]) -> Array | None:
    """Numbers of a quantity in an answer, in whatever shape; None: missing, or no array of numbers."""
    for name in path:
        if not isinstance(values, Mapping) or name not in values:
            return None
        values = values[name]
    try:
        return np.array(values, dtype=np.float64)
    except (ValueError, TypeError, OverflowError):
        return None
