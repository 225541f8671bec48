"""Least squares of free numbers over runs, with the exact model and channels weighted by their noise.

Unknown besides the free numbers are the initial state of each run and a constant offset of each channel; offsets are
eliminated by centring. Weak priors of PRIOR natural sizes keep what no channel tells at its value in the stand file.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mahovik.errors import StandError, StateError, UsageError
from mahovik.out.identify.free import Free
from mahovik.out.identify.gauss_newton import Loss, minimise, triangle, weights_of
from mahovik.out.identify.jacobian import slopes, values
from mahovik.out.identify.run import Run, noise_of
from mahovik.out.identify.sight import undetermined_directions
from mahovik.out.notices import OnProgress, Progress, tell

Array = NDArray[np.float64]

PRIOR = 100.0
"""Standard deviation of the priors of free numbers, in natural sizes."""

HELD = 1e-6
"""Standard deviation of the priors of combinations that no channel tells, in natural sizes."""

PRIOR_START = 10.0
"""Standard deviation of the priors of initial states, in natural sizes."""

LINEAR = 0.02
"""A jacobian is kept while its prediction of a change of residuals is as good as this share of the change."""

SIGMA = 1.4826
"""Standard deviation of a normal distribution over its median absolute deviation."""

LEAST_NOISE = 1e-9
"""Least noise of a channel, of 1 SI and its spread."""

ROUNDS = 2
"""Fits with weights by the residuals of the fit before."""


@dataclass(frozen=True, eq=False)
class Fit:
    """An estimate.

    theta      free numbers; `covariance` theirs (k, k), with initial states and offsets unknown
    starts     deviations of the initial states of the runs (R, D), see Deviations
    information  triangular factor (k, k) of the inverse covariance, in natural sizes of the numbers, without priors
    noise      of channels, by run (C), SI
    residuals  measured minus predicted without offset, by run (T, C), SI; NaN where there is no sample
    by_theta   derivatives of the channels, by run (T, C, k)
    offsets    of the channels, by run (C), SI
    held       unit vectors (k), in natural sizes of the numbers, along which these stay as in the stand file
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
    held: list[Array]


class Problem:
    """Residuals of all runs as a function of z: theta and initial states in natural sizes, about the stand file."""

    def __init__(self, free: Free, runs: Sequence[Run], theta: Array, fixed: bool = False) -> None:
        """`fixed`: theta is not free, only initial states are."""
        self.free, self.runs, self._about, self._fixed = free, runs, theta, fixed
        self.scale = free.scale
        self.k = 0 if fixed else len(theta)
        self.noise = [noise_of(run.measured) for run in runs]
        self._kept: tuple[Array, Array, list[Array]] | None = None
        self._units = [noise.copy() for noise in self.noise]
        self._seen: dict[bytes, list[tuple[Array, Array]]] = {}
        self.slopes: list[tuple[Array, Array]] = []
        self._held = np.zeros((0, self.k))

    def hold(self, directions: Sequence[Array]) -> None:
        """Keep these combinations of free numbers, unit vectors in natural sizes, as in the stand file."""
        self._held = np.array(directions).reshape(-1, self.k)

    def restore_held(self, z: Array) -> Array:
        """z with the held combinations at their values in the stand file."""
        found = z.copy()
        found[: self.k] -= self._held.T @ (self._held @ z[: self.k])
        return found

    @property
    def size(self) -> int:
        """Numbers of z."""
        return self.k + self._start_scale.size * len(self.runs)

    @property
    def _start_scale(self) -> Array:
        """Natural sizes of the deviations of an initial state (D)."""
        return self.runs[0].predictor.deviations.scale

    def _of_start(self, r: int) -> slice:
        """Places of the deviations of the initial state of a run in z."""
        count = self._start_scale.size
        return slice(self.k + count * r, self.k + count * (r + 1))

    def split(self, z: Array) -> tuple[Array, Array]:
        """theta, and the deviations of the initial states (R, D)."""
        theta, scale = self._about.copy(), self._start_scale
        theta[: self.k] += self.scale[: self.k] * z[: self.k]
        return theta, z[self.k :].reshape(len(self.runs), len(scale)) * scale

    def reweigh(self, z: Array, loss: Loss) -> None:
        """Take the noise of each channel from its residuals; with a robust loss by their median, as outliers are in."""
        found = []
        for (r, _), run in zip(self.differences(z), self.runs, strict=True):
            size = np.sqrt(np.nanmean(r**2, axis=0)) if loss == "linear" else SIGMA * np.nanmedian(np.abs(r), axis=0)
            found.append(np.maximum(size, LEAST_NOISE * (1.0 + np.nanstd(run.measured, axis=0))))
        self.noise = found

    def differences(self, z: Array) -> list[tuple[Array, Array]]:
        """Measured minus predicted, centred (T, C), and offsets (C), of each run. Raises StandError, StateError."""
        key = z.tobytes()
        if key in self._seen:
            return self._seen[key]
        theta, starts = self.split(z)
        found = []
        for run, start in zip(self.runs, starts, strict=True):
            course = values(run.predictor, self.free, theta, start)
            difference = run.measured - run.at_samples(course[:, :, None])[:, :, 0]
            offset = np.nanmean(difference, axis=0)
            found.append((difference - offset, offset))
        self._seen = {key: found}
        return found

    def residuals(self, z: Array) -> Array:
        """Weighted residuals, then priors; NaN for a stand that cannot be, from which the search turns back."""
        try:
            found = self.differences(z)
        except (StandError, StateError):
            return np.full(sum(int(run.there.sum()) for run in self.runs) + len(self.prior_rows), np.nan)
        parts = [_there(r / noise, run) for (r, _), noise, run in zip(found, self.noise, self.runs, strict=True)]
        return np.concatenate([*parts, self.prior_rows @ z])

    @property
    def _priors(self) -> Array:
        return np.repeat([1.0 / PRIOR, 1.0 / PRIOR_START], [self.k, self.size - self.k])

    @property
    def prior_rows(self) -> Array:
        """Priors, then held combinations, as rows of the residuals."""
        held = np.zeros((len(self._held), self.size))
        held[:, : self.k] = self._held / HELD
        return np.concatenate([np.diag(self._priors), held])

    def jacobian(self, z: Array, exact: bool = False) -> Array:
        """Derivatives of the residuals; those of a z before, while the channels change as they say, unless exact."""
        found = self._kept_slopes(z, exact)
        rows = []
        for r, (run, own) in enumerate(zip(self.runs, found, strict=True)):
            whole = np.zeros((len(own), self.size))
            noise = np.broadcast_to(self.noise[r], run.measured.shape)[run.there][:, None]
            whole[:, : self.k] = -own[:, : self.k] / noise
            whole[:, self._of_start(r)] = -own[:, self.k :] / noise
            rows.append(whole)
        return np.concatenate([*rows, self.prior_rows])

    def _kept_slopes(self, z: Array, exact: bool) -> list[Array]:
        """Derivatives of the centred channels at the samples (n, k + D) of each run, in natural sizes."""
        rows = zip(self.differences(z), self._units, self.runs, strict=True)
        now = np.concatenate([_there(difference / units, run) for (difference, _), units, run in rows])
        if self._kept is not None and not (exact and not np.array_equal(self._kept[0], z)):
            at, before, found = self._kept
            if self._is_near(z - at, now - before, found):
                return found
        theta, starts = self.split(z)
        found, self.slopes = [], []
        for run, start in zip(self.runs, starts, strict=True):
            at_start = slopes(run.predictor, self.free, theta, start)
            by_theta = run.at_samples(at_start.by_theta)[:, :, : self.k]
            by_start = run.at_samples(at_start.by_start)
            self.slopes.append((by_theta, by_start))
            own = np.concatenate([by_theta * self.scale[: self.k], by_start * self._start_scale], axis=2)
            own[~run.there] = np.nan
            own -= np.nanmean(own, axis=0)
            found.append(own[run.there])
        self._kept = z.copy(), now, found
        return found

    def _is_near(self, by: Array, change: Array, found: list[Array]) -> bool:
        """Whether kept derivatives predict a change of the channels to the share LINEAR of it."""
        row, left = 0, 0.0
        for r, (run, own) in enumerate(zip(self.runs, found, strict=True)):
            part = np.concatenate([by[: self.k], by[self._of_start(r)]])
            units = np.broadcast_to(self._units[r], run.measured.shape)[run.there]
            left += float(np.sum((change[row : row + len(own)] + own @ part / units) ** 2))
            row += len(own)
        return left <= LINEAR**2 * float(change @ change)


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
        z = minimise(problem.residuals, problem.jacobian, z, loss)
        problem.reweigh(z, loss)
    information = _information(problem, z, loss)
    held = [] if fixed else undetermined_directions(free, runs, problem.split(z)[0], information)
    if held:
        problem.hold(held)
        z = minimise(problem.residuals, problem.jacobian, problem.restore_held(z), loss)
        problem.reweigh(z, loss)
        information = _information(problem, z, loss)
    return _result(problem, z, information, held)


def _information(problem: Problem, z: Array, loss: Loss) -> Array:
    """Triangular factor (k, k) of the inverse covariance, in natural sizes, with unknown starts, without priors."""
    k, extra = problem.k, problem.size - problem.k
    J = problem.jacobian(z)
    data = (J * np.sqrt(weights_of(problem.residuals(z), loss))[:, None])[: -len(problem.prior_rows)]
    nuisance = np.concatenate([data[:, k:], problem.prior_rows[k : problem.size, k:]])
    whole = np.concatenate([nuisance, np.concatenate([data[:, :k], np.zeros((extra, k))])], axis=1)
    return triangle(whole)[extra:, extra:]


def _result(problem: Problem, z: Array, information: Array, held: list[Array]) -> Fit:
    """The estimate at z, with its covariance by the weights of its own residuals."""
    k = problem.k
    scale = problem.scale[:k]
    whole = np.concatenate([information, np.eye(k) / PRIOR])
    inverse = np.linalg.pinv(whole.T @ whole) if k else np.zeros((0, 0))
    theta, starts = problem.split(z)
    found = problem.differences(z)
    return Fit(
        theta, scale[:, None] * inverse * scale, starts, information, problem.noise,
        [difference for difference, _ in found], [by_theta for by_theta, _ in problem.slopes],
        [by_start for _, by_start in problem.slopes], [offset for _, offset in found], held,
    )  # fmt: skip


def _there(array: Array, run: Run) -> Array:
    """Rows of the samples that exist, (n) or (n, k)."""
    return array[run.there]
