"""Audited models: what differs is what a calculation by hand says, and a planted mistake is named."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import audits_campaign
import numpy as np
import pytest

from audits import basilisk, gyrostat, npsauv
from audits.audit import merged, terms, without_added_products
from audits.catalogue import AUDITS
from audits.measure import AGREES, measure
from mahovik.core.stand.state import State
from mahovik.core.stand.write import dumps

TESTS = Path(__file__).parents[1]

QUICK = ("npsauv", "npsauv_old", "remus100_current", "otter", "gz_sim", "cubli", "screen", "screen_turned")


@pytest.mark.parametrize("name", QUICK)
def test_what_differs_is_what_was_worked_out_by_hand(name: str) -> None:
    found = measure(AUDITS[name], faults=False)
    assert found.false == ()
    assert found.missing == ()
    assert bool(found.differing) == (AUDITS[name].wrong is None or bool(AUDITS[name].wrong))
    if found.agreeing is not None:
        assert found.agreeing < 1e-13


def test_a_planted_sign_is_named() -> None:
    """The older NPS AUV II, whose rigid body is right, with the heave force of the newer."""
    wrong = npsauv.model(5454.54, npsauv.OLD_STRIPS, heave=1.0, pitch=1.0, inverse=None)
    found = measure(replace(npsauv.OLD, answer=wrong), faults=False)
    assert set(found.false) == {"Z: u q", "Z: v p", "Z: p p", "Z: q q"}
    assert found.differing == ("Z", "M")


@pytest.mark.slow
def test_a_planted_sign_of_a_gyroscopic_torque_is_named() -> None:
    def answer(state: State, want: str) -> Mapping[str, Any]:
        found = dict(gyrostat.textbook(state, want))
        if want == "forward":
            h = gyrostat.JS * np.array([state.phi_dot[0], 0.0, 0.0])
            error = np.linalg.solve(gyrostat.TOTAL, 2 * np.cross(state.V[3:], h))
            found["V_dot"] = [*found["V_dot"][:3], *(np.array(found["V_dot"][3:]) + error)]
        return found

    found = measure(replace(AUDITS["gyrostat"], answer=answer, wants=("forward",)), faults=False)
    assert set(found.false) == {"M: r w1.speed", "N: q w1.speed"}


def test_the_wheel_of_basilisk_lacks_terms_that_are_no_whole_fault() -> None:
    """It lacks Jt - Jg, not what a static unbalance adds to J22 - J33: that fault of the dictionary is 2 % more."""
    found = measure(AUDITS["basilisk_asymmetric"])
    assert found.faults == found.false == found.missing == ()
    assert len(found.named) == len(AUDITS["basilisk_asymmetric"].wrong or ())
    assert found.agreeing is not None
    assert found.agreeing < AGREES


def test_back_substitution_gives_the_torque_that_it_was_given() -> None:
    rng = np.random.default_rng(3)
    for model in (basilisk.spinning_body, basilisk.fully_coupled(0.0021, 0.0027)):
        V = rng.normal(size=6)
        effector = model(V[3:], 0.7, 5.0, 0.02)
        V_dot, phi_ddot = basilisk.move(effector, V, None)
        given, _ = basilisk.move(effector, V, phi_ddot)
        np.testing.assert_allclose(given, V_dot, rtol=1e-12)
        r_ddot = V_dot[:3] + np.cross(V[3:], V[:3])
        assert effector.torque(r_ddot, V_dot[3:], phi_ddot, 0.02) == pytest.approx(0.02, rel=1e-10)


def test_rows_take_the_products_of_added_mass_out() -> None:
    rng = np.random.default_rng(4)
    half = rng.normal(size=(6, 6))
    added, V = half @ half.T, rng.normal(size=6)
    letters = dict(zip("uvwpqr", V, strict=True))
    found = np.zeros(6)
    for row in merged(without_added_products(added)):
        a, b = row["of"]
        found["XYZKMN".index(row["wrench"])] += row["value"] * letters[a] * letters[b]
    p, h = added[:3] @ V, added[3:] @ V
    v, w = V[:3], V[3:]
    np.testing.assert_allclose(found, [*np.cross(w, p), *(np.cross(w, h) + np.cross(v, p))], rtol=1e-10)


def test_terms_of_a_text() -> None:
    assert terms("Z: u q, v p; M: p r") == {("Z", "u q"), ("Z", "v p"), ("M", "p r")}
    assert terms("") == frozenset()


def test_every_model_has_a_source() -> None:
    """A file has its revision; a paper its year."""
    for audit in AUDITS.values():
        in_a_file = "github.com" not in audit.source or re.search(r"\b[0-9a-f]{8}\b", audit.source)
        assert in_a_file, audit.source
        assert audit.stand.name == audit.name
    assert len(AUDITS) >= 10
    assert len({audit.title for audit in AUDITS.values()}) == len(AUDITS)


def test_kept_results_are_those_of_the_catalogue() -> None:
    rows = audits_campaign.CAMPAIGN.figures()["rows"]
    assert [row["name"] for row in rows] == list(AUDITS)
    for row in rows:
        audit = AUDITS[row["name"]]
        assert (row["model"], row["source"], row["scope"], row["finding"]) == (
            audit.title,
            audit.source,
            audit.scope,
            audit.finding,
        )
        assert row["false"] == row["missing"] == []


@pytest.mark.slow
def test_the_commands_of_the_page(tmp_path: Path) -> None:
    """The stand file and the program of an audit, judged by the command; its output is the one that the page shows."""
    page = (TESTS.parent / "docs" / "audits.md").read_text(encoding="utf-8")
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
