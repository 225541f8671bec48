"""The part of a law about the stand file: its tables, and its part of identities and of written files."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from mahovik.core.stand.fields import Table
from mahovik.core.stand.model import TWIST_LETTERS, Hold, LawData, Mat6, Stand
from mahovik.core.stand.units import Dimension

Note = Callable[..., None]
"""Notes a problem of the file: the parts of the key path, the last the reason."""

TablesByKey = Mapping[str, Sequence[Any]]
"""The valid tables of a stand file by key: one of `[key]`, any number of `[[key]]`."""


@dataclass(frozen=True)
class HoldNumber:
    """A number of a hold, in SI: `of` says of what, such as "friction of yaw"; `value` three numbers of a vector."""

    of: str
    name: str
    value: float | tuple[float, float, float]
    unit: str

    @property
    def printed(self) -> tuple[tuple[float, ...], str]:
        """The numbers and their unit as people read them: angles in degrees."""
        values = self.value if isinstance(self.value, tuple) else (self.value,)
        return (tuple(map(math.degrees, values)), "deg") if self.unit == "rad" else (values, self.unit)


def negative_diagonal(where: str, matrix: Mat6 | None, does: str) -> list[str]:
    """A warning, in a list, of what is negative on the diagonal of a damping or a stiffness, and of what it `does`."""
    diagonal = () if matrix is None else [(letter, matrix[i][i]) for i, letter in enumerate(TWIST_LETTERS)]
    negative = ", ".join(f"{value:.5g} for {letter}" for letter, value in diagonal if value < 0.0)
    return [f"{where} has {negative}: {does}"] if negative else []


DRIVES = "it drives where it should brake; coefficients that damp are positive"
PUSHES = "it pushes away where it should pull back; what pulls back is positive"


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
    held        `[[hold.key]]`: tables of the hold, each about one of its freedoms
    read_held   makes the data of these, and notes their problems; None where they do nothing
    dimension_of  of a number of one of these tables by its key, which is that of the freedom; None: it is no number
    """

    data: type[LawData]
    read: Callable[[Any, TablesByKey], LawData | None]
    lines: Callable[[Any], tuple[list[str], list[str]]]
    content: Callable[[Any], dict[str, Any]]
    structure: Callable[[Any, Stand], dict[str, Any]]
    header: type[Table] | None = None
    tables: Mapping[str, type[Table]] = field(default_factory=dict)
    arrays: Mapping[str, type[Table]] = field(default_factory=dict)
    mounted: tuple[str, ...] = ()
    held: Mapping[str, type[Table]] = field(default_factory=dict)
    read_held: Callable[[TablesByKey, Hold, Note], LawData | None] = lambda given, hold, note: None
    dimension_of: Callable[[str, Any, Hold], Dimension | None] = lambda key, table, hold: None


@dataclass(frozen=True)
class BodyLawSchema:
    """One law in the tables of bodies: SCHEMA of the module `schema` of its folder.

    data       class of its raw data
    key        its key in the table of a body, or in the stand where it is `mounted`
    table      what that key takes
    read       makes the data of the valid table, or of the list of those mounted on a body; None where it does nothing
    lines      the data as lines of a stand file: what stands in the table of the key; each of the tables of one mounted
    structure  what of all bodies decides the text of the C, by key
    problem    key and words of what a body lacks for its data; None where it lacks nothing
    limited    members that the emitted C takes up to a largest size only
    optional   is the key missing in the identity of a stand's physics where no body has the law?
    mounted    are its tables `[[key]]` of the file, each with a name and a `mount`, the carrier or an instrument?
    """

    data: type[LawData]
    key: str
    table: type[Table]
    read: Callable[[Any], LawData | None]
    lines: Callable[[Any], list[str]]
    structure: Callable[[Stand], dict[str, Any]]
    limited: tuple[str, ...] = ()
    optional: bool = False
    mounted: bool = False
    problem: Callable[[Any, Any], tuple[str, str] | None] = lambda body, data: None
