"""Quantities over regimes, speeds, states and programmes are those of the commands for the stand of the sample."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose

import mahovik
from campaigns.sections import Keys, computation, tables_of
from control.following import SERVO
from mahovik import stands
from mahovik.core.motion.programme import programme_text
from mahovik.use.study.rest import rest
from verify.programme.programmes import shaker

N = 3
SATELLITE = {"rw1.unbalance.static": np.linspace(1e-6, 3e-6, N), "carrier.mass": np.linspace(50, 51, N)}
TABLE = {"w1.unbalance.static": np.linspace(1e-6, 2e-3, N), "carrier.mass": np.linspace(11.9, 12.1, N)}

WANTED: dict[str, Keys] = {
    "a": {"peak": "acceleration", "at": "carrier"},
    "mount": {"peak": "force", "of": "w1"},
    "moment": {"rms": "moment", "of": "w1"},
    "tau": {"peak": "torque", "of": "w2"},
    "speed": {"end": "speed", "of": "w2"},
    "power": {"mean": "power", "of": "w2"},
}


def columns(stand: mahovik.Stand, until: float, **options: Any) -> dict[str, np.ndarray]:
    """The columns of a simulation by name."""
    run = mahovik.simulate(stand, until=until, mounts=True, **options)
    return {f"{one.name} [{one.unit}]" if one.unit else one.name: one.values for one in run.columns}


def vector(found: dict[str, np.ndarray], names: str, what: str) -> np.ndarray:
    """Three columns as rows (T, 3): `vector(found, "xyz", "force_{} acc1 [m/s2]")`."""
    return np.stack([found[what.format(letter)] for letter in names], axis=1)


@pytest.mark.slow
def test_a_satellite_with_given_speeds_is_that_of_simulate() -> None:
    """It rests exactly, so the steps are the same, and what is read of them too, to rounding."""
    ramp = {"default": {"ramp": {"to": "3000 rpm", "duration": "20 ms"}}}
    wanted: dict[str, Keys] = {
        "force": {"peak": "specific_force", "at": "acc1"},
        "rms": {"rms": "acceleration", "at": "acc1"},
        "late": {"rms": "specific_force", "at": "acc1", "axis": "y", "after": "30 ms"},
        "rate": {"peak": "rate", "at": "acc1"},
        "shift": {"end": "displacement", "at": "carrier", "axis": "x"},
        "mount": {"peak": "force", "of": "rw2"},
        "tau": {"peak": "torque", "of": "all"},
    }
    own = computation(mahovik.example("sat4"), {"regime": ramp, "until": "50 ms"}, wanted)
    assert own.units["force"] == "m/s2"
    assert own.units["mount"] == "N"
    tables = tables_of(own, SATELLITE)
    values, reasons = own.values(tables)
    assert not any(reasons)
    for j in range(N):
        found = columns(tables.stand(j), 0.05, regime=ramp)
        force = vector(found, "xyz", "force_{} acc1 [m/s2]")
        late = found["t [s]"] >= 0.03 * (1 - 1e-12)
        expected = {
            "force": np.linalg.norm(force, axis=1).max(),
            "rms": np.sqrt(np.mean((force**2).sum(axis=1))),  # without gravity both are the same
            "late": np.sqrt(np.mean(force[late, 1] ** 2)),
            "rate": np.linalg.norm(vector(found, "xyz", "gyro_{} acc1 [rad/s]"), axis=1).max(),
            "shift": found["x [m]"][-1] - found["x [m]"][0],
            "mount": np.linalg.norm(vector(found, "XYZ", "mount_{} rw2 [N]"), axis=1).max(),
            "tau": max(np.abs(found[f"tau rw{s} [N m]"]).max() for s in range(1, 5)),
        }
        for name, number in expected.items():
            assert_allclose(values[name][j], number, rtol=1e-13, err_msg=name)
        assert values["shift"][j] == expected["shift"]  # a number of the state: to the bit


GOVERNED = {"default": {"run_up": {"torque": "0.05 N m", "to": "100 rpm"}}, "flywheel": {"w3": {"speed": 20}}}
PUSHED = {"default": {"ramp": {"to": 60, "duration": "9 ms"}}, "wrench": {"carrier": [0, 0, 1, 0, 0.1, 0]}}


@pytest.mark.parametrize(
    "regime",
    [
        pytest.param(GOVERNED, id="run-up beside a speed", marks=pytest.mark.slow),
        pytest.param(PUSHED, id="ramp with a wrench", marks=pytest.mark.slow),
    ],
)
def test_regimes_of_a_table_on_springs_are_those_of_simulate(regime: dict[str, Any]) -> None:
    """Each sample begins at its own rest, which is found otherwise than by `rest`, to 1e-12 m/s2."""
    own = computation(mahovik.example("bench8"), {"regime": regime, "until": "20 ms", "every": "2 ms"}, WANTED)
    tables = tables_of(own, TABLE)
    values, reasons = own.values(tables)
    assert not any(reasons)
    for j in (0, N - 1):
        found = columns(tables.stand(j), 0.02, regime=regime, every=2e-3)
        assert_allclose(
            values["mount"][j], np.linalg.norm(vector(found, "XYZ", "mount_{} w1 [N]"), axis=1).max(), rtol=1e-9
        )
        moment = vector(found, "KMN", "mount_{} w1 [N m]")
        assert_allclose(values["moment"][j], np.sqrt(np.mean((moment**2).sum(axis=1))), rtol=1e-9)
        assert_allclose(values["tau"][j], np.abs(found["tau w2 [N m]"]).max(), rtol=1e-9)
        assert_allclose(values["speed"][j], found["phi_dot w2 [rad/s]"][-1], rtol=1e-9)
        assert_allclose(values["power"][j], np.mean(found["tau w2 [N m]"] * found["phi_dot w2 [rad/s]"]), rtol=1e-8)


def test_samples_begin_at_their_own_rest() -> None:
    """With all flywheels held nothing moves, however far the weight lets the carrier down."""
    wanted: dict[str, Keys] = {
        "moved": {"peak": "displacement", "at": "carrier"},
        "lift": {"mean": "force", "of": "suspension", "axis": "z"},
        "a": {"peak": "acceleration", "at": "carrier"},
    }
    own = computation(mahovik.example("bench8"), {"regime": {"default": {"hold": True}}, "until": "10 ms"}, wanted)
    tables = tables_of(
        own, {"carrier.mass": np.linspace(11, 13, N), "carrier.center_of_mass.0": np.linspace(0, 0.01, N)}
    )
    values, _ = own.values(tables)
    for j in range(N):
        stand = tables.stand(j)
        force = sum(body.mass for body in stand.bodies) * 9.81
        tilted = np.hypot(*rest(stand).state.quaternion[1:3])  # type: ignore[index]
        assert_allclose(values["lift"][j], force, rtol=max(1e-9, 4 * tilted**2))
    assert np.all(values["a"] < 1e-10)
    assert np.all(values["moved"] < 1e-13)


def test_a_sample_that_leaves_its_ranges_has_a_reason_and_the_others_have_numbers() -> None:
    """A stiffness beyond what the steps follow ends one sample only."""
    run = {"regime": {"default": {"speed": 100}}, "until": "20 ms", "start": {"position": [1e-3, 0, 0]}}
    own = computation(mahovik.example("bench8"), run, WANTED)
    stiff = np.array([1633.5, 1e12, 1700.0])
    values, reasons = own.values(tables_of(own, {"suspension.stiffness.0.0": stiff}))
    assert reasons[0] == reasons[2] == ""
    assert "returned" in reasons[1]
    assert reasons[1].startswith("at t = ")
    for column in values.values():
        assert np.isfinite(column).tolist() == [True, False, True]
    alone, _ = own.values(tables_of(own, {"suspension.stiffness.0.0": stiff[2:]}))
    for name, column in values.items():
        assert column[2] == alone[name][0], name


def test_a_sample_without_equilibrium_has_the_reason_of_rest() -> None:
    """So stiff that a rest is not found to 1e-12 m/s2: a reason, and numbers of the others."""
    own = computation(mahovik.example("bench8"), {"regime": {"default": {"hold": True}}, "until": "1 ms"}, WANTED)
    values, reasons = own.values(tables_of(own, {"suspension.stiffness.0.0": np.array([1633.5, 1e12])}))
    assert reasons[0] == ""
    assert reasons[1].startswith("bench8: no static equilibrium")
    assert np.isfinite(values["a"]).tolist() == [True, False]


def test_a_stand_without_equilibrium_needs_a_start() -> None:
    """Weight that nothing carries: no sample could begin, so the file is refused, with what to do."""
    stand = mahovik.example("bench8").replace({"suspension": None})
    with pytest.raises(mahovik.UsageError, match=r"^over: .*nothing carries a force.*give .* by `start`$"):
        computation(
            stand, {"regime": {"default": {"speed": 1}}, "until": 0.01}, {"a": {"peak": "rate", "at": "carrier"}}
        )


def test_constant_speeds_are_those_of_vibration() -> None:
    """RMS above 0 Hz and within a band, of all axes and of one."""
    speeds = {"rw1": "3000 rpm", "rw2": "-1500 rpm"}
    wanted: dict[str, Keys] = {
        "a": {"rms": "acceleration", "at": "acc1"},
        "low": {"rms": "acceleration", "at": "acc1", "band": ["20 Hz", "30 Hz"]},
        "y": {"rms": "acceleration", "at": "acc1", "axis": "y"},
        "turn": {"peak": "rotation", "at": "acc1"},
    }
    own = computation(mahovik.example("sat4"), {"speeds": speeds, "phases": {"rw2": "40 deg"}}, wanted)
    tables = tables_of(own, SATELLITE)
    values, reasons = own.values(tables)
    assert not any(reasons)
    stand = tables.stand(1)
    asked: dict[str, Any] = {"speed": speeds, "at": "acc1", "quantity": "acceleration", "phase": {"rw2": "40 deg"}}
    rms, low = (mahovik.vibration(stand, **asked, band=band)["rms"] for band in (None, (20.0, 30.0)))
    for name, wanted_rms in (("a", np.linalg.norm(rms)), ("low", np.linalg.norm(low)), ("y", rms[1])):
        assert_allclose(values[name][1], wanted_rms, rtol=1e-8)
    assert 0.0 < values["turn"][1] < 1e-5


def test_states_are_those_of_the_functions(tmp_path: Path) -> None:
    """The largest over two states, by the functions of the model of the sample's own stand."""
    lines = [
        '{"phi_dot": [100, 0, 0, 0]}',
        '{"phi_dot": [300, 50, 0, 0], "phi": [1, 2, 3, 4], "phi_ddot": [1, 2, 3, 4]}',
    ]
    (tmp_path / "s.jsonl").write_text("\n".join(lines), encoding="utf-8")
    wanted: dict[str, Keys] = {
        "tau": {"peak": "torque", "of": "rw1"},
        "force": {"peak": "specific_force", "at": "acc1"},
        "sigma": {"least": "sigma"},
        "mount": {"end": "force", "of": "rw2"},
    }
    own = computation(mahovik.example("sat4"), {"states": "s.jsonl"}, wanted, folder=tmp_path)
    tables = tables_of(own, SATELLITE)
    values, reasons = own.values(tables)
    assert not any(reasons)
    model = mahovik.build(tables.stand(1))
    x = model.states(phi=[[0, 0, 0, 0], [1, 2, 3, 4]], phi_dot=[[100, 0, 0, 0], [300, 50, 0, 0]])
    phi_ddot = np.array([[0, 0, 0, 0], [1, 2, 3, 4]])
    V_dot = model.forward(x, phi_ddot).V_dot
    assert_allclose(values["tau"][1], np.abs(model.torque(x, V_dot, phi_ddot).tau[:, 0]).max(), rtol=1e-13)
    force = model.points(x, V_dot).specific_force[:, 0]
    assert_allclose(values["force"][1], np.linalg.norm(force, axis=1).max(), rtol=1e-13)
    singular = np.linalg.svd(model.matrices(x).I, compute_uv=False)
    assert_allclose(values["sigma"][1], singular.min(), rtol=1e-10)
    mount = model.mounts(x, V_dot, phi_ddot).mount_wrench[1, 1, :3]
    assert_allclose(values["mount"][1], np.linalg.norm(mount), rtol=1e-13)


def shaker_files(folder: Path) -> None:
    """Programme, motion and servos of shaker2."""
    (folder / "p.json").write_text(programme_text(shaker()[2]), encoding="utf-8")
    spin = next(path for path in stands.motions("shaker2") if "spin" in path.name)
    (folder / "m.json").write_bytes(spin.read_bytes())
    (folder / "servo.toml").write_text(SERVO, encoding="utf-8")


ERRORS: dict[str, Keys] = {
    "share": {"peak": "error"},
    "z": {"rms": "error", "axis": "z"},
    "tau": {"peak": "torque", "of": "left"},
}


@pytest.mark.slow
def test_a_programme_with_servos_is_that_of_follow(tmp_path: Path) -> None:
    """The errors of `follow` on the stand that the programme was planned for, and larger ones on another."""
    shaker_files(tmp_path)
    run = {"programme": "p.json", "motion": "m.json", "servo": "servo.toml", "periods": 12}
    stand = mahovik.example("shaker2")
    own = computation(stand, run, ERRORS, folder=tmp_path)
    mass = stand.carrier.mass
    values, reasons = own.values(tables_of(own, {"carrier.mass": np.array([mass, 1.01 * mass])}))
    assert not any(reasons)
    files = {"motion": "m.json", "programme": "p.json", "servo": "servo.toml"}
    found = mahovik.simulate(stand, **{name: tmp_path / file for name, file in files.items()}, periods=12)
    assert values["share"][0] == found["error"]
    assert values["z"][0] == found["coordinates"]["rms"][2]
    assert values["tau"][0] == found["peak_torque"][0]
    assert values["share"][1] > 100 * values["share"][0]


def test_a_programme_of_another_stand_is_refused(tmp_path: Path) -> None:
    """Before anything is computed, by the programme's own identities."""
    shaker_files(tmp_path)
    with pytest.raises(mahovik.UsageError, match=r"^over: programme: p\.json: .*shaker2"):
        computation(mahovik.example("bench8"), {"programme": "p.json", "motion": "m.json"}, {"e": {"peak": "error"}},
                    folder=tmp_path)  # fmt: skip


def test_a_start_is_the_same_for_all_samples() -> None:
    """The state of `start` is that of `simulate --start`."""
    start = {"angles": [0.1, -0.2, 0.3], "V": [0, 0, 0, 0.1, 0.2, 0.3], "phi_dot": [10, 20, 30, 40]}
    regime = {"default": {"torque": "1e-3 N m"}}
    own = computation(
        mahovik.example("sat4"), {"regime": regime, "until": "10 ms", "start": start, "order": 2},
        {"rate": {"end": "rate", "at": "acc1"}, "s": {"end": "speed", "of": "rw3"}},
    )  # fmt: skip
    tables = tables_of(own, SATELLITE)
    values, _ = own.values(tables)
    found = columns(tables.stand(1), 0.01, regime=regime, start=start, order=2)
    assert_allclose(values["s"][1], found["phi_dot rw3 [rad/s]"][-1], rtol=1e-13)
    rate = np.linalg.norm(vector(found, "xyz", "gyro_{} acc1 [rad/s]"), axis=1)[-1]
    assert_allclose(values["rate"][1], rate, rtol=1e-13)
