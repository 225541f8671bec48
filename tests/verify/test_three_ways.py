"""Three evaluate a state: the one that differs from the other two is named, whichever it is, or none."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
import pytest

from mahovik.core.stand import State, load
from mahovik.errors import StateError
from mahovik.proof import reference
from mahovik.proof.second import Second
from mahovik.proof.verify.backends import NumpyBackend
from mahovik.proof.verify.check import Check, report
from mahovik.proof.verify.draw import draw
from mahovik.proof.verify.harness import judge
from mahovik.stands import path

DEMO = load(path("demo3"))


def wrong_by(values: dict[str, Any], by: float) -> dict[str, Any]:
    """V_dot wrong by a part."""
    return values | ({"V_dot": np.asarray(values["V_dot"]) * (1 + by)} if "V_dot" in values else {})


class Judged(NumpyBackend):
    """The reference as what is judged, wrong by a part of V_dot, or refusing."""

    def __init__(self, by: float = 0.0) -> None:
        super().__init__(DEMO)
        self._real, self._by = reference.evaluate, by

    def evaluate(self, state: State, want: Sequence[str]) -> dict[str, Any]:
        if math.isnan(self._by):
            raise StateError("too fast")
        return wrong_by(self._real(DEMO, state, want), self._by)


class Other(Second):
    """The second derivation, likewise."""

    def __init__(self, by: float = 0.0, refuses_after: int = 0) -> None:
        super().__init__(DEMO)
        self._by, self._answers = by, refuses_after

    def evaluate(self, state: State, want: Sequence[str]) -> dict[str, Any]:
        self._answers -= 1
        if math.isnan(self._by):
            if self._answers < 0:
                raise StateError("no such sum")
            return super().evaluate(state, want)
        return wrong_by(super().evaluate(state, want), self._by)


def rows(judged: float = 0.0, second: float = 0.0, refuses_after: int = 0) -> dict[str, Check]:
    other = Other(second, refuses_after)
    report = judge(DEMO, Judged(judged), draw(DEMO, 1, 9), ("forward", "momentum", "mounts"), second=other)
    return {row.quantity: row for row in report}


REFUSES = math.nan
ALONE = {
    "nobody": ({}, "ok", "", ""),
    "judged": ({"judged": 1e-6}, "FAILED", "reference and second agree, C differs", ""),
    "second": ({"second": 1e-6}, "FAILED", "C and reference agree, second differs", ""),
    "all": ({"judged": 1e-6, "second": -1e-6}, "FAILED", "no two agree", ""),
    "judged refuses": ({"judged": REFUSES}, "FAILED", "reference and second agree, C differs", "refused: too fast"),
    "second refuses some": (
        {"second": REFUSES, "refuses_after": 3}, "FAILED", "C and reference agree, second differs",
        "second derivation refused: no such sum",
    ),
    "both refuse": (
        {"judged": REFUSES, "second": REFUSES}, "FAILED", "C and second agree, reference differs", "no such sum"
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", ALONE)
def test_the_one_that_differs_is_named(name: str) -> None:
    case, verdict, disagreement, reason = ALONE[name]
    table = rows(**case)  # type: ignore[arg-type]
    row = table["V_dot"]
    assert row.verdict == verdict
    assert row.words.startswith(disagreement) and reason in row.words
    if not any(map(math.isnan, case.values())):
        assert not table["energy"].failed
    assert table["mount_wrench"].second is None  # the second derivation has no such want


def test_reference_alone(monkeypatch: pytest.MonkeyPatch) -> None:
    backend, right = Judged(), reference.evaluate
    monkeypatch.setattr(reference, "evaluate", lambda *arguments: wrong_by(right(*arguments), 1e-6))
    (row,) = judge(DEMO, backend, draw(DEMO, 1, 9), ("forward",), second=Second(DEMO))
    assert row.failed
    assert row.words == "C and second agree, reference differs"


def test_a_stand_that_the_second_derivation_refuses_is_compared_without_it() -> None:
    judged = judge(DEMO, Judged(), draw(DEMO, 1, 9), ("forward", "mounts"), second=Other(math.nan))
    (skipped,) = (row for row in judged if row.verdict == "not compared")
    assert (skipped.judged, skipped.quantity) == ("forward", "second derivation")
    assert skipped.words == "second derivation refused: no such sum; so at every state"
    compared = next(row for row in judged if row.quantity == "V_dot")
    assert (compared.verdict, compared.states, compared.second) == ("ok", 9, None)
    assert report(DEMO, "generated C", 1, 9, 1e-12, judged).passed
    wrong = judge(DEMO, Judged(1e-6), draw(DEMO, 1, 9), ("forward",), second=Other(math.nan))
    assert [row.quantity for row in wrong if row.failed] == ["V_dot"]
