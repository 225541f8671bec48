"""Missing samples: NaN, infinite values, and a value that a stuck channel repeats."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from mahovik.use.measured.recording import Array
from mahovik.use.measured.times import count
from mahovik.use.measured.track import Track

STUCK = 8
"""Equal samples in a row of a channel that else changes with nearly every sample."""

CHANGING = 0.95
"""Share of samples that differ from the one before, above which a channel changes with nearly every one."""


def mark_drops(track: Track) -> Track:
    """The track with NaN where a sample is missing or stuck; empty channels left out; a note on each."""
    kept = {}
    for name, column in track.values.items():
        values = np.where(np.isfinite(column), column, np.nan)
        missing = int(np.isnan(values).sum())
        if missing == len(values):
            track.notes.append(f"{name.label}: no sample: left out")
            continue
        if missing:
            track.notes.append(f"{name.label}: {count(missing, 'sample')} of {len(values)} missing")
        if name.quantity in ("acceleration", "rate", "mount"):
            stuck = _stuck(values)
            if stuck.any():
                values = np.where(stuck, np.nan, values)
                first = track.t[int(np.argmax(stuck))]
                track.notes.append(
                    f"{name.label}: {int(stuck.sum())} samples repeat the one before, first at t = {first:.6g} s: "
                    "taken as missing"
                )
        kept[name] = values
    track.values = kept
    return track


def _stuck(values: Array) -> NDArray[np.bool_]:
    """Where a value repeats for STUCK samples and more, its first sample excepted; never if the channel is coarse."""
    same = np.concatenate([[False], np.diff(values) == 0.0])
    edges = np.flatnonzero(np.diff(np.concatenate([[0], same.astype(int), [0]])))
    starts, ends = edges[::2], edges[1::2]
    long = ends - starts >= STUCK - 1
    inside = np.zeros(len(values), dtype=bool)
    for a, b in zip(starts[long], ends[long], strict=True):
        inside[a:b] = True
    rest = ~inside
    changing = rest.sum() > 2 and (~same[rest]).mean() > CHANGING
    return inside if changing else np.zeros(len(values), dtype=bool)
