"""Random models: the stand has the dynamics that Pinocchio and MuJoCo find in the file."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from foreign.drawn import mjcf, random_bodies, urdf
from mahovik.out.foreign.agreement import MujocoOriginal, PinocchioOriginal, agreement
from mahovik.out.foreign.merge import make_stand
from mahovik.out.foreign.mjcf import compile_model, read_mjcf
from mahovik.out.foreign.urdf import read_urdf
from mahovik.out.foreign.write import stand_file

SEEDS = [*range(4), *(pytest.param(seed, marks=pytest.mark.slow) for seed in range(4, 60))]


def options(rng: np.random.Generator, fixed: int) -> dict[str, Any]:
    """Any fixed body as the carrier, instruments or not."""
    return {"carrier": f"b{rng.integers(fixed + 1)}", "instruments": bool(rng.integers(2))}


@pytest.mark.parametrize("seed", SEEDS)
def test_urdf(seed: int, tmp_path: Path) -> None:
    rng = np.random.default_rng(seed)
    fixed, turning = int(rng.integers(5)), int(rng.integers(1, 6))
    path = tmp_path / "drawn.urdf"
    path.write_text(urdf(random_bodies(rng, fixed, turning)))
    found = make_stand(read_urdf(path), "drawn", path.name, gravity=rng.normal(size=3) * 9, **options(rng, fixed))
    stand_file(found, path.name, "")
    errors = agreement(found, PinocchioOriginal(path, found, False), 5, seed)
    assert len(found.stand.flywheels) == turning
    assert max(errors.values()) < 1e-11, errors
    assert max(errors[name] for name in ("K", "I", "bias", "tau")) < 1e-13, errors


@pytest.mark.parametrize("seed", SEEDS)
def test_mjcf(seed: int, tmp_path: Path) -> None:
    rng = np.random.default_rng(1000 + seed)
    fixed, turning = int(rng.integers(5)), int(rng.integers(1, 6))
    path = tmp_path / "drawn.xml"
    path.write_text(mjcf(random_bodies(rng, fixed, turning), rng))
    found = make_stand(read_mjcf(path), "drawn", path.name, **options(rng, fixed))
    stand_file(found, path.name, "")
    errors = agreement(found, MujocoOriginal(compile_model(path), found, True), 5, seed)
    assert len(found.stand.flywheels) == turning
    assert max(errors.values()) < 1e-11, errors
    assert max(errors[name] for name in ("K", "I", "bias", "tau")) < 1e-12, errors
