"""Diagnosis of held carriers: every fault answers every want, and wrong numbers of a stand file are no crash."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from mahovik.core.stand import load
from mahovik.core.stand.model import Stand
from mahovik.proof.diagnose.diagnosis import Diagnoser
from mahovik.proof.diagnose.faults import DICTIONARY
from mahovik.proof.diagnose.predict import FaultyProgram, Part, PiecesByState
from mahovik.proof.diagnose.words import sentences
from mahovik.proof.verify.states import Request
from toolchain.quick import quick

BODIES = """
[carrier]
mass = 30.0
inertia = [2.0, 4.0, 4.0]
center_of_mass = [0.1, 0, -0.1]
inertia_about = "center_of_mass"
[[flywheel]]
name = "w"
mass = 0.2
spin_inertia = 2e-4
transverse_inertia = 1e-4
unbalance = { static = "1 g mm" }
"""

HOLDS = {
    "pendulum": 'freedoms = ["pitch"]\npivot = [0, 0, "120 mm"]',
    "yaw with friction": 'freedoms = ["yaw"]\n[[hold.friction]]\ncoulomb = 0.4\nsmoothing = 0.01\nviscous = 0.05',
}


def stand_of(folder: Path, name: str) -> Stand:
    file = folder / "held.toml"
    file.write_text(f'schema = 1\nname = "held"\ngravity = [0, 0, -9.81]\n[hold]\n{HOLDS[name]}\n{BODIES}')
    return load(str(file))


def first_requests(diagnoser: Diagnoser) -> list[Request]:
    """The first request of each want."""
    found: dict[str, Request] = {}
    for request in diagnoser.requests:
        found.setdefault(request.want[0], request)
    return list(found.values())


@pytest.mark.slow
@pytest.mark.parametrize("name", HOLDS)
def test_every_fault_answers_every_want(name: str, tmp_path: Path) -> None:
    stand = stand_of(tmp_path, name)
    requests = first_requests(Diagnoser(stand))
    known: PiecesByState = {}
    assert {"reaction", "generalized"} <= {request.want[0] for request in requests}
    for request in requests:
        right = FaultyProgram(stand, (), known).answer(request)
        for fault in DICTIONARY:
            assert FaultyProgram(stand, (Part(fault),), known).answer(request).keys() in (right.keys(), set())


@pytest.mark.parametrize("name", HOLDS)
@pytest.mark.parametrize("want", quick(2, ["reaction", "forward", "generalized"]))
def test_another_mass_is_an_error_that_is_said(name: str, want: str, tmp_path: Path) -> None:
    stand = stand_of(tmp_path, name)
    other = replace(stand, carrier=replace(stand.carrier, mass=33.0))
    found = Diagnoser(stand, wants=(want,)).diagnose(FaultyProgram(other).answer)
    assert found.outcome in ("named", "unknown")
    assert sentences(found)
