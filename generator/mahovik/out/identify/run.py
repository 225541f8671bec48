"""One run of measured data beside what the stand predicts for it: samples, gaps, delays, noise."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mahovik.core.stand.state import State
from mahovik.errors import UsageError
from mahovik.out.api.stands import Stand
from mahovik.out.campaign.signals import sensors
from mahovik.out.identify.channels import Channel, known_channels
from mahovik.out.identify.phases import Fitted, motion_of, span_of
from mahovik.out.identify.predict import Predictor
from mahovik.use.measured.recording import Recording

Array = NDArray[np.float64]

PAD = 8
"""Steps that a prediction begins before the first sample and ends after the last: delays reach there."""

ON_GRID = 1e-3
"""Samples so near to evenly spaced times, in steps, are taken to be there."""

LEAST_NOISE = 1e-9
"""Least noise of a channel, SI: along axes in which a stand cannot move, computed data have rounding alone."""

HEARD = 3.0
"""A channel has a signal where its spread is above this many times its noise."""

NEAR_CORNER = 3.0
"""Samples so near to a corner of a phase, in steps, are left out: its place is not known better, nor are delays."""

FEWEST = 100
"""Samples that a run has at least."""


@dataclass(frozen=True, eq=False)
class Run:
    """Samples of the channels of a stand's sensors in one run.

    measured  (T, C) SI; NaN where there is no sample
    notes     samples that were left out
    places    (T,) of the samples among the predicted times, in steps; with the known delays of channels (T, C)
    """

    source: str
    predictor: Predictor
    measured: Array
    places: Array
    duration: float
    notes: tuple[str, ...] = ()

    @property
    def channels(self) -> tuple[Channel, ...]:
        """Measured channels."""
        return self.predictor.channels

    @property
    def there(self) -> NDArray[np.bool_]:
        """Whether there is a sample (T, C)."""
        return np.isfinite(self.measured)

    def at_samples(self, course: Array) -> Array:
        """Predicted channels (G, C, n) at the times of the samples (T, C, n)."""
        from scipy.interpolate import make_interp_spline

        found = np.empty((len(self.places), *course.shape[1:]))
        for place in np.unique(self.places[0]):
            own = np.flatnonzero(self.places[0] == place)
            rows = self.places[:, own[0]]
            whole = np.round(rows)
            if np.abs(rows - whole).max() < ON_GRID:
                found[:, own] = course[whole.astype(int)][:, own]
            else:
                found[:, own] = make_interp_spline(np.arange(len(course), dtype=float), course[:, own], k=5)(rows)
        return found


def run_of(recording: Recording, stand: Stand, start: State | None, delays: Mapping[str, float]) -> Run:
    """The run of a recording. `delays`: known ones of points, s. Raises UsageError."""
    t, every = recording.t, recording.step
    channels: list[Channel] = []
    columns = []
    for channel in known_channels(stand):
        found = recording.find(channel.point, channel.kind, channel.letter)
        if found is not None and np.isfinite(found.values).any():
            channels.append(channel)
            columns.append(found.values)
    if not channels and stand.hold is not None:
        raise UsageError(
            f"{recording.source}: no channel of a sensor or of the hold, expected such as hold.reaction.x [N]"
        )
    if not channels and any("expected a stand with [hold]" in note for note in recording.notes):
        raise UsageError(
            f"{recording.source}: no channel of a sensor; its channels of a hold need a stand with [hold], and "
            f"{stand.name} has none"
        )
    if not channels:
        points = sensors(stand)
        example = f"{points[0] if points else 'acc1'}.acceleration.x [m/s2]"
        hint = "" if points else f"; {stand.name} has no [[point]]: give it the places of its sensors"
        raise UsageError(f"{recording.source}: no channel of a sensor, expected such as {example}{hint}")
    measured = np.column_stack(columns)
    motion = motion_of(recording, stand)
    begin_known, end_known = span_of(recording, stand)
    outside = (t < begin_known - every) | (t > end_known + every)
    left_out = int((np.isfinite(measured).any(axis=1) & outside).sum())
    notes: tuple[str, ...] = ()
    if left_out:
        measured[outside] = np.nan
        where = f"outside {begin_known:.6g} to {end_known:.6g} s"
        notes = (f"{recording.source}: {left_out} samples {where}, where a phase is missing, are left out",)
    if any(isinstance(each.law, Fitted) for each in motion.flywheels):  # an acceleration is known from one side alone
        measured[(t < begin_known + 0.5 * every) | (t > end_known - 0.5 * every)] = np.nan
    for corner in motion.breaks(float(t[-1] - t[0])):
        near = np.abs(t - t[0] - corner) <= NEAR_CORNER * every
        if int((np.isfinite(measured).any(axis=1) & near).sum()):
            measured[near] = np.nan
            notes += (
                f"{recording.source}: the acceleration of a flywheel jumps at {corner + t[0]:.6g} s: the samples "
                "nearest to it are left out",
            )
    samples = int(np.isfinite(measured).any(axis=1).sum())
    if samples < FEWEST:
        raise UsageError(f"{recording.source}: {samples} samples of sensors, expected at least {FEWEST}")
    late = np.array([delays.get(channel.point, 0.0) for channel in channels])
    begin = -PAD * every - float(late.max())
    places = ((t - t[0])[:, None] - late - begin) / every
    count = int(np.ceil(places.max())) + PAD + 1
    predictor = Predictor(stand, motion, channels, begin, every, count, start)
    return Run(recording.source, predictor, measured, places, float(t[-1] - t[0]), notes)


def runs_of(
    recordings: Sequence[Recording], stand: Stand, start: State | None, delays: Mapping[str, float]
) -> tuple[Run, ...]:
    """The runs of some recordings."""
    return tuple(run_of(each, stand, start, delays) for each in recordings)


def noise_of(measured: Array) -> Array:
    """Noise (C) of channels (T, C) by their fourth differences, which motion hardly has."""
    found: list[Any] = []
    for column in measured.T:
        values = np.diff(column[np.isfinite(column)], 4)
        found.append(1.4826 * np.median(np.abs(values)) / np.sqrt(70.0) if len(values) else 0.0)
    least = 1e-6 * np.nanstd(measured, axis=0) + 1e-12
    return np.asarray(np.maximum(np.array(found), least))


def noise_beside(run: Run, left: Array) -> Array:
    """Noise (C) of the channels of a run, by its data or by what a fit leaves of them (T, C), where that is less."""
    return np.asarray(np.maximum(np.minimum(noise_of(run.measured), noise_of(left)), LEAST_NOISE))


def has_signal(run: Run, left: Array) -> NDArray[np.bool_]:
    """Whether the channels of a run (C) have a signal, and not noise alone; `left`: see `noise_beside`."""
    return np.asarray(np.nanstd(run.measured, axis=0) > HEARD * noise_beside(run, left))
