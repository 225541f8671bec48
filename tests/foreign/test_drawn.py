"""Random models: the stand has the dynamics that Pinocchio and MuJoCo find in the file."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from mahovik.out.foreign.agreement import MujocoOriginal, PinocchioOriginal, agreement
from mahovik.out.foreign.merge import make_stand
from mahovik.out.foreign.mjcf import compile_model, read_mjcf
from mahovik.out.foreign.urdf import read_urdf
from mahovik.out.foreign.write import stand_file

Array = np.ndarray


def numbers(values: Array) -> str:
    return " ".join(repr(float(x)) for x in values)


@dataclass(frozen=True)
class DrawnBody:
    """A body: number of its parent, place, angles, axis if it turns; mass, centre, principal axes and moments."""

    parent: int
    turns: bool
    position: Array
    angles: Array
    axis: Array
    mass: float
    center: Array
    principal: Array
    moments: Array


def random_bodies(rng: np.random.Generator, fixed: int, turning: int) -> list[DrawnBody]:
    """Body 0 is the root; then those that are fixed, on any of them; then wheels, and a weight fixed on each."""
    found = [_body(rng, -1, False, 10.0)]
    found += [_body(rng, int(rng.integers(i + 1)), False, 2.0) for i in range(fixed)]
    for _ in range(turning):
        found.append(_body(rng, int(rng.integers(fixed + 1)), True, 0.5))
        found.append(_body(rng, len(found) - 1, False, 0.01))
    return found


def _body(rng: np.random.Generator, parent: int, turns: bool, scale: float) -> DrawnBody:
    mass = scale * rng.uniform(0.2, 2)
    point = rng.uniform(0.05, 0.2, 3) ** 2 * mass  # second moments: sums of two are moments that a body can have
    axis = rng.normal(size=3) if rng.random() < 0.7 else np.eye(3)[rng.integers(3)] * rng.choice([-1.0, 1.0])
    return DrawnBody(
        parent,
        turns,
        rng.normal(size=3) * 0.3,
        rng.uniform(-3, 3, 3) if rng.random() < 0.8 else rng.choice([0, np.pi / 2, -np.pi / 2], 3),
        axis,
        mass,
        rng.normal(size=3) * (0.01 if turns else 0.1),
        rng.uniform(-3, 3, 3),
        point.sum() - point,
    )


def urdf(bodies: list[DrawnBody]) -> str:
    """The bodies as a URDF text."""
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


def mjcf(bodies: list[DrawnBody], rng: np.random.Generator) -> str:
    """The bodies as an MJCF text, with anchors and references of hinges."""

    def element(i: int) -> str:
        body = bodies[i]
        quat = Rotation.from_euler("xyz", body.principal).as_quat(scalar_first=True)
        place = f'pos="{numbers(body.position)}" euler="{numbers(body.angles)}"'
        joint = "<freejoint/>" if i == 0 else ""
        if body.turns:
            anchor = f'pos="{numbers(rng.normal(size=3) * 0.05)}" ref="{float(rng.uniform(-3, 3))!r}"'
            joint = f'<joint name="j{i}" axis="{numbers(body.axis)}" {anchor}/>'
        inertial = f'pos="{numbers(body.center)}" quat="{numbers(quat)}" mass="{body.mass!r}"'
        inertial += f' diaginertia="{numbers(body.moments)}"'
        inside = "".join(element(k) for k, other in enumerate(bodies) if other.parent == i)
        return f'<body name="b{i}" {place}>{joint}<inertial {inertial}/>{inside}</body>'

    return f'<mujoco><compiler angle="radian"/><worldbody>{element(0)}</worldbody></mujoco>'


SEEDS = [*range(4), *(pytest.param(seed, marks=pytest.mark.slow) for seed in range(4, 60))]


def options(rng: np.random.Generator, fixed: int) -> dict[str, Any]:
    """Any fixed body as the carrier, instruments or not."""
    return {"carrier": f"b{rng.integers(fixed + 1)}", "instruments": bool(rng.integers(2))}


@pytest.mark.parametrize("seed", SEEDS)
def test_urdf(seed: int, tmp_path: Path) -> None:
    rng = np.random.default_rng(seed)
    fixed, turning = int(rng.integers(5)), int(rng.integers(1, 6))
    path = tmp_path / "drawn.urdf"
    path.write_text(urdf(random_bodies(rng, fixed, turning)))
    found = make_stand(read_urdf(path), "drawn", path.name, gravity=rng.normal(size=3) * 9, **options(rng, fixed))
    stand_file(found, path.name, "")
    errors = agreement(found, PinocchioOriginal(path, found, False), 5, seed)
    assert len(found.stand.flywheels) == turning
    assert max(errors.values()) < 1e-11, errors
    assert max(errors[name] for name in ("K", "I", "bias", "tau")) < 1e-13, errors


@pytest.mark.parametrize("seed", SEEDS)
def test_mjcf(seed: int, tmp_path: Path) -> None:
    rng = np.random.default_rng(1000 + seed)
    fixed, turning = int(rng.integers(5)), int(rng.integers(1, 6))
    path = tmp_path / "drawn.xml"
    path.write_text(mjcf(random_bodies(rng, fixed, turning), rng))
    found = make_stand(read_mjcf(path), "drawn", path.name, **options(rng, fixed))
    stand_file(found, path.name, "")
    errors = agreement(found, MujocoOriginal(compile_model(path), found, True), 5, seed)
    assert len(found.stand.flywheels) == turning
    assert max(errors.values()) < 1e-11, errors
    assert max(errors[name] for name in ("K", "I", "bias", "tau")) < 1e-12, errors
