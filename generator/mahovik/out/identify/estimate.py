"""Least squares of free numbers over runs by `scipy.optimize.least_squares`, with channels weighted by their noise.

Unknown besides the free numbers are the initial state of each run and a constant offset of each channel; offsets are
eliminated by centring. Combinations of free numbers that no channel tells, by the singular values of the Jacobian,
stay as in the stand file; weak priors keep everything else within reason.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Literal, get_args

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import null_space
from scipy.optimize import least_squares

from mahovik.core.stand.model import Stand
from mahovik.errors import StandError, StateError, UsageError
from mahovik.nearest import suggestion
from mahovik.out.identify.free import Free
from mahovik.out.identify.predict import NEAR_CORNER, Phase, Predictor, Samples, channels_of, corners_of, phase_of
from mahovik.use.measured.clocks import Recording
from mahovik.use.numeric.se3 import Array

Loss = Literal["linear", "soft_l1", "huber", "cauchy", "arctan"]

WEIGHTS: Mapping[str, Callable[[Array], Array]] = {
    "linear": np.ones_like,
    "soft_l1": lambda z: 1.0 / np.sqrt(1.0 + z),
    "huber": lambda z: 1.0 / np.sqrt(np.maximum(1.0, z)),
    "cauchy": lambda z: 1.0 / (1.0 + z),
    "arctan": lambda z: 1.0 / (1.0 + z**2),
}
"""Weights of squares z of residuals with which least squares has the gradient of a loss of SciPy."""

PRIOR, PRIOR_START = 100.0, 10.0
"""Standard deviations of the priors of free numbers and of initial states, in natural sizes."""

LARGE = 0.5
"""A combination whose standard deviation is above this, in natural sizes of its numbers, is unobservable."""

WHOLE, PART = 0.99, 0.3
"""Part of a number in unobservable combinations from which it is one by itself; part of the largest to be named."""

SIGMA = 1.4826
"""Standard deviation of a normal distribution over its median absolute deviation."""

LEAST_NOISE = 1e-9
"""Least noise of a channel, of 1 SI and its spread."""

HEARD = 3.0
"""A channel has a signal where its spread is above this many times its noise."""

MUCH, ABOVE = 1.0 / 3.0, 5.0
"""A fit is bad where it leaves more than this share of a channel's data, and this many times its noise."""

LAGS, COLOURED, SURE, EXACT = 20, 0.05, 6.0, 1e-4
"""Lags at which residuals are correlated; coloured part of their variance from which standard errors are too small, if
so many standard deviations show it; share of the data below which residuals are rounding."""

STEP = 1e-4
"""Step of central differences, of the natural size of a number."""

PAD = 8
"""Steps that a prediction begins before the first sample and ends after the last: delays reach there."""

FEWEST = 100
"""Samples that a run has at least."""

STILL, STEADY, TOGETHER = 1e-3, 0.01, 4.0 * np.pi
"""Speed of a flywheel that stands still (rad/s); share of a speed by which a constant one changes; difference of the
angles of two flywheels of one speed (rad)."""

SWING, LEAST_SWING, TRIAL = 0.3, 5.0, 2000
"""Amplitude of the speeds of a trial motion: share of the speed, and least (rad/s); its samples."""


class Run:
    """Samples of the channels of a stand's sensors in one recording, and what is predicted for them.

    channels  labels (C); measured: (T, C) SI, NaN where there is no sample; noise: (C) by differences
    """

    def __init__(self, recording: Recording, free: Free) -> None:
        """Raises UsageError."""
        stand = free.stand
        t, every, self.source, self.notes = recording.t, recording.step, recording.source, list[str]()
        self.channels = tuple(label for label in channels_of(stand) if label in recording.frame)
        if not self.channels:
            example = "hold.reaction.x [N]" if stand.hold is not None else "acc1.acceleration.x [m/s2]"
            hint = "" if channels_of(stand) else f"; {stand.name} has no [[point]]: give it the places of its sensors"
            raise UsageError(f"{self.source}: no channel of a sensor, expected such as {example}{hint}")
        phases = [phase_of(recording, stand, wheel.name) for wheel in stand.flywheels]
        known = recording.frame[[f"{wheel.name}.phase" for wheel in stand.flywheels]].dropna().index
        self.measured = recording.frame[list(self.channels)].to_numpy(copy=True)
        outside = (t < known[0] + 0.5 * every) | (t > known[-1] - 0.5 * every)  # there a spline is known from one side
        if left := int(np.isfinite(self.measured[(t < known[0]) | (t > known[-1])]).any(axis=1).sum()):
            where = f"outside {known[0]:.6g} to {known[-1]:.6g} s, where a phase is missing"
            self.notes.append(f"{self.source}: {left} samples {where}, are left out")
        self.measured[outside] = np.nan
        for at in (at for phase in phases for at in corners_of(phase, every)):  # not even known from one side there
            self.measured[np.abs(t - t[0] - at) < NEAR_CORNER * every] = np.nan
        self.there = np.isfinite(self.measured)
        if (samples := int(self.there.any(axis=1).sum())) < FEWEST:
            raise UsageError(f"{self.source}: {samples} samples of sensors, expected at least {FEWEST}")
        self.duration, self._free = float(t[-1] - t[0]), free
        begin = -PAD * every - max(free.known.values(), default=0.0)
        count = int(np.ceil((self.duration - begin) / every)) + PAD + 1
        self.predictor = Predictor(stand, phases, self.channels, begin, every, count)
        self._samples = Samples(self.predictor.times, t - t[0], self.channels)
        self.noise = noise_of(self.measured)

    def predict(self, theta: Array, start: Array) -> Array:
        """Channels (T, C) at theta (k) and the numbers of an initial state (D)."""
        course = self.predictor(self._free.tables(theta[:, None]), start[:, None])
        return self._samples.at(course, self._free.delays(theta))[:, :, 0]

    def slopes(self, theta: Array, start: Array) -> Array:
        """Derivatives (T, C, k + D) by theta and the initial state, each over its natural size."""
        course, rates = slopes(self.predictor, self._free, theta, start)
        delays, size = self._free.delays(theta), self._free.size
        late = np.zeros((*self.measured.shape, len(self._free.delayed)))
        for i, name in enumerate(self._free.delayed):
            late_rows = [label.startswith(f"{name}.") for label in self.channels]
            late[:, late_rows, i] = (
                -self._samples.at(course[:, :, None], delays, 1)[:, late_rows, 0] * self._free.scale[size + i]
            )
        at = self._samples.at(rates, delays)
        return np.concatenate([at[:, :, :size], late, at[:, :, size:]], axis=2)

    def centred(self, values: Array) -> tuple[Array, Array]:
        """Values (T, C, ...) less their means (C, ...) over the samples that exist; NaN elsewhere."""
        kept = np.where(self.there.reshape(*self.there.shape, *(1,) * (values.ndim - 2)), values, np.nan)
        mean = np.nanmean(kept, axis=0)
        return kept - mean, mean


def slopes(predictor: Predictor, free: Free, theta: Array, start: Array) -> tuple[Array, Array]:
    """Channels (G, C), and their derivatives (G, C, n) by n numbers of the stand and of the initial state.

    Central differences over natural sizes; one-sided where a stand on one side cannot be. Raises StandError.
    """
    k, D = free.size, len(predictor.start_scale)
    steps = STEP * np.concatenate([free.scale[:k], predictor.start_scale])
    both = np.kron(np.diag(steps), [1.0, -1.0])
    thetas = np.column_stack([theta, theta[:, None] + np.pad(both[:k], ((0, len(theta) - k), (0, 0)))])
    starts = np.column_stack([start, start[:, None] + both[k:]])
    try:
        tables = free.tables(thetas)
    except StandError:
        for i in range(k):
            refused = []
            for j in (1 + 2 * i, 2 + 2 * i):
                try:
                    free.tables(thetas[:, j : j + 1])
                except StandError:
                    thetas[:, j] = theta
                    refused.append(j)
            if len(refused) == 2:
                raise
        tables = free.tables(thetas)
    course = predictor(tables, starts)
    width = np.full(k + D, 2.0 * STEP)
    width[:k] = [(thetas[i, 1 + 2 * i] - thetas[i, 2 + 2 * i]) / free.scale[i] for i in range(k)]
    return course[:, :, 0], (course[:, :, 1::2] - course[:, :, 2::2]) / width


@dataclass(frozen=True, eq=False)
class Fit:
    """An estimate.

    theta        free numbers; covariance: theirs (k, k), without what is unobservable
    unobservable orthonormal combinations (q, k), in natural sizes, that stay as in the stand file
    noise        of channels, by run (C); residuals: measured less predicted without offset, by run (T, C); offsets: (C)
    starts       numbers of the initial states (R, D)
    """

    theta: Array
    covariance: Array
    unobservable: Array
    noise: list[Array]
    residuals: list[Array]
    offsets: list[Array]
    starts: Array

    def standard_errors(self, slopes: Array) -> Array:
        """Standard errors of numbers with derivatives `slopes` (k, k) by theta; NaN where one is not determined."""
        variance = np.diag(slopes @ self.covariance @ slopes.T)
        lost = (slopes != 0.0) @ (np.linalg.norm(self.unobservable, axis=0) > PART)
        return np.sqrt(np.where((variance >= 0.0) & ~lost, variance, np.nan))


class Problem:
    """Residuals of all runs as a function of z: combinations of free numbers, then initial states, in natural sizes.

    basis  (k, r): theta = nominal + scale (basis z)
    """

    def __init__(self, free: Free, runs: Sequence[Run]) -> None:
        self.free, self.runs, self.noise = free, runs, [run.noise for run in runs]
        self.basis = np.eye(len(free.paths))
        self._starts = runs[0].predictor.start_scale

    def split(self, z: Array) -> tuple[Array, Array]:
        """theta, and the numbers of the initial states (R, D)."""
        r = self.basis.shape[1]
        theta = self.free.nominal + self.free.scale * (self.basis @ z[:r])
        return theta, z[r:].reshape(len(self.runs), len(self._starts)) * self._starts

    def differences(self, z: Array) -> list[tuple[Array, Array]]:
        """Measured less predicted, centred (T, C), and offsets (C), of each run. Raises StandError, StateError."""
        theta, starts = self.split(z)
        return [run.centred(run.measured - run.predict(theta, x)) for run, x in zip(self.runs, starts, strict=True)]

    @property
    def size(self) -> int:
        """Numbers of z."""
        return self.basis.shape[1] + len(self.runs) * len(self._starts)

    @property
    def prior(self) -> Array:
        """Diagonal of the rows of the priors."""
        return np.where(np.arange(self.size) < self.basis.shape[1], 1.0 / PRIOR, 1.0 / PRIOR_START)

    def residuals(self, z: Array) -> Array:
        """Weighted residuals, then priors; NaN for a stand that cannot be, from which the search turns back."""
        try:
            differences = self.differences(z)
        except (StandError, StateError):
            return np.full(sum(int(run.there.sum()) for run in self.runs) + self.size, np.nan)
        rows = zip(differences, self.noise, self.runs, strict=True)
        return np.concatenate([*((r / noise)[run.there] for (r, _), noise, run in rows), self.prior * z])

    def jacobian(self, z: Array) -> Array:
        """Derivatives of the residuals."""
        (theta, starts), k, r, D = self.split(z), len(self.basis), self.basis.shape[1], len(self._starts)
        parts = []
        for i, (run, start, noise) in enumerate(zip(self.runs, starts, self.noise, strict=True)):
            by = (-run.centred(run.slopes(theta, start))[0] / noise[:, None])[run.there]
            part = np.zeros((len(by), self.size))
            part[:, :r], part[:, r + D * i : r + D * (i + 1)] = by[:, :k] @ self.basis, by[:, k:]
            parts.append(part)
        return np.concatenate([*parts, np.diag(self.prior)])

    def reweigh(self, z: Array, loss: Loss) -> None:
        """Take the noise of each channel from its residuals; with a robust loss by their median, as outliers are in."""
        for i, ((r, _), run) in enumerate(zip(self.differences(z), self.runs, strict=True)):
            size = np.sqrt(np.nanmean(r**2, axis=0)) if loss == "linear" else SIGMA * np.nanmedian(np.abs(r), axis=0)
            self.noise[i] = np.maximum(size, LEAST_NOISE * (1.0 + np.nanstd(run.measured, axis=0)))

    def information(self, z: Array, loss: Loss) -> Array:
        """Triangular factor (r, r) of the inverse covariance of the combinations, with unknown starts, no priors."""
        r = self.basis.shape[1]
        J = self.jacobian(z) * np.sqrt(WEIGHTS[loss](self.residuals(z) ** 2))[:, None]
        J[len(J) - self.size : len(J) - self.size + r] = 0.0
        return np.asarray(np.linalg.qr(np.column_stack([J[:, r:], J[:, :r]]), mode="r"))[-r:, -r:]


def estimate(free: Free, recordings: Sequence[Recording], loss: Loss = "linear") -> tuple[Fit, list[Run]]:
    """Free numbers from recordings, by one of SciPy's losses. Raises UsageError, StandError, StateError."""
    if loss not in get_args(Loss):
        raise UsageError(f'loss: unknown "{loss}"{suggestion(loss, get_args(Loss))}')
    _refuse_apart(free.stand, recordings)
    runs = [Run(recording, free) for recording in recordings]
    problem = Problem(free, runs)
    samples = sum(int(run.there.sum()) for run in runs)
    if samples <= problem.size:
        raise UsageError(f"{samples} samples of sensors for {problem.size} unknown numbers: too few data")

    def solve(z: Array) -> Array:
        z = least_squares(problem.residuals, z, problem.jacobian, loss=loss, ftol=1e-9, xtol=1e-12, gtol=1e-12).x
        problem.reweigh(z, loss)
        return np.asarray(z)

    z = solve(solve(np.zeros(problem.size)))
    information = problem.information(z, loss)
    _, sigma, rows = np.linalg.svd(information)
    weak = _singles_first(rows[sigma * LARGE < 1.0])
    if len(weak):
        k, problem.basis = len(problem.basis), null_space(weak)
        z = solve(np.concatenate([problem.basis.T @ z[:k], z[k:]]))
        information = problem.information(z, loss)
    theta, starts = problem.split(z)
    spread = np.linalg.inv(information.T @ information + np.eye(len(information)) / PRIOR**2)
    axes = free.scale[:, None] * problem.basis
    differences = problem.differences(z)
    fit = Fit(
        theta,
        axes @ spread @ axes.T,
        weak,
        problem.noise,
        [r for r, _ in differences],
        [o for _, o in differences],
        starts,
    )
    return fit, runs


def _refuse_apart(stand: Stand, recordings: Sequence[Recording]) -> None:
    """Raise UsageError: the phase of a flywheel is in a recording whose times are not those of the sensors."""
    for label in (f"{wheel.name}.phase" for wheel in stand.flywheels):
        having = [recording for recording in recordings if label in recording.frame]
        without = [recording for recording in recordings if label not in recording.frame]
        if having and without:
            first, second = (f"{x.source} covers {x.t[0]:.6g} to {x.t[-1]:.6g} s" for x in (without[0], having[0]))
            raise UsageError(f"{first}, {second} and has the phase of {label[:-6]}: expected times that overlap")


def _singles_first(weak: Array) -> Array:
    """Orthonormal directions that span those of `weak` (q, k), nearly: axes of single numbers, then the rest."""
    singles = np.linalg.norm(weak, axis=0) > WHOLE
    _, sigma, rows = np.linalg.svd(np.where(singles, 0.0, weak), full_matrices=False)
    return np.concatenate([np.eye(weak.shape[1])[singles], rows[sigma > 0.5]])


def noise_of(measured: Array) -> Array:
    """Noise (C) of channels (T, C) by their fourth differences, which motion hardly has."""
    noise = []
    for column in measured.T:
        values = np.diff(column[np.isfinite(column)], 4)
        noise.append(SIGMA * np.median(np.abs(values)) / np.sqrt(70.0) if len(values) else 0.0)
    return np.asarray(np.maximum(np.array(noise), 1e-6 * np.nanstd(measured, axis=0) + 1e-12))


def shares_left(run: Run, residuals: Array) -> tuple[Array, NDArray[np.bool_], NDArray[np.bool_]]:
    """For each channel (C): residual as a share of the data (NaN where these are constant), has signal, fits badly."""
    spread, left = np.nanstd(run.measured, axis=0), np.sqrt(np.nanmean(residuals**2, axis=0))
    noise = np.maximum(np.minimum(run.noise, noise_of(residuals)), LEAST_NOISE)
    heard = spread > HEARD * noise
    shares = left / np.where(spread > LEAST_NOISE, spread, np.nan)
    return shares, heard, heard & (shares > MUCH) & (left > ABOVE * noise)


def coloured_lines(runs: Sequence[Run], fit: Fit) -> list[str]:
    """A line for each run whose residuals are not white noise, so that standard errors are too small.

    A narrow band that is a part s of the variance has correlations of s cos(), the rest has 1 / sqrt(T) of any sign.
    """
    lines = []
    for run, residuals in zip(runs, fit.residuals, strict=True):
        shares, heard, bad = shares_left(run, residuals)
        sizes = dict[str, float]()
        for c in np.flatnonzero(heard & ~bad & (shares > EXACT)):
            r = residuals[np.isfinite(residuals[:, c]), c]
            squares = sum(float(r[k:] @ r[:-k] / (r @ r)) ** 2 for k in range(1, LAGS + 1))
            if len(r) * squares > LAGS + SURE * np.sqrt(2.0 * LAGS):
                sizes[run.channels[c]] = float(np.sqrt(2.0 * (squares / LAGS - 1.0 / len(r))))
        name = max(sizes, key=lambda label: sizes[label], default="")
        if name and sizes[name] > COLOURED:
            size = f"{100.0 * sizes[name]:.2g} % of what {name} leaves is no white noise"
            cause = "a delay, a filter, or a number that is not free?"
            lines.append(f"warning: {run.source}: {size}, standard errors are too small: {cause}")
    return lines


# -- what the data cannot tell ---------------------------------------------------------------------------------------


def unobservable_lines(free: Free, runs: Sequence[Run], fit: Fit) -> list[str]:
    """One line for each number, or combination of numbers, that the data do not tell, and what would show it."""
    names = [path.removesuffix("_at") if ".unbalance." in path else path for path in free.paths]
    lines: dict[str, None] = {}
    for direction in fit.unobservable:
        size = np.abs(direction)
        parts = dict.fromkeys(names[i] for i in np.argsort(-size) if size[i] >= PART * size.max())
        many = "their combination is" if len(parts) > 1 else "is"
        lines[f"{', '.join(parts)}: {many} {_advice(free, runs, fit, direction, list(parts))}"] = None
    return list(lines)


def _advice(free: Free, runs: Sequence[Run], fit: Fit, direction: Array, names: Sequence[str]) -> str:
    """Why data do not show a combination, and what would."""
    wheels = [wheel.name for wheel in free.stand.flywheels]
    varied = [i for i, name in enumerate(wheels) if any(path.startswith(f"{name}.") for path in names)]
    motions = [run.predictor.motion(np.linspace(0.0, run.duration, 200)) for run in runs]
    still = [wheels[i] for i in varied if all(np.abs(speeds[:, i]).max() < STILL for _, speeds, _ in motions)]
    if still:
        return f"not seen in the data: {', '.join(still)} stands still, let it turn"
    if len(varied) > 1 and all(
        min(np.ptp(phi[:, a] - phi[:, b]), np.ptp(phi[:, a] + phi[:, b])) < TOGETHER
        for phi, _, _ in motions for a in varied for b in varied if a < b
    ):  # fmt: skip
        return (
            f"not seen: {' and '.join(wheels[i] for i in varied)} turn at one speed in all data, let the speeds differ"
        )
    if any(np.any(np.ptp(speeds, axis=0) > STEADY * np.abs(speeds).max(axis=0) + 1e-6) for _, speeds, _ in motions):
        return "not seen in this motion: add a run with other speeds, or a sensor at another place; or keep one fixed"
    if _shown_by_swing(free, runs[0], fit, motions[0][1].mean(axis=0), direction):
        return "not seen at constant speeds: add a run in which the speeds of the flywheels change"
    return "not seen at constant speeds, nor if they changed: keep it as it is, or add a sensor at another place"


def _shown_by_swing(free: Free, run: Run, fit: Fit, mean: Array, direction: Array) -> bool:
    """Whether a run as long, in which all speeds (N, rad/s) swing about their means, would tell a combination."""
    phases = [_swing(float(w), 3.0 + 0.7 * i, 0.3 * i) for i, w in enumerate(mean)]
    every, whole = float(run.predictor.times[1] - run.predictor.times[0]), len(run.predictor.times)
    predictor = Predictor(free.stand, phases, run.channels, 0.0, every, min(TRIAL, whole))
    _, by = slopes(predictor, free, fit.theta, np.zeros(len(predictor.start_scale)))
    by = ((by - by.mean(axis=0)) / fit.noise[0][:, None]).reshape(-1, by.shape[2])
    k, D = free.size, len(predictor.start_scale)
    R = np.asarray(np.linalg.qr(np.column_stack([by[:, k:], by[:, :k] @ direction[:k]]), mode="r"))
    return bool(LARGE * abs(R[D, D]) * np.sqrt(whole / len(predictor.times)) > 1.0)


def _swing(mean: float, rate: float, begin: float) -> Phase:
    """Phase of a flywheel whose speed (rad/s) swings about its mean at `rate`, rad/s."""
    size = max(SWING * abs(mean), LEAST_SWING)

    def phase(t: Array, order: int = 0) -> Array:
        shift = 0.5 * np.pi * order
        drift = (begin + mean * t, mean, 0.0)[order]
        return np.asarray(drift - size / rate * rate**order * np.cos(rate * t + shift))

    return phase
