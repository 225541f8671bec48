"""Calls with one spoiled number each, and the check that nothing was written."""

import copy
import math
from collections.abc import Iterator
from typing import Any

from emit.compiled import Compiled, bits
from mahovik.contract.status import STATUS_VALUES
from mahovik.core.toolchain.library import uniform_data

FILL = 4321.5
"""What outputs hold before a call."""

NumberPath = tuple[Any, ...]
"""Keys and indices from plain data down to one number."""

NOT_FINITE = (math.nan, math.inf, -math.inf)


def numbers(value: Any, path: NumberPath = ()) -> Iterator[NumberPath]:
    """Paths of every real in plain data."""
    if isinstance(value, dict):
        for name, inner in value.items():
            yield from numbers(inner, (*path, name))
    elif isinstance(value, list | tuple):
        for index, inner in enumerate(value):
            yield from numbers(inner, (*path, index))
    elif isinstance(value, float):
        yield path


def spoiled(value: Any, path: NumberPath, number: Any) -> Any:
    """Plain data with one number replaced."""
    changed = copy.deepcopy(value)
    place = changed
    for step in path[:-1]:
        place = place[step]
    place[path[-1]] = number
    return changed


def get(value: Any, path: NumberPath) -> Any:
    """Value at a path."""
    for step in path:
        value = value[step]
    return value


def refuses(c: Compiled, function: str, inputs: dict[str, Any], *expected: str) -> None:
    """The C refuses with one of the statuses and leaves every output as it was."""
    status, outputs = c.c(function, inputs, fill=FILL)
    assert status in {STATUS_VALUES[name] for name in expected}, (function, status)
    for a in c.program.function(function).arguments:
        if a.direction == "out":
            assert outputs[a.name] == uniform_data(a.type, a.shape, FILL), f"{function} wrote {a.name}"
        elif a.direction == "inout":
            assert bits(outputs[a.name]) == bits(inputs[a.name]), f"{function} wrote {a.name}"


def accepts(c: Compiled, function: str, inputs: dict[str, Any]) -> dict[str, Any]:
    """Outputs of a call that is good, all finite."""
    status, outputs = c.c(function, inputs, fill=FILL)
    assert status == 0, (function, status)
    for path in numbers(outputs):
        assert math.isfinite(get(outputs, path)), (function, path)
    return outputs
