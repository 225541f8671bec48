"""What the folder of a law says of the stand file: its tables, and its part of identities and of written files."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from mahovik.core.stand.fields import Table
from mahovik.core.stand.model import LawData, Stand

Given = Mapping[str, Sequence[Any]]
"""The valid tables of a stand file by key: one of `[key]`, any number of `[[key]]`."""


@dataclass(frozen=True)
class LawSchema:
    """One law in the stand file.

    data        class of its raw data
    read        makes the data of the valid header and tables; None where they do nothing
    lines       the data as lines of a stand file: those of the header, and those of the tables
    content     the data, or None, as the identity of the physics has them, by key
    structure   what of the data, or of None, decides the text of the C, by key
    header      keys outside any table
    tables      `[key]`
    arrays      `[[key]]`
    mounted     those of the arrays whose items have a name and a `mount`, the carrier or an instrument
    """

    data: type[LawData]
    read: Callable[[Any, Given], LawData | None]
    lines: Callable[[Any], tuple[list[str], list[str]]]
    content: Callable[[Any], dict[str, Any]]
    structure: Callable[[Any, Stand], dict[str, Any]]
    header: type[Table] | None = None
    tables: Mapping[str, type[Table]] = field(default_factory=dict)
    arrays: Mapping[str, type[Table]] = field(default_factory=dict)
    mounted: tuple[str, ...] = ()


def keys_of(table: type[Table]) -> list[str]:
    """The keys that a table may have."""
    return [info.alias or name for name, info in table.model_fields.items()]
