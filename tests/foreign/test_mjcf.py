"""An MJCF file as a stand: the dynamics of MuJoCo on the file itself; what cannot be a stand is refused by name."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from mahovik.core.stand import loads
from mahovik.errors import ForeignError, UsageError
from mahovik.out.foreign.agreement import MujocoOriginal, agreement
from mahovik.out.foreign.merge import ImportedStand, make_stand
from mahovik.out.foreign.mjcf import compile_model, read_mjcf
from mahovik.out.foreign.write import stand_file

SAT = Path(__file__).parent / "models" / "sat.xml"
TOLERANCE = 1e-12
"""MuJoCo's full inertias go by principal axes that are good to about this."""


def imported(path: Path = SAT, **options: Any) -> ImportedStand:
    """The stand of a file."""
    return make_stand(read_mjcf(path), "sat", path.name, **options)


def errors_of(path: Path, found: ImportedStand) -> dict[str, float]:
    """How far off MuJoCo on the file itself is."""
    return agreement(found, MujocoOriginal(compile_model(path), found, read_mjcf(path).free is not False))


def check(path: Path, **options: object) -> None:
    """MuJoCo on the file itself gives the same motion, forces and matrices."""
    errors = errors_of(path, imported(path, **options))
    assert set(errors) == {"K", "I", "bias", "V_dot", "phi_ddot", "tau"}
    assert max(errors.values()) < TOLERANCE, errors


@pytest.mark.parametrize("options", [{}, {"carrier": "panel"}, {"instruments": True}], ids=["plain", "carrier", "own"])
def test_the_dynamics_are_those_of_the_file(options: dict[str, object]) -> None:
    check(SAT, **options)


def test_angles_sequences_and_includes(tmp_path: Path) -> None:
    """Radians, another sequence, and wheels in a file of their own."""
    text = SAT.read_text().replace('angle="degree" eulerseq="xyz"', 'angle="radian" eulerseq="zyz"')
    start, end = text.index('<body name="w2"'), text.index('<body pos="0 -0.2 0"')
    (tmp_path / "w2.xml").write_text(f"<mujocoinclude>{text[start:end]}</mujocoinclude>")
    path = tmp_path / "sat.xml"
    path.write_text(f'{text[:start]}<include file="w2.xml"/>{text[end:]}')
    check(path)
    assert [s.name for s in imported(path).stand.flywheels] == ["w1", "w2", "body6"]


def test_what_becomes_of_it() -> None:
    found = imported()
    stand = found.stand
    assert [s.name for s in stand.flywheels] == ["w1", "w2", "body6"]
    assert [p.name for p in stand.points] == ["imu", "tip"]
    assert stand.gravity == (0.1, 0.2, -3.7)
    motors = [s.motor for s in stand.flywheels]
    assert [m and (m.torque, m.viscous, m.coulomb) for m in motors] == [
        (0.2, 1e-5, 1e-4),  # control range times gear
        (None, 1e-5, 0.0),
        (0.5, 1e-5, 1e-4),  # the joint's own range
    ]
    notes = "\n".join(found.notes)
    for word in ('actuator "m2": a law of control', "8 geoms", "1 sensor", "no contacts: 6 geoms", "world, 1 body"):
        assert word in notes
    assert loads(stand_file(found, "sat.xml", "x")) == stand


def test_gravity_and_damping_that_are_switched_off(tmp_path: Path) -> None:
    path = tmp_path / "sat.xml"
    flags = '<option gravity="0.1 0.2 -3.7"><flag gravity="disable" damper="disable" frictionloss="disable"/></option>'
    path.write_text(SAT.read_text().replace('<option gravity="0.1 0.2 -3.7"/>', flags))
    stand = imported(path).stand
    assert stand.gravity == (0.0, 0.0, 0.0)
    assert [s.motor and (s.motor.viscous, s.motor.coulomb) for s in stand.flywheels] == [(0, 0), None, (0, 0)]
    check(path)


def test_fixed_on_the_world_but_taken_as_free(tmp_path: Path) -> None:
    """There the carrier rests, so that torques are all that can be compared."""
    path = tmp_path / "sat.xml"
    path.write_text(SAT.read_text().replace('<freejoint name="hub_free"/>', ""))
    with pytest.raises(ForeignError, match="is fixed on the world, but a carrier moves: give --carrier hub"):
        imported(path)
    for carrier in ("hub", "panel"):
        found = imported(path, carrier=carrier)
        assert "is fixed on the world there, and free here" in "\n".join(found.notes)
        errors = errors_of(path, found)
        assert set(errors) == {"tau"}
        assert errors["tau"] < TOLERANCE


# ---- what is refused ----

SHAPE = '<geom size="0.1"/>'
WHEEL = f'<body name="w"><joint name="j" {{0}}/>{SHAPE}</body>'
GOOD = WHEEL.format("")


def hub(inside: str, free: str = "<freejoint/>") -> str:
    return f'<worldbody><body name="hub">{free}{SHAPE}{inside}</body></worldbody>'


REFUSED = {
    "slide": (hub(WHEEL.format('type="slide"')), 'joint "j": slide: a flywheel turns about one axis, as a hinge does'),
    "ball": (hub(WHEEL.format('type="ball"')), 'joint "j": ball: a flywheel turns about one axis'),
    "range": (hub(WHEEL.format('limited="true" range="-1 1"')), 'joint "j": has a range: a flywheel turns without end'),
    "spring": (hub(WHEEL.format('stiffness="1"')), 'joint "j": stiffness: a flywheel has no spring'),
    "armature": (hub(WHEEL.format('armature="1"')), 'joint "j": armature: inertia without a body'),
    "polynomial": (hub(WHEEL.format('damping="1 2"')), 'joint "j": damping that is not linear in the speed'),
    "two joints": (
        hub(f'<body name="w"><joint axis="1 0 0"/><joint axis="0 1 0"/>{SHAPE}</body>'),
        'body "w": has 2 joints: a flywheel has one',
    ),
    "nested": (
        hub(f'<body name="w"><joint name="j"/>{SHAPE}<body name="x"><joint name="k"/>{SHAPE}</body></body>'),
        'joint "k": turns on body "w", which turns itself: a flywheel must be on the carrier',
    ),
    "on the world": (
        f'<worldbody><body name="w"><joint name="j"/>{SHAPE}</body></worldbody>',
        'joint "j": turns on the world itself: a flywheel is on a carrier',
    ),
    "two that are free": (
        hub(GOOD).replace("</worldbody>", f'<body name="b"><freejoint/>{SHAPE}</body></worldbody>'),
        '2 bodies of the world move, "hub", "b": expected one, the carrier with its flywheels',
    ),
    "nothing moves": (hub("", ""), "no body moves: expected one, the carrier with its flywheels"),
    "equality": (
        hub(GOOD) + '<equality><joint name="e" joint1="j"/></equality>',
        'equality "e": constrains the motion, which a stand cannot have',
    ),
    "tendon": (
        hub(GOOD) + '<tendon><fixed name="t"><joint joint="j" coef="1"/></fixed></tendon>',
        'tendon "t": constrains the motion',
    ),
    "density": ('<option density="1000"/>' + hub(GOOD), "option, density: MuJoCo's fluid is not that of a stand"),
    "gravcomp": (hub(GOOD.replace("<body ", '<body gravcomp="1" ')), 'body "w": gravcomp: a stand has no such force'),
    "damped carrier": (
        hub(GOOD, '<joint name="f" type="free" damping="1"/>'),
        'joint "f": damping: not of a carrier that moves freely',
    ),
    "nan": (hub(GOOD.replace("<body ", '<body pos="0 nan 0" ')), 'body "w", pos: is not finite'),
    "no inertia": (
        hub('<body name="w"><joint/></body>'),
        "MuJoCo refuses it: mass and inertia of moving bodies must be",
    ),
    "unknown attribute": (hub(WHEEL.format('colour="1"')), "MuJoCo refuses it: "),
}


@pytest.mark.parametrize("case", REFUSED)
def test_refused(case: str, tmp_path: Path) -> None:
    """One line that names the thing."""
    inside, said = REFUSED[case]
    path = tmp_path / "m.xml"
    path.write_text(f'<mujoco model="r">{inside}</mujoco>')
    with pytest.raises(ForeignError) as error:
        stand_file(imported(path), path.name, "")
    lines = str(error.value).splitlines()
    assert len(lines) == 1, lines
    assert lines[0].startswith("m.xml: ")
    assert said in lines[0]


def test_without_mujoco(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "mujoco", None)
    with pytest.raises(UsageError, match=r"MuJoCo, which reads MJCF, is not installed .*: pip install mujoco"):
        read_mjcf(SAT)


def test_frames_that_turn_are_left_out(tmp_path: Path) -> None:
    path = tmp_path / "sat.xml"
    path.write_text(
        SAT.read_text().replace(
            '<geom class="wheel"/>\n        </body>', '<geom class="wheel"/><site name="s"/></body>'
        )
    )
    assert "left out: 1 frames that turn with flywheels" in imported(path).notes
    assert np.isfinite(imported(path).stand.carrier.mass)
