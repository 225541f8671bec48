"""The linear model equals automatic differentiation of the second derivation; files read back; refusals."""

from __future__ import annotations

import io
import json
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from scipy.io import loadmat

from mahovik.core.stand import load
from mahovik.core.stand.model import Stand
from mahovik.core.stand.random import Features, random_stand, random_state
from mahovik.core.stand.state import State, rest_state
from mahovik.errors import StateError, UsageError
from mahovik.proof.second.linear import Matrices, linear
from mahovik.stands import path
from mahovik.use.study.linear import LinearModel, linear_model
from mahovik.use.study.linear.model import model_file
from mahovik.use.study.rest import rest

AGREEMENT = 1e-10
"""Relative to the largest number of a row; the largest of a hundred stands is 6e-12, where rows nearly cancel."""


def disagreement(found: LinearModel, expected: Matrices) -> float:
    """Largest difference of A, B, C and D, each row relative to its largest number."""
    worst = 0.0
    for name in "ABCD":
        a, b = getattr(found, name), getattr(expected, name)
        assert a.shape == b.shape
        if b.size:
            size = np.abs(b).max(axis=1, keepdims=True)
            worst = max(worst, float((np.abs(a - b) / np.where(size > 0, size, 1.0)).max()))
    return worst


def random_case(seed: int, flywheels: int, **kinds: Any) -> tuple[Stand, State]:
    """A random stand with all that is named, and a state of it."""
    rng = np.random.default_rng(seed)
    stand = random_stand(rng, flywheels, Features(**kinds))
    return stand, random_state(stand, rng)


@pytest.mark.parametrize(
    ("seed", "kinds"),
    [
        (1, {"laws": {"suspension": 1}, "gravity": True, "points": 2, "wrench_inputs": True}),
        (2, {"fluid": True, "stream": True, "instruments": 2, "laws": {"leg": 0}}),
        (
            4,
            {
                "laws": {"suspension": 1, "leg": 2},
                "fluid": True,
                "stream": True,
                "gravity": True,
                "wrench_inputs": True,
            },
        ),
    ],
)
def test_it_is_the_derivative_of_the_second_derivation(seed: int, kinds: dict[str, Any]) -> None:
    stand, state = random_case(seed, 3, **kinds)
    assert disagreement(linear_model(stand, state), linear(stand, state)) < AGREEMENT


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(60))
def test_it_is_the_derivative_on_any_stand(seed: int) -> None:
    stand, state = random_case(1000 + seed, seed % 7)
    assert disagreement(linear_model(stand, state), linear(stand, state)) < AGREEMENT


@pytest.mark.parametrize("name", ["shaker2", "sat4", "auv6"])
def test_at_rest_and_with_flywheels_turning_steadily(name: str) -> None:
    stand = load(path(name))
    state = replace(rest(stand).state, phi_dot=(100.0,) * len(stand.flywheels))
    assert disagreement(linear_model(stand, state), linear(stand, state)) < AGREEMENT


def test_locked_flywheels_are_one_with_the_carrier() -> None:
    """The second derivation answers as the drives do: tau keeps phi'' whatever the carrier does."""
    stand, state = random_case(5, 2, laws={"suspension": 1}, points=1)
    free, locked = linear_model(stand, state), linear_model(stand, state, locked=True)
    N = len(stand.flywheels)
    keep = np.linalg.solve(free.B[12 + N :, :N], free.A[12 + N :, :12])  # phi'' = 0 = A x + B tau
    assert np.allclose(locked.A, free.A[:12, :12] - free.B[:12, :N] @ keep, rtol=0, atol=1e-9 * np.abs(free.A).max())
    assert locked.A.shape == (12, 12)
    assert [str(x) for x in locked.inputs] == [f"wrench {x} [{'N' if x in 'XYZ' else 'N m'}]" for x in "XYZKMN"]


def test_points_are_those_named_in_that_order() -> None:
    stand = load(path("sat4"))
    assert linear_model(stand, rest_state(stand)).points == ("acc1",)
    assert linear_model(stand, rest_state(stand), ["carrier", "acc1"]).points == ("carrier", "acc1")
    assert linear_model(stand, rest_state(stand), []).C.shape == (0, 20)
    with pytest.raises(UsageError, match='unknown point "acc2", did you mean "acc1"'):
        linear_model(stand, rest_state(stand), ["acc2"])
    with pytest.raises(UsageError, match="given twice"):
        linear_model(stand, rest_state(stand), ["acc1", "acc1"])


def test_what_is_not_finite_is_refused() -> None:
    stand = load(path("sat4"))
    with pytest.raises(StateError, match="not finite"):
        linear_model(stand, replace(rest_state(stand), V=(1e200, 0, 0, 0, 0, 1e200)))


@pytest.mark.parametrize("locked", [False, True])
def test_both_formats_read_back_to_the_same_bits(locked: bool) -> None:
    stand, state = random_case(7, 2, points=2, wrench_inputs=True)
    model = linear_model(stand, state, locked=locked)
    text = json.loads(model_file(model, ".json"))
    mat = loadmat(io.BytesIO(model_file(model, ".mat")), simplify_cells=True)
    for name in "ABCD":
        matrix = getattr(model, name)
        assert np.array_equal(np.array(text[name]).reshape(matrix.shape), matrix)
        assert np.array_equal(mat[name].reshape(matrix.shape), matrix)
    for name in ("states", "inputs", "outputs"):
        given = [each.name for each in getattr(model, name)]
        assert text[name] == given
        assert list(mat[name]) == given
        units = [each.unit for each in getattr(model, name)]
        assert text[f"{name[:-1]}_units"] == units
        assert list(mat[f"{name[:-1]}_units"]) == units
    assert text["flywheels"] == mat["flywheels"] == ("locked" if locked else "free")
    assert np.array_equal(mat["state"]["tau"], model.state.tau)
    assert model_file(model, ".mat") == model_file(model, ".mat")
    assert b"20" not in model_file(model, ".mat")[:116]  # no date
