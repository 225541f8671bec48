"""Quantities over regimes, speeds, programmes and states: closed formulas, and what the model gives for one stand."""

from __future__ import annotations

import json
import tomllib
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose
from numpy.typing import NDArray

import mahovik
from campaigns.files import read
from mahovik import stands
from mahovik.core.motion.programme import programme_text
from mahovik.core.stand.numbers import StandNumbers
from mahovik.core.toolchain import store
from mahovik.out.campaign.file import Campaign
from mahovik.out.campaign.quantities import STATISTICS, band_rms
from verify.programme.programmes import shaker

Array = NDArray[np.float64]

SATELLITE = '[vary]\n"rw1.unbalance.static" = { uniform = [1e-6, 3e-6] }\n"carrier.mass" = { uniform = [50, 51] }\n'


def computed(folder: Path, vary: str, over: str, wanted: dict[str, str], stand: str, samples: int = 3) -> Any:
    """Rows of a campaign, and its stands; `wanted`: `what` and further keys by name."""
    tables = "".join(f'[[quantity]]\nname = "{name}"\nwhat = {keys}\n' for name, keys in wanted.items())
    campaign = read(folder, f"{vary}[over]\n{over}\n{tables}", stand=stand, samples=samples)
    rows = campaign.rows(0, samples)
    assert not any(rows["error"]) and not len(campaign.rows(0, 0)["sample"])
    return rows, [stand_of(campaign, rows, j) for j in range(samples)]


def stand_of(campaign: Campaign, rows: dict[str, Any], j: int) -> mahovik.Stand:
    """The stand of a sample, from its columns."""
    return campaign.stand.replace(
        {varied.number.path: float(rows[varied.number.path][j]) for varied in campaign.draw.varied}
    )


def length(vectors: Array) -> Array:
    return np.asarray(np.linalg.norm(vectors, axis=-1))


def test_a_regime_is_that_of_the_model_of_each_sample(tmp_path: Path) -> None:
    """A free satellite rests exactly, so the steps are the same, and what is read of them too, to rounding."""
    ramp = {"default": {"ramp": {"to": "3000 rpm", "duration": "20 ms"}}}
    over = 'regime = { default = { ramp = { to = "3000 rpm", duration = "20 ms" } } }\nuntil = "50 ms"'
    wanted = {
        "force": '"peak specific force"\nat = "acc1"',
        "late": '"rms specific force"\nat = "acc1"\naxis = "y"\nafter = 0.03',
        "rms": '"rms acceleration"\nat = "acc1"',
        "rate": '"peak rate"\nat = "acc1"',
        "v": '"mean velocity"\nat = "acc1"',
        "shift": '"end displacement"\nat = "carrier"\naxis = "x"',
        "mount": '"peak force"\nat = "rw2"',
        "moment": '"rms moment"\nat = "rw2"\naxis = "y"',
        "tau": '"peak torque"\nat = "all"',
        "speed": '"least speed"\nat = "rw1"',
        "power": '"mean power"\nat = "rw2"',
        "turn": '"peak angle"\nat = "acc1"',
    }
    rows, model = computed(tmp_path, SATELLITE, over, wanted, "sat4")
    for j, stand in enumerate(model):
        run = mahovik.build(stand).simulate(0.05, regime=ramp, mounts=True)
        t, V, force = run["t"], run["V"], run["specific_force"][:, 0]
        r = np.array(stand.points[0].position if stand.points else stand.instruments[0].position)
        q = run["attitude"] * np.sign(run["attitude"][:, :1])
        expected = {
            "force": length(force).max(),
            "late": np.sqrt(np.mean(force[t >= 0.03 * (1 - 1e-12), 1] ** 2)),
            "rms": np.sqrt(np.mean(length(force) ** 2)),  # without gravity both are the same
            "rate": length(run["rate"][:, 0]).max(),
            "v": length(V[:, :3] + np.cross(V[:, 3:], r)).mean(),
            "shift": run["position"][-1, 0] - run["position"][0, 0],
            "mount": length(run["mount_wrench"][:, 1, :3]).max(),
            "moment": np.sqrt(np.mean(run["mount_wrench"][:, 1, 4] ** 2)),
            "tau": np.abs(run["tau"]).max(),
            "speed": run["phi_dot"][:, 0].min(),
            "power": np.mean(run["tau"][:, 1] * run["phi_dot"][:, 1]),
            "turn": 2 * np.arcsin(length(q[:, 1:]).max()),
        }
        for name, number in expected.items():
            assert_allclose(rows[name][j], number, rtol=1e-8 if name == "turn" else 1e-12, err_msg=name)


LADEN = """
schema = 1
name = "laden"
gravity = [0.3, -0.2, -9.81]
stream = [0.3, 0.1, -0.2]
stream_profile = { depth = [-1, 0, 2], velocity = [[1, 0, 0], [0.2, 0.3, 0], [0, 0.1, 0]] }
[carrier]
mass = 6
center_of_mass = [0.01, 0.02, -0.03]
inertia = [0.2, 0.3, 0.25]
inertia_about = "center_of_mass"
damping = { linear = [2, 3, 4, 0.3, 0.2, 0.1] }
[suspension]
stiffness = [300, 400, 500, 30, 40, 50]
damping = [3, 4, 5, 0.1, 0.2, 0.3]
[[flywheel]]
name = "a"
mass = 0.5
axis = [1, 2, -1]
zero = [0, 0, 1]
position = [0.1, 0.2, 0.05]
spin_inertia = 2e-3
transverse_inertia = [1.5e-3, 1.2e-3]
unbalance = { static = 2e-3, static_at = 0.4, dynamic = 1e-4 }
motor = { torque = 0.3, speed = 300, viscous = 1e-4, coulomb = 2e-3, coulomb_speed = 0.5 }
[[flywheel]]
name = "b"
mass = 0.4
axis = [0, 0, 1]
zero = [1, 0, 0]
spin_inertia = 1e-3
transverse_inertia = 8e-4
motor = { viscous = 2e-5, torque_speed = [[0, 0.1], [100, 0.15], [200, 0]] }
"""

HELD = """
[hold]
freedoms = ["yaw", "x", "pitch"]
pivot = [0.1, 0, 0.05]
[[hold.friction]]
freedom = "x"
coulomb = 0.5
smoothing = 0.05
"""

SEESAW = """
[hold]
freedoms = ["pitch"]
pivot = [0.1, 0.05, 0]
angles = [0.1, 0.2, 0.3]
[[hold.stop]]
freedom = "pitch"
at = 0.001
stiffness = 500
[[hold.stop]]
freedom = "pitch"
side = "below"
at = -0.001
stiffness = 500
"""


LAWS = {"a": {"run_up": {"torque": 0.5, "to": 250.0}}, "b": {"torque": 0.4}}


def check_rows(folder: Path, hold: str, start: Any, vary: str, samples: int) -> None:
    """To the bit each row of a campaign of the laden stand is the motion of its own stand, which is not built there."""
    (folder / "laden.toml").write_text(LADEN + hold, encoding="utf-8")
    keys: dict[str, Any] = {"regime": {"flywheel": LAWS}, "dt": 1e-3, "until": 0.01, "start": start}
    over = "\n".join(f"{key} = {_toml(value)}" for key, value in keys.items())
    wanted = {"speed": '"end speed"\nat = "a"', "rate": '"end rate"\nat = "carrier"\naxis = "y"'}
    kept = set[str]()
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(store, "find_numbers", lambda _: None)
        patch.setattr(store, "keep_numbers", lambda name, _: kept.add(name))
        rows, of_samples = computed(folder, f"[vary]\n{vary}\n", over, wanted, "laden.toml", samples)
    assert len(kept) == 1
    for j, of_sample in enumerate(of_samples):
        begin = None if start == "rest" else start
        run = mahovik.build(of_sample).simulate(0.01, regime=keys["regime"], start=begin, dt=1e-3)
        assert (rows["speed"][j], rows["rate"][j]) == (run["phi_dot"][-1, 0], run["V"][-1, 4])


@pytest.mark.parametrize(
    ("hold", "start"),
    [("", {"V": [0.1, 0.2, 0.3, 0.1, -0.2, 0.3], "angles": [0.1, 0.2, 0.3]}), (HELD, {"u": [0.1, 0.2, 0.3]}),
     (SEESAW, {"u": [0.5], "phi_dot": [3, 4]})],
    ids=["free", "held", "seesaw"],
)  # fmt: skip
@settings(max_examples=4)
@given(data=st.data())
def test_a_row_is_the_motion_of_its_own_stand(
    tmp_path_factory: pytest.TempPathFactory, hold: str, start: dict[str, Any], data: st.DataObject
) -> None:
    """Any number may vary: of a body, of a law, of a motor, of the place where the carrier is held."""
    stand = mahovik.Stand.from_dict(tomllib.loads(LADEN + hold))
    fixed = ("hold.basis", "hold.axis", "hold.slide")
    numbers = [x for x in StandNumbers(stand, stand.to_dict(), motors=True) if not x.path.startswith(fixed)]
    number = data.draw(st.sampled_from(numbers))
    low, high = sorted([number.value * 0.999, number.value * 1.001]) if number.value else (0.0, 1e-6)
    vary = f'"{number.path}" = {{ uniform = [{low!r}, {high!r}] }}'
    check_rows(tmp_path_factory.mktemp("campaign"), hold, start, vary, samples=1)


@pytest.mark.parametrize(
    ("hold", "start", "vary"),
    [("", {"V": [0.1] * 6}, '"a.motor.coulomb_speed" = { lognormal = [0.005, 2] }'),
     ("", {"V": [0.1] * 6}, '"b.motor.torque_speed[0][0]" = { normal = [0, 1] }'),
     ("", {"V": [0.1] * 6}, '"a.motor.torque" = { uniform = [0.01, 0.6] }\n"a.mass" = { uniform = [0.1, 1] }'),
     (HELD, {"u": [0.1] * 3}, '"hold.position[0]" = { uniform = [0, 1] }\n"hold.angles[1]" = { uniform = [0, 0.1] }'),
     (SEESAW, "rest", '"hold.pivot[0]" = { uniform = [0.08, 0.1] }')],
    ids=["more parts of a step", "points below rest", "a motor and a body", "place", "pivot"],
)  # fmt: skip
def test_motors_and_places_of_a_hold_are_rows_of_one_build(tmp_path: Path, hold: str, start: Any, vary: str) -> None:
    check_rows(tmp_path, hold, start, vary, samples=8)


def _toml(value: Any) -> str:
    if isinstance(value, dict):
        return "{" + ", ".join(f"{key} = {_toml(x)}" for key, x in value.items()) + "}"
    return json.dumps(value)


def test_samples_begin_at_their_own_rest(tmp_path: Path) -> None:
    """A sample with all flywheels held does not move, however far its weight lets the carrier down."""
    vary = '[vary]\n"carrier.mass" = { uniform = [11, 13] }\n"carrier.center_of_mass[0]" = { uniform = [0, 0.01] }\n'
    wanted = {"moved": '"peak displacement"\nat = "carrier"', "a": '"peak acceleration"\nat = "carrier"'}
    rows, _ = computed(tmp_path, vary, 'regime = { default = { hold = true } }\nuntil = "10 ms"', wanted, "bench8")
    assert np.all(rows["a"] < 1e-10) and np.all(rows["moved"] < 1e-13)


def test_one_sample_that_fails_has_its_reason_and_the_others_their_numbers(tmp_path: Path) -> None:
    """A stiffness beyond what steps follow; a mass that no body has; a stiffness at which no rest is found."""
    quantity = '[[quantity]]\nname = "a"\nwhat = "peak acceleration"\nat = "carrier"\n'
    run = "[over]\nregime = { default = { speed = 100 } }\nuntil = 0.02\n"
    stiff = '[vary]\n"suspension.stiffness[0][0]" = { lognormal = [1e8, 9] }\n'
    moved = read(tmp_path, stiff + run + "start = { position = [1e-3, 0, 0] }\n" + quantity, stand="bench8").rows(0, 16)
    rested = read(tmp_path, stiff + run + quantity, stand="bench8").rows(0, 16)
    heavy = read(tmp_path, '[vary]\n"w1.inertia.J12" = { normal = [0, 1e-3] }\n' + run + quantity, stand="bench8").rows(
        0, 16
    )
    for rows, words in ((moved, "at t = "), (rested, "bench8: no rest pose"), (heavy, "inertia")):
        bad = np.array([bool(reason) for reason in rows["error"]])
        assert 0 < bad.sum() < 16 and np.array_equal(np.isnan(rows["a"]), bad)
        assert any(words in reason for reason in rows["error"])


CLAMPED = """
schema = 1
name = "force_table"
[carrier]
mass = 20
inertia = [1, 1, 1]
[hold]
freedoms = []
[[flywheel]]
name = "w"
mass = 1
axis = [0, 0, 1]
zero = [1, 0, 0]
spin_inertia = 0.002
transverse_inertia = 0.001
unbalance = { static = "50 g mm" }
"""

PENDULUM = CLAMPED.replace("freedoms = []", 'freedoms = ["pitch"]\npivot = [0, 0, 0.2]').replace(
    "[carrier]", "gravity = [0, 0, -9.81]\n[carrier]"
)


def test_a_force_table_reads_the_unbalance_of_each_sample(tmp_path: Path) -> None:
    """U w^2, over constant speeds and in time, where it turns as the wheel does."""
    (tmp_path / "table.toml").write_text(CLAMPED, encoding="utf-8")
    vary, wanted = (
        '[vary]\n"w.unbalance.static" = { uniform = [1e-5, 9e-5] }\n',
        {"F": '"rms force"\nat = "hold.reaction"'},
    )
    for over, factor in (
        ("speeds = { w = 157.0 }", 1.0),
        ("regime = { default = { speed = 157.0 } }\nuntil = 0.02", 1.0),
    ):
        rows, _ = computed(tmp_path, vary, over, wanted, "table.toml")
        assert rows["F"] == pytest.approx(factor * rows["w.unbalance.static"] * 157.0**2, rel=1e-9)


def test_over_speeds_there_are_the_sums_of_vibration_above_zero_hertz(tmp_path: Path) -> None:
    """Weight, an ellipse that few moments of a turn miss, and a band."""
    (tmp_path / "table.toml").write_text(CLAMPED.replace("[carrier]", "gravity = [0, 0, -9.81]\n[carrier]").replace(
        "axis = [0, 0, 1]", "axis = [0.3, 0.5, 1]"), encoding="utf-8")  # fmt: skip
    names = {"peak": '"peak force"', "x": '"peak force"\naxis = "x"', "rms": '"rms force"'}
    names["above"] = '"rms force"\nband = ["40 Hz", "400 Hz"]'
    wanted = {name: f'{what}\nat = "hold.reaction"' for name, what in names.items()}
    rows, stands = computed(
        tmp_path, '[vary]\n"w.mass" = { uniform = [1, 2] }\n', "speeds = { w = 157.0 }", wanted, "table.toml"
    )
    for k, stand in enumerate(stands):
        study = mahovik.vibration(stand, speed={"w": 157.0}, at="hold.reaction")
        expected = {"peak": study["length"]["peak"], "rms": study["length"]["rms"], "x": study["peak"][0], "above": 0.0}
        assert {name: rows[name][k] for name in names} == expected


def test_a_pendulum_hangs_from_the_pivot_of_each_sample(tmp_path: Path) -> None:
    """The pivot is off the axis: the pendulum hangs from it with its weight, and does not move."""
    (tmp_path / "pendulum.toml").write_text(PENDULUM, encoding="utf-8")
    wanted = {"F": '"peak force"\nat = "hold.reaction"', "rate": '"peak rate"\nat = "carrier"'}
    over = "regime = { default = { hold = true } }\nuntil = 0.02"
    rows, _ = computed(tmp_path, '[vary]\n"hold.pivot[0]" = { uniform = [0, 0.08] }\n', over, wanted, "pendulum.toml")
    assert rows["F"] == pytest.approx(21 * 9.81, rel=1e-9) and np.all(rows["rate"] < 1e-9)
    rows, _ = computed(tmp_path, '[vary]\n"carrier.mass" = { uniform = [19, 21] }\n', over, wanted, "pendulum.toml")
    assert rows["F"] == pytest.approx((1 + rows["carrier.mass"]) * 9.81, rel=1e-9) and np.all(rows["rate"] < 1e-9)


def test_what_all_samples_are_refused_for_is_refused_once(tmp_path: Path) -> None:
    (tmp_path / "laden.toml").write_text(LADEN + HELD, encoding="utf-8")
    (tmp_path / "p.json").write_text(programme_text(shaker()[2]), encoding="utf-8")
    (tmp_path / "m.json").write_bytes(stands.motions("shaker2")[0].read_bytes())
    vary, wanted = '[vary]\n"hold.position[0]" = { uniform = [0, 1] }\n', {"a": '"peak acceleration"\nat = "carrier"'}
    runs = {
        "speeds = { a = 100 }": "stream_profile",
        'programme = "p.json"\nmotion = "m.json"': r"position\[0\] varies",
    }
    for over, words in runs.items():
        with pytest.raises(mahovik.MahovikError, match=words):
            computed(tmp_path, vary, over, wanted, "laden.toml")


def test_states_are_those_of_the_model(tmp_path: Path) -> None:
    """Each row has the largest value over two states, computed by the model of the sample's own stand."""
    lines = [
        '{"phi_dot": [100, 0, 0, 0]}',
        '{"phi_dot": [300, 50, 0, 0], "phi": [1, 2, 3, 4], "phi_ddot": [1, 2, 3, 4]}',
    ]
    (tmp_path / "s.jsonl").write_text("\n".join(lines), encoding="utf-8")
    wanted = {"tau": '"peak torque"\nat = "rw1"', "mount": '"end force"\nat = "rw2"'}
    wanted["force"] = '"peak specific force"\nat = "acc1"'
    rows, sat4 = computed(tmp_path, SATELLITE, 'states = "s.jsonl"', wanted, "sat4")
    model = mahovik.build(sat4[1])
    x = model.states(phi=[[0, 0, 0, 0], [1, 2, 3, 4]], phi_dot=[[100, 0, 0, 0], [300, 50, 0, 0]])
    phi_ddot = np.array([[0, 0, 0, 0], [1, 2, 3, 4]])
    V_dot = model.forward(x, phi_ddot).V_dot
    assert_allclose(rows["tau"][1], np.abs(model.torque(x, V_dot, phi_ddot).tau[:, 0]).max(), rtol=1e-13)
    assert_allclose(rows["force"][1], length(model.points(x, V_dot).specific_force[:, 0]).max(), rtol=1e-13)
    mount = model.mounts(x, V_dot, phi_ddot).mount_wrench[1, 1, :3]
    assert_allclose(rows["mount"][1], length(mount), rtol=1e-13)


def test_a_programme_is_followed_by_the_stand_that_it_is_for(tmp_path: Path) -> None:
    """A heavier shaker misses its motion; the programme of another stand is refused."""
    (tmp_path / "p.json").write_text(programme_text(shaker()[2]), encoding="utf-8")
    spin = next(path for path in stands.motions("shaker2") if "spin" in path.name)
    (tmp_path / "m.json").write_bytes(spin.read_bytes())
    over = 'programme = "p.json"\nmotion = "m.json"'
    wanted = {"share": '"peak error"', "z": '"peak error"\naxis = "z"'}
    rows, _ = computed(tmp_path, '[vary]\n"carrier.mass" = { tolerance = 1e-9 }\n', over, wanted, "shaker2")
    assert np.all(rows["share"] < 1e-5)
    heavier, _ = computed(
        tmp_path, '[vary]\n"carrier.mass" = { tolerance = ["50 g", "90 g"] }\n', over, wanted, "shaker2"
    )
    assert np.all(heavier["share"] > 1e-3) and np.all(heavier["z"] > 100 * rows["z"])
    with pytest.raises(mahovik.MahovikError, match=r"over: programme: p\.json: programme of another stand"):
        mahovik.example("shaker2").replace({"carrier.mass": 3.0}).save(tmp_path / "other.toml")
        computed(tmp_path, '[vary]\n"carrier.mass" = { tolerance = 1e-9 }\n', over, wanted, "other.toml")


@given(st.integers(0, 2**32 - 1), st.sampled_from([1, 3]))
def test_statistics_are_those_of_numpy(seed: int, components: int) -> None:
    values = np.random.default_rng(seed).normal(size=(40, components, 5))
    size = values[:, 0] if components == 1 else np.linalg.norm(values, axis=1)
    expected = {
        "peak": np.abs(size).max(axis=0), "rms": np.sqrt(np.mean(size**2, axis=0)), "mean": size.mean(axis=0),
        "least": size.min(axis=0), "end": size[-1],
    }  # fmt: skip
    for name, numbers in expected.items():
        assert_allclose(STATISTICS[name](values), numbers, rtol=1e-14, atol=1e-15)


@given(st.floats(40.0, 90.0), st.floats(0.0, 6.0), st.floats(0.1, 10.0))
def test_a_band_has_the_rms_of_what_swings_in_it(frequency: float, phase: float, amplitude: float) -> None:
    """A sine at any frequency in the band, beside a mean, a slow and a fast one outside it."""
    t: Array = np.linspace(0.0, 1.0, 1001)
    inside = amplitude * np.sin(2 * np.pi * frequency * t + phase)
    outside = 3.0 + 2.0 * np.sin(2 * np.pi * 11.3 * t) + np.cos(2 * np.pi * 203.7 * t)
    values: Array = np.stack([np.stack([inside, outside], axis=1), np.stack([outside, 2 * inside], axis=1)], axis=2)
    expected: Array = np.array([1.0, 2.0]) * amplitude / np.sqrt(2)
    assert_allclose(band_rms(t, values, (30.0, 100.0)), expected, rtol=1e-2, atol=2e-3)
