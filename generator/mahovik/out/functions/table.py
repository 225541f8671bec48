"""Results as named columns with units: arrays, data frames, labelled arrays, tables of notebooks, pictures."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from importlib import import_module
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from mahovik.errors import InputError, UsageError
from mahovik.nearest import suggestion
from mahovik.out.api.fields import Array, table

if TYPE_CHECKING:
    from mahovik.out.report.plots import Panel

SHOWN_ROWS = 12
"""Rows of a notebook's table: the first ones, and the last."""


class Column(NamedTuple):
    """One value per row: numbers, or texts, with the unit of all of them ("" for none)."""

    name: str
    unit: str
    values: Array


class Table(ABC):
    """Rows under named columns with units. `index` names the column that the rows are known by.

    `t["phi_dot w1"]` is a column as an array; `len(t)` the number of rows.
    """

    index = ""

    @property
    @abstractmethod
    def columns(self) -> tuple[Column, ...]:
        """The columns in order."""

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the columns."""
        return tuple(column.name for column in self.columns)

    @property
    def units(self) -> dict[str, str]:
        """Units of the columns, by name."""
        return {column.name: column.unit for column in self.columns}

    def __getitem__(self, name: str) -> Array:
        for column in self.columns:
            if column.name == name:
                return column.values
        raise InputError(f"{name!r}: no such column{suggestion(str(name), self.names)}")

    def __len__(self) -> int:
        return len(self.columns[0].values) if self.columns else 0

    def __bool__(self) -> bool:
        return True  # a table without rows is still a result

    def to_pandas(self) -> Any:
        """The rows as a pandas.DataFrame; units stand in `attrs["units"]`. Raises UsageError without pandas."""
        pandas = module("pandas")
        frame = pandas.DataFrame({column.name: column.values for column in self.columns})
        frame.attrs["units"] = self.units
        return frame.set_index(self.index) if self.index else frame

    def to_xarray(self) -> Any:
        """The columns as an xarray.Dataset; each has its unit in `attrs`. Raises UsageError without xarray."""
        xarray = module("xarray")
        rows = self.index or "row"
        found = {
            column.name: (rows, column.values, {"units": column.unit} if column.unit else {}) for column in self.columns
        }
        place = {rows: found.pop(rows)} if self.index else {rows: np.arange(len(self))}
        return xarray.Dataset(found, coords=place)

    def plot(self, axes: Any = None) -> Any:
        """Draw it; the axes of matplotlib, one per panel. `axes`: as many to draw on, or one for the first panel.

        Raises UsageError without matplotlib, InputError for other numbers of axes.
        """
        from mahovik.out.report.plots import draw_on_axes

        return draw_on_axes(self._title, self._panels(), axes)

    @property
    def _title(self) -> str:
        return repr(self).strip("<>")

    def _panels(self) -> Sequence[Panel]:
        """Contents of its picture: columns of numbers over the index, over time, or over the rows."""
        from mahovik.out.report.plots import column_panels

        index = next((each for each in self.columns if each.name in (self.index, "t")), None)
        drawn = [each for each in self.columns if index is None or each.name != index.name]
        if not (len(self) and any(each.values.dtype.kind in "iuf" for each in self.columns)):
            raise UsageError(f"{self._title}: has no rows of numbers to draw")
        return column_panels(index, drawn)

    def _repr_html_(self) -> str:
        head = [f"{column.name}, {column.unit}" if column.unit else column.name for column in self.columns]
        many = len(self) > SHOWN_ROWS
        places = [*range(SHOWN_ROWS - 2), len(self) - 1] if many else range(len(self))
        rows = [[_text(column.values[i]) for column in self.columns] for i in places]
        if many:
            rows.insert(-1, ["…"] * len(head))
        return table(self._title, head, rows, f"{len(self)} rows" if many else "")


def _text(value: Any) -> str:
    return f"{value:.6g}" if isinstance(value, float | np.floating) else str(value)


def module(name: str) -> Any:
    """A library that only some users have. Raises UsageError, with the command that installs it."""
    try:
        return import_module(name)
    except ImportError:
        raise UsageError(f'{name} is not installed: pip install "mahovik[frames]"') from None


def split_unit(text: str) -> tuple[str, str]:
    """Name and unit of "phi w1 [rad]"."""
    name, bracket, unit = text.partition(" [")
    return name, unit.rstrip("]") if bracket else ""
