"""Many steps under given speeds in one call of the C: the bits of as many calls of `step_driven`."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_array_equal
from numpy.typing import NDArray

import mahovik
from mahovik.out.api.compiled import ELEMENT, compiled
from mahovik.out.campaign.block import Block

N, COUNT, STEP = 11, 5, 1e-3


@pytest.mark.parametrize("pushed", [False, True])
def test_a_course_has_the_bits_of_its_steps(pushed: bool) -> None:
    """Speeds that vary, rest and begin again, with a run-time wrench or without one; samples that differ."""
    stand = mahovik.example("bench8")
    if pushed:
        stand = stand.replace({"carrier.wrench_input": True})
    rng, model = np.random.default_rng(1), mahovik.build(stand)
    tables = model.tables({"w1.unbalance.static": rng.uniform(1e-6, 1e-3, N)})
    made = compiled(stand, "double", ELEMENT["double"], None, parallel=False)
    speeds = np.cumsum(rng.normal(size=(COUNT + 1, 8)) * np.array([1, 1, 0, 0, 1, 0])[:, None], axis=0) + 50.0
    phases, mean = rng.normal(size=(COUNT + 1, 8)), np.diff(speeds, axis=0) / STEP
    wrenches = rng.normal(size=(COUNT, 6 if pushed else 0))

    block = Block(stand, made, tables, 0, N)
    x = model.states(N, V=rng.normal(size=(N, 6)) * 0.1, phi=phases[0], phi_dot=speeds[0])
    block.x[:] = x.array.T
    block.given["order"][0], block.given["dt"][0] = 2, STEP
    rows: dict[str, NDArray[Any]] = {
        "phi": phases, "phi_dot": speeds, "phi_ddot": mean, "wrench": wrenches, "count": np.array([COUNT], np.int32),
        "refused": np.zeros(N, np.int32), "status": np.zeros(N, np.int32),
    }  # fmt: skip
    assert block.course(rows)() == 0
    for k in range(COUNT):
        wrench = {"carrier": wrenches[k]} if pushed else None
        x = model.step_driven(x, STEP, mean[k], order=2, wrench=wrench, tables=tables)
        x.phi, x.phi_dot = np.tile(phases[k + 1], (N, 1)), np.tile(speeds[k + 1], (N, 1))
    assert_array_equal(block.x.T, x.array)


def test_a_refused_sample_is_named_with_its_first_step() -> None:
    """It stays as it was, and the others go on."""
    stand = mahovik.example("bench8")
    model = mahovik.build(stand)
    made = compiled(stand, "double", ELEMENT["double"], None, parallel=False)
    block = Block(stand, made, model.tables({}, 3), 0, 3)
    block.x[:] = model.states(3).array.T
    block.x[7, 1] = np.nan
    block.given["order"][0], block.given["dt"][0] = 2, STEP
    none = np.zeros((COUNT + 1, 8))
    rows: dict[str, NDArray[Any]] = {
        "phi": none, "phi_dot": none, "phi_ddot": none[1:], "wrench": np.zeros((COUNT, 0)),
        "count": np.array([COUNT], np.int32), "refused": np.full(3, -1, np.int32), "status": np.zeros(3, np.int32),
    }  # fmt: skip
    assert block.course(rows)() < 0
    assert (rows["status"] < 0).tolist() == [False, True, False]
    assert rows["refused"].tolist() == [-1, 0, -1]
    assert_array_equal(block.x[:, 0], block.x[:, 2])
