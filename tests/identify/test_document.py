"""Numbers in the text of a stand file: each form in which a number may stand is kept, and reads as the number."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import mahovik
from mahovik.core.stand import identities, loads
from mahovik.out.campaign.distributions import Fixed
from mahovik.out.campaign.draw import Draw, Parameter
from mahovik.out.campaign.places import Place, Places
from mahovik.out.identify.document import with_numbers

TEXT = """
schema = 1
name = "bench"
gravity = { value = [0, 0, -981], unit = "cm/s^2" }  # down
[carrier]
mass = "8 kg"  # scale
inertia = [0.12, 0.15, 0.2]
damping = { linear = [1, 2, 3, 4, 5, 6] }
[suspension]
stiffness = [4000, 4000, 6000, 60, 60, "80 N m/rad"]  # springs
[[flywheel]]
name = "w1"
axis = [0, 0, 1]
zero = [1, 0, 0]
mass = "800 g"
spin_inertia = 0.0016
transverse_inertia = { value = [9, 9.5], unit = "kg cm^2" }
unbalance = { static = "0.5 g cm", static_at = "10 deg" }  # a guess
[[point]]
name = "imu"
position = ["10 mm", 0, "20 mm"]
"""


def with_value(stand: mahovik.Stand, path: str, value: float) -> tuple[mahovik.Stand, list[Place]]:
    """The stand with another number, as an estimate changes it, and the place of the number."""
    places = Places(stand)
    found = {place.path: place for place in places.find(path)}
    draw = Draw(
        tuple(Parameter(each, Fixed(each.nominal), None) for each in found.values()), (), None, places.matrices()
    )
    changes = draw.changes({name: np.array([value]) for name in found})
    return places.stand().replace({put: values[0] for put, values in changes.items()}), list(found.values())


@pytest.mark.parametrize(
    ("path", "value", "line"),
    [
        ("carrier.mass", 8.25, 'mass = "8.25 kg"  # scale'),
        ("gravity[2]", -9.82, 'gravity = { value = [0, 0, -982.0], unit = "cm/s^2" }  # down'),
        ("suspension.stiffness[1][1]", 4100.0, 'stiffness = [4000, 4100.0, 6000, 60, 60, "80 N m/rad"]  # springs'),
        ("suspension.stiffness[5][5]", 81.0, 'stiffness = [4000, 4000, 6000, 60, 60, "81 N m/rad"]  # springs'),
        ("carrier.damping.linear[0][0]", 1.5, "damping = { linear = [1.5, 2, 3, 4, 5, 6] }"),
        ("w1.spin_inertia", 0.0017, "spin_inertia = 0.0017"),
        ("w1.transverse_inertia[1]", 0.0011, 'transverse_inertia = { value = [9, 11.0], unit = "kg cm^2" }'),
        ("w1.unbalance.static", 2e-6, 'unbalance = { static = "0.2 g cm", static_at = "10 deg" }  # a guess'),
        ("imu.position[0]", 0.012, 'position = ["12 mm", 0, "20 mm"]'),
    ],
)
def test_a_number_keeps_its_form(path: str, value: float, line: str, tmp_path: Path) -> None:
    file = tmp_path / "bench.toml"
    file.write_text(TEXT, encoding="utf-8")
    new, places = with_value(mahovik.load(file), path, value)
    text = with_numbers(TEXT, new, places)
    (changed,) = set(text.splitlines()) - set(TEXT.splitlines())
    assert changed == line
    assert identities(loads(text)) == identities(new)
