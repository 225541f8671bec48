"""What `check` says of a stand: figures by hand and by other means, warnings of plausible slips."""

from __future__ import annotations

import math
from dataclasses import replace
from itertools import product

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.optimize import linprog
from scipy.spatial import ConvexHull

from mahovik import stands
from mahovik.core.stand import Stand, load, loads
from mahovik.core.stand.capacity import Envelope, momentum_capacity, torque_capacity
from mahovik.core.stand.masses import mass_properties, mean_stand
from mahovik.core.stand.model import State
from mahovik.core.stand.random import random_stand, random_state
from mahovik.core.stand.summary import summarize
from mahovik.proof import reference
from mahovik.stands import path

BASE = 'schema = 1\nname = "a"\nangles = "{angles}"\ngravity = {gravity}\n[carrier]\nmass = 1\ninertia = [1, 1, 1]\n'


def wheel(extra: str = "") -> str:
    return (
        '[[instrument]]\nname = "i"\nmass = 1\ninertia = [1, 1, 1]\nposition = [1, 0, 0]\nangles = ["90 deg", 0, 0]\n'
        '[[flywheel]]\nname = "w"\nmount = "i"\nposition = [0, 2, 0]\naxis = [0, 0, 1]\nzero = [1, 0, 0]\nmass = 2\n'
        'spin_inertia = 0.02\ntransverse_inertia = [0.011, 0.012]\n'
        'unbalance = {{ static = "30 g mm", static_at = "90 deg", dynamic = "400 g mm^2" }}\n' + extra
    )  # fmt: skip


def stand(angles: str = "ship", gravity: str = "[0, 0, 0]", extra: str = "") -> Stand:
    return loads((BASE + wheel(extra)).format(angles=angles, gravity=gravity))


def test_masses_and_centres_in_the_carrier_frame() -> None:
    summary = summarize(stand())
    assert [(row.name, row.kind, row.mount) for row in summary.bodies] == [
        ("carrier", "carrier", ""),
        ("i", "instrument", "carrier"),
        ("w", "flywheel", "i"),
    ]
    # w: 2 m along axis 2 of the instrument, which is -axis 1 of the carrier; r = 15 um along axis 3 of Es, the same way
    assert summary.bodies[2].center_of_mass == pytest.approx((1 - 2 - 15e-6, 0, 0), abs=1e-15)
    assert summary.mass == 4.0
    assert summary.center_of_mass == pytest.approx((1 / 4 + 2 * (-1 - 15e-6) / 4, 0, 0), abs=1e-15)


def test_unbalance_in_si_and_its_force() -> None:
    (row,) = summarize(stand(), speed=1000.0).unbalance
    assert row.static == pytest.approx(30e-6)
    assert row.dynamic == pytest.approx(400e-9)
    assert row.asymmetry == pytest.approx(-1e-3)
    assert row.spin_inertia == 0.02
    assert row.force == pytest.approx(30e-6 * 1e6)
    assert row.moment == pytest.approx(400e-9 * 1e6)


def test_the_speed_is_asked_or_the_motors_or_3000_rpm() -> None:
    with_motor = stand(extra='motor = {{ speed = "6000 rpm" }}\n')
    assert [
        summarize(example, speed).unbalance[0].speed
        for example, speed in ((stand(), None), (with_motor, None), (with_motor, 5.0))
    ] == pytest.approx([100 * math.pi, 200 * math.pi, 5.0])


@pytest.mark.parametrize(
    ("angles", "gravity", "is_heading"),
    [
        ("ship", "[0, 0, -9.81]", False),
        ("aircraft", "[0, 0, -9.81]", True),
        ("aircraft", "[0, -9.81, 0]", False),
        ("ship", "[0, 9.81, 0]", True),
        ("ship", "[9.81, 0, 0]", False),
        ("ship", "[0.4, 0, -9.8]", False),
        ("ship", "[0, 0, 0]", False),
        ("euler", "[0, 0, 0]", True),
    ],
)
def test_a_singularity_that_is_a_heading_is_a_warning(angles: str, gravity: str, is_heading: bool) -> None:
    warnings = summarize(stand(angles, gravity)).warnings
    assert is_heading == any("singular" in warning for warning in warnings)


def test_weight_that_nothing_carries_is_a_warning() -> None:
    warnings = summarize(stand(gravity="[0, 0, -9.81]")).warnings
    assert warnings == ("nothing carries the weight (no suspension, leg or buoyancy): the stand falls freely",)
    assert summarize(load(path("bench8"))).warnings == ()


GOOD = """schema = 1
name = "a"
[carrier]
mass = 10
inertia = [0.1, 0.1, 0.1]
center_of_mass = ["2 mm", 0, 0]
inertia_about = "center_of_mass"
[[instrument]]
name = "camera"
mass = 1
inertia = [0.002, 0.002, 0.002]
position = ["300 mm", 0, 0]
[[flywheel]]
name = "w1"
position = ["120 mm", 0, 0]
axis = [0, 0, 1]
zero = [1, 0, 0]
mass = 1
spin_inertia = 0.002
transverse_inertia = 0.0011
unbalance = { static = "12 g mm" }
[[flywheel]]
name = "w2"
position = ["-120 mm", 0, 0]
axis = [0, 0, 1]
zero = [1, 0, 0]
mass = 1
spin_inertia = 0.002
transverse_inertia = 0.0011
unbalance = { static = "11 g mm" }
[[point]]
name = "tip"
position = ["500 mm", 0, 0]
"""


def warnings(*changes: tuple[str, str]) -> tuple[str, ...]:
    text = GOOD
    for old, new in changes:
        assert old in text
        text = text.replace(old, new)
    return summarize(loads(text)).warnings


def motor(speed: str) -> tuple[str, str]:
    """The change that gives w1 a motor of this speed."""
    wheel = 'unbalance = { static = "12 g mm" }'
    return wheel, f"motor = {{ speed = {speed} }}\n{wheel}"


def spun(inertia: str) -> tuple[str, str]:
    """The change that makes w1 a wheel of 2.4 kg with this inertia about all axes."""
    old = 'mass = 1\nspin_inertia = 0.002\ntransverse_inertia = 0.0011\nunbalance = { static = "12'
    return old, f'mass = 2.4\nspin_inertia = "{inertia}"\ntransverse_inertia = "{inertia}"\nunbalance = {{ static = "12'


SLIPS = [
    # 1.5 mm at 3000 rpm is 471 mm/s
    (
        ("12 g mm", "150 g cm"),
        "flywheel w1: a static unbalance of 1500 g mm on 1 kg is G 630 at 3000 rpm, 11.8 times G 40: "
        "a slip in its unit, or a working moment, which is twice it?",
    ),
    # 0.1 kg m2 as numbers of kg mm2: sqrt(1.5e5/10) m, where the tip is at 0.5 m
    (
        ("[0.1, 0.1, 0.1]", "[1e5, 1e5, 1e5]"),
        "carrier: its radius of gyration is 122 m, 246 times the distance of what stands on it; it would be lighter "
        "than any gas: a slip in the unit of its inertia or mass?",
    ),
    # a disc of 1 kg and 0.002 kg m2 has a radius of 63.2 mm
    (
        motor("6000"),
        "flywheel w1: at 6000 rad/s, 57296 rpm, the rim of a disc of its mass and inertia, of 0.0632 m, runs at "
        "379.5 m/s, above 300: rpm written as rad/s?",
    ),
    # sqrt(1.5 191/2.4) m, beside 0.122 m of the carrier
    (
        spun("191 kg m^2"),
        "w1: its radius of gyration is 10.9 m, 89.2 times the largest of the other bodies: a slip in the unit of its "
        "inertia or mass?",
    ),
    # sqrt(0.3/20) = 0.122 m: the origin is outside beyond 0.367 m
    (
        ('["2 mm"', '["0.4 m"'),
        "carrier: its centre of mass is 0.4 m from the origin of its frame, 3.27 times its radius of gyration of "
        "0.122 m, which is outside the body: a slip in the unit?",
    ),
    (('["120 mm"', '["120 m"'), "flywheel w1: its position is 120 m from the middle of the bodies, "),
    (('["300 mm"', "[300"), "instrument camera: its position is 300 m from the middle of the bodies, "),
    (('["500 mm"', "[3.7"), "point tip: its position is 3."),
]


@pytest.mark.parametrize(("change", "words"), SLIPS)
def test_a_slip_is_named_with_its_numbers(change: tuple[str, str], words: str) -> None:
    assert any(line.startswith(words) for line in warnings(change))


@pytest.mark.parametrize(
    "change",
    [
        ("12 g mm", "120 g cm"),  # 377 mm/s
        ("[0.1, 0.1, 0.1]", "[100, 100, 100]"),
        motor('"6000 rpm"'),
        spun("191 kg cm^2"),
        ('["2 mm"', '["0.36 m"'),
        ('["500 mm"', "[3.3"),
    ],
)
def test_what_a_little_less_is_no_slip(change: tuple[str, str]) -> None:
    assert not any("slip" in line or "rpm written" in line for line in warnings(change))


@pytest.mark.parametrize("name", stands.names())
def test_the_examples_have_no_slips(name: str) -> None:
    assert not any("slip" in line for line in summarize(load(stands.path(name))).warnings)


def test_flywheels_that_are_all_unbalanced_are_so_on_purpose() -> None:
    """Shakers and vibration motors, also with the speed of a motor."""
    both = (("12 g mm", "150 g cm"), ("11 g mm", "160 g cm"))
    assert warnings(*both) == warnings(motor('"3000 rpm"'), *both) == ()


def test_a_free_carrier_without_mass() -> None:
    text = GOOD.replace("mass = 10\n", "mass = 0\n").replace('center_of_mass = ["2 mm", 0, 0]\n', "")
    instrument = text[text.index("[[instrument]]") : text.index('[[flywheel]]\nname = "w1"')]
    assert not any("its mass is 0" in line for line in summarize(loads(text)).warnings)
    bare = summarize(loads(text.replace(instrument, ""))).warnings
    assert any(line.startswith("carrier: its mass is 0") for line in bare)
    held = text.replace(instrument, "").replace("[[flywheel]]", '[hold]\nfreedoms = ["yaw"]\n[[flywheel]]', 1)
    assert not any("its mass is 0" in line for line in summarize(loads(held)).warnings)


@pytest.mark.parametrize("excess", [0.999, 1.001])
def test_the_densest_ball_is_the_bound(excess: float) -> None:
    """A ball of osmium of 2.4 kg has the inertia 2/5 m r^2; a little less is impossible."""
    radius = (2.4 / 22.6e3 / (4 / 3 * math.pi)) ** (1 / 3)
    lines = warnings(spun(f"{0.4 * 2.4 * radius**2 / excess!r} kg m^2"))
    assert any("osmium" in line for line in lines) == (excess > 1.0)


FLOATING = """schema = 1
name = "rov"
gravity = [0, 0, -9.81]
[carrier]
mass = 13.5
inertia = [0.26, 0.23, 0.37]
added_mass = [1.272, 1.424, 3.736, 0.0378, 0.027, 0.0444]
buoyancy = { displaced_mass = 13.5, center = [0, 0, 0.03] }
damping = { linear = [13.7, 1, 23, 0.5, 0.8, 0.1], quadratic = [14.1, 21.7, 19, 0.119, 0.047, 0.15] }
"""
SUSPENSION = "[suspension]\nstiffness = [1e3, 1e3, 1e3, 9, 9, 9]\ndamping = [1, 1, 1, 1, 1, 1]\n"


@pytest.mark.parametrize(
    ("old", "new", "line"),
    [
        ("linear = [13.7, 1,", "linear = [-13.7, -1,", "carrier: damping.linear has -13.7 for u, -1 for v: it drives"),
        ("0.047, 0.15", "0.047, -0.15", "carrier: damping.quadratic has -0.15 for r: it drives"),
        (
            "added_mass",
            "fading_damping = { linear = [1, 1, -23, 1, 1, 1], rate = 3 }\nadded_mass",
            "carrier: fading_damping.linear has -23 for w: it drives",
        ),
        ("stiffness = [1e3", "stiffness = [-1e3", "suspension.stiffness has -1000 for u: it pushes away"),
        ("damping = [1, 1, 1, 1", "damping = [1, 1, 1, -1", "suspension.damping has -1 for p: it drives"),
    ],
)
def test_a_sign_on_a_diagonal_that_drives(old: str, new: str, line: str) -> None:
    text = FLOATING + SUSPENSION
    assert old in text and summarize(loads(text)).warnings == ()
    (warning,) = summarize(loads(text.replace(old, new))).warnings
    assert warning.startswith(line)


def test_a_center_of_buoyancy_below_the_centre_of_mass_of_what_can_tilt() -> None:
    below = FLOATING.replace("0.03]", "-0.03]")
    assert summarize(loads(FLOATING)).warnings == ()
    (line,) = summarize(loads(below)).warnings
    assert line.startswith("buoyancy: its centre is 30 mm below the centre of mass")
    down = below.replace("-9.81", "9.81")
    assert summarize(loads(below + SUSPENSION)).warnings == summarize(loads(down)).warnings == ()
    for freedom, warned in (("yaw", False), ("roll", True)):
        held = summarize(loads(f'{below}[hold]\nfreedoms = ["{freedom}"]\n')).warnings
        assert (line in held) == warned


CARRIER = 'schema = 1\nname = "a"\n[carrier]\nmass = 3\ninertia = [0.5, 0.6, 0.7]\n'


def placed(name: str, axis: str, extra: str = "", position: str = "[0, 0, 0]") -> str:
    zero = "[0, 1, 1]" if axis == "[1, 0, 0]" else "[1, 0, 0]"
    return (
        f'[[flywheel]]\nname = "{name}"\nposition = {position}\naxis = {axis}\nzero = {zero}\nmass = 1\n'
        f"spin_inertia = 0.02\ntransverse_inertia = 0.011\n{extra}\n"
    )


def loaded(*wheels: str) -> Stand:
    return loads(CARRIER + "".join(wheels))


def test_a_wheel_beside_the_carrier() -> None:
    """3 kg and 1 kg at 0.4 m: the centre at 0.1 m, the reduced mass 0.75 kg, 0.75 x 0.4^2 = 0.12 kg m2 across."""
    properties = mass_properties(loaded(placed("w", "[0, 0, 1]", position="[0.4, 0, 0]")))
    assert properties.mass == 4.0
    assert properties.center_of_mass == pytest.approx((0.1, 0.0, 0.0))
    moments = (0.5 + 0.011, 0.6 + 0.011 + 0.12, 0.7 + 0.02 + 0.12)
    assert np.allclose(properties.inertia, np.diag(moments), rtol=0, atol=1e-15)
    assert properties.principal_inertia == pytest.approx(moments)
    assert np.allclose(properties.principal_axes, np.eye(3), rtol=0, atol=1e-12)


def test_an_instrument_is_turned_with_its_wheel() -> None:
    """The instrument's axis 1 is axis 2 of E1; a wheel along it adds 0.02 there, 0.011 across."""
    text = (
        '[[instrument]]\nname = "i"\nmass = 0\nangles = ["90 deg", 0, 0]\nposition = [0, 0, 0]\n'
        + placed("w", "[1, 0, 0]", 'mount = "i"')
    )  # fmt: skip
    assert np.diag(mass_properties(loaded(text)).inertia) == pytest.approx([0.511, 0.62, 0.711])


MOTOR = 'motor = {{ torque = {}, speed = "{} rpm" }}'


def test_capacity_of_three_wheels_on_the_axes() -> None:
    """0.02 kg m2 at 3000 rpm is 2 pi N m s; a box of three axes has its least reach along the shortest."""
    x, y, z = (MOTOR.format(torque, speed) for torque, speed in ((0.1, 3000), (0.2, 6000), (0.3, 3000)))
    triad = loaded(placed("x", "[1, 0, 0]", x), placed("y", "[0, 1, 0]", y), placed("z", "[0, 0, 1]", z))
    momentum, torque = momentum_capacity(triad), torque_capacity(triad)
    h = 2 * math.pi
    assert momentum.each == pytest.approx((h, 2 * h, h))
    assert momentum.axes == pytest.approx((h, 2 * h, h))
    assert (momentum.total, momentum.direction) == pytest.approx((4 * h, h))
    assert torque.axes == pytest.approx((0.1, 0.2, 0.3))
    assert (torque.total, torque.direction) == pytest.approx((0.6, 0.1))


@pytest.mark.parametrize(("tilt", "direction"), [(1.2e-9, 0.0), (1.7e-9, 1.7e-9)])
def test_wheels_reach_across_a_plane_that_they_leave_by_more_than_rounding(tilt: float, direction: float) -> None:
    """Two wheels along one axis but for a tilt, across which the least singular value of the axes is tilt/sqrt 2."""
    axes = ("[1, 0, 0]", "[0, 1, 0]", f"[0, 1, {tilt}]")
    capacity = torque_capacity(
        loaded(*(placed(f"w{k}", axis, "motor = { torque = 1 }") for k, axis in enumerate(axes)))
    )
    assert capacity.direction == pytest.approx(direction, rel=1e-6, abs=0.0)


@pytest.mark.parametrize(
    ("keys", "static_at", "dynamic_at"),
    [
        ('static = "3 g mm", static_at = "70 deg"', 70.0, None),
        ('static = "3 g mm", dynamic = "9 g mm^2", dynamic_at = "-20 deg"', 0.0, -20.0),
        ('dynamic = "9 g mm^2", dynamic_at = "135 deg"', None, 135.0),
        ('dynamic = "9 g mm^2", dynamic_at = "180 deg"', None, 180.0),
    ],
)
def test_angles_of_unbalance_are_those_of_the_file(
    keys: str, static_at: float | None, dynamic_at: float | None
) -> None:
    (row,) = summarize(loaded(placed("w", "[1, 0, 0]", f"unbalance = {{ {keys} }}"))).unbalance
    for angle, expected in ((row.static_at, static_at), (row.dynamic_at, dynamic_at)):
        assert (angle is None) == (expected is None)
        assert angle is None or expected is None or math.degrees(angle) == pytest.approx(expected)


PHASES = 2.0 * np.pi * np.arange(8) / 8.0


def at_phase(state: State, phase: float) -> State:
    return replace(state, phi=tuple(phi + phase for phi in state.phi))


def matrices(stand: Stand, state: State) -> tuple[np.ndarray, np.ndarray]:
    parts = reference.pieces(stand, state)
    return parts.K, parts.I


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_k_and_i_are_their_means_over_the_phases(seed: int) -> None:
    rng = np.random.default_rng(seed)
    stand = random_stand(rng, 3)
    state = random_state(stand, rng, phase_limit=10.0)
    at_phases = [matrices(stand, at_phase(state, phase)) for phase in PHASES]
    for k, mean in enumerate(matrices(mean_stand(stand), state)):
        expected = np.mean([pair[k] for pair in at_phases], axis=0)
        assert mean == pytest.approx(expected, rel=1e-12, abs=1e-12 * np.abs(expected).max())


Array = np.ndarray


PYRAMID = np.array([[1, 1, 1], [-1, 1, 1], [-1, -1, 1], [1, -1, 1]]) / np.sqrt(3)


def corners(columns: Array) -> Array:
    return np.asarray(np.array(list(product((-1.0, 1.0), repeat=len(columns)))) @ columns)


@settings(max_examples=25, deadline=None)
@given(st.integers(3, 7), st.integers(0, 10_000))
def test_facets_are_those_of_the_hull_of_all_corners_of_the_box(count: int, seed: int) -> None:
    rng = np.random.default_rng(seed)
    columns = rng.normal(size=(count, 3)) * rng.uniform(0.1, 3.0, (count, 1))
    envelope, points = Envelope(columns), corners(columns)
    hull = ConvexHull(points)
    planes = {tuple(np.round(row, 7)) for row in hull.equations}
    ours = np.column_stack([envelope.normals, -envelope.distances])
    assert 2 * len(ours) == len(planes) == count * (count - 1)
    for plane in (*ours, *(ours * [-1, -1, -1, 1])):
        assert min(np.abs(plane - np.array(other)).max() for other in planes) < 1e-6
    assert envelope.radius == pytest.approx(-hull.equations[:, 3].max(), rel=1e-9)
    assert np.max(points @ envelope.normals.T, axis=0) == pytest.approx(envelope.distances, rel=1e-9)


@settings(max_examples=25, deadline=None)
@given(st.integers(1, 6), st.integers(0, 10_000), st.sampled_from([1, 2, 3]))
def test_a_ray_ends_where_a_linear_programme_says(count: int, seed: int, rank: int) -> None:
    rng = np.random.default_rng(seed)
    columns = rng.normal(size=(count, rank)) @ np.linalg.qr(rng.normal(size=(3, 3)))[0][:rank]
    direction = rng.normal(size=count) @ columns if seed % 2 else rng.normal(size=3)
    direction = direction / np.linalg.norm(direction)
    programme = linprog(
        [*np.zeros(count), -1.0],
        A_eq=np.column_stack([columns.T, -direction]),
        b_eq=np.zeros(3),
        bounds=[(-1, 1)] * count + [(0, None)],
    )
    assert Envelope(columns).reach(direction) == pytest.approx(programme.x[-1], rel=1e-6, abs=1e-7)


def test_the_worst_directions_of_a_pyramid_are_between_its_faces() -> None:
    facets = Envelope(PYRAMID)
    assert facets.radius == pytest.approx(4 / np.sqrt(6))
    assert len(facets.normals) == len(facets.worst) == 6  # a rhombic dodecahedron: every facet is as near
    for direction in facets.worst:
        assert np.sort(np.abs(direction)) == pytest.approx([0.0, np.sqrt(0.5), np.sqrt(0.5)], abs=1e-12)
        assert facets.reach(direction) == pytest.approx(facets.radius)


def test_wheels_in_a_plane_or_in_a_line_leave_a_direction_named() -> None:
    flat = Envelope(np.array([[1.0, 0, 0], [0, 2.0, 0], [1.0, 1.0, 0], [0, 0, 0]]))
    assert flat.radius == 0.0 and flat.worst == ((0.0, 0.0, 1.0),)
    assert flat.reach([0, 0, 1]) == 0.0 and flat.reach([0, 1, 0]) == pytest.approx(3.0)
    line = Envelope(np.array([[0, 0, 3.0], [0, 0, -1.0]]))
    assert line.radius == 0.0 and line.worst[0][2] == 0.0
    assert line.reach([0, 0, -1]) == pytest.approx(4.0) and line.reach([1, 0, 1]) == 0.0
    assert Envelope(np.zeros((0, 3))).worst == () and Envelope(np.zeros((1, 3))).reach([1, 0, 0]) == 0.0
