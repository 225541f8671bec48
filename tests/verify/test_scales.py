"""Measured scales: a relative error of 1e-9 in a term of the equations is seen where the term is not negligible."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from mahovik.contract.limits import DOUBLE
from mahovik.core.stand import Stand, load
from mahovik.core.stand.random import EVERYTHING, random_stand
from mahovik.errors import StateError
from mahovik.proof import reference
from mahovik.proof.reference.pieces import Pieces
from mahovik.proof.verify.check import difference
from mahovik.proof.verify.draw import draw
from mahovik.proof.verify.scales import Scales, share
from mahovik.stands import path

PLANTED = 1e-9
NOT_NEGLIGIBLE = 0.01
"""Part of the scale of a quantity from which on a term must be seen."""

WANTS = ("matrices", "momentum", "forward", "torque", "mounts", "coupled")
PARTS = ("K", "K_dot", "M", "I", "J", "F", "Theta_ff")


def with_errors(stand: Stand, at: Pieces) -> Iterator[tuple[str, Pieces]]:
    """Every term with a relative error: the matrices, and each kind of wrench on each body."""
    for name in PARTS:
        if np.any(getattr(at, name)):
            wrong = replace(at)
            vars(wrong)[name] = getattr(at, name) * (1.0 + PLANTED)  # a field, or a property that is kept
            yield name, wrong
    bodies: tuple[Any, ...] = (*at.fixed, *at.flywheels)
    placed = {k.body.name: k for k in bodies}
    for body, kinds in at.terms.items():
        for kind, wrench in kinds.items():
            if np.any(wrench):
                error = PLANTED * np.asarray(wrench)
                P = {**at.P, body: at.P[body] + error}
                yield f"{kind} on {body}", replace(at, P=P, F=at.F + placed[body].L @ error)


def answers(stand: Stand, state: Any, at: Pieces) -> dict[tuple[str, str], Any]:
    result: dict[tuple[str, str], Any] = {}
    for want in WANTS:
        try:
            values = reference.evaluate(stand, state, (want,), at)
        except (StateError, np.linalg.LinAlgError):
            continue
        result |= {(want, name): value for name, value in values.items()}
    return result


def parts_of_scales(stand: Stand, states: int) -> dict[str, float]:
    """The largest part of the scale of any quantity that each term reaches at the drawn states."""
    scales, reached = Scales(stand), dict[str, float]()
    for _, state in draw(stand, 1, states):
        neighbour, held, at = scales.neighbours(state)[0]
        right = answers(neighbour, held, at)
        for term, wrong in with_errors(neighbour, at):
            for key, value in answers(neighbour, held, wrong).items():
                measured = scales.want(state, key[0])
                if measured is not None and key in right:
                    off, _ = difference(value, right[key], measured.scales[key[1]])
                    reached[term] = max(reached.get(term, 0.0), off / PLANTED)
    return reached


SMALL: dict[str, set[str]] = {
    "demo3": set(),
    "bench8": set(),
    "auv6": set(),
    "everything": {f"damping terms on {body}" for body in ("carrier", "i1", "w3")},
}
"""Terms that never are a hundredth of the scale of a quantity."""


@pytest.mark.slow
@pytest.mark.parametrize("name", SMALL)
def test_an_error_of_1e_9_in_a_term_is_seen(name: str) -> None:
    stand = random_stand(np.random.default_rng(7), 3, EVERYTHING) if name == "everything" else load(path(name))
    reached = parts_of_scales(stand, 60)
    assert len(reached) >= 5
    assert {term for term, part in reached.items() if part < NOT_NEGLIGIBLE} == SMALL[name]
    assert all(part * PLANTED > DOUBLE.value for part in reached.values() if part >= NOT_NEGLIGIBLE)


def test_a_scale_is_the_change_of_the_answer() -> None:
    """The answer is x a + b of numbers near 1, each of which moves it by as much as it is."""
    stand = load(path("demo3"))
    scales = Scales(stand)
    _, state = draw(stand, 1, 3)[1]
    m = stand.carrier.mass
    measured = scales.measure(state, lambda neighbour, _, __: {"x": np.array([neighbour.carrier.mass - 0.5 * m, 0.0])})
    x, zero = np.asarray(measured.scales["x"])
    assert 0.5 * m <= x <= m  # at least the value, at most the largest change
    assert zero == x / 256  # what is zero is so by symmetry
    assert not measured.undecided


def test_a_word_that_changes_is_undecided() -> None:
    stand = load(path("demo3"))
    m = stand.carrier.mass
    _, state = draw(stand, 1, 3)[1]
    measured = Scales(stand).measure(state, lambda near, _, __: {"heavier": near.carrier.mass > m, "x": np.ones(1)})
    assert measured.undecided


def test_components_that_a_rotation_mixes_share_the_largest() -> None:
    assert share(np.array([1.0, 2.0, 3.0, 4.0, 5.0, 6.0]), None).tolist() == [3.0] * 3 + [6.0] * 3
    assert share(np.array([1.0, 2.0, 3.0]), 0).tolist() == [1.0, 2.0, 3.0]  # flywheels
