"""Numbers of a stand file as they are written: in `check`, and in the messages that refuse them."""

from __future__ import annotations

from pathlib import Path

import pytest

from cli.run import run
from mahovik.core.stand import load
from mahovik.core.stand.numbers import Written, written_numbers
from mahovik.core.stand.stand_file import document_at

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
    numbers = {(number.where, number.key): number for number in written_numbers(document_at(tmp_path / "a.toml"))[0]}
    assert numbers["w1", "unbalance.static"] == Written("w1", "unbalance.static", "0.05 g mm", 5e-8, "kg m")
    assert {key: (number.text, number.in_si) for key, number in numbers.items()} == {
        ("carrier", "mass"): ("12000 g", "12 kg"),
        ("carrier", "buoyancy.displaced_mass"): ("900 g", "0.9 kg"),
        ("carrier", "buoyancy.center"): ("[1 mm, 0, 0]", "[0.001, 0, 0] m"),
        ("leg[0]", "length"): ("250 mm", "0.25 m"),
        ("leg[0]", "stiffness"): ("40 N/mm", "40000 N/m"),
        ("w1", "spin_inertia"): ("20 kg cm^2", "0.002 kg m^2"),
        ("w1", "transverse_inertia"): ("11 kg-cm²", "0.0011 kg m^2"),
        ("w1", "unbalance.static"): ("0.05 g mm", "5e-08 kg m"),
        ("w1", "unbalance.dynamic_at"): ("90 deg", "1.5708 rad"),
        ("w1", "motor.torque"): ("7.5 oz-in", "0.0529616 N m"),
        ("w1", "motor.speed"): ("6000 1/min", "628.319 rad/s"),
    }


LISTS = """schema = 1
name = "b"
gravity = { value = [0, 0, -981], unit = "cm/s^2" }
magnetic_field = ["20 uT", 0, 0.00001]
[carrier]
mass = 12
inertia = [1, 1, "10000 kg cm^2"]
center_of_mass = [1.50, "-2 mm", { value = 3, unit = "cm" }]
inertia_about = "center_of_mass"
added_mass = ["1000 g", 1, 1, 0.1, 0.1, "1000 kg cm^2"]
[[flywheel]]
name = "w1"
mass = 1
inertia = { value = [[20, 0, 0], [0, 11, 0.5], [0, 0.5, 11]], unit = "kg cm^2" }
[[flywheel]]
name = "w2"
mass = 1
angles = ["90 deg", 0]
inertia = [[0.002, 0, 0], { value = [0, 11, 0], unit = "kg cm^2" }, [0, 0, "0.0011 kg m^2"]]
[[flywheel]]
name = "w3"
mass = 1
spin_inertia = 0.002
transverse_inertia = ["11 kg cm^2", 0.0012]
[[torquer]]
name = "m1"
dipole = [0, "3 A m^2", 0]
[[point]]
name = "p"
position = [0, "3 mm", 0]
"""


FIN = """schema = 1
name = "rov"
[carrier]
mass = 20
inertia = [[1, 0.{0}, 0], [0.{1}, 1, 0], [0, 0, 1]]
added_mass = [[9, 0, 0, 0, 0, 0], [0, 40, 0, 0, 0, {2}], [0, 0, 40, 0, 0, 0],
              [0, 0, 0, 1, 0, 0], [0, 0, 0, 0, 4, 0], [0, {3}, 0, 0, 0, 10]]
[[point]]
name = "tip"
angles = [0, {4}, 0]
"""


@pytest.mark.parametrize(
    ("numbers", "lines"),
    [
        (("124", "124", "1.5", "1.5", "1.5"), []),
        (("124", "125", "1.5", "1.5", "1.5"), ["carrier.inertia: [0][1] = 0.124 kg m^2 but [1][0] = 0.125 kg m^2"]),
        (("124", "124", "1.51", "1.5", "1.5"), ["carrier.added_mass: [1][5] = 1.51 kg m but [5][1] = 1.5 kg m"]),
        (("124", "124", "1.5", "1.5", "90"), ["tip.angles: [0, 90, 0] rad is beyond a whole turn"]),
        (("124", "124", "1.5", "1.5", '"450 deg"'), []),
    ],
)
def test_check_names_elements_of_which_the_mean_counts_and_angles_in_degrees(
    numbers: tuple[str, ...], lines: list[str], tmp_path: Path
) -> None:
    file = tmp_path / "rov.toml"
    file.write_text(FIN.format(*numbers))
    assert [
        line.partition(": not")[0].partition(": degrees")[0] for line in written_numbers(document_at(file))[1]
    ] == lines
    shown = run("check", str(file)).stdout
    assert all(f"warning: {line}" in shown for line in lines)
    J = load(file).carrier.inertia
    assert J[0][1] == J[1][0] == pytest.approx(0.5 * (float(f"0.{numbers[0]}") + float(f"0.{numbers[1]}")), rel=1e-15)
