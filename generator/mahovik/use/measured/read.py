"""Files of measured data as recordings of a stand: each channel matched, each fault of the data corrected and noted."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from itertools import pairwise
from pathlib import Path

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from mahovik.core.stand.model import Stand
from mahovik.errors import DataError
from mahovik.nearest import suggestion
from mahovik.use.measured.clocks import GAP, Array, Recording, count, join
from mahovik.use.measured.files import READERS, file_content, read_frames
from mahovik.use.measured.flywheels import with_phases
from mahovik.use.measured.headers import (
    HeaderError,
    Names,
    channel_of,
    is_run,
    is_time,
    known_header,
    read_names,
    time_scale,
)

FEWEST = 4
"""Samples that a recording has at least."""

SHORTEST_RUN = 16
"""Samples from which on what follows a step back in time can be a run."""

STUCK = 8
"""Equal samples in a row of a channel that else changes with nearly every sample."""

CHANGING = 0.95
"""Share of samples that differ from the one before, above which a channel changes with nearly every one."""

SHOWN = 20
"""Lines of faults in a message."""


def read_recordings(paths: Iterable[Path], stand: Stand) -> tuple[Recording, ...]:
    """The runs of some files of measured data (CSV, Parquet, TDMS, ULog; TOML with names), matched to a stand.

    Raises DataError with a line for each file that cannot be used; UsageError: a package of an extra is missing.
    """
    files = [Path(path) for path in paths]
    named = [read_names(path, file_content(path)) for path in files if path.suffix.lower() == ".toml"]
    names = Names(
        names={key: header for header_names in named for key, header in header_names.names.items()},
        counts={key: turn for header_names in named for key, turn in header_names.counts.items()},
    )
    wheels = [wheel.name for wheel in stand.flywheels]
    for name in names.counts:
        if name not in wheels:
            raise DataError([f"file of names: counts: {stand.name} has no flywheel {name}{suggestion(name, wheels)}"])
    data = [path for path in files if path.suffix.lower() != ".toml"]
    if not data:
        raise DataError([f"no file of data, expected {', '.join(READERS)}"])
    recordings, left = list[tuple[str, Recording]](), list[str]()
    for path in data:
        for frame in read_frames(path):
            for recording in _recordings(path, frame, stand, names):
                if recording.frame.columns.size:
                    recordings.append((str(path), recording))
                else:
                    left += recording.notes
    if not recordings:
        more = [f"... and {len(left) - SHOWN} more lines like these"] if len(left) > SHOWN else []
        channels = f"{', '.join(map(str, data))}: no channel of the stand {stand.name} is left"
        raise DataError([*left[:SHOWN], *more, channels])
    file, first = recordings[0]
    recordings[0] = file, Recording(first.frame, first.source, (*first.notes, *left), first.counted)
    return join(recordings)


def _recordings(path: Path, frame: pd.DataFrame, stand: Stand, names: Names) -> Iterator[Recording]:
    """The runs of a table; without channels where nothing of it is left."""
    source, notes = frame.attrs["source"], list(frame.attrs["notes"])
    matched, turns = _match(path, frame, stand, names, notes)
    if path.suffix.lower() == ".ulg" and matched.empty:
        return
    runs = list(_runs(matched))
    for k, run in enumerate(runs):
        lines = list(notes)
        if len(runs) > 1:
            lines.append(f"run {k + 1} of {len(runs)}: the time begins again in the file")
        ordered = _with_gaps(_without_drops(_ordered(run, lines), lines), lines)
        if ordered.columns.size and len(ordered) < FEWEST:
            lines.append(f"{len(ordered)} samples, expected {FEWEST} or more: left out")
            ordered = ordered.iloc[:, :0]
        phased, counted = with_phases(ordered, stand.flywheels, {**names.counts, **turns}, lines)
        name = f"{source}, run {k + 1}" if len(runs) > 1 else source
        yield Recording(phased, name, tuple(f"{name}: {line}" for line in lines), counted)


def _match(
    path: Path, frame: pd.DataFrame, stand: Stand, names: Names, notes: list[str]
) -> tuple[pd.DataFrame, dict[str, int]]:
    """Channels of a table in SI over the time, by label; counts a turn that headers state, by flywheel."""
    run, vehicle = is_run(frame), path.suffix.lower() == ".ulg"
    if run:
        notes.append("a run of mahovik simulate: readings and flywheels are taken as measured")
    t: Array | None = None
    columns, turns, unnamed = dict[str, Array](), dict[str, int](), 0
    for column in frame:
        header = names.names.get(column) or (known_header(column, frame, stand) if run or vehicle else column)
        if header is None:
            unnamed += 1
            continue
        values = frame[column].to_numpy()
        try:
            if is_time(header):
                if t is None:
                    t = values * time_scale(header)
                else:
                    notes.append(f'a second column of time, "{column}": left out')
                continue
            channel = channel_of(header, stand)
        except HeaderError as error:
            notes.append(f"{error}: left out")
            continue
        if channel.label in columns:
            notes.append(f"{channel.label}: stands twice: the first is taken")
            continue
        columns[channel.label] = np.where(np.isfinite(values), channel.scale * values, np.nan)
        if channel.counts is not None:
            turns[channel.label.partition(".")[0]] = channel.counts
    if vehicle and unnamed:
        notes.append(f"{unnamed} other columns have no name of the stand: left out")
    if t is None:
        notes.append("no column of time, expected `time [s]`: left out")
        return pd.DataFrame(), turns
    return pd.DataFrame(columns, index=pd.Index(t, name="time")), turns


def _runs(frame: pd.DataFrame) -> Iterator[pd.DataFrame]:
    """The runs of a table, for each of which the time begins again; rows without time are left out.

    A step back of time begins a run where all parts between such steps are long and begin near the first one;
    otherwise rows are out of order.
    """
    frame = frame[np.isfinite(frame.index)]
    t = frame.index.to_numpy()
    ends = [0, *(np.flatnonzero(np.diff(t) < 0) + 1).tolist(), len(t)]
    parts = [t[a:b] for a, b in pairwise(ends)]
    if len(parts) > 1:
        near = 0.1 * min(np.ptp(part) for part in parts)
        if min(map(len, parts)) < SHORTEST_RUN or any(abs(part[0] - parts[0][0]) > near for part in parts):
            ends = [0, len(t)]
    yield from (frame.iloc[a:b] for a, b in pairwise(ends))


def _ordered(frame: pd.DataFrame, notes: list[str]) -> pd.DataFrame:
    """The frame with times that rise strictly."""
    if late := int((np.diff(frame.index) < 0).sum()):
        frame = frame.sort_index(kind="stable")
        notes.append(f"times out of order at {count(late, 'place')}: sorted")
    if twice := int(frame.index.duplicated().sum()):
        frame = frame[~frame.index.duplicated()]
        notes.append(f"{count(twice, 'repeated time')}: the first sample of each is kept")
    return frame


def _with_gaps(frame: pd.DataFrame, notes: list[str]) -> pd.DataFrame:
    """The frame; notes on gaps and uneven steps of its times."""
    t = frame.index.to_numpy()
    steps = np.diff(t)
    usual = float(np.median(steps)) if len(steps) else 0.0
    gaps = np.flatnonzero(steps > GAP * usual)
    if len(gaps):
        longest = gaps[int(np.argmax(steps[gaps]))]
        where = f"the longest of {steps[longest]:.4g} s at t = {t[longest]:.6g} s"
        notes.append(f"{count(len(gaps), 'gap')} in time, {where}: not filled")
    elif len(steps) and np.ptp(steps) > 0.02 * usual:
        notes.append(f"steps of time from {steps.min():.4g} to {steps.max():.4g} s: taken as they are")
    return frame


def _without_drops(frame: pd.DataFrame, notes: list[str]) -> pd.DataFrame:
    """The frame with NaN where a sample of a sensor is stuck; channels without samples are left out."""
    frame = frame.copy()
    for label in list(frame):
        values = frame[label].to_numpy()
        missing = int(np.isnan(values).sum())
        if missing == len(values):
            notes.append(f"{label}: no sample: left out")
            del frame[label]
            continue
        if missing:
            notes.append(f"{label}: {count(missing, 'sample')} of {len(values)} missing")
        if label.count(".") == 2 and (stuck := _stuck(values)).any():
            frame[label] = np.where(stuck, np.nan, values)
            first = frame.index[int(np.argmax(stuck))]
            words = f"{int(stuck.sum())} samples repeat the one before, first at t = {first:.6g} s"
            notes.append(f"{label}: {words}: taken as missing")
    return frame


def _stuck(values: Array) -> NDArray[np.bool_]:
    """Where a value repeats for STUCK samples and more, its first sample excepted; never if the channel is coarse."""
    same = np.concatenate([[False], np.diff(values) == 0.0])
    edges = np.flatnonzero(np.diff(np.concatenate([[0], same.astype(int), [0]])))
    inside = np.zeros(len(values), dtype=bool)
    for a, b in zip(edges[::2], edges[1::2], strict=True):
        inside[a:b] = b - a >= STUCK - 1
    rest = ~inside
    changing = rest.sum() > 2 and (~same[rest]).mean() > CHANGING
    return inside if changing else np.zeros(len(values), dtype=bool)
