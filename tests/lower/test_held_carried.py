"""Steps of a held carrier with a carry: its pivot stays through very many short steps in float, far from the origin."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest

from lower.in_place import end_of_steps
from mahovik.core.stand.hold import FREEDOMS, twist_of
from mahovik.core.stand.model import Hold, Stand, State, rest_state
from mahovik.core.stand.stand_file import loads
from mahovik.proof.verify.c_backend import CBackend
from toolchain.quick import quick
from verify.holds import PENDULUM

PIVOT = (0.25, 0.0, -0.5)
FAR = (96.3, -70.1, 50.7)
HOLDS = {"hinge": ("pitch",), "plane": ("x", "z", "pitch"), "ball joint": ("roll", "pitch", "yaw")}


STEPS = 20_000
ULP = float(np.spacing(np.float32(96.3)))
"""m"""


@cache
def stand_of(name: str) -> Stand:
    hold = Hold(tuple(FREEDOMS[way] for way in HOLDS[name]), PIVOT, (0.0,) * 3, (0.0,) * 3)
    return replace(loads(PENDULUM), hold=hold)


@cache
def backend(name: str) -> CBackend:
    return CBackend(stand_of(name), "float")


def start(name: str) -> State:
    hold = stand_of(name).hold
    assert hold is not None
    u = (0.9, -1.3, 0.7)[: len(HOLDS[name])]
    x, y, z = (float(np.float32(a)) for a in FAR)
    upright = replace(rest_state(stand_of(name)), position=(x, y, z), quaternion=(1.0, 0.0, 0.0, 0.0))
    return replace(upright, u=u, V=twist_of(hold, u))


def pivot(x: dict[str, Any]) -> np.ndarray:
    """Place of the pivot in E0, m."""
    w, v, r = x["attitude"][0], x["attitude"][1:], np.array(PIVOT)
    return np.asarray(x["position"] + r + 2 * np.cross(v, np.cross(v, r) + w * r))


def wandered(name: str) -> np.ndarray:
    """How far the pivot went in half a second of very many steps, m."""
    end = end_of_steps(backend(name), "step", start(name), 0.5, STEPS, carried=True)
    return np.asarray(pivot(end) - np.array(start(name).position) - np.array(PIVOT))


@pytest.mark.parametrize("name", quick(1, ["hinge", "ball joint"]))
def test_the_pivot_stays_within_the_place_of_a_float(name: str) -> None:
    """A unit in the last place of a float 96 m away is 7.6e-6 m; 20,000 roundings of it would be far more."""
    assert np.abs(wandered(name)).max() < 0.75 * ULP
