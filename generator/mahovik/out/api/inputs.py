"""Inputs of a caller, checked and laid out by component, component i of state j at [i, j]; which one the C refused."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mahovik.contract.quantities import BOUNDS
from mahovik.contract.status import refusal_reason, status_words
from mahovik.core.lower.limits import thresholds, wrong_numbers
from mahovik.core.program.arrays import ArgumentLayout
from mahovik.core.program.types import DOUBLE, FLOAT
from mahovik.core.stand.hold import freedom_names
from mahovik.core.stand.model import TWIST_LETTERS, WRENCH_LETTERS, Stand
from mahovik.core.stand.numbers import in_si
from mahovik.core.stand.units import ANGLE, ANGULAR_ACCELERATION, LENGTH, SPEED, TORQUE, QuantityError, show
from mahovik.errors import InputError, RefusedError
from mahovik.nearest import suggestion
from mahovik.out.result import Axis

Array = NDArray[Any]
Given = ArrayLike | Mapping[str, ArrayLike]
"""Numbers for all components, one number for each of them, or numbers by name, of which the missing are zero."""

PLACE, QUATERNION = Axis("axis", ("x", "y", "z")), Axis("quaternion", ("w", "x", "y", "z"))
TWIST, WRENCH = Axis("twist", tuple(TWIST_LETTERS)), Axis("wrench", tuple(WRENCH_LETTERS))

DIMENSIONS = {
    "position": LENGTH, "angles": ANGLE, "phi": ANGLE, "phi_dot": SPEED, "motor_speed": SPEED, "target_speed": SPEED,
    "avoid_speed": SPEED, "phi_ddot": ANGULAR_ACCELERATION, "limit": ANGULAR_ACCELERATION, "most": ANGULAR_ACCELERATION,
    "tau": TORQUE, "motor_torque": TORQUE,
}  # fmt: skip
"""Inputs that may be texts with a unit."""


def axes_of(stand: Stand) -> dict[str, Axis]:
    """What the numbers of an input count, by the name of the input."""
    axes = {"position": PLACE, "attitude": QUATERNION, "V": TWIST, "V_dot": TWIST}
    axes["angles"] = Axis("angle", ("psi", "theta", "phi"))
    axes |= dict.fromkeys(
        ("phi", "phi_dot", "phi_ddot", "tau"), Axis("flywheel", tuple(s.name for s in stand.flywheels))
    )
    if stand.hold is not None:
        axes |= dict.fromkeys(("u", "u_dot"), Axis("freedom", tuple(freedom_names(stand.hold))))
    return axes


def numbers(values: Any, what: str) -> Array:
    """An array of real numbers, in SI, of an input, with whose name `what` begins. Raises InputError."""
    dimension = DIMENSIONS.get(what.partition(" ")[0])
    try:
        result = np.asarray(values)
        if dimension is not None and result.dtype.kind == "U":
            return np.reshape([in_si(text, dimension) for text in result.flat], result.shape)
    except QuantityError as error:
        raise InputError(f"{what}: {error}") from None
    except (ValueError, TypeError) as error:
        raise InputError(f"{what}: no array of numbers: {str(error).split('. ')[0]}") from None
    if result.dtype.kind not in "iuf":
        if result.size == 0:
            return result.astype(np.float64)
        kind = "texts" if result.dtype.kind == "U" else f"an array of {result.dtype}"
        raise InputError(f"{what}: expected real numbers in SI, found {kind}")
    return result


def is_count(n: Any) -> bool:
    """Whether it is a whole number from 0."""
    return isinstance(n, int | np.integer) and not isinstance(n, bool) and bool(n >= 0)


def read(values: Given, what: str, axis: Axis) -> Array:
    """An array of shape (), (k,) or (n, k) of the k numbers that an axis counts. Raises InputError."""
    names = axis.labels
    if isinstance(values, Mapping):
        parts = {i: numbers(value, f"{what} of {names[i]}") for i, value in places(values, what, axis).items()}
        for i, part in parts.items():
            if part.ndim > 1:
                raise InputError(f"{what} of {names[i]}: expected a number or shape (n,), found {part.shape}")
        n = batch_size({f"{what} of {names[i]}": part for i, part in parts.items()}, 1)
        side_by_side = np.zeros(len(names) if n is None else (n, len(names)))
        for i, part in parts.items():
            side_by_side[..., i] = part
        return side_by_side
    result = numbers(values, what)
    if result.ndim == 0 or (result.ndim <= 2 and result.shape[-1] == len(names)):
        return result
    of = f" ({', '.join(names)})" if 0 < len(names) <= 12 else ""
    raise InputError(f"{what}: expected shape ({len(names)},) or (n, {len(names)}){of}, found {result.shape}")


def places(values: Mapping[str, Any], what: str, axis: Axis) -> dict[int, Any]:
    """Values given by label of an axis, by their place. Raises InputError for an unknown label."""
    for name in values:
        if name not in axis.labels:
            noun = axis.name if axis.name in ("flywheel", "freedom", "row", "angle") else "component"
            raise InputError(f"{what}: no {noun} {show(name)}{suggestion(str(name), axis.labels)}")
    return {axis.labels.index(name): value for name, value in values.items()}


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


def lock_flags(locks: Sequence[str] | ArrayLike, axis: Axis) -> NDArray[np.int32]:
    """Locks of flywheels, an axis, from names, or from a flag for each. Raises InputError."""
    locks, N = (locks,) if isinstance(locks, str) else locks, len(axis.labels)
    if isinstance(locks, Sequence) and all(isinstance(name, str) for name in locks):
        locked = places(dict.fromkeys(map(str, locks)), "locked", axis)
        return np.array([i in locked for i in range(N)], dtype=np.int32)
    result = np.asarray(locks)
    if result.shape != (N,) or result.dtype.kind not in "biu":
        raise InputError(f"locked: expected names of flywheels or {N} flags, found {locks!r:.60}")
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
        parts[body] = read(value, f"wrench of {body}", WRENCH)
    n = batch_size(parts)
    result = np.zeros((len(bodies), 6) if n is None else (n, len(bodies), 6))
    for body, part in parts.items():
        result[..., list(bodies).index(body), :] = part
    return result.reshape(*result.shape[:-2], 6 * len(bodies))


# -- what the C refused

Labels = Mapping[str, Sequence[str]]
"""Names of the numbers of a member, where they have any."""


def refusal_error(
    function: str, status: NDArray[np.int32], inputs: Iterable[tuple[ArgumentLayout, Array]], labels: Labels
) -> RefusedError:
    """The error of a call: names the first refused state, its status, and the input to blame where it can be seen."""
    bad = np.flatnonzero(status < 0)
    index = int(bad[0])
    value = int(status[index])
    name = status_words(value)
    otherwise = refusal_reason(name, "an option is outside its range")
    blamed = next((words for a, memory in inputs for words in _reasons(a, memory, index, labels)), otherwise)
    which = f"state {index}: " if len(status) > 1 else ""
    more = f"; {len(bad):,} of {len(status):,} states refused" if len(bad) > 1 else ""
    return RefusedError(f"{function}: {which}{name}: {blamed}{more}", function, index, value, name, len(bad))


def _reasons(argument: ArgumentLayout, memory: Array, index: int, labels: Labels) -> Iterator[str]:
    """What is wrong with an argument of state `index`, in words."""
    if argument.name == "options":
        yield from _wrong_options(argument, memory, labels)
    elif argument.name == "dt" and not 0.0 < memory[0] <= BOUNDS["MAX_STEP"].value:
        yield f"dt is {memory[0]:.9g} s, expected above 0 and at most {BOUNDS['MAX_STEP'].value:g}"
    elif argument.order == "components":
        yield from wrong_numbers(argument.members, memory[:, index], labels)


_FROM_ZERO = ("motor_torque", "motor_viscous", "motor_coulomb", "motor_power", "target_rate", "avoid_speed")
_ABOVE_ZERO = ("limit", "most", "motor_speed", "motor_coulomb_speed")
_SHARES = ("near_singular", "damping")


def _wrong_options(argument: ArgumentLayout, memory: Array, labels: Labels) -> Iterator[str]:
    """Options of `inverse` that are outside their ranges."""
    least = thresholds(FLOAT if memory["weight"].dtype == np.float32 else DOUBLE).weight
    for member in argument.members:
        if member.kind == "int" or len(member.shape) > 1:  # rows of tasks: any number; curves: of the file
            continue
        for i, x in enumerate(memory[member.name].reshape(-1).tolist()):
            what = f"{member.name} {labels['phi'][i]}" if member.shape else member.name
            if member.name == "weight" and not x >= least:
                yield f"{what} is {x:.9g}, expected at least {least:g}"
            elif member.name in _FROM_ZERO and not x >= 0:
                yield f"{what} is {x:.9g} {member.unit}, expected at least 0"
            elif member.name in _ABOVE_ZERO and not x > 0:
                yield f"{what} is {x:.9g} {member.unit}, expected above 0"
            elif member.name in _SHARES and not 0 <= x <= 1:
                yield f"{what} is {x:.9g}, expected 0 to 1"
