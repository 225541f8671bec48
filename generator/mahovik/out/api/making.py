"""Memory of states and wrenches from what a caller gives."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from mahovik.contract.quantities import UNIT_LENGTH
from mahovik.core.stand.model import WRENCH_LETTERS
from mahovik.core.stand.units import show
from mahovik.errors import InputError
from mahovik.nearest import meant
from mahovik.out.api import inputs
from mahovik.out.api.fields import Array
from mahovik.proof.verify.states import ROUNDING


def packed(parts: Mapping[str, tuple[Array, int]], n: int | None, real: np.dtype[Any]) -> Array:
    """Arrays of shape (), (count,), (n, count) below one another, (components, n). Raises InputError."""
    many = inputs.batch_size({name: part for name, (part, _) in parts.items()})
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
        given = inputs.read(angles, "angles", 3, ("psi", "theta", "phi"), "angle")
        return quaternions(np.full(3, given) if given.ndim == 0 else given)
    if attitude is None:
        return np.array([1.0, 0.0, 0.0, 0.0])
    found = inputs.numbers(attitude, "attitude")
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
            raise InputError(f"wrench: no body {show(body)}{meant(str(body), known)}")
        if body not in bodies:
            raise InputError(f"wrench: the C takes none on {show(body)}: set `wrench_input = true` in the stand file")
        parts[body] = inputs.read(value, f"wrench of {body}", 6, WRENCH_LETTERS, "component")
    n = inputs.batch_size(parts)
    found = np.zeros((6 * len(bodies),) if n is None else (n, 6 * len(bodies)))
    for body, part in parts.items():
        first = 6 * list(bodies).index(body)
        found[..., first : first + 6] = part
    return found
