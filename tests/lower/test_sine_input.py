"""Given sines and cosines: the bits of those of phases, and what is refused."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest

from emit.compiled import bits
from lower.refusals import FILL
from mahovik.contract.functions import TURNS
from mahovik.contract.status import STATUS_VALUES
from mahovik.core.program.interpret import Interpreter
from mahovik.core.stand.random import BARE, EVERYTHING, Features, random_stand, random_state
from mahovik.core.toolchain.library import uniform_data
from mahovik.proof.verify.c_backend import CBackend

FUNCTIONS = ("forward", "torque", "coupled", "inverse_fast")
FLOATING = Features("ship", 1, True, True, True, 1, True, laws={"suspension": 1, "leg": 1})
STANDS = {"turned3": (3, EVERYTHING), "turned8": (8, FLOATING), "turned1": (1, BARE)}


@cache
def backend(name: str, precision_name: str = "double") -> CBackend:
    count, features = STANDS[name]
    stand = random_stand(np.random.default_rng(list(name.encode())), count, features, name)
    return CBackend(replace(stand, phase_input="sincos"), precision_name)


def inputs_of(c: CBackend, seed: int = 0) -> dict[str, Any]:
    """A state, and the sines and cosines of its phases by the routine of the program."""
    inputs = c.arguments(random_state(c.generated.values._stand, np.random.default_rng(seed)))
    options = {name: np.array(v).tolist() for name, v in inputs["options"].items()}
    largest = c.generated.program.precision.largest
    options["limit"] = [min(v, largest) for v in options["limit"]]
    routines = Interpreter(c.generated.program)
    turns = []
    for phi in inputs["x"]["phi"]:
        scalar = c.generated.program.precision.scalar
        sine, cosine = [scalar(0)], [scalar(0)]
        routines.call("sincos", scalar(phi), sine, cosine)
        turns.append((float(sine[0]), float(cosine[0])))
    sines, cosines = zip(*turns, strict=True)
    return inputs | {"options": options, "sine": list(sines), "cosine": list(cosines)}


def without_phases(inputs: dict[str, Any]) -> dict[str, Any]:
    """The same state with other phases: functions of sines must not look at them."""
    return inputs | {"x": {**inputs["x"], "phi": [1.25 - p for p in inputs["x"]["phi"]]}}


def run(c: CBackend, function: str, inputs: dict[str, Any]) -> tuple[int, dict[str, Any]]:
    wanted = {a.name for a in c.program.function(function).arguments if a.direction != "out"}
    return c.library.run(c.program.function(function), {n: v for n, v in inputs.items() if n in wanted}, FILL)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "precision_name"), [*((name, "double") for name in STANDS), ("turned3", "float")], ids=str
)
@pytest.mark.parametrize("function", FUNCTIONS)
def test_the_sines_of_the_phases_give_the_bits_of_the_phases(name: str, function: str, precision_name: str) -> None:
    c = backend(name, precision_name)
    for seed in range(5):
        inputs = inputs_of(c, seed)
        status, want = run(c, function, {k: v for k, v in inputs.items() if k not in TURNS})
        assert status in (0, STATUS_VALUES["EXCESSIVE"])
        same, got = run(c, function, without_phases(inputs))
        assert (same, bits(got)) == (status, bits(want))


def refused(c: CBackend, function: str, inputs: dict[str, Any], due: str) -> None:
    status, outputs = run(c, function, inputs)
    assert status == STATUS_VALUES[due]
    for a in c.program.function(function).arguments:
        if a.direction == "out":
            assert outputs[a.name] == uniform_data(a.type, a.shape, FILL)


@pytest.mark.parametrize("function", FUNCTIONS)
def test_what_is_no_sine_and_cosine_is_refused(function: str) -> None:
    c = backend("turned3")
    inputs = inputs_of(c)
    for s in range(3):
        for name in TURNS:
            for value, due in ((math.nan, "NOT_FINITE"), (math.inf, "NOT_FINITE"), (2.5, "RANGE"), (-1e200, "RANGE")):
                arguments = list(inputs[name])
                arguments[s] = value
                refused(c, function, inputs | {name: arguments}, due)
    for name in TURNS:
        refused(c, function, {k: v for k, v in inputs.items() if k != name}, "BAD_ARGUMENT")
