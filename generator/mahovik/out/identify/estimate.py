"""Least squares of free numbers over runs: Gauss-Newton in a trust region, with exact model and weighted channels.

Unknown besides the free numbers are the initial state of each run and a constant offset of each channel; offsets are
eliminated by centring. Weak priors of PRIOR natural sizes keep what no channel tells at its value in the stand file.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import least_squares

from mahovik.errors import StandError, StateError, UsageError
from mahovik.out.functions.notices import OnProgress, Progress, tell
from mahovik.out.identify.free import Free
from mahovik.out.identify.jacobian import START_SCALE, slopes, values
from mahovik.out.identify.predict import START
from mahovik.out.identify.run import Run, noise_of

Array = NDArray[np.float64]
Loss = Literal["linear", "soft_l1", "huber"]

PRIOR = 100.0
"""Standard deviation of the priors of free numbers, in natural sizes."""

PRIOR_START = 10.0
"""The same of initial states."""

LINEAR = 0.02
"""A jacobian is kept while its prediction of a change of residuals is as good as this share of the change."""

ROUNDS = 2
"""Fits with weights by the residuals of the fit before."""


@dataclass(frozen=True, eq=False)
class Fit:
    """An estimate.

    theta      free numbers; `covariance` theirs (k, k), with initial states and offsets unknown
    starts     initial states of the runs (R, 12)
    information  triangular factor (k, k) of the inverse covariance, in natural sizes of the numbers, without priors
    noise      of channels, by run (C), SI
    residuals  measured minus predicted without offset, by run (T, C), SI; NaN where there is no sample
    by_theta   derivatives of the channels, by run (T, C, k)
    offsets    of the channels, by run (C), SI
    """

    theta: Array
    covariance: Array
    starts: Array
    information: Array
    noise: list[Array]
    residuals: list[Array]
    by_theta: list[Array]
    by_start: list[Array]
    offsets: list[Array]


class Problem:
    """Residuals of all runs as a function of z: theta and initial states in natural sizes, about the stand file."""

    def __init__(self, free: Free, runs: Sequence[Run], theta: Array, fixed: bool = False) -> None:
        """`fixed`: theta is not free, only initial states are."""
        self.free, self.runs, self._about, self._fixed = free, runs, theta, fixed
        self.scale = free.scale
        self.k = 0 if fixed else len(theta)
        self.noise = [noise_of(run.measured) for run in runs]
        self._kept: tuple[Array, Array, Array] | None = None
        self._seen: dict[bytes, Array] = {}
        self.slopes: list[tuple[Array, Array]] = []

    @property
    def size(self) -> int:
        """Numbers of z."""
        return self.k + START * len(self.runs)

    def split(self, z: Array) -> tuple[Array, Array]:
        """theta, and the initial states (R, 12)."""
        theta = self._about.copy()
        theta[: self.k] += self.scale[: self.k] * z[: self.k]
        return theta, z[self.k :].reshape(-1, START) * START_SCALE

    def reweigh(self, z: Array) -> None:
        """Take the noise of each channel from its residuals."""
        self.noise = [np.maximum(np.sqrt(np.nanmean(r**2, axis=0)), 1e-12) for r, _ in self.differences(z)]
        self._kept, self._seen = None, {}

    def differences(self, z: Array) -> list[tuple[Array, Array]]:
        """Measured minus predicted, centred (T, C), and offsets (C), of each run."""
        theta, starts = self.split(z)
        found = []
        for run, start in zip(self.runs, starts, strict=True):
            course = values(run.predictor, self.free, theta, start)
            difference = run.measured - run.at_samples(course[:, :, None])[:, :, 0]
            offset = np.nanmean(difference, axis=0)
            found.append((difference - offset, offset))
        return found

    def residuals(self, z: Array) -> Array:
        """Weighted residuals, then priors; NaN for a stand that cannot be, from which the search turns back."""
        key = z.tobytes()
        if key not in self._seen:
            try:
                parts = [
                    _there(difference / noise, run)
                    for (difference, _), noise, run in zip(self.differences(z), self.noise, self.runs, strict=True)
                ]
                self._seen = {key: np.concatenate([*parts, self._priors * z])}
            except (StandError, StateError):
                return np.full(sum(int(run.there.sum()) for run in self.runs) + self.size, np.nan)
        return self._seen[key]

    @property
    def _priors(self) -> Array:
        return np.concatenate([np.full(self.k, 1.0 / PRIOR), np.full(START * len(self.runs), 1.0 / PRIOR_START)])

    def jacobian(self, z: Array) -> Array:
        """Derivatives of the residuals; those of a z before, while the residuals change as they say."""
        now = self.residuals(z)
        if self._kept is not None:
            at, before, J = self._kept
            change = now - before
            if np.linalg.norm(change - J @ (z - at)) <= LINEAR * np.linalg.norm(change):
                return J
        theta, starts = self.split(z)
        rows, self.slopes = [], []
        for r, (run, start) in enumerate(zip(self.runs, starts, strict=True)):
            found = slopes(run.predictor, self.free, theta, start)
            by_theta = run.at_samples(found.by_theta)[:, :, : self.k]
            by_start = run.at_samples(found.by_start)
            self.slopes.append((by_theta, by_start))
            own = np.zeros((*run.measured.shape, self.size))
            own[:, :, : self.k] = by_theta * self.scale[: self.k]
            own[:, :, self.k + START * r : self.k + START * (r + 1)] = by_start * START_SCALE
            own = np.where(run.there[:, :, None], own, np.nan)
            own -= np.nanmean(own, axis=0)
            rows.append(-_there(own / self.noise[r][:, None], run))
        J = np.concatenate([*rows, np.diag(self._priors)])
        self._kept = z.copy(), now, J
        return J


def estimate(
    free: Free,
    runs: Sequence[Run],
    loss: Loss = "linear",
    theta: Array | None = None,
    fixed: bool = False,
    progress: OnProgress | None = None,
) -> Fit:
    """Free numbers from runs, from theta on. `fixed`: theta stays, only initial states are found. Raises UsageError."""
    about = free.nominal if theta is None else theta
    problem = Problem(free, runs, about, fixed)
    samples = sum(int(run.there.sum()) for run in runs)
    if samples <= problem.size:
        raise UsageError(f"{samples} samples of sensors for {problem.size} unknown numbers: too few data")
    z = np.zeros(problem.size)
    for k in range(1 + ROUNDS):
        tell(progress, Progress("fit", k, 1 + ROUNDS))
        first: Any = least_squares(
            problem.residuals, z, problem.jacobian, method="trf", loss=loss, x_scale=1.0, xtol=1e-9, ftol=1e-9,
            gtol=1e-12, max_nfev=60,
        )  # fmt: skip
        z = first.x
        problem.reweigh(z)
    return _result(problem, z, loss)


def _result(problem: Problem, z: Array, loss: Loss) -> Fit:
    """The estimate at z, with its covariance by the weights of its own residuals."""
    J = problem.jacobian(z)
    k = problem.k
    if loss != "linear":
        J = J * np.sqrt(_weights(problem.residuals(z), loss))[:, None]
    data = J[: len(J) - problem.size]
    nuisance = np.concatenate([data[:, k:], np.diag(problem._priors[k:])])
    R = np.linalg.qr(np.block([[nuisance, np.concatenate([data[:, :k], np.zeros((problem.size - k, k))])]]), mode="r")
    information = R[problem.size - k :, problem.size - k :]
    scale = problem.scale[:k]
    whole = np.concatenate([information, np.eye(k) / PRIOR])
    inverse = np.linalg.pinv(whole.T @ whole) if k else np.zeros((0, 0))
    theta, starts = problem.split(z)
    found = problem.differences(z)
    return Fit(
        theta, scale[:, None] * inverse * scale, starts, information, problem.noise,
        [difference for difference, _ in found], [by_theta for by_theta, _ in problem.slopes],
        [by_start for _, by_start in problem.slopes], [offset for _, offset in found],
    )  # fmt: skip


def _weights(residuals: Array, loss: Loss) -> Array:
    """Weights of residuals, as the robust loss has them at its scale 1."""
    squares = residuals**2
    if loss == "huber":
        return np.asarray(1.0 / np.maximum(1.0, np.sqrt(squares)))
    return np.asarray(1.0 / np.sqrt(1.0 + squares))


def _there(array: Array, run: Run) -> Array:
    """Rows of samples that are there, (n) or (n, k)."""
    return array[run.there]
