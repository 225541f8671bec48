"""Faults of measured data, each told in one line and corrected where that is safe."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.interpolate import make_interp_spline

from mahovik.use.measured.clocks import Array, Recording, clock_offset, find_pulses, modulus_of, phase_of, unwrap
from mahovik.use.measured.read import read_recordings
from measured.stand_of_tests import STAND, clock, read_one, values, write_csv

RATE = "acc1.rate.x [rad/s]"
TURN = 2.0 * np.pi


def wobble(t: Array) -> Array:
    """A signal that changes with every sample."""
    return np.asarray(np.sin(37.0 * t) + 0.3 * np.cos(211.0 * t))


def lines(recording: Recording, text: str) -> list[str]:
    """Notes with a text."""
    return [note for note in recording.notes if text in note]


def test_a_clean_file_has_no_notes(tmp_path: Path) -> None:
    """Nothing is reported where nothing is wrong."""
    t = clock()
    recording = read_one(tmp_path / "a.csv", {"time [s]": t, RATE: wobble(t), "w1.speed [rad/s]": 100 + t})
    assert recording.notes == ()
    assert np.isfinite(recording.frame).all(axis=None)


def test_gaps(tmp_path: Path) -> None:
    """Gaps are reported with the longest and its place, and not filled."""
    t = np.delete(clock(), np.r_[50:53, 200:300])
    recording = read_one(tmp_path / "a.csv", {"time [s]": t, RATE: wobble(t)})
    (line,) = lines(recording, "gap")
    assert "2 gaps in time, the longest of 0.101 s at t = 0.199 s" in line
    np.testing.assert_array_equal(recording.t, t)


def test_times_out_of_order_and_repeated(tmp_path: Path) -> None:
    """Samples are sorted by time; of equal times the first is kept."""
    t = clock(100)
    order = np.arange(100)
    order[[10, 11]] = order[[11, 10]]
    order = np.insert(order, 40, 39)
    x = wobble(t)
    recording = read_one(tmp_path / "a.csv", {"time [s]": t[order], RATE: x[order]})
    np.testing.assert_array_equal(recording.t, t)
    np.testing.assert_array_equal(values(recording, "acc1.rate.x"), x)
    assert lines(recording, "out of order at 1 place: sorted")
    assert lines(recording, "1 repeated time")


def test_missing_and_stuck_samples(tmp_path: Path) -> None:
    """Missing samples become NaN, also where a value repeats in a channel that changes elsewhere."""
    t, x = clock(), wobble(clock())
    x[[5, 6]] = np.nan
    x[9] = np.inf
    x[100:130] = x[100]
    recording = read_one(tmp_path / "a.csv", {"time [s]": t, RATE: x, "acc2.rate.x [rad/s]": wobble(t)})
    missing = np.flatnonzero(np.isnan(values(recording, "acc1.rate.x")))
    np.testing.assert_array_equal(missing, [5, 6, 9, *range(101, 130)])
    assert lines(recording, "acc1.rate.x: 3 samples of 400 missing")
    assert lines(recording, "29 samples repeat the one before, first at t = 0.101 s")
    assert not lines(recording, "acc2")


@given(
    modulus=st.sampled_from([4096, 1 << 16, 1 << 32]),
    signed=st.booleans(),
    speed=st.floats(-0.45, 0.45),
    start=st.integers(-(10**6), 10**6),
)
def test_wrapped_counters_go_on(modulus: int, signed: bool, speed: float, start: int) -> None:
    """A register of any size, signed or not, may move by nearly half of its modulus between two samples."""
    true = np.round(start + speed * modulus * np.arange(200.0))
    low = -modulus // 2 if signed else 0
    read = (true - low) % modulus + low
    recognised = modulus_of(read, 4096)
    if recognised is None:
        np.testing.assert_array_equal(np.diff(read), np.diff(true))
        return
    if np.ptp(true) > modulus:
        assert recognised == modulus
    whole, _, unsure = unwrap(read, recognised)
    if recognised == modulus:
        np.testing.assert_array_equal(np.diff(whole), np.diff(true))
        assert (unsure > 0) == (abs(speed) > 0.401) or 0.399 < abs(speed) < 0.401


def test_a_speed_tells_whole_turns_between_samples(tmp_path: Path) -> None:
    """Seven tenths of a turn between samples are not three tenths backwards."""
    t = clock(200)
    phase = 0.7 * TURN * 1e3 * t
    columns = {"time [s]": t, "w1.phase [rad]": phase % TURN}
    alone = read_one(tmp_path / "a.csv", columns)
    assert values(alone, "w1.phase")[-1] < 0
    told = read_one(tmp_path / "b.csv", {**columns, "w1.speed [rad/s]": np.gradient(phase, t)})
    np.testing.assert_allclose(values(told, "w1.phase"), phase, atol=1e-9)


@pytest.mark.parametrize("header", ["w1.count", "w1.count [1]", "w1.count [1/4096 turn]"])
def test_counts_are_phases(tmp_path: Path, header: str) -> None:
    """Counts per turn and zero are those of the stand's encoder; counts wrap at a turn."""
    t = clock()
    phase = 300 * t
    counts = np.floor(phase / TURN * 4096) + 10
    recording = read_one(tmp_path / "a.csv", {"time [s]": t, header: counts % 4096})
    np.testing.assert_allclose(values(recording, "w1.phase"), phase, atol=1.01 * TURN / 4096)
    (line,) = recording.notes
    assert "wraps at 4096 counts, 19 times: unwrapped" in line


def test_counts_without_counts_a_turn_are_left_out(tmp_path: Path) -> None:
    """The stand file has no encoder for this wheel."""
    t = clock(2000)
    columns = {"time [s]": t, "w2.count": np.floor(200 * t / TURN * 500), "acc1.rate.x [rad/s]": wobble(t)}
    recording = read_one(tmp_path / "a.csv", columns)
    assert lines(recording, "w2.count: counts a turn are not known") and recording.get("w2.phase") is None


@given(st.floats(20.0, 300.0), st.floats(-30.0, 30.0), st.floats(0.0, 1.0), st.booleans())
def test_pulses_are_a_phase(speed: float, acceleration: float, at: float, analogue: bool) -> None:
    """The phase of a wheel of changing speed is right up to the step of time and a constant."""
    t = clock(4000)
    phase = speed * t + 0.5 * acceleration * t**2
    if (speed + acceleration * t).min() < 20.0:
        return
    turn = (phase / TURN + at) % 1.0
    signal = np.exp(-(((turn - 0.5) / 0.1) ** 2)) if analogue else (turn < 0.3).astype(float)
    pulses = find_pulses(t, signal)
    assert pulses is not None
    assert (pulses.double, pulses.lost) == (0, 0)
    course = phase_of(pulses, t, 1.0)
    inside = np.isfinite(course)
    error = (course - phase)[inside]
    # bend of the phase between two pulses, besides the place of a pulse in a step of time
    bend = abs(acceleration) * (TURN / (speed + acceleration * t).min()) ** 2 / 8
    assert np.ptp(error) < 2.2e-3 * (speed + abs(acceleration) * 4) + 2 * bend


@pytest.mark.parametrize("spike", [50.0, -50.0])
def test_a_spike_is_no_pulse(spike: float) -> None:
    """Pulses of a noisy tacho are the same with a spike between two of them; short ones of two levels are found."""
    t = clock(1000)
    noise = 0.02 * np.random.default_rng(1).standard_normal(len(t))
    signal = (20.0 * t % 1.0 < 0.3) + noise
    clean = find_pulses(t, signal)
    signal[540] = spike
    times = find_pulses(t, signal)
    assert clean is not None and times is not None
    assert (times.double, times.lost) == (0, 0)
    np.testing.assert_allclose(times.times, clean.times, atol=1e-4)
    short = find_pulses(clock(9000), np.isin(np.arange(9000), [1000, 3000, 5000, 7000]).astype(float))
    assert short is not None and len(short.times) == 4


def test_lost_and_double_pulses(tmp_path: Path) -> None:
    """A lost pulse counts as a turn, a double one is left out."""
    t = clock(3000)
    phase = 100 * t
    turns, angle = np.divmod(phase, TURN)
    good = angle < 1.0
    signal = good & (turns != 20) & (turns != 31)
    signal |= (turns == 10) & (angle > 1.6) & (angle < 2.0)
    recording = read_one(tmp_path / "a.csv", {"time [s]": t, "w2.tacho": signal.astype(float)})
    assert lines(recording, "1 double pulse left out")
    assert lines(recording, "2 lost pulses counted")
    error = values(recording, "w2.phase") - phase
    assert np.nanmax(error) - np.nanmin(error) < 0.25


@given(st.floats(-0.5, 0.5), st.integers(0, 2**32 - 1))
def test_the_offset_of_a_clock_is_found(offset: float, seed: int) -> None:
    """The offset is right to a fifth of a step, from a signal that does not repeat, with noise on both sides."""
    rng = np.random.default_rng(seed)
    t = clock(3000)
    parts = [(rng.uniform(2, 40), rng.uniform(0, TURN), rng.uniform(0.3, 1)) for _ in range(12)]

    def signal(time: Array) -> Array:
        chirp = np.sin(20 * time + 15 * time**2)
        return np.asarray(chirp + sum(a * np.sin(w * time + p) for w, p, a in parts))

    other = t[::2] - offset  # the second clock shows less by the offset
    noise = [0.1 * rng.normal(size=len(x)) for x in (t, other)]
    estimate = clock_offset(t, signal(t) + noise[0], other, signal(t[::2]) + noise[1])
    assert estimate is not None
    if estimate.safe:
        assert abs(estimate.seconds - offset) < 4e-4


def test_two_files_of_one_run(tmp_path: Path) -> None:
    """The offset of two loggers comes from their common channel; flywheels get the times of the sensors."""
    t = clock(4000)
    speed = 200 + 20 * np.sin(3 * t) + 10 * np.sin(17 * t**1.3)
    rate = wobble(t)
    slow = slice(None, None, 5)
    a = write_csv(tmp_path / "a.csv", {"time [s]": t, RATE: rate, "w1.speed [rad/s]": speed})
    columns = {"time [s]": t[slow] + 0.25, "w1.speed [rad/s]": speed[slow], "w2.speed [rad/s]": -speed[slow]}
    b = write_csv(tmp_path / "b.csv", columns)
    (recording,) = read_recordings([a, b], STAND)
    assert lines(recording, "0.25 s ahead by w1.speed: corrected")
    other = values(recording, "w2.speed")
    assert np.isfinite(other).mean() > 0.99
    np.testing.assert_allclose(other[np.isfinite(other)], -speed[np.isfinite(other)], atol=0.05)
    np.testing.assert_array_equal(values(recording, "acc1.rate.x"), rate)


def test_two_files_without_a_common_channel(tmp_path: Path) -> None:
    """Their clocks are taken as equal, and that is said; a channel without a sample is left out."""
    t = clock()
    a = write_csv(tmp_path / "a.csv", {"time [s]": t, RATE: wobble(t), "acc2.rate.x [rad/s]": np.nan * t})
    b = write_csv(tmp_path / "b.csv", {"time [s]": t[::4], "w1.phase [rad]": 50 * t[::4] ** 2})
    (recording,) = read_recordings([a, b], STAND)
    assert lines(recording, "no channel is in both that shows an offset: taken as equal")
    assert lines(recording, "acc2.rate.x: no sample: left out")
    inside = recording.t <= t[::4][-1]
    np.testing.assert_allclose(values(recording, "w1.phase")[inside], (50 * t**2)[inside], atol=1e-9)
    assert np.isnan(values(recording, "w1.phase")[~inside]).all()


def test_a_second_clock_that_runs_fast(tmp_path: Path) -> None:
    """Phases of another file are those of the sensors' clock within a hundredth of a turn."""
    t = clock(10_000)
    speed = 100.0 + make_interp_spline(np.arange(0.0, 10.1, 0.05), np.random.default_rng(4).normal(size=202), k=3)(t)
    a = write_csv(tmp_path / "a.csv", {"time [s]": t, RATE: wobble(t), "w1.speed [rad/s]": speed})
    other = {"time [s]": t * (1 + 5e-4), "w1.speed [rad/s]": speed, "w2.phase [rad]": 100.0 * t}
    (recording,) = read_recordings([a, write_csv(tmp_path / "b.csv", other)], STAND)
    assert lines(recording, "ppm fast by w1.speed: corrected")
    error = values(recording, "w2.phase") - 100.0 * t
    assert np.isfinite(error).mean() > 0.99 and np.nanmax(np.abs(error)) < 0.01 * TURN


def test_files_of_several_runs_go_in_pairs(tmp_path: Path) -> None:
    """The k-th file of sensors is joined with the k-th of flywheels."""
    t = clock()
    paths = [write_csv(tmp_path / f"imu{k}.csv", {"time [s]": t, RATE: k + wobble(t)}) for k in (1, 2)]
    paths += [write_csv(tmp_path / f"w{k}.csv", {"time [s]": t, "w1.speed [rad/s]": 0 * t + k}) for k in (1, 2)]
    recordings = read_recordings(paths, STAND)
    assert [float(values(run, "w1.speed")[0]) for run in recordings] == [1.0, 2.0]
    assert [round(float(values(run, "acc1.rate.x")[0])) for run in recordings] == [1, 2]
