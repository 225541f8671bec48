"""Every key of a stand file, in every spelling that it allows; the examples; files of other kinds in its place."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from mahovik import stands
from mahovik.core.stand import dumps, load, loads
from mahovik.core.stand.law import Velocity
from mahovik.core.stand.model import Encoder, MountingAngles, MountingAxes, Point
from mahovik.core.stand.motor import Motor
from mahovik.core.stand.summary import summarize
from mahovik.errors import StandError, UsageError
from mahovik.laws.buoyancy.law import Buoyancy
from mahovik.laws.damping.law import Damping, DampingTerm
from mahovik.laws.leg.law import Leg, legs_of
from mahovik.laws.suspension.law import Suspension
from mahovik.stands import names, path

FULL = """
schema = 1
name = "full"
angles = "zxz"
gravity = [0, 0, "-9.81 m/s^2"]
stream = { value = [1, 0, -0.5], unit = "km/h" }

[carrier]
mass = "12 kg"
center_of_mass = ["0 mm", "4 mm", 0.01]
inertia = { value = [[200, 1, 2], [1, 300, 3], [2, 3, 400]], unit = "g m^2" }
inertia_about = "center_of_mass"
added_mass = ["3 kg", 4, 5, "600 kg cm^2", 0.07, 0.08]
buoyancy = { displaced_mass = "11800 g", center = { value = [0, 0, 30], unit = "mm" } }
wrench_input = true
[carrier.damping]
linear = [1, 2, 3, "4 N m s", "5 N m s/rad", 6]
quadratic = [
  ["1 N s^2/m^2", 0, 0, 0, 0, 7],
  [0, 2, 0, 0, 0, 0],
  [0, 0, 3, 0, 0, 0],
  [0, 0, 0, 4, 0, 0],
  [0, 0, 0, 0, 5, 0],
  [0, 0, 0, 0, 0, 6],
]
terms = [ { wrench = "Y", of = ["u", "r"], value = -3.1 }, { wrench = "N", of = ["r", "|v|"], value = -4.2 } ]

[suspension]
stiffness = ["1 N/mm", 1000, 1000, 60, 60, "60 N m/rad"]
damping = [25, 25, 25, 1, 1, 1]
position = [0, 0, 0.11]
angles = { value = [0, 90, 0], unit = "deg" }

[[leg]]
ground = [0, 0, -1]
carrier = [0, 0, "-10 cm"]
length = 0.9
stiffness = 400.0
damping = 3

[[instrument]]
name = "gyro"
position = [0.1, 0, 0]
angles = ["30 deg", 0, 0]
mass = 1
inertia = [0.01, 0.02, 0.02]
buoyancy = { displaced_mass = 0.5 }

[[instrument]]
name = "mark"

[[flywheel]]
name = "w1"
mount = "gyro"
position = [0.1, 0.2, 0]
angles = [0.3, -0.2, "45 deg"]
mass = 0.8
center_of_mass = [0, 0.002, 0.001]
inertia = [[0.0016, 0, 0], [0, 0.0009, 0], [0, 0, 0.0008]]
inertia_about = "center_of_mass"
buoyancy = { displaced_mass = 0.1 }
damping = { linear = [0, 0, 0, 1e-4, 0, 0] }
[flywheel.motor]
torque = 0.2
speed = "6000 rpm"
constant = 0.03
resistance = 0.5
supply = 24
viscous = 1e-5
coulomb = 5e-4
[flywheel.encoder]
counts = -4096
zero = 12.5
latency = "50 us"

[[flywheel]]
name = "w2"
axis = [0, 0, 2]
zero = [1, 0, 5]
mass = 0.8
spin_inertia = 0.0016
transverse_inertia = 0.0009
unbalance = { static = "0.5 g cm", static_at = 0, dynamic = "2 g cm^2", dynamic_at = "90 deg" }

[[point]]
name = "acc1"
mount = "gyro"
position = [0.1, 0, 0.02]
angles = [0, 0.1, 0]
"""


def diagonal(*x: float) -> tuple[tuple[float, ...], ...]:
    return tuple(tuple(value if i == j else 0.0 for j in range(len(x))) for i, value in enumerate(x))


def test_every_key_is_read() -> None:
    stand = loads(FULL)
    assert (stand.name, stand.angles, stand.gravity) == ("full", "euler", (0.0, 0.0, -9.81))
    assert stand.stream == pytest.approx((1 / 3.6, 0, -0.5 / 3.6), rel=1e-15)

    carrier = stand.carrier
    assert (carrier.name, carrier.mass, carrier.center_of_mass) == ("carrier", 12.0, (0.0, 0.004, 0.01))
    assert carrier.inertia == ((0.2, 0.001, 0.002), (0.001, 0.3, 0.003), (0.002, 0.003, 0.4))
    assert carrier.inertia_about == "center_of_mass"
    assert diagonal(3.0, 4.0, 5.0, 0.06, 0.07, 0.08) == carrier.added_mass
    assert Buoyancy(11.8, (0.0, 0.0, 0.03)) == carrier.law(Buoyancy)
    assert carrier.wrench_input
    damping = carrier.law(Damping)
    assert damping is not None
    assert diagonal(1.0, 2.0, 3.0, 4.0, 5.0, 6.0) == damping.linear
    assert damping.quadratic is not None
    assert damping.quadratic[0] == (1.0, 0.0, 0.0, 0.0, 0.0, 7.0)
    terms = (
        DampingTerm(1, (Velocity(0, False), Velocity(5, False)), -3.1),
        DampingTerm(5, (Velocity(5, False), Velocity(1, True)), -4.2),
    )
    assert terms == damping.terms

    suspension = stand.law(Suspension)
    assert suspension is not None
    assert diagonal(1000.0, 1000.0, 1000.0, 60.0, 60.0, 60.0) == suspension.stiffness
    assert diagonal(25.0, 25.0, 25.0, 1.0, 1.0, 1.0) == suspension.damping
    assert suspension.position == (0.0, 0.0, 0.11)
    assert (0.0, math.pi / 2, 0.0) == suspension.angles
    assert (Leg((0.0, 0.0, -1.0), (0.0, 0.0, -0.1), 0.9, 400.0, 3.0),) == legs_of(stand)

    gyro, mark = stand.instruments
    assert (gyro.name, gyro.position, gyro.mass) == ("gyro", (0.1, 0.0, 0.0), 1.0)
    assert gyro.angles[0] == 0.5235987755982989  # pi/6 rounded once; math.pi / 6 is one bit less
    assert Buoyancy(0.5, (0.0, 0.0, 0.0)) == gyro.law(Buoyancy)
    assert (0.0, diagonal(0.0, 0.0, 0.0), None, False) == (mark.mass, mark.inertia, mark.added_mass, mark.wrench_input)

    w1, w2 = stand.flywheels
    assert (w1.name, w1.mount, w1.position) == ("w1", "gyro", (0.1, 0.2, 0.0))
    assert MountingAngles(0.3, -0.2, math.pi / 4) == w1.mounting
    assert Motor(0.2, 200 * math.pi, 0.03, 0.5, 24.0, 1e-5, 5e-4, 0.1) == w1.motor
    assert Encoder(-4096, 12.5, 5e-5) == w1.encoder
    assert Buoyancy(0.1, (0.0, 0.0, 0.0)) == w1.law(Buoyancy)
    damping = w1.law(Damping)
    assert damping is not None
    assert diagonal(0.0, 0.0, 0.0, 1e-4, 0.0, 0.0) == damping.linear
    assert (damping.quadratic, damping.terms) == (None, ())

    assert (w2.mount, w2.position) == ("carrier", (0.0, 0.0, 0.0))
    assert MountingAxes((0.0, 0.0, 2.0), (1.0, 0.0, 5.0)) == w2.mounting
    assert (w2.motor, w2.encoder) == (None, None)
    assert (Point("acc1", "gyro", (0.1, 0.0, 0.02), (0.0, 0.1, 0.0)),) == stand.points
    assert stand == loads(dumps(stand))


def test_the_least_stand_has_the_documented_defaults() -> None:
    stand = loads('schema = 1\nname = "a"\n[carrier]\nmass = 1\ninertia = [1, 1, 1]\n')
    assert (stand.angles, stand.gravity, stand.stream) == ("ship", (0.0, 0.0, 0.0), None)
    assert (stand.laws, stand.instruments, stand.flywheels, stand.points) == ((), (), (), ())
    carrier = stand.carrier
    assert (carrier.added_mass, carrier.laws, carrier.wrench_input) == (None, (), False)


def test_what_is_all_zero_is_as_if_left_out() -> None:
    bare = 'schema = 1\nname = "a"\n[carrier]\nmass = 1\ninertia = [1, 1, 1]\n'
    zero = (
        bare
        + "added_mass = [0, 0, 0, 0, 0, 0]\nbuoyancy = { displaced_mass = 0 }\n"
        + "damping = { linear = [0, 0, 0, 0, 0, 0], quadratic = [0, -0.0, 0, 0, 0, 0], terms = [] }\n"
        + "[suspension]\nstiffness = [0, 0, 0, 0, 0, 0]\nposition = [0, 0, 1]\n"
    )
    assert loads(bare) == loads(zero)
    assert loads("stream = [0, 0, 0]\n" + bare).stream == (0.0, 0.0, 0.0)  # the key alone makes it an input


def test_phase_input_is_read_and_written_back() -> None:
    text = (
        'schema = 1\nname = "a"\nphase_input = "sincos"\n[carrier]\nmass = 1\ninertia = [1, 1, 1]\n'
        '[[flywheel]]\nname = "w"\nmass = 1\ninertia = [1, 1, 1]\n'
    )
    stand = loads(text)
    assert stand.phase_input == "sincos"
    assert loads(text.replace('phase_input = "sincos"\n', "")).phase_input == "angle"
    assert loads(dumps(stand)) == stand


def test_the_examples_are_there() -> None:
    assert names() == ("auv6", "bench8", "demo3", "eye4", "remus6", "sat4", "shaker2", "two_exciters")


@pytest.mark.parametrize("name", names())
def test_each_loads_under_its_own_name_and_says_what_it_shows(name: str) -> None:
    assert name == load(path(name)).name
    assert path(name).read_text().startswith("# ")


def test_an_unknown_example_is_a_usage_error() -> None:
    with pytest.raises(UsageError, match='no example stand "bench9", did you mean "bench8"'):
        path("bench9")


def test_remus6_has_the_published_totals() -> None:
    """30.48 kg, centre of gravity 19.6 mm below the centre of buoyancy, 0.177 and 3.45 kg m2 about that."""
    stand = load(path("remus6"))
    summary = summarize(stand)
    assert summary.mass == pytest.approx(30.48, rel=1e-12)
    assert np.array(summary.center_of_mass) == pytest.approx(np.array([0, 0, 0.0196]), abs=1e-7)
    assert stand.flywheels[5].mount == "nose"


def test_bench8_weight_hangs_at_its_suspension() -> None:
    """The suspension is raised by weight / stiffness, as its file says."""
    stand = load(path("bench8"))
    held = stand.law(Suspension)
    assert held is not None
    assert held.position[2] == pytest.approx(summarize(stand).mass * 9.81 / 1633.5, rel=1e-8)


FOLDER = stands.path("bench8").parent


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("bench8.motion.json", "is JSON, as motions and programmes are; expected a stand file (TOML)"),
        ("servos/bench8.toml", "is a file of servos, expected a stand file"),
    ],
)
def test_a_file_of_another_kind_is_named(name: str, words: str) -> None:
    with pytest.raises(StandError) as error:
        load(FOLDER / name)
    assert str(error.value) == f"{Path(name).name}: {words}"


def test_a_regime_is_named(tmp_path: Path) -> None:
    (tmp_path / "r.toml").write_text('schema = 1\n[default]\nspeed = "3000 rpm"\n')
    with pytest.raises(StandError, match=r"r.toml: is a regime, expected a stand file"):
        load(tmp_path / "r.toml")
