"""A URDF as a stand: the dynamics of Pinocchio on the file itself; what cannot be a stand is refused by name."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from mahovik.errors import ForeignError
from mahovik.out.foreign.agreement import PinocchioOriginal, agreement
from mahovik.out.foreign.merge import ImportedStand, make_stand
from mahovik.out.foreign.urdf import read_urdf
from mahovik.out.foreign.write import stand_file

SAT = Path(__file__).parent / "models" / "sat.urdf"
TOLERANCE = 1e-12
"""Tolerance of K, I, bias, tau, phi_ddot. V_dot is a small difference of large wheel torques: 1e-11."""


def imported(path: Path = SAT, **options: Any) -> ImportedStand:
    """The stand of a file."""
    return make_stand(read_urdf(path), "sat", path.name, **options)


def check(path: Path, **options: object) -> None:
    """Pinocchio on the file itself gives the same motion, forces and matrices."""
    floats = read_urdf(path).free is True
    found = imported(path, **options)
    errors = agreement(found, PinocchioOriginal(path, found, floats))
    assert set(errors) == {"K", "I", "bias", "V_dot", "phi_ddot", "tau"}
    assert errors.pop("V_dot") < 1e-11
    assert max(errors.values()) < TOLERANCE, errors


@pytest.mark.parametrize(
    "options",
    [{}, {"gravity": np.array([0.3, -1.0, -9.81])}, {"carrier": "panel"}, {"carrier": "body", "instruments": True}],
    ids=["plain", "gravity", "carrier", "instruments"],
)
def test_the_dynamics_are_those_of_the_file(options: dict[str, object]) -> None:
    check(SAT, **options)


def test_what_floats_on_the_world(tmp_path: Path) -> None:
    path = tmp_path / "floating.urdf"
    floating = (
        '<joint name="f" type="floating"><parent link="map"/><child link="base_link"/><origin xyz="1 2 3"/></joint>'
    )
    path.write_text(SAT.read_text().replace("</robot>", f'<link name="map"/>{floating}</robot>'))
    check(path, gravity=np.array([0.0, 0.0, -9.81]))


def test_what_becomes_of_it() -> None:
    found = imported()
    stand = found.stand
    assert [s.name for s in stand.flywheels] == ["wheel_1", "wheel2", "wheel3", "wheel4"]
    assert found.joints == ("wheel1_joint", "wheel2_joint", "wheel3_joint", "wheel4_joint")
    assert [p.name for p in stand.points] == ["imu"]
    assert stand.carrier.mass == pytest.approx(13.3)
    motor = stand.flywheels[0].motor
    assert motor is not None
    assert (motor.torque, motor.viscous, motor.coulomb, motor.speed) == (0.2, 1e-4, 2e-4, None)
    notes = "\n".join(found.notes)
    for word in ('"wheel 1" is called "wheel_1"', "velocity limit 600", "1 transmission", "no gravity"):
        assert word in notes


# ---- what is refused ----

SPHERE = '<inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/>'
LINK = f'<link name="{{0}}"><inertial><mass value="{{1}}"/>{SPHERE}</inertial></link>'
BASE = LINK.format("base", 5)
WHEEL = LINK.format("w", 1)


def joint(kind: str, inside: str = "", name: str = "j", parent: str = "base", child: str = "w") -> str:
    return f'<joint name="{name}" type="{kind}"><parent link="{parent}"/><child link="{child}"/>{inside}</joint>'


TURNS = joint("continuous")
REFUSED = {
    "prismatic": (BASE + WHEEL + joint("prismatic"), 'joint "j": prismatic: a flywheel turns, it does not slide'),
    "revolute": (BASE + WHEEL + joint("revolute"), 'joint "j": revolute, with an end to its turning'),
    "planar": (BASE + WHEEL + joint("planar"), 'joint "j": planar'),
    "unknown": (BASE + WHEEL + joint("screw"), 'joint "j", type: expected fixed, continuous or floating,'),
    "mimic": (BASE + WHEEL + joint("continuous", '<mimic joint="k"/>'), 'joint "j": mimic'),
    "axis": (BASE + WHEEL + joint("continuous", '<axis xyz="0 0 0"/>'), 'axis, xyz: "0.0 0.0 0.0" has no direction'),
    "two numbers": (
        BASE + WHEEL + joint("continuous", '<axis xyz="0 1"/>'),
        'joint "j", axis, xyz: expected 3 numbers separated by blanks, found "0 1"',
    ),
    "nan": (BASE + WHEEL + joint("fixed", '<origin xyz="0 nan 0"/>'), 'origin, xyz: "0 nan 0" is not finite'),
    "unit": (
        BASE + LINK.format("w", "1 kg") + TURNS,
        'link "w", inertial, mass, value: expected a number, found "1 kg"',
    ),
    "negative": (BASE + LINK.format("w", "-1") + TURNS, 'link "w", inertial, mass: -1 is negative'),
    "no mass": (
        BASE + WHEEL.replace('<mass value="1"/>', "") + TURNS,
        'link "w", inertial, mass, value: required, but missing',
    ),
    "no inertia": (
        BASE + '<link name="w"><inertial><mass value="1"/></inertial></link>' + TURNS,
        'link "w", inertial, inertia: required, but missing',
    ),
    "no moment": (BASE + WHEEL.replace('iyz="0" ', "") + TURNS, 'link "w", inertial, inertia, iyz: required'),
    "not definite": (
        BASE + WHEEL.replace('ixx="1"', 'ixx="-1"') + TURNS,
        'link "w", inertia: Theta is not positive semidefinite',
    ),
    "hidden in a sum": (
        LINK.format("base", 500) + WHEEL.replace('ixx="1"', 'ixx="2.1"') + joint("fixed"),
        'link "w", inertia: principal moments about the centre of mass break the triangle inequality',
    ),
    "empty wheel": (BASE + '<link name="w"/>' + TURNS, 'joint "j": link "w" turns, but has no mass and no inertia'),
    "empty base": (
        '<link name="base"/>' + WHEEL + TURNS,
        'link "base": has no mass and no inertia, nor has what is fixed on it',
    ),
    "nested": (
        BASE + WHEEL + LINK.format("x", 1) + TURNS + joint("continuous", "", "k", "w", "x"),
        'joint "k": turns on link "w", which turns itself: a flywheel must be on the carrier',
    ),
    "roots": (BASE + WHEEL, '2 links have no parent, "base", "w": expected one root'),
    "two parents": (
        BASE + WHEEL + LINK.format("x", 1) + joint("fixed", "", "i", child="x") + TURNS
        + joint("fixed", "", "k", "x", "w"),
        'link "w": is child of two joints, j and k',
    ),
    "cycle": (BASE + WHEEL + TURNS + joint("fixed", "", "k", "w", "base"), "no link is the root: expected one root"),
    "cycle apart": (
        BASE + WHEEL + LINK.format("x", 1) + joint("fixed", "", "a", "w", "x") + joint("fixed", "", "b", "x", "w"),
        "its joints close a loop",
    ),
    "unknown link": (BASE + WHEEL + joint("continuous", child="v"), 'joint "j", child: there is no link "v"'),
    "no child": (BASE + '<joint name="j" type="fixed"><parent link="base"/></joint>', 'joint "j", child: required'),
    "floating in the middle": (
        BASE + WHEEL + LINK.format("x", 1) + TURNS + joint("floating", "", "k", "w", "x"),
        'joint "k": floating: only the root may float, alone',
    ),
    "two of one name": (BASE + BASE, 'link "base": there are two of this name'),
    "no link": ("", "has no link"),
    "fixed on the world": (
        '<link name="world"/>' + BASE + WHEEL + TURNS + joint("fixed", "", "k", "world", "base"),
        'link "base": is fixed on the world, but a carrier moves: give --carrier base to make it free',
    ),
    "xacro": (
        '<xacro:macro xmlns:xacro="http://www.ros.org/wiki/xacro" name="m"/>' + BASE,
        "has xacro macros: run `xacro FILE > model.urdf` first",
    ),
}  # fmt: skip


@pytest.mark.parametrize("case", REFUSED)
def test_refused(case: str, tmp_path: Path) -> None:
    """One line that names the thing."""
    inside, said = REFUSED[case]
    path = tmp_path / "m.urdf"
    path.write_text(f'<robot name="r">{inside}</robot>')
    with pytest.raises(ForeignError) as error:
        stand_file(imported(path), path.name, "")
    lines = str(error.value).splitlines()
    assert len(lines) == 1, lines
    assert lines[0].startswith("m.urdf: ")
    assert said in lines[0]


def test_all_problems_are_told_together(tmp_path: Path) -> None:
    """Problems of the file, of the bodies and of the joints come in one message."""
    path = tmp_path / "m.urdf"
    wheels = WHEEL + LINK.format("x", -2) + LINK.format("y", 1).replace('ixx="1"', 'ixx="3"') + LINK.format("z", 1)
    wheels += joint("continuous", "", "l", "base", "y") + joint("continuous", "", "m", "y", "z")
    path.write_text(
        f"<robot name='r'>{BASE}{wheels}{joint('prismatic')}{joint('planar', '<mimic/>', 'k', child='x')}</robot>"
    )
    with pytest.raises(ForeignError) as error:
        imported(path)
    assert len(error.value.problems) == 6


def test_files_that_are_not_there(tmp_path: Path) -> None:
    with pytest.raises(ForeignError, match="no such file"):
        read_urdf(tmp_path / "m.urdf")
    with pytest.raises(ForeignError, match="is a directory"):
        read_urdf(tmp_path)


def test_a_carrier_that_is_none() -> None:
    with pytest.raises(
        ForeignError, match='--carrier wheel2: turns, expected "base_link" or a link that is fixed to it'
    ):
        imported(carrier="wheel2")
    with pytest.raises(ForeignError, match=r'--carrier panle: is not in the file, did you mean "panel"\?'):
        imported(carrier="panle")


def test_fixed_on_the_world_but_taken_as_free(tmp_path: Path) -> None:
    path = tmp_path / "m.urdf"
    path.write_text(f"<robot name='r'>{REFUSED['fixed on the world'][0]}</robot>")
    found = imported(path, carrier="base")
    assert found.stand.carrier.mass == 5
    assert any("fixed on the world there, and free here" in note for note in found.notes)
    check(path, carrier="base")


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("", "not XML: no element found"),
        ("<robot><link>", "not XML:"),
        ("\x00\x01", "not XML:"),
        ('<?xml version="1.0" encoding="klingon"?><robot/>', "not XML:"),
        ("<mujoco/>", "its root element is <mujoco>: is an MJCF: mahovik new"),
        ("<sdf/>", "its root element is <sdf>: is an SDF, which has no reader here"),
        ("<html/>", "its root element is <html>: expected <robot>"),
    ],
)
def test_files_that_are_no_urdf(text: str, said: str, tmp_path: Path) -> None:
    path = tmp_path / "m.urdf"
    path.write_text(text)
    with pytest.raises(ForeignError, match=said):
        read_urdf(path)
