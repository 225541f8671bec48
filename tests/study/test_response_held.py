"""Vibration of held carriers, periodic and by lines: closed formulas, the free carrier, the C through time."""

from __future__ import annotations

import json
import math
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import mahovik
from cli.run import refused, run
from mahovik import stands
from mahovik.core.stand import Stand, load
from mahovik.core.stand.hold import FREEDOMS
from mahovik.core.stand.model import Hold
from mahovik.out.commands.vibration import vibration as command
from mahovik.use.vibration import steady as steady_motions
from mahovik.use.vibration.lines import COMBINATION
from mahovik.use.vibration.speeds import Asked, read_speeds
from mahovik.use.vibration.steady import steady
from mahovik.use.vibration.study import Vibration, vibration
from mahovik.use.vibration.view import find_view
from simulate.runs import columns as columns_of

HELD = Path(__file__).parents[2] / "docs" / "held"
ZERO = (0.0, 0.0, 0.0)


def stand_of(document: dict[str, Any]) -> Stand:
    return mahovik.Stand.from_dict(document)


def table(**unbalance: str) -> dict[str, Any]:
    """A wheel that turns about z, 100 mm above O1, on a clamped carrier without weight."""
    return {
        "schema": 1,
        "name": "table",
        "carrier": {"mass": 12, "inertia": [0.2, 0.2, 0.2]},
        "hold": {"freedoms": []},
        "flywheel": [{"name": "wheel", "position": [0, 0, 0.1], "axis": [0, 0, 1], "zero": [1, 0, 0], "mass": 2,
                      "spin_inertia": 4e-3, "transverse_inertia": 2.5e-3, "unbalance": unbalance}],
    }  # fmt: skip


def reaction(response: Any, quantity: str) -> Any:
    """Magnitudes (H + 1, 3) of the harmonics of the reaction."""
    return np.abs(response.harmonics(find_view(response.scene.stand, "hold.reaction", quantity))[1])


@pytest.mark.parametrize(
    ("unbalance", "force", "moment"),
    [({"static": "72 g mm"}, 72e-6, 72e-7), ({"dynamic": "5 kg mm^2"}, 0.0, 5e-6)],
)
def test_a_force_table_reads_an_unbalance(unbalance: dict[str, str], force: float, moment: float) -> None:
    """The reaction is U w^2 across the axis, its moment that with an arm of 100 mm, at one order alone."""
    response = steady(stand_of(table(**unbalance)), [300.0])
    for quantity, size in (("force", force * 300.0**2), ("moment", moment * 300.0**2)):
        np.testing.assert_allclose(reaction(response, quantity)[1], [size, size, 0.0], rtol=1e-12, atol=1e-12)
    assert reaction(response, "force")[2:].max() < 1e-11


def shaker(friction: bool, damping: float = 300.0) -> dict[str, Any]:
    """One exciter about x on a rail along z with a spring; damped by the suspension, or by viscous friction."""
    hold = {"freedoms": ["z"]} | ({"friction": [{"viscous": damping}]} if friction else {})
    return {
        "schema": 1, "name": "shaker",
        "carrier": {"mass": 60, "inertia": [1.6, 1.9, 2.4]},
        "hold": hold,
        "suspension": {"stiffness": [0, 0, 4e4, 0, 0, 0], "damping": [0, 0, 0 if friction else damping, 0, 0, 0]},
        "flywheel": [{"name": "w", "axis": [1, 0, 0], "zero": [0, 0, 1], "mass": 8, "spin_inertia": 0.02,
                      "transverse_inertia": 0.012, "unbalance": {"static": "160 g m"}}],
    }  # fmt: skip


@pytest.mark.parametrize(("friction", "speed"), [(False, 10.0), (True, 24.0), (False, 80.0)])
def test_a_shaker_of_one_freedom(friction: bool, speed: float) -> None:
    """It moves by m e w^2 / (k - M w^2 + i c w) along the rail; m e w^2 across the rail is held."""
    M, k, c, me = 68.0, 4e4, 300.0, 0.16
    response = steady(stand_of(shaker(friction)), [speed])
    size = me * speed**2 / abs(k - M * speed**2 + 1j * c * speed)

    def amplitude(name: str, quantity: str) -> Any:
        return np.abs(response.harmonics(find_view(response.scene.stand, name, quantity))[1][1])

    assert amplitude("hold.z", "displacement") == pytest.approx(size, rel=1e-9)
    assert amplitude("hold.z", "acceleration") == pytest.approx(size * speed**2, rel=1e-9)
    at_carrier = amplitude("carrier", "displacement")
    np.testing.assert_allclose(at_carrier, [0.0, 0.0, size], rtol=1e-9, atol=1e-14)
    np.testing.assert_allclose(reaction(response, "force")[1], [0.0, me * speed**2, 0.0], rtol=1e-9, atol=1e-9)


def test_six_freedoms_are_the_free_carrier() -> None:
    """A hold that blocks nothing leaves the motion of points, without reaction."""
    free = load(stands.path("bench8"))
    held = replace(free, hold=Hold(tuple(FREEDOMS.values()), (0.1, -0.2, 0.3), ZERO, ZERO))
    speeds = [60.0, -40.0, 20.0, 0, 0, 0, 0, 0]
    response, other = steady(free, speeds), steady(held, speeds)
    for name in [*(i.name for i in free.instruments), *(p.name for p in free.points)]:
        view = find_view(free, name)
        expected, actual = (motion.harmonics(view)[1][:8] for motion in (response, other))
        np.testing.assert_allclose(actual, expected, rtol=0, atol=1e-8 * np.abs(expected).max())
    size = reaction(other, "force").max()
    assert size < 1e-9 * 10.0 * free.carrier.mass


def two_wheels(first: str, second: str) -> Stand:
    """Two wheels about z, 100 mm above and below O1, on a clamped carrier that weighs 14 kg or more."""
    document = table() | {"gravity": [0, 0, -9.81]}
    wheel = {key: value for key, value in document["flywheel"][0].items() if key != "unbalance"}
    document["flywheel"] = [
        wheel | {"name": "up", "unbalance": {"static": first}},
        wheel | {"name": "down", "position": [0, 0, -0.1], "unbalance": {"dynamic": second}},
    ]
    return stand_of(document)


def lines_of(stand: Stand, speeds: Asked, at: str, quantity: str | None = None) -> Vibration:
    """Lines of what is seen, of a sweep at its ends and more."""
    return vibration(stand, read_speeds(stand, speeds), find_view(stand, at, quantity, "angle"), steps=2)


def size(vibration: Vibration, wheel: str) -> Any:
    """Amplitudes (3) of the first order of one wheel at the last speed; zero where there is none."""
    for i, name in enumerate(vibration.lines.names):
        if (name.wheel, name.order) == (wheel, 1):
            return vibration.lines.sizes[-1, i]
    return np.zeros(3)


@pytest.mark.parametrize("speeds", [{"up": 300.0, "down": -211.7}, {"up": "100..300", "down": -211.7}])
@pytest.mark.parametrize("quantity", ["force", "moment"])
def test_a_clamped_carrier_moves_only_the_reaction(speeds: dict[str, Any], quantity: str) -> None:
    """The reaction is U w^2 with an arm of 100 mm, a couple of U w^2 of the dynamic unbalance, and the weight."""
    stand = two_wheels("72 g mm", "5 kg mm^2")
    result = lines_of(stand, speeds, "hold.reaction", quantity)
    force, couple = 72e-6 * 300.0**2, 5e-6 * 211.7**2
    weight = 72e-6 * 9.81  # its moment, of a centre of mass beside the axis
    first, second = (force, 0.0) if quantity == "force" else (0.1 * force + weight, couple)
    np.testing.assert_allclose(size(result, "up"), [first, first, 0.0], rtol=1e-12, atol=1e-12)
    np.testing.assert_allclose(size(result, "down"), [second, second, 0.0], rtol=1e-12, atol=1e-12)
    assert result.seen.measure.unit == ("N" if quantity == "force" else "N m")
    assert not any(name.source == COMBINATION for name in result.lines.names)
    assert result.off < 1e-9 and all(np.max(line.left_out) < 1e-9 for line in result.whole.values())


@pytest.mark.parametrize(("friction", "last"), [(False, "11.3"), (True, "5..11.3")])
def test_a_shaker_of_one_freedom_is_an_oscillator(friction: bool, last: str) -> None:
    """Two exciters at speeds without a common period: m e w^2 / (k - M w^2 + i c w) of each, and m e w^2 held across.

    The mount of each gives its wheel what moves it: |w^2 (m_w z + m e)| along the rail, m e w^2 across it.
    """
    document = shaker(friction)
    document["flywheel"].append(document["flywheel"][0] | {"name": "v"})
    stand = stand_of(document)
    speeds: dict[str, float | str] = {"w": 24.0, "v": last}
    M, k, c, me, m = 76.0, 4e4, 300.0, 0.16, 8.0
    motion = lines_of(stand, speeds, "carrier", "displacement")
    held, mount = (lines_of(stand, speeds, at) for at in ("hold.reaction", "v"))
    along_rail = lines_of(stand, speeds, "hold.z", "velocity")
    assert command(stand, speed=speeds, at="hold.z")["rms"].shape[-1] == 1
    for wheel, w in (("w", 24.0), ("v", 11.3)):
        z = me * w**2 / (k - M * w**2 + 1j * c * w)
        np.testing.assert_allclose(size(motion, wheel), [0.0, 0.0, abs(z)], rtol=1e-9, atol=1e-15)
        np.testing.assert_allclose(size(along_rail, wheel), [w * abs(z), 0.0, 0.0], rtol=1e-9, atol=1e-15)
        np.testing.assert_allclose(size(held, wheel), [0.0, me * w**2, 0.0], rtol=1e-9, atol=1e-9)
        excitation = me if wheel == "v" else 0.0
        along, across = abs(w**2 * (m * z + excitation)), excitation * w**2
        np.testing.assert_allclose(size(mount, wheel), [0.0, along, across], rtol=1e-9, atol=1e-9)


SWINGING = {
    "schema": 1, "name": "swinging", "gravity": [0, 0, -9.81],
    "carrier": {"mass": 2, "center_of_mass": [0, 0, -0.2], "inertia": [0.02, 0.02, 0.01],
                "inertia_about": "center_of_mass"},
    "hold": {"freedoms": ["pitch"], "pivot": [0, 0, 0.05], "friction": [{"viscous": 1.0}]},
    "flywheel": [{"name": name, "axis": [0, 1, 0], "zero": [0, 0, 1], "position": [0, 0, z], "mass": 0.5,
                  "spin_inertia": 1e-3, "transverse_inertia": 6e-4, "unbalance": {"static": "5 g m"}}
                 for name, z in (("w1", -0.2), ("w2", -0.3))],
}  # fmt: skip
"""A damped pendulum with two heavily unbalanced wheels."""


@pytest.mark.parametrize("quantity", ["force", "moment"])
def test_with_a_common_period_it_is_the_response(quantity: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """The lines of the torus of both wheels' phases are those of the motion with a common period."""
    stand = stand_of(SWINGING)
    monkeypatch.setattr(steady_motions, "FEW_TURNS", 0)
    result = lines_of(stand, {"w1": 20.0, "w2": 30.0}, "hold.reaction", quantity)
    assert "harmonic balance" in result.whole[0].method
    monkeypatch.setattr(steady_motions, "FEW_TURNS", 40)
    _, wanted = steady(stand, [20.0, 30.0]).harmonics(find_view(stand, "hold.reaction", quantity))
    total = np.zeros((24, 3), dtype=complex)
    for i, hertz in enumerate(result.lines.frequency[0]):
        if (k := round(hertz * 2.0 * math.pi / 10.0)) < len(total):
            total[k] += result.lines.amplitude[0, i]
    np.testing.assert_allclose(total[1:8], wanted[1:8], rtol=0, atol=1e-5 * np.abs(wanted[1:]).max())


def test_a_maker_s_table_shakes_a_force_table(tmp_path: Path) -> None:
    """c w^2 at each order, through a bearing mode at H times that; noise whose mean square is its integral."""
    path, noise, inner = (tmp_path / name for name in ("wheel.csv", "noise.csv", "inner.csv"))
    path.write_text("order [-],radial force [N/(rad/s)^2],axial force [N/(rad/s)^2]\n1,2e-6,0\n2.5,0,3e-6\n")
    noise.write_text("frequency [Hz],axial force [N^2/Hz]\n10,1e-4\n210,1e-4\n")
    inner.write_text("mode,frequency [Hz],damping [-]\naxial,50,0.1\n")
    stand = stand_of(table(static="72 g mm"))
    words: dict[str, Any] = {"speed": 100.0, "harmonics": {"all": path}}
    result = command(stand, **words, at="hold.reaction", noise={"all": noise})
    amplitudes = dict(zip(result["order"], result["amplitude"], strict=True))
    np.testing.assert_allclose(amplitudes[1.0], [2e-2, 2e-2, 0.0], rtol=1e-9, atol=1e-15)
    np.testing.assert_allclose(amplitudes[2.5], [0.0, 0.0, 3e-2], rtol=1e-9, atol=1e-15)
    assert result["rms"][2] == pytest.approx(math.sqrt(3e-2**2 / 2.0 + 1e-4 * 200.0), rel=1e-6)
    mounted = command(stand, **words, at="wheel", noise={"all": noise})
    assert mounted["rms"][0] == pytest.approx(result["rms"][2], rel=1e-9)  # its axis is its first
    ratio = 250.0 / (2.0 * math.pi) / 50.0
    gain = abs((1.0 + 0.2j * ratio) / (1.0 - ratio**2 + 0.2j * ratio))
    soft = command(stand, **words, at="hold.reaction", inner_modes={"all": inner})
    assert soft["amplitude"][soft["order"] == 2.5][0, 2] == pytest.approx(3e-2 * gain, rel=1e-9)


def test_requirements_on_a_force() -> None:
    stand = str(HELD / "force_table.toml")
    asked = ("vibration", stand, "--speed", "wheel=0..3000rpm", "--at", "hold.reaction", "--steps", "4", "--json")
    w = math.radians(6 * 3000)
    result = json.loads(run(*asked, "--require", "rms 6 N").stdout)
    assert result["requirements"][0]["value"] == pytest.approx(72e-6 * w**2 / math.sqrt(2), rel=1e-9)
    assert result["requirements"][0]["met"] and result["units"]["rms"] == "N"
    assert run(*asked, "--require", "worst 7 N").exit_code == 1
    words = command(
        stand, speed="wheel=0..3000rpm", at="hold.reaction", steps=4, require=["rms 6000 mN 0..1e3Hz"]
    ).text()
    assert "met: rms 6000 mN 0..1e3Hz: 5025 mN on " in words and " at 3000 rpm, 0.837 times the limit" in words
    assert "expected a force" in refused(*asked, "--require", "rms 1 arcsec")


@pytest.mark.slow
def test_it_is_the_motion_of_the_c_through_time() -> None:
    """A pendulum under two wheels, stepped with a carry until it is steady; lines fitted to what it reads over 40 s."""
    stand, speeds, every = stand_of(SWINGING), [20.0, 31.7], 0.02
    lines = lines_of(stand, speeds, "hold.reaction").lines
    done = columns_of(
        stand, 50.0, regime={"flywheel": {"w1": {"speed": 20.0}, "w2": {"speed": 31.7}}}, start={"phi_dot": speeds},
        dt=every / 8, every=every, carried=True,
    )  # fmt: skip
    columns = [f"hold.reaction.{axis} [N]" for axis in "xyz"]
    t = np.arange(2001) * every + 10.0
    values = np.column_stack([done[column][-2001:] for column in columns])
    large = lines.sizes[0].max(axis=1) > 1e-4 * lines.sizes[0].max()
    there = large & (lines.frequency[0] > 0.0)
    wave = np.exp(2j * np.pi * np.outer(t, lines.frequency[0, there]))
    basis = np.hstack([np.ones((len(t), 1)), wave.real, -wave.imag])
    fitted, *_ = np.linalg.lstsq(basis, values, rcond=None)
    n = int(there.sum())
    measured = fitted[1 : n + 1] + 1j * fitted[n + 1 :]
    np.testing.assert_allclose(measured, lines.amplitude[0, there], rtol=0, atol=1e-4 * lines.sizes[0].max())
    assert n > 4


@pytest.mark.parametrize(
    ("words", "expected"),
    [
        (["--at", "hold.reacton"], 'hold.reacton: unknown, did you mean "hold.reaction"?'),
        (["--at", "hold.z", "--quantity", "angle"], "hold.z has none; expected one of displacement, velocity"),
        (["--at", "hold.z", "--modes", "modes.csv"], "--modes: structural modes have no shape of a freedom, hold.z"),
        (["--at", "hold.pitch"], "--at hold.pitch: unknown, "),
        (["--at", "hold.2"], "--at hold.2: unknown"),
        (
            ["--at", "hold.reaction", "--quantity", "angle"],
            "angle: hold.reaction has none; expected one of force, moment",
        ),
        (["--at", "carrier", "--quantity", "moment"], "--quantity moment: carrier has none; expected a flywheel"),
        (["--at", "left", "--modes", "modes.csv"], "--modes: structural modes have no shape of a load, left"),
    ],
)
def test_refusals(words: list[str], expected: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path("modes.csv").write_text("frequency [Hz],damping [-],modal mass [kg]\n10,0.01,1\n")
    text = refused("vibration", str(HELD / "linear_shaker.toml"), "--speed", "all=10", *words)
    assert expected in text and len(text.splitlines()) == 1


def test_a_free_carrier_has_no_reaction() -> None:
    text = refused("vibration", str(stands.path("sat4")), "--speed", "all=10", "--at", "hold.reaction")
    assert "--at hold.reaction: unknown, expected one of acc1, carrier, rw1" in text
