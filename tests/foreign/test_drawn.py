"""Random models: the stand of each format has the forces that MuJoCo and Pinocchio find in it, or in its twins."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import mujoco
import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from foreign.judge import difference, names
from mahovik.out.foreign.original import compare, read
from mahovik.out.foreign.stand import ImportedStand, make_stand

Array = np.ndarray


def numbers(values: Array) -> str:
    return " ".join(repr(float(x)) for x in values)


@dataclass(frozen=True)
class DrawnBody:
    """A body: its parent, place, angles; axis and anchor if it turns; mass, centre, principal axes, moments."""

    parent: int
    turns: bool
    position: Array
    angles: Array
    axis: Array
    anchor: Array
    mass: float
    center: Array
    principal: Array
    moments: Array


def random_bodies(rng: np.random.Generator, fixed: int, turning: int, anchors: bool) -> list[DrawnBody]:
    """Body 0 is the root; then those that are fixed, on any of them; then wheels, and a weight fixed on each."""
    bodies = [_body(rng, -1, False, 10.0, False)]
    bodies += [_body(rng, int(rng.integers(i + 1)), False, 2.0, False) for i in range(fixed)]
    for _ in range(turning):
        bodies.append(_body(rng, int(rng.integers(fixed + 1)), True, 0.5, anchors))
        bodies.append(_body(rng, len(bodies) - 1, False, 0.01, False))
    return bodies


def _body(rng: np.random.Generator, parent: int, turns: bool, scale: float, anchored: bool) -> DrawnBody:
    mass = scale * rng.uniform(0.2, 2)
    point = rng.uniform(0.05, 0.2, 3) ** 2 * mass  # second moments: sums of two are moments that a body can have
    axis = rng.normal(size=3) if rng.random() < 0.7 else np.eye(3)[rng.integers(3)] * rng.choice([-1.0, 1.0])
    return DrawnBody(
        parent,
        turns,
        rng.normal(size=3) * 0.3,
        rng.uniform(-3, 3, 3) if rng.random() < 0.8 else rng.choice([0, np.pi / 2, -np.pi / 2], 3),
        axis,
        rng.normal(size=3) * 0.05 * anchored,
        mass,
        rng.normal(size=3) * (0.01 if turns else 0.1),
        rng.uniform(-3, 3, 3),
        point.sum() - point,
    )


def urdf(bodies: list[DrawnBody]) -> str:
    """The bodies as a URDF text, free; without anchors, which it does not have."""
    lines = ['<robot name="drawn">']
    for i, body in enumerate(bodies):
        xx, yy, zz = body.moments
        lines.append(f'<link name="b{i}"><inertial>')
        lines.append(
            f'<origin xyz="{numbers(body.center)}" rpy="{numbers(body.principal)}"/><mass value="{body.mass!r}"/>'
        )
        lines.append(f'<inertia ixx="{xx}" ixy="0" ixz="0" iyy="{yy}" iyz="0" izz="{zz}"/></inertial></link>')
        if body.parent >= 0:
            kind = "continuous" if body.turns else "fixed"
            lines.append(f'<joint name="j{i}" type="{kind}"><parent link="b{body.parent}"/><child link="b{i}"/>')
            lines.append(f'<origin xyz="{numbers(body.position)}" rpy="{numbers(body.angles)}"/>')
            lines.append(f'<axis xyz="{numbers(body.axis)}"/></joint>')
    return "\n".join([*lines, "</robot>"])


def mjcf(bodies: list[DrawnBody], root: str = "<freejoint/>", zeros: Array | None = None) -> str:
    """The bodies as an MJCF text; `zeros`: references of the hinges."""

    def element(i: int) -> str:
        body = bodies[i]
        angles = " ".join(map(repr, map(float, Rotation.from_euler("xyz", body.angles).as_quat(scalar_first=True))))
        quat = Rotation.from_euler("xyz", body.principal).as_quat(scalar_first=True)
        place = f'pos="{numbers(body.position)}" quat="{angles}"' if i else ""
        joint = root if i == 0 else ""
        if body.turns:
            anchor = f'pos="{numbers(body.anchor)}"' + ("" if zeros is None else f' ref="{float(zeros[i])!r}"')
            joint = f'<joint name="j{i}" axis="{numbers(body.axis)}" {anchor}/>'
        inertial = f'pos="{numbers(body.center)}" quat="{numbers(quat)}" mass="{body.mass!r}"'
        inertial += f' diaginertia="{numbers(body.moments)}"'
        inside = "".join(element(k) for k, other in enumerate(bodies) if other.parent == i)
        return f'<body name="b{i}" {place}>{joint}<inertial {inertial}/>{inside}</body>'

    compiler = '<compiler angle="radian"/><option gravity="0 0 0"/>'
    return f"<mujoco>{compiler}<worldbody>{element(0)}</worldbody></mujoco>"


def sdf(bodies: list[DrawnBody], rng: np.random.Generator) -> str:
    """The bodies as an SDF text, links in any order; poses in the link below, in a frame on it, or in the model."""
    elements = []
    places: list[tuple[Array, Any]] = []
    for i, body in enumerate(bodies):
        turned = Rotation.from_euler("xyz", body.angles if i else np.zeros(3))
        origin, axes = places[body.parent] if i else (np.zeros(3), Rotation.identity())
        places.append((origin + axes.apply(body.position) if i else origin, axes * turned))
        pose = f"{numbers(body.position)} {numbers(body.angles)}"
        how = int(rng.integers(4)) if i else 3
        frame = ""
        if how == 0:
            placed = f'<pose relative_to="b{body.parent}">{pose}</pose>'
        elif how == 1:
            frame = f'<frame name="f{i}" attached_to="b{body.parent}"><pose>{pose}</pose></frame>'
            placed = f'<pose relative_to="f{i}"/>'
        elif how == 2:
            degrees = f"{numbers(body.position)} {numbers(np.degrees(body.angles))}"
            placed = f'<pose degrees="true" relative_to="b{body.parent}">{degrees}</pose>'
        else:
            quaternion = numbers(places[i][1].as_quat())
            placed = f'<pose rotation_format="quat_xyzw">{numbers(places[i][0])} {quaternion}</pose>'
        moments = "".join(
            f"<{key}>{x!r}</{key}>" for key, x in zip(("ixx", "iyy", "izz"), body.moments.tolist(), strict=True)
        )
        inertial = f"<pose>{numbers(body.center)} {numbers(body.principal)}</pose><mass>{body.mass!r}</mass>"
        elements.append(
            f'{frame}<link name="b{i}">{placed}<inertial>{inertial}<inertia>{moments}</inertia></inertial></link>'
        )
        if i:
            kind = str(rng.choice(["continuous", "revolute"])) if body.turns else "fixed"
            attribute, axis = "", body.axis
            if rng.random() < 0.3:
                attribute, axis = ' expressed_in="__model__"', places[i][1].apply(body.axis)
            turns = f"<axis><xyz{attribute}>{numbers(axis)}</xyz></axis>" if body.turns else ""
            elements.append(
                f'<joint name="j{i}" type="{kind}"><pose>{numbers(body.anchor)} 0 0 0</pose>'
                f"<parent>b{body.parent}</parent><child>b{i}</child>{turns}</joint>"
            )
    rng.shuffle(elements)
    return f'<sdf version="1.9"><model name="drawn">{"".join(elements)}</model></sdf>'


SEEDS = [*range(4), *(pytest.param(seed, marks=pytest.mark.slow) for seed in range(4, 60))]


def imported(path: Path, text: str, gravity: Array | None, **options: Any) -> tuple[ImportedStand, Any]:
    path.write_text(text)
    model, original = read(path, gravity)
    return make_stand(model, "drawn", path.name, **options), original


def sizes(seed: int) -> tuple[np.random.Generator, int, int, dict[str, Any]]:
    """Numbers of fixed and of turning bodies; any fixed body as the carrier, instruments or not."""
    rng = np.random.default_rng(seed)
    fixed, turning = int(rng.integers(5)), int(rng.integers(1, 6))
    return rng, fixed, turning, {"carrier": f"b{rng.integers(fixed + 1)}", "instruments": bool(rng.integers(2))}


@pytest.mark.parametrize("seed", SEEDS)
def test_urdf(seed: int, tmp_path: Path) -> None:
    rng, fixed, turning, options = sizes(seed)
    text = urdf(random_bodies(rng, fixed, turning, False))
    made, original = imported(tmp_path / "drawn.urdf", text, rng.normal(size=3) * 9, **options)
    assert len(made.stand.flywheels) == turning
    assert difference(tmp_path / "drawn.urdf", made, 5, seed) < 1e-13
    assert max(compare(made, original, 5, seed).values()) < 1e-12


@pytest.mark.parametrize("seed", SEEDS)
def test_mjcf(seed: int, tmp_path: Path) -> None:
    rng, fixed, turning, options = sizes(1000 + seed)
    bodies = random_bodies(rng, fixed, turning, True)
    zeros = rng.uniform(-3, 3, len(bodies))
    made, original = imported(tmp_path / "drawn.xml", mjcf(bodies, zeros=zeros), None, **options)
    assert len(made.stand.flywheels) == turning
    assert max(compare(made, original, 5, seed).values()) < 1e-12


@pytest.mark.parametrize("seed", SEEDS)
def test_sdf(seed: int, tmp_path: Path) -> None:
    """The same bodies as SDF and MJCF, and without anchors as URDF, give one stand."""
    rng, fixed, turning, options = sizes(2000 + seed)
    for anchors in (True, False):
        bodies = random_bodies(rng, fixed, turning, anchors)
        made, original = imported(tmp_path / "drawn.sdf", sdf(bodies, rng), None, **options)
        assert len(made.stand.flywheels) == turning
        (tmp_path / "twin.xml").write_text(mjcf(bodies))
        _, twin = read(tmp_path / "twin.xml", None)
        assert max(compare(made, twin, 5, seed).values()) < 1e-12
        assert max(compare(made, original, 5, seed).values()) < 1e-12
    (tmp_path / "twin.urdf").write_text(urdf(bodies))
    assert difference(tmp_path / "twin.urdf", made, 5, seed) < 1e-12


HELD = {
    "hinge": (
        '<joint name="h" axis="1 2 2" pos="0.1 0 0.2" damping="0.3" stiffness="2" springref="0.2" ref="0.4"/>',
        1,
    ),
    "hinge against an axis": ('<joint name="h" axis="0 -1 0" damping="0.3" armature="0.2"/>', 1),
    "slide": ('<joint name="s" type="slide" axis="0 1 1" damping="3" stiffness="9" springref="-0.1" armature="2"/>', 1),
    "ball": ('<joint name="b" type="ball" pos="0 0.1 0" damping="0.4" stiffness="3" armature="0.3"/>', 3),
    "two slides": (
        '<joint name="x" type="slide" axis="1 0 0" damping="2" stiffness="3"/>'
        '<joint name="z" type="slide" axis="0 0 -1"/>',
        2,
    ),
    "plane": (
        '<joint name="x" type="slide" axis="1 0 0"/><joint name="y" type="slide" axis="0 1 0"/>'
        '<joint name="h" axis="0 0 1" pos="0.1 0 0" damping="0.2"/>',
        3,
    ),
    "along and about": (
        '<joint name="x" type="slide" axis="1 0 0" stiffness="3" damping="1"/>'
        '<joint name="h" axis="1 0 0" damping="2"/>',
        2,
    ),
    "three hinges": (
        '<joint name="h" axis="0 0 1" pos="0 0 0.1"/><joint name="i" axis="0 1 0" pos="0 0 0.1"/>'
        '<joint name="j" axis="1 0 0" pos="0 0 0.1"/>',
        3,
    ),
    "six": (
        '<joint name="x" type="slide" axis="1 0 0"/><joint name="y" type="slide" axis="0 1 0"/>'
        '<joint name="z" type="slide" axis="0 0 1"/><joint name="b" type="ball"/>',
        6,
    ),
    "free with damping": ('<joint type="free" name="f" damping="0.4" armature="0.2"/>', 6),
    "free with a spring": ('<joint type="free" name="f" damping="0.4" stiffness="3"/>', 6),
    "welded": ("", 0),
}


@pytest.mark.parametrize("kind", HELD)
def test_held(kind: str, tmp_path: Path) -> None:
    """Stands with any joints to the world agree with MuJoCo, springs and damping included."""
    joints, count = HELD[kind]
    rng = np.random.default_rng(7)
    text = mjcf(random_bodies(rng, 2, 3, True), joints).replace('gravity="0 0 0"', 'gravity="1 2 -9"')
    text = text.replace('<body name="b0" >', '<body name="b0" pos="0.3 0.2 1" quat="0.5 0.1 0.7 -0.3">')
    for carrier in ("b0", "b2"):
        made, original = imported(tmp_path / "held.xml", text, None, carrier=carrier)
        hold = made.stand.hold
        assert (6 if hold is None else len(hold.freedoms)) == count
        if hold is not None:  # home is where the coordinates are zero
            turning = [joint for joint in names(made.held) if original.joint(joint).type[0] != 1]
            data = mujoco.MjData(original)
            for joint in turning:
                data.joint(joint).qpos[:] = 0.0
            mujoco.mj_kinematics(original, data)
            assert hold.position == pytest.approx(data.body(carrier).xpos, abs=1e-14)
            home = Rotation.from_euler("ZYX", hold.angles).as_matrix()
            assert home.ravel() == pytest.approx(data.body(carrier).xmat, abs=1e-14)
        differences = compare(made, original)
        assert len(differences) == (2 if count else 1)
        assert max(differences.values()) < 1e-12, differences
