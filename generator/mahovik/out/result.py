"""What every command answers: named columns with units, what stands beside them, messages, a verdict.

`Result` is plain data. Its table for terminals and notebooks, JSON, files, data frames and pictures are made here and
nowhere else.
"""

from __future__ import annotations

import csv
import dataclasses
import io
import json
import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from itertools import product, zip_longest
from pathlib import Path
from textwrap import wrap
from typing import TYPE_CHECKING, Any, NamedTuple
from unicodedata import east_asian_width

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mahovik.errors import InputError, UsageError, library
from mahovik.nearest import suggestion
from mahovik.signatures import checked

if TYPE_CHECKING:
    from mahovik.out.plots import Panel

Array = NDArray[Any]

SUFFIXES = (".csv", ".json", ".parquet", ".svg", ".png")
"""Ends of the names of files that a result is written to."""

SHOWN = 40
"""Most rows of a table for people; of longer ones the first and the last."""

UNITS: dict[str, tuple[tuple[str, float], ...]] = {
    "kg": (("kg", 1.0), ("g", 1e-3)),
    "kg m": (("g mm", 1e-6), ("mg mm", 1e-9), ("kg mm", 1e-3), ("kg m", 1.0)),
    "kg m2": (("kg m2", 1.0), ("kg cm2", 1e-4), ("g cm2", 1e-7), ("g mm2", 1e-9), ("mg mm2", 1e-12)),
    "m": (("m", 1.0), ("mm", 1e-3), ("um", 1e-6)),
    "m/s": (("m/s", 1.0), ("mm/s", 1e-3), ("um/s", 1e-6)),
    "N": (("N", 1.0), ("mN", 1e-3), ("uN", 1e-6), ("kN", 1e3)),
    "N m": (("N m", 1.0), ("mN m", 1e-3), ("uN m", 1e-6), ("kN m", 1e3)),
    "N m s": (("N m s", 1.0), ("mN m s", 1e-3), ("uN m s", 1e-6)),
    "rad": (("deg", math.pi / 180.0), ("arcsec", math.pi / 648000.0)),
    "rpm": (("rpm", math.pi / 30.0),),
}
"""Units in which numbers of a unit are shown to people, and their size; the first one that fits is taken."""

FITS = 0.1, 1e5
"""A unit fits if the largest figure is at least the first, and below the second."""

ROUNDING = 1e-14
"""Part of the largest part of a vector below which a part is shown as zero."""

CODES = {"bold": "1", "red": "31", "bold red": "1;31", "green": "32", "yellow": "33"}
"""Control characters of styles."""

STYLES = {"ok": "green", "yes": "green", "passed": "green", "FAILED": "bold red", "failed": "bold red", "no": "red"}
"""Styles of words in a table on a terminal."""


class Axis(NamedTuple):
    """What an axis of a column counts: its name, and labels, of which there may be none."""

    name: str
    labels: tuple[Any, ...] = ()


class Column(NamedTuple):
    """Values under a name, one a row; `column` makes it of lists.

    axes     of values with more axes than that of the rows: what these count
    shown    key of `UNITS` for people
    meaning  frame and point of the values
    """

    name: str
    unit: str
    values: Array
    axes: tuple[Axis, ...] = ()
    shown: str = ""
    meaning: str = ""

    @property
    def head(self) -> str:
        """Its name, and the unit behind a comma."""
        return f"{self.name}, {self.unit}" if self.unit else self.name

    def flat(self) -> list[Column]:
        """Each part as a column of its own with its unit: `amplitude x`, `amplitude y`; without parts itself."""
        if not self.axes:
            return [self]
        sizes = self.values.shape[1:]
        units = self.unit.split(", ")  # of a twist: of its linear half, of its angular half
        labels = product(*(axis.labels or range(size) for axis, size in zip(self.axes, sizes, strict=True)))
        return [
            Column(
                " ".join([self.name, *map(str, names)]),
                units[place[-1] * len(units) // sizes[-1]],
                self.values[:, *place],
                (),
                self.shown,
            )
            for place, names in zip(np.ndindex(*sizes), labels, strict=True)
        ]

    def real(self) -> list[Column]:
        """Columns of real numbers: for complex ones two a part, `shape x.real` and `shape x.imag`; else this column."""
        if self.values.dtype.kind != "c":
            return [self]
        pairs = product(self.flat(), ("real", "imag"))
        return [part._replace(name=f"{part.name}.{half}", values=getattr(part.values, half)) for part, half in pairs]

    def part(self, *labels: Any) -> tuple[Any, ...]:
        """The index of the part that labels, numbers or slices name, of an array without rows. Raises InputError."""
        if len(labels) > len(self.axes):
            raise InputError(f"{self.name}: {len(labels)} labels, but it has {len(self.axes)} axes besides the rows")
        result: list[Any] = []
        for k, (axis, label) in enumerate(zip(self.axes, labels, strict=False)):
            if isinstance(label, str) and label not in axis.labels:
                hint = suggestion(label, axis.labels) if axis.labels else ", which has no labels, give a number"
                raise InputError(f'{self.name}: no "{label}" on axis {k}{hint}')
            result.append(axis.labels.index(label) if isinstance(label, str) else label)
        return (Ellipsis, *result, *(slice(None) for _ in self.axes[len(result) :]))


class NoEntryError(InputError, KeyError):
    """A result has no column or entry of this name."""


def column(
    name: str, unit: str, values: ArrayLike | Sequence[float | None], parts: Sequence[str] = (), shown: str = ""
) -> Column:
    """A column of numbers (None becomes NaN) or texts, in SI.

    unit    of all values; "" for none
    values  (rows,), or (rows, parts) with a name for each of `parts`, such as x, y, z
    shown   key of `UNITS` for people: "rpm" for a speed in rad/s; "": that of the unit
    """
    listed = values if isinstance(values, np.ndarray) else list(values)  # type: ignore[arg-type]
    axes = (Axis(f"{name} part", tuple(parts)),) if parts else ()
    if len(listed) and any(isinstance(value, str) for value in listed):
        return Column(name, unit, np.array([str(value) for value in listed], dtype=object), axes, shown)
    array = np.asarray(listed)
    if array.dtype == object:
        array = np.array([np.nan if value is None else value for value in listed], dtype=np.float64)
    return Column(name, unit, array.reshape(-1, len(parts)) if parts else array, axes, shown)


def columns_of(
    rows: Sequence[Any],
    units: Mapping[str, str],
    parts: Mapping[str, Sequence[str]] | None = None,
    shown: Mapping[str, str] | None = None,
) -> tuple[Column, ...]:
    """Columns of attributes, or entries, of `rows`: `units` by their names; `parts`, `shown` as those of `column`."""
    parts, shown = parts or {}, shown or {}
    tables = [row if isinstance(row, Mapping) else {name: getattr(row, name) for name in units} for row in rows]
    return tuple(
        column(name, unit, [row[name] for row in tables], parts.get(name, ()), shown.get(name, ""))
        for name, unit in units.items()
    )


@dataclasses.dataclass(frozen=True, eq=False, repr=False)
class Result(Mapping[str, Any]):
    """The answer of a function: a mapping of the arrays of its columns, by name, and of what stands in `meta`.

    `result["amplitude"]` and `result.amplitude` are the same; `result["amplitude", "x"]` is the part of that label.

    title      one line that says what it is of
    columns    the main table
    rows       key under which JSON has a list with an object a row; "": each column is a list under its own name
    index      column that rows are known by; with `rows`, JSON has an object with a key a row in place of the list
    meta       plain data beside the columns: numbers, texts, lists, mappings, further results
    units      units of entries of `meta`
    messages   sentences for people, printed below the table
    ok         whether the verdict is good: False is exit status 1
    details    entries of `meta` that JSON has and tables for people leave out
    drawings   panels of its picture, `out.plots.Panel`;
               none: the columns of numbers over the index, or over `t`
    single     one row, whose arrays come without the axis of rows; whole: a long table has all its rows in text
    """

    title: str
    columns: Sequence[Column] = ()
    rows: str = ""
    index: str = ""
    meta: Mapping[str, Any] = dataclasses.field(default_factory=dict)
    units: Mapping[str, str] = dataclasses.field(default_factory=dict)
    messages: Sequence[str] = ()
    ok: bool = True
    details: Sequence[str] = ()
    drawings: Sequence[Panel] = ()
    single: bool = False
    whole: bool = False

    def __post_init__(self) -> None:
        if len({*self}) < len(self):
            raise ValueError(f"{self.title}: two columns or entries have one name: {', '.join(self)}")

    def __getitem__(self, key: str | tuple[Any, ...]) -> Any:
        name, *labels = key if isinstance(key, tuple) else (key,)
        for one in self.columns:
            if one.name == name:
                values = one.values[0] if self.single else one.values
                return values[one.part(*labels)] if labels else values
        if name in self.meta:
            return self.meta[name]
        raise NoEntryError(f"{name!r}: no such column or entry{suggestion(str(name), list(self))}")

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_") or name in self.__dataclass_fields__:
            raise AttributeError(name)
        try:
            return self[name]
        except InputError as error:
            raise AttributeError(str(error)) from None

    def __dir__(self) -> list[str]:
        return sorted({*super().__dir__(), *(name for name in self if name.isidentifier())})

    def __contains__(self, key: object) -> bool:
        return key in self.meta or any(one.name == key for one in self.columns)

    def __iter__(self) -> Iterator[str]:
        yield from (one.name for one in self.columns)
        yield from self.meta

    def __len__(self) -> int:
        return len(self.columns) + len(self.meta)

    def __bool__(self) -> bool:
        return True  # what has no rows is still a result

    def __repr__(self) -> str:
        return f"<{self.title or f'Result of {list(self)}'}{'' if self.ok else ': FAILED'}>"

    def __str__(self) -> str:
        return self.text()

    @property
    def count(self) -> int:
        """Number of rows."""
        return len(self.columns[0].values) if self.columns else 0

    def take(self, rows: slice | Sequence[int] | Array, names: Sequence[str], title: str | None = None) -> Result:
        """Some rows of some columns, by number and by name, alone, under the same title or another."""
        columns = [one._replace(values=one.values[rows]) for one in self.columns if one.name in names]
        return Result(self.title if title is None else title, columns)

    # ---- data

    def flat(self) -> list[Column]:
        """The columns, each part of one with parts as a column of its own."""
        return [part for one in self.columns for part in one.flat()]

    def _long(self) -> tuple[list[str], list[Column]]:
        """Names of the columns that rows are known by, and those of a table: a row a moment of each sample.

        Raises UsageError for a result without columns.
        """
        if not self.columns:
            raise UsageError(f"{self.title}: has no table; to_dict() and .json have what it says")
        names = [self.index] if self.index else []
        if len(self.columns) < 2 or not all(one.axes and one.axes[0].name == "t" for one in self.columns[1:]):
            return names, self.flat()
        index, *columns = self.columns
        t = columns[0].axes[0].labels
        result = [index._replace(values=np.repeat(index.values, len(t))), column("t", "s", np.tile(t, self.count))]
        for one in columns:
            values = one.values.reshape(-1, *one.values.shape[2:])
            result += one._replace(values=values, axes=one.axes[1:]).flat()
        return [*names, "t"], result

    def to_dict(self) -> dict[str, Any]:
        """Plain data, as JSON has it: what is not finite is None, a complex number a pair."""
        units = {one.name: one.unit for one in self.columns if one.unit} | dict(self.units)
        result = {key: plain(value) for key, value in self.meta.items()}
        if self.rows:
            result[self.rows] = self._objects()
        else:
            result |= {one.name: plain(self[one.name]) for one in self.columns}
        return {**result, "units": units, "messages": list(self.messages), "ok": bool(self.ok)}

    def _objects(self) -> Any:
        """An object a row."""
        names = [one.name for one in self.columns]
        values = zip(*(plain(one.values) for one in self.columns), strict=True)
        rows = [dict(zip(names, row, strict=True)) for row in values]
        if not self.index or not self.rows:
            return rows
        return {row.pop(self.index): row for row in rows}

    def to_json(self) -> str:
        """JSON text; the same bytes for the same numbers."""
        return json.dumps(self.to_dict(), indent=1, allow_nan=False)

    def to_pandas(self) -> Any:
        """The rows as a pandas.DataFrame; units stand in `attrs["units"]`. Raises UsageError without pandas."""
        names, columns = self._long()
        frame = library("pandas", "frames").DataFrame({one.name: one.values for one in columns})
        frame.attrs["units"] = {one.name: one.unit for one in columns}
        return frame.set_index(names) if names else frame

    def to_xarray(self) -> Any:
        """The columns as an xarray.Dataset, each with its unit in `attrs`. Raises UsageError without xarray."""
        rows: list[str] = [] if self.single else [self.index or "row"]
        result, places, names = {}, dict[str, Any](), {one.name for one in self.columns}
        for one in self.columns:
            dims = [*rows]
            for axis in one.axes:
                name = axis.name if axis.name not in names else f"{axis.name} part"  # it is a column as well
                dims.append(name if name not in dims else f"{name} of {one.name}")
                places |= {dims[-1]: list(axis.labels)} if axis.labels else {}
            more = {"units": one.unit, "long_name": one.meaning}
            result[one.name] = (dims, self[one.name], {key: text for key, text in more.items() if text})
        if rows:
            places[rows[0]] = result.pop(self.index) if self.index else np.arange(self.count)
        return library("xarray", "frames").Dataset(result, coords=places)

    # ---- files

    @checked
    def save(self, path: str | Path) -> None:
        """Write it to a file, by the end of its name: .csv, .json, .parquet, .svg or .png. Raises UsageError."""
        from mahovik.writing import format_of, write

        path = Path(path)
        suffix = format_of(path, SUFFIXES, "path")
        # files know no complex numbers
        table = dataclasses.replace(self, columns=[part for one in self.columns for part in one.real()])
        if suffix == ".json":
            write(path, self.to_json() + "\n")
        elif suffix == ".csv":
            write(path, table._csv())
        elif suffix == ".parquet":
            content = io.BytesIO()
            library("pyarrow", "campaign")
            table.to_pandas().to_parquet(content)
            write(path, content.getvalue())
        else:
            from mahovik.out.plots import draw

            write(path, draw(self.title, self._drawings(), suffix))

    def _csv(self) -> str:
        text, (_, columns) = io.StringIO(), self._long()
        lines = csv.writer(text, lineterminator="\n")
        lines.writerow([f"{one.name} [{one.unit}]" if one.unit else one.name for one in columns])
        lines.writerows(zip(*(one.values.tolist() for one in columns), strict=True))
        return text.getvalue()

    def plot(self, ax: Any = None) -> Any:
        """Draw it, and return the axes of matplotlib; None: on a new figure with all panels.

        ax  one axes, for the first panel, or a list, for as many panels

        Raises UsageError without matplotlib, or where more axes are given than there are panels.
        """
        from mahovik.out.plots import draw_on_axes

        result = draw_on_axes(self.title, self._drawings(), ax)
        return result if ax is None else ax

    def _drawings(self) -> Sequence[Panel]:
        from mahovik.out.plots import column_panels

        if self.drawings:
            return self.drawings
        columns = [(one.name, one.unit, one.values) for one in self.flat() if one.values.dtype.kind in "iuf"]
        index = next((one for one in columns if one[0] in (self.index, "t", "step") and len(one[2])), None)
        if index is None or len(columns) < 2:
            raise UsageError(f"{self.title}: no picture shows it, expected .csv, .json or .parquet")
        if len(columns) > SHOWN and index[0] != "t":
            words = f"{len(columns)} columns are too many to draw; result.take(rows, names) has fewer"
            raise UsageError(f"{self.title}: {words}")
        return column_panels(index, [one for one in columns if one[0] != index[0]])

    # ---- text

    def text(self, width: int | None = None, styles: bool = False) -> str:
        """The table for people, what stands beside it, and the messages.

        width   columns of the terminal, where long cells are folded; None: nothing is folded
        styles  with the control characters that give colours
        """
        paint, width = painted if styles else lambda text, _: text, width or 10_000
        lines = [paint(line, "bold") for line in folded(self.title, width) if self.title]
        for title, table in self._tables():
            lines += table._table_lines(title, width, paint)
        for message in (*self._lines(), *self.messages):
            lines += [paint(line, "yellow" * message.startswith("warning")) for line in folded(message, width)]
        return "".join(f"{line}\n" for line in lines)

    def _tables(self) -> Iterator[tuple[str, Result]]:
        """The main table and those of `meta`, with their titles."""
        if self.columns:
            yield "", self
        shown = {key: value for key, value in self.meta.items() if key not in self.details}
        tables = {key: value for key, value in shown.items() if isinstance(value, Result) and value.count}
        alone = len(tables) == 1 and not self.columns
        for key, value in tables.items():
            yield value.title or ("" if alone else key_words(key)), value

    def _table_lines(self, title: str, width: int, paint: Callable[[str, str], str]) -> Iterator[str]:
        """The lines of its table; between two columns there are three spaces."""
        heads, rows, numbers = self.cells()
        columns = zip(heads, *rows, strict=True)
        widths = [max(columns_of_text(line) for cell in column for line in cell.split("\n")) for column in columns]
        while sum(widths) > max(width - 3 * len(widths) + 1, len(widths)):  # the widest gives way
            widths[widths.index(max(widths))] -= 1
        yield from [*(paint(line, "bold") for line in folded(title, width) if title), ""]
        if not heads:
            return
        for row in (heads, *rows):
            cells = [folded(cell, most) for cell, most in zip(row, widths, strict=True)]
            styles = ["bold" if row is heads else STYLES.get(cell, "") for cell in row]
            for parts in zip_longest(*cells, fillvalue=""):
                spaces = [" " * (most - columns_of_text(part)) for part, most in zip(parts, widths, strict=True)]
                texts = zip(map(paint, parts, styles), spaces, numbers, strict=True)
                yield " " + "   ".join(space + text if right else text + space for text, space, right in texts).rstrip()
            if row is heads:
                yield " " + "─" * (sum(widths) + 3 * len(widths) - 3)
        yield ""

    def cells(self) -> tuple[list[str], list[list[str]], list[bool]]:
        """Heads with units, the cells of the rows that are shown, and which columns are of numbers.

        Of arrays with more axes than one has in a table, and of a single row, there is a row an array.
        """
        shown = [fitted(one) for one in self.columns if one.name not in self.details]
        if self.single or any(one.values.ndim > 2 for one in shown):
            return ["name", "shape", "unit", "values", "meaning"], [self._about(one) for one in shown], [False] * 5
        columns = [part for one in shown for part in one.flat()]
        heads = [key_words(one.head) for one in columns]
        places: list[int | None] = [*range(self.count)]
        if self.count > SHOWN and not self.whole:
            places = [*range(SHOWN - 10), None, *range(self.count - 9, self.count)]
        rows = [["..." if i is None else cell_text(one.values[i]) for one in columns] for i in places]
        return heads, rows, [one.values.dtype.kind in "iufc" for one in columns]

    def _about(self, one: Column) -> list[str]:
        """Name, shape, unit, numbers or their range, and meaning of the arrays of a column."""
        values = one.values[0] if self.single else one.values
        if values.size <= 12:
            words = ", ".join(map(cell_text, np.ravel(values)))
        else:
            good = values[np.isfinite(values)]
            words = f"{good.min():.4g} … {good.max():.4g}" if good.size else "not finite"
            words += f", {values.size - good.size} not finite" if 0 < good.size < values.size else ""
        return [one.name, " × ".join(map(str, np.shape(values))) or "number", one.unit, words, one.meaning]

    def _lines(self) -> Iterator[str]:
        """Entries of `meta` that are a number, a text or a short list of them, a line each."""
        for key, value in self.meta.items():
            if key in self.details or value is None or isinstance(value, Result | Mapping):
                continue
            parts = list(value) if isinstance(value, list | tuple | np.ndarray) else [value]
            texts = all(isinstance(part, str) for part in parts)
            if not parts or not (texts or (len(parts) <= 6 and all(isinstance(x, int | float) for x in parts))):
                continue
            one = Column(key, self.units.get(key, ""), np.array(parts, dtype=object))
            if not texts and not any(isinstance(part, bool | int) for part in parts):
                one = fitted(one._replace(values=np.array([parts], dtype=np.float64)))
            words = (", " if texts else "  ").join(map(cell_text, np.ravel(one.values)))
            yield f"{key_words(key)}: {words} {one.unit}".rstrip()

    def _repr_html_(self) -> str:
        from html import escape

        parts = [f"<div><strong>{escape(self.title)}</strong></div>"]
        for one in (self, *(value for key, value in self.meta.items() if isinstance(value, Result))):
            if one.columns:
                heads, rows, _ = one.cells()
                head = "".join(f"<th>{escape(text)}</th>" for text in heads)
                body = "".join(f"<tr>{''.join(f'<td>{escape(cell)}</td>' for cell in row)}</tr>" for row in rows)
                parts.append(f"<table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>")
        parts += [f"<div>{escape(line)}</div>" for line in (*self._lines(), *self.messages)]
        return "".join(parts)


def painted(text: str, style: str) -> str:
    """A text with the control characters of a style; as it is without one."""
    return f"\x1b[{CODES[style]}m{text}\x1b[0m" if style and text else text


def columns_of_text(text: str) -> int:
    """Columns of a terminal that a line takes."""
    return len(text) if text.isascii() else sum(1 + (east_asian_width(sign) in "WF") for sign in text)


def folded(text: str, width: int) -> list[str]:
    """The lines of a text, none longer than the width, broken between words where that can be."""
    lines = text.split("\n")
    if all(columns_of_text(line) <= width for line in lines):
        return lines
    return [part for line in lines for part in wrap(line, max(width, 1)) or [""]]


def key_words(key: str) -> str:
    """A key as words of a heading."""
    return key.replace("_", " ").replace("center", "centre")


def plain(value: Any) -> Any:
    """Plain data for JSON: arrays as lists, complex numbers as pairs, None for what is not finite."""
    if isinstance(value, Result):
        return value._objects()
    if isinstance(value, Mapping):
        return {str(key): plain(part) for key, part in value.items()}
    if isinstance(value, list | tuple | set | frozenset):
        return [plain(part) for part in value]
    if isinstance(value, np.ndarray | np.generic):
        return plain(value.tolist())
    if isinstance(value, complex):
        return [plain(value.real), plain(value.imag)]
    if isinstance(value, float):
        return value if math.isfinite(value) else None
    if dataclasses.is_dataclass(value) and not isinstance(value, type):
        return {field.name: plain(getattr(value, field.name)) for field in dataclasses.fields(value)}
    return str(value) if isinstance(value, Path) else value


def split_unit(text: str) -> tuple[str, str]:
    """Name and unit of the head of a column, "phi w1 [rad]"."""
    name, bracket, unit = text.partition(" [")
    return name, unit.rstrip("]") if bracket else ""


def cell_text(value: Any) -> str:
    """A number with six digits, or a text; "-" for what is missing."""
    if value is None:
        return "-"
    if isinstance(value, bool | np.bool_):
        return "yes" if value else "no"
    if isinstance(value, complex | np.complexfloating):
        return f"{value:.4g}"
    if isinstance(value, float | np.floating):
        return f"{value + 0.0:.6g}" if math.isfinite(value) else "-"
    return str(value)


def quantity_text(value: float, unit: str) -> str:
    """A number of an SI unit in the unit for people: "3.56 mm" of 0.00356 and "m"."""
    one = fitted(Column("", unit, np.array([value], dtype=np.float64)))
    return f"{one.values[0]:.6g} {one.unit}"


def fitted(one: Column) -> Column:
    """A column in the unit for people; the part of a vector that is rounding of its largest part is zero."""
    unit = _unit_that_fits(one)
    if one.values.ndim > 1 and one.values.dtype.kind == "f":
        size = np.abs(one.values)
        dust = size < ROUNDING * np.max(size, axis=-1, keepdims=True, initial=0.0, where=np.isfinite(size))
        one = one._replace(values=np.where(dust, 0.0, one.values))
    return one if unit is None else one._replace(unit=unit[0], values=one.values / unit[1])


def _unit_that_fits(one: Column) -> tuple[str, float] | None:
    """The first unit in which the largest figure is of a readable size; None where the column's own stays."""
    units = UNITS.get(one.shown or one.unit)
    if units is None or one.values.dtype.kind not in "iuf":
        return None
    largest = float(np.nanmax(np.abs(one.values), initial=0.0)) if one.values.size else 0.0
    if not math.isfinite(largest) or largest == 0.0:
        return units[0]
    fitting = [unit for unit in units if FITS[0] <= largest / unit[1] < FITS[1]]
    if fitting:
        return fitting[0]
    return min(units, key=lambda unit: abs(math.log(largest / unit[1])))
