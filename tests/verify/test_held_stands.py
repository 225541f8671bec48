"""Held stands of docs/held: each verifies, and joints of other programs agree with its C."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from mahovik.core.stand import Stand, load
from mahovik.core.stand.state import rest_state
from mahovik.proof.verify.backends import NumpyBackend
from mahovik.proof.verify.harness import verify_c
from mahovik.proof.verify.judges.compare import verify_judges
from mahovik.proof.verify.judges.rigid import attitude
from toolchain.quick import quick

DOCS = Path(__file__).parents[2] / "docs"
FILES = sorted((DOCS / "held").glob("*.toml"))
WITHOUT_PINOCCHIO = {"force_table"}
"""Clamped: Pinocchio has no joint without freedoms."""


def stand_of(name: str) -> Stand:
    """A stand of docs/held."""
    return load(str(DOCS / "held" / f"{name}.toml"))


def test_every_stand_is_named_in_the_tutorial() -> None:
    page = (DOCS / "tutorial-held.md").read_text(encoding="utf-8")
    assert len(FILES) == 5
    for file in FILES:
        assert f"(held/{file.name})" in page
        assert load(str(file)).name == file.stem


@pytest.mark.slow
@pytest.mark.parametrize("file", quick(1, FILES), ids=lambda file: file.stem)
def test_a_stand_verifies(file: Path) -> None:
    assert verify_c(load(str(file)), seed=3, count=6).passed


@pytest.mark.slow
@pytest.mark.parametrize("file", FILES, ids=lambda file: file.stem)
def test_joints_of_others_agree(file: Path) -> None:
    found = verify_judges(load(str(file)), count=6, names=("pinocchio", "mujoco"), bare=True)
    assert found.passed
    silent = {row.want for row in found.rows if row.verdict == "not compared"}
    assert silent == ({"pinocchio"} if file.stem in WITHOUT_PINOCCHIO else set())


def test_the_cube_stands_upright_on_its_corner() -> None:
    stand = stand_of("cube")
    assert stand.hold is not None
    state = replace(rest_state(stand), angles=stand.hold.angles, quaternion=None)
    diagonal = attitude(stand, state).as_matrix() @ np.ones(3) / math.sqrt(3.0)
    assert np.abs(diagonal - [0.0, 0.0, 1.0]).max() < 1e-12


def test_the_air_table_hangs_level() -> None:
    stand = stand_of("air_table")
    mass = sum(body.mass for body in stand.bodies)
    found = NumpyBackend(stand).evaluate(rest_state(stand), ["momentum"])
    center = np.array(found["center_of_mass"])
    assert np.abs(center[:2]).max() * mass < 5e-6  # the unbalances of three wheels, kg m
    assert -0.6e-3 < center[2] < -0.5e-3


def test_exciters_of_the_shaker_cancel_across_the_rail() -> None:
    stand = stand_of("linear_shaker")
    speed, phase = 50.0, 0.7
    state = replace(rest_state(stand), phi=(phase, phase), phi_dot=(speed, speed))
    across, one_way = (
        abs(NumpyBackend(stand).evaluate(replace(state, phi=phi), ["forward"])["reaction"][1])
        for phi in ((phase, phase), (phase, -phase))
    )
    assert across < 1e-12 * one_way
    assert math.isclose(one_way, 2 * 0.16 * speed**2 * math.sin(phase), rel_tol=1e-12)
