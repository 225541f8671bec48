"""verify --real float: bounds met by right C and missed by wrong C, states of float, statuses on float's thresholds."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np

from cli.run import DEMO3, refused, run
from mahovik.core.lower.thresholds import THRESHOLDS
from mahovik.core.program.types import FLOAT as SINGLE
from mahovik.core.stand import load
from mahovik.proof.second import Second
from mahovik.proof.verify.bounds import FLOAT
from mahovik.proof.verify.compare import Judge, Row
from mahovik.proof.verify.draw import draw
from mahovik.proof.verify.report import Report, conclusion
from mahovik.stands import path
from verify.build import everything


def test_states_are_those_that_float_takes() -> None:
    for _, state in draw(everything(), 3, 40, "float"):
        numbers = [*state.position, *state.V, *state.phi, *state.phi_dot, *state.tau, *(state.angles or ())]
        assert all(float(np.float32(x)) == x for x in numbers)
        assert max(map(abs, (*state.phi, *(state.angles or ()))), default=0.0) <= SINGLE.max_phase


def test_rank_is_decided_by_the_thresholds_of_float() -> None:
    assert (FLOAT.cuts.rank, FLOAT.cuts.reached) == (THRESHOLDS["float"].rank, THRESHOLDS["float"].unreachable)
    stand = load(path("bench8"))
    judge = Judge(stand, FLOAT, Second(stand))
    drawn = [state for _, state in draw(stand, 1, 30, "float")]
    kept = [found for state in drawn if (found := judge.expected_answer(state, "inverse")) is not None]
    assert len(kept) >= len(drawn) / 4  # and not all of them hang on rounding


def test_what_is_nearest_to_its_bound_is_no_worst() -> None:
    """Each difference is said with its own quantity, pair and bound, also that of the references."""
    rows = (
        Row("forward", "V_dot", 1, 3e-7, verdict="ok", tolerance=1e-6, derivations=1e-12),
        Row("momentum", "Z0", 1, 2e-7, verdict="ok", tolerance=5e-7, derivations=1e-12, second=1e-13, between=2e-7),
    )
    found = Report("demo3", "", "", "C", 1, 1, 1e-6, rows)
    expected = "passed: nearest to its bound Z0, judged and reference: 2.0e-07 of the natural scale, 5e-07 accepted"
    assert conclusion(found) == expected
    near = replace(rows[1], second=9e-13)
    found = replace(found, rows=(rows[0], near))
    assert "Z0, second and reference: 9.0e-13 of the natural scale, 1e-12 accepted" in conclusion(found)
    same = [replace(row, tolerance=1e-6, derivations=1e-6) for row in rows]
    assert conclusion(replace(found, rows=tuple(same))) == "passed: worst 3.0e-07 of the natural scale, 1e-06 accepted"


def test_c_of_the_other_element_type_is_refused(tmp_path: Path) -> None:
    run("generate", DEMO3, "--real", "float", "-o", str(tmp_path))
    said = refused("verify", DEMO3, "--against", str(tmp_path), "--real", "double")
    assert said == f"error: {tmp_path / 'demo3.h'}: its C is float, expected double: give --real float\n"
