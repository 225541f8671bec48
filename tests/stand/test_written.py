"""Numbers of a stand file as they are written: in `check`, and in the messages that refuse them."""

from __future__ import annotations

from pathlib import Path

import pytest

from mahovik import stands
from mahovik.core.stand import load, loads
from mahovik.core.stand.written import Written, written_numbers
from mahovik.errors import StandError

TEXT = """schema = 1
name = "a"
[carrier]
mass = { value = 12000, unit = "g" }
inertia = [1, 1, 1]
buoyancy = { displaced_mass = "900 g", center = ["1 mm", 0, 0] }
[[leg]]
ground = [0, 0, -1]
carrier = [0, 0, 0]
length = "250 mm"
stiffness = "40 N/mm"
[[flywheel]]
name = "w1"
mass = 1
spin_inertia = "20 kg  cm^2"
transverse_inertia = "11 kg-cm²"
unbalance = { static = "0.05 g mm", dynamic = 1e-7, dynamic_at = "90 deg" }
motor = { torque = "7.5 oz-in", speed = "6000 1/min", coulomb = 1e-4 }
"""


def test_numbers_with_units_are_listed_as_they_are_written(tmp_path: Path) -> None:
    (tmp_path / "a.toml").write_text(TEXT, encoding="utf-8")
    load(tmp_path / "a.toml")
    found = {(each.where, each.key): each for each in written_numbers(tmp_path / "a.toml")}
    assert found["w1", "unbalance.static"] == Written("w1", "unbalance.static", "0.05 g mm", 5e-8, "kg m")
    assert {key: (each.text, f"{each.value:.6g} {each.unit}") for key, each in found.items()} == {
        ("carrier", "mass"): ("12000 g", "12 kg"),
        ("carrier", "buoyancy.displaced_mass"): ("900 g", "0.9 kg"),
        ("leg[0]", "length"): ("250 mm", "0.25 m"),
        ("leg[0]", "stiffness"): ("40 N/mm", "40000 N/m"),
        ("w1", "spin_inertia"): ("20 kg cm^2", "0.002 kg m^2"),
        ("w1", "transverse_inertia"): ("11 kg-cm²", "0.0011 kg m^2"),
        ("w1", "unbalance.static"): ("0.05 g mm", "5e-08 kg m"),
        ("w1", "unbalance.dynamic_at"): ("90 deg", "1.5708 rad"),
        ("w1", "motor.torque"): ("7.5 oz-in", "0.0529616 N m"),
        ("w1", "motor.speed"): ("6000 1/min", "628.319 rad/s"),
    }


@pytest.mark.parametrize("name", stands.names())
def test_the_examples_are_listed(name: str) -> None:
    units = [each.text for each in written_numbers(stands.path(name))]
    assert len(units) == {"remus6": 29, "sat4": 23}.get(name, 0)


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("0.05 g mm", "-3 g mm", "unbalance, static: -3 g mm (-3e-06 kg m) is negative"),
        ("250 mm", "-250 mm", "leg[0], length: -250 mm (-0.25 m) is negative"),
        ("6000 1/min", "0 rpm", "motor, speed: 0 rpm (0 rad/s) is not above 0"),
        ("11 kg-cm²", "-11 kg-cm²", "transverse_inertia: -11 kg-cm² (-0.0011 kg m^2) is negative"),
        ("value = 12000", "value = -12000", "carrier, mass: -12000 g (-12 kg) is negative"),
        ("1e-7", "-1e-7", "unbalance, dynamic: -1e-07 kg m^2 is negative"),
    ],
)
def test_a_refused_number_is_shown_as_it_is_written(old: str, new: str, words: str) -> None:
    with pytest.raises(StandError) as found:
        loads(TEXT.replace(old, new))
    assert words in str(found.value)
