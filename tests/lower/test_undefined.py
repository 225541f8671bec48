"""Nothing that C leaves undefined: no variable is read before it is written, no index or shift out of its range."""

import math
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import mahovik.core.program.interpret as module
from emit.compiled import QUANTITIES, bits, compiled
from mahovik.core.program.types import Kind, Precision, Struct
from mahovik.core.stand.random import extreme_state, random_state
from toolchain.quick import quick

NAMES = ("everything6", "hung5", "wet7", "bare5", "everything0", "bare0", "stream1")

MORE_FUNCTIONS = (
    *("quaternion", "torque", "mounts", "coupled", "inverse", "inverse_fast", "points"),
    *("forward_jacobian", "coupled_jacobian", "step", "step_driven"),
)


@pytest.mark.parametrize("name", quick(1, NAMES))
def test_nothing_is_read_before_it_is_written(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """The interpreter begins locals and outputs with zeros, C with what was there: with NaN nothing may change."""
    c = compiled(name)

    def spoilt(type_: Kind | Struct, shape: tuple[Any, ...], precision: Precision) -> Any:
        if shape:
            return [spoilt(type_, shape[1:], precision) for _ in range(int(shape[0]))]
        if isinstance(type_, Struct):
            return SimpleNamespace(**{f.name: spoilt(f.type, f.shape, precision) for f in type_.fields})
        return precision.scalar(math.nan) if type_ is Kind.REAL else 10**9

    plain = module.Interpreter(c.program)
    monkeypatch.setattr(module, "new_value", spoilt)
    strict = module.Interpreter(c.program)
    rng = np.random.default_rng(2)
    states = [random_state(c.stand, rng) for _ in range(3)]
    states += [extreme_state(c.stand, rng, kind) for kind in ("rest", "half_turn")]
    for state in states:
        arguments = c.arguments(state) | {"mounting": c.values.mounting, "dt": 1e-4, "order": 4}
        carry = {"rounding": [1e-12] * (13 + 2 * len(c.stand.flywheels))}
        functions = [(called, arguments) for called in filter(c.has, (*QUANTITIES, *MORE_FUNCTIONS))]
        functions += [(called, arguments | {"carry": carry}) for called, _ in functions if called.startswith("step")]
        for function, known in functions:
            taken = (a.name for a in c.program.function(function).arguments if a.direction != "out")
            inputs = {name: known[name] for name in taken if name in known}
            want, got = plain.run(function, inputs), strict.run(function, inputs)
            assert want[0] == got[0]
            if want[0] >= 0:
                assert bits(want[1]) == bits(got[1]), function
    inputs = {"parameters": c.values.parameters, "table": c.values.table}
    assert bits(plain.run("prepare", inputs)[1]) == bits(strict.run("prepare", inputs)[1])
