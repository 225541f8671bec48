"""`[hold]` and tasks in the stand file: what is read, refused, written back, and what the identities depend on."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import mahovik
from mahovik.core.stand import dumps, identities, loads, structure
from mahovik.core.stand.coordinates import places_of, row_vector
from mahovik.core.stand.hold import FREEDOMS, has_coordinates, is_closed, kinds, no_coordinates, twists, words
from mahovik.core.stand.model import Freedom, Hold, Task, TaskRow
from mahovik.core.stand.physical import condition_of_twists
from mahovik.core.stand.random import EVERYTHING, random_stand
from mahovik.core.stand.summary import TaskSummary, summarize
from mahovik.proof.reference.algebra import twists as literal_twists
from mahovik.proof.reference.motion import point_transfers
from mahovik.proof.second.system import twists as moving_twists

STAND = """
schema = 1
name = "s"
gravity = [0, 0, -9.81]
[carrier]
mass = 3
inertia = [1, 1, 1]
[[flywheel]]
name = "w1"
mass = 1
inertia = [0.02, 0.01, 0.01]
"""
ZERO = (0.0, 0.0, 0.0)


def with_hold(text: str) -> str:
    return f"{STAND}[hold]\n{text}\n"


def hold_of(text: str) -> Hold:
    hold = loads(with_hold(text)).hold
    assert hold is not None
    return hold


GOOD = (
    'freedoms = ["yaw"]\npivot = ["0 mm", 0, "-40 mm"]',
    'freedoms = ["x", "z", "pitch"]\nposition = [1, 2, 3]\nangles = [0.1, 0, 0]',
    "freedoms = []",
    "axis = [1, 1, 1]\npivot = [0.1, 0, 0]",
    "slide = [0, 0, 2]",
    "basis = [[1, 0, 0, 0, 0, 0], [0, 0.5, 0, 0, 0, 1]]",
)


@pytest.mark.parametrize("text", GOOD)
def test_a_hold_is_read_and_written_back(text: str) -> None:
    stand = loads(with_hold(text))
    assert stand.hold is not None
    assert loads(dumps(stand)) == stand
    assert structure(stand).hold == kinds(stand.hold)


_NUMBER = st.floats(-2, 2, allow_subnormal=False)
_VECTOR = st.tuples(_NUMBER, _NUMBER, _NUMBER)
_AXES = _VECTOR.filter(lambda v: max(map(abs, v)) > 1e-3)
_FREEDOM = st.one_of(
    st.sampled_from(list(FREEDOMS.values())),
    st.builds(Freedom, st.sampled_from(("turn", "slide")), _AXES),
    st.builds(lambda a, b: Freedom("twist", twist=(*a, *b)), _AXES, _VECTOR),
)


@given(st.lists(_FREEDOM, max_size=6), _VECTOR)
def test_three_ways_to_the_same_twists(freedoms: list[Freedom], pivot: tuple[float, float, float]) -> None:
    hold = Hold(tuple(freedoms), pivot, ZERO, ZERO)
    S = twists(hold)
    assert S.shape == (6, len(freedoms))
    for other in (literal_twists(hold), moving_twists(hold)):
        np.testing.assert_allclose(other, S, rtol=0, atol=1e-14)


@pytest.mark.parametrize(
    ("text", "closed"),
    [
        ('freedoms = ["roll", "pitch", "yaw"]\npivot = [1, 2, 3]', True),
        ('freedoms = ["x", "z", "pitch"]', True),
        ('freedoms = ["x", "roll"]', True),
        ('freedoms = ["x", "y", "z", "yaw"]', True),
        ("freedoms = []", True),
        ('freedoms = ["x", "yaw"]', False),
        ('freedoms = ["roll", "pitch"]', False),
        ("basis = [[1, 0, 0, 0, 0, 0], [0, 0, 0, 0, 0, 1]]", False),
        ("basis = [[1, 0, 0, 0, 0, 0.2]]", True),
    ],
)
def test_a_closed_set_of_twists_is_told_from_others(text: str, closed: bool) -> None:
    assert is_closed(hold_of(text)) is closed
    assert ("not a closed set" in summarize(loads(with_hold(text))).hold) is not closed


@pytest.mark.parametrize(
    ("text", "missing"),
    [
        ('freedoms = ["y", "yaw"]', "expected also x:"),
        ('freedoms = ["roll", "pitch"]', "expected also yaw:"),
        ('freedoms = ["x", "roll", "pitch"]', "expected also y, z, yaw:"),
    ],
)
def test_freedoms_that_are_missing_from_a_closed_set_are_named(text: str, missing: str) -> None:
    assert missing in words(hold_of(text))


def test_the_condition_of_a_basis_is_that_of_its_rows_not_of_a_far_centre_of_mass() -> None:
    """Two rows at the angle whose tangent is 1/x, where masses and inertias are units: condition (c + 1)/(1 - c)."""
    for x in (1e-2, 0.5):
        text = f"""
schema = 1
name = "bob"
carrier = {{ mass = 1, center_of_mass = [0, 1, 0], inertia = [1.000001, 2e-6, 1.000001], inertia_about = "origin" }}
hold = {{ basis = [[1, 0, 0, 0, 0, 0], [1, 0, 0, 0, 0, {x}]] }}
"""
        stand = loads(text)
        assert stand.hold is not None
        cosine, condition = 1 / np.sqrt(1 + 1.000001 * x * x), condition_of_twists(stand, twists(stand.hold))
        assert condition == pytest.approx((1 + cosine) / (1 - cosine), rel=1e-9)


def test_a_closed_basis_is_said_to_have_no_coordinates() -> None:
    """`eval` and the C refuse them, in the same words; `rest` and `modes` take its rows."""
    hold = hold_of("basis = [[0.1, 0, 0.2, 0, 1, 0]]")
    assert is_closed(hold) and not has_coordinates(hold)
    assert "a closed set: `rest`, `modes` and `plan` count along it" in words(hold)
    assert no_coordinates(hold) == "a basis of [hold] has no coordinates"


def test_a_suspension_on_what_is_blocked_is_a_warning() -> None:
    leg = "\n[[leg]]\nground = [0, 0, -1]\ncarrier = [0.1, 0, 0]\nlength = 0.9\nstiffness = 100\n"
    clamped = "legs: [hold] clamps the carrier: wrenches on it add to the reaction and do nothing else"
    assert clamped in summarize(loads(with_hold("freedoms = []") + leg)).warnings
    suspended = with_hold('freedoms = ["z"]') + "[suspension]\nstiffness = [5, 0, 7, 0, 0, 0]\n"
    warnings = summarize(loads(suspended)).warnings
    (warning,) = [line for line in warnings if "blocks" in line]
    assert "X of its wrench" in warning and "Z" not in warning
    free = with_hold('freedoms = ["z"]') + "[suspension]\nstiffness = [0, 0, 7, 0, 0, 0]\n"
    assert not any("blocks" in line for line in summarize(loads(free)).warnings)


def test_the_identities_know_the_hold() -> None:
    free, one, other = loads(STAND), loads(with_hold(GOOD[0])), loads(with_hold('freedoms = ["yaw"]'))
    names = [identities(stand) for stand in (free, one, other)]
    assert len({hashes.physics for hashes in names}) == 3
    assert names[0].structure != names[1].structure == names[2].structure
    assert identities(replace(one, hold=None)) == names[0]


def test_check_names_what_acts_along_the_freedoms() -> None:
    text = 'freedoms = ["x"]\n[[hold.friction]]\nviscous = 1\n[[hold.stop]]\nat = 1\nstiffness = 1'
    assert summarize(loads(with_hold(text))).hold.endswith("; friction of x; stops of x")


SATELLITE = """
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
    return f"{SATELLITE}[task.{name}]\nrows = {rows}\n"


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
    without, one = loads(SATELLITE), loads(SIGHT)
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
