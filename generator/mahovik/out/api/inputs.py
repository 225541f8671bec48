"""Inputs of a caller, checked and laid out by component: component i of state j at [i, j]."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mahovik.contract.quantities import UNIT_LENGTH
from mahovik.core.stand.model import TWIST_LETTERS, WRENCH_LETTERS, Hold
from mahovik.core.stand.units import show
from mahovik.errors import InputError
from mahovik.nearest import suggestion
from mahovik.proof.verify.held import blocked_twist
from mahovik.proof.verify.states import ROUNDING

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


def read_twist(given: Given, hold: Hold | None) -> Array:
    """V of shape (), (6,) or (n, 6). Raises InputError; also for one that a hold does not allow."""
    found = read(given, "V", 6, TWIST_LETTERS, "component")
    if hold is not None and (reason := blocked_twist(hold, found * np.ones(6))):
        raise InputError(reason)
    return found


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
    """Values given by name, by their place. Raises InputError for an unknown name."""
    found = {}
    for name, value in given.items():
        if name not in names:
            hint = suggestion(str(name), names)
            raise InputError(f"{what}: no {noun} {show(name)}{hint}")
        found[list(names).index(name)] = value
    return found


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
    found = np.empty((count, n), dtype=real)
    found[...] = part if part.ndim == 0 else part[:, np.newaxis]
    return found


def lock_flags(given: Sequence[str] | ArrayLike, names: Sequence[str]) -> NDArray[np.int32]:
    """Locks of flywheels from names, or from a flag for each."""
    if isinstance(given, str):
        given = (given,)
    if isinstance(given, Sequence) and all(isinstance(each, str) for each in given):
        unknown = [str(each) for each in given if each not in names]
        if unknown:
            hint = suggestion(unknown[0], names)
            raise InputError(f"locked: no flywheel {show(unknown[0])}{hint}")
        return np.array([name in given for name in names], dtype=np.int32)
    found = np.asarray(given)
    if found.shape != (len(names),) or found.dtype.kind not in "biu":
        raise InputError(f"locked: expected names of flywheels or {len(names)} flags, found {given!r:.60}")
    return np.asarray(found != 0, dtype=np.int32)


def pack_states(parts: Mapping[str, tuple[Array, int]], n: int | None, real: np.dtype[Any]) -> Array:
    """Arrays of shape (), (count,), (n, count) below one another, (components, n). Raises InputError."""
    many = batch_size({name: part for name, (part, _) in parts.items()})
    if n is not None and (isinstance(n, bool) or not isinstance(n, int | np.integer) or n < 0):
        raise InputError(f"states: n: expected a number of states, found {n!r:.40}")
    if n is not None and many not in (None, n):
        raise InputError(f"states: n is {n}, but arrays of {many} states were given")
    size = n if n is not None else many if many is not None else 1
    memory = np.empty((sum(count for _, count in parts.values()), size), dtype=real)
    row = 0
    for part, count in parts.values():
        with np.errstate(over="ignore"):  # beyond float is infinite, which the C refuses by name
            memory[row : row + count] = part.T if part.ndim == 2 else part[:, np.newaxis] if part.ndim else part
        row += count
    return memory


def attitudes(attitude: ArrayLike | None, angles: ArrayLike | None, quaternions: Callable[[Array], Array]) -> Array:
    """Unit quaternions, (4,) or (n, 4), of quaternions or angles. Raises InputError, RefusedError."""
    if attitude is not None and angles is not None:
        raise InputError("attitude, angles: both given, expected one of them")
    if angles is not None:
        given = read(angles, "angles", 3, ("psi", "theta", "phi"), "angle")
        return quaternions(np.full(3, given) if given.ndim == 0 else given)
    if attitude is None:
        return np.array([1.0, 0.0, 0.0, 0.0])
    found = numbers(attitude, "attitude")
    if found.ndim not in (1, 2) or found.shape[-1] != 4:
        raise InputError(f"attitude: expected shape (4,) or (n, 4) (w, x, y, z), found {found.shape}")
    length = np.linalg.norm(found.astype(np.float64), axis=-1, keepdims=True)
    wrong = np.flatnonzero(~(np.abs(length - 1.0) <= UNIT_LENGTH))
    if wrong.size:
        where = f" of state {wrong[0]}" if found.ndim == 2 else ""
        raise InputError(f"attitude{where}: length {length.flat[wrong[0]]:.9g}, expected 1 within {UNIT_LENGTH:g}")
    return np.where(np.abs(length - 1.0) <= ROUNDING, found, found / length)


def wrenches(given: Mapping[str, ArrayLike] | None, bodies: Sequence[str], known: Sequence[str]) -> Array:
    """Run-time wrenches of bodies, (6 W,) or (n, 6 W), by what is given by name. Raises InputError.

    `bodies`: those that take one; `known`: all of the stand.
    """
    if given is not None and not isinstance(given, Mapping):
        raise InputError(f"wrench: expected six numbers by the name of each body, found {type(given).__name__}")
    parts: dict[str, Array] = {}
    for body, value in (given or {}).items():
        if body not in known:
            raise InputError(f"wrench: no body {show(body)}{suggestion(str(body), known)}")
        if body not in bodies:
            raise InputError(f"wrench: the C takes none on {show(body)}: set `wrench_input = true` in the stand file")
        parts[body] = read(value, f"wrench of {body}", 6, WRENCH_LETTERS, "component")
    n = batch_size(parts)
    found = np.zeros((6 * len(bodies),) if n is None else (n, 6 * len(bodies)))
    for body, part in parts.items():
        first = 6 * list(bodies).index(body)
        found[..., first : first + 6] = part
    return found
