"""Many steps under given speeds in one call of the C: the bits of as many calls of `step_driven`."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_array_equal
from numpy.typing import NDArray

import mahovik
from mahovik.out.api.compiled import ELEMENT, compile_library
from mahovik.out.campaign.block import Block

N, COUNT, STEP = 11, 5, 1e-3
Array = NDArray[Any]


@pytest.mark.slow
@pytest.mark.parametrize("pushed", [False, True])
def test_a_course_has_the_bits_of_its_steps(pushed: bool) -> None:
    """Speeds that vary, rest and begin again, with a run-time wrench or without one; samples that differ."""
    stand = mahovik.example("bench8")
    if pushed:
        stand = stand.replace({"carrier.wrench_input": True})
    rng, model = np.random.default_rng(1), mahovik.build(stand)
    tables = model.tables({"w1.unbalance.static": rng.uniform(1e-6, 1e-3, N)})
    made = compile_library(stand, "double", ELEMENT["double"], None, parallel=False)
    # a stretch of two steps, then one of three; the second begins where the first ends
    speeds = np.cumsum(rng.normal(size=(COUNT + 2, 8)) * np.array([1, 1, 0, 0, 0, 1, 0])[:, None], axis=0) + 50.0
    phases = rng.normal(size=(COUNT + 2, 8))
    phases[3], mean = phases[2], np.delete(np.diff(speeds, axis=0), 2, axis=0) / STEP
    wrenches = rng.normal(size=(COUNT, 6 if pushed else 0))

    block = Block(stand, made, tables, 0, N)
    x = model.states(N, V=rng.normal(size=(N, 6)) * 0.1, phi=phases[0], phi_dot=speeds[0])
    block.x[:] = x.array.T
    block.given["order"][0] = 2
    ends = rng.normal(size=(2, 8))
    rows = rows_of(phases, speeds, mean, wrenches, [2, 3], ends)
    kept = rows["kept"][0] = 13
    rows["states"], rows["V_dot"] = np.zeros((2, kept, N)), np.zeros((2, 6, N))
    assert block.course(rows)() == 0
    at = 0
    for k in range(COUNT):
        wrench = {"carrier": wrenches[k]} if pushed else None
        x = model.step_driven(x, STEP, mean[k], order=2, wrench=wrench, tables=tables)
        row = k + 1 + (k >= 2)
        x.phi, x.phi_dot = np.tile(phases[row], (N, 1)), np.tile(speeds[row], (N, 1))
        if k in (1, COUNT - 1):
            wrench = {"carrier": rows["end_wrench"][at]} if pushed else None
            assert_array_equal(rows["states"][at], x.array.T[:kept])
            assert_array_equal(rows["V_dot"][at].T, model.forward(x, ends[at], wrench=wrench, tables=tables).V_dot)
            at += 1
    assert_array_equal(block.x.T, x.array)


def rows_of(
    phases: Array, speeds: Array, mean: Array, wrenches: Array, counts: list[int], ends: Array
) -> dict[str, Array]:
    """Numbers of stretches with these counts of steps, as the C reads them; it keeps nothing."""
    n, rng = len(ends), np.random.default_rng(7)
    return {
        "phi": phases, "phi_dot": speeds, "phi_ddot": mean, "wrench": wrenches, "end_phi_ddot": ends,
        "end_wrench": rng.normal(size=(n, wrenches.shape[1])), "dt": np.full(n, STEP),
        "count": np.array(counts, np.int32), "stretches": np.array([n], np.int32), "kept": np.zeros(1, np.int32),
        "states": np.zeros((0, 0, 0)), "V_dot": np.zeros((0, 0, 0)), "refused": np.full(N, -1, np.int32),
        "status": np.zeros(N, np.int32),
    }  # fmt: skip


def test_a_refused_sample_is_named_with_its_first_step() -> None:
    """It stays as it was, and the others go on."""
    stand = mahovik.example("bench8")
    model = mahovik.build(stand)
    made = compile_library(stand, "double", ELEMENT["double"], None, parallel=False)
    block = Block(stand, made, model.tables({}, 3), 0, 3)
    block.x[:] = model.states(3).array.T
    block.x[7, 1] = np.nan
    block.given["order"][0] = 2
    none = np.zeros((COUNT + 1, 8))
    rows = rows_of(none, none, none[1:], np.zeros((COUNT, 0)), [COUNT], none[:1])
    rows["refused"], rows["status"] = rows["refused"][:3], rows["status"][:3]
    assert block.course(rows)() < 0
    assert (rows["status"] < 0).tolist() == [False, True, False]
    assert rows["refused"].tolist() == [-1, 0, -1]
    assert_array_equal(block.x[:, 0], block.x[:, 2])
