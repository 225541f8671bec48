"""Regimes: laws of speed and their derivatives, motors, what a file says in which units, every bad input one line."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from mahovik import stands
from mahovik.core.motion.laws import (
    Constant,
    Harmonic,
    Law,
    Ramp,
    RunUp,
    SpeedTable,
    Sweep,
    Torque,
    TorqueTable,
)
from mahovik.core.motion.regime import load, loads_regime, steady_regime
from mahovik.core.stand import load as load_stand
from mahovik.core.stand.motor import Motor, available_torque, drive, friction, required_torque
from mahovik.errors import RegimeError

SHAKER = load_stand(stands.path("shaker2"))
HEAD = "schema = 1\n"
REST = "default = { hold = true }\n"


def regime_of_left(law: str) -> str:
    """A regime of shaker2 whose flywheel `left` has the lines given; the other is held."""
    return f"{HEAD}{REST}[flywheel.left]\n{law}\n"


def problems(text: str, folder: Path = Path(), until: float = 1.0) -> list[str]:
    with pytest.raises(RegimeError) as caught:
        loads_regime(text, SHAKER, until, "r.toml", folder)
    assert all(line.startswith("r.toml: ") and "\n" not in line for line in caught.value.problems)
    return list(caught.value.problems)


@pytest.mark.parametrize(
    ("text", "law"),
    [
        ('speed = "600 rpm"', Constant(20 * math.pi)),
        ("speed = -3", Constant(-3.0)),
        ("hold = true", Constant(0.0)),
        ('ramp = { to = 8, duration = "500 ms" }', Ramp(0.0, 8.0, 0.0, 0.5)),
        ("ramp = { from = 1, to = 8, duration = 2, start = 0.5 }", Ramp(1.0, 8.0, 0.5, 2.0)),
        ('sweep = { from = "1 Hz", to = 8, duration = 2 }', Sweep(2 * math.pi, 8.0, 0.0, 2.0)),
        ('sweep = { from = 1, to = 8, duration = 2, scale = "log" }', Sweep(1.0, 8.0, 0.0, 2.0, "log")),
        ('harmonic = { mean = 1, amplitude = 2, frequency = "3 Hz", phase = 0.5 }', Harmonic(1.0, 2.0, 3.0, 0.5)),
        ('torque = "20 mN m"', Torque(0.02)),
        ("run_up = { torque = 0.2, to = 50 }", RunUp(0.2, 50.0, 0.5)),
        ("run_up = { torque = 0.2, to = 50, band = 2 }", RunUp(0.2, 50.0, 2.0)),
    ],
)
def test_laws_in_si(text: str, law: Law) -> None:
    first, second = loads_regime(regime_of_left(text), SHAKER, 1.0).flywheels
    assert (first.name, first.law) == ("left", law)
    assert (second.name, second.law) == ("right", Constant(0.0))


def test_phases_initial_speeds_and_defaults() -> None:
    text = HEAD + 'default = { torque = 0.1, initial_speed = 4 }\n[flywheel.right]\nphase = "90 deg"\n'
    first, second = loads_regime(text, SHAKER, 1.0).flywheels
    assert (first.law, first.phase, first.speed) == (Torque(0.1), None, 4.0)
    assert (second.law, second.phase, second.speed) == (Torque(0.1), math.pi / 2, 4.0)
    kept = steady_regime(SHAKER, [1.0, 2.0])
    assert [flywheel.law for flywheel in kept.flywheels] == [Constant(1.0), Constant(2.0)]
    assert not kept.by_torque


def test_a_motion_is_named() -> None:
    text = (stands.path("shaker2").parent / "shaker2.motion.json").read_text()
    with pytest.raises(RegimeError) as error:
        loads_regime(text, SHAKER, 1.0, "m.json", is_json=True)
    assert error.value.problems == ("m.json: is a motion file, expected a regime or a programme file",)


def test_tables(tmp_path: Path) -> None:
    (tmp_path / "a.csv").write_text("t [ms],phi_dot [rpm]\n0,0\n500,300\n1000,600\n")
    (tmp_path / "b.csv").write_text("torque,t\n1,0\n2,1\n")
    (tmp_path / "w.csv").write_text("t,Z [kN],M\n0,0,0\n2,1,4\n")
    text = HEAD + '[flywheel.left]\ntable = "a.csv"\n[flywheel.right]\nhold = true\n[wrench]\nleft = "w.csv"\n'
    regime = loads_regime(text, SHAKER, 1.0, "r.toml", tmp_path)
    law = regime.flywheels[0].law
    assert isinstance(law, SpeedTable)
    np.testing.assert_allclose(law.motion(np.array([0.25]))[1], 5 * math.pi, rtol=1e-12)
    assert regime.wrench(1.0) == {"left": (0.0, 0.0, 500.0, 0.0, 2.0, 0.0)}
    torque = loads_regime(regime_of_left('table = "b.csv"'), SHAKER, 1.0, "r.toml", tmp_path).flywheels[0].law
    assert isinstance(torque, TorqueTable)
    assert torque.torque(0.5, 0.0, None) == 1.5


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("schema = 2", "schema: expected 1, found 2"),
        ("schema =", "not TOML"),
        (HEAD + "defualt = {hold = true}\n" + REST, 'unknown key "defualt", did you mean "default"?'),
        (HEAD + REST + "[flywheel.lefd]\nspeed = 1", 'unknown flywheel "lefd", did you mean "left"?'),
        (HEAD + "[flywheel.left]\nspeed = 1", 'flywheel "right": has no law'),
        (HEAD + "[flywheel.left]\nphase = 1\n[flywheel.right]\nhold=true", "no law: expected"),
        (regime_of_left("speed = 1\ntorque = 2"), "exactly one law, not 2"),
        (regime_of_left("frequency = 50"), 'unknown key "frequency": a turn at 50 Hz is speed = "3000 rpm"'),
        (regime_of_left("sped = 1"), 'unknown key "sped", did you mean "speed"?'),
        (regime_of_left('speed = "50 Hz"'), "a frequency is not one: write rpm or rad/s"),
        (regime_of_left('torque = "3 N"'), 'unit "N" does not fit, expected a torque (N m)'),
        (regime_of_left("speed = nan"), "not finite"),
        (regime_of_left("hold = false"), "expected true"),
        (regime_of_left("ramp = { to = 5, duration = 0 }"), "duration: 0 s is not above 0"),
        (regime_of_left('sweep = { from = 1, to = 5, duration = 1, scale = "dec" }'), 'scale: unknown "dec"'),
        (regime_of_left('sweep = { from = 0, to = 5, duration = 1, scale = "log" }'), "two speeds of one sign"),
        (
            regime_of_left("speed = 1e300"),
            'left", speed: a speed of 1e+300 rad/s is out of range, at most 100000 in magnitude',
        ),
        (regime_of_left("speed = -2e5"), "a speed of 200000 rad/s is out of range"),
        (
            regime_of_left("ramp = { to = 9e4, duration = 1e-5 }"),
            "ramp: an acceleration of 9e+09 rad/s2 is out of range",
        ),
        (regime_of_left("torque = 2e9"), "torque: a torque of 2e+09 N m is out of range"),
        (regime_of_left("speed = 1\nphase = 2e7"), 'flywheel "left", phase: an angle of 20000000 rad is out of range'),
        (
            HEAD + REST + "[wrench]\ncarrier = [0, 0, 1e12, 0, 0, 0]",
            'wrench "carrier", Z: a force of 1e+12 N is out of',
        ),
        (regime_of_left("speed = 1\ninitial_speed = 2"), "initial_speed: not allowed with `speed`"),
        (regime_of_left("table = 3"), "expected the name of a CSV file"),
        (HEAD + REST + "[wrench]\ncarier = [0, 0, 0, 0, 0, 0]", 'unknown body "carier", did you mean "carrier"?'),
        (HEAD + REST + '[wrench]\ncarrier = [0, "1 N m", 0, 0, 0, 0]', 'wrench "carrier", Y: unit "N m" does not fit'),
    ],
)
def test_bad_regimes(text: str, words: str) -> None:
    (line,) = problems(text)
    assert words in line


@pytest.mark.parametrize(
    ("content", "words"),
    [
        ("t,phi_dot\n0,1\n2,3\n1,4\n9,1\n", "row 4: t = 1 s is not after 2 s"),
        ("t,phi_dot\n0,1\n0.5,3\n", "covers t = 0 s to 0.5 s, but the simulation runs from 0 to 1 s"),
        ("t,phi_dot\n0,1\n", "at least two rows"),
        ("t,phi_dit\n0,1\n1,1\n", 'unknown column "phi_dit", did you mean "phi_dot"?'),
        ("phi_dot,torque\n0,1\n1,1\n", 'no column "t"'),
        ("t,t\n0,1\n1,1\n", 'column "t" appears twice'),
        ("t,phi_dot [Hz]\n0,1\n1,1\n", 'unit "Hz" does not fit'),
        ("t,phi_dot\n0,1\n1\n", "row 3: 1 cells, but the header has 2"),
        ("t,phi_dot\n0,1\n1,x\n", 'row 3: column "phi_dot": "x" is not a number'),
        ("t,phi_dot,torque\n0,1,1\n1,1,1\n", "has phi_dot and torque"),
        ("t,phi_dot\n0,0\n0.4,9.99e4\n0.6,9.99e4\n1,0\n", "a speed of 10"),  # between its points
        ("t,torque\n0,0\n1,-2e9\n", "a torque of 2e+09 N m is out of range"),
    ],
)
def test_bad_tables(content: str, words: str, tmp_path: Path) -> None:
    (tmp_path / "a.csv").write_text(content)
    (line,) = problems(regime_of_left('table = "a.csv"'), tmp_path)
    assert words in line


def test_missing_files(tmp_path: Path) -> None:
    (line,) = problems(regime_of_left('table = "none.csv"'), tmp_path)
    assert "cannot be read: no such file" in line
    with pytest.raises(RegimeError, match="no such file"):
        load(tmp_path / "none.toml", SHAKER, 1.0)


def test_all_problems_are_reported_together() -> None:
    text = HEAD + '[flywheel.lefd]\nspeed = 1\n[flywheel.left]\nspeed = "3 m"\nphase = "2 kg"\n[wrench]\nx = 1\n'
    messages = problems(text)
    assert len(messages) == 5
    assert [
        w for w in ("lefd", 'unit "m"', 'unit "kg"', '"right": has no law', 'body "x"') if w not in "\n".join(messages)
    ] == []


TABLE = SpeedTable.of(np.array([-0.5, 0.0, 0.3, 1.0, 2.5]), np.array([1.0, 3.0, -2.0, 5.0, 4.0]))
Smooth = Constant | Ramp | Harmonic | SpeedTable
LAWS: list[Smooth] = [
    Constant(-4.0),
    Ramp(2.0, 30.0, 0.25, 1.5),
    Ramp(30.0, -2.0, 0.0, 0.5),
    Sweep(2.0, 40.0, 0.25, 1.5, "log"),
    Sweep(-3.0, -3.0, 0.0, 1.0, "log"),
    Harmonic(5.0, 3.0, 2.0, 0.7),
    TABLE,
]


@pytest.mark.parametrize("law", LAWS, ids=lambda law: type(law).__name__)
def test_speed_and_acceleration_are_the_derivatives_of_the_phase(
    law: Smooth,
) -> None:
    """They are central differences of it, away from the corners, and the phase begins at zero."""
    h = 1e-4
    t = np.linspace(0.013, 1.987, 151)
    corners = np.array([c for c in law.breaks if c > 0] or [-1.0])
    t = t[np.abs(t[:, None] - corners).min(axis=1) > 2 * h]
    before, now, after = (law.motion(t + shift) for shift in (-h, 0.0, h))
    assert law.motion(np.zeros(1))[0][0] == pytest.approx(0.0, abs=1e-14)
    np.testing.assert_allclose((after[0] - before[0]) / (2 * h), now[1], rtol=1e-6, atol=1e-6)  # third derivative h2/6
    np.testing.assert_allclose((after[1] - before[1]) / (2 * h), now[2], rtol=1e-5, atol=1e-5)


def test_ramps_and_sweeps_reach_their_ends_and_stay() -> None:
    for law in (Ramp(2.0, 30.0, 0.25, 1.5), Sweep(2.0, 30.0, 0.25, 1.5, "log")):
        _, speed, acceleration = law.motion(np.array([0.1, 0.25, 1.75, 3.0]))
        np.testing.assert_allclose(speed, [2.0, 2.0, 30.0, 30.0], rtol=1e-14)
        np.testing.assert_array_equal(acceleration[[0, 3]], 0.0)
    middle = Sweep(2.0, 32.0, 0.0, 2.0, "log").motion(np.array([1.0]))[1][0]
    assert middle == pytest.approx(8.0, rel=1e-14)  # the geometric mean


def test_torque_laws_command_what_they_say() -> None:
    assert Torque(0.3).torque(7.0, 100.0, None) == 0.3
    table = TorqueTable(np.array([0.0, 2.0]), np.array([1.0, 5.0]))
    assert table.torque(0.5, 9.0, None) == 2.0
    run_up = RunUp(0.2, 100.0, 1.0)
    assert run_up.torque(0.0, 0.0, None) == pytest.approx(0.2, rel=1e-12)
    assert run_up.torque(0.0, 100.0, None) == 0.0
    assert run_up.torque(0.0, 200.0, None) == pytest.approx(-0.2, rel=1e-12)
    assert RunUp(0.2, -100.0, 1.0).torque(0.0, 0.0, None) == pytest.approx(-0.2, rel=1e-12)


MOTOR = Motor(0.2, 100.0, None, None, None, 1e-3, 5e-3, 0.1)


def test_available_torque_falls_linearly_to_the_no_load_speed_and_brakes_in_full() -> None:
    assert [available_torque(MOTOR, 1.0, w) for w in (0.0, 50.0, 100.0, 150.0)] == [0.2, 0.1, 0.0, 0.0]
    assert [available_torque(MOTOR, -1.0, w) for w in (0.0, -50.0, -100.0)] == [0.2, 0.1, 0.0]
    assert available_torque(MOTOR, -1.0, 90.0) == 0.2
    assert available_torque(Motor(None, 100.0, None, None, None, 0, 0, 0.1), 1.0, 500.0) == math.inf
    assert available_torque(Motor(0.2, None, None, None, None, 0, 0, 0.1), 1.0, 500.0) == 0.2


def test_friction_opposes_and_adds_to_the_limited_command() -> None:
    assert friction(MOTOR, 50.0) == pytest.approx(-0.05 - 0.005, rel=1e-12)
    assert friction(MOTOR, 0.0) == 0.0
    assert drive(MOTOR, 5.0, 50.0) == pytest.approx(0.1 - 0.055, rel=1e-12)
    assert drive(MOTOR, -5.0, 50.0) == pytest.approx(-0.2 - 0.055, rel=1e-12)
    assert drive(MOTOR, 0.01, 50.0) == pytest.approx(0.01 - 0.055, rel=1e-12)
    assert drive(None, 5.0, 50.0) == 5.0
    assert required_torque(MOTOR, drive(MOTOR, 0.03, 50.0), 50.0) == pytest.approx(0.03, rel=1e-12)
