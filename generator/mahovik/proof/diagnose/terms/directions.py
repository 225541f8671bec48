"""Directions of motion and of equations: all six of a free carrier, the freedoms of a held one."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from mahovik.core.stand.hold import FREEDOMS, freedom_labels, freedom_names, wrenches
from mahovik.core.stand.model import TWIST_LETTERS, WRENCH_LETTERS, Hold, Stand
from mahovik.proof.reference.array import Array, vector
from mahovik.proof.reference.hold import twists
from mahovik.proof.reference.screw import T

LEAST = 1e-12
"""Length below which a direction is none."""


@dataclass(frozen=True, eq=False)
class Directions:
    """Speeds that the products are made of, and equations that are taken of the wrench on the carrier.

    letters     k names of speeds: letters of SNAME, or u_1, u_2, ... of freedoms without a name
    basis       (6 x k) V_r = basis times the speeds; O1, E1
    dual        (6 x k) the speeds = dual^T V_r
    components  c names of equations: letters of SNAME, or the number of a freedom without a name
    rows        (6 x c) components = rows^T of a wrench on the carrier, in E1 about O1
    places      c places of the components among the six of a wrench about the pivot; None: none of them
    freedoms    (k x m) speeds of the letters at u = 1
    shift       (6 x 6) V = shift V_p, V_p the twist of the frame at the pivot with the axes of E1
    """

    letters: tuple[str, ...]
    basis: Array
    dual: Array
    components: tuple[str, ...]
    rows: Array
    places: tuple[int | None, ...]
    freedoms: Array
    shift: Array

    @cached_property
    def rates(self) -> tuple[str, ...]:
        """Names of the derivatives of the speeds."""
        return tuple(f"{letter}_dot" for letter in self.letters)

    @property
    def at_origin(self) -> bool:
        """Whether the equations are about O1, which no pivot is away from."""
        return not self.shift[:3, 3:].any()

    def mass(self, K: Array) -> Array:
        """Factors (..., c, k) of the derivatives of the speeds in K V_r* along the rows, of K (..., 6, 6)."""
        return np.asarray(self.rows.T @ K @ self.basis)

    def at_pivot(self, K: Array) -> Array:
        """K (6x6) about the pivot."""
        return np.asarray(self.shift.T @ K @ self.shift)


_ALL = np.eye(6)

FREE = Directions(TWIST_LETTERS, _ALL, _ALL, WRENCH_LETTERS, _ALL, tuple(range(6)), _ALL, _ALL)
"""Directions of a free carrier."""


def along_freedoms(stand: Stand) -> Directions:
    """Speeds and equations of what is free. In a stream the speeds are all six of the pivot, relative to the fluid."""
    if stand.hold is None:
        return FREE
    S, W, shift = twists(stand.hold), wrenches(stand.hold), _shift(stand.hold)
    names = freedom_names(stand.hold)
    places = tuple(_place(name) for name in names)
    components = tuple(name if k is None else WRENCH_LETTERS[k] for name, k in zip(names, places, strict=True))
    if any(stand.stream or ()) or stand.profile is not None:
        dual = np.asarray(np.linalg.inv(shift)).T
        return Directions(TWIST_LETTERS, shift, dual, components, S, places, dual.T @ S, shift)
    letters = [f"u_{name}" if k is None else TWIST_LETTERS[k] for name, k in zip(names, places, strict=True)]
    order = sorted(range(len(names)), key=lambda k: places[k] or 0)  # of products: "u q", in whatever order the file
    own = tuple(letters[k] for k in order)
    return Directions(own, S[:, order], W[:, order], components, S, places, np.eye(len(own))[order], shift)


def of_all_components(stand: Stand) -> Directions:
    """Speeds of the freedoms, and all six components about the pivot."""
    free = along_freedoms(stand)
    return _with_rows(free, free.shift)


def of_blocked_components(stand: Stand) -> Directions:
    """Speeds of what is free, and what is left of a wrench without its part along the freedoms, about the pivot."""
    free = along_freedoms(stand)
    if stand.hold is None:
        return free
    S, W = twists(stand.hold), wrenches(stand.hold)
    found = _with_rows(free, (_ALL - S @ W.T) @ free.shift)
    named = None not in free.places
    return found if named else replace(found, places=(None,) * len(found.places))


def point_in_words(stand: Stand) -> str:
    """The point that moments are about, in words."""
    return "O1" if along_freedoms(stand).at_origin else "the pivot"


def freedoms_in_words(stand: Stand) -> str:
    """Equations and speeds that the names of a held carrier stand for; "" of one that is free or clamped."""
    if stand.hold is None or not stand.hold.freedoms:
        return ""
    of = along_freedoms(stand)
    names = list(zip(of.components, freedom_labels(stand.hold), strict=True))
    equations = ", ".join(f"{name} along {what}" for name, what in names)
    speeds = [of.letters[int(np.argmax(column))] for column in of.freedoms.T] if len(of.letters) == len(names) else []
    if not speeds:
        return f"equations of what is free: {equations}; speeds are those of the pivot relative to the fluid"
    return f"equations of what is free: {equations}; speeds: {', '.join(speeds)}"


def _with_rows(of: Directions, rows: Array) -> Directions:
    """Directions with rows (6 x 6), named by the letters of SNAME; without those that are zero."""
    there = [k for k in range(6) if np.linalg.norm(rows[:, k]) > LEAST]
    names = tuple(WRENCH_LETTERS[k] for k in there)
    return Directions(of.letters, of.basis, of.dual, names, rows[:, there], tuple(there), of.freedoms, of.shift)


def _place(name: str) -> int | None:
    """Place of a freedom among the components of a twist, by its name."""
    return list(FREEDOMS).index(name) if name in FREEDOMS else None


def _shift(hold: Hold) -> Array:
    """(6 x 6) V of a twist of the frame at the pivot with the axes of E1: L^T V = V_p, L = T(pivot)."""
    return np.asarray(np.linalg.inv(T(vector(hold.pivot)).T))
