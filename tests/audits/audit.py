"""A public model of others as a program: its stand, its answers, its source, and the terms in which it is wrong."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from decimal import Decimal
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mahovik.core.stand.model import Stand, State
from mahovik.core.stand.stand_file import read
from mahovik.proof.verify.judges import attitude

Array = NDArray[np.float64]

Answer = Callable[[State, str], Mapping[str, Any]]
"""Values of a want at a state, as `mahovik eval` names them."""

Term = tuple[str, str]
"""Component of the wrench on the carrier, or name of the flywheel, and the product."""


@dataclass(frozen=True, eq=False)
class Audit:
    """A model of others.

    name      an identifier; title: the model, in words
    source    paper, or repository, file and revision
    scope     what is compared, and what is left out
    document  the same machine as a stand file
    wants     quantities that the model gives
    answer    the model
    wrong     every term that differs by hand calculation; None: it differs in no sum of a few products
    finding   what the difference means, a sentence
    states    states at which a held model is compared; a free one is asked at those of the search for terms
    """

    name: str
    title: str
    source: str
    scope: str
    document: Mapping[str, Any]
    wants: tuple[str, ...]
    answer: Answer
    wrong: frozenset[Term] | None
    finding: str
    states: tuple[State, ...] = ()

    @cached_property
    def stand(self) -> Stand:
        """The stand of `document`."""
        return stand_of(self.document, self.name)


def stand_of(document: Mapping[str, Any], name: str) -> Stand:
    """The stand of a document in SI."""
    return read({"schema": 1, "name": name} | _exact(document), name)


def _exact(value: Any) -> Any:
    """The value with its floats as the reader of stand files takes them."""
    if isinstance(value, Mapping):
        return {key: _exact(item) for key, item in value.items()}
    if isinstance(value, Sequence) and not isinstance(value, str):
        return [_exact(item) for item in value]
    return Decimal(repr(float(value))) if isinstance(value, float) else value


def terms(text: str) -> frozenset[Term]:
    """Terms of a text such as "Z: u q, v p; M: p r"."""
    pairs = set()
    for part in filter(None, text.split("; ")):
        component, products = part.split(": ")
        pairs |= {(component, product) for product in products.split(", ")}
    return frozenset(pairs)


def cross(a: Sequence[float] | Array) -> Array:
    """Matrix (3x3) of the vector product with a."""
    x, y, z = a
    return np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])


def to_body(stand: Stand, state: State, vector: Sequence[float]) -> Array:
    """A vector of E0 in E1 (3)."""
    return np.asarray(attitude(stand, state).as_matrix().T @ np.array(vector))


def rigid_mass(mass: float, center: Sequence[float], inertia: Array) -> Array:
    """Mass matrix (6x6) of a rigid body about O1, of its inertia about O1."""
    S = mass * cross(center)
    return np.block([[mass * np.eye(3), -S], [S, inertia]])


def rigid_products(mass: float, center: Sequence[float], inertia: Array, V: Array) -> Array:
    """Products of velocities (6; N, N m) on the right-hand side of Newton's and Euler's equations about O1."""
    v, w, c = V[:3], V[3:], np.array(center)
    force = -mass * (np.cross(w, v) + np.cross(w, np.cross(w, c)))
    return np.concatenate([force, -np.cross(w, inertia @ w) - mass * np.cross(c, np.cross(w, v))])


def momentum_products(M: Array, V: Array) -> Array:
    """C(V) V (6) of a symmetric mass matrix about O1, in the form that Fossen's handbook gives it."""
    p, h = M[:3] @ V, M[3:] @ V
    C = np.block([[np.zeros((3, 3)), -cross(p)], [-cross(p), -cross(h)]])
    return np.asarray(C @ V)


def without_added_products(added: Array) -> list[dict[str, Any]]:
    """Rows of `damping.terms` that take the products of added mass out of the equations: published derivatives hold
    these already."""
    letters = "uvwpqr"
    coefficients: dict[tuple[int, int, int], float] = {}
    for j in range(6):
        for k in range(6):
            # C(V) V is bilinear: the part of V_j in the matrix and V_k beside it
            column = _bilinear(added, j, k)
            for i in np.flatnonzero(column):
                key = (int(i), min(j, k), max(j, k))
                coefficients[key] = coefficients.get(key, 0.0) + float(column[i])
    return [
        {"wrench": "XYZKMN"[i], "of": [letters[j], letters[k]], "value": value}
        for (i, j, k), value in coefficients.items()
        if value
    ]


def _bilinear(M: Array, j: int, k: int) -> Array:
    p, h = M[:3, j], M[3:, j]
    unit = np.eye(6)[k]
    return np.concatenate([-cross(p) @ unit[3:], -cross(p) @ unit[:3] - cross(h) @ unit[3:]])


def merged(rows: Sequence[Mapping[str, Any]]) -> list[dict[str, Any]]:
    """Rows of `damping.terms` in which each product of a component stands once."""
    sums: dict[tuple[str, tuple[str, ...]], float] = {}
    for row in rows:
        key = (row["wrench"], tuple(sorted(row["of"])))
        sums[key] = sums.get(key, 0.0) + row["value"]
    return [{"wrench": w, "of": list(of), "value": value} for (w, of), value in sums.items() if value]
