"""Coefficients of the laws of carrier and instruments as columns beside the products, component by component.

A coefficient is a number that a law's fields declare with an error of measurement, of which the wrench is a polynomial
of the second degree at most: its parts are columns.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, cast

import numpy as np

from mahovik.contract.laws import BODY_LAWS, parts
from mahovik.core.stand.declare import Declared, Spread
from mahovik.core.stand.law import HeldLaw
from mahovik.core.stand.model import Body, Flywheel, Stand
from mahovik.core.stand.state import State
from mahovik.proof.diagnose.terms.bodies import axial
from mahovik.proof.reference import Pieces
from mahovik.proof.reference.array import Array
from mahovik.proof.reference.law import BodyReference, CarrierReference
from mahovik.proof.reference.pieces import body_wrench
from mahovik.proof.reference.rotation import Pose

SEEN = 6
"""States by which it is seen whether a wrench is a polynomial of a number."""

ALIKE = 1e-10
"""Sine of the angle between columns below which they are one; part of a wrench that is rounding of its differences."""


@dataclass(frozen=True, eq=False)
class LawTerm:
    """A part of the wrench of a law that is proportional to one coefficient.

    detail       0: the coarsest parts of the law; parts of one detail are looked for together
    term         what the coefficient stands before, in words; the coefficient itself, if there are none
    coefficient  its path in the stand file
    value        the right one, SI
    wrench       (n, 6; N, N m) where the coefficient is one, in the body's frame, at n states
    """

    detail: int
    term: str
    coefficient: str
    value: float
    wrench: Array


@dataclass(frozen=True)
class LawParts:
    """Coarse parts of a law, LAW of `faults` of its folder: of one body at n states, with its twists V_r (n, 6)."""

    law: type[Any]
    terms: Callable[[Sequence[Body], Array], Iterable[LawTerm]]


@dataclass(frozen=True, eq=False)
class LawColumn:
    """A column of one component of the wrench on the carrier, and the coefficient that it belongs to.

    name    what the coefficient stands before; values (n), of which the right ones are `right` times
    path    of the coefficient in the stand file; of several that no state tells apart: joined by "or"
    """

    name: str
    values: Array
    path: str
    right: float


_Change = Callable[[Any, float], Any]
"""A law with another value of one of its numbers."""


class _Law:
    """A law at n states: transfer L (6x6) of the wrenches of its body, coarse parts if it has any, coefficients."""

    def __init__(
        self, laws: Sequence[Any], path: str, wrench: Callable[[int, Any], Array], L: Array, coarse: Iterable[LawTerm]
    ) -> None:
        self.L, self.coarse = L, list(coarse)
        self._of = laws, path, wrench

    @cached_property
    def coefficients(self) -> list[LawTerm]:
        """Terms of its coefficients: made when they are asked for, as the law is evaluated for each."""
        return list(coefficients(*self._of))

    def terms(self, detail: int) -> list[LawTerm]:
        """Its parts of one detail; its coefficients, if there are none."""
        return [term for term in self.coarse if term.detail == detail] or self.coefficients


def laws_at(stand: Stand, states: Sequence[State], at: Sequence[Pieces]) -> list[_Law]:
    """All laws of a stand at n states: those between E0 and the carrier, then those of each body."""
    found, of_carrier = list[_Law](), cast(tuple[Any, ...], stand.laws)
    poses = [Pose(axial(p.L1[3:, :3] @ p.C.T), p.C, p.V) for p in at]
    between, of_bodies = parts("reference", CarrierReference), parts("reference", BodyReference, BODY_LAWS)
    coarse = {each.law: each.terms for each in parts("faults", LawParts, BODY_LAWS)}

    def on_carrier(i: int, law: Any) -> Array:
        alone = replace(stand, laws=(law,))
        return sum((body_wrench(x.wrenches(alone, states[i], poses[i])) for x in between), np.zeros(6))

    for law in of_carrier:
        path = f"hold.{law.key}" if isinstance(law, HeldLaw) else law.key
        found.append(_Law([law] * len(at), path, on_carrier, np.eye(6), ()))
    for s, k in enumerate(at[0].bodies.placed()):
        bodies, V_r = [p.bodies.bodies[s] for p in at], np.array([k.twist(p.V_r) for p in at])

        def on_body(i: int, law: Any, bodies: Any = bodies, V_r: Array = V_r) -> Array:
            alone = replace(bodies[i], laws=(law,))
            return sum((body_wrench(x.wrenches(alone, np.zeros(3), V_r[i])) for x in of_bodies), np.zeros(6))

        of_body: Any = () if isinstance(k.body, Flywheel) else k.body.laws
        for law in of_body:
            kind = type(law)
            terms = coarse[kind](bodies, V_r) if kind in coarse else ()
            found.append(_Law([b.law(kind) for b in bodies], f"{k.body.name}.{law.key}", on_body, k.L, terms))
    return found


def coefficients(laws: Sequence[Any], path: str, wrench: Callable[[int, Any], Array]) -> Iterator[LawTerm]:
    """Terms of the coefficients of a law as it is at n states, under a path; `wrench`: of another law at a state."""
    for name, value, largest, changed in _numbers(laws[0], path):
        step = largest or 1.0

        def wrenches(k: int, of: int, change: _Change = changed, value: float = value, step: float = step) -> Array:
            return np.array([wrench(i, change(law, value + k * step)) for i, law in enumerate(laws[:of])])

        P0, P1, P2, P3 = (wrenches(k, SEEN) for k in range(4))
        small = ALIKE * float(np.abs(P3).max())
        if np.abs(P3 - 3.0 * P2 + 3.0 * P1 - P0).max() > small:
            continue
        linear = np.abs(P2 - 2.0 * P1 + P0).max() <= small
        P0, P1 = wrenches(0, len(laws)), wrenches(1, len(laws))
        square = 0.0 if linear else (wrenches(2, len(laws)) - 2.0 * P1 + P0) / (2.0 * step**2)
        yield LawTerm(0, name, name, value, (P1 - P0) / step - square * (2.0 * value + step))
        if not linear:
            yield LawTerm(0, f"{name}^2", name, value**2, np.asarray(square))


def _numbers(of: Any, path: str) -> Iterator[tuple[str, float, float, _Change]]:
    """Each number with an error: its path, value, the largest of its list, and what gives it another value."""
    if isinstance(of, float):
        yield path, of, abs(of), lambda _, x: x
    elif isinstance(of, tuple):
        largest = float(np.abs(of).max(initial=0.0)) if not any(isinstance(x, Declared) for x in of) else 0.0
        for i, part in enumerate(of):
            below = getattr(part, "name", f"{path}[{i}]")
            for name, value, size, change in _numbers(part, below):
                yield name, value, max(size, largest), _in_place(i, change)
    elif isinstance(of, Declared):
        for key in of.annotations():
            part = getattr(of, key)
            tables = isinstance(part, tuple) and any(isinstance(x, Declared) for x in part)
            if tables or key in of.marked(Spread):
                below = path if getattr(of, "item", None) else f"{path}.{key}"
                for name, value, size, change in _numbers(part, below):
                    yield name, value, size, _in_field(key, change)


def _in_place(i: int, change: _Change) -> _Change:
    return lambda whole, x: (*whole[:i], change(whole[i], x), *whole[i + 1 :])


def _in_field(key: str, change: _Change) -> _Change:
    return lambda whole, x: replace(whole, **{key: change(getattr(whole, key), x)})


def law_columns(laws: Sequence[_Law], row: Array) -> Iterator[list[LawColumn]]:
    """Columns of the component that `row` (6) takes of the wrench: coarse parts of each law; then finer ones."""
    finest = max((term.detail for law in laws for term in law.coarse), default=-1) + 1
    for detail in range(finest + 1 if laws else 0):
        there = ((law.L, term) for law in laws for term in law.terms(detail))
        yield _merge([LawColumn(x.term, x.wrench @ (row @ L), x.coefficient, x.value) for L, x in there])


def _merge(columns: Sequence[LawColumn]) -> list[LawColumn]:
    """Without columns that are zero; columns that are proportional at all states are one, with all their names."""
    largest = max((float(np.linalg.norm(x.values)) for x in columns), default=0.0)
    kept: list[LawColumn] = []
    for column in columns:
        b = column.values
        if np.linalg.norm(b) <= ALIKE * largest:
            continue
        for i, other in enumerate(kept):
            a = other.values
            ratio = float(a @ b) / float(a @ a)
            if np.linalg.norm(b - ratio * a) <= ALIKE * np.linalg.norm(b):
                there = [x for x in (other, column) if x.right]  # of those that the right equations have
                if there:
                    name, path = (" or ".join(getattr(x, key) for x in there) for key in ("name", "path"))
                    kept[i] = replace(other, name=name, path=path, right=other.right + ratio * column.right)
                break
        else:
            kept.append(column)
    return kept
