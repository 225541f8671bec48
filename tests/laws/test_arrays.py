"""The program on columns and on arrays against the interpreter: the wrenches of all laws, and their slopes."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from laws.stands import TEXTS, bearing
from mahovik.core.lower.law_arrays import LawArrays, law_functions, quaternions
from mahovik.core.program.columns import Array
from mahovik.core.program.function import Program
from mahovik.core.program.interpret import Interpreter
from mahovik.core.program.types import DOUBLE
from mahovik.core.stand.model import Stand
from mahovik.core.stand.structure import structure
from mahovik.use.numeric.se3 import attitude
from strategies import held_stands, stands

ROUTINES = {
    name: lambda *x, f=function: float(f(*map(np.atleast_1d, x))[0])
    for name, function in (("atan2", np.arctan2), ("exp", np.exp))
}
"""Routines of our own, of which those of NumPy differ in the last digit."""


def compare(
    stand: Stand, name: str, out: str, inputs: dict[str, Any], samples: dict[str, Array], values: Array
) -> None:
    """A function of the laws sample by sample: columns have the bits, arrays the numbers (M, 6) to rounding."""
    lib, _, columns = law_functions(structure(stand))
    interpreter = Interpreter(Program("laws", DOUBLE, (), (), lib.functions), ROUTINES)

    def run(program: Interpreter, numbers: dict[str, Any]) -> list[Any]:
        named = inputs | numbers | {"x": SimpleNamespace(**numbers), out: [0.0] * 6}
        program.call(name, *(named[argument] for argument in lib.taken(name)))
        return list(named[out])

    expected = np.array([run(interpreter, {k: x[m].tolist() for k, x in samples.items()}) for m in range(len(values))])
    rows = run(columns, {k: [*x.T] for k, x in samples.items()})
    columns.begin()
    assert np.array_equal(np.array(np.broadcast_arrays(*rows, values[:, 0])[:6]).T, expected)
    assert_allclose(values, expected, rtol=0, atol=1e-12 * np.abs(expected).max(initial=1e-300))


def draw_samples(seed: int) -> dict[str, Array]:
    """Poses and twists of some samples; twists at rest and along one axis are among them."""
    rng = np.random.default_rng(seed)
    C, V = attitude("ship", rng.normal(size=(5, 3)) * 0.4), rng.normal(size=(5, 6))
    V[0], V[1, 1:] = 0.0, 0.0
    return {"position": rng.normal(size=(5, 3)) * 0.3, "attitude": quaternions(C), "V": V, "C": C.reshape(-1, 9)}


def agrees(stand: Stand, seed: int) -> None:
    """All laws of a stand."""
    laws, at = LawArrays(stand), draw_samples(seed)
    for body in laws.bodies:
        if body is not None:
            named = {"table": laws.table, "damper": body.damper}
            compare(stand, "damped", "P", named, {"V": at["V"]}, body.wrench(at["V"]))
    if laws.ties:
        pose = at["position"], at["C"].reshape(-1, 3, 3), at["V"]
        compare(stand, "tied", "F", {"table": laws.table}, at, laws.tied(*pose))
        slopes_are_those_of_differences(laws, at)


def slopes_are_those_of_differences(laws: LawArrays, at: dict[str, Array]) -> None:
    """Slopes by a small pose and by the twist are differences, except where a stop begins within a step."""
    O1, C, V = at["position"], at["C"].reshape(-1, 3, 3), at["V"]
    step, slopes = 1e-6, laws.tied_slopes(O1, C, V)
    for k, e in enumerate(np.eye(12) * step):
        turned = [C @ attitude("ship", sign * e[[5, 4, 3]]) for sign in (1.0, -1.0)]
        ends = [
            laws.tied(O1 + sign * C @ e[:3], turn, V + sign * e[6:])
            for sign, turn in zip((1.0, -1.0), turned, strict=True)
        ]
        middle = laws.tied(O1, C, V)
        bent = np.abs(ends[0] + ends[1] - 2.0 * middle).max(axis=1) > 1e-6 * np.abs(ends[0] - ends[1]).max(initial=1e-9)
        expected = (ends[0] - ends[1]) / (2.0 * step)
        size = np.abs(slopes).max() + np.abs(middle).max() + 1e-9
        assert_allclose(slopes[~bent, :, k], expected[~bent], rtol=0, atol=2e-6 * size)


@given(st.one_of(stands(max_flywheels=3), held_stands(max_flywheels=2)), st.integers(0, 1000))
def test_laws_are_those_of_the_interpreter(stand: Stand, seed: int) -> None:
    agrees(stand, seed)


@pytest.mark.parametrize("law", TEXTS)
def test_laws_of_a_vessel_are_those_of_the_interpreter(law: str) -> None:
    agrees(bearing(law, 3), 1)
