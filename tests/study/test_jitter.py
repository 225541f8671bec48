"""Vibration by lines of free stands: closed forms, the periodic response, slow beats, makers' tables, modes."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mahovik.core.stand import Stand, load
from mahovik.errors import CheckError
from mahovik.proof.reference import pieces
from mahovik.proof.reference.momentum import momentum_in_E0
from mahovik.proof.reference.motion import mounts
from mahovik.stands import path
from mahovik.use.study.linear.model import places
from mahovik.use.vibration.balance import _Search, balance
from mahovik.use.vibration.band import in_band, rms
from mahovik.use.vibration.chain import Makers
from mahovik.use.vibration.csv_table import JitterFileError
from mahovik.use.vibration.maker import InnerModes, read_harmonics, read_inner_modes
from mahovik.use.vibration.periodic import periodic_response
from mahovik.use.vibration.scene import Scene
from mahovik.use.vibration.speeds import read_speeds
from mahovik.use.vibration.structure import read_structure
from mahovik.use.vibration.study import Jitter, jitter
from mahovik.use.vibration.torus import Torus
from mahovik.use.vibration.torus_motion import Balance, full_motion
from mahovik.use.vibration.view import find_view

M_CARRIER, M_WHEEL, J_TRANSVERSE, J_SPIN = 40.0, 2.0, 3.0, 0.02

HEAD = f"""
schema = 1
name = "one"
[carrier]
mass = {M_CARRIER}
inertia = [{J_TRANSVERSE}, {J_TRANSVERSE}, 2.0]
[[point]]
name = "eye"
angles = ["90 deg", 0, 0]
"""

WHEEL = """
[[flywheel]]
name = "w"
axis = [0, 0, 1]
zero = [1, 0, 0]
mass = {mass}
spin_inertia = {spin}
transverse_inertia = 0.011
unbalance = {{ {unbalance} }}
"""


def one_wheel(folder: Path, unbalance: str, more: str = "") -> Stand:
    """The stand with a wheel of this unbalance, and more tables."""
    file = folder / "one.toml"
    file.write_text(HEAD + WHEEL.format(mass=M_WHEEL, spin=J_SPIN, unbalance=unbalance) + more)
    return load(file)


OMEGA = 240.0
SUSPENSION = """
[suspension]
stiffness = [9e5, 9e5, 9e5, 50, 50, 50]
damping = [40, 40, 40, 0.1, 0.1, 0.1]
"""


def vibration(
    stand: Stand, speeds: list[str], quantity: str, point: str = "eye", steps: int = 1, makers: Makers | None = None
) -> Jitter:
    """Vibration of a point by name."""
    return jitter(
        stand, read_speeds(stand, speeds), steps, find_view(stand, point, quantity), makers=makers or Makers()
    )


STATIC, DYNAMIC = 'static = "5 g cm"', 'dynamic = "20 g cm^2"'
RADIUS = 5e-5 / (M_CARRIER + M_WHEEL)
"""m: in the plane both bodies go round the common centre of mass, and nothing turns."""
SPRUNG = 5e-5 * OMEGA**2 / abs(9e5 - (M_CARRIER + M_WHEEL) * OMEGA**2 + 40j * OMEGA)
ANGLE = 2e-6 / (J_TRANSVERSE + 0.011 - J_SPIN)
"""rad: J theta'' - i H theta' = U Omega^2 exp(i Omega t), theta = theta_x + i theta_y, H the wheel's spin momentum."""


@pytest.mark.parametrize(
    ("unbalance", "more", "quantity", "size"),
    [
        (STATIC, "", "displacement", RADIUS),
        (STATIC, "", "acceleration", RADIUS * OMEGA**2),
        (STATIC, SUSPENSION, "displacement", SPRUNG),
        (DYNAMIC, "", "angle", ANGLE),
        (DYNAMIC, "", "rate", ANGLE * OMEGA),
    ],
)
def test_unbalance_by_closed_form(unbalance: str, more: str, quantity: str, size: float, tmp_path: Path) -> None:
    stand = one_wheel(tmp_path, unbalance, more)
    found = vibration(stand, [f"w={OMEGA}"], quantity)
    first = [(name.wheel, name.order) for name in found.lines.names].index(("w", 1.0))
    assert found.lines.sizes[0, first] == pytest.approx([size, size, 0.0], rel=1e-6, abs=1e-16)


@pytest.mark.parametrize(
    ("name", "speeds", "point"),
    [
        ("sat4", ["rw1=3000rpm", "rw2=2000rpm", "rw3=-1000rpm"], "acc1"),
        ("sat4", ["all=3000rpm"], "acc1"),
        ("bench8", ["w1=60", "w2=-40", "w3=20"], "carrier"),
    ],
)
def test_with_a_common_period_it_is_the_periodic_response(name: str, speeds: list[str], point: str) -> None:
    stand, quantity = load(path(name)), "acceleration"
    asked = read_speeds(stand, speeds)
    found = vibration(stand, speeds, quantity, point)
    other = periodic_response(stand, asked.speeds(0.0))
    wanted = rms(other.harmonics(find_view(stand, point, quantity)), other.frequencies)
    assert found.lines.rms()[0] == pytest.approx(wanted, rel=1e-6)


def test_an_undamped_resonance_is_said(tmp_path: Path) -> None:
    rate = 9e5 / (M_CARRIER + M_WHEEL)
    stand = one_wheel(tmp_path, 'static = "5 g cm"', SUSPENSION.replace("damping = [40, 40, 40, 0.1, 0.1, 0.1]", ""))
    with pytest.raises(CheckError, match="no steady motion found"):
        balance(stand, [float(np.sqrt(rate))])


def test_a_line_on_the_end_of_a_band_is_within() -> None:
    """A speed of 1800 rpm is 30.000000000000004 Hz: jitter, response, quiet and campaigns ask one function."""
    rounded = np.nextafter(30.0, [0.0, np.inf])
    assert in_band(rounded, (30.0, 60.0)).all() and in_band(rounded, (15.0, 30.0)).all()
    assert not in_band(30.0 * (1.0 + 2e-9), (10.0, 30.0)) and not in_band(10.0 * (1.0 - 2e-9), (10.0, 30.0))


RPM = np.pi / 30
SAT4 = load(path("sat4"))
NEARLY_EQUAL: tuple[list[float], ...] = (
    [3000, 2995, 3000, 3000],
    [3000, 2999.99, 0, 0],
)


def solve(speeds: list[float]) -> Balance:
    """The motion at speeds in rpm."""
    return balance(SAT4, [RPM * x for x in speeds])


@pytest.mark.parametrize("speeds", NEARLY_EQUAL, ids=str)
def test_momentum_is_constant_along_the_motion(speeds: list[float]) -> None:
    """Momentum in E0 by the literal reference: a carrier that turned by a false beat would show it."""
    found, rng = solve(speeds), np.random.default_rng(3)
    angles = rng.uniform(0.0, 2.0 * np.pi, (12, len(found.turning)))
    Z = np.array([momentum_in_E0(pieces(SAT4, found.state(theta))) for theta in angles])
    spin = np.linalg.norm(Z[:, 3:], axis=1).max()
    assert np.abs(Z[:, :3]).max() < 1e-9 and np.abs(Z - Z.mean(axis=0)).max() < 1e-11 * spin


def test_momentum_gives_the_motion_that_the_equations_of_motion_give() -> None:
    """Two methods, at speeds without slow beats."""
    search = _Search(Scene.of(SAT4), np.array([300.0, -211.0, 0.0, 0.0]), np.zeros(4))
    by_momentum = search.at(3)
    search.conserves = False
    search.before = None
    other = search.at(3)
    size = np.abs(by_momentum.c).max(axis=0)
    assert np.abs(other.c - by_momentum.c).max(axis=0) / size == pytest.approx(np.zeros(12), abs=1e-6)


@given(st.integers(1, 4), st.integers(1, 3), st.integers(0, 2**32 - 1))
def test_coefficients_come_back_from_values(count: int, order: int, seed: int) -> None:
    torus, rng = Torus.of(count, order), np.random.default_rng(seed)
    c = rng.normal(size=(len(torus.k), 2)) + 1j * rng.normal(size=(len(torus.k), 2))
    c[0] = c[0].real
    values = torus.values(c)
    assert np.abs(torus.coefficients(values) - c).max() < 1e-12
    assert np.abs(torus.at(c, torus.nodes) - values).max() < 1e-10


def table(folder: Path, text: str) -> Path:
    file = folder / "table.csv"
    file.write_text(text)
    return file


def test_mount_wrenches_are_those_of_the_reference() -> None:
    stand = load(path("bench8"))
    found = balance(stand, [60.0, -41.2, 20.1, 0, 0, 0, 0, 0], order=3)
    torus = found.torus
    rates = 1j * found.frequencies[:, None] * found.c
    ours = full_motion(found, torus, found.c, found.h).mount_wrenches()
    own = found.scene.chart.mechanics.tables.Lm
    for j in (0, 11, 57):
        at = pieces(stand, found.state(torus.nodes[j]))
        V_dot = torus.values(rates)[j, 6:]
        wanted = mounts(at, V_dot, np.zeros(8))
        for s in range(8):
            assert ours[j, s] == pytest.approx(-own[s] @ wanted[s], rel=1e-9, abs=1e-9)


MODES = "frequency [Hz],damping [-],modal mass [kg],{}\n{},0,{},{}\n"
COLUMNS = ",".join(f"{name} {part} [{'rad/m' if part[0] == 'r' else '-'}]" for name in ("w", "eye") for part in
                   ("x", "y", "z", "rx", "ry", "rz"))  # fmt: skip


@pytest.mark.parametrize("speed", [f"w={OMEGA}", f"w=200..{OMEGA}"])
def test_a_mode_that_is_the_rigid_carrier_moves_as_the_carrier(speed: str, tmp_path: Path) -> None:
    """Shape: translation along x, modal mass: the carrier's, no stiffness. The mount wrench moves both alike."""
    stand = one_wheel(tmp_path, 'static = "5 g cm"')
    file = table(tmp_path, MODES.format(COLUMNS, 1e-6, M_CARRIER, "1,0,0,0,0,0,1,0,0,0,0,0"))
    found = vibration(
        stand, [speed], "displacement", steps=3, makers=Makers(structure=read_structure(file, stand))
    ).lines
    alone = vibration(stand, [speed], "displacement", steps=3, makers=Makers()).lines
    axes = places(stand, ["eye"])[0].axes
    first = [each.names.index(each.names[0]) for each in (found, alone)]
    more, rigid = (each.amplitude[-1, i] @ axes.T for each, i in zip((found, alone), first, strict=True))
    assert more == pytest.approx(rigid * [2.0, 1.0, 1.0], rel=1e-6, abs=1e-15)


@pytest.mark.parametrize("speed", [f"w={OMEGA}", f"w=-{OMEGA}", f"w=200..{OMEGA}"])
def test_a_table_with_the_unbalance_gives_the_unbalance(speed: str, tmp_path: Path) -> None:
    """Order 1 of the table takes the place of the wheel's own: 5 g cm are 5e-5 N/(rad/s)^2."""
    stand = one_wheel(tmp_path, 'static = "5 g cm", dynamic = "20 g cm^2"')
    file = table(
        tmp_path, "order [-],radial force [N/(rad/s)^2],radial moment [N m/(rad/s)^2]\n1,5e-5,2e-6\n2.5,1e-5,0\n"
    )
    makers = Makers({"w": read_harmonics(file)})
    for quantity in ("displacement", "angle"):
        found = vibration(stand, [speed], quantity, steps=3, makers=makers).lines
        own = vibration(stand, [speed], quantity, steps=3, makers=Makers()).lines
        first = [i for i, name in enumerate(found.names) if name.order == 1.0]
        wanted = max(own.sizes[-1], key=np.linalg.norm)
        got = max(found.sizes[-1, first], key=np.linalg.norm)
        assert got == pytest.approx(wanted, rel=1e-3, abs=1e-12)
    at = next(i for i, name in enumerate(found.names) if name.order == 2.5)
    assert found.frequency[-1, at] == pytest.approx(2.5 * OMEGA / (2.0 * np.pi))


def test_units_of_a_table_are_converted(tmp_path: Path) -> None:
    one = read_harmonics(table(tmp_path, "order,radial force [N/(rad/s)^2],tolerance [%]\n1,1e-5,20\n"))
    rpm = 1e-5 * (np.pi / 30) ** 2
    two = read_harmonics(table(tmp_path, f"order [-],radial force [mN/rpm^2]\n1,{1e3 * rpm!r}\n"))
    assert one.amplitude == pytest.approx(two.amplitude, rel=1e-12)
    assert one.tolerance.tolist() == [0.2]


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("order,radial force\n1,1\n", 'column "radial force": no unit; expected a force by the square of a speed'),
        ("order,radial force [N]\n1,1\n", "expected a force by the square of a speed"),
        ("order,radial force [N/Hz^2]\n1,1\n", "Hz may be turns or radians"),
        ("order,radiale force [N/rpm^2]\n1,1\n", 'unknown column "radiale force [N/rpm^2]", did you mean'),
        ("radial force [N/rpm^2]\n1\n", 'no column "order"'),
        ("order,radial force [N/rpm^2]\n0,1\n", "row 2: order 0"),
        ("order,radial force [N/rpm^2]\n1,x\n", '"x" is not a number'),
        ("order,radial force [N/rpm^2]\n1\n", "1 cells, but the header has 2"),
        ("order,radial force [N/rpm^2]\n1,1\n1,2\n", "order 1 appears twice"),
    ],
)
def test_bad_harmonics_are_refused_in_one_line(text: str, words: str, tmp_path: Path) -> None:
    with pytest.raises(JitterFileError) as caught:
        read_harmonics(table(tmp_path, text))
    assert words in str(caught.value) and str(caught.value).count("\n") == 0


def test_a_shape_of_some_columns_says_which_to_add(tmp_path: Path) -> None:
    stand = one_wheel(tmp_path, 'static = "5 g cm"')
    file = table(tmp_path, MODES.format("w z [-],w rx [rad/m]", 10, 5, "1,0"))
    with pytest.raises(JitterFileError) as caught:
        read_structure(file, stand)
    assert 'mode shape of "w" has z, rx alone, expected all of x, y, z, rx, ry, rz; add columns w x, w y, w ry' in str(
        caught.value
    )


def rotor(inner: InnerModes, omega: float, speed: float) -> tuple[float, float]:
    """Gains of a forward and a backward turning moment, by the two real equations of the rocking rotor."""
    own, damping = inner.modes["rocking"]
    g = inner.polar * speed
    # theta_2'' + g theta_3' + ..., theta_3'' - g theta_2' + ...: unit transverse inertia
    D = np.array([
        [own**2 - omega**2 + 2j * damping * own * omega, 1j * omega * g],
        [-1j * omega * g, own**2 - omega**2 + 2j * damping * own * omega],
    ])  # fmt: skip
    through = own**2 + 2j * damping * own * omega
    found = []
    for moment in ([1.0, -1j], [1.0, 1j]):
        theta = np.linalg.solve(D, np.array(moment))
        found.append(abs(through * theta[0]))
    return found[0], found[1]


def test_rocking_splits_into_whirls(tmp_path: Path) -> None:
    inner = read_inner_modes(
        table(tmp_path, "mode,frequency [Hz],damping [-],polar ratio [-]\nrocking,40,0.01,1.8\nradial,200,0.02,\n")
    )
    speed = 300.0
    for omega in (100.0, 250.0, 700.0):
        w = np.array([0, 0, 0, 0, 1, -1j]), np.array([0, 0, 0, 0, 1, 1j])
        passed = [abs(inner.transmit(each, np.array(omega), np.array(speed))[4]) for each in w]
        assert passed == pytest.approx(rotor(inner, omega, speed), rel=1e-9)
