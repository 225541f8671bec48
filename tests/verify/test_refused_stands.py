"""Stands that one of the judges refuses: its rows say why, the other judges still judge."""

from __future__ import annotations

from dataclasses import replace

from mahovik.core.stand import loads
from mahovik.proof.second import Second
from mahovik.proof.verify.bounds import DOUBLE
from mahovik.proof.verify.c_backend import CBackend
from mahovik.proof.verify.draw import draw
from mahovik.proof.verify.functions.case import Case
from mahovik.proof.verify.functions.reactions import mount_rows
from mahovik.proof.verify.judges.compare import ALL, verify_judges

FLYWHEELS = """
[[flywheel]]
name = "w1"
mass = 1
position = [0.2, 0, 0]
spin_inertia = 0.002
transverse_inertia = 0.0011
[[flywheel]]
name = "w2"
mass = 1
position = [0, 0.2, 0]
spin_inertia = 0.002
transverse_inertia = 0.0011
"""
ONE_WHEEL = FLYWHEELS.rpartition("[[flywheel]]")[0]
POINT = loads(f'schema = 1\nname = "point"\n[carrier]\nmass = 5\ninertia = [0, 0, 0]\n{FLYWHEELS}')
"""A carrier that is a point: without its flywheels nothing resists a turn."""

HELD = loads(
    f'schema = 1\nname = "held"\n[carrier]\nmass = 0\ninertia = [0, 0, 0]\nadded_mass = [1, 1, 1, 1, 1, 1]\n{ONE_WHEEL}'
)
"""One wheel, and else added mass alone: without fluid its mass matrix is singular."""


def test_reactions_on_a_carrier_without_inertia_are_skipped_with_the_reason() -> None:
    states = [(name, replace(state, wrench={})) for name, state in draw(POINT, 1, 6)]
    case = Case(POINT, CBackend(POINT), states[:3], DOUBLE, Second(POINT), 1)
    torque, motion = mount_rows(case)
    assert (torque.verdict, torque.states) == ("ok", 3)
    assert motion.verdict == "not compared" and not motion.failed
    assert motion.reason == (
        "its judge refused: the mass matrix of the stand without flywheels is not positive definite"
    )


def test_a_stand_that_is_none_without_fluid_is_skipped_with_the_reason() -> None:
    """Every judge says so; nothing is compared, which is no pass."""
    found = verify_judges(HELD, count=2, bare=True)
    assert [row.want for row in found.rows] == list(ALL)
    for row in found.rows:
        assert (row.verdict, row.states) == ("not compared", 0)
        assert row.reason.startswith("the stand without carrier: added_mass has no positive definite mass matrix")
    assert not found.passed
