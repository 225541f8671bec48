"""A file of names: what columns of other programs mean on the stand, as TOML among the files of data.

    [names]
    "sensor_combined.gyro_rad[0]" = "imu.rate.x [rad/s]"
    [counts]
    w1 = 4096

`counts`: counts per turn of encoders that neither a unit nor the stand file states.
"""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

from mahovik.core.stand.units import show
from mahovik.errors import DataError
from mahovik.nearest import suggestion

KEYS = ("names", "counts")


@dataclass(frozen=True)
class Names:
    """Headers by the name of a column in a file, and counts per turn by flywheel."""

    names: Mapping[str, str] = field(default_factory=dict)
    counts: Mapping[str, int] = field(default_factory=dict)


def read_names(path: Path, content: bytes) -> Names:
    """The names of a file. Raises DataError."""
    try:
        raw = tomllib.loads(content.decode("utf-8"))
    except (UnicodeDecodeError, tomllib.TOMLDecodeError) as error:
        raise DataError([f"{path}: no TOML: {error}"]) from None
    problems = [f"{path}: unknown key {show(key)}{suggestion(key, KEYS)}" for key in raw if key not in KEYS]
    tables = {key: raw.get(key, {}) for key in KEYS}
    problems += [f"{path}: {key}: expected a table" for key, table in tables.items() if not isinstance(table, dict)]
    if not problems:
        problems += [
            f'{path}: names."{key}": expected a header such as "acc1.rate.x [rad/s]"'
            for key, value in tables["names"].items()
            if not isinstance(value, str)
        ]
        problems += [
            f"{path}: counts.{key}: expected a whole number of counts per turn, not zero"
            for key, value in tables["counts"].items()
            if isinstance(value, bool) or not isinstance(value, int) or value == 0
        ]
    if problems:
        raise DataError(problems)
    return Names(tables["names"], tables["counts"])
