"""Quantities over constant speeds, states and programmes are those of the commands for one stand."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose

import mahovik
from campaigns.sections import Keys, computation, tables_of
from control.following import SERVO
from mahovik import stands
from mahovik.core.motion.programme import programme_text
from verify.programme.programmes import shaker

N = 2
SATELLITE = {"rw1.unbalance.static": np.linspace(1e-6, 3e-6, N), "carrier.mass": np.linspace(50, 51, N)}


def test_constant_speeds_are_those_of_response() -> None:
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
    assert reasons == [""] * N
    stand = tables.stand(1)
    found = mahovik.response(stand, speeds, "acc1", band=(20.0, 30.0), phases={"rw2": "40 deg"})
    columns = {column.name: float(column.values[0]) for column in found.columns}
    for name, column in (("a", "rms xyz"), ("low", "band rms xyz"), ("y", "rms y")):
        assert_allclose(values[name][1], columns[column], rtol=1e-12)
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
    assert reasons == [""] * N
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
    assert reasons == [""] * N
    found = mahovik.follow(
        stand, tmp_path / "m.json", tmp_path / "p.json", tmp_path / "servo.toml", periods=12, causes=False
    )
    assert found.errors is not None
    assert values["share"][0] == found.errors.share
    assert values["z"][0] == found.errors.rms[2]
    assert values["tau"][0] == np.abs(found.record.tau[:, 0]).max()
    assert values["share"][1] > 100 * values["share"][0]


def test_a_programme_of_another_stand_is_refused(tmp_path: Path) -> None:
    """Before anything is computed, by the programme's own identities."""
    shaker_files(tmp_path)
    with pytest.raises(mahovik.UsageError, match=r"^over: programme: p\.json: .*shaker2"):
        computation(mahovik.example("bench8"), {"programme": "p.json", "motion": "m.json"}, {"e": {"peak": "error"}},
                    folder=tmp_path)  # fmt: skip
