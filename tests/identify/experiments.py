"""An experiment whose errors are predicted, and the estimate from data made of it."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from mahovik.core.motion.programme.regime import programme_regime
from mahovik.out.api.model import build
from mahovik.out.api.stands import Stand
from mahovik.out.identify.channels import Channel
from mahovik.out.identify.estimate import estimate
from mahovik.out.identify.excite.bounds import bounds_of
from mahovik.out.identify.excite.course import Courses
from mahovik.out.identify.excite.information import Experiment
from mahovik.out.identify.free import Free
from mahovik.out.identify.predict import Predictor
from mahovik.out.identify.run import Run

LOW, HIGH, STEEP = 40.0, 100.0, 90.0
"""Bounds of speed, rad/s, and acceleration, rad/s2."""


def check_predicted_errors(
    stand: Stand, keys: Sequence[str], channels: Sequence[Channel], noise: NDArray[np.float64]
) -> None:
    """An estimate from data with this noise, SI by channel, states the covariance that was predicted."""
    free, rng, rate = Free(build(stand), list(keys)), np.random.default_rng(4), 500.0
    own = Courses(stand, bounds_of(stand, HIGH, LOW, STEEP, None, 1.0), 1.0, 2)
    programme = own.programme(rng.uniform(size=(2, 5)))
    predicted = Experiment(stand, free, channels, noise, rate, HIGH).quality(programme, fine=True)
    predictor = Predictor(stand, programme_regime(programme), channels, 0.0, 1 / rate, 501)
    exact = predictor(build(stand).tables({}, 1))[:, :, 0]
    measured = exact + noise * rng.normal(size=exact.shape)
    places = np.repeat(np.arange(501.0)[:, None], len(channels), axis=1)
    found = estimate(free, [Run("made", predictor, measured, places, 1.0)])
    errors = np.sqrt(np.diag(found.covariance))
    assert np.allclose(np.sqrt(np.diag(predicted.covariance)), errors, rtol=0.1)
    assert (np.abs(found.theta - free.nominal) < 5 * errors).all()
