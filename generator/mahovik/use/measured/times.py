"""Times of a track: missing, unsorted, repeated, with gaps; and several runs in one table."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from mahovik.use.measured.recording import GAP
from mahovik.use.measured.track import Track

SHORTEST_RUN = 16
"""Samples from which on what follows a step back in time can be a run."""


def split_runs(track: Track) -> list[Track]:
    """The runs of a track: the time begins again for each. Rows without time are left out.

    A step back of time begins a run where all parts between steps back are long and begin near the first one;
    otherwise rows are out of order.
    """
    timed = np.isfinite(track.t)
    if not timed.all():
        track = _rows(track, timed)
        track.notes.append(f"{int((~timed).sum())} rows without time: left out")
    back = np.flatnonzero(np.diff(track.t) < 0) + 1
    if not len(back):
        return [track]
    starts = [0, *back.tolist()]
    ends = [*starts[1:], len(track.t)]
    parts = [track.t[a:b] for a, b in zip(starts, ends, strict=True)]
    tolerance = 0.1 * min(np.ptp(part) for part in parts)
    if min(map(len, parts)) < SHORTEST_RUN or any(abs(part[0] - parts[0][0]) > tolerance for part in parts):
        return [track]
    runs = []
    for k, (a, b) in enumerate(zip(starts, ends, strict=True)):
        inside = np.zeros(len(track.t), dtype=bool)
        inside[a:b] = True
        run = _rows(track, inside)
        run.source = f"{track.source}, run {k + 1}"
        run.notes = [*track.notes, f"run {k + 1} of {len(starts)}: the time begins again in the file"]
        runs.append(run)
    return runs


def order_times(track: Track) -> Track:
    """The track with times that rise strictly; notes on order, repeated times and gaps."""
    t, notes = track.t, track.notes
    late = int((np.diff(t) < 0).sum())
    if late:
        order = np.argsort(t, kind="stable")
        track = _take(track, order)
        notes.append(f"times out of order at {late} places: sorted")
    kept = np.concatenate([[True], np.diff(track.t) > 0])
    if not kept.all():
        track = _take(track, np.flatnonzero(kept))
        notes.append(f"{int((~kept).sum())} repeated times: the first sample of each is kept")
    track.notes = notes
    steps = np.diff(track.t)
    gaps = np.flatnonzero(steps > GAP * track.step)
    if len(gaps):
        longest = gaps[int(np.argmax(steps[gaps]))]
        notes.append(
            f"{count(len(gaps), 'gap')} in time, the longest of {steps[longest]:.4g} s at t = {track.t[longest]:.6g} s"
            ": not filled"
        )
    elif len(steps) and np.ptp(steps) > 0.02 * track.step:
        notes.append(f"steps of time from {steps.min():.4g} to {steps.max():.4g} s: taken as they are")
    return track


def count(number: int, noun: str) -> str:
    """`1 gap`, `2 gaps`."""
    return f"{number} {noun}{'' if number == 1 else 's'}"


def _rows(track: Track, inside: NDArray[np.bool_]) -> Track:
    return _take(track, np.flatnonzero(inside))


def _take(track: Track, rows: NDArray[np.intp]) -> Track:
    values = {name: column[rows] for name, column in track.values.items()}
    return Track(track.source, track.t[rows], values, list(track.notes))
