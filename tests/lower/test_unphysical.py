"""prepare takes the parameters of every stand that the reader takes, in double and in float, and of no other."""

from __future__ import annotations

import copy
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from mahovik.contract.status import STATUS_VALUES
from mahovik.core.lower import prepare as lowered
from mahovik.core.lower.checks import add_checks
from mahovik.core.lower.layout import Layout
from mahovik.core.lower.library import Library
from mahovik.core.lower.limits import THRESHOLDS
from mahovik.core.program.function import Program
from mahovik.core.program.interpret import Interpreter
from mahovik.core.program.types import DOUBLE, FLOAT, Precision
from mahovik.core.stand import structure
from mahovik.core.stand.random import BARE, random_stand
from mahovik.proof.verify.c_backend import CBackend

Array = NDArray[np.float64]
PRECISIONS = pytest.mark.parametrize("precision", (DOUBLE, FLOAT), ids=lambda p: p.name)
OK, REFUSED = STATUS_VALUES["OK"], STATUS_VALUES["NOT_POSITIVE_DEFINITE"]
SEEDS = st.integers(0, 2**32 - 1)
ORDER = ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))


@cache
def checks(precision: Precision) -> Interpreter:
    """check_inertia and check_added_mass alone."""
    lib = Library(Layout(structure(random_stand(np.random.default_rng(1), 0, replace(BARE, fluid=True))), precision))
    add_checks(lib)
    lowered.add_check_inertia(lib)
    lowered.add_added_mass(lib)
    return Interpreter(Program("checks", precision, (), (), lib.functions))


def inertia_status(precision: Precision, mass: float, center: Array, J: Array) -> int:
    arguments = {"mass": mass, "c": center.tolist(), "J": [float(J[i, j]) for i, j in ORDER]}
    return int(checks(precision).run("check_inertia", arguments)[0])


def added_status(precision: Precision, added: Array) -> int:
    return int(checks(precision).run("check_added_mass", {"added_mass": added.tolist()})[0])


def rotation(rng: np.random.Generator) -> Array:
    Q, _ = np.linalg.qr(rng.normal(size=(3, 3)))
    return np.asarray(Q)


def about_origin(principal: Array, Q: Array, mass: float, center: Array) -> Array:
    """Inertia about the origin, of principal moments about the centre of mass."""
    return np.asarray(Q @ np.diag(principal) @ Q.T + mass * (center @ center * np.eye(3) - np.outer(center, center)))


def random_body(seed: int, moments: Array) -> tuple[Array, float, Array, Array]:
    """A body of second moments about its centre of mass in random axes: principal moments, mass, centre, J."""
    rng = np.random.default_rng(seed)
    mass, size = float(10 ** rng.uniform(-4, 4)), float(10 ** rng.uniform(-4, 2))
    center = rng.normal(size=3) * size * float(rng.choice([0.0, 0.1, 1.0]))
    principal = (moments.sum() - moments) * mass * size**2
    return principal, mass, center, about_origin(principal, rotation(rng), mass, center)


@PRECISIONS
@settings(max_examples=150, deadline=None)
@given(
    seed=SEEDS,
    moments=st.tuples(*[st.sampled_from([0.0, 1e-12, 1e-3, 0.5, 1.0]) | st.floats(0, 1)] * 3).filter(any),
)
def test_every_body_that_can_be_is_taken(precision: Precision, seed: int, moments: tuple[float, ...]) -> None:
    """Rods, discs and clouds are accepted: second moments that are zero to rounding are on the border."""
    _, mass, center, J = random_body(seed, np.array(moments))
    assert inertia_status(precision, mass, center, J) == OK


@PRECISIONS
@settings(max_examples=150, deadline=None)
@given(seed=SEEDS, moments=st.tuples(st.floats(0, 1), st.floats(0.1, 1)), excess=st.floats(8, 1e5))
def test_a_triangle_that_does_not_close_is_refused(
    precision: Precision, seed: int, moments: tuple[float, float], excess: float
) -> None:
    """One second moment is negative by more than the tolerance of the largest element of J."""
    _, mass, center, J = random_body(seed, np.array([*moments, 0.0]))
    rng = np.random.default_rng(seed + 1)
    n = rng.normal(size=3)
    n /= np.linalg.norm(n)
    P = np.trace(J) / 2 * np.eye(3) - J - mass * np.outer(center, center)
    lack = n @ P @ n + excess * THRESHOLDS[precision.name].unphysical * np.abs(J).max()
    P = P - lack * np.outer(n, n)
    P_origin = P + mass * np.outer(center, center)
    broken = np.trace(P_origin) * np.eye(3) - P_origin
    assert inertia_status(precision, mass, center, broken) == REFUSED


@PRECISIONS
@pytest.mark.parametrize(
    ("J", "good"),
    [
        ([1.0, 1.0, 2.0], True),  # a flat disc
        ([1.0, 1.0, 0.0], True),  # a rod
        ([0.0, 0.0, 0.0], True),  # a point
        ([1.0, 1.0, 2.001], False),
        ([1.0, 2.001, 1.0], False),
        ([2.001, 1.0, 1.0], False),
        ([1.0, -0.001, 1.0], False),
        ([1.0, 0.0, 0.0], False),
        ([-1.0, -1.0, -1.0], False),
    ],
)
def test_bodies_by_hand(precision: Precision, J: list[float], good: bool) -> None:
    for size in (1.0, 1e-12, 1e12):
        assert inertia_status(precision, 1.0, np.zeros(3), np.diag(J) * size) == (OK if good else REFUSED)


def definite(rng: np.random.Generator, rank: int) -> Array:
    """A positive semidefinite 6x6 of this rank, its rows of very different size."""
    factor = rng.normal(size=(6, rank)) * 10 ** rng.uniform(-3, 3, 6)[:, None]
    added = factor @ factor.T
    return np.asarray((added + added.T) / 2)


@PRECISIONS
@settings(max_examples=100, deadline=None)
@given(seed=SEEDS, rank=st.integers(0, 6), dry=st.sets(st.integers(0, 5)))
def test_every_semidefinite_added_mass_is_taken(precision: Precision, seed: int, rank: int, dry: set[int]) -> None:
    added = definite(np.random.default_rng(seed), rank)
    for i in dry:
        added[i, :] = added[:, i] = 0.0
    rounded = added.astype(precision.scalar)
    assert added_status(precision, rounded.astype(float)) == OK


@PRECISIONS
@settings(max_examples=100, deadline=None)
@given(seed=SEEDS, rank=st.integers(1, 5), excess=st.floats(20, 1e4))
def test_an_added_mass_with_a_negative_direction_is_refused(
    precision: Precision, seed: int, rank: int, excess: float
) -> None:
    """A matrix with unit diagonal and a zero eigenvalue is made negative along its direction."""
    rng = np.random.default_rng(seed)
    added = definite(rng, rank)
    root = np.sqrt(np.diag(added))
    unit = added / root[:, None] / root[None, :]
    n = np.linalg.eigh(unit)[1][:, 0]
    unit = unit - excess * THRESHOLDS[precision.name].unphysical * np.outer(n, n)
    broken = unit * root[:, None] * root[None, :]
    broken = np.triu(broken) + np.triu(broken, 1).T
    assert added_status(precision, broken) == REFUSED


@pytest.mark.parametrize(("real", "tiny"), [("double", 1e-310), ("float", 1e-40)])
def test_what_has_no_inverse_is_refused(real: str, tiny: float) -> None:
    """A spin inertia or a total mass so small that its inverse is no number counts as none."""
    c = CBackend(random_stand(np.random.default_rng(5), 2, BARE, name="tiny"), real)
    parameters = copy.deepcopy(c.generated.values.parameters)
    parameters["flywheel"][0]["body"]["inertia"] = [tiny, tiny, tiny, 0.0, 0.0, 0.0]
    parameters["flywheel"][0]["body"]["center_of_mass"] = [0.0, 0.0, 0.0]
    inputs = {"parameters": parameters, "table": c.generated.values.table}
    assert c.call("prepare", inputs)[0] == STATUS_VALUES["NOT_POSITIVE_DEFINITE"]
    parameters = copy.deepcopy(c.generated.values.parameters)
    for body in (parameters["carrier"], *(w["body"] for w in parameters["flywheel"])):
        body["mass"] = tiny
    assert c.call("prepare", inputs | {"parameters": parameters})[0] == STATUS_VALUES["NOT_POSITIVE_DEFINITE"]
