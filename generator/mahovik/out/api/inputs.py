"""What a caller gives, checked and laid out by component: component i of state j at [i, j]."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mahovik.core.stand.units import show
from mahovik.errors import InputError
from mahovik.nearest import meant

Array = NDArray[Any]
Given = ArrayLike | Mapping[str, ArrayLike]
"""Numbers for all components, one number for each of them, or numbers by name, of which the missing are zero."""

_NUMBERS = "iuf"


def numbers(given: Any, what: str) -> Array:
    """An array of real numbers. Raises InputError for anything else."""
    try:
        found = np.asarray(given)
    except (ValueError, TypeError) as error:
        raise InputError(f"{what}: no array of numbers: {str(error).split('. ')[0]}") from None
    if found.dtype.kind not in _NUMBERS:
        if found.size == 0:
            return found.astype(np.float64)
        raise InputError(f"{what}: expected real numbers, found an array of {found.dtype}")
    return found


def read(given: Given, what: str, count: int, names: Sequence[str], noun: str) -> Array:
    """An array of shape (), (count,) or (n, count). Raises InputError. `names`: of the components, `noun`s."""
    if isinstance(given, Mapping):
        return _by_name(given, what, names, noun)
    found = numbers(given, what)
    if found.ndim == 0 or (found.ndim <= 2 and found.shape[-1] == count):
        return found
    of = f" ({', '.join(names)})" if 0 < len(names) <= 12 else ""
    raise InputError(f"{what}: expected shape ({count},) or (n, {count}){of}, found {found.shape}")


def _by_name(given: Mapping[str, ArrayLike], what: str, names: Sequence[str], noun: str) -> Array:
    parts: dict[int, Array] = {}
    for i, value in places(given, what, names, noun).items():
        parts[i] = numbers(value, f"{what} of {names[i]}")
        if parts[i].ndim > 1:
            raise InputError(f"{what} of {names[i]}: expected a number or shape (n,), found {parts[i].shape}")
    n = batch_size({f"{what} of {names[i]}": part for i, part in parts.items()}, 1)
    found = np.zeros((len(names),) if n is None else (n, len(names)))
    for i, part in parts.items():
        found[..., i] = part
    return found


def places(given: Mapping[str, Any], what: str, names: Sequence[str], noun: str) -> dict[int, Any]:
    """What is given by name, by its place. Raises InputError for an unknown name."""
    found = {}
    for name, value in given.items():
        if name not in names:
            hint = meant(str(name), names)
            raise InputError(f"{what}: no {noun} {show(name)}{hint}")
        found[list(names).index(name)] = value
    return found


def batch_size(parts: Mapping[str, Array], axes: int = 2) -> int | None:
    """The number of states of arrays that have a batch axis (those of so many axes); None where none has.

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
    found = np.empty((count, n), dtype=real)
    found[...] = part if part.ndim == 0 else part[:, np.newaxis]
    return found


def flags(given: Sequence[str] | ArrayLike, names: Sequence[str]) -> NDArray[np.int32]:
    """Locks of flywheels from names, or from a flag for each."""
    if isinstance(given, str):
        given = (given,)
    if isinstance(given, Sequence) and all(isinstance(each, str) for each in given):
        unknown = [str(each) for each in given if each not in names]
        if unknown:
            hint = meant(unknown[0], names)
            raise InputError(f"locked: no flywheel {show(unknown[0])}{hint}")
        return np.array([name in given for name in names], dtype=np.int32)
    found = np.asarray(given)
    if found.shape != (len(names),) or found.dtype.kind not in "biu":
        raise InputError(f"locked: expected names of flywheels or {len(names)} flags, found {given!r:.60}")
    return np.asarray(found != 0, dtype=np.int32)
