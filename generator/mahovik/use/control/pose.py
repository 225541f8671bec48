"""The carrier's pose as coordinates q = (O1 in E0, psi, theta, phi), and plant states from a chart."""

from __future__ import annotations

from dataclasses import replace
from typing import cast

import numpy as np
from scipy.spatial.transform import Rotation

from mahovik.core.stand.model import Sequence, Stand, Vec3, Vec6
from mahovik.core.stand.state import State, rest_state
from mahovik.use.plan.array import Array
from mahovik.use.plan.forward import Chart

EULER: dict[Sequence, str] = {"ship": "ZYX", "aircraft": "YZX", "euler": "ZXZ"}
"""SciPy's names of the stand's sequences: about axes that turn along."""


def coordinates(sequence: Sequence, position: Array, attitude: Array, near: Array) -> Array:
    """q (M, 6; m, rad) of positions (M, 3) and quaternions (M, 4; w first), angles within half a turn of `near`."""
    angles = Rotation.from_quat(attitude[:, [1, 2, 3, 0]]).as_euler(EULER[sequence])
    wrapped = near[:, 3:] + np.remainder(angles - near[:, 3:] + np.pi, 2.0 * np.pi) - np.pi
    return np.hstack([position, wrapped])


def plant_state(stand: Stand, chart: Chart, y: Array, phi: Array, phi_dot: Array) -> State:
    """The state of a plant: y (12) of a chart, flywheels at phi, phi' (N each)."""
    at = chart.twists(y[None])
    a, b, c, w = Rotation.from_matrix(at.C[0]).as_quat().tolist()
    return replace(
        rest_state(stand),
        position=cast(Vec3, tuple(at.O1[0].tolist())),
        quaternion=(w, a, b, c),
        V=cast(Vec6, tuple(y[6:].tolist())),
        phi=tuple(phi.tolist()),
        phi_dot=tuple(phi_dot.tolist()),
    )
