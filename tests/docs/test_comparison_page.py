"""docs/limits.md: what it says of another tool's mechanics, where that can be tried."""

from __future__ import annotations

import mujoco
import numpy as np

from docs.pages import ROOT

PAGE = (ROOT / "docs" / "limits.md").read_text(encoding="utf-8")

ELLIPSOID = """<mujoco><option density="{}" gravity="0 0 0"/><worldbody><body><freejoint/>
<geom type="ellipsoid" size=".3 .1 .1" mass="12" fluidshape="ellipsoid"/></body></worldbody></mujoco>"""


def acceleration(density: float, speed: float) -> list[float]:
    """Acceleration of an ellipsoid that drifts ahead and to the side and is pushed to the side."""
    model = mujoco.MjModel.from_xml_string(ELLIPSOID.format(density))
    data = mujoco.MjData(model)
    data.qvel[:2] = speed, speed
    data.qfrc_applied[1] = 10.0
    mujoco.mj_forward(model, data)
    return list(data.qacc)


def test_added_mass_of_mujoco_has_no_inertia() -> None:
    """At rest water changes nothing of its motion; in motion it does, by the moment of Munk among others."""
    assert "only the terms in velocity, not the inertia" in PAGE
    assert acceleration(1000.0, 0.0) == acceleration(0.0, 0.0)
    assert np.abs(acceleration(1000.0, 1.0)[5]) > 1.0
    assert acceleration(0.0, 1.0)[5] == 0.0
