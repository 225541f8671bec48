"""Inputs of a caller, checked and laid out by component: component i of state j at [i, j]."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mahovik.core.stand.model import WRENCH_LETTERS
from mahovik.core.stand.units import TIME, QuantityError, number, show
from mahovik.errors import InputError
from mahovik.nearest import suggestion

Array = NDArray[Any]
Given = ArrayLike | Mapping[str, ArrayLike]
"""Numbers for all components, one number for each of them, or numbers by name, of which the missing are zero."""


def numbers(values: Any, what: str) -> Array:
    """An array of real numbers. Raises InputError for anything else."""
    try:
        result = np.asarray(values)
    except (ValueError, TypeError) as error:
        raise InputError(f"{what}: no array of numbers: {str(error).split('. ')[0]}") from None
    if result.dtype.kind not in "iuf":
        if result.size == 0:
            return result.astype(np.float64)
        raise InputError(f"{what}: expected real numbers, found an array of {result.dtype}")
    return result


def is_count(n: Any) -> bool:
    """Whether it is a whole number from 0."""
    return isinstance(n, int | np.integer) and not isinstance(n, bool) and bool(n >= 0)


def time(value: Any, what: str) -> Any:
    """A text with a unit as a time in s; anything else as it is. Raises InputError."""
    try:
        return number(value, TIME) if isinstance(value, str) else value
    except QuantityError as error:
        raise InputError(f"{what}: {error}") from None


def read(values: Given, what: str, count: int, names: Sequence[str], noun: str) -> Array:
    """An array of shape (), (count,) or (n, count). Raises InputError. `names`: of the components, `noun`s."""
    if isinstance(values, Mapping):
        parts = {i: numbers(value, f"{what} of {names[i]}") for i, value in places(values, what, names, noun).items()}
        for i, part in parts.items():
            if part.ndim > 1:
                raise InputError(f"{what} of {names[i]}: expected a number or shape (n,), found {part.shape}")
        n = batch_size({f"{what} of {names[i]}": part for i, part in parts.items()}, 1)
        return _side_by_side(parts, n, len(names), 1)
    result = numbers(values, what)
    if result.ndim == 0 or (result.ndim <= 2 and result.shape[-1] == count):
        return result
    of = f" ({', '.join(names)})" if 0 < len(names) <= 12 else ""
    raise InputError(f"{what}: expected shape ({count},) or (n, {count}){of}, found {result.shape}")


def _side_by_side(parts: Mapping[int, Array], n: int | None, count: int, width: int) -> Array:
    """Parts by place, each `width` numbers wide, as (count width,) or (n, count width); missing ones are 0."""
    result = np.zeros((count, width) if n is None else (n, count, width))
    for i, part in parts.items():
        result[..., i, :] = part[..., np.newaxis] if width == 1 else part
    return result.reshape(*result.shape[:-2], count * width)


def places(values: Mapping[str, Any], what: str, names: Sequence[str], noun: str) -> dict[int, Any]:
    """Values given by name, by their place. Raises InputError for an unknown name."""
    result = {}
    for name, value in values.items():
        if name not in names:
            raise InputError(f"{what}: no {noun} {show(name)}{suggestion(str(name), names)}")
        result[list(names).index(name)] = value
    return result


def batch_size(parts: Mapping[str, Array], axes: int = 2) -> int | None:
    """The number of states of arrays that have a batch axis (with this many axes); None if none has one.

    Raises InputError where they differ.
    """
    sizes = {name: len(part) for name, part in parts.items() if part.ndim == axes}
    if len(set(sizes.values())) > 1:
        raise InputError(f"different numbers of states: {', '.join(f'{k} {n}' for k, n in sizes.items())}")
    return next(iter(sizes.values()), None)


def by_component(part: Array, count: int, n: int, real: np.dtype[Any]) -> Array:
    """The array as (count, n), contiguous; without copying where it lies like this already."""
    if part.ndim == 2:
        return np.ascontiguousarray(part.T, dtype=real)
    if part.ndim == 1 and n == 1:
        return np.ascontiguousarray(part[:, np.newaxis], dtype=real)
    if not part.any():
        return np.zeros((count, n), dtype=real)
    result = np.empty((count, n), dtype=real)
    result[...] = part if part.ndim == 0 else part[:, np.newaxis]
    return result


def lock_flags(locks: Sequence[str] | ArrayLike, names: Sequence[str]) -> NDArray[np.int32]:
    """Locks of flywheels from names, or from a flag for each. Raises InputError."""
    locks = (locks,) if isinstance(locks, str) else locks
    if isinstance(locks, Sequence) and all(isinstance(name, str) for name in locks):
        locked = places(dict.fromkeys(map(str, locks)), "locked", names, "flywheel")
        return np.array([i in locked for i in range(len(names))], dtype=np.int32)
    result = np.asarray(locks)
    if result.shape != (len(names),) or result.dtype.kind not in "biu":
        raise InputError(f"locked: expected names of flywheels or {len(names)} flags, found {locks!r:.60}")
    return np.asarray(result != 0, dtype=np.int32)


def wrenches(by_body: Mapping[str, ArrayLike] | None, bodies: Sequence[str], known: Sequence[str]) -> Array:
    """Run-time wrenches of bodies, (6 W,) or (n, 6 W), by what is given by name. Raises InputError.

    `bodies`: those that take one; `known`: all of the stand.
    """
    if by_body is not None and not isinstance(by_body, Mapping):
        raise InputError(f"wrench: expected six numbers by the name of each body, found {type(by_body).__name__}")
    parts: dict[str, Array] = {}
    for body, value in (by_body or {}).items():
        if body not in known:
            raise InputError(f"wrench: no body {show(body)}{suggestion(str(body), known)}")
        if body not in bodies:
            raise InputError(f"wrench: the C takes none on {show(body)}: set `wrench_input = true` in the stand file")
        parts[body] = read(value, f"wrench of {body}", 6, WRENCH_LETTERS, "component")
    return _side_by_side({list(bodies).index(body): x for body, x in parts.items()}, batch_size(parts), len(bodies), 6)
