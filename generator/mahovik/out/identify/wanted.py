"""Free numbers and known delays: `--free KEYS|FREE.toml`, paths of the stand file and known delays of sensors."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated, Any

from pydantic import Field

from mahovik.core.motion.document import document_of, text_of
from mahovik.core.stand.content import TABLE
from mahovik.core.stand.fields import Table
from mahovik.core.stand.problems import Problems
from mahovik.core.stand.units import TIME, QuantityError, number
from mahovik.errors import DataError


class FreeFile(Table):
    """Keys of FREE.toml. `delay`: time by which a sensor reports late, by its point, s or a text with a unit."""

    free: Annotated[list[str], Field(min_length=1)]
    delay: Annotated[dict[str, Any], Field(default_factory=dict)]


@dataclass(frozen=True)
class Wanted:
    """Paths that are free, and known delays of points, s."""

    paths: tuple[str, ...]
    delays: dict[str, float] = field(default_factory=dict)


def wanted_of(text: str) -> Wanted:
    """Paths separated by commas, or those of a file that ends in .toml. Raises DataError."""
    if not text.endswith(".toml"):
        return Wanted(tuple(each.strip() for each in text.split(",") if each.strip()))
    problems = Problems(text)
    document = document_of(text_of(Path(text), TABLE, DataError), text, DataError, is_json=False)
    table = problems.valid(FreeFile, document)
    delays: dict[str, float] = {}
    if table is not None:
        for point, value in table.delay.items():
            try:
                delays[point] = number(value, TIME)
            except QuantityError as error:
                problems.add(f"delay.{point}: {error}")
    if table is None or problems.lines:
        raise DataError(problems.lines)
    return Wanted(tuple(table.free), delays)
