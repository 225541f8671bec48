"""Models as people have them: the stand, what is said and refused, the forces that MuJoCo and Pinocchio find."""

from __future__ import annotations

import json
import os
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from cli.run import refused, run
from foreign.judge import difference, names
from mahovik.core.stand.fields import name_problem
from mahovik.errors import ForeignError
from mahovik.laws.stop.law import Stops
from mahovik.laws.suspension.law import Suspension
from mahovik.out.foreign.model import Place, angles_of
from mahovik.out.foreign.original import compare, read
from mahovik.out.foreign.stand import ImportedStand, make_stand

MODELS = Path(__file__).parent / "models"
SAT_URDF, SAT_MJCF = (MODELS / f"sat.{suffix}" for suffix in ("urdf", "xml"))
TOLERANCE = 1e-12
"""Largest difference of forces and torques over the largest of them; MuJoCo's principal axes are good to about this."""


def imported(path: Path, gravity: Any = None, **options: Any) -> ImportedStand:
    """The stand of a file, which has the forces of MuJoCo's model of it, and those of Pinocchio's of a URDF."""
    model, original = read(path, gravity)
    made = make_stand(model, "imported", path.name, **options)
    differences = compare(made, original)
    assert differences
    assert max(differences.values()) < TOLERANCE, differences
    if path.suffix == ".urdf":
        assert difference(path, made) < TOLERANCE
    return made


def written(folder: Path, name: str, text: str) -> Path:
    (folder / name).write_text(text)
    return folder / name


def notes(made: ImportedStand) -> str:
    return "\n".join(made.notes)


# ---- satellites: every feature of URDF and MJCF that is read ----


@pytest.mark.parametrize("gravity", [None, np.array([0.3, -1.0, -9.81])])
@pytest.mark.parametrize("options", [{}, {"carrier": "panel"}, {"carrier": "body", "instruments": True}])
def test_a_urdf(options: dict[str, Any], gravity: Any) -> None:
    made = imported(SAT_URDF, gravity, **options)
    assert made.stand.gravity == ((0, 0, 0) if gravity is None else tuple(gravity))
    wheels = made.stand.flywheels
    assert [wheel.name for wheel in wheels] == ["wheel_1", "wheel2", "wheel3", "wheel4"]
    assert names(made.wheels) == ["wheel1_joint", "wheel2_joint", "wheel3_joint", "wheel4_joint"]
    assert wheels[0].inertia == ((0.0011, 0, 0), (0, 0.0006, 0), (0, 0, 0.0006))  # numbers of the file, to the last bit
    motor = wheels[0].motor
    assert motor is not None
    assert (motor.torque, motor.viscous, motor.coulomb, motor.speed) == (0.2, 1e-4, 2e-4, None)
    for words in ('"wheel 1" is called "wheel_1"', "velocity limit 600", "1 collision", "1 transmission"):
        assert words in notes(made)
    assert ("the format has no gravity" in notes(made)) == (gravity is None)


@pytest.mark.parametrize("options", [{}, {"carrier": "panel"}, {"instruments": True}])
def test_an_mjcf(options: dict[str, Any]) -> None:
    made = imported(SAT_MJCF, **options)
    stand = made.stand
    assert [wheel.name for wheel in stand.flywheels] == ["w1", "w2", "body6"]
    assert [point.name for point in stand.points] == ["imu", "tip"]
    assert stand.gravity == (0.1, 0.2, -3.7)
    assert stand.hold is None
    motors = [wheel.motor for wheel in stand.flywheels]
    assert [motor and (motor.torque, motor.viscous, motor.coulomb) for motor in motors] == [
        (0.2, 1e-5, 1e-4),  # control range times gear
        (None, 1e-5, 0.0),
        (0.5, 1e-5, 1e-4),  # the joint's own range
    ]
    for words in (
        'actuator "m2": a law of control',
        "equations: 2 geoms, 1 sensor",
        "no contacts: 7 geoms",
        "move of the world: table",
    ):
        assert words in notes(made)


def test_angles_sequences_and_includes(tmp_path: Path) -> None:
    """The file has radians, another sequence, wheels in a file of their own, and inertias of shapes."""
    text = SAT_MJCF.read_text().replace('angle="degree" eulerseq="xyz"', 'angle="radian" eulerseq="zyz"')
    start, end = text.index('<body name="w2"'), text.index('<body pos="0 -0.2 0"')
    written(tmp_path, "w2.xml", f"<mujocoinclude>{text[start:end]}</mujocoinclude>")
    path = written(tmp_path, "sat.xml", f'{text[:start]}<include file="w2.xml"/>{text[end:]}')
    assert [wheel.name for wheel in imported(path).stand.flywheels] == ["w1", "w2", "body6"]
    shapes = text.replace("<compiler ", '<compiler inertiafromgeom="true" ').replace(
        'size="0.2 0.2 0.2" mass="0"', 'size="0.2 0.2 0.2"'
    )
    shapes = shapes.replace('<inertial pos="0.012', '<geom size="0.03"/><inertial pos="0.012')
    assert imported(written(tmp_path, "shapes.xml", shapes)).stand.carrier.mass == pytest.approx(
        8 * 0.2**3 * 2700, rel=0.1
    )


def test_what_is_switched_off(tmp_path: Path) -> None:
    flags = '<option gravity="0.1 0.2 -3.7"><flag gravity="disable" damper="disable" frictionloss="disable"/></option>'
    path = written(tmp_path, "sat.xml", SAT_MJCF.read_text().replace('<option gravity="0.1 0.2 -3.7"/>', flags))
    stand = imported(path).stand
    assert stand.gravity == (0.0, 0.0, 0.0)
    assert [w.motor and (w.motor.viscous, w.motor.coulomb) for w in stand.flywheels] == [(0, 0), None, (0, 0)]


def test_files_of_shapes_need_not_be_there(tmp_path: Path) -> None:
    mesh = '<{0}><geometry><mesh filename="package://nowhere/a.dae"/></geometry></{0}>'
    text = SAT_URDF.read_text().replace(
        '<link name="panel">', '<link name="panel">' + mesh.format("visual") * 2 + mesh.format("collision")
    )
    assert imported(written(tmp_path, "sat.urdf", text)).stand.carrier.mass == pytest.approx(13.3)
    asset = (
        '<mesh name="m" file="nowhere.stl"/><texture name="t" type="2d" file="no.png"/><material name="k" texture="t"/>'
    )
    text = SAT_MJCF.read_text().replace("<worldbody>", f"<asset>{asset}</asset><worldbody>", 1)
    text = text.replace('<geom type="box" size="0.2 0.2 0.2" mass="0"/>', '<geom type="mesh" mesh="m" material="k"/>')
    assert imported(written(tmp_path, "sat.xml", text)).stand.carrier.mass == pytest.approx(22.16)
    shapes = '<geom size="0.1" mass="2"/><geom type="mesh" mesh="m" mass="0"/><geom type="mesh" mesh="m" density="0"/>'
    text = f"<asset>{asset}</asset><worldbody><body><freejoint/>{shapes}</body></worldbody>"
    assert imported(written(tmp_path, "bare.xml", f"<mujoco>{text}</mujoco>")).stand.carrier.mass == 2.0


# ---- what holds the carrier ----


def test_a_pendulum_with_a_reaction_wheel(tmp_path: Path) -> None:
    """Accelerations of MuJoCo at five states, with damping of the hinge, to 1e-13."""
    made = imported(MODELS / "pendulum.xml")
    stand = written(tmp_path, "pendulum.toml", made.text)
    known = json.loads((MODELS / "pendulum.json").read_text())
    answers = run("eval", str(stand), stdin="\n".join(map(json.dumps, known["states"]))).output.splitlines()
    for answer, expected in zip(map(json.loads, answers), known["qacc"], strict=True):
        assert [*answer["u_dot"], *answer["phi_ddot"]] == pytest.approx(expected, rel=1e-13)


CART = """<mujoco><compiler angle="{angle}"/>
<default><joint damping="0.3"/><default class="wheel"><joint damping="0" armature="2e-4"/></default></default>
<worldbody><body name="bar" pos="0 0 1"><joint name="{name}" {joint}/><geom size="0.1" mass="2"/>
<body name="w" pos="0 0 0.5"><joint class="wheel" name="spin" axis="0 1 0"/>
<geom type="cylinder" size="0.1 0.01" zaxis="0 1 0"/></body></body></worldbody></mujoco>"""


def test_a_joint_on_the_world_is_a_hold_with_springs_friction_and_stops(tmp_path: Path) -> None:
    joint = 'axis="0 1 0" range="-30 50" frictionloss="0.1" stiffness="4" springref="10" ref="5"'
    text = CART.format(angle="degree", name="h", joint=joint).replace('armature="2e-4"', "")
    made = imported(written(tmp_path, "m.xml", text))
    for part in ('freedoms = ["pitch"]', '[[hold.friction]]\nfreedom = "pitch"\ncoulomb = 0.1'):
        assert part in made.text
    stops = [law for law in made.stand.laws if type(law).__name__ == "Stops"]
    assert [(stop.at, stop.above) for stop in stops[0].items] == [
        pytest.approx((np.radians(-30), False)),
        pytest.approx((np.radians(50), True)),
    ]
    assert "its range is two stops, whose stiffness is chosen here" in notes(made)
    text = CART.format(angle="radian", name="rail", joint='type="slide" axis="0 0 -1" range="-0.2 0.3"')
    made = imported(written(tmp_path, "m.xml", text.replace('armature="2e-4"', "")))
    assert "slide = [0.0, 0.0, -1.0]" in made.text
    assert 'at = 0.3\nside = "above"' in made.text
    slides = 'type="slide" axis="1 0 0"/><joint type="slide" axis="0 1 0"/><joint'
    plane = f'{slides} name="turn" axis="0 0 -1" range="-10 40"'
    text = CART.format(angle="degree", name="x", joint=plane).replace('armature="2e-4"', "")
    turned = imported(written(tmp_path, "m.xml", text)).stand.law(Stops)
    assert turned is not None
    assert [stop.freedom for stop in turned.items] == [2, 2]  # yaw, which turns against the joint
    assert [stop.at for stop in turned.items] == pytest.approx(np.radians([-40, 10]))
    slides = 'type="slide" axis="1 0 0" damping="0.4"/><joint type="slide" axis="0 1 0" damping="0"/><joint'
    text = CART.format(angle="radian", name="x", joint=f'{slides} name="turn" axis="0 0 1" damping="2"')
    made = imported(written(tmp_path, "m.xml", text.replace('armature="2e-4"', "")))
    assert 'freedoms = ["x", "y", "yaw"]' in made.text
    assert "damping = [0.0, 0.0, 0.0, 0.0, 0.0, 2.0]" in made.text
    assert 'joint "x": damping left out: no law of a hold says it' in notes(made)
    text = CART.format(angle="radian", name="h", joint='axis="0 1 0" range="-3.1 3.1"')
    made = imported(written(tmp_path, "m.xml", text.replace('armature="2e-4"', "")))
    assert 'joint "h": range left out: no law of a hold says it' in notes(made)
    text = CART.format(angle="radian", name="b", joint='type="ball" range="0 1"').replace('armature="2e-4"', "")
    assert notes(imported(written(tmp_path, "m.xml", text))).count("range left out") == 1


def test_armature_is_refused_or_the_wheels(tmp_path: Path) -> None:
    path = written(tmp_path, "m.xml", CART.format(angle="radian", name="h", joint='type="free"'))
    with pytest.raises(ForeignError, match=r'joint "spin": armature 0\.0002 is inertia without a body: armature=wheel'):
        make_stand(read(path, None)[0], "m", "m.xml")
    made = imported(path, armature="wheel")
    assert "its spin turns the carrier, which that of the file does not" in notes(made)
    plain = imported(written(tmp_path, "plain.xml", path.read_text().replace('armature="2e-4"', "")))
    change = np.array(made.stand.flywheels[0].inertia) - np.array(plain.stand.flywheels[0].inertia)
    assert change == pytest.approx(np.diag([2e-4, 1e-4, 1e-4]), abs=1e-15)
    change = np.array(made.stand.carrier.inertia) - np.array(plain.stand.carrier.inertia)
    assert change == pytest.approx(np.diag([-1e-4, -2e-4, -1e-4]), abs=1e-15)
    text = path.read_text().replace('size="0.1" mass="2"', 'type="capsule" size="0.01 0.5" mass="2"')
    stick = written(tmp_path, "stick.xml", text.replace('armature="2e-4"', 'armature="1.5e-4"'))
    with pytest.raises(
        ForeignError, match=r'joint "spin": armature 0\.00015: a thin disc of it has more inertia in its'
    ):
        imported(stick, armature="wheel")


INERTIA = '<inertia ixx="{0}" ixy="0" ixz="0" iyy="{0}" iyz="0" izz="{0}"/>'


def link(name: str, mass: float = 1.0) -> str:
    inertial = f'<origin xyz="0 0.01 0"/><mass value="{mass}"/>{INERTIA.format(mass / 10)}'
    return f'<link name="{name}"><inertial>{inertial}</inertial></link>'


def joint(name: str, kind: str, parent: str, child: str, inside: str = "", axis: str = "0 0 1") -> str:
    ends = f'<parent link="{parent}"/><child link="{child}"/><origin xyz="0.1 0 0.2" rpy="0.1 0 0"/>'
    return f'<joint name="{name}" type="{kind}">{ends}<axis xyz="{axis}"/>{inside}</joint>'


def urdf(*parts: str) -> str:
    return f'<robot name="r">{"".join(parts)}</robot>'


HELD = {
    "hinge": ([joint("h", "continuous", "world", "bar", '<dynamics damping="0.4"/>', "0 1 0")], 'freedoms = ["pitch"]'),
    "welded": ([joint("h", "fixed", "world", "bar")], "freedoms = []"),
    "floating": ([joint("h", "floating", "world", "bar")], None),
    "slide": (
        [joint("h", "prismatic", "world", "bar", '<limit lower="-1" upper="2" effort="1" velocity="1"/>')],
        'freedoms = ["z"]',
    ),
    "on a base": (
        [joint("b", "fixed", "world", "base"), joint("h", "continuous", "base", "bar"), link("base")],
        'freedoms = ["yaw"]',
    ),
    "gimbals": (
        ['<link name="a"/><link name="b"/>', joint("h", "continuous", "world", "a").replace("0.1 0 0.2", "0 0 0")]
        + [
            f'<joint name="{n}" type="continuous"><parent link="{p}"/><child link="{c}"/><axis xyz="{a}"/></joint>'
            for n, p, c, a in (("i", "a", "b", "0 1 0"), ("j", "b", "bar", "1 0 0"))
        ],
        'freedoms = ["yaw", "pitch", "roll"]',
    ),
}


@pytest.mark.parametrize("kind", HELD)
def test_a_root_that_is_called_world_holds(kind: str, tmp_path: Path) -> None:
    joints, hold = HELD[kind]
    wheel = [link("bar"), link("w", 0.3), joint("spin", "continuous", "bar", "w")]
    made = imported(written(tmp_path, "m.urdf", urdf('<link name="world"/>', *joints, *wheel)))
    assert (hold in made.text) if hold else made.stand.hold is None
    assert [wheel.name for wheel in made.stand.flywheels] == ["w"]


# ---- vehicles ----

AXES = {"x": "1 0 0", "y": "0 1 0", "z": "0 0 1"}


def test_a_cubesat_with_a_triad_is_the_same_from_both_formats(tmp_path: Path) -> None:
    wheel = """<body name="w{0}" pos="{1}"><joint name="spin_{0}" axis="{1}"/>
    <inertial pos="0 1e-6 2e-6" mass="0.13" fullinertia="4e-5 5e-5 6e-5 1e-7 2e-7 3e-7"/></body>"""
    wheels = "".join(wheel.format(*fields) for fields in AXES.items())
    motors = "".join(f'<motor joint="spin_{axis}" ctrlrange="-4 4"/>' for axis in AXES)
    hub = '<inertial pos="0 0 0.001" mass="4" fullinertia="0.03 0.031 0.01 1e-4 0 2e-4"/>'
    mjcf = f"""<mujoco><option gravity="0 0 0"/><default><joint damping="1e-7"/><motor gear="1e-3"/></default>
    <worldbody><body name="hub"><freejoint/>{hub}{wheels}</body></worldbody><actuator>{motors}</actuator></mujoco>"""
    inertial = (
        '<inertial><origin xyz="{}"/><mass value="{}"/><inertia ixx="{}" iyy="{}" izz="{}" ixy="{}" ixz="{}" iyz="{}"/>'
    )
    links = f'<link name="hub">{inertial.format("0 0 0.001", 4, 0.03, 0.031, 0.01, 1e-4, 0, 2e-4)}</inertial></link>'
    body = inertial.format("0 1e-6 2e-6", 0.13, 4e-5, 5e-5, 6e-5, 1e-7, 2e-7, 3e-7)
    for axis, direction in AXES.items():
        inside = '<limit effort="0.004" velocity="800"/><dynamics damping="1e-7"/>'
        spun = joint(f"spin_{axis}", "continuous", "hub", f"w{axis}", inside, direction)
        spun = spun.replace('xyz="0.1 0 0.2" rpy="0.1 0 0"', f'xyz="{direction}"')
        links += f'<link name="w{axis}">{body}</inertial></link>{spun}'
    one = imported(written(tmp_path, "sat.xml", mjcf)).stand
    assert one == imported(written(tmp_path, "sat.urdf", urdf(links))).stand
    assert [wheel.motor and (wheel.motor.torque, wheel.motor.viscous) for wheel in one.flywheels] == [(0.004, 1e-7)] * 3


def hexacopter() -> str:
    """A URDF converted from SDF: an IMU with limits 0, 0; rotors with limits 1,000 turns apart; elements of SDF."""
    imu = joint("imu_joint", "revolute", "base", "imu", '<limit lower="0" upper="0" effort="0" velocity="0"/>')
    endless = '<limit lower="-1" upper="6284" effort="10" velocity="-1"/><pose>1 2 3 0 0 0</pose>'
    rotors = [
        link(f"rotor_{i}", 0.005) + joint(f"rotor_{i}_joint", "revolute", "base", f"rotor_{i}", endless)
        for i in range(6)
    ]
    rotors[2] = (
        rotors[2]
        .replace("<inertial>", '<origin xyz="0.2 0.1 0.08"/><mass value="99"/><inertial>')
        .replace("</link>", "<gravity>1</gravity></link>")
    )
    gazebo = "<gazebo><plugin/></gazebo><self_collide>0</self_collide>"
    return urdf(link("base", 0.68), link("imu", 0.015), imu, *rotors, gazebo)


def test_a_hexacopter(tmp_path: Path) -> None:
    path = written(tmp_path, "hex.urdf", hexacopter())
    model, original = read(path, None)
    made = make_stand(model, "hex", "hex.urdf")
    assert max(compare(made, original).values()) < TOLERANCE
    twin = path.read_text().replace('name="imu_joint" type="revolute"', 'name="imu_joint" type="fixed"')
    twin = twin.replace('type="revolute"', 'type="continuous"').replace('velocity="-1"', 'velocity="1"')
    assert difference(written(tmp_path, "twin.urdf", twin), made) < TOLERANCE
    assert made.stand.carrier.mass == pytest.approx(0.695)
    assert "velocity limit" not in notes(made)
    assert [wheel.name for wheel in made.stand.flywheels] == [f"rotor_{i}" for i in range(6)]
    for words in (
        "1 <mass> in <link>",
        "1 <gravity> in <link>",
        "6 <pose> in <joint>",
        "1 <self_collide> in <robot>",
        'warning: link "rotor_2": its <origin> is not read: the place of a link is that of its joint',
        'joint "imu_joint": its limits are equal: it is fixed at 0',
        "effect on the equations: 1 gazebo",
    ):
        assert words in notes(made), words


def test_equal_limits_fix_at_their_angle(tmp_path: Path) -> None:
    """The stand is that of the same bodies with the joint's turn in the place of the link."""
    limit = '<limit lower="0.7" upper="0.7" effort="1" velocity="1"/>'
    rest = (link("base"), link("w", 0.1), joint("spin", "continuous", "arm", "w"), link("arm"))
    path = written(tmp_path, "m.urdf", urdf(*rest, joint("j", "revolute", "base", "arm", limit)))
    model, original = read(path, None)
    made = make_stand(model, "m", "m.urdf")
    assert max(compare(made, original).values()) < TOLERANCE
    fixed = joint("j", "fixed", "base", "k")
    turned = '<joint name="k" type="fixed"><parent link="k"/><child link="arm"/><origin rpy="0 0 0.7"/></joint>'
    assert difference(written(tmp_path, "twin.urdf", urdf(*rest, fixed, '<link name="k"/>', turned)), made) < TOLERANCE
    text = f'<sdf version="1.9"><model name="m">{ARM}</model></sdf>'.replace("-2.3<", "0.8<")
    arm = imported(written(tmp_path, "arm.sdf", text)).stand.carrier
    assert arm.center_of_mass == pytest.approx((0, 0, -0.2 / 3))
    assert arm.inertia[0][2] == pytest.approx(0.0, abs=1e-15)
    range_ = '<joint name="spin" range="30 30"/>'
    text = CART.format(angle="degree", name="h", joint='type="free"')
    text = text.replace('<joint class="wheel" name="spin" axis="0 1 0"/>', range_)
    said = 'joint "spin": range 30 30 does not rise, and is none to MuJoCo'
    assert said in notes(imported(written(tmp_path, "m.xml", text)))


def test_efforts_that_are_no_limit(tmp_path: Path) -> None:
    for effort in ("-1", "0", "inf"):
        limit = f'<limit effort="{effort}" velocity="-1"/>'
        text = urdf(link("base"), link("w", 0.1), joint("spin", "continuous", "base", "w", limit))
        made = make_stand(read(written(tmp_path, "m.urdf", text), None)[0], "m", "m.urdf")
        assert made.stand.flywheels[0].motor is None
        assert f'joint "spin": effort {effort} is read as no limit of the torque' in notes(made)
    text = f'<sdf version="1.9"><model name="q">{BASE}{ROTOR.format(i=0, y=0.1)}</model></sdf>'
    made = imported(written(tmp_path, "m.sdf", text.replace("<effort>0<", "<effort>-1<")))
    assert made.stand.flywheels[0].motor is None
    assert "effort" not in notes(made)  # -1 is the default of SDF


def test_joints_of_a_urdf_that_mujoco_makes_of_others(tmp_path: Path) -> None:
    """A planar one is three of its own, a floating one makes its base the world."""
    wheel = (link("bar"), link("w", 0.3), joint("spin", "continuous", "bar", "w"))
    planar = joint("p", "planar", "world", "bar", '<limit effort="3" velocity="1"/>')
    made = imported(written(tmp_path, "m.urdf", urdf('<link name="world"/>', planar, *wheel)))
    assert '# "p" on the world.\n[hold]' in made.text
    assert "_T" not in made.text
    text = urdf('<link name="ground"/>', joint("f", "floating", "ground", "bar"), *wheel)
    model, original = read(written(tmp_path, "m.urdf", text), None)
    made = make_stand(model, "m", "m.urdf")
    assert max(compare(made, original).values()) < TOLERANCE
    assert 'link "ground": bears a floating joint, so that it is the world' in notes(made)


ROTOR = """<link name="rotor_{i}"><gravity>true</gravity><velocity_decay/>
<pose relative_to="hub">0.17 {y} 0.06 0 0 0.3</pose>
<inertial><mass>0.016</mass><inertia><ixx>3.8e-07</ixx><iyy>2.6e-05</iyy><izz>2.6e-05</izz></inertia></inertial></link>
<joint name="rotor_{i}_joint" type="revolute"><parent>base_link</parent><child>rotor_{i}</child>
<axis><xyz>0 0 1</xyz><limit><lower>-1e+16</lower><upper>1e+16</upper><effort>0</effort></limit>
<dynamics><spring_stiffness>0</spring_stiffness></dynamics></axis><physics><ode/></physics></joint>"""
BASE = """<link name="base_link"><inertial><pose>0.01 0 0.02 0 0 0.4</pose><mass>2</mass>
<inertia><ixx>0.022</ixx><ixy>0</ixy><ixz>0</ixz><iyy>0.025</iyy><iyz>0</iyz><izz>0.04</izz></inertia></inertial>
<visual name="v"><geometry/></visual></link>
<frame name="hub" attached_to="base_link"><pose>0 0 0.1 0 0 0.2</pose></frame>"""
LIGHT = "<inertial><mass>{}</mass><inertia><ixx>1e-3</ixx><iyy>1e-3</iyy><izz>1e-3</izz></inertia></inertial>"
ARM = f"""<link name="mount">{LIGHT.format(0.1)}</link>
<link name="camera"><pose>0 0 -0.1 0 0.2 0</pose>{LIGHT.format(0.2)}</link>
<joint name="pitch" type="revolute"><parent>mount</parent><child>camera</child><axis><xyz>0 -1 0</xyz>
<limit><lower>-2.3</lower><upper>0.8</upper></limit></axis></joint>"""


def px4(folder: Path) -> Path:
    """A vehicle that includes its base, and a gimbal, each a model in a folder beside its own."""
    rotors = "".join(ROTOR.format(i=i, y=y) for i, y in enumerate((-0.17, 0.17)))
    for name, inside in {
        "x_base": f"<pose>0 0 .24 0 0 0</pose><static>false</static>{BASE}{rotors}",
        "gimbal": ARM,
        "x": '<include merge="true"><uri>model://x_base</uri></include><include><uri>model://gimbal</uri><name>g</name>'
        '<pose relative_to="hub">0 0 0.26 0 0 3.14</pose></include><plugin/><joint name="attach" type="fixed">'
        "<parent>base_link</parent><child>g::mount</child></joint>",
    }.items():
        (folder / name).mkdir()
        file = "arm.sdf" if name == "gimbal" else "model.sdf"  # as Gazebo Classic's are
        written(folder / name, file, f'<sdf version="1.9"><model name="{name}">{inside}</model></sdf>')
    config = (
        '<model><sdf version="1.4">old.sdf</sdf><sdf version="1.10">arm.sdf</sdf><sdf version="1.9">o</sdf></model>'
    )
    written(folder / "gimbal", "old.sdf", "<sdf/>")
    written(folder / "gimbal", "model.config", config)
    return folder / "x" / "model.sdf"


def test_a_vehicle_of_the_px4_simulator(tmp_path: Path) -> None:
    path = px4(tmp_path)
    with pytest.raises(ForeignError, match=r'joint "g::pitch": turns from -2\.3 to 0\.8: .*; fix=g::pitch'):
        make_stand(read(path, None)[0], "x", "x.sdf")
    made = imported(path, fix=["g::pitch"])
    stand = made.stand
    assert made.carrier == "base_link"
    assert stand.carrier.mass == pytest.approx(2.3)
    assert [wheel.name for wheel in stand.flywheels] == ["rotor_0", "rotor_1"]
    assert [point.name for point in stand.points] == ["hub"]
    turned = np.array([[np.cos(0.2), -np.sin(0.2), 0], [np.sin(0.2), np.cos(0.2), 0], [0, 0, 1]])
    assert stand.flywheels[0].position == pytest.approx(turned @ [0.17, -0.17, 0.06] + [0, 0, 0.1])
    assert stand.points[0].angles == pytest.approx((0.2, 0, 0))
    camera = turned @ np.array([0, 0, 0.16]) + [0, 0, 0.1]
    centre = (2 * np.array([0.01, 0, 0.02]) + 0.1 * np.array([0, 0, 0.36]) + 0.2 * camera) / 2.3
    assert stand.carrier.center_of_mass == pytest.approx(centre)
    for words in ("2 physics", "1 plugin", 'joint "rotor_0_joint": effort 0 is read as no limit'):
        assert words in notes(made)
    assert "velocity_decay" not in notes(made)  # the file has it without numbers


def test_the_fluid_of_an_sdf_is_added_mass_of_the_carrier(tmp_path: Path) -> None:
    """Its matrix is in the frame of a link, about that origin: the energy of the fluid is that of the link's motion."""
    rng = np.random.default_rng(3)
    keys = [(i, j) for i in range(6) for j in range(i, 6)]
    root = rng.normal(size=(6, 6))
    A = root @ root.T
    numbers = {"xyzpqr"[i] + "xyzpqr"[j]: float(A[i, j]) for i, j in keys}
    fluid = "<pose>0 0 9 1 0 0</pose><fluid_added_mass>{}</fluid_added_mass></inertial>"
    fluid = fluid.format("".join(f"<{key}>{number!r}</{key}>" for key, number in numbers.items()))
    pose, fluid = (0.3, -0.1, 0.2, 0.4, -0.5, 0.6), LIGHT.format(1.5).replace("</inertial>", fluid)
    fin = f"""<link name="fin"><pose>{" ".join(map(str, pose))}</pose>{fluid}
    <velocity_decay><linear>0.1</linear></velocity_decay></link>
    <joint name="f" type="fixed"><parent>base_link</parent><child>fin</child></joint>"""
    path = written(tmp_path, "m.sdf", f'<sdf version="1.9"><model name="m">{BASE}{fin}</model></sdf>')
    made = imported(path)
    assert "fluid_added_mass is added_mass of the carrier" in notes(made)
    assert 'link "fin": velocity_decay, a damping in some engines, is left out' in notes(made)
    turned, arm = Rotation.from_euler("xyz", pose[3:]), np.array(pose[:3])
    for V in rng.normal(size=(4, 6)):
        v = turned.inv().apply([V[:3] + np.cross(V[3:], arm), V[3:]]).ravel()
        assert V @ np.array(made.stand.carrier.added_mass) @ V == pytest.approx(v @ A @ v, rel=1e-12)
    fluid = "<fluid_added_mass><xx>1</xx></fluid_added_mass></inertial>"
    wheel = ROTOR.format(i=0, y=0.1).replace("</inertial>", fluid)
    path = written(tmp_path, "w.sdf", f'<sdf version="1.9"><model name="m">{BASE}{wheel}</model></sdf>')
    assert 'link "rotor_0": fluid_added_mass left out: a flywheel has none' in notes(imported(path))


def test_what_sdf_says_where_the_file_does_not(tmp_path: Path) -> None:
    """SDF's default mass, the world's gravity, axes of old versions and a joint to the world with friction count."""
    sensor = '<link name="mast"/><joint name="m" type="fixed"><parent>base_link</parent><child>mast</child></joint>'
    held = """<joint name="post" type="revolute"><pose>0 0 -0.3 0 0 0.4</pose><parent>world</parent>
    <child>base_link</child><axis><xyz>1 0 0</xyz><limit><lower>-0.5</lower><upper>0.4</upper></limit>
    <dynamics><damping>0.2</damping><friction>0.1</friction><spring_stiffness>2</spring_stiffness>
    <spring_reference>0.1</spring_reference></dynamics></axis></joint>"""
    sun = "<include><uri>model://sun</uri></include>"
    ground = '<model name="ground"><static>1</static><link name="g"/></model>'
    text = f"{BASE}{ROTOR.format(i=0, y=0.1)}{sensor}{held}"
    model = f'<model name="q"><pose>1 2 3 0 0 0.5</pose>{text}</model>'
    path = written(
        tmp_path,
        "w.sdf",
        f'<sdf version="1.9"><world name="w">{ground}{sun}{model}</world></sdf>',
    )
    made = imported(path)
    assert made.stand.gravity == (0, 0, -9.8)
    assert made.stand.carrier.mass == pytest.approx(3.0)
    assert 'include "model://sun": left out of the world, since it is not there' in notes(made)
    assert 'link "mast": mass, ixx, iyy, izz not in the file: 1 kg, 1 kg m2, the defaults of SDF' in notes(made)
    hold = made.stand.hold
    assert hold is not None
    assert hold.position == pytest.approx((1, 2, 3))
    assert hold.pivot == pytest.approx((0, 0, -0.3))
    assert hold.freedoms[0].direction == pytest.approx((np.cos(0.4), np.sin(0.4), 0))
    spring = made.stand.law(Suspension)
    assert spring is not None
    home, relaxed = (Rotation.from_euler("ZYX", angles) for angles in (hold.angles, spring.angles))
    assert (home.inv() * relaxed).as_rotvec() == pytest.approx(0.1 * np.array(hold.freedoms[0].direction))
    frame = "<use_parent_model_frame>1</use_parent_model_frame>"
    for old in ('version="1.4"', 'version="1.6"'):
        text = path.read_text().replace('version="1.9"', old)
        if "1.6" in old:
            text = text.replace("1 0 0</xyz>", f"1 0 0</xyz>{frame}")
        hold = imported(written(tmp_path, "old.sdf", text)).stand.hold
        assert hold is not None
        assert hold.freedoms[0].direction == pytest.approx((1, 0, 0))


URDF, MJCF = str(MODELS / "sat.urdf"), str(MODELS / "sat.xml")


@pytest.fixture(autouse=True)
def somewhere(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)


def test_a_urdf_becomes_a_stand_that_is_checked_and_generated() -> None:
    said = run("new", URDF).output
    assert said.startswith("files: small_sat.toml\ncarrier base_link, 4 flywheels, 1 point\n")
    assert "agrees with MuJoCo's model of the file, but for what is said above, at 20 random states" in said
    assert "it is 0; --gravity 0,0,-9.81 gives one\n" in Path("small_sat.toml").read_text()
    assert os.listdir() == ["small_sat.toml"]
    assert run("check", "small_sat.toml").exit_code == 0
    assert run("generate", "small_sat.toml").exit_code == 0


def test_an_mjcf_too() -> None:
    said = run("new", MJCF, "-o", "new/other.toml", "--name", "other", "--instruments").output
    assert "carrier hub, 1 instrument, 3 flywheels, 2 points" in said
    assert run("check", "new/other.toml").output.startswith("other ")


def test_a_vehicle_of_several_files_from_its_own_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(px4(tmp_path).parent)
    said = run("new", "model.sdf", "--fix", "g::pitch", "--gravity", "0,0,-9.81").output
    assert said.startswith("files: x.toml\ncarrier base_link, 2 flywheels, 1 point\n")
    assert "gravity = [0.0, 0.0, -9.81]" in Path("x.toml").read_text()
    assert run("check", "x.toml").exit_code == 0


def test_nothing_is_overwritten() -> None:
    Path("small_sat.toml").write_text("mine")
    assert refused("new", URDF) == "error: small_sat.toml: exists already, nothing was written\n"
    assert Path("small_sat.toml").read_text() == "mine"


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (("no.urdf",), "no.urdf: no such file"),
        ((URDF, "-o", "sat.json"), "-o sat.json: expected a name that ends in .toml"),
        (("bench8", "-o", "sat.json"), "-o sat.json: expected a name that ends in .toml"),
        ((URDF, "--name", "a b"), '--name a b: "a b" is not a C identifier'),
        ((URDF, "--name", "math"), '--name math: "math" is the name of a standard header of C'),
        ((URDF, "--carrier", "wheel4"), "--carrier wheel4: turns"),
        ((URDF, "--gravity", "0,0,nan"), "--gravity 0,0,nan: expected three finite numbers"),
        ((MJCF, "--gravity", "0,0,1"), "--gravity: a model of MuJoCo has its own"),
        (("bench8", "--fix", "j"), "--fix: needs *.urdf or *.xml or *.mjcf or *.sdf"),
    ],
)
def test_refused(arguments: tuple[str, ...], said: str) -> None:
    text = refused("new", *arguments)
    assert said in text
    assert text.count("\n") == 1
    assert os.listdir() == []


def test_a_stand_that_disagrees_is_not_written(monkeypatch: pytest.MonkeyPatch) -> None:
    """Should the reading of a file be wrong, MuJoCo notices."""
    monkeypatch.setattr(Place, "point", lambda self, inside: self.origin + 1.01 * self.axes @ inside)
    said = refused("new", URDF, status=1)
    assert said.startswith("error: sat.urdf: the stand differs from MuJoCo's model, forces on the carrier by 0.")
    assert os.listdir() == []


def test_every_name_is_an_identifier_of_its_own() -> None:
    written = ["wheel 1", "wheel_1", "wheel/1", "1st", "колесо", "int", "carrier", "a" * 70, "a" * 71, "x_", "class"]
    places = "".join(f'<site name="{name}"/>' for name in written)
    text = f'<mujoco><worldbody><body><freejoint/><geom size="1"/>{places}</body></worldbody></mujoco>'
    Path("m.xml").write_text(text, encoding="utf-8")
    names = [point.name for point in make_stand(read(Path("m.xml"), None)[0], "m", "m.xml").stand.points]
    assert names[:5] == ["wheel_1", "wheel_1_2", "wheel_1_3", "_1st", "point"]
    assert len(set(names)) == len(written)
    assert [name_problem(name) for name in names] == [None] * len(names)
    assert "carrier" not in names


def test_angles_of_any_axes() -> None:
    """They give the rotation back, also at their singularity, where either of two may be anything."""
    rng = np.random.default_rng(3)
    for _ in range(500):
        psi, theta, phi = rng.uniform(-3, 3, 3)
        if rng.random() < 0.6:
            theta = rng.choice([-1, 1]) * (np.pi / 2 + 10.0 ** rng.uniform(-17, -1) * rng.choice([-1, 0, 1]))
        axes = np.asarray(Rotation.from_euler("ZYX", [psi, theta, phi]).as_matrix())
        again = Rotation.from_euler("ZYX", angles_of(axes)).as_matrix()
        assert np.abs(again - axes).max() < 1e-15 * 4
