"""Tasks in the stand file: what is read, refused, written back, and what the identities depend on."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import mahovik
from mahovik.core.stand import dumps, identities, loads, structure
from mahovik.core.stand.model import Task, TaskRow
from mahovik.core.stand.random import EVERYTHING, Features, random_stand
from mahovik.core.stand.summary import TaskSummary, summarize
from mahovik.core.stand.task import places_of, row_vector
from mahovik.errors import StandError
from mahovik.proof.reference.points import point_transfers

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


REFUSED = {
    "unknown point": (
        task('[{ point = "telescop", rows = ["wy"] }]'),
        'task "sight", rows: unknown point "telescop", did you mean "telescope"?',
    ),
    "a flywheel is no point": (
        task('[{ point = "w1", rows = ["wy"] }]'),
        'task "sight", rows: unknown point "w1", expected one of mast, telescope',
    ),
    "the carrier is no point": (
        task('[{ point = "carrier", rows = ["wy"] }]'),
        'task "sight", rows: unknown point "carrier": rows of the carrier itself are those of O1, and stand without a '
        'point, rows = ["wx", ...]',
    ),
    "unknown component": (task('["wx", "w"]'), 'task "sight", rows[1]: unknown component "w", did you mean "wx"?'),
    "component of a point": (
        task('[{ point = "mast", rows = ["x", 3] }]'),
        'task "sight", rows[0]: rows[0]: unknown component "x", did you mean "vx"?',
    ),
    "number": (task("[3]"), 'task "sight", rows[0]: expected one of vx, vy, vz, wx, wy, wz, found 3'),
    "key of a row": (
        task('[{ point = "mast", row = ["wx"] }]'),
        'task "sight", rows[0]: unknown key "row", did you mean "rows"?',
    ),
    "no rows": (
        task("[]"),
        'task "sight", rows: expected a list of rows such as ["wx", "wy", "wz"], found an empty list',
    ),
    "twice": (task('["wx", "vx", { point = "mast", rows = ["wx"] }, "vx"]'), 'task "sight", rows: vx is given twice'),
    "dependent": (
        task('["wx", { point = "mast", rows = ["wy", "wx"] }]'),
        'task "sight", rows: mast.wx follows from wx at every state: rows of a task must be independent; '
        "leave one of them out",
    ),
    "dependent by an arm": (
        task('["vx", { point = "mast", rows = ["vx"] }, "wy"]'),
        'task "sight", rows: wy follows from vx, mast.vx at every state: rows of a task must be independent; '
        "leave one of them out",
    ),
    "seven": (
        task('["vx", "vy", "vz", "wx", "wy", "wz", { point = "telescope", rows = ["vy"] }]'),
        'task "sight", rows: telescope.vy follows from vx, vy, vz, wx, wy, wz at every state: '
        "rows of a task must be independent; leave one of them out",
    ),
    "keyword": (task('["wx"]', "int"), 'task "int": "int" is a C keyword'),
    "no flywheel": (
        STAND.split("[[flywheel]]", maxsplit=1)[0] + '[task.a]\nrows = ["wx"]\n',
        "task: a task is what flywheels are to do, but there is no flywheel",
    ),
    "no table": (STAND.replace("[carrier]", "task = 3\n[carrier]"), "task: expected tables [task.NAME], found 3"),
    "most": (
        STAND.replace("[carrier]", 'inverse_most = "3 rpm"\n[carrier]'),
        'inverse_most: unit "rpm" does not fit, expected an angular acceleration (rad/s^2)',
    ),
}


@pytest.mark.parametrize("case", REFUSED)
def test_a_wrong_task_is_refused(case: str) -> None:
    text, expected = REFUSED[case]
    with pytest.raises(StandError) as caught:
        loads(text, "s.toml")
    assert f"s.toml: {expected}" in caught.value.problems


@pytest.mark.parametrize("name", ["fast", "options", "result", "work", "fast_point", "a_at", "a_result", "work_3"])
def test_a_name_that_the_c_needs_is_refused(name: str) -> None:
    with pytest.raises(StandError, match="would make a name of the C that is taken"):
        loads(task('["wx"]', name))


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
    transfers = dict(point_transfers(stand)) | {"": np.eye(6)}
    assert set(transfers) == {"", *places}
    for of, L in transfers.items():
        rows = [row_vector(TaskRow(of, name), places) for name in ("vx", "vy", "vz", "wx", "wy", "wz")]
        np.testing.assert_allclose(rows, L.T, atol=1e-15)


def test_random_tasks_leave_the_rest_of_a_stand_as_it_is() -> None:
    one, other = (random_stand(np.random.default_rng(7), 4, Features(tasks=k)) for k in (0, 3))
    assert len(other.tasks) == 3
    assert replace(other, tasks=()) == one
    assert loads(dumps(other)) == other
