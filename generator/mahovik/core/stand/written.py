"""Numbers of a stand file as they are written, with their units, beside what they are in SI."""

from __future__ import annotations

import typing
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from pydantic import BaseModel

from mahovik.contract.laws import parts
from mahovik.core.stand.fields import QuantityValidator, Table, written
from mahovik.core.stand.law import with_laws
from mahovik.core.stand.schema import CarrierTable, FlywheelTable, InstrumentTable
from mahovik.core.stand.toml import parse
from mahovik.core.stand.units import Dimension, number


@dataclass(frozen=True)
class Written:
    """One number with a unit: `where` is the body's name or the table, `key` the path in it, `value` in `unit`, SI."""

    where: str
    key: str
    text: str
    value: float
    unit: str


def written_numbers(path: str | Path) -> list[Written]:
    """All numbers with units of a valid stand file, outside lists, in its order."""
    document = parse(Path(path).read_text(encoding="utf-8-sig"))
    laws = [part.SCHEMA for part in parts("schema")]
    tables: dict[str, type[Table]] = {
        "carrier": with_laws(CarrierTable),
        "instrument": with_laws(InstrumentTable),
        "flywheel": with_laws(FlywheelTable),
    }
    for law in laws:
        tables |= {**law.tables, **law.arrays}
    found: list[Written] = []
    for key, table in tables.items():
        items = document.get(key, [])
        for k, item in enumerate(items if isinstance(items, list) else [items]):
            where = item.get("name", f"{key}[{k}]" if isinstance(items, list) else key)
            found += _of_table(item, table, where)
    return found


def _of_table(raw: dict[str, Any], table: type[BaseModel], where: str, path: str = "") -> Iterator[Written]:
    for key, value in raw.items():
        field = table.model_fields.get(key)
        if field is None:
            continue
        dimension, inner = _parts_of((field.annotation, *field.metadata))
        text = written(value)
        if text is not None and dimension is not None:
            yield Written(where, path + key, text, number(value, dimension), dimension.si)
        elif inner is not None and isinstance(value, dict):
            yield from _of_table(value, inner, where, f"{path}{key}.")


def _parts_of(annotations: tuple[Any, ...]) -> tuple[Dimension | None, type[BaseModel] | None]:
    """Dimension and table in the annotation of a field, each None where it has none."""
    for each in annotations:
        if isinstance(each, QuantityValidator) and each.dimension is not None:
            return each.dimension, None
        if isinstance(each, type) and issubclass(each, BaseModel):
            return None, each
        found = _parts_of(typing.get_args(each))
        if found != (None, None):
            return found
    return None, None
