"""Designs of held carriers: one flywheel for one freedom, derivatives, what no design can do."""

from __future__ import annotations

import json
from typing import Any

import numpy as np
import pytest

from mahovik.core.motion.required import RequiredMotion, read_motion
from mahovik.core.stand import loads
from mahovik.core.stand.model import Stand
from mahovik.core.stand.write import dumps
from mahovik.errors import DesignError, MahovikError
from mahovik.use.design import DesignOptions, design_stand, freedom_of_keys
from mahovik.use.design.read import read_freedom
from mahovik.use.design.task import Design, Task, Weighing
from mahovik.use.plan.problem import Periodic

RAIL = """
schema = 1
name = "rail"
gravity = [0, 0, -9.81]
[carrier]
mass = 6.0
inertia = [0.05, 0.06, 0.07]
[hold]
freedoms = ["z"]
[suspension]
stiffness = [0, 0, 20000, 0, 0, 0]
damping = [0, 0, 40, 0, 0, 0]
"""
WHEEL = """
[[flywheel]]
name = "{name}"
position = ["10 mm", "{y} mm", "20 mm"]
axis = [1, 0, 0]
zero = [0, 0, 1]
mass = 0.5
spin_inertia = 0.01
transverse_inertia = 0.006
unbalance = {{ static = "{unbalance} kg mm" }}
"""
KEYS = (
    'schema = 1\nspeed = [-1, 1]\nharmonics = 1\n{number}\n[[free]]\nunbalance = {{ min = 0, max = "{most} kg mm" }}\n'
)


def rail(text: str = RAIL, unbalance: float = 1.0) -> Stand:
    """A shaker on a rail with two exciters across it."""
    wheels = "".join(WHEEL.format(name=name, y=y, unbalance=unbalance) for name, y in (("left", 60), ("right", -60)))
    return loads(text + wheels)


def motion(own: Stand, rows: dict[str, list[float]], **keys: Any) -> RequiredMotion:
    document = {"schema": 1, "type": "periodic", "period": 0.05, "harmonics": [{"k": 1, **rows}], "winding": "any"}
    return read_motion(json.dumps(document | keys), own, "m.json")


def up_and_down(own: Stand) -> RequiredMotion:
    """0.3 mm along the rail at 20 Hz."""
    return motion(own, {"cos": [3e-4]})


@pytest.mark.slow
def test_one_flywheel_is_enough_for_one_freedom() -> None:
    """The hold takes the force across the rail, so one wheel does, at constant speed, with the unbalance of the closed
    formula: mu Omega^2 = |k - m Omega^2 + i d Omega| A.
    """
    own = rail()
    freedom = read_freedom(KEYS.format(number="number = [1, 2]", most=3), own)
    found = design_stand(own, up_and_down, freedom, DesignOptions(starts=4))
    assert (found.status, found.words) == ("OK", ())
    assert found.stand is not None and found.programme is not None
    assert [wheel.name for wheel in found.stand.flywheels] == ["left"]
    assert found.programme.report["verified"] is True and found.programme.coordinates == ("z",)
    Omega = 2 * np.pi * 20
    needed = 3e-4 * abs(20000 - 6.5 * Omega**2 + 40j * Omega) / Omega**2
    assert found.totals["after"]["unbalance"] == pytest.approx(needed, rel=1e-6)
    assert found.programme.report["harmonics"] == 0
    assert loads(dumps(found.stand)) == found.stand


@pytest.mark.parametrize(
    ("hold", "rows"),
    [
        ('freedoms = ["x", "z", "pitch"]', {"cos": [3e-4, 1e-4, 0.01], "sin": [1e-4, 0.0, 0.02]}),
        ('freedoms = ["roll", "pitch", "yaw"]\npivot = [0, 0, 0.1]', {"cos": [0.01, 0.02, 0.0]}),
    ],
)
def test_rows_have_the_derivatives_of_differences(hold: str, rows: dict[str, list[float]]) -> None:
    """Derivatives by the numbers of the stand, the angles of the programme, and the free mean pose."""
    own = rail(RAIL.replace('freedoms = ["z"]', hold))
    required = motion(own, rows, free_mean=[True] * len(next(iter(rows.values()))))
    task = Task.of(own, required, freedom_of_keys("position,angles,unbalance,mass", own))
    rng = np.random.default_rng(7)
    course = Periodic(required.span, np.array([1.0, -1.0]), rng.normal(size=(2, 3)), np.zeros(task.start.rows_count))
    design = Design(task.space.random(rng), course)
    J, z = task.jacobian(design, Weighing()), task.pack(design)
    assert task.rows(design, Weighing()).shape == (len(J),) and J.shape[1] == len(z)
    for k, e in enumerate(1e-6 * np.eye(len(z))):
        around = [task.rows(task.unpack(z + sign * e, course), Weighing()) for sign in (1.0, -1.0)]
        D = (around[0] - around[1]) / 2e-6
        rounding = 1e-9 * abs(around[0]).max()
        assert abs(J[:, k] - D).max() <= 2e-5 * max(abs(D).max(), 1e-3) + rounding, k


@pytest.mark.parametrize(
    ("text", "most", "words"),
    [
        (RAIL, 0.7, r"along z it needs a first moment of \+-.* from the flywheels; their largest total unb"),
        (RAIL.partition("[suspension]")[0], 3.0, "a force along z of .* N has no support in the mean"),
        (RAIL.replace('["z"]', "[]"), 3.0, "no freedoms: clamped, the carrier makes no motion that could be planned"),
        (
            RAIL.replace('freedoms = ["z"]', "basis = [[1, 0, 0, 0, 0, 0], [0, 0, 0, 0, 0, 1]]"),
            3.0,
            "no coordinates of a motion to be planned",
        ),
    ],
)
def test_what_no_design_can_do_is_refused(text: str, most: float, words: str) -> None:
    own = rail(text)
    freedom = read_freedom(KEYS.format(number="", most=most), own)
    with pytest.raises(MahovikError, match=words) as refused:
        design_stand(own, up_and_down, freedom)
    assert str(refused.value).count("\n") == 0
    assert isinstance(refused.value, DesignError) == (own.hold is not None and len(own.hold.freedoms) == 1)
