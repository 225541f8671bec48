"""Band RMS of samples: sines of known size, in and out of the band."""

from __future__ import annotations

import numpy as np
import pytest

from mahovik.use.study.quiet.simulation import band_rms, line_amplitude

EVERY = 1e-3
T = EVERY * np.arange(4000)
SINES = np.column_stack([3.0 * np.sin(2 * np.pi * 50.3 * T + 1.0), 4.0 * np.cos(2 * np.pi * 50.3 * T)])


def test_rms_of_a_line_in_the_band() -> None:
    """Root of the sum over axes; a drift below the band is not heard."""
    drift = np.column_stack([1.0 + 5.0 * T, 0.1 * T])
    assert band_rms(SINES + drift, EVERY, (20.0, 200.0), 0) == pytest.approx(5.0 / np.sqrt(2.0), rel=1e-6)
    assert line_amplitude(SINES + drift, EVERY, 50.3, 0) == pytest.approx(5.0, rel=1e-5)


def test_integrals_divide_by_frequency() -> None:
    """Twice: a displacement."""
    omega = 2 * np.pi * 50.3
    assert band_rms(SINES, EVERY, (20.0, 200.0), 2) == pytest.approx(5.0 / np.sqrt(2.0) / omega**2, rel=1e-3)


def test_a_line_outside_is_not_heard() -> None:
    """A lobe beside the band's end: 90 dB less."""
    assert band_rms(SINES, EVERY, (52.0, 200.0), 0) < 5.0 * 10 ** (-90 / 20)
