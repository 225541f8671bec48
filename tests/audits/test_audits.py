"""Audited models: what differs is what a calculation by hand says, and a planted mistake is named."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from audits import npsauv
from audits.audit import merged, without_added_products
from audits.measure import AUDITS, measure
from mahovik.core.stand.stand_file import dumps
from toolchain.quick import quick

TESTS = Path(__file__).parents[1]

FIRST = ("npsauv", "cubli", "gz_sim")
"""Models that every run of the tests judges: each differs in another way, or is held."""


@pytest.mark.parametrize("name", quick(4, sorted(AUDITS, key=lambda name: (name not in FIRST, name))))
def test_what_differs_is_what_was_worked_out_by_hand(name: str) -> None:
    measured = measure(AUDITS[name], faults=False)
    assert measured.false == ()
    assert measured.missing == ()
    assert bool(measured.differing) == (AUDITS[name].wrong is None or bool(AUDITS[name].wrong))
    if measured.agreeing is not None:
        assert measured.agreeing < 1e-13


def test_a_planted_sign_is_named() -> None:
    """The heave force of the newer model is planted in the older NPS AUV II, whose rigid body is right."""
    wrong = npsauv.model(5454.54, npsauv.OLD_STRIPS, heave=1.0, pitch=1.0)
    measured = measure(replace(npsauv.OLD, answer=wrong), faults=False)
    assert set(measured.false) == {"Z: u q", "Z: v p", "Z: p p", "Z: q q"}
    assert measured.differing == ("Z", "M")


def test_rows_take_the_products_of_added_mass_out() -> None:
    rng = np.random.default_rng(4)
    half = rng.normal(size=(6, 6))
    added, V = half @ half.T, rng.normal(size=6)
    letters = dict(zip("uvwpqr", V, strict=True))
    sums = np.zeros(6)
    for row in merged(without_added_products(added)):
        a, b = row["of"]
        sums["XYZKMN".index(row["wrench"])] += row["value"] * letters[a] * letters[b]
    p, h = added[:3] @ V, added[3:] @ V
    v, w = V[:3], V[3:]
    np.testing.assert_allclose(sums, [*np.cross(w, p), *(np.cross(w, h) + np.cross(v, p))], rtol=1e-10)


@pytest.mark.slow
def test_the_commands_of_the_page(tmp_path: Path) -> None:
    """The command judges the program of an audit, and prints what the page shows."""
    page = (TESTS.parent / "docs" / "judging.md").read_text(encoding="utf-8")
    assert 'mahovik judge npsauv.toml --with "python -m audits npsauv" --explain' in page
    environment = {**os.environ, "PYTHONPATH": str(TESTS)}
    stand = subprocess.run(
        [sys.executable, "-m", "audits", "npsauv", "--stand"],
        env=environment, capture_output=True, text=True, check=True,
    ).stdout  # fmt: skip
    assert stand == dumps(AUDITS["npsauv"].stand)
    (tmp_path / "npsauv.toml").write_text(stand, encoding="utf-8")
    command = [sys.executable, "-m", "mahovik", "judge", "npsauv.toml", "--with", f"{sys.executable} -m audits npsauv"]
    judged = subprocess.run(
        [*command, "--explain"], cwd=tmp_path, env=environment, capture_output=True, text=True, check=False
    )
    assert judged.returncode == 1
    shown = re.search(r"^6 wrong terms found:\n(  .*\n)+", page, re.MULTILINE)
    assert shown is not None
    assert shown[0].strip() in judged.stdout
