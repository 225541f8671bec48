"""Tasks in the stand file: what is read, refused, written back, and what the identities depend on."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

import mahovik
from mahovik.core.stand import dumps, identities, loads, structure
from mahovik.core.stand.coordinates import places_of, row_vector
from mahovik.core.stand.model import Task, TaskRow
from mahovik.core.stand.random import EVERYTHING, random_stand
from mahovik.core.stand.summary import TaskSummary, summarize
from mahovik.proof.reference.motion import point_transfers

STAND = """
schema = 1
name = "s"
[carrier]
mass = 3
inertia = [1, 1, 1]
[[flywheel]]
name = "w1"
mass = 1
inertia = [0.02, 0.01, 0.01]
[[instrument]]
name = "mast"
position = [0, 0, 1]
[[point]]
name = "telescope"
mount = "mast"
position = [0.1, 0.2, 0]
angles = [0.1, 0.2, 0.3]
"""


def task(rows: str, name: str = "sight") -> str:
    return f"{STAND}[task.{name}]\nrows = {rows}\n"


SIGHT = task('[{ point = "telescope", rows = ["wy", "vz"] }, "vx", { point = "mast", rows = ["wx"] }]')


def test_a_task_is_read_and_written_back() -> None:
    stand = loads(SIGHT)
    rows = (TaskRow("telescope", "wy"), TaskRow("telescope", "vz"), TaskRow("", "vx"), TaskRow("mast", "wx"))
    assert stand.tasks == (Task("sight", rows),)
    assert loads(dumps(stand)) == stand
    changed = mahovik.Stand.of(stand).replace({"task.sight.rows": ["wz"], "inverse_most": "600 rpm/s"})
    assert changed.tasks == (Task("sight", (TaskRow("", "wz"),)),)
    assert mahovik.Stand.of(loads(dumps(changed))) == changed
    assert summarize(stand).tasks == (TaskSummary("sight", ("telescope.wy", "telescope.vz", "vx", "mast.wx")),)


def test_identities() -> None:
    without, one = loads(STAND), loads(SIGHT)
    assert identities(without).structure != identities(one).structure
    other = replace(one, tasks=(Task("sight", (*one.tasks[0].rows[:-1], TaskRow("mast", "wy"))),))
    assert structure(one) != structure(other)
    moved = loads(SIGHT.replace("position = [0.1,", "position = [0.11,"))
    assert identities(moved).structure == identities(one).structure
    assert identities(moved).physics != identities(one).physics
    assert identities(replace(without, inverse_most=2e4)).structure == identities(without).structure
    assert identities(replace(without, inverse_most=2e4)).physics != identities(without).physics


def test_rows_are_those_of_the_transfers_of_the_reference() -> None:
    """Two codes for one fact: a row of S is a column of L of the point, of E for O1."""
    stand = random_stand(np.random.default_rng(4), 3, EVERYTHING)
    places = places_of(stand.instruments, stand.points)
    transfers = point_transfers(stand) | {"": np.eye(6)}
    assert set(transfers) == {"", *places}
    for of, L in transfers.items():
        rows = [row_vector(TaskRow(of, name), places) for name in ("vx", "vy", "vz", "wx", "wy", "wz")]
        np.testing.assert_allclose(rows, L.T, atol=1e-15)
