"""Why the C refused a state, in words: the input to blame, where it can be seen."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mahovik.contract.quantities import QUANTITIES
from mahovik.contract.status import refusal_reason, status_words
from mahovik.core.lower.limits import UNIT_SQUARE_MAX, UNIT_SQUARE_MIN, limits, thresholds
from mahovik.core.program.arrays import ArgumentLayout
from mahovik.core.program.types import DOUBLE, FLOAT
from mahovik.errors import RefusedError

Array = NDArray[Any]
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
        return
    precision = FLOAT if memory.dtype == np.float32 else DOUBLE
    bounds = limits(precision)
    if argument.name == "dt" and not 0.0 < memory[0] <= bounds["MAX_STEP"].value:
        yield f"dt is {memory[0]:.9g} s, expected above 0 and at most {bounds['MAX_STEP'].value:g}"
    first = 0
    for member in argument.members if argument.order == "components" else ():
        column = memory[first : first + member.size, index].astype(np.float64)
        first += member.size
        names = labels.get(member.name, ())
        known = QUANTITIES[member.name].bounds if member.name in QUANTITIES else ()
        for i, x in enumerate(column.tolist()):
            what = f"{member.name} {names[i]}" if names else f"{member.name}[{i}]"
            if not np.isfinite(x):
                yield f"{what} is {x}"
            elif known and abs(x) > (bound := bounds[known[i // 3 % len(known)]]).value:
                yield f"{what} is {x:.9g}, at most {bound.value:g} {bound.unit}".rstrip()
        if member.name == "attitude" and not UNIT_SQUARE_MIN <= float(np.sum(column**2)) <= UNIT_SQUARE_MAX:
            yield f"attitude has length {float(np.linalg.norm(column)):.9g}, expected 1 within 0.001"


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
