"""What arrays of states and results hold: names, units, meanings, labels; and how notebooks show them."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from html import escape
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mahovik.core.program.arrays import Member
from mahovik.core.stand.identity import identities
from mahovik.core.stand.laws import carrier_laws
from mahovik.core.stand.model import TWIST_LETTERS, WRENCH_LETTERS, Stand
from mahovik.core.stand.summary import summarize
from mahovik.core.stand.units import show
from mahovik.errors import InputError
from mahovik.nearest import suggestion

Array = NDArray[Any]
Labels = tuple[str, ...]

_AXES = ("x", "y", "z")
_RATES = ("x", "y", "z", "psi", "theta", "phi")
_BODY = ("mass", "x", "y", "z", "J11", "J22", "J33", "J12", "J13", "J23")
_BY_NAME: Mapping[str, tuple[Labels, ...]] = {
    "position": (_AXES,),
    "attitude": (("w", "x", "y", "z"),),
    "V": (TWIST_LETTERS,),
    "V_dot": (TWIST_LETTERS,),
    "F": (WRENCH_LETTERS,),
    "residual": (WRENCH_LETTERS,),
    "reaction": (WRENCH_LETTERS,),
    "K": (WRENCH_LETTERS, TWIST_LETTERS),
    "K_dot": (WRENCH_LETTERS, TWIST_LETTERS),
    "M": (WRENCH_LETTERS, TWIST_LETTERS),
    "I": (WRENCH_LETTERS,),
    "J": (WRENCH_LETTERS,),
    "center_of_mass": (_AXES,),
    "center_of_mass_velocity": (_AXES,),
    "twist": (TWIST_LETTERS,),
    "specific_force": (_AXES,),
    "angular_acceleration": (_AXES,),
    "q_dot": (_RATES,),
    "q_ddot": (_RATES,),
    "V_dot_V": (TWIST_LETTERS, TWIST_LETTERS),
    "V_dot_phi": (TWIST_LETTERS,),
    "V_dot_phi_dot": (TWIST_LETTERS,),
    "V_dot_phi_ddot": (TWIST_LETTERS,),
    "V_dot_tau": (TWIST_LETTERS,),
    "Y_carrier": (WRENCH_LETTERS, _BODY),
    "Y_flywheel": (WRENCH_LETTERS, _BODY),
    "Y_drive": (_BODY,),
    "Y_added_mass": (WRENCH_LETTERS,),
    "Y_linear": (TWIST_LETTERS,),
    "Y_quadratic": (TWIST_LETTERS,),
}
"""Names along the axes of a field, one after another; flywheels and sensors are known by what the axis counts."""


@dataclass(frozen=True)
class Field:
    """One array of states or results, without the batch axis.

    name, shape  `shape` () is a number
    unit         SI
    meaning      frame and point it refers to
    labels       for each axis the names of its places; () where they have none
    """

    name: str
    shape: tuple[int, ...]
    unit: str
    meaning: str
    labels: tuple[Labels, ...]


def field(member: Member, stand: Stand, sensors: Sequence[str], before: tuple[str, ...] = ()) -> Field:
    """The field of a member of the C; `before`: what axes count that stand before its own."""
    counted = {"N": tuple(s.name for s in stand.flywheels), "SENSORS": tuple(sensors)}
    axes = [counted.get(axis, ()) for axis in (*before, *member.axes)]
    known = iter(_BY_NAME.get(member.name, ()))
    for i, labels in enumerate(axes):
        if not labels:
            axes[i] = next(known, ())
    shape = (*(len(counted[axis]) for axis in before), *member.shape)
    return Field(member.name, shape, member.unit, member.meaning, tuple(axes))


class Named(ABC):
    """Arrays by name, and their parts by label: `r["phi_ddot"]`, `r["phi_ddot", "w1"]`, `r["I", "N", "w1"]`."""

    def __init__(self, fields: Sequence[Field], batch: int | None) -> None:
        self._fields = {f.name: f for f in fields}
        self._batch = batch

    @property
    def fields(self) -> tuple[Field, ...]:
        """What there is, with units and meanings."""
        return tuple(self._fields.values())

    @property
    def batch(self) -> int | None:
        """Number of states; None: a single state, arrays without batch axis."""
        return self._batch

    def to_dict(self) -> dict[str, Array]:
        """The arrays by name."""
        return {name: self._array(name) for name in self._fields}

    def __getitem__(self, key: str | tuple[Any, ...]) -> Array:
        """An array by name, or the part of it that labels name: a view."""
        name, index = self._place(key)
        found: Array = self._array(name)[index]
        return found

    @abstractmethod
    def _array(self, name: str) -> Array:
        """The array of a field."""

    def _place(self, key: str | tuple[Any, ...]) -> tuple[str, tuple[Any, ...]]:
        name, *parts = key if isinstance(key, tuple) else (key,)
        if name not in self._fields:
            raise InputError(f"{show(name)}: no such name{suggestion(str(name), self._fields)}")
        f = self._fields[name]
        if len(parts) > len(f.shape):
            raise InputError(f"{name}: {len(parts)} labels, but it has {len(f.shape)} axes besides that of the batch")
        found = [_index(f, axis, part) for axis, part in enumerate(parts)]
        return name, (Ellipsis, *found, *(slice(None) for _ in f.shape[len(found) :]))

    def __dir__(self) -> list[str]:
        return sorted({*super().__dir__(), *self._fields})


def _index(f: Field, axis: int, part: Any) -> Any:
    """A label as its place; numbers and slices as they are."""
    if not isinstance(part, str):
        return part
    labels = f.labels[axis]
    if not labels:
        raise InputError(f"{f.name}: axis {axis} has no labels, give a number")
    if part not in labels:
        raise InputError(f"{f.name}: no {show(part)} on axis {axis}{suggestion(part, labels)}")
    return labels.index(part)


def range_text(a: Array) -> str:
    """An array in a table cell: its number, or least and largest of many."""
    if a.size == 0:
        return "none"
    if a.size == 1:
        return f"{a.reshape(-1)[0]:.6g}"
    finite = a[np.isfinite(a)]
    if finite.size == 0:
        return "not finite"
    lost = a.size - finite.size
    return f"{finite.min():.4g} … {finite.max():.4g}" + (f", {lost} not finite" if lost else "")


_LEFT = ' style="text-align: left"'


def arrays(title: str, named: Named) -> str:
    """Arrays with shape, unit, meaning; a single state's numbers, the range of many."""
    found = named.to_dict()
    rows = []
    for f in named.fields:
        a = found[f.name]
        values = [f"{x:.5g}" for x in np.ravel(a)] if a.size <= 12 and named.batch is None else [range_text(a)]
        rows.append([f.name, " × ".join(map(str, a.shape)) or "number", f.unit, ", ".join(values), f.meaning])
    status = getattr(named, "status", None)
    note = ""
    if status is not None:
        refused = int(np.count_nonzero(np.asarray(status) < 0))
        note = f"{refused} of {np.size(status)} refused: NaN" if refused else ""
    return table(title.strip("<>"), ["name", "shape", "unit", "values", "meaning"], rows, note)


def functions(title: str, rows: Sequence[Sequence[str]]) -> str:
    """The functions of a model: name, what it takes, what it gives, and how many states its C takes at once."""
    return table(title.strip("<>"), ["function", "takes", "gives", "how"], rows)


def table(title: str, head: Sequence[str], rows: Sequence[Sequence[str]], note: str = "") -> str:
    """A table under its title; every text is escaped."""
    cells = "".join(f"<th{_LEFT}>{escape(text)}</th>" for text in head)
    body = "".join("<tr>" + "".join(f"<td{_LEFT}>{escape(text)}</td>" for text in row) + "</tr>" for row in rows)
    after = f"<div>{escape(note)}</div>" if note else ""
    return (
        f"<div><strong>{escape(title)}</strong></div>"
        f"<table><thead><tr>{cells}</tr></thead><tbody>{body}</tbody></table>{after}"
    )


def bodies(stand: Stand) -> str:
    """The bodies of a stand with their masses, and the unbalance of its flywheels in workshop units."""
    summary = summarize(stand)
    unbalance = {row.name: row for row in summary.unbalance}
    rows = []
    for row in summary.bodies:
        wheel = unbalance.get(row.name)
        numbers = (
            [f"{wheel.spin_inertia:.4g}", f"{1e6 * wheel.static:.4g}", f"{1e9 * wheel.dynamic:.4g}"]
            if wheel
            else [""] * 3
        )
        at = ", ".join(f"{x * 1e3:.4g}" for x in row.center_of_mass)
        rows.append([row.name, row.kind, row.mount, f"{row.mass:.4g}", at, *numbers])
    head = [
        "body", "kind", "mount", "mass, kg", "mass centre in E1, mm", "spin inertia, kg m2", "static, g mm",
        "dynamic, g mm2",
    ]  # fmt: skip
    gravity = math.hypot(*stand.gravity)
    parts = [f"{summary.mass:.4g} kg in all", f"gravity {gravity:.4g} m/s2"]
    parts += [words for law in carrier_laws() if (words := law.short(stand))]
    parts += [f"points {', '.join(p.name for p in stand.points)}"] if stand.points else []
    title = f"{repr(stand).strip('<>')}; physics {identities(stand).physics}"
    return table(title, head, rows, "; ".join(parts))
