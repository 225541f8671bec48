"""tools/math_campaign.py and tools/math_proof.py: small campaign, proofs that can fail."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import math_campaign as page
import math_judge as campaign
import math_proof as proof
import numpy as np
import pytest
from flint import arb

from docs.pages import ROOT, rows
from mahovik.core.program.types import DOUBLE, FLOAT, Precision
from mahovik.core.routines import arc_tangent
from mahovik.core.routines.exponential import POLYNOMIALS as EXPONENTIAL
from mahovik.core.routines.sincos import POLYNOMIALS as SINCOS
from toolchain.tools import require

PRECISIONS = pytest.mark.parametrize("precision", (DOUBLE, FLOAT), ids=lambda p: p.name)


@pytest.fixture(autouse=True)
def compiler() -> None:
    require("gcc", "gcc")


def test_a_small_campaign_keeps_every_bound() -> None:
    found = list(campaign.rows(4000))
    assert {(r.routine, r.precision) for r in found} == {
        (name, p) for name in ("sin", "cos", "sqrt", "atan2", "exp", "wrap") for p in ("double", "float")
    }
    assert [row for row in found if not row.good] == []
    # an ulp that was measured ten times too small or too large would be seen
    assert all(row.worst > 0.3 for row in found if row.unit == "ulp")


def test_every_float_from_a_half_to_eight_pi() -> None:
    """Every binade in which a multiple of pi/2 is subtracted; make math-campaign takes the smaller ones as well."""
    found = [*campaign.every_float(0.5, campaign.LAST_NEAR), campaign.every_root(1.0, 4.0)]
    assert [row.unit for row in found] == ["ulp", "", "wrong"]
    assert [row for row in found if not row.good] == []
    assert found[0].count > 46_000_000


@PRECISIONS
def test_the_judge_sees_an_error(precision: Precision) -> None:
    """Results one unit off are judged one unit off, give or take the half that rounding takes."""
    x = campaign.angles(precision, campaign.NEAR, 300, 1)
    x = x[x != 0]
    sine, _ = campaign.run(precision, "sincos", x, results=2)
    off = np.nextafter(sine, precision.scalar(9))
    worst, _ = campaign.largest_error(precision, [x], off, arb.sin)
    assert 1.0 < worst < 2.0


@pytest.mark.slow
def test_all_that_is_proven_holds() -> None:
    found = list(proof.rows())
    assert len(found) == 18
    assert [row for row in found if not row.good] == []


@PRECISIONS
def test_a_proven_bound_of_a_polynomial_is_above_what_is_found_and_near_it(precision: Precision) -> None:
    """tools/minimax.py found these by samples."""
    fits, arcs = SINCOS[precision.name], arc_tangent.POLYNOMIALS[precision.name]
    powers = EXPONENTIAL[precision.name]
    for what, found in (
        ("sine", fits.sine_error), ("cosine", fits.cosine_error), ("arc tangent", arcs.error),
        ("hyperbolic sine", powers.sine_error), ("hyperbolic cosine", powers.cosine_error),
    ):  # fmt: skip
        assert 0.98 * found < proof.approximation(what, precision) < 1.3 * found


@pytest.mark.parametrize("part", ["sine", "cosine"])
def test_a_coefficient_that_is_off_is_no_longer_proven(part: str, monkeypatch: pytest.MonkeyPatch) -> None:
    fits = SINCOS["double"]
    spoiled = list(getattr(fits, part))
    spoiled[2] *= 1 + 1e-9
    changed: dict[str, Any] = {part: tuple(spoiled)}
    monkeypatch.setitem(SINCOS, "double", replace(fits, **changed))
    for cached in (proof.approximation, proof.small_angle_error, proof.anywhere):
        cached.cache_clear()
    try:
        assert any(not row.good for row in proof.rows())
    finally:
        for cached in (proof.approximation, proof.small_angle_error, proof.anywhere):
            cached.cache_clear()


@PRECISIONS
def test_no_sample_is_closer_to_a_quarter_turn_than_the_least_that_is_proven(precision: Precision) -> None:
    least = proof.least_reduced(precision)
    x = campaign.closest_to_quarter_turns(precision, campaign.NEAR)
    distances = []
    for value in x[x > 0.7].tolist():
        turns = round(value / (np.pi / 2))
        distances.append(float(abs(arb(value) - arb.pi() / 2 * turns)))
    assert least <= min(distances) < 1.01 * least


def test_the_kept_figures_are_within_their_bounds() -> None:
    rows = [campaign.Row(**row) for row in page.MEASURED.figures()["rows"]]
    assert {(row.routine, row.precision) for row in rows} >= {
        (name, p) for name in ("sin", "sqrt", "atan2") for p in ("double", "float")
    }
    assert [row for row in rows if not row.good] == []


def test_the_page_promises_what_is_measured() -> None:
    """The table of docs/proofs.md, against the bounds of the kept figures."""
    promised = {row[0]: row[1] for row in rows(ROOT / "docs" / "proofs.md", "function") if len(row) == 2}
    bound = {(r["routine"], r["precision"], r["unit"]): r["bound"] for r in page.MEASURED.figures()["rows"]}
    assert promised["sine, cosine"].startswith(f"{bound['sin', 'double', 'ulp']:g} ulp for angles up to 8 pi; ")
    assert (
        f"{bound['cos', 'double', '']:g} (`float`: {bound['cos', 'float', '']:.0e}".replace("e-0", "e-")
        in (promised["sine, cosine"])
    )
    assert promised["`atan2`"].startswith(f"{bound['atan2', 'double', 'ulp']:g} ulp")
    assert f"{bound['wrap', 'double', 'rad']:g} rad" in promised["`wrap`"]


@pytest.mark.slow
def test_the_kept_proofs_are_those_of_today() -> None:
    kept = [proof.Row(**row) for row in page.PROVEN.figures()["rows"]]
    assert [row.cells() for row in kept] == [row.cells() for row in proof.rows()]
