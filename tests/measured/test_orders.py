"""Orders against speed: amplitudes at their orders while the speed rises, at both senses, with missing samples."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mahovik.errors import InputError
from mahovik.use.measured import Channel, Recording
from mahovik.use.measured.orders import OrderMap, merge_maps, order_map
from mahovik.use.measured.recording import Array

T: Array = np.asarray(1e-3 * np.arange(10_000), dtype=np.float64)


def recording(phase: Array, values: Array) -> Recording:
    channels = (
        Channel("flywheel", "w1", "phase", "", "rad", phase),
        Channel("point", "acc1", "acceleration", "x", "m/s2", values),
    )
    return Recording(T, channels, "run.csv")


def orders_of(found: Recording, values: Array | None = None) -> OrderMap:
    return order_map(found, "w1", found.channels[1], values)


@settings(max_examples=10, deadline=None)
@given(st.floats(60, 120), st.floats(-2, 10), st.sampled_from([-1.0, 1.0]), st.integers(1, 6), st.floats(0, 6))
def test_an_order_has_its_amplitude_at_every_speed(
    speed: float, rise: float, sense: float, half: int, at: float
) -> None:
    """a cos(o phi + at) beside an offset; every fiftieth sample is missing."""
    phase = sense * (speed * T + 0.5 * rise * T**2)
    x = 3.0 + 0.7 * np.cos(0.5 * half * phase + at)
    x[::50] = np.nan
    found = orders_of(recording(phase, x))
    own = int(np.argmin(np.abs(found.orders - 0.5 * half)))
    assert found.orders[own] == pytest.approx(0.5 * half)
    assert found.amplitude[:, own] == pytest.approx(0.7, rel=0.02)
    far = np.abs(found.orders - 0.5 * half) > 0.3
    assert np.nanmax(found.amplitude[:, far]) < 0.03
    assert found.speed.min() >= min(speed, speed + 10 * rise) * 0.99
    assert found.speed.max() <= max(speed, speed + 10 * rise) * 1.01


def test_values_of_a_model_are_blank_where_data_is() -> None:
    x = np.cos(100.0 * T)
    x[:5000] = np.nan
    found = recording(100.0 * T, x)
    model = np.where(np.arange(len(T)) < 5000, 1e3, np.cos(100.0 * T))
    assert np.allclose(orders_of(found).amplitude, orders_of(found, model).amplitude, atol=1e-12)


def test_recordings_at_close_speeds_are_one_row() -> None:
    maps = [orders_of(recording(w * T, a * np.cos(w * T))) for w, a in ((100.0, 3.0), (100.1, 4.0), (200.0, 1.0))]
    found = merge_maps(maps)
    assert found.speed == pytest.approx([100.05, 200.0], rel=1e-3)
    first = found.amplitude[:, found.orders == 1.0][:, 0]
    assert first == pytest.approx([np.sqrt(12.5), 1.0], rel=0.01)


@pytest.mark.parametrize(("phase", "words"), [(0.5 * T, "turns with samples"), (np.full(len(T), np.nan), "0 turns")])
def test_few_turns_are_refused(phase: Array, words: str) -> None:
    with pytest.raises(InputError, match=words):
        orders_of(recording(phase, np.cos(T)))
    with pytest.raises(InputError, match="no phase of w2"):
        order_map(recording(T, T), "w2", recording(T, T).channels[1])
