"""Measured data as recordings of a stand: each channel matched, each fault of the data corrected and noted.

Data are CSV, Parquet or frames of pandas, with a column under each header.
"""

from __future__ import annotations

import io
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from mahovik.core.stand.files import TABLE, content
from mahovik.core.stand.model import Stand
from mahovik.errors import DataError, UsageError
from mahovik.use.measured.clocks import GAP, Array, Recording, count, join, with_phases
from mahovik.use.measured.headers import HeaderError, channel_of, is_run, is_time, known_header, time_scale

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


def read_recordings(data: Iterable[str | Path | pd.DataFrame], stand: Stand) -> tuple[Recording, ...]:
    """The runs of some files of measured data or frames, matched to a stand.

    Raises DataError with a line for each file that cannot be used; UsageError: Parquet without pyarrow.
    """
    recordings, left, sources = list[Recording](), list[str](), list[str]()
    for number, entry in enumerate(data, 1):
        source = f"frame {number}" if isinstance(entry, pd.DataFrame) else str(entry)
        table, notes = _columns_of(entry) if isinstance(entry, pd.DataFrame) else read_table(Path(entry))
        sources.append(source)
        for recording in _recordings(source, table, notes, stand):
            if recording.frame.columns.size:
                recordings.append(recording)
            else:
                left += recording.notes
    if not recordings:
        more = [f"... and {len(left) - SHOWN} more lines like these"] if len(left) > SHOWN else []
        raise DataError([*left[:SHOWN], *more, f"{', '.join(sources)}: no channel of the stand {stand.name} is left"])
    recordings[0] = replace(recordings[0], notes=(*recordings[0].notes, *left))
    return join(recordings)


# -- tables ------------------------------------------------------------------------------------------------------------


def read_table(path: Path) -> tuple[pd.DataFrame, list[str]]:
    """The columns of a file with numbers, under its headers and in its units, and what was met while reading.

    Raises DataError in one line; UsageError: Parquet without pyarrow.
    """
    reader = READERS.get(path.suffix.lower())
    if reader is None:
        raise DataError([f'{path}: unknown format "{path.suffix}", expected {" or ".join(READERS)}'])
    try:
        return reader(path, content(path, TABLE))
    except OSError as error:
        raise DataError([f"{path}: {error.strerror or error}"]) from None


def _columns_of(frame: pd.DataFrame) -> tuple[pd.DataFrame, list[str]]:
    """The columns of a frame with numbers, in double; an index with a name is one of them."""
    table = frame if frame.index.name is None else frame.reset_index()
    return table.select_dtypes(["number", "bool"]).astype(np.float64), []


def _read_csv(path: Path, raw: bytes) -> tuple[pd.DataFrame, list[str]]:
    """Columns parted by commas, semicolons or tabs; where they are not parted by commas, a comma is a decimal one.

    Headers are in the first line; `#` begins a comment; a cell that is no number is a missing sample.
    """
    try:
        text = raw.decode("utf-8-sig")
    except UnicodeDecodeError:
        text = raw.decode("latin-1")  # degree signs of older programs
    if "\0" in text:
        raise DataError([f"{path}: holds zero bytes, expected a text with columns"])
    lines = [line for line in text.splitlines() if line.strip() and not line.lstrip().startswith("#")]
    if len(lines) < 2:
        raise DataError([f"{path}: expected a line of headers and lines of numbers, found {len(lines)} lines"])
    delimiter = max(",;\t", key=lines[0].count)
    headers = [cell.strip().strip('"').strip() for cell in lines[0].split(delimiter)]
    for header in headers:
        if header and headers.count(header) > 1:
            raise DataError([f'{path}: line 1: the header "{header}" stands twice; name each column once'])
    body = "\n".join(lines[1:])
    try:
        frame = pd.read_csv(
            io.StringIO(body if delimiter == "," else body.replace(",", ".")), sep=delimiter, header=None,
            names=[header or f"column {k + 1}" for k, header in enumerate(headers)], index_col=False,
            on_bad_lines="skip", float_precision="round_trip", skipinitialspace=True, low_memory=False,
        )  # fmt: skip
    except (ValueError, OverflowError) as error:  # pandas' own errors are ValueErrors
        raise DataError([f"{path}: cannot be read as CSV: {error}".splitlines()[0]]) from None
    notes = []
    if len(frame) < len(lines) - 1:
        notes.append(f"{len(lines) - 1 - len(frame)} lines with more than {len(headers)} cells: left out")
    numbers = frame.apply(pd.to_numeric, errors="coerce")
    if holes := int((numbers.isna() & frame.notna()).to_numpy().sum()):
        notes.append(f"{holes} cells hold no number: taken as missing samples")
    return numbers.astype(np.float64), notes


def _read_parquet(path: Path, raw: bytes) -> tuple[pd.DataFrame, list[str]]:
    try:
        return _columns_of(pd.read_parquet(io.BytesIO(raw), engine="pyarrow"))
    except ImportError:
        raise UsageError(f'{path}: needs pyarrow; `pip install "mahovik[campaign]"`') from None
    except Exception as error:  # pyarrow raises what its parser meets
        raise DataError([f"{path}: cannot be read as Parquet: {error}".splitlines()[0]]) from None


READERS: Mapping[str, Callable[[Path, bytes], tuple[pd.DataFrame, list[str]]]] = {
    ".csv": _read_csv,
    ".parquet": _read_parquet,
}
"""Readers of the formats, by the end of the name."""


# -- recordings --------------------------------------------------------------------------------------------------------


def _recordings(source: str, table: pd.DataFrame, notes: list[str], stand: Stand) -> Iterator[Recording]:
    """The runs of a table; without channels where nothing of it is left."""
    matched, turns = _match(table, stand, notes)
    runs = list(_runs(matched))
    for k, run in enumerate(runs):
        lines = list(notes)
        if len(runs) > 1:
            lines.append(f"run {k + 1} of {len(runs)}: the time begins again in the file")
        ordered = _with_gaps(_without_drops(_ordered(run, lines), lines), lines)
        if ordered.columns.size and len(ordered) < FEWEST:
            lines.append(f"{len(ordered)} samples, expected {FEWEST} or more: left out")
            ordered = ordered.iloc[:, :0]
        phased, counted = with_phases(ordered, stand.flywheels, turns, lines)
        name = f"{source}, run {k + 1}" if len(runs) > 1 else source
        yield Recording(phased, name, tuple(f"{name}: {line}" for line in lines), counted)


def _match(table: pd.DataFrame, stand: Stand, notes: list[str]) -> tuple[pd.DataFrame, dict[str, int]]:
    """Channels of a table in SI over the time, by label; counts a turn that headers state, by flywheel."""
    run = is_run(table)
    if run:
        notes.append("a run of mahovik simulate: readings and flywheels are taken as measured")
    t: Array | None = None
    columns, turns = dict[str, Array](), dict[str, int]()
    for column in table:
        header = known_header(column) if run else column
        if header is None:
            continue
        values = table[column].to_numpy()
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
