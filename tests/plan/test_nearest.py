"""Bounds far below what a motion needs: the nearest programme names the bound, what is needed and what is allowed."""

from __future__ import annotations

import pytest

from mahovik.core.motion.required import Bounds
from mahovik.use.plan.optimise import evaluate
from mahovik.use.plan.planner import not_found_message
from mahovik.use.plan.search import Candidate, Improver, Search, choose
from plan.improvable import N, plain, setting


def pushed() -> tuple[Improver, Search[Candidate]]:
    """A search of which the bound has left one attempt that is no programme."""
    own = setting(Bounds(torque=(0.03,) * N))
    free = plain("rock")
    attempt = own.candidate(evaluate(own.problem, own.cost, free.with_harmonics(2), 0), "rock", free)
    assert not attempt.exact
    return own, Search(beyond=[attempt])


def test_a_programme_brought_nearer_to_the_bound_is_given_where_none_keeps_it(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    own, found = pushed()
    monkeypatch.setattr(Improver, "rescue", lambda *_: None)
    (nearest,) = choose(own, found, seconds=None)  # without the clock: the outcome is the same on a busy machine
    assert nearest.exact and not nearest.is_programme
    attempt = found.beyond[0]
    assert attempt.free is not None
    disregards = own.exact(attempt, attempt.free, None)
    assert nearest.utilisation < 0.9 * disregards.utilisation, "it is no nearer than one that disregards the bound"
    worst = nearest.exceeded_bounds[0]
    assert (worst.kind, worst.limit) == ("torque", 0.03)
    assert worst.value > 0.1
    assert f"torque of {worst.of}: {worst.value:.6g} N m" in worst.words and "bound is 0.03" in worst.words


def test_a_search_without_a_programme_names_the_bound_that_its_nearest_attempt_exceeds() -> None:
    _, found = pushed()
    words = not_found_message(found)
    assert "the nearest attempt exceeds a bound, torque of w" in words
    assert "bound is 0.03" in words and "try wider bounds" in words
    assert "bound" not in not_found_message(Search())
