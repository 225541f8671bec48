"""Files of measured data as recordings of a stand: each format read, each channel matched, each fault reported."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from pathlib import Path

import numpy as np

from mahovik.core.stand.content import TABLE, content
from mahovik.core.stand.model import Stand
from mahovik.errors import DataError
from mahovik.nearest import suggestion
from mahovik.use.measured.drops import mark_drops
from mahovik.use.measured.files.csv_file import read_csv
from mahovik.use.measured.files.parquet_file import read_parquet
from mahovik.use.measured.files.table import Table
from mahovik.use.measured.files.tdms_file import read_tdms
from mahovik.use.measured.files.ulog_file import read_ulog
from mahovik.use.measured.flywheels import channels_of
from mahovik.use.measured.join import join
from mahovik.use.measured.names import Names, read_names
from mahovik.use.measured.quantities import HeaderError, Name, is_time, name_of, time_scale
from mahovik.use.measured.recording import Array, Recording
from mahovik.use.measured.simulated_run import NOTE as RUN
from mahovik.use.measured.simulated_run import is_run, is_state, run_header
from mahovik.use.measured.times import order_times, split_runs
from mahovik.use.measured.track import Track

READERS: Mapping[str, Callable[[Path, bytes], list[Table]]] = {
    ".csv": read_csv,
    ".parquet": read_parquet,
    ".tdms": read_tdms,
    ".ulg": read_ulog,
}
"""Readers of the formats, by the end of the name."""

PARTS = (".ulg",)
"""Formats of whole vehicles: columns without a name of the stand are counted, not reported one by one."""

FEWEST = 4
"""Samples that a recording has at least."""

IMU = {
    **{f"sensor_combined.gyro_rad[{k}]": f"rate.{axis} [rad/s]" for k, axis in enumerate("xyz")},
    **{f"sensor_combined.accelerometer_m_s2[{k}]": f"acceleration.{axis} [m/s2]" for k, axis in enumerate("xyz")},
}
"""Fields of PX4 that are known without a file of names, of a stand with one point."""


def read_recordings(paths: Iterable[Path], stand: Stand) -> tuple[Recording, ...]:
    """The runs of some files of measured data (CSV, Parquet, TDMS, ULog; TOML with names), matched to a stand.

    Raises DataError with a line for each file that cannot be used; UsageError: a package of an extra is missing.
    """
    contents = {Path(path): _content(Path(path)) for path in paths}
    names = _names(contents)
    data = {path: content for path, content in contents.items() if path.suffix.lower() != ".toml"}
    if not data:
        raise DataError([f"no file of data, expected {', '.join(READERS)}"])
    unknown = [f"counts.{each}{suggestion(each, [w.name for w in stand.flywheels])}" for each in names.counts
               if each not in {w.name for w in stand.flywheels}]  # fmt: skip
    if unknown:
        raise DataError([f"file of names: the stand has no such flywheel: {unknown[0]}"])
    found: list[tuple[str, Recording]] = []
    left: list[str] = []
    for path, bytes_ in data.items():
        for table in READERS[path.suffix.lower()](path, bytes_):
            for track in _tracks(path, table, stand, names):
                recording = _recording(track, stand, names)
                if recording.channels:
                    found.append((str(path), recording))
                else:
                    left += recording.notes
    if not found:
        raise DataError([*_some(left), f"{', '.join(map(str, data))}: no channel of the stand {stand.name} is left"])
    joined = join(found)
    if left:
        first = joined[0]
        joined = (Recording(first.t, first.channels, first.source, (*first.notes, *left)), *joined[1:])
    return joined


def read_tables(path: Path) -> list[Table]:
    """The tables of one file of data, as it has them. Raises DataError."""
    return READERS[path.suffix.lower()](path, _content(path))


def _some(lines: list[str], most: int = 20) -> list[str]:
    return lines if len(lines) <= most else [*lines[:most], f"... and {len(lines) - most} more lines like these"]


def _content(path: Path) -> bytes:
    """Read a file as bytes, if the end of its name is that of a known format. Raises DataError."""
    known = (*READERS, ".toml")
    if path.suffix.lower() not in known:
        raise DataError([f'{path}: unknown format "{path.suffix}", expected {", ".join(known)}'])
    try:
        return content(path, TABLE)
    except FileNotFoundError as error:
        raise DataError([f"{path}: {error.strerror}"]) from None
    except IsADirectoryError:
        raise DataError([f"{path}: is a directory, expected a file of data"]) from None
    except OSError as error:
        raise DataError([f"{path}: cannot be read: {error.strerror or error}"]) from None


def _names(contents: Mapping[Path, bytes]) -> Names:
    """All names of the files of names among the files."""
    headers: dict[str, str] = {}
    counts: dict[str, int] = {}
    for path, bytes_ in contents.items():
        if path.suffix.lower() == ".toml":
            found = read_names(path, bytes_)
            headers |= found.names
            counts |= found.counts
    return Names(headers, counts)


def _tracks(path: Path, table: Table, stand: Stand, names: Names) -> list[Track]:
    """The runs of a table, with what the stand knows of its channels. A table without time has none."""
    notes = list(table.notes)
    times = [header for header in table.columns if is_time(names.names.get(header, header))]
    run = is_run(table.columns)
    if run:
        notes.append(RUN)
    matched, scale, others = _match(table, stand, names, notes, run or path.suffix.lower() in PARTS)
    if path.suffix.lower() in PARTS and not matched:
        return []
    if not times:
        notes.append("no column of time, expected `time [s]`: left out")
        return [Track(table.source, np.zeros(0), {}, notes)]
    if len(times) > 1:
        notes.append(f'two columns of time: "{times[0]}" is taken, "{times[1]}" is left out')
    if others and not run:
        notes.append(f"{others} other columns have no name of the stand: left out")
    header = names.names.get(times[0], times[0])
    try:
        t = table.columns[times[0]] * time_scale(header)
    except HeaderError as error:
        notes.append(f"{error}: left out")
        return [Track(table.source, np.zeros(0), {}, notes)]
    return split_runs(Track(table.source, t, {n: x * scale[n] for n, x in matched.items()}, notes))


def _match(
    table: Table, stand: Stand, names: Names, notes: list[str], counted: bool
) -> tuple[dict[Name, Array], dict[Name, float], int]:
    """Columns of a table by their name on the stand, its unit in SI, and the number of others if they are counted."""
    matched: dict[Name, Array] = {}
    scale: dict[Name, float] = {}
    others = 0
    for column, values in table.columns.items():
        header = names.names.get(column, _own_header(column, stand, notes) if counted else column)
        if header is None:
            others += 1
            if RUN in notes and not is_state(column):
                notes.append(f'"{column}" is no column of a run, and has no name of the stand: left out')
            continue
        if is_time(header):
            continue
        try:
            name = name_of(header, stand)
        except HeaderError as error:
            notes.append(f"{error}: left out")
            continue
        if any(each.label == name.label for each in matched):
            notes.append(f"{name.label}: stands twice: the first is taken")
            continue
        matched[name], scale[name] = values, name.scale
    return matched, scale, others


def _own_header(column: str, stand: Stand, notes: list[str]) -> str | None:
    """Header of a column of a run, or of a field of PX4; None where it is not known."""
    if RUN in notes:
        return run_header(column)
    if column not in IMU and not column.startswith("time"):
        return None
    if column.startswith("time"):
        return column
    if len(stand.points) != 1:
        return None
    name = stand.points[0].name
    note = f"sensor_combined is taken for the one point {name}"
    if note not in notes:
        notes.append(note)
    return f"{name}.{IMU[column]}"


def _recording(track: Track, stand: Stand, names: Names) -> Recording:
    """A track checked and corrected; without channels where nothing is left."""
    channels = []
    if track.values and len(track.t) >= FEWEST:
        track = order_times(track)
    if track.values and len(track.t) < FEWEST:
        track.notes.append(f"{len(track.t)} samples, expected {FEWEST} or more: left out")
    elif track.values:
        channels = channels_of(mark_drops(track), stand, names.counts)
    notes = tuple(f"{track.source}: {note}" for note in track.notes)
    return Recording(track.t, tuple(channels), track.source, notes)
