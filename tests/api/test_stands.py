"""Stands in Python: of mappings, edited by path; the same identities as those of files."""

from __future__ import annotations

import math
import tomllib
from typing import Any

import pytest

import mahovik
from mahovik import stands
from mahovik.core.stand import identities, load

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
    found = mahovik.Stand.from_dict(document)
    assert identities(found) == identities(load(stands.path(name)))
    assert found == mahovik.example(name) == found.replace({})
    assert mahovik.Stand.from_dict(found.to_dict()) == found


def test_a_path_changes_one_value_with_its_unit() -> None:
    stand = mahovik.Stand.from_dict(SMALL)
    found = stand.replace(
        {"w1.unbalance.static": "2 g mm", "carrier.inertia.0": 0.015, "gravity": [0, 0, "-1.62 m/s^2"]}
    )
    wheel = found.flywheels[0]
    assert wheel.mass * math.hypot(*wheel.center_of_mass[1:]) == pytest.approx(2e-6, rel=1e-15)
    assert math.degrees(math.atan2(wheel.center_of_mass[2], wheel.center_of_mass[1])) == pytest.approx(30.0)
    assert found.carrier.inertia[0][0] == 0.015 and found.gravity == (0.0, 0.0, -1.62)
    assert stand == mahovik.Stand.from_dict(SMALL), "the stand itself has changed"
    motor = found.replace({"w1.motor.torque": "20 mN m", "w1.unbalance": None})
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
