"""Why a state was refused, in one line: the input that is to blame, its value, its bound."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mahovik.contract.quantities import QUANTITIES
from mahovik.contract.status import refusal_reason, status_words
from mahovik.core.lower.limits import UNIT_SQUARE_MAX, UNIT_SQUARE_MIN, Limit, limits
from mahovik.core.lower.thresholds import thresholds
from mahovik.core.program.arrays import ArgumentLayout
from mahovik.core.program.types import DOUBLE, FLOAT, Precision
from mahovik.core.stand.model import WRENCH_LETTERS, Stand
from mahovik.errors import RefusedError
from mahovik.out.api.fields import Array, field


def refused(
    function: str,
    status: NDArray[np.int32],
    inputs: Mapping[str, tuple[ArgumentLayout, Array]],
    stand: Stand,
    wrenches: Sequence[str],
) -> RefusedError:
    """The error of a call: names the first refused state, its status, and the input to blame where it can be seen."""
    bad = np.flatnonzero(status < 0)
    index = int(bad[0])
    value = int(status[index])
    name = status_words(value)
    blamed = next(_blamed(index, inputs, stand, wrenches), refusal_reason(name, "an option is outside its range"))
    which = f"state {index}: " if len(status) > 1 else ""
    more = f"; {len(bad):,} of {len(status):,} states refused" if len(bad) > 1 else ""
    message = f"{function}: {which}{name}: {blamed}{more}"
    return RefusedError(message, function, index, value, name, len(bad))


def _blamed(
    index: int, inputs: Mapping[str, tuple[ArgumentLayout, Array]], stand: Stand, wrenches: Sequence[str]
) -> Iterator[str]:
    for argument, memory in inputs.values():
        if argument.name == "dt" and not 0.0 < memory[0] <= _bounds(memory)["MAX_STEP"].value:
            yield f"dt is {memory[0]:.9g} s, expected above 0 and at most {_bounds(memory)['MAX_STEP'].value:g}"
        if argument.name == "options":
            yield from _option(argument, memory, stand)
        if argument.order != "components":
            continue
        row = 0
        for member in argument.members:
            labels = field(member, stand, ()).labels[0]
            if member.name == "wrench":
                labels = tuple(f"{body} {letter}" for body in wrenches for letter in WRENCH_LETTERS)
            column = memory[row : row + member.size, index]
            row += member.size
            yield from _wrong(member.name, column, labels, member.unit)


def _option(argument: ArgumentLayout, memory: Array, stand: Stand) -> Iterator[str]:
    """Options of `inverse` that are outside their ranges."""
    least = thresholds(_precision(memory["weight"])).weight
    for member in argument.members:
        values = memory[member.name].reshape(-1).tolist()
        for i, x in enumerate(values):
            what = f"{member.name} {stand.flywheels[i].name}" if member.shape else member.name
            if member.name == "weight" and not x >= least:
                yield f"{what} is {x:.9g}, expected at least {least:g}"
            elif member.name == "limit" and not x > 0:
                yield f"{what} is {x:.9g} {member.unit}, expected above 0"
            elif member.name in ("near", "damping") and not 0 <= x <= 1:
                yield f"{what} is {x:.9g}, expected 0 to 1"


def _wrong(name: str, column: NDArray[Any], labels: Sequence[str], unit: str) -> Iterator[str]:
    bounds = _bounds(column)
    for i, x in enumerate(column.tolist()):
        what = f"{name} {labels[i]}" if labels else f"{name}[{i}]"
        if not np.isfinite(x):
            yield f"{what} is {x}"
            continue
        names = QUANTITIES[name].bounds if name in QUANTITIES else ()
        if names and abs(x) > bounds[limit := names[i // 3 % len(names)]].value:
            yield f"{what} is {x:.9g}, at most {bounds[limit].value:g} {bounds[limit].unit}".rstrip()
    if name == "attitude" and not UNIT_SQUARE_MIN <= float(np.sum(column.astype(np.float64) ** 2)) <= UNIT_SQUARE_MAX:
        length = float(np.linalg.norm(column.astype(np.float64)))
        yield f"attitude has length {length:.9g}, expected 1 within 0.001"


def _bounds(a: Array) -> dict[str, Limit]:
    return limits(_precision(a))


def _precision(a: Array) -> Precision:
    return FLOAT if a.dtype == np.float32 else DOUBLE
