"""Coefficients of the laws of carrier and instruments as columns beside the products, component by component."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from mahovik.contract.laws import BODY_LAWS, parts
from mahovik.core.stand.model import Flywheel, Stand
from mahovik.proof.diagnose.terms.bodies import axial
from mahovik.proof.diagnose.terms.law_term import BodyFaults, CarrierFaults, LawTerm
from mahovik.proof.reference import Pieces
from mahovik.proof.reference.array import Array
from mahovik.proof.reference.rotation import Pose

ALIKE = 1e-10
"""Sine of the angle between columns below which they are one."""

_OF_BODIES, _BETWEEN = parts("faults", BodyFaults, BODY_LAWS), parts("faults", CarrierFaults)
KINDS = (*(law.kind for law in _OF_BODIES), *(law.kind for law in _BETWEEN))
"""Kinds of wrench whose coefficients are columns of their own."""


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


Parts = list[list[tuple[str, Array, LawTerm]]]
"""The parts of each law of each body, with the name of the body and its L (6x6)."""


def law_parts(stand: Stand, at: Sequence[Pieces]) -> Parts:
    """Parts of all laws of a stand at n states: those between bodies, then those of each body."""
    poses = [Pose(axial(p.L1[3:, :3] @ p.C.T), p.C, p.V) for p in at]
    between = (law.terms(stand, poses) for law in _BETWEEN)
    parts = [[("carrier", np.eye(6), term) for term in terms] for terms in between if terms]
    for s, k in enumerate(at[0].bodies.placed()):
        if not isinstance(k.body, Flywheel):
            bodies = [p.bodies.bodies[s] for p in at]
            V_r = np.array([k.twist(p.V_r) for p in at])
            of_body = (law.terms(bodies, V_r) for law in _OF_BODIES)
            parts += [[(k.body.name, k.L, term) for term in terms] for terms in of_body if terms]
    return parts


def law_columns(parts: Parts, row: Array) -> Iterator[list[LawColumn]]:
    """Columns of the component that `row` (6) takes of the wrench: coarse parts of each law; then finer ones."""
    last = [max(term.detail for *_, term in of_law) for of_law in parts]
    for detail in range(max(last, default=-1) + 1):
        columns = [
            _column(body, term.wrench @ (row @ L), term)
            for of_law, most in zip(parts, last, strict=True)
            for body, L, term in of_law
            if term.detail == min(detail, most)
        ]
        yield _merge(columns)


def _column(body: str, values: Array, term: LawTerm) -> LawColumn:
    name = term.term if body == "carrier" else f"{body}: {term.term}"
    of_body = term.coefficient.startswith(("cross_flow", "fading_damping"))
    return LawColumn(name, values, f"{body}.{term.coefficient}" if of_body else term.coefficient, term.value)


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
