"""Stands in Python: of mappings, edited by path as in campaigns; the same identities as those of files."""

from __future__ import annotations

import math
import tomllib
from typing import Any

import pytest

import mahovik
from mahovik import stands
from mahovik.core.stand import identities, load
from mahovik.core.stand.numbers import StandNumbers
from mahovik.errors import UsageError

SMALL: dict[str, Any] = {
    "name": "small",
    "schema": 1,
    "angles": "ship",
    "carrier": {"mass": "2 kg", "inertia": [0.01, 0.02, 0.02]},
    "flywheel": [
        {"name": "w1", "mass": 0.5, "spin_inertia": "5 kg cm^2", "transverse_inertia": "3 kg cm^2",
         "unbalance": {"static": "1 g mm", "static_at": "30 deg"}}
    ],
}  # fmt: skip


@pytest.mark.parametrize("name", stands.names())
def test_the_keys_of_a_file_give_its_stand(name: str) -> None:
    document = tomllib.loads(stands.path(name).read_text(encoding="utf-8"))
    stand = mahovik.Stand.from_dict(document)
    assert identities(stand) == identities(load(stands.path(name)))
    assert stand == mahovik.example(name) == stand.replace({})
    assert mahovik.Stand.from_dict(stand.to_dict()) == stand


def test_a_path_changes_one_value_with_its_unit() -> None:
    stand = mahovik.Stand.from_dict(SMALL)
    changed = stand.replace(
        {"w1.unbalance.static": "2 g mm", "carrier.inertia.0": 0.015, "gravity": [0, 0, "-1.62 m/s^2"]}
    )
    wheel = changed.flywheels[0]
    assert wheel.mass * math.hypot(*wheel.center_of_mass[1:]) == pytest.approx(2e-6, rel=1e-15)
    assert math.degrees(math.atan2(wheel.center_of_mass[2], wheel.center_of_mass[1])) == pytest.approx(30.0)
    assert changed.carrier.inertia[0][0] == 0.015 and changed.gravity == (0.0, 0.0, -1.62)
    assert stand == mahovik.Stand.from_dict(SMALL), "the stand itself has changed"
    motor = changed.replace({"w1.motor.torque": "20 mN m", "w1.unbalance": None})
    assert motor.flywheels[0].motor is not None and motor.flywheels[0].motor.torque == 0.02
    assert motor.flywheels[0].center_of_mass == (0.0, 0.0, 0.0)


def test_a_flywheel_given_by_its_inertia_takes_an_unbalance() -> None:
    stand = mahovik.example("bench8")
    before, after = stand.flywheels[0], stand.replace({"w1.unbalance.static": "2 g mm"}).flywheels[0]
    assert after.mass * math.hypot(*after.center_of_mass[1:]) == pytest.approx(2e-6, rel=1e-14)
    assert math.atan2(*before.center_of_mass[1:]) == pytest.approx(math.atan2(*after.center_of_mass[1:]), abs=1e-14)
    assert after.center_of_mass[0] == before.center_of_mass[0]
    both = stand.replace({"w1.unbalance.dynamic": "30 g mm^2", "w1.unbalance.static": "2 g mm"}).flywheels[0]
    assert math.hypot(both.inertia[0][1], both.inertia[0][2]) == pytest.approx(30e-9, rel=1e-14)
    assert both.center_of_mass == after.center_of_mass
    heavier = stand.replace({"w1.unbalance.static": "2 g mm", "w1.mass": 2 * before.mass}).flywheels[0]
    assert heavier.mass * math.hypot(*heavier.center_of_mass[1:]) == pytest.approx(2e-6, rel=1e-14)


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"w2.mass": 1}, 'w2.mass: small has no "w2", did you mean "w1"?'),
        ({"w1.mas": 1}, 'unknown key "mas", did you mean "mass"?'),
        ({"w1.mass.x": 1}, "0.5 has no keys"),
        ({"carrier.inertia.3": 1}, '"3", expected a place from 0 to 2'),
        ({"w1.axis": None}, 'there is no "axis" to take away'),
        ({"w1.mass": "1 m"}, 'unit "m" does not fit, expected a mass (kg)'),
        ({"w1.unbalance.static": -1}, "unbalance"),
        ({"flywheel.w3.mass": 1}, 'no "w3"'),
    ],
)
def test_a_wrong_path_is_named(changes: dict[str, Any], words: str) -> None:
    with pytest.raises(mahovik.MahovikError) as error:
        mahovik.Stand.from_dict(SMALL).replace(changes)
    assert words in str(error.value) and "\n" not in str(error.value)


def test_all_problems_of_a_mapping_are_named() -> None:
    with pytest.raises(mahovik.StandError) as error:
        mahovik.Stand.from_dict({**SMALL, "carrier": {"mass": -1}, "gravty": 1}, "trial")
    lines = str(error.value).splitlines()
    assert len(lines) >= 3 and all(line.startswith("trial: ") for line in lines)
    with pytest.raises(mahovik.UsageError, match="expected a mapping"):
        mahovik.Stand.from_dict([1])  # type: ignore[arg-type]  # what a user may pass


PATTERNS = (
    "*.mass", "*.position", "*.center_of_mass", "*.inertia.J11", "*.inertia.J12", "*.inertia.J32", "*.unbalance.static",
    "gravity", "stream", "leg[*].stiffness", "leg[*].ground", "suspension.stiffness[2][2]", "suspension.damping[0][0]",
    "carrier.added_mass[1][5]", "carrier.damping.linear[3][3]", "hold.pivot", "*.buoyancy.center",
)  # fmt: skip


HELD: dict[str, Any] = {
    "schema": 1,
    "name": "held",
    "carrier": {"mass": "2 kg", "inertia": [0.02, 0.02, 0.01]},
    "hold": {"freedoms": ["pitch"]},
    "suspension": {"stiffness": [0, 0, 0, 0, "3 N m/rad", 0]},
    "flywheel": [
        {"name": name, "axis": [0, 1, 0], "zero": [0, 0, 1], "position": {"value": [0, 20, 0], "unit": "mm"},
         "mass": 0.5, "inertia": {"value": [9, 6, 6], "unit": "kg cm^2"}}
        for name in ("w1", "w2", "other")
    ],
}  # fmt: skip


def held_stand() -> mahovik.Stand:
    return mahovik.Stand.from_dict(HELD)


@pytest.mark.parametrize("name", ["held", "auv6", "sat4"])
def test_every_path_of_a_campaign_is_one_of_replace(name: str) -> None:
    """The stand does not change where its own value is set by the path."""
    stand = held_stand() if name == "held" else mahovik.example(name)
    count = 0
    for pattern in PATTERNS:
        try:
            places = StandNumbers(stand, stand.to_dict()).find(pattern)
        except UsageError:
            continue  # no such table in this stand
        for place in places:
            if place.key in ("inertia", "center_of_mass") and "spin_inertia" in _table(stand, place.body):
                continue  # the file gives them as a data sheet does
            same = stand.replace({place.path: place.value})
            if place.key != "static":  # an amount is recomputed from the centre of mass
                assert same == stand, place.path
            count += 1
    assert count > 10


def _table(stand: mahovik.Stand, name: str) -> dict[str, Any]:
    document = stand.to_dict()
    lists = [entry for items in document.values() if isinstance(items, list) for entry in items]
    named = {entry["name"]: entry for entry in lists if isinstance(entry, dict) and "name" in entry}
    return dict(document.get(name) or named[name])


def test_a_place_is_set_whatever_way_the_file_gives_its_list() -> None:
    """The list may be left out, have one unit for all, or be the diagonal of a matrix, whose elements mirror."""
    changed = held_stand().replace(
        {
            "hold.pivot[2]": "-40 mm",
            "w1.position[0]": "5 mm",
            "carrier.inertia.J12": 1e-3,
            "suspension.stiffness[4][4]": "4 N m/rad",
            "gravity[2]": -9.81,
        }
    )
    assert changed.hold is not None and changed.hold.pivot == (0.0, 0.0, -0.04)
    assert changed.flywheels[0].position == pytest.approx((0.005, 0.02, 0.0)) and changed.gravity == (0.0, 0.0, -9.81)
    assert changed.carrier.inertia == ((0.02, 1e-3, 0.0), (1e-3, 0.02, 0.0), (0.0, 0.0, 0.01))
    whole = {
        "hold": {"freedoms": ["pitch"], "pivot": [0, 0, "-40 mm"]},
        "w1.position": ["5 mm", "20 mm", 0],
        "carrier.inertia": [[0.02, 1e-3, 0], [1e-3, 0.02, 0], [0, 0, 0.01]],
        "suspension": {"stiffness": [0, 0, 0, 0, 4, 0]},
        "gravity": [0, 0, -9.81],
    }
    assert changed == held_stand().replace(whole)


def test_a_pattern_sets_all_that_it_matches() -> None:
    changed = held_stand().replace({"w*.mass": "300 g", "w*.inertia.J11": "8 kg cm^2", "other.position[*]": "1 mm"})
    assert [flywheel.mass for flywheel in changed.flywheels] == [0.3, 0.3, 0.5]
    assert [flywheel.inertia[0][0] for flywheel in changed.flywheels] == pytest.approx([8e-4, 8e-4, 9e-4])
    assert changed.flywheels[2].position == (1e-3, 1e-3, 1e-3)
    both = {f"w{i}.mass": 0.3 for i in (1, 2)} | {f"w{i}.inertia[0]": 8e-4 for i in (1, 2)}
    assert changed == held_stand().replace({**both, "other.position": [1e-3] * 3})


def test_places_are_those_of_the_file_while_items_are_taken_away() -> None:
    bench8 = mahovik.example("bench8")
    assert not bench8.replace({"w*": None}).flywheels
    left = bench8.replace({"flywheel[0]": None, "flywheel[2]": None, "flywheel[3].mass": 2.0}).flywheels
    assert [(wheel.name, wheel.mass == 2.0) for wheel in left[:3]] == [("w2", False), ("w4", True), ("w5", False)]


def test_a_pattern_matches_bodies_first_and_no_tables() -> None:
    """Points and parts of laws are matched where no body may have the key, tables without a name never."""
    wing = {"name": "wing", "position": [0, 0, 1], "density": 1.2, "area": 0.1, "lift_slope": 3.0}
    point = {"name": "where", "position": [1, 0, 0]}
    leg = {"ground": [0, 0, -1], "carrier": [0, 0, 0], "length": 1}
    stand = mahovik.Stand.from_dict({**HELD, "fin": [wing], "point": [point], "leg": [leg]})
    numbers = StandNumbers(stand, stand.to_dict())
    for pattern, names in {
        "w*.unbalance.static": {"w1", "w2"}, "w*.position[0]": {"w1", "w2"}, "*.mass": {"carrier", "w1", "w2", "other"},
        "w*.area": {"wing"}, "wh*.position[0]": {"where"},
    }.items():  # fmt: skip
        assert {number.body for number in numbers.find(pattern)} == names
        before, after = stand.to_dict(), stand.replace({pattern: 1e-3}).to_dict()
        rows = [[row for key in ("flywheel", "fin", "point") for row in keys[key]] for keys in (before, after)]
        changed = {old["name"] for old, new in zip(*rows, strict=True) if old != new}
        assert changed == names - {"carrier"}
    with pytest.raises(UsageError, match="no name matches"):
        numbers.find("s*.stiffness[2][2]")
    for refused in (lambda: numbers.find("leg[1].length"), lambda: stand.replace({"leg[1].length": 2})):
        with pytest.raises(UsageError, match="expected 0, the only place"):
            refused()


@pytest.mark.parametrize(
    ("path", "words"),
    [
        ("hold.pivto[2]", 'unknown key "pivto", did you mean "pivot"'),
        ("w1.position[3]", "expected a place from 0 to 2"),
        ("w1.position[", "is no path; expected names joined by dots"),
        ("v*.mass", 'no name matches "v'),
        ("w1.mass[0]", "mass"),
        ("w*.mas", 'unknown key "mas" of w1, w2, did you mean "mass"'),
        ("w1.mazz*", "matches no key"),
        ("s*.stiffness", 'no name matches "s*"'),
    ],
)
def test_a_path_that_leads_nowhere_is_refused_in_a_line(path: str, words: str) -> None:
    with pytest.raises(mahovik.MahovikError, match=r".") as caught:
        held_stand().replace({path: 1})
    assert words in str(caught.value) and len(str(caught.value).splitlines()) == 1
