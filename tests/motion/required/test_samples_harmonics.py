"""Harmonics of sampled motions are those of the motion, not the images that a spline makes of them."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from mahovik import stands
from mahovik.core.motion.required import load_motion
from mahovik.core.stand import load
from mahovik.errors import MotionError

STAND = load(stands.path("bench8"))
EXACT = load_motion(stands.motions("bench8")[0], STAND)


def sampled(folder: Path, count: int, share: float = 1.0) -> Path:
    """bench8's motion by samples, over a share of its period."""
    given: dict[str, Any] = json.loads(stands.motions("bench8")[0].read_text(encoding="utf-8"))
    del given["harmonics"]
    t = share * EXACT.span * np.arange(count) / count
    given |= {"units": {}, "samples": {"t": t.tolist(), "q": (EXACT.at(t).q - EXACT.mean).tolist()}}
    path = folder / "m.json"
    path.write_text(json.dumps(given), encoding="utf-8")
    return path


@pytest.mark.parametrize("count", [16, 24, 31, 32, 64])
def test_the_images_of_a_spline_are_no_harmonics(count: int, tmp_path: Path) -> None:
    assert load_motion(sampled(tmp_path, count), STAND).harmonics == EXACT.harmonics == (1,)


def test_samples_of_a_part_of_the_period_are_refused(tmp_path: Path) -> None:
    with pytest.raises(MotionError, match="is it the period of these samples"):
        load_motion(sampled(tmp_path, 32, 0.5), STAND)
