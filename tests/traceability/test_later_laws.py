"""Mutants of functions that no example stand has: those of laws of the fluid, and the exponential of one of them."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest

from mahovik.core.emit.generate import Generated, generate_all
from mahovik.core.lower.values import Values
from mahovik.core.stand import Stand
from mahovik.core.stand.model import StreamProfile
from mahovik.core.stand.random import Features, random_stand
from mahovik.proof.verify.c_backend import InterpreterBackend
from mahovik.proof.verify.draw import draw
from mahovik.proof.verify.harness import judge
from traceability.equations import subjects
from traceability.mutants import chosen, mutant, planted, sites

LATER = ("exp", "add_fading", "add_control", "stream_at")

OF_LATER_LAWS = ("exp", "stream_at", "check_depth")
"""Functions of these laws that ROLES names; `check_depth` has tests of its own."""

UNSEEN = {"exp": (3, "term dropped"), "add_control": (4, "choice exchanged", "minus dropped")}
"""Most mutants that the comparison does not see, and of which kinds: of `exp` terms beyond the tolerance, which have
their tests in tests/routines; of control derivatives magnitudes that no derivative of this stand takes."""


@cache
def stand() -> Stand:
    """A random one with every law of the fluid, in a stream by depth."""
    features = Features(instruments=0, flow=True, stream=True, gravity=True)
    profile = StreamProfile((0.0, 0.1, 1.0), (-2.5, 0.4, 3.0), ((0.5, 0.1, -0.3), (0.2, 0.3, 0), (-0.1, 0, 0.2)))
    return replace(random_stand(np.random.default_rng(2), 1, features), profile=profile)


@cache
def made() -> Any:
    return generate_all(stand())


def test_their_functions_have_an_equation_or_a_purpose() -> None:
    known = {f.name: f for f in made().program.functions}
    assert set(LATER) <= set(known)
    assert all(subjects(known[name]) for name in LATER)


def agrees(functions: Any) -> bool:
    """Whether a program of these functions agrees with the literal reference at some states, or runs at all."""
    program = replace(made().program, functions=functions)
    try:
        values = Values(stand(), made().layout, program)
        backend = InterpreterBackend(Generated(made().layout, program, values, {}))
        return not any(row.failed for row in judge(stand(), backend, draw(stand(), 5, 12, wrenches=False), ["forward"]))
    except Exception:  # a mutant may do anything: that it cannot run is a way to be noticed
        return False


def test_without_a_mutant_all_agree() -> None:
    assert agrees(made().program.functions)


@pytest.mark.parametrize("name", LATER)
def test_mutants_are_noticed(name: str) -> None:
    """The comparison with the literal reference finds them."""
    functions = made().program.functions
    numbers = chosen(sites(made().program.function(name)), 8)
    assert len(numbers) >= 5
    unseen = [number for number in numbers if agrees(planted(name, number)(functions))]
    kinds = [(number, mutant(made().program.function(name), number)[1]) for number in unseen]
    most, *allowed = UNSEEN.get(name, (0,))
    assert len(unseen) <= int(most), kinds
    assert {kind for _, kind in kinds} <= set(allowed)
