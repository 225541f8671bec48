"""Files of any format and unit are read back in SI."""

from __future__ import annotations

from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
import pandas as pd
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mahovik.errors import DataError
from mahovik.use.measured.clocks import Recording
from mahovik.use.measured.headers import HeaderError, channel_of
from mahovik.use.measured.read import read_recordings
from measured.stand_of_tests import STAND, clock, read_one, values, write_csv

UNITS = {
    "acceleration.x": {"m/s2": 1.0, "m/s^2": 1.0, "mm/s²": 1e-3, "g": 9.80665, "mg": 9.80665e-3, "cm/s^2": 1e-2},
    "rate.z": {"rad/s": 1.0, "deg/s": np.pi / 180, "rpm": np.pi / 30, "mrad/s": 1e-3},
}
WHEEL_UNITS = {
    "phase": {"rad": 1.0, "deg": np.pi / 180, "turn": 2 * np.pi},
    "speed": {"rad/s": 1.0, "rpm": np.pi / 30, "deg/s": np.pi / 180},
    "torque": {"N m": 1.0, "mN m": 1e-3, "mNm": 1e-3, "N cm": 1e-2},
}


@st.composite
def columns(draw: st.DrawFn) -> dict[str, tuple[str, float]]:
    """Labels of some channels, each with a unit and its size in SI."""
    known = {f"{name}.{q}": units for name in ("acc1", "acc2", "gyro") for q, units in UNITS.items()}
    known |= {f"{name}.{q}": units for name in ("w1", "w2") for q, units in WHEEL_UNITS.items()}
    labels = draw(st.lists(st.sampled_from(sorted(known)), min_size=1, max_size=6, unique=True))
    return {label: draw(st.sampled_from(sorted(known[label].items()))) for label in labels}


@settings(max_examples=25)
@given(
    columns(),
    st.sampled_from([("s", 1.0), ("ms", 1e-3), ("us", 1e-6)]),
    st.sampled_from([".csv", ".parquet", "frame", "frame by time"]),
    st.data(),
)
def test_what_is_written_is_read(
    chosen: dict[str, tuple[str, float]], time: tuple[str, float], form: str, data: st.DataObject
) -> None:
    """CSV, Parquet and frames give back any channels, in any unit of the right kind and any order."""
    seed = data.draw(st.integers(0, 2**32 - 1))
    made = {label: 0.3 * np.random.default_rng(seed + k).uniform(-1, 1, 60) for k, label in enumerate(chosen)}
    t = clock(60)
    table = {f"{label} [{unit}]": made[label] / size for label, (unit, size) in chosen.items()}
    table = {f"time [{time[0]}]": t / time[1], **table}
    with TemporaryDirectory() as folder:
        path = Path(folder) / f"data{form}"
        frame, source = pd.DataFrame(table), path if form.startswith(".") else pd.DataFrame()
        if form == ".csv":
            write_csv(path, table)
        elif form == ".parquet":
            frame.to_parquet(path)
        else:
            source = frame.set_index(frame.columns[0]) if form == "frame by time" else frame
        (recording,) = read_recordings([source], STAND)
    np.testing.assert_allclose(recording.t, t, rtol=1e-12, atol=1e-15)
    assert set(recording.frame) == set(chosen)
    for label in recording.frame:
        np.testing.assert_allclose(values(recording, label), made[label], rtol=1e-12)


@pytest.mark.parametrize("delimiter", [";", "\t"])
def test_decimal_commas_after_whole_numbers(tmp_path: Path, delimiter: str) -> None:
    """The first line has no decimal comma, so that the other lines decide."""
    path = tmp_path / "data.csv"
    rows = "\n".join([f"0{delimiter}0", *(f"0,{k:03d}{delimiter}{k},5" for k in range(1, 20))])
    path.write_text(f"time [s]{delimiter}acc1.rate.x [rad/s]\n{rows}\n", encoding="utf-8")
    (recording,) = read_recordings([path], STAND)
    assert recording.notes == ()
    np.testing.assert_allclose(recording.t, 1e-3 * np.arange(20))
    np.testing.assert_allclose(values(recording, "acc1.rate.x"), [0.0, *(np.arange(1, 20) + 0.5)])


CHANNELS = {
    "acc3.rate.x [rad/s]": 'no point, instrument or flywheel "acc3", did you mean "acc1"?',
    "acc1.accelration.x [m/s2]": 'did you mean "acceleration.x"?',
    "acc1.rate.q [rad/s]": 'acc1 has no "rate.q"',
    "acc1.rate.x [m/s2]": "expected an angular speed",
    "acc1.rate.x": "has no unit",
    "w1.speed [Hz]": "write rpm or rad/s",
    "w1.count [rad]": "expected [1] or, of a count, [1/4096 turn]",
    "hold.reaction.x [N]": "the carrier is free",
    "carrier.rate.x [rad/s]": "name a [[point]]",
    "[rad/s]": "expected a name and a unit",
}


@pytest.mark.parametrize("header", CHANNELS)
def test_a_channel_that_cannot_be_used_is_one_line(tmp_path: Path, header: str) -> None:
    """It is left out while another channel is there, and refused if none is."""
    with pytest.raises(HeaderError) as error:
        channel_of(header, STAND)
    assert CHANNELS[header] in str(error.value)
    t = clock()
    recording = read_one(tmp_path / "data.csv", {"time [s]": t, "acc1.rate.z [rad/s]": np.sin(t), header: t})
    assert list(recording.frame) == ["acc1.rate.z"]
    assert len([note for note in recording.notes if CHANNELS[header] in note]) == 1
    with pytest.raises(DataError, match="no channel of the stand bench is left") as refused:
        read_one(tmp_path / "data.csv", {"time [s]": t, header: t})
    assert CHANNELS[header] in str(refused.value)


FILES = {
    "a.txt": (b"time", 'unknown format ".txt"'),
    "a.csv": (b"", "expected a line of headers"),
    "b.csv": (b"time [s],time [s]\n1,2\n", "stands twice"),
    "c.csv": (b"time [s],acc1.rate.x [rad/s]\nx\ny\n", "2 cells hold no number"),
    "d.csv": (b"acc1.rate.x [rad/s]\n1\n2\n", "no column of time"),
    "e.csv": (b"time [kg],acc1.rate.x [rad/s]\n1,2\n2,3\n", "expected a time"),
    "f.csv": (b"time [s],acc1.rate.x [rad/s]\n1,2\n2,3\n", "2 samples, expected 4 or more"),
    "g.csv": (b"a\0b\n1\n", "zero bytes"),
    "a.parquet": (b"PAR1", "cannot be read as Parquet"),
}


@pytest.mark.parametrize("name", FILES)
def test_a_file_that_cannot_be_read_is_one_line(tmp_path: Path, name: str) -> None:
    """It names the file, what was found and what was expected."""
    content, said = FILES[name]
    path = tmp_path / name
    path.write_bytes(content)
    with pytest.raises(DataError) as error:
        read_recordings([path], STAND)
    assert said in str(error.value)
    assert all(len(line) < 400 for line in error.value.problems)
    with pytest.raises(DataError, match=r"gone\.csv: no such file"):
        read_recordings([tmp_path / "gone.csv"], STAND)


@settings(max_examples=30)
@given(st.binary(max_size=300), st.sampled_from([".csv", ".parquet"]))
def test_arbitrary_bytes(content: bytes, form: str) -> None:
    """They are refused in words, never by another error."""
    head = b"time [s],acc1.rate.x [rad/s]\n" if form == ".csv" else b""
    with TemporaryDirectory() as folder:
        path = Path(folder) / f"data{form}"
        path.write_bytes(head + content)
        try:
            recordings: tuple[Recording, ...] = read_recordings([path], STAND)
        except DataError as error:
            assert error.problems
        else:
            assert recordings


def test_a_run_of_simulate_is_data(tmp_path: Path) -> None:
    """Readings, phases, speeds and torques are read; columns that no sensor can measure are left out."""
    columns = {
        "t [s]": clock(),
        **{name: np.full(400, 1.0) for name in ("x [m]", "qw", "v_x [m/s]", "omega_x [rad/s]", "phi_ddot w1 [rad/s2]")},
        "force_y acc1 [m/s2]": np.sin(clock()),
        "gyro_z acc2 [rad/s]": np.cos(clock()),
        "phi w1 [rad]": 50.0 * clock(),
        "phi_dot w1 [rad/s]": 50.0 + clock(),
        "tau w2 [N m]": 0.1 * clock(),
    }
    recording = read_one(tmp_path / "run.csv", columns)
    assert list(recording.frame) == [
        "acc1.acceleration.y", "acc2.rate.z", "w1.phase", "w1.speed", "w2.torque",
    ]  # fmt: skip
    assert np.array_equal(values(recording, "acc1.acceleration.y"), np.sin(clock()))
    assert len(recording.notes) == 1
    assert "run of mahovik simulate" in recording.notes[0]
    added = {"hold.force.x [N]": clock(), "acc1.acceleration.x [m/s2]": clock(), "load cell": clock()}
    recording = read_one(tmp_path / "more.csv", columns | added)
    assert "hold.force.x" in recording.notes[1]
    assert "acc1.acceleration.x" in recording.frame
