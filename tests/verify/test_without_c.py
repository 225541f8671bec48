"""Program, literal reference and second derivation answer alike, and nothing is compiled: the quickest judge of all."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import partial

import numpy as np
import pytest

from mahovik.core.stand import Stand, load
from mahovik.core.stand.hold import FREEDOMS
from mahovik.core.stand.model import Hold, StreamProfile, rest_state
from mahovik.core.stand.random import BARE, Features, random_stand
from mahovik.proof import reference
from mahovik.proof.second import Second
from mahovik.proof.verify.c_backend import InterpreterBackend
from mahovik.proof.verify.draw import draw
from mahovik.proof.verify.harness import judge
from mahovik.stands import names, path
from toolchain.quick import quick
from verify.build import everything, generated
from verify.holds import DRY, WET, random_held_stand

FLOWING = Features(instruments=1, flow=True, stream=True, points=1, gravity=True)
BY_DEPTH = StreamProfile((0.0, 0.1, 1.0), (-2.5, 0.4, 3.0), ((0.5, 0.1, -0.3), (0.2, 0.3, 0.0), (-0.1, 0.0, 0.2)))


def flowing() -> Stand:
    """A stand with every law of a fluid, in a stream that changes with depth."""
    return replace(random_stand(np.random.default_rng(3), 2, FLOWING), profile=BY_DEPTH)


def drawn_stand(N: int, features: Features) -> Stand:
    """A stand drawn by its number of flywheels."""
    return random_stand(np.random.default_rng(N), N, features)


STANDS: dict[str, Callable[[], Stand]] = {
    "everything": everything,
    "held": lambda: random_held_stand("hinge", 3, WET, 2),
    "flowing": flowing,
    "clamped": lambda: random_held_stand("clamped", 3, DRY, 1),
    "knife edge": lambda: random_held_stand("knife edge", 3, DRY, 0),
}
SLOW: dict[str, Callable[[], Stand]] = {
    **{name: partial(random_held_stand, name, 3, DRY) for name in ("ball joint", "all but one", "free")},
    **{f"bare, {N}": partial(drawn_stand, N, BARE) for N in (0, 1, 7)},
    **{f"drawn, {N}": partial(drawn_stand, N, Features()) for N in range(6)},
    **{angles: partial(everything, angles) for angles in ("aircraft", "euler")},
    **{name: partial(load, path(name)) for name in names()},
}


@pytest.mark.parametrize("name", quick(len(STANDS), STANDS | SLOW))
def test_program_reference_and_second_derivation_agree(name: str) -> None:
    stand = (STANDS | SLOW)[name]()
    backend = InterpreterBackend(generated(stand))
    rows = judge(stand, backend, draw(stand, 5, 10), backend.wants, second=Second(stand))
    assert {row.quantity: row.words for row in rows if row.failed} == {}
    seen = {row.quantity for row in rows if row.second is not None}
    expected = {"V_dot", "energy"} | ({"tau"} if stand.flywheels else set())
    assert expected | ({"points"} if stand.points or stand.instruments else set()) <= seen


def test_couplings_whose_squares_underflow_are_solved() -> None:
    """Phases of 1e-158 leave couplings of that size in the mass matrix of a carrier in the plane."""
    plane = tuple(FREEDOMS[name] for name in ("x", "y", "yaw"))
    stand = replace(load(path("bench8")), hold=Hold(plane, (0.05, -0.03, 0.02), (0.0,) * 3, (0.0,) * 3))
    state = replace(rest_state(stand), phi=tuple(1e-158 * k for k in range(8)), tau=tuple(0.1 * k for k in range(8)))
    expected = reference.evaluate(stand, state, ["coupled"])["phi_ddot"]
    assert Second(stand).evaluate(state, ("coupled",))["phi_ddot"] == pytest.approx(expected, rel=1e-10)
