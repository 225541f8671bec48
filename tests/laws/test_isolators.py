"""Isolators: their sums by hand, beside legs, at rest under their load; the second reading of the file; refusals."""

from __future__ import annotations

import math
import tomllib
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import mahovik
from mahovik.core.stand import loads
from mahovik.core.stand.model import Stand, rest_state
from mahovik.core.stand.stand_file import dumps
from mahovik.errors import StandError, UsageError
from mahovik.laws.suspension.law import Suspension
from mahovik.proof import reference
from mahovik.proof.second.reading import differences
from mahovik.use.simulate.held import home

TABLE = """
schema = 1
name = "table4"
gravity = [0, 0, -9.81]
[carrier]
mass = 80
center_of_mass = [0.02, 0.01, 0.05]
inertia = [4, 6, 9]
inertia_about = "center_of_mass"
buoyancy = { displaced_mass = 6, center = [0.01, 0, 0.04] }
"""
PRELOAD = '[suspension]\npreload = "weight"\n'
CORNERS = [(x, y) for x in (-300, 300) for y in (-200, 200)]


def isolator(name: str, position: Any, stiffness: str = '["40 N/mm", "40 N/mm", "90 N/mm"]', more: str = "") -> str:
    return f'[[isolator]]\nname = "{name}"\nposition = {position}\nstiffness = {stiffness}\n{more}\n'


def corners(stiffness: str = '["40 N/mm", "40 N/mm", "90 N/mm"]', more: str = "") -> str:
    return "".join(
        isolator(f"mount{i}", f'["{x} mm", "{y} mm", 0]', stiffness, more) for i, (x, y) in enumerate(CORNERS)
    )


def suspension(stand: Stand) -> Suspension:
    law = stand.law(Suspension)
    assert law is not None
    return law


def test_four_corners_by_hand() -> None:
    centred = TABLE.replace("[0.02, 0.01, 0.05]", "[0, 0, 0]").replace("[0.01, 0, 0.04]", "[0, 0, 0]")
    law = suspension(loads(centred + corners(more="ratio = 0.05")))
    k, kz, x2, y2 = 40e3, 90e3, 0.09, 0.04
    expected = 4 * np.diag([k, k, kz, kz * y2, kz * x2, k * (x2 + y2)])
    assert np.array(law.stiffness) == pytest.approx(expected, rel=1e-15, abs=1e-9)
    c, cz = (2 * 0.05 * math.sqrt(stiffness * 74 / 4) for stiffness in (k, kz))
    expected = 4 * np.diag([c, c, cz, cz * y2, cz * x2, c * (x2 + y2)])
    assert np.array(law.damping) == pytest.approx(expected, rel=1e-14, abs=1e-9)
    assert suspension(loads(centred + corners(more="loss = 0.1"))).damping == law.damping


def test_springs_along_one_axis_are_long_legs() -> None:
    placed = isolator("a", [0.3, 0.2, -0.1], "[0, 0, 9e4]", "damping = [0, 0, 70]\nangles = [0.3, 0.4, 0]") + isolator(
        "b", [-0.3, 0.1, 0.1], "[0, 0, 5e4]", "angles = [0, -0.2, 0.5]"
    )
    stand, far, legs = loads(TABLE + placed), 1e5, ""
    for table in tomllib.loads(placed)["isolator"]:
        psi, theta, phi = table["angles"]
        axis = np.array([
            math.cos(psi) * math.sin(theta) * math.cos(phi) + math.sin(psi) * math.sin(phi),
            math.sin(psi) * math.sin(theta) * math.cos(phi) - math.cos(psi) * math.sin(phi),
            math.cos(theta) * math.cos(phi),
        ])  # fmt: skip
        ground = (np.array(table["position"]) - far * axis).tolist()
        legs += f"[[leg]]\nground = {ground}\ncarrier = {table['position']}\nlength = {far}\n"
        legs += f"stiffness = {table['stiffness'][2]}\ndamping = {table.get('damping', [0, 0, 0])[2]}\n"
    displaced: dict[str, Any] = {
        "position": (2e-5, -1e-5, 3e-5),
        "angles": (1e-5, 2e-5, -3e-5),
        "V": (1e-3, 0.0, 2e-3, 0.0, 1e-3, 0.0),
    }
    answers = [
        reference.evaluate(other, replace(rest_state(other), **displaced), ["forward"])["V_dot"]
        for other in (stand, loads(TABLE + legs))
    ]
    assert answers[0] == pytest.approx(answers[1], abs=1e-4)


axes = st.tuples(*[st.floats(-3, 3)] * 3).map(list)
places = st.tuples(*[st.floats(-0.5, 0.5)] * 3).map(list)
springs = st.tuples(*[st.floats(2e3, 1e5)] * 3).map(list)
HOLDS = [
    "", '[hold]\nfreedoms = ["z"]\nangles = [0.4, -0.3, 0.2]\nposition = [1, 2, 3]\n',
    '[hold]\nfreedoms = ["roll", "pitch", "yaw"]\npivot = [0.1, 0, -0.2]\nangles = [0.4, -0.3, 0.2]\n',
]  # fmt: skip
WHEEL = """
[[instrument]]
name = "head"
position = [0.1, 0.2, 0.1]
angles = [0.2, 0.1, -0.4]
mass = 3
inertia = [0.1, 0.1, 0.1]
[[flywheel]]
name = "w"
mount = "head"
angles = [0.3, 0.5]
mass = 2
spin_inertia = 0.01
transverse_inertia = 0.008
"""


@given(st.lists(st.tuples(places, axes, springs), min_size=3, max_size=5), st.sampled_from(HOLDS), st.data())
def test_preloaded_springs_bear_the_weight_in_the_pose_of_the_file(mounts: Any, hold: str, data: Any) -> None:
    sequence = data.draw(st.sampled_from(["ship", "aircraft", "euler"]))
    damping_line = data.draw(st.sampled_from(["", "damping = [20, 30, 40]"]))
    text = TABLE.replace("schema = 1", f'schema = 1\nangles = "{sequence}"') + PRELOAD + hold + WHEEL
    for i, (position, angles, k) in enumerate(mounts):
        text += isolator(f"m{i}", position, str(k), f"angles = {angles}\n{damping_line}")
    try:
        stand = loads(text)
    except StandError as error:  # springs in a line, or nearly
        words = ("isolator: nothing carries the weight", "would turn by", "springs resist a motion by")
        assert any(part in str(error) for part in words)
        return
    assert loads(dumps(stand)) == stand
    off = {key: x for key, x in differences(stand, tomllib.loads(text)).items() if "suspension" in key}
    assert len(off) == 3
    assert max(off.values()) < 1e-9
    answer = reference.evaluate(stand, home(stand), ["forward"])
    largest = np.abs(suspension(stand).stiffness).max()
    assert np.abs(answer["V_dot" if stand.hold is None else "u_dot"]).max() < 1e-12 * largest


def test_springs_bear_the_weight_up_to_where_the_pose_is_no_minimum() -> None:
    """At the height that is refused first the stiffness of the whole stand, by the reference, is singular."""
    centred = TABLE.replace("[0.01, 0, 0.04]", "[0, 0, 0]")
    springs = [isolator(f"m{i}", [x, y, 0.1 * i], "[4e3, 5e3, 9e3]", f"angles = [0.2, 0.1, {0.1 * i}]")
               for i, (x, y) in enumerate([(0.3, 0.2), (0.35, -0.2), (-0.3, 0.0)])]  # fmt: skip
    low, high = 0.1, 3.0
    for _ in range(50):
        height = 0.5 * (low + high)
        try:
            stand = loads(centred.replace("0.01, 0.05]", f"0.01, {height!r}]") + PRELOAD + "".join(springs))
            low = height
        except StandError as error:
            assert "springs resist a motion by" in str(error)
            high = height
    columns = []
    for twist in np.eye(6):
        ways = [replace(rest_state(stand), position=tuple(twist[:3] * h), quaternion=(1.0, *(twist[3:] * h / 2)))
                for h in (1e-5, -1e-5)]  # fmt: skip
        plus, minus = (reference.evaluate(stand, way, ["matrices"])["F"] for way in ways)
        columns.append((minus - plus) / 2e-5)
    stiffness = np.array(columns).T
    values = np.sort(np.linalg.eigvals(stiffness).real)
    assert abs(values[0]) < 1e-6 * values[1]


def test_a_held_table_is_borne_up_to_its_height() -> None:
    roll = PRELOAD + '[hold]\nfreedoms = ["roll"]\n' + corners("[0, 0, 5e3]")
    limit = 4 * 5e3 * 0.04 / (74 * 9.81)
    at = TABLE.replace("[0.01, 0, 0.04]", "[0, 0, {0}]").replace("[0.02, 0.01, 0.05]", "[0, 0, {0}]")
    assert loads(at.replace("{0}", f"{0.999 * limit}") + roll).hold is not None
    with pytest.raises(
        StandError, match=r"along roll springs resist a motion by 800 N m/rad, weight drives it by 800\.8"
    ):
        loads(at.replace("{0}", f"{1.001 * limit}") + roll)


def test_a_clamped_carrier_loads_no_isolator() -> None:
    clamped = TABLE + PRELOAD + "[hold]\nfreedoms = []\n"
    assert suspension(loads(clamped + corners())).position == (0, 0, 0)
    with pytest.raises(StandError, match="isolator mount0, ratio: it bears 0 kg at rest"):
        loads(clamped + corners(more="ratio = 0.1"))


def test_damping_of_each_load_is_read_as_the_second_reading_does() -> None:
    text = TABLE + PRELOAD + corners(more="ratio = 0.03\nangles = [0.1, 0.2, 0.3]") + WHEEL
    off = differences(loads(text), tomllib.loads(text))
    assert max(x for key, x in off.items() if "suspension" in key) < 1e-12


def test_samples_differ_as_their_stands_do() -> None:
    stand = mahovik.Stand.of(loads(TABLE + PRELOAD + corners(more="loss = 0.1")))
    changes = {"mount2.stiffness[2]": np.array([9e4, 8e4]), "carrier.mass": np.array([80.0, 90.0])}
    model = mahovik.build(stand)
    tables = model.tables(changes)
    varied = stand.replace({path: float(values[1]) for path, values in changes.items()})
    assert tables.stand(1).to_dict() == varied.to_dict()
    states = model.states(2)
    answers = model.forward(states, tables=tables).V_dot[1], mahovik.build(varied).forward(model.states(1)).V_dot[0]
    assert np.array_equal(*answers)


@pytest.mark.parametrize(
    ("text", "problem"),
    [
        (PRELOAD, 'suspension, preload: is of springs that stand as [[isolator]], but there is none'),
        (PRELOAD.replace("weight", "half") + corners(), 'suspension, preload: expected "weight", found "half"'),
        (
            "[suspension]\nstiffness = [1, 1, 1, 1, 1, 1]\n" + corners(),
            'suspension, stiffness: given beside [[isolator]], which make it: expected preload = "weight" alone',
        ),
        (corners(more="ratio = 0.1\nloss = 0.2"), "isolator mount0, loss: given beside ratio: expected one of"),
        (corners(more="zeta = 0.1"), 'unknown key "zeta": `ratio` is that of critical damping'),
        (corners(more="damping_ratio = 0.1"), "`ratio` is that of critical damping"),
        (corners(more="Q = 10"), "`loss` is 1 / Q"),
        (corners(more="damping = { ratio = 0.1 }"), "damping: expected 3 numbers; ratio is a key beside it: ratio ="),
        (corners("[1e3, 1e3, -5]"), 'isolator "mount0", stiffness[2]: -5 N/m is negative'),
        (corners('["1 N/mm", "1 N/mm", "1 N m/rad"]'), "expected a stiffness (N/m)"),
        (PRELOAD + corners("[1e3, 1e3, 0]"), "isolator: nothing carries the weight along z: springs have no stiffness"),
        (PRELOAD + isolator("one", [0.3, 0, 0]), "isolator: nothing carries the weight along"),
        (PRELOAD + corners("[4e3, 4e3, 50]"), "suspension, preload: springs would turn by"),
        *((PRELOAD + isolator("one", [0, 0, 0], "[2e3, 2e3, 2e3]") + isolator("two", place, "[2e3, 2e3, 2e3]"),
           "suspension, preload: springs would turn by") for place in ([7.4e-163, 0, 0], [0, 0, 7.4e-163])),
        (isolator("one", [0, 0, 0]) + isolator("one", [0, 0, 0]), "name: taken by an isolator"),
        (
            isolator("a", [0.3, 0.2, 0]) + isolator("b", [0.3, -0.2, 0])
            + isolator("down", [1, 0, 0], more="ratio = 1"),
            "isolator down, ratio: it bears -",
        ),
    ],
)  # fmt: skip
def test_refusals(text: str, problem: str) -> None:
    with pytest.raises(StandError) as caught:
        loads(TABLE + text)
    assert problem in str(caught.value)


def test_changes_of_what_the_file_does_not_give() -> None:
    stand = mahovik.Stand.of(loads(TABLE + corners(more="ratio = 0.1")))
    with pytest.raises(StandError, match=r'isolator "mount0", damping: expected 3 numbers, found 0\.2'):
        stand.replace({"mount0.damping[0]": 0.2})
    with pytest.raises(UsageError, match=r"suspension\.stiffness\[0\]\[0\]: \[\[isolator\]\] make it: expected"):
        stand.replace({"suspension.stiffness[0][0]": 0.2})


def test_check_shows_natural_frequencies_and_sag() -> None:
    centred = TABLE.replace("[0.02, 0.01, 0.05]", "[0, 0, 0]").replace("[0.01, 0, 0.04]", "[0, 0, 0]")
    rest = mahovik.check(mahovik.Stand.of(loads(centred + corners()))).meta["rest"]
    k, kz, x2, y2 = 160e3, 360e3, 0.09, 0.04
    squares = [k / 80, k / 80, kz / 80, kz * y2 / 4, kz * x2 / 6, k * (x2 + y2) / 9]
    assert rest["frequencies"] == pytest.approx(np.sqrt(sorted(squares)) / (2 * math.pi), rel=1e-6)
    assert rest["sag"] == pytest.approx([0, 0, -74 * 9.81 / kz, 0, 0, 0], rel=1e-6, abs=1e-12)
