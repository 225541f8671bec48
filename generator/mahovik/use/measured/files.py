"""Files of measured data as data frames: CSV, Parquet, NI TDMS and PX4 ULog.

A frame has a column under each header of the file, in the unit of the file; `attrs["source"]` names the file and the
part of it, `attrs["notes"]` lists what was met while reading. Each reader raises DataError in one line.
"""

from __future__ import annotations

import io
import struct
import warnings
from collections import defaultdict
from collections.abc import Callable, Iterable, Mapping
from importlib import import_module
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
import pandas as pd

from mahovik.core.stand.content import TABLE, content
from mahovik.errors import DataError, UsageError
from mahovik.use.measured.headers import is_time

TDMS_ZERO = np.datetime64("1904-01-01T00:00:00")
"""Zero of times in TDMS; a waveform that begins there has no start."""

ULOG_MAGIC, ULOG_HEADER, ULOG_DEFINITIONS = b"ULog\x01\x12\x35", 16, b"BFIMPQ"
"""First bytes of a log, length of its header, types of the messages before the data."""

ULOG_TIMES = ("timestamp_sample", "timestamp")
"""Fields with the time in microseconds, the best first."""


def read_frames(path: Path) -> list[pd.DataFrame]:
    """The tables of one file, by the end of its name. Raises DataError; UsageError: an extra is missing."""
    reader = READERS.get(path.suffix.lower())
    if reader is None:
        raise DataError([f'{path}: unknown format "{path.suffix}", expected {", ".join((*READERS, ".toml"))}'])
    return reader(path, file_content(path))


def file_content(path: Path) -> bytes:
    """The bytes of a file of data. Raises DataError."""
    try:
        return content(path, TABLE)
    except OSError as error:
        raise DataError([f"{path}: {error.strerror or error}"]) from None


def frame_of(source: str, columns: Mapping[str, Any], notes: Iterable[str] = ()) -> pd.DataFrame:
    """A frame of float columns of one length."""
    frame = pd.DataFrame({header: np.asarray(values, dtype=np.float64) for header, values in columns.items()})
    frame.attrs = {"source": source, "notes": list(notes)}
    return frame


def read_csv(path: Path, raw: bytes) -> list[pd.DataFrame]:
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
    return [frame_of(str(path), numbers, notes)]


def read_parquet(path: Path, raw: bytes) -> list[pd.DataFrame]:
    """The columns with numbers."""
    package("pyarrow", "campaign", path)
    try:
        frame = pd.read_parquet(io.BytesIO(raw), engine="pyarrow")
        return [frame_of(str(path), frame.select_dtypes(["number", "bool"]))]
    except Exception as error:  # pyarrow raises what its parser meets
        raise DataError([f"{path}: cannot be read as Parquet: {error}".splitlines()[0]]) from None


def read_tdms(path: Path, raw: bytes) -> list[pd.DataFrame]:
    """Each group, whose time is a channel `time [s]` or that of its waveforms; those of another step apart.

    A unit is in the name of a channel or in its property `unit_string`. Waveforms begin `wf_start_offset` after their
    `wf_start_time`, which counts from the earliest of the file.
    """
    nptdms = package("nptdms", "tdms", path)
    try:
        groups = nptdms.TdmsFile.read(io.BytesIO(raw)).groups()
    except Exception as error:  # the parser raises what it meets
        raise DataError([f"{path}: cannot be read as TDMS: {error}"]) from None
    waves = [c.properties for group in groups for c in group.channels() if float(c.properties.get("wf_increment", 0))]
    starts = [p["wf_start_time"] for p in waves if p.get("wf_start_time", TDMS_ZERO) > TDMS_ZERO]  # NaT is above none
    frames = []
    for group in groups:
        source, notes, tables = f"{path}: {group.name}", list[str](), defaultdict[Any, dict[str, Any]](dict)
        columns = {}
        for channel in group.channels():
            unit, values = channel.properties.get("unit_string", ""), np.asarray(channel[:])
            header = channel.name if "[" in channel.name or not unit else f"{channel.name} [{unit}]"
            if values.dtype.kind in "fiub":
                columns[header] = channel.properties, values
            else:
                notes.append(f'"{header}" holds no numbers: left out')
        timed = next((header for header in columns if is_time(header)), None)
        for header, (properties, values) in columns.items():
            step, length = float(properties.get("wf_increment", 0.0)), len(values)
            if timed is not None and length != len(columns[timed][1]):
                notes.append(f'"{header}" has {length} samples, the time {len(columns[timed][1])}: left out')
            elif timed is None and step <= 0.0:
                notes.append(f'"{header}" has no time: no channel `time [s]` and no property wf_increment: left out')
            else:
                first, start = float(properties.get("wf_start_offset", 0.0)), properties.get("wf_start_time", TDMS_ZERO)
                if start > TDMS_ZERO:
                    first += float((start - min(starts)) / np.timedelta64(1, "s"))
                tables["time" if timed is not None else (first, step, length)][header] = values
        for key, table in tables.items():
            time = {} if timed is not None else {"time [s]": key[0] + key[1] * np.arange(key[2])}
            frames.append(frame_of(source, time | table, notes))
            notes = []
        if notes:
            frames.append(frame_of(source, {}, notes))
    if frames and 0 < len(starts) < len(waves):
        lacking = f"{len(waves) - len(starts)} of {len(waves)} waveforms have no wf_start_time"
        frames[0].attrs["notes"].append(f"{lacking}: taken as that of the earliest")
    return frames


def read_ulog(path: Path, raw: bytes) -> list[pd.DataFrame]:
    """Each topic; headers are `topic.field`, `topic#1.field` of a second instance."""
    pyulog = package("pyulog", "ulog", path)
    if not _has_data(raw):
        raise DataError([f"{path}: cannot be read as ULog: no whole header, definitions and data"])
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            log = pyulog.ULog(io.BytesIO(raw))
    except Exception as error:  # the parser raises what it meets, such as struct.error and TypeError
        raise DataError([f"{path}: cannot be read as ULog: {str(error) or type(error).__name__}"]) from None
    frames = []
    for topic in log.data_list:
        label = topic.name if topic.multi_id == 0 else f"{topic.name}#{topic.multi_id}"
        time = next((field for field in ULOG_TIMES if field in topic.data and np.any(topic.data[field])), None)
        if time is not None:
            fields = {k: v for k, v in topic.data.items() if v.dtype.kind in "fiub" and k not in ULOG_TIMES}
            columns = {"time [us]": topic.data[time], **{f"{label}.{field}": v for field, v in fields.items()}}
            frames.append(frame_of(f"{path}: {label}", columns))
    if frames and log.dropouts:
        lost = sum(dropout.duration for dropout in log.dropouts)
        frames[0].attrs["notes"].append(f"{len(log.dropouts)} drops of the logger, {lost} ms in all")
    return frames


def _has_data(raw: bytes) -> bool:
    """Whether definitions lead to data; pyulog would search without end in a file that stops before.

    A message is its length (two bytes), its type and as many bytes; `A` begins the data.
    """
    at = ULOG_HEADER
    while raw.startswith(ULOG_MAGIC) and at + 3 <= len(raw):
        size, kind = struct.unpack_from("<HB", raw, at)
        if kind == ord("A"):
            return True
        if kind not in ULOG_DEFINITIONS:
            return False
        at += 3 + size
    return False


def package(name: str, extra: str, path: Path) -> ModuleType:
    """A package that only an extra installs. Raises UsageError with the command that installs it."""
    try:
        return import_module(name)
    except ImportError:
        raise UsageError(f'{path}: needs {name}; `pip install "mahovik[{extra}]"`') from None


READERS: Mapping[str, Callable[[Path, bytes], list[pd.DataFrame]]] = {
    ".csv": read_csv,
    ".parquet": read_parquet,
    ".tdms": read_tdms,
    ".ulg": read_ulog,
}
"""Readers of the formats, by the end of the name."""
