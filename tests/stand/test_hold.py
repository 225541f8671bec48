"""`[hold]` in the stand file: what is read, refused, written back; its twists; what the identities depend on."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mahovik.core.stand import dumps, identities, loads, structure
from mahovik.core.stand.definite import condition_of_twists
from mahovik.core.stand.hold import FREEDOMS, has_coordinates, is_closed, kinds, no_coordinates, twist_of, twists, words
from mahovik.core.stand.model import Freedom, Hold
from mahovik.core.stand.summary import summarize
from mahovik.errors import StandError
from mahovik.proof.reference.hold import blocked_directions
from mahovik.proof.reference.hold import twists as literal_twists
from mahovik.proof.second.hold import twists as moving_twists

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


def test_what_turns_turns_about_the_pivot() -> None:
    hold = hold_of(GOOD[3])
    (column,) = twists(hold).T
    axis = np.ones(3) / np.sqrt(3)
    assert column[3:] == pytest.approx(axis)
    at_pivot = column[:3] + np.cross(axis, hold.pivot)
    assert at_pivot == pytest.approx(np.zeros(3))
    assert twist_of(hold, [2.0]) == pytest.approx(2 * column)


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


def test_the_blocked_wrenches_do_no_work() -> None:
    S = twists(hold_of(GOOD[5]))
    B = blocked_directions(S)
    assert B.shape == (6, 4)
    assert np.abs(S.T @ B).max() < 1e-15
    assert np.linalg.matrix_rank(np.hstack([S, B])) == 6


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


def test_a_closed_basis_is_said_to_have_no_coordinates() -> None:
    """`eval` and the C refuse them, in the same words; `rest` and `modes` take its rows."""
    stand = loads(with_hold("basis = [[0.1, 0, 0.2, 0, 1, 0]]"))
    assert stand.hold is not None and is_closed(stand.hold) and not has_coordinates(stand.hold)
    said = words(stand.hold)
    assert "a closed set: `rest`, `modes` and `plan` count along it" in said and "no coordinates in `eval`" in said
    assert no_coordinates(stand.hold) == "a basis of [hold] has no coordinates"


@pytest.mark.parametrize("axis", ["[1e-300, 0, 0]", "[1e200, 0, 0]"])
def test_an_axis_of_any_length_is_shown_by_its_unit_vector(axis: str) -> None:
    assert words(hold_of(f"axis = {axis}")).startswith("1 freedom, turning about (1, 0, 0);")


LEG = "\n[[leg]]\nground = [0, 0, -1]\ncarrier = [0.1, 0, 0]\nlength = 0.9\nstiffness = 100\n"


def test_a_leg_on_a_clamped_carrier_is_a_warning() -> None:
    found = [line for line in summarize(loads(with_hold("freedoms = []") + LEG)).warnings if line.startswith("legs")]
    assert found == ["legs: [hold] clamps the carrier: wrenches on it add to the reaction and do nothing else"]
    assert not [line for line in summarize(loads(with_hold('freedoms = ["yaw"]') + LEG)).warnings if "legs" in line]


@pytest.mark.parametrize("text", ['hold = ["yaw"]\n', "hold = 3\n"])
def test_a_hold_that_is_no_table_is_shown_one(text: str) -> None:
    with pytest.raises(StandError, match=r'expected one table, \[hold\] with a line such as freedoms = \["yaw"\]'):
        loads(text + with_hold("freedoms = []").replace("[hold]\nfreedoms = []", ""))
    with pytest.raises(StandError, match="expected one table"):
        loads(with_hold("freedoms = []").replace("[hold]", "[[hold]]"))


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ('freedoms = ["yaw", "x", "yaw"]', "yaw is given twice"),
        ('freedoms = ["jaw"]', 'unknown freedom "jaw", did you mean "yaw"?'),
        ('freedoms = "yaw"', "expected a list of names"),
        ("axis = [0, 0, 0]", "has no direction"),
        ("axis = [0, 0, 1]\nslide = [0, 0, 1]", "axis, slide given together, expected one of"),
        ("pivot = [0, 0, 1]", "it is not said how the carrier can move, expected one of"),
        ("slide = [0, 0, 1]\npivot = [0, 0, 1]", "pivot: given together with slide"),
        ("basis = [[1, 0, 0, 0, 0, 1], [2, 0, 0, 0, 0, 2]]", "row 1 follows from row 0"),
        ("basis = [[1, 0, 0, 0, 0, 0], [1, 0, 0, 0, 0, 1e-13]]", "rows are nearly dependent, by masses and inertias"),
        ("basis = [[1, 0, 0, 0, 0, 0], [1, 0, 0, 0, 0, 1e-3]]", "the difference of two rows in place of one"),
        ("basis = [[1, 0, 0, 0, 0, 1], [0, 0, 0, 0, 0, 0]]", "a row of zeros is no motion"),
        ("basis = [[1, 0, 0]]", "expected 6 numbers, found 3"),
        ("basis = []", "freedoms = [] is clamped"),
        ('freedom = ["yaw"]', "unknown key"),
        ('freedoms = ["yaw"]\n[task.t]\nrows = ["wx"]', "tasks of a carrier with [hold] are not there yet"),
    ],
)
def test_a_hold_that_is_none_is_refused_in_one_line(text: str, reason: str) -> None:
    with pytest.raises(StandError) as caught:
        loads(with_hold(text))
    (line,) = caught.value.problems
    assert "hold" in line and reason in line


@pytest.mark.parametrize(
    "basis",
    [
        "[[1, 0, 0, 0, 0, 0], [1, 0, 0, 0, 0, 0.1]]",
        "[[0, 0, 0, 0, 0, 1], [0.1, 0, 0, 0, 0, 1], [0, 1, 0, 1e-13, 0, 0]]",  # a screw of a very small pitch
        "[[1, 0, 0, 0, 0, 0], [0, 0, 0, 0, 0, 1e-9]]",  # whatever the unit of a row
    ],
)
def test_rows_that_differ_are_taken_whatever_their_size(basis: str) -> None:
    stand = loads(with_hold(f"basis = {basis}"))
    assert stand.hold is not None and np.linalg.matrix_rank(twists(stand.hold), tol=1e-10) == len(stand.hold.freedoms)


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
        cosine, found = 1 / np.sqrt(1 + 1.000001 * x * x), condition_of_twists(stand, twists(stand.hold))
        assert found == pytest.approx((1 + cosine) / (1 - cosine), rel=1e-9)


def test_a_suspension_on_what_is_blocked_is_a_warning() -> None:
    suspended = with_hold('freedoms = ["z"]') + "[suspension]\nstiffness = [5, 0, 7, 0, 0, 0]\n"
    warnings = summarize(loads(suspended)).warnings
    (found,) = [line for line in warnings if "blocks" in line]
    assert "X of its wrench" in found and "Z" not in found
    free = with_hold('freedoms = ["z"]') + "[suspension]\nstiffness = [0, 0, 7, 0, 0, 0]\n"
    assert not any("blocks" in line for line in summarize(loads(free)).warnings)


def test_the_identities_know_the_hold() -> None:
    free, one, other = loads(STAND), loads(with_hold(GOOD[0])), loads(with_hold('freedoms = ["yaw"]'))
    names = [identities(stand) for stand in (free, one, other)]
    assert len({each.physics for each in names}) == 3
    assert names[0].structure != names[1].structure == names[2].structure
    assert identities(replace(one, hold=None)) == names[0]


def test_check_names_what_acts_along_the_freedoms() -> None:
    text = 'freedoms = ["x"]\n[[hold.friction]]\nviscous = 1\n[[hold.stop]]\nat = 1\nstiffness = 1'
    assert summarize(loads(with_hold(text))).hold.endswith("; friction of x; stops of x")
