"""NI TDMS, by nptdms: each group is a table; its time is a channel `time [s]` or that of its waveforms.

The unit of a channel stands in its name, or in its property `unit_string`. Channels of one group whose waveforms have
another step or start are tables of their own. Waveforms begin `wf_start_offset` after their `wf_start_time`,
which counts from the earliest of the file.
"""

from __future__ import annotations

import io
from collections import defaultdict
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from mahovik.errors import DataError
from mahovik.use.measured.files.table import Table, package
from mahovik.use.measured.quantities import is_time
from mahovik.use.measured.recording import Array

ZERO = np.datetime64("1904-01-01T00:00:00")
"""Zero of times in TDMS; a waveform that begins there has no start."""


def read_tdms(path: Path, content: bytes) -> list[Table]:
    """The groups of a TDMS file. Raises DataError; UsageError without nptdms."""
    nptdms = package("nptdms", "tdms", str(path))
    try:
        found = nptdms.TdmsFile.read(io.BytesIO(content))
    except (ValueError, KeyError, EOFError, OSError, IndexError, TypeError, OverflowError, MemoryError) as error:
        raise DataError([f"{path}: cannot be read as TDMS: {error}"]) from None
    groups = {f"{path}: {group.name}": group.channels() for group in found.groups()}
    waves = [c for channels in groups.values() for c in channels if _step(c) > 0.0]
    starts = [start for c in waves if (start := _start(c)) is not None]
    earliest = min(starts, default=None)
    tables = [table for source, channels in groups.items() for table in _tables(source, channels, earliest)]
    if tables and 0 < len(starts) < len(waves):
        lacking = f"{len(waves) - len(starts)} of {len(waves)} waveforms have no wf_start_time"
        note = f"{lacking}: taken as that of the earliest"
        tables[0] = replace(tables[0], notes=(*tables[0].notes, note))
    return tables


def _step(channel: Any) -> float:
    return float(channel.properties.get("wf_increment", 0.0))


def _start(channel: Any) -> np.datetime64 | None:
    """Time at which a waveform begins; None where it is not given, or is the zero of the format."""
    start = channel.properties.get("wf_start_time")
    return start if isinstance(start, np.datetime64) and start > ZERO else None  # NaT is above nothing


def _tables(source: str, channels: list[Any], earliest: np.datetime64 | None) -> list[Table]:
    """Tables of a group: one with the channel of time, or one for each step and start of its waveforms."""
    notes, numbers = [], {}
    steps: dict[str, tuple[float, float, int]] = {}
    for channel in channels:
        unit = channel.properties.get("unit_string", "")
        header = channel.name if "[" in channel.name or not unit else f"{channel.name} [{unit}]"
        values = np.asarray(channel[:])
        if values.dtype.kind not in "fiub":
            notes.append(f'"{header}" holds no numbers: left out')
            continue
        numbers[header] = values.astype(np.float64)
        first, start = float(channel.properties.get("wf_start_offset", 0.0)), _start(channel)
        if start is not None and earliest is not None:
            first += float((start - earliest) / np.timedelta64(1, "s"))
        steps[header] = first, _step(channel), len(values)
    timed = next((header for header in numbers if is_time(header)), None)
    if timed is not None:
        length = len(numbers[timed])
        notes += [
            f'"{h}" has {len(x)} samples, the time {length}: left out' for h, x in numbers.items() if len(x) != length
        ]
        return [Table(source, {h: x for h, x in numbers.items() if len(x) == length}, tuple(notes))]
    grouped: dict[tuple[float, float, int], dict[str, Array]] = defaultdict(dict)
    for header, values in numbers.items():
        first, step, length = steps[header]
        if step <= 0.0:
            notes.append(f'"{header}" has no time: no channel `time [s]` and no property wf_increment: left out')
            continue
        grouped[first, step, length][header] = values
    tables = [
        Table(
            source,
            {"time [s]": np.asarray(first + step * np.arange(length), dtype=np.float64), **columns},
            tuple(notes) if k == 0 else (),
        )
        for k, ((first, step, length), columns) in enumerate(grouped.items())
    ]
    return tables or ([Table(source, {}, tuple(notes))] if notes else [])
