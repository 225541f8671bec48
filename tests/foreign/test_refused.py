"""What cannot be a stand is refused in one line that names the file, the thing and the reason."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import pytest

from foreign.test_models import BASE, ROTOR, SAT_MJCF, SAT_URDF, joint, link, px4, urdf
from mahovik.errors import ForeignError, UsageError
from mahovik.out.foreign.original import read
from mahovik.out.foreign.stand import ImportedStand, make_stand


def imported(path: Path, **options: Any) -> ImportedStand:
    return make_stand(read(path, None)[0], "m", path.name, **options)


WHEEL = link("base", 5) + link("w")
TURNS = joint("j", "continuous", "base", "w")
NESTED = link("x") + joint("k", "continuous", "w", "x")
OF_URDF = {
    "prismatic": (
        WHEEL + joint("j", "prismatic", "base", "w", '<limit lower="0" upper="1"/>'),
        'joint "j": slide: a flywheel turns',
    ),
    "revolute": (
        WHEEL + joint("j", "revolute", "base", "w", '<limit lower="-1" upper="1"/>'),
        'joint "j": turns from -1 to 1',
    ),
    "many turns": (
        WHEEL + joint("j", "revolute", "base", "w", '<limit lower="-1" upper="6280"/>'),
        'joint "j": turns from -1 to 6280',
    ),
    "no limits": (
        WHEEL + joint("j", "revolute", "base", "w"),
        'joint "j", limit, lower and upper: expected two numbers',
    ),
    "limits turned": (
        WHEEL + joint("j", "revolute", "base", "w", '<limit lower="1" upper="0"/>'),
        "limit: lower 1 is above upper 0",
    ),
    "planar": (WHEEL + joint("j", "planar", "base", "w"), 'link "w" has 3 freedoms: a flywheel has one'),
    "unknown": (
        WHEEL + joint("j", "screw", "base", "w"),
        'joint "j": type "screw": expected one of revolute,',
    ),
    "mimic": (WHEEL + joint("j", "continuous", "base", "w", '<mimic joint="k"/>'), 'joint "j": mimic'),
    "axis": (WHEEL + joint("j", "continuous", "base", "w", axis="0 0 0"), "MuJoCo refuses it: axis too small"),
    "nan": (WHEEL + TURNS.replace("0.1 0 0.2", "0 nan 0"), "body, pos: has a number that is not finite"),
    "unit": (WHEEL.replace('"1.0"', '"1 kg"') + TURNS, "MuJoCo refuses it: bad format in attribute 'value'"),
    "negative": (
        WHEEL.replace('"1.0"', '"-1"') + TURNS,
        "MuJoCo refuses it: mass and inertia of moving bodies must be",
    ),
    "zero": (WHEEL.replace('"1.0"', '"0"') + TURNS, "MuJoCo refuses it: mass and inertia of moving bodies must be"),
    "no moments": (
        link("base") + '<link name="w"><inertial><mass value="1"/></inertial></link>' + TURNS,
        "missing element: 'inertia'",
    ),
    "hidden in a sum": (
        WHEEL.replace('ixx="0.1"', 'ixx="0.5"') + joint("j", "fixed", "base", "w"),
        "inertia must satisfy A + B >= C",
    ),
    "empty wheel": (
        link("base") + '<link name="w"/>' + TURNS,
        'joint "j": link "w" turns, but has no mass and no inertia',
    ),
    "empty base": ('<link name="base"/>' + link("w") + TURNS, 'link "base": has no mass and no inertia'),
    "nested": (
        WHEEL + TURNS + NESTED,
        'joint "k": turns on link "w", which turns itself: expected the carrier; a root',
    ),
    "roots": (WHEEL, '2 links have no parent, "base", "w": expected one root'),
    "two parents": (
        WHEEL + NESTED + TURNS + joint("i", "fixed", "base", "x"),
        'link "x": is child of two joints, on "w" and "base"',
    ),
    "cycle": (WHEEL + TURNS + joint("k", "fixed", "w", "base"), "no link is the root: expected one root"),
    "cycle apart": (
        WHEEL + link("x") + joint("a", "fixed", "w", "x") + joint("b", "fixed", "x", "w"),
        "its joints close a loop",
    ),
    "unknown link": (WHEEL + TURNS + joint("k", "fixed", "base", "v"), 'joint "k", child: there is no link "v"'),
    "floating inside": (
        WHEEL + TURNS + link("x") + joint("k", "floating", "w", "x"),
        "free joint can only be used on top level",
    ),
    "mass that floats on mass": (
        WHEEL + joint("j", "floating", "base", "w"),
        'link "base": bears a floating joint, so that it is the world, but has mass: take its <inertial>',
    ),
    "two of one name": (link("base") + link("base") + link("w") + TURNS, 'link "base": there are two of this name'),
    "xacro": (
        '<xacro:macro xmlns:xacro="http://www.ros.org/wiki/xacro" name="m"/>' + WHEEL,
        "run `xacro FILE > model.urdf` first",
    ),
}
GEOM = '<geom size="0.1"/>'
SPUN = f'<body name="w"><joint name="j" {{0}}/>{GEOM}</body>'
GOOD = SPUN.format("")


def hub(inside: str, free: str = "<freejoint/>", more: str = "") -> str:
    return f'<worldbody><body name="hub">{free}{GEOM}{inside}</body>{more}</worldbody>'


HINGES = '<joint name="a" axis="1 0 0"/><joint name="b" axis="0 1 0"/>'
PLANE = (
    '<joint name="x" type="slide" axis="1 0 0"/><joint name="y" type="slide" axis="0 1 0" armature="1"/>'
    '<joint name="h" axis="0 0 1"/>'
)
OF_MJCF = {
    "slide": (
        hub(SPUN.format('type="slide"')),
        'joint "j": slide: a flywheel turns about one axis, as a hinge does; fix=j',
    ),
    "ball": (hub(SPUN.format('type="ball"')), 'joint "j": ball: a flywheel turns about one axis'),
    "spring": (hub(SPUN.format('stiffness="1"')), 'joint "j": stiffness 1: a flywheel has no spring'),
    "polynomial": (
        hub(SPUN.format('damping="1 2"')),
        'joint "j": a spring or damping that is not linear is no law of a stand',
    ),
    "two joints": (hub(f'<body name="w">{HINGES}{GEOM}</body>'), 'body "w" has 2 freedoms: a flywheel has one'),
    "two hinges": (hub(GOOD, HINGES), 'joints "a", "b": together no directions fixed in the carrier'),
    "two carriers": (
        hub(GOOD, more=f'<body name="b"><freejoint/>{GEOM}</body>'),
        '2 bodies move on the world, "hub", "b": expected one',
    ),
    "two that move": (
        hub(GOOD, more=f'<body name="b"><joint/>{GEOM}</body>'),
        'body "b": moves on the world, as the carrier "hub"',
    ),
    "nothing moves": (hub("", ""), "no bodies move on the world: expected one, the carrier"),
    "equality": (
        hub(GOOD) + '<equality><joint name="e" joint1="j"/></equality>',
        'equality "e": constrains the motion',
    ),
    "tendon": (
        hub(GOOD) + '<tendon><fixed name="t"><joint joint="j" coef="1"/></fixed></tendon>',
        'tendon "t": constrains',
    ),
    "density": ('<option density="1000"/>' + hub(GOOD), "option, density: MuJoCo's fluid is not that of a stand"),
    "gravcomp": (hub(GOOD.replace("<body ", '<body gravcomp="1" ')), 'body "w": gravcomp: a stand has no such force'),
    "armature of a plane": (hub(GOOD, PLANE), 'joint "y": armature: inertia without a body'),
    "heavy armature": (hub(SPUN.format('armature="1e9"')), "armature 1e+09: a thin disc of it has more inertia"),
    "unknown attribute": (hub(SPUN.format('colour="1"')), "MuJoCo refuses it: "),
    "no file": (hub(GOOD) + '<include file="no.xml"/>', "MuJoCo refuses it: "),
}
Q = BASE + ROTOR.format(i=0, y=0.1)
VEHICLE = f'<model name="q">{Q}</model>'
OF_SDF = {
    "two models": ('<model name="a"/><model name="b"/>', '2 models move, "a", "b": expected one'),
    "no model": ("", "no models move: expected one"),
    "universal": (
        VEHICLE.replace("revolute", "universal"),
        'joint "rotor_0_joint": universal: expected one of revolute',
    ),
    "roots": (
        f'<model name="q">{Q}<link name="x"/></model>',
        '2 links have no parent, "base_link", "x": expected one root',
    ),
    "frame": (VEHICLE.replace('"hub">0.17', '"hob">0.17'), 'frame "hob": is not there'),
    "circle": (VEHICLE.replace("<pose>0 0 0.1", '<pose relative_to="rotor_0">0 0 0.1'), "is in a circle of frames"),
    "numbers": (VEHICLE.replace("0 0 0.1", "0 0 no"), 'pose: expected 6 numbers separated by blanks, found "0 0 no'),
    "axis": (VEHICLE.replace("<xyz>0 0 1", "<xyz>0 0 0"), "MuJoCo refuses it: axis too small"),
    "mimic": (VEHICLE.replace("<xyz>", '<mimic joint="k"/><xyz>'), 'joint "rotor_0_joint": mimic'),
    "include": ("<include><uri>https://fuel.example/x</uri></include>", 'include "https://fuel.example/x": expected'),
    "include nowhere": (
        '<model name="q"><include><uri>model://x</uri></include></model>',
        'include "model://x": expected x/model.sdf in',
    ),
    "auto": (VEHICLE.replace("<inertial>", '<inertial auto="true">', 1), 'link "base_link", inertial: auto'),
    "zero": (VEHICLE.replace("0.016", "0"), "MuJoCo refuses it: mass and inertia of moving bodies"),
}
CASES = {
    **{f"{case}.urdf": (urdf(text), said) for case, (text, said) in OF_URDF.items()},
    **{f"{case}.xml": (f'<mujoco model="r">{text}</mujoco>', said) for case, (text, said) in OF_MJCF.items()},
    **{f"{case}.sdf": (f'<sdf version="1.9">{text}</sdf>', said) for case, (text, said) in OF_SDF.items()},
    "empty.urdf": ("", "not XML: no element found"),
    "cut off.sdf": ("<sdf><model>", "not XML:"),
    "noise.xml": ("\x00\x01", "not XML:"),
    "encoding.urdf": ('<?xml version="1.0" encoding="klingon"?><robot/>', "not XML:"),
    "page.xml": ("<html/>", "its root element is <html>: expected one of robot, mujoco, sdf"),
}


@pytest.mark.parametrize("case", CASES)
def test_refused(case: str, tmp_path: Path) -> None:
    text, said = CASES[case]
    path = tmp_path / case
    path.write_text(text)
    with pytest.raises(ForeignError) as error:
        imported(path, armature="wheel")
    lines = str(error.value).splitlines()
    assert len(lines) == 1, lines
    assert lines[0].startswith(f"{case}: ")
    assert said in lines[0]


def test_problems_are_told_together(tmp_path: Path) -> None:
    path = tmp_path / "m.xml"
    spring, slide = (
        SPUN.format('stiffness="1"'),
        SPUN.format('type="slide"').replace('"w"', '"x"').replace('"j"', '"k"'),
    )
    path.write_text(f"<mujoco>{hub(spring + slide)}</mujoco>")
    with pytest.raises(ForeignError) as error:
        imported(path)
    assert len(error.value.problems) == 2


def test_files_that_are_not_there(tmp_path: Path) -> None:
    with pytest.raises(ForeignError, match="no such file"):
        imported(tmp_path / "m.urdf")
    with pytest.raises(ForeignError, match="is a directory"):
        imported(tmp_path)


def test_the_file_of_a_mesh_is_needed_for_inertia_alone(tmp_path: Path) -> None:
    text = """<mujoco><compiler meshdir="stl"/><asset><mesh name="hull" file="hull.stl"/></asset><worldbody>
    <body name="a"><freejoint/>{}<geom type="mesh" mesh="hull"/></body></worldbody></mujoco>"""
    (tmp_path / "m.xml").write_text(text.format(""))
    words = 'mesh "hull": its file hull.stl is not in .*stl, but the inertia of body "a" comes of it: put it there, or'
    with pytest.raises(ForeignError, match=words):
        imported(tmp_path / "m.xml")
    (tmp_path / "m.xml").write_text(text.format('<inertial mass="2" pos="0 0 0" diaginertia="1 1 1"/>'))
    assert make_stand(read(tmp_path / "m.xml", None)[0], "m", "m").carrier == "a"


def test_models_that_include_each_other(tmp_path: Path) -> None:
    for name, other in (("a", "b"), ("b", "a")):
        (tmp_path / name).mkdir()
        text = f'<model name="{name}"><include><uri>model://{other}</uri></include></model>'
        (tmp_path / name / "model.sdf").write_text(f'<sdf version="1.9">{text}</sdf>')
    with pytest.raises(ForeignError, match='include "model://a": there is no other model in'):
        imported(tmp_path / "a" / "model.sdf")


def test_a_carrier_that_is_none(tmp_path: Path) -> None:
    with pytest.raises(ForeignError, match='carrier=wheel2: turns, expected "base_link" or a link that is fixed to it'):
        imported(SAT_URDF, carrier="wheel2")
    with pytest.raises(ForeignError, match=r'carrier=panle: is not in the file, did you mean "panel"\?'):
        imported(SAT_URDF, carrier="panle")
    with pytest.raises(ForeignError, match=r"fix=w1_spn: is no joint of the file, did you mean \"w1_spin\"\?"):
        make_stand(read(SAT_MJCF, None)[0], "m", "m", fix=["w1_spn"])


def test_without_mujoco(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setitem(sys.modules, "mujoco", None)
    for path in (SAT_URDF, SAT_MJCF, px4(tmp_path)):
        with pytest.raises(
            UsageError, match=rf'{path.name}: is read with mujoco, which is not there: pip install "mahovik\[import\]"'
        ):
            read(path, None)
