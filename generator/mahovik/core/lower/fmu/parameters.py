"""What is measured on a stand, number by number, in the order of the structs that hold it: parameters and laws."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from mahovik.core.lower.fmu import units
from mahovik.core.lower.fmu.units import Unit
from mahovik.core.lower.layout import Layout
from mahovik.core.lower.values import Values
from mahovik.core.program.types import Field, Kind, Struct
from mahovik.core.stand.model import TWIST_LETTERS, WRENCH_LETTERS, DampingTerm, Stand

_INERTIA = ("J11", "J22", "J33", "J12", "J13", "J23")
_QUATERNION = "wxyz"


@dataclass(frozen=True)
class Member:
    """A number of a struct: `positive` where it must not be negative."""

    name: str
    unit: Unit
    description: str
    value: float
    positive: bool = False


def parameters(stand: Stand, layout: Layout, values: Values) -> Iterator[Member]:
    """All reals of `parameters`, depth first."""
    named = {
        "instrument": [p.name for p in stand.instruments],
        "flywheel": [s.name for s in stand.flywheels],
        "point": [p.name for p in stand.points],
    }
    given = values.parameters
    for f in layout.parameters.fields:
        if f.name == "added_mass":
            yield from _matrix("added_mass", f, given[f.name], units.added_mass, "added mass Lambda, about O1 in E1")
        elif f.name == "carrier":
            assert isinstance(f.type, Struct)
            yield from _members("carrier", f.type, given[f.name])
        else:
            assert isinstance(f.type, Struct)
            for name, value in zip(named[f.name], given[f.name], strict=True):
                yield from _members(name, f.type, value)


def laws(stand: Stand, layout: Layout, values: Values) -> Iterator[Member]:
    """All reals of the table that `prepare` does not touch, depth first."""
    table = values.table
    for k, own in enumerate(layout.own if layout.own_damped else ()):
        assert layout.frame.field("damper") is not None
        name = stand.bodies[own.index].name
        yield from _damper(name, layout.damper, _member(_member(table, "frame")[k], "damper"))
    for f in layout.laws:
        given = _member(table, f.name)
        if f.name in ("gravity", "stream"):
            what = {"gravity": "gravity in E0", "stream": "velocity of the fluid in E0"}[f.name]
            yield from _vector(f.name, f, given, what)
        elif f.name == "damper":
            yield from _damper("carrier", layout.damper, given)
        elif f.name == "term":
            yield from _terms(stand, given)
        elif f.name == "suspension":
            yield from _suspension(layout.suspension, given)
        else:
            for k, leg in enumerate(given):
                yield from _members(f"leg[{k + 1}]", layout.leg, leg)


def _member(value: Any, name: str) -> Any:
    return value[name] if isinstance(value, Mapping) else getattr(value, name)


def _members(prefix: str, struct: Struct, value: Any) -> Iterator[Member]:
    """Members of a body, its mounting, or a leg; the body's own stand under the same prefix."""
    for f in struct.fields:
        given = _member(value, f.name)
        if isinstance(f.type, Struct):
            yield from _members(prefix, f.type, given)
        elif f.type is Kind.REAL:
            what = f"{prefix}: {f.name.replace('_', ' ')}" + (f", {f.comment}" if f.comment else "")
            yield from _vector(f"{prefix}.{f.name}", f, given, what)


def _vector(name: str, f: Field, value: Any, description: str) -> Iterator[Member]:
    """A scalar or a one-dimensional array."""
    unit = units.of_member(f.unit)
    if not f.shape:
        positive = f.name in ("mass", "displaced_mass", "length")
        yield Member(name, unit, description, float(value), positive)
        return
    for i, number in enumerate(value):
        if f.name == "inertia":
            text = f"{description.split(', J11', maxsplit=1)[0]} {_INERTIA[i]} about the body's origin, in its own axes"
            yield Member(f"{name}.{_INERTIA[i]}", unit, text, float(number))
        else:
            yield Member(f"{name}[{i + 1}]", unit, f"{description}; component {i + 1}", float(number))


def _matrix(name: str, f: Field, rows: Any, unit: Callable[[int, int], Unit], description: str) -> Iterator[Member]:
    for i, row in enumerate(rows):
        for j, number in enumerate(row):
            place = f"{i + 1},{j + 1}"
            yield Member(f"{name}[{place}]", unit(i, j), f"{description}, element {place}", float(number))


def _damper(body: str, struct: Struct, value: Any) -> Iterator[Member]:
    """Matrices of damping; the hydrodynamic derivatives follow in a table of their own."""
    for f in struct.fields:
        if f.name == "linear":
            what = f"{body}: linear damping, of its own twist relative to the fluid, in its own frame"
            yield from _matrix(
                f"{body}.damping.linear", f, _member(value, f.name), lambda i, j: units.law(i, (j,)), what
            )
        elif f.name == "quadratic":
            what = f"{body}: damping quadratic in its own twist relative to the fluid, in its own frame"
            yield from _matrix(
                f"{body}.damping.quadratic", f, _member(value, f.name), lambda i, j: units.law(i, (j, j)), what
            )


def _terms(stand: Stand, rows: Any) -> Iterator[Member]:
    """Hydrodynamic derivatives, in the order in which the table has them."""
    own: list[tuple[str, DampingTerm]] = [
        (body.name, term) for body in stand.bodies if body.damping is not None for term in body.damping.terms
    ]
    for k, ((body, term), row) in enumerate(zip(own, rows, strict=True)):
        factors = [f"|{TWIST_LETTERS[f.component]}|" if f.absolute else TWIST_LETTERS[f.component] for f in term.of]
        text = f"{body}: hydrodynamic derivative, {WRENCH_LETTERS[term.wrench]} += value {' '.join(factors)}"
        unit = units.law(term.wrench, tuple(f.component for f in term.of))
        yield Member(f"derivative[{k + 1}]", unit, text, float(_member(row, "value")))


def _suspension(struct: Struct, value: Any) -> Iterator[Member]:
    for f in struct.fields:
        given = _member(value, f.name)
        name = f"suspension.{f.name}"
        if f.name == "stiffness":
            text = "stiffness of the suspension, wrench on the carrier at O1 in E1"
            yield from _matrix(name, f, given, lambda i, j: units.law(i, (j,), rate=False), text)
        elif f.name == "damping":
            text = "damping of the suspension, wrench on the carrier at O1 in E1"
            yield from _matrix(name, f, given, lambda i, j: units.law(i, (j,)), text)
        elif f.name == "attitude":
            for i, number in enumerate(given):
                text = f"equilibrium attitude of the suspension, unit quaternion, {_QUATERNION[i]}"
                yield Member(f"{name}[{i + 1}]", units.NONE, text, float(number))
        else:
            yield from _vector(name, f, given, f"suspension: {f.comment}")
