"""An input that a law takes in the table: one number of each fin, of each propeller."""

from __future__ import annotations

from dataclasses import dataclass

from mahovik.core.program.types import NamedCount


@dataclass(frozen=True)
class RunTimeInput:
    """A number of every struct of one array of the table that the caller may set at run time.

    array, member  its place, `table.fin[k].deflection`
    limit          largest magnitude: a number, or the name of a bound of the C, such as MAX_SPEED
    count          length of the array
    names          names in the stand file, in the order of the array
    prefix         enumerators of the indices are this and the name in capitals
    words          "deflection of every fin"
    """

    array: str
    member: str
    limit: float | str
    count: NamedCount
    names: tuple[str, ...]
    prefix: str
    words: str
