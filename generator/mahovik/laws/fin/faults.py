"""Coefficients of lift and drag of fins, one by one, for the search for wrong terms."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from mahovik.core.stand.model import Body
from mahovik.laws.fin.law import Fin, Fins
from mahovik.laws.fin.reference import lift_and_drag
from mahovik.proof.diagnose.terms.law_term import BodyFaults, LawTerm
from mahovik.proof.reference.array import Array


def law_terms(bodies: Sequence[Body], V_r: Array) -> list[LawTerm]:
    """Lift, drag and induced drag of every fin of one body, whose deflections may differ from state to state."""
    found = []
    for s, right in enumerate(_fins(bodies[0])):
        pairs = [(_fins(body)[s], V) for body, V in zip(bodies, V_r, strict=True)]
        lift = _sum(pairs, lift_slope=1.0, drag=0.0, induced=0.0)
        drag = _sum(pairs, lift_slope=0.0, drag=1.0, induced=0.0)
        induced = _sum(pairs, drag=0.0, induced=1.0) - _sum(pairs, drag=0.0, induced=0.0)
        for term, key, wrench in (("lift", "lift_slope", lift), ("drag", "drag", drag),
                                  ("induced drag", "induced", induced)):  # fmt: skip
            value = float(getattr(right, key))
            found.append(LawTerm(0, f"{right.name} {term}", f"{right.name}.{key}", value, wrench))
    return found


def _sum(pairs: Sequence[tuple[Fin, Array]], drag: float, induced: float, lift_slope: float | None = None) -> Array:
    """Wrench (n, 6) of a fin with other coefficients; `lift_slope` None: its own."""
    return np.array(
        [
            lift_and_drag(
                replace(
                    fin, drag=drag, induced=induced, lift_slope=fin.lift_slope if lift_slope is None else lift_slope
                ),
                V,
            )
            for fin, V in pairs
        ]
    )


def _fins(body: Body) -> tuple[Fin, ...]:
    law = body.law(Fins)
    return () if law is None else law.fins


LAW = BodyFaults("fins", law_terms)
