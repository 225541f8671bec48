"""Vibration by lines: closed forms, the periodic response, one verdict in all branches, slow beats, tables, modes."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import mahovik
from mahovik.core.stand import Stand, load
from mahovik.core.stand.files import TableError
from mahovik.core.stand.model import rest_state
from mahovik.errors import CheckError, UsageError
from mahovik.out.commands.vibration import vibration as command
from mahovik.proof.reference import pieces
from mahovik.proof.reference.motion import mounts
from mahovik.proof.reference.pieces import momentum, momentum_in_E0
from mahovik.stands import path
from mahovik.use.study.linear import places
from mahovik.use.vibration import steady as steady_motions
from mahovik.use.vibration.chain import Makers, combinations
from mahovik.use.vibration.lines import LineName, Lines, in_band, size_of
from mahovik.use.vibration.maker import InnerModes, read_harmonics, read_inner_modes, read_structure
from mahovik.use.vibration.speeds import read_speeds
from mahovik.use.vibration.steady import Steady, quasiperiodic, steady
from mahovik.use.vibration.study import Vibration
from mahovik.use.vibration.study import vibration as find
from mahovik.use.vibration.torus import Torus, indices
from mahovik.use.vibration.view import find_view
from study.test_response_held import table as force_table

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
    stand: Stand, speeds: list[str], quantity: str, point: str = "eye", steps: int = 2, makers: Makers | None = None
) -> Vibration:
    """Vibration of a point by name."""
    return find(stand, read_speeds(stand, speeds), find_view(stand, point, quantity), steps=steps, makers=makers)


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
    result = vibration(stand, [f"w={OMEGA}"], quantity)
    first = [(name.wheel, name.order) for name in result.lines.names].index(("w", 1.0))
    assert result.lines.sizes[0, first] == pytest.approx([size, size, 0.0], rel=1e-6, abs=1e-16)


def test_lengths_are_those_of_the_time_course() -> None:
    """No length at many moments and phases exceeds that of the lines, and the longest comes near it."""
    rng = np.random.default_rng(3)
    a = rng.standard_normal((4, 3, 3)) + 1j * rng.standard_normal((4, 3, 3))
    a[0, 1:], a[1, 0], a[1, 2] = 0.0, [1.0, 1j, 0.0], 0.0  # one line; a round and a plain ellipse
    lines = Lines(tuple(LineName(f"w{k}", 1.0) for k in range(3)), np.tile([1.0, 2.0, 2.0], (4, 1)), a)
    angles = rng.uniform(0.0, 2.0 * np.pi, (400_000, 3))
    tied = angles[:, [0, 1, 1]]  # w2 and w3 have one frequency
    for lengths, phases in ((lines.lengths(np.zeros(3)).worst, angles), (lines.lengths(np.zeros(3)).peak, tied)):
        sampled = np.array([np.linalg.norm((np.exp(1j * phases) @ row).real, axis=1).max() for row in a])
        assert (sampled <= lengths * (1.0 + 1e-9)).all() and lengths == pytest.approx(sampled, rel=0.01)
    assert size_of(a[1, 0]) == pytest.approx(1.0, rel=1e-12)
    assert lines.lengths(np.zeros(3)).rms == pytest.approx(np.linalg.norm(lines.sums().rms, axis=1))


def test_the_largest_amplitude_of_a_sweep_is_the_longest_vector_of_the_motion(tmp_path: Path) -> None:
    stand = one_wheel(tmp_path, STATIC, SUSPENSION.replace("[9e5, 9e5", "[9e5, 7e5"))
    seen = find_view(stand, "eye", "acceleration")
    result = find(stand, read_speeds(stand, ["w=60..110"]), seen)
    largest = result.largest()
    moved = seen.full(steady(stand, [result.value[largest.step]]).full())
    longest = np.linalg.norm(moved, axis=1).max()
    assert largest.value == pytest.approx(longest, rel=5e-3)  # which has some moments only
    assert result.lengths().worst.max() == pytest.approx(longest, rel=5e-3)
    assert (
        np.linalg.norm(result.sums().worst, axis=1).max() > 1.1 * longest
    )  # the root of the sum of squares is no length


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
    result = vibration(stand, speeds, quantity, point)
    frequency, a = steady(stand, asked.speeds(0.0)).harmonics(find_view(stand, point, quantity))
    wanted = np.sqrt((np.abs(a[frequency > 0.0]) ** 2).sum(axis=0) / 2.0)
    assert result.sums().rms[0] == pytest.approx(wanted, rel=1e-6)


def test_an_undamped_resonance_is_said(tmp_path: Path) -> None:
    rate = 9e5 / (M_CARRIER + M_WHEEL)
    stand = one_wheel(tmp_path, 'static = "5 g cm"', SUSPENSION.replace("damping = [40, 40, 40, 0.1, 0.1, 0.1]", ""))
    with pytest.raises(CheckError, match="no steady motion found"):
        quasiperiodic(stand, [float(np.sqrt(rate))])


def test_a_line_on_the_end_of_a_band_is_within() -> None:
    """A speed of 1800 rpm is 30.000000000000004 Hz."""
    rounded = np.nextafter(30.0, [0.0, np.inf])
    assert in_band(rounded, (30.0, 60.0)).all() and in_band(rounded, (15.0, 30.0)).all()
    assert not in_band(30.0 * (1.0 + 2e-9), (10.0, 30.0)) and not in_band(10.0 * (1.0 - 2e-9), (10.0, 30.0))


QUESTIONS: dict[str, tuple[str, dict[str, str], dict[str, str]]] = {
    "all": ("sat4", {"all": "3000rpm"}, {"all": "2900..3000rpm"}),
    "geared": ("sat4", {"all": "3000rpm", "rw2": "1500rpm"}, {"all": "2900..3000rpm", "rw2": "0.5*rw1"}),
    "apart": ("sat4", {"all": "3000rpm", "rw2": "2987rpm"}, {"rw1": "2900..3000rpm", "rw3": "1*rw1", "rw4": "rw1",
                                                            "rw2": "2987rpm"}),
    "shaker": ("shaker2", {"all": "110rpm"}, {"all": "100..110rpm"}),
}  # fmt: skip
"""Stand, speeds, and a sweep that ends with them and is largest there."""


@pytest.mark.parametrize("name", QUESTIONS)
@pytest.mark.parametrize("few_turns", [0, 40])
def test_a_requirement_has_one_verdict_in_all_branches(
    name: str, few_turns: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    """One set of speeds or the end of a sweep, the torus or a common period, lines on the end of a band."""
    stand, speeds, sweep = QUESTIONS[name]
    at: dict[str, Any] = {"at": "acc1" if stand == "sat4" else "carrier", "quantity": "acceleration"}
    edge = 110.0 / 60.0 if stand == "shaker2" else 50.0
    sums = [f"{sum} VALUE m/s2{band}" for sum in ("rms", "peak", "worst") for band in ("", f" 1..{edge!r}Hz")]
    wanted = command(
        path(stand), speed=speeds, **at, require=[requirement.replace("VALUE", "1") for requirement in sums]
    )
    values = [requirement["value"] for requirement in wanted["requirements"]]
    assert values[0] == pytest.approx(wanted["rms"].max(), rel=1e-9) and values[0] <= values[2] <= values[4]
    monkeypatch.setattr(steady_motions, "FEW_TURNS", few_turns)
    for part, verdict in ((1.0 + 1e-5, True), (1.0 - 1e-5, False)):
        limits = [text.replace("VALUE", repr(part * value)) for text, value in zip(sums, values, strict=True)]
        for asked in ({"speed": speeds}, {"speed": sweep, "steps": 3}):
            result = command(path(stand), **asked, **at, require=limits)
            assert [requirement["met"] for requirement in result["requirements"]] == [verdict] * len(sums)
            assert result.ok is verdict


@pytest.mark.filterwarnings("ignore:starts from rest, turned")
@pytest.mark.parametrize(("stand", "most"), [("shaker2", 3000), ("bench8", 3000), ("auv6", 600)])
def test_the_largest_amplitude_of_a_sweep_is_the_true_one(stand: str, most: int) -> None:
    """However coarse its grid: a dense sweep about the peak finds nothing larger by 2 %, and no speed is coarse."""
    asked: dict[str, Any] = {"at": "carrier", "quantity": "displacement"}
    result = command(path(stand), speed={"all": f"0..{most}rpm"}, steps=7, **asked)
    largest = result["largest"]
    assert not any("coarse" in message for message in result.messages)
    at = largest["speed"] / RPM
    dense = command(path(stand), speed={"all": f"{at - 5:.6f}..{at + 5:.6f}rpm"}, steps=21, **asked)
    assert (
        0.98 * dense["largest"]["value"]
        < largest["value"]
        == pytest.approx(float(np.nanmax(result["length", "peak"])), rel=0.02)
    )


PENDULUM = """
schema = 1
name = "pendulum"
gravity = [0, 0, -9.81]
[carrier]
mass = 4.0
center_of_mass = [0, 0, -0.2]
inertia = [0.25, 0.25, 0.1]
inertia_about = "origin"
[hold]
freedoms = ["pitch"]
[suspension]
stiffness = [0, 0, 0, 0, 0, 0]
damping = [0, 0, 0, 0, 0.006, 0]
[[flywheel]]
name = "w"
position = [0, 0, 0.3]
axis = [0, 1, 0]
zero = [1, 0, 0]
mass = 0.5
spin_inertia = 0.001
transverse_inertia = 0.0006
unbalance = { static = "0.6 kg mm" }
"""


@pytest.mark.slow
def test_a_sweep_follows_a_lightly_damped_peak_that_bends(tmp_path: Path) -> None:
    """A pendulum with 0.2 % of damping: where the driving moment is that of damping, it swings U (r w^2 + g)/(c w)."""
    file = tmp_path / "pendulum.toml"
    file.write_text(PENDULUM)
    result = command(file, speed="w=43.7..44.5rpm", at="hold.pitch", quantity="angle", steps=3)
    largest = result["largest"]
    w = largest["speed"]
    assert largest["value"] == pytest.approx(0.6e-3 * (0.3 * w**2 + 9.81) / (0.006 * w), rel=0.015)
    assert not any("no steady motion" in message for message in result.messages)


def _norm(values: Any) -> float:
    return float(np.linalg.norm(np.nan_to_num(values), axis=1).max())


RPM = np.pi / 30
SAT4 = load(path("sat4"))
NEARLY_EQUAL: tuple[list[float], ...] = (
    [3000, 2995, 3000, 3000],
    [3000, 2999.99, 0, 0],
)


def solve(speeds: list[float]) -> Steady:
    """The motion at speeds in rpm."""
    return quasiperiodic(SAT4, [RPM * x for x in speeds])


@pytest.mark.parametrize("speeds", NEARLY_EQUAL, ids=str)
def test_momentum_is_constant_along_the_motion(speeds: list[float]) -> None:
    """Momentum in E0 by the literal reference: a carrier that turned by a false beat would show it."""
    solution, rng = solve(speeds), np.random.default_rng(3)
    angles = rng.uniform(0.0, 2.0 * np.pi, (12, len(solution.base)))
    Z = np.array([momentum_in_E0(pieces(SAT4, solution.state(theta))) for theta in angles])
    spin = np.linalg.norm(Z[:, 3:], axis=1).max()
    assert np.abs(Z[:, :3]).max() < 1e-9 and np.abs(Z - Z.mean(axis=0)).max() < 1e-11 * spin


@given(st.integers(1, 4), st.integers(1, 3), st.integers(0, 2**32 - 1))
def test_coefficients_come_back_from_values(count: int, order: int, seed: int) -> None:
    torus, rng = Torus.of(count, order), np.random.default_rng(seed)
    c = rng.normal(size=(len(torus.k), 2)) + 1j * rng.normal(size=(len(torus.k), 2))
    c[0] = c[0].real
    values = torus.values(c)
    assert np.abs(torus.coefficients(values) - c).max() < 1e-12
    assert np.abs(torus.at(c, torus.angles(np.eye(count, dtype=int))) - values).max() < 1e-10


@pytest.mark.parametrize("slow", [5.0, 5.13])
def test_lines_are_named_by_the_smallest_combination_with_a_common_period_and_without(slow: float) -> None:
    """Whole ratios, 5 to 100, and others: the sums and differences are not orders 22 and 18 of the slow wheel."""
    names = vibration(load(path("sat4")), ["all=100", f"rw1={slow}"], "angle", "acc1").lines.names
    assert {"1 x rw1", "3 x rw2, rw3, rw4", "2 rw1 + rw2", "2 rw1 - rw2"} <= {name.text for name in names}
    assert max(name.order for name in names) == 3.0


@given(st.lists(st.integers(-7, 7), min_size=1, max_size=3).filter(lambda turns: math.gcd(*turns) == 1))
def test_combinations_are_the_smallest(turns: list[int]) -> None:
    all_of = indices(len(turns), 7)
    for n, k in combinations(turns, 12).items():
        sizes = np.abs(all_of).sum(axis=1)[np.abs(all_of @ turns) == abs(n)]
        assert k @ turns == n and np.abs(k).sum() == sizes.min(initial=max(np.abs(k).sum(), 8))


def table(folder: Path, text: str) -> Path:
    file = folder / "table.csv"
    file.write_text(text)
    return file


def test_mount_wrenches_are_those_of_the_reference() -> None:
    stand = load(path("bench8"))
    solution = quasiperiodic(stand, [60.0, -41.2, 20.1, 0, 0, 0, 0, 0], order=3)
    torus = solution.torus
    rates = 1j * solution.frequencies[:, None] * solution.c
    ours, nodes = solution.full().mount_wrenches(), torus.angles(np.eye(3, dtype=int))
    transfers = solution.scene.chart.mechanics.tables.Lm
    for j in (0, 11, 57):
        at = pieces(stand, solution.state(nodes[j]))
        V_dot = torus.values(rates)[j, 6:]
        wanted = mounts(at, V_dot, np.zeros(8))
        for s in range(8):
            assert ours[j, s] == pytest.approx(-transfers[s] @ wanted[s], rel=1e-9, abs=1e-9)


MODES = "frequency [Hz],damping [-],modal mass [kg],{}\n{},0,{},{}\n"
COLUMNS = ",".join(f"{name} {part} [{'rad/m' if part[0] == 'r' else '-'}]" for name in ("w", "eye") for part in
                   ("x", "y", "z", "rx", "ry", "rz"))  # fmt: skip


@pytest.mark.parametrize("speed", [f"w={OMEGA}", f"w=200..{OMEGA}"])
def test_a_mode_that_is_the_rigid_carrier_moves_as_the_carrier(speed: str, tmp_path: Path) -> None:
    """Shape: translation along x, modal mass: the carrier's, no stiffness. The mount wrench moves both alike."""
    stand = one_wheel(tmp_path, 'static = "5 g cm"')
    file = table(tmp_path, MODES.format(COLUMNS, 1e-6, M_CARRIER, "1,0,0,0,0,0,1,0,0,0,0,0"))
    result = vibration(stand, [speed], "displacement", makers=Makers(structure=read_structure(file, stand))).lines
    alone = vibration(stand, [speed], "displacement").lines
    axes = places(stand, ["eye"])[0].axes
    first = [lines.names.index(lines.names[0]) for lines in (result, alone)]
    more, rigid = (lines.amplitude[-1, i] @ axes.T for lines, i in zip((result, alone), first, strict=True))
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
        result = vibration(stand, [speed], quantity, makers=makers).lines
        expected = vibration(stand, [speed], quantity).lines
        first = [i for i, name in enumerate(result.names) if name.order == 1.0]
        wanted = max(expected.sizes[-1], key=np.linalg.norm)
        got = max(result.sizes[-1, first], key=np.linalg.norm)
        assert got == pytest.approx(wanted, rel=1e-3, abs=1e-12)
    at = next(i for i, name in enumerate(result.names) if name.order == 2.5)
    assert result.frequency[-1, at] == pytest.approx(2.5 * OMEGA / (2.0 * np.pi))


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
        ("order,radial force [N/rpm^2],sense\n2,1,backward\n2,1,\n", "order 2 appears twice, expected it once, or"),
        ("order,radial force [N/rpm^2],sense\n1,1,left\n", 'sense "left", expected one of forward, backward, unknown'),
    ],
)
def test_bad_harmonics_are_refused_in_one_line(text: str, words: str, tmp_path: Path) -> None:
    with pytest.raises(TableError) as caught:
        read_harmonics(table(tmp_path, text))
    assert words in str(caught.value) and str(caught.value).count("\n") == 0


def test_a_shape_of_some_columns_says_which_to_add(tmp_path: Path) -> None:
    stand = one_wheel(tmp_path, 'static = "5 g cm"')
    file = table(tmp_path, MODES.format("w z [-],w rx [rad/m]", 10, 5, "1,0"))
    with pytest.raises(TableError) as caught:
        read_structure(file, stand)
    assert 'mode shape of "w" has z, rx alone, expected all of x, y, z, rx, ry, rz; add columns w x, w y, w ry' in str(
        caught.value
    )


def rotor(inner: InnerModes, omega: float, speed: float) -> tuple[float, float]:
    """Gains of a forward and a backward turning moment, by the two real equations of the rocking rotor."""
    mode, damping = inner.modes["rocking"]
    g = inner.polar * speed
    # theta_2'' + g theta_3' + ..., theta_3'' - g theta_2' + ...: unit transverse inertia
    D = np.array([
        [mode**2 - omega**2 + 2j * damping * mode * omega, 1j * omega * g],
        [-1j * omega * g, mode**2 - omega**2 + 2j * damping * mode * omega],
    ])  # fmt: skip
    through = mode**2 + 2j * damping * mode * omega
    values = []
    for moment in ([1.0, -1j], [1.0, 1j]):
        theta = np.linalg.solve(D, np.array(moment))
        values.append(abs(through * theta[0]))
    return values[0], values[1]


def test_rocking_splits_into_whirls(tmp_path: Path) -> None:
    inner = read_inner_modes(
        table(tmp_path, "mode,frequency [Hz],damping [-],polar ratio [-]\nrocking,40,0.01,1.8\nradial,200,0.02,\n")
    )
    speed = 300.0
    for omega in (100.0, 250.0, 700.0):
        w = np.array([0, 0, 0, 0, 1, -1j]), np.array([0, 0, 0, 0, 1, 1j])
        passed = [abs(inner.transmit(frequency, np.array(omega), np.array(speed))[4]) for frequency in w]
        assert passed == pytest.approx(rotor(inner, omega, speed), rel=1e-9)


@pytest.mark.parametrize(
    ("sense", "size"),
    [
        ("forward", 2.191e-4),
        ("backward", 9.394e-4),
        ("unknown", 9.394e-4),
        ("", 9.394e-4),
        ("backward\n0.5,1e-9,forward", 11.585e-4),
    ],
)
def test_a_harmonic_against_the_wheel_meets_the_other_whirl(sense: str, size: float, tmp_path: Path) -> None:
    """Order 0.5 at 6000 rpm on a rocking mode of 90 Hz, by theta'' - i p W theta' + c theta' + k theta = moment."""
    (tmp_path / "modes.csv").write_text("mode,frequency [Hz],damping [-],polar ratio [-]\nrocking,90,0.02,1.8\n")
    rows = f"order [-],radial moment [N m/(rad/s)^2],sense\n1,1e-9,\n0.5,1e-9,{sense}\n"
    result = command(
        mahovik.Stand.from_dict(force_table()), speed={"wheel": "6000rpm"}, at="hold.reaction", quantity="moment",
        harmonics={"wheel": table(tmp_path, rows)}, inner_modes={"wheel": tmp_path / "modes.csv"},
    )  # fmt: skip
    half, one = (result["amplitude"][result["order"] == order].sum(axis=0) for order in (0.5, 1.0))
    assert half == pytest.approx([size, size, 0.0], rel=2e-4)
    sources = result["source"][result["order"] == 0.5].tolist()
    assert len({*sources}) == len(sources) and ("maker radial moment backward" in sources) == ("backward" in sense)
    W, natural = 200.0 * np.pi, 2.0 * np.pi * 90.0
    through = natural**2 + 0.04j * natural * W
    forward = 1e-9 * W**2 * abs(through / (through - W**2 + 1.8 * W * W))
    assert one == pytest.approx([forward, forward, 0.0], rel=1e-6)
    assert result["worst"] == pytest.approx(half + one, rel=1e-6)


BAND = (20.0, 200.0)
AWAY = {"rw1": "3040rpm", "rw2": "3022rpm", "rw3": "3040rpm", "rw4": "3022rpm"}
QUIET: dict[str, Any] = {"speed": AWAY, "at": "acc1", "quantity": "acceleration", "band": "20..200Hz", "improve": True}


def test_small_differences_of_speed_make_sat4_quieter() -> None:
    """All orders in the band agree with a common period; the momentum is that of the literal reference."""
    result = command(path("sat4"), **QUIET, momentum="0 0 14")["improved"]
    exact = steady(SAT4, result["speeds"].tolist(), result["phases"].tolist())
    frequency, a = exact.harmonics(find_view(SAT4, "acc1"))
    inside = (BAND[0] <= frequency) & (frequency <= BAND[1])
    assert result["after"] == pytest.approx(float(np.linalg.norm(a[inside]) / math.sqrt(2.0)), rel=1e-6)
    assert result["before"] > 5.0 * result["after"]
    (words, *_) = command(path("sat4"), **QUIET, momentum="0 0 0").messages
    assert (
        words
        == "no line above rounding is left in the band: RMS 0.00568592 m/s2 before, 0 after, of the whole equations"
    )
    mean = np.zeros(3)
    for turn in range(4):
        phi = tuple(result["phases"] + turn * math.pi / 2)
        state = replace(rest_state(SAT4), phi=phi, phi_dot=tuple(result["speeds"].tolist()))
        mean += momentum(pieces(SAT4, state))[3:] / 4
    assert mean == pytest.approx([0.0, 0.0, 14.0], abs=1e-12)


FAST = {"quantity": "acceleration", "improve": True}


def test_wheels_stop_only_where_the_limit_lets_them() -> None:
    """Two exciters of opposite senses hold no momentum: they are quietest at rest, which is no improvement."""
    wanted: dict[str, Any] = {"speed": {"left": "600rpm", "right": "-600rpm"}, "at": "carrier"} | FAST
    kept = command(path("shaker2"), **wanted)["improved"]
    assert np.abs(kept["speeds"]).min() >= 10.0 * np.pi * (1.0 - 1e-8)
    stopped = command(path("shaker2"), **wanted, limit="0..700rpm")
    assert stopped["improved"]["speeds"].tolist() == [0.0, 0.0] and "stop: left, right" in stopped.messages
    assert stopped.messages[0].startswith("no line above rounding is left") and "-0" not in " ".join(stopped.messages)
    low = command(path("sat4"), **QUIET | {"speed": [314.0, -314.0, 314.0, -314.0], "band": "30..200Hz"})
    assert "order 1 is outside of 30..200 Hz: rw1, rw2, rw3, rw4" in low.messages


def test_limits_and_frequencies_to_be_avoided_hold() -> None:
    result = command(
        path("sat4"), **QUIET | {"speed": 0.0}, momentum=(2.0, 1.0, 5.0), limit="3000 rpm", avoid=["14..22Hz", "40Hz"]
    )["improved"]
    turns = np.abs(result["speeds"]) / (2.0 * np.pi)
    assert np.all(turns <= 50.0 * (1.0 + 1e-8))
    for order in (1, 2):
        for low, high in ((14.0, 22.0), (36.0, 44.0)):
            assert not np.any((order * turns > low * (1 + 1e-8)) & (order * turns < high * (1 - 1e-8)))


@pytest.mark.parametrize(
    ("wanted", "error", "words"),
    [
        ({"momentum": "0 0 40"}, CheckError, r"needs 1\.4\d* times the speed limits"),
        ({"momentum": "0 0"}, UsageError, "expected three finite numbers"),
        ({"speed": {"all": "0..10rpm"}}, UsageError, "expected one set of speeds"),
        ({"improve": False, "limit": 3.0}, UsageError, "limit: needs improve=True"),
        ({"avoid": "35"}, UsageError, "expected a frequency with its unit"),
        ({"avoid": "0.001..1000Hz"}, CheckError, "keep out of these frequencies"),
    ],
)
def test_searches_that_are_refused(wanted: dict[str, Any], error: type[Exception], words: str) -> None:
    with pytest.raises(error, match=words):
        command(path("sat4"), **QUIET | wanted)


def test_wheels_that_have_nothing_free_are_refused() -> None:
    """Three flywheels for three axes; two of one axis hold nothing across it."""
    few = replace(SAT4, flywheels=SAT4.flywheels[:3])
    with pytest.raises(UsageError, match="3 flywheels with spin axes of rank 3 leave no speeds free"):
        command(few, **QUIET | {"speed": "3000rpm"})
    one = replace(SAT4.flywheels[0], name="other")
    pair = replace(SAT4, flywheels=(SAT4.flywheels[0], one))
    with pytest.raises(UsageError, match="perpendicular to all spin axes"):
        command(pair, **QUIET | {"speed": "3000rpm"}, momentum="0 0 14")


def test_two_wheels_cancel_on_a_force_table() -> None:
    """Together they leave the difference of the unbalances, half a turn apart; no momentum has to be kept."""
    document = force_table()
    first = document["flywheel"][0] | {"name": "up", "unbalance": {"static": "72 g mm"}}
    second = first | {"name": "down", "position": [0, 0, -0.1]}
    document["flywheel"] = [first, second | {"unbalance": {"static": "60 g mm", "static_at": "30 deg"}}]
    result = command(
        mahovik.Stand.from_dict(document), speed={"up": "3000rpm", "down": "2987rpm"}, at="hold.reaction",
        band="20..200Hz", improve=True, limit="3000rpm",
    )["improved"]  # fmt: skip
    one, other = result["speeds"]
    away = 40.0 * np.pi  # below the band nothing counts
    assert abs(one) <= away or abs(abs(one) - abs(other)) < 1e-9 * one
    if abs(one) > away:
        assert np.exp(1j * (result["phases"][1] - result["phases"][0] + np.radians(30.0))) == pytest.approx(
            -1.0, abs=1e-6
        )
        assert result["after"] == pytest.approx(12e-6 * one**2, rel=1e-6)  # of x and y together
