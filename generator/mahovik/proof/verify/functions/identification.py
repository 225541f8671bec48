"""Judge of `identify_step`: its factored steps against the literal covariance form, from random estimates."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from mahovik.core.stand.state import State
from mahovik.errors import StateError
from mahovik.proof.reference.array import Array
from mahovik.proof.reference.regressor import Estimate, identify_step, slopes
from mahovik.proof.verify.check import Check
from mahovik.proof.verify.functions.case import Case
from mahovik.proof.verify.scales import scales

DEVIATION = 1e-3
"""kg m: standard deviation of the unbalances before the sample."""

NOISE = 0.1
"""Part of what the unbalances make of a channel that is noise: the sample tells much, but not all."""

FORGET = 0.1

ERRORS = 256
"""Roundings that both may make: six channels, each of which leaves a hundredth of what it sees."""


def identification_rows(case: Case) -> Iterator[Check]:
    """Unbalances and covariance after one sample."""
    tolerance = ERRORS * case.unit
    rows = {name: Check("identify_step", name, tolerance) for name in ("unbalance", "covariance")}
    for number, (name, state) in enumerate(case.states):
        before, given = random_estimate(case.random(number), 2 * case.count, case)
        H = slopes(case.stand, state)
        noise = case.nearest_numbers(NOISE * np.sqrt(np.diag(H @ before.covariance @ H.T)))
        inputs = {**case.backend.arguments(state), "noise": noise.tolist(), "forget": FORGET, "estimate": given}
        try:
            found = case.call("identify_step", inputs)["estimate"]
        except StateError as error:
            for row in rows.values():
                row.refuse(error, name)
            continue
        _note(rows, case, name, state, noise, before, found)
    for row in rows.values():
        yield row


def _note(
    rows: dict[str, Check], case: Case, name: str, state: State, noise: Array, before: Estimate, found: Any
) -> None:
    after, sample = identify_step(case.stand, state, noise, FORGET, before)
    natural = scales(case.stand, state, case.at(state), "forward", case.bounds.cuts)["V_dot"]
    size = np.abs(state.V_dot) + natural + np.abs(sample.slopes) @ np.abs(before.unbalance)
    scale = np.abs(before.unbalance) + np.abs(sample.gain) @ size
    rows["unbalance"].compare(np.array(found["unbalance"], dtype=np.float64), after.unbalance, scale, name)
    deviation = np.sqrt(np.diag(before.covariance))
    rows["covariance"].compare(covariance(found), after.covariance, np.outer(deviation, deviation), name)


def random_estimate(rng: np.random.Generator, n: int, case: Case) -> tuple[Estimate, dict[str, Any]]:
    """An estimate with its covariance, and as the C takes it."""
    given = {
        "unbalance": case.nearest_numbers(DEVIATION * rng.normal(size=n)).tolist(),
        "variance": case.nearest_numbers(DEVIATION**2 * rng.uniform(0.5, 1.5, n)).tolist(),
        "factor": case.nearest_numbers(0.3 * rng.normal(size=n * (n - 1) // 2)).tolist(),
        "largest": 1.0,
    }
    return Estimate(np.array(given["unbalance"]), covariance(given)), given


def covariance(estimate: Any) -> Array:
    """U D U^T of an estimate of the C."""
    variance = np.array(estimate["variance"], dtype=np.float64)
    U = np.eye(len(variance))
    rows, columns = np.tril_indices(len(variance), -1)  # column by column above the diagonal
    U[columns, rows] = np.array(estimate["factor"], dtype=np.float64)
    return np.asarray((U * variance) @ U.T)
