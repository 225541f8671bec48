"""What files say, in SI, by the definitions of units and of data sheets.

1 rpm is `2 pi / 60` rad/s, 1 g mm is `1e-6` kg m, 1 g cm^2 is `1e-7` kg m2. A static unbalance `U` at the angle `a`
from axis 2 puts the centre of mass at `U / m (0, cos a, sin a)`; a dynamic one is `J12 = -U cos b`, `J13 = -U sin b`.

In a URDF `rpy` turns about the fixed x, then y, then z. A box turned by 90 degrees about z exchanges its first two
moments; one that is fixed at the distance `d` along x adds `m d^2` about y and z, and moves the centre of mass.
"""

from __future__ import annotations

from math import cos, pi, radians, sin
from pathlib import Path

import numpy as np
import pytest

import mahovik
from by_hand.stands import stand, wheel
from mahovik.core.motion.regime import loads_regime
from mahovik.core.stand.summary import summarize
from mahovik.core.stand.units import ANGLE, INERTIA, SPEED, STATIC_UNBALANCE, TORQUE, Dimension, number
from mahovik.out.foreign.original import read
from mahovik.out.foreign.stand import make_stand


@pytest.mark.parametrize(
    ("text", "dimension", "value"),
    [
        ("3000 rpm", SPEED, 100 * pi), ("2 deg/s", SPEED, pi / 90), ("90 deg", ANGLE, pi / 2),
        ("5 g mm", STATIC_UNBALANCE, 5e-6), ("12 g cm^2", INERTIA, 12e-7), ("3 mN m", TORQUE, 3e-3),
        ("2 arcsec", ANGLE, pi / 324000), ("40 mN/(rad/s)^2", Dimension("", "N/(rad/s)^2"), 0.04),
    ],
)  # fmt: skip
def test_units(text: str, dimension: Dimension, value: float) -> None:
    assert number(text, dimension) == pytest.approx(value, rel=1e-15)


def test_unbalance_of_a_data_sheet() -> None:
    a, b = radians(30.0), radians(100.0)
    unbalance = {"static": "6 g mm", "static_at": "30 deg", "dynamic": "4 g cm^2", "dynamic_at": "100 deg"}
    unbalanced = stand(wheel("w", transverse_inertia=0.011, unbalance=unbalance))
    spun = unbalanced.flywheels[0]
    assert spun.center_of_mass == pytest.approx((0.0, 3e-6 * cos(a), 3e-6 * sin(a)))
    J = np.array(spun.inertia)
    assert [J[0, 1], J[0, 2], J[1, 2]] == pytest.approx([-4e-7 * cos(b), -4e-7 * sin(b), 0.0], abs=1e-22)
    row = summarize(unbalanced, 100 * pi).unbalance[0]
    assert (row.static_at, row.dynamic_at) == pytest.approx((a, b))


def test_laws_of_a_regime() -> None:
    text = """
schema = 1
[flywheel.a]
phase = "30 deg"
ramp = { from = "60 rpm", to = "180 rpm", duration = "2 s", start = "1 s" }
[flywheel.b]
harmonic = { mean = 3, amplitude = 2, frequency = "0.25 Hz", phase = "90 deg" }
"""
    regime = loads_regime(text, stand(wheel("a"), wheel("b")), 4.0)
    phi, phi_dot, phi_ddot = regime.motion(np.array([0.0, 1.0, 2.0, 4.0]))
    w = 2 * pi
    assert regime.flywheels[0].phase == pytest.approx(pi / 6)
    assert phi_dot[:, 0] == pytest.approx([w, w, 2 * w, 3 * w])
    assert phi[:, 0] == pytest.approx([0.0, w, 2.5 * w, 8.0 * w])
    assert phi_ddot[2, 0] == pytest.approx(w)
    assert phi_dot[:, 1] == pytest.approx([5.0, 3.0, 1.0, 5.0])
    assert phi[:, 1] == pytest.approx([0.0, 3.0 + 4 / pi, 6.0, 12.0])


URDF = """
<robot name="box">
<link name="body"><inertial><origin rpy="0 0 1.5707963267948966"/><mass value="4"/>
<inertia ixx="0.1" iyy="0.2" izz="0.25" ixy="0" ixz="0" iyz="0"/></inertial></link>
<link name="far"><inertial><mass value="1"/>
<inertia ixx="0.01" iyy="0.01" izz="0.01" ixy="0" ixz="0" iyz="0"/></inertial></link>
<joint name="fixed" type="fixed"><parent link="body"/><child link="far"/><origin xyz="0.5 0 0"/></joint>
<link name="wheel"><inertial><mass value="0.5"/>
<inertia ixx="0.001" iyy="0.001" izz="0.002" ixy="0" ixz="0" iyz="0"/></inertial></link>
<joint name="spin" type="continuous"><parent link="body"/><child link="wheel"/>
<origin xyz="0 0 0.2" rpy="1.5707963267948966 0 0"/><axis xyz="0 0 1"/>
<dynamics damping="2e-5" friction="3e-3"/><limit effort="0.1" velocity="100"/></joint>
</robot>
"""


def test_a_urdf_by_its_definition(tmp_path: Path) -> None:
    (tmp_path / "box.urdf").write_text(URDF)
    box = make_stand(read(tmp_path / "box.urdf", None)[0], "box", "box.urdf").stand
    assert box.carrier.mass == 5.0
    assert box.carrier.center_of_mass == pytest.approx((0.1, 0.0, 0.0))
    apart = 4 * 0.1**2 + 1 * 0.4**2  # about the common mass centre
    about = np.diag(np.array(box.carrier.inertia))
    about = about if box.carrier.inertia_about == "center_of_mass" else about - 5 * np.array([0, 0.01, 0.01])
    assert about == pytest.approx([0.21, 0.11 + apart, 0.26 + apart])
    spun = box.flywheels[0]
    place = summarize(box).bodies[1].center_of_mass
    assert place == pytest.approx((0.0, 0.0, 0.2))
    assert np.diag(np.array(spun.inertia)) == pytest.approx([0.002, 0.001, 0.001])
    axis = np.array(getattr(spun.mounting, "axis", ()))
    assert axis == pytest.approx([0.0, -1.0, 0.0], abs=1e-15)
    assert spun.motor is not None
    assert (spun.motor.viscous, spun.motor.coulomb, spun.motor.torque) == (2e-5, 3e-3, 0.1)


def test_a_stand_that_is_written_reads_back(tmp_path: Path) -> None:
    """Every key of a wheel, and what a mounting by angles has beside one by axes."""
    more = {
        "motor": {"torque": 0.2, "speed": 300, "constant": 0.05, "coulomb": 0.003, "viscous": 2e-5, "coulomb_speed": 2},
        "encoder": {"counts": 4096, "zero": 7, "latency": 3e-4}, "inverse_weight": 2.0, "wrench_input": True,
    }  # fmt: skip
    by_angles = {key: value for key, value in wheel("b", angles=[0.1, 0.2, 0.3]).items() if key not in ("axis", "zero")}
    written = stand(
        wheel("a", position=[0.1, 0.2, 0.3], **more), by_angles, point=[{"name": "p", "position": [1, 2, 3]}]
    )
    written.save(tmp_path / "hand.toml")
    again = mahovik.load(tmp_path / "hand.toml")
    assert (again.carrier, again.flywheels, again.points) == (written.carrier, written.flywheels, written.points)
