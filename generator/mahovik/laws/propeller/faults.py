"""Coefficients of thrust and torque of propellers, one by one, for the search for wrong terms."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from mahovik.core.stand.model import Body, Vec3
from mahovik.laws.propeller.law import Propeller, Propellers
from mahovik.laws.propeller.reference import thrust_and_torque
from mahovik.proof.diagnose.terms.law_term import BodyFaults, LawTerm
from mahovik.proof.reference.array import Array

PRODUCTS = ("|n| n", "|n| V_a", "|V_a| V_a")
"""What k0, k1, k2 stand before."""

NONE: Vec3 = (0.0, 0.0, 0.0)
UNITS: tuple[Vec3, ...] = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))


def law_terms(bodies: Sequence[Body], V_r: Array) -> list[LawTerm]:
    """k0, k1, k2 of K_T and K_Q of every propeller of one body, whose speeds may differ from state to state."""
    found = []
    for s, right in enumerate(_propellers(bodies[0])):
        at = [_propellers(body)[s] for body in bodies]
        for k, product in enumerate(PRODUCTS):
            for what, thrust, torque in (("thrust", UNITS[k], NONE), ("torque", NONE, UNITS[k])):
                wrench = np.array(
                    [
                        thrust_and_torque(replace(p, thrust=thrust, torque=torque), V)
                        for p, V in zip(at, V_r, strict=True)
                    ]
                )
                value = getattr(right, what)[k]
                found.append(
                    LawTerm(0, f"{right.name} {what} {product}", f"{right.name}.{what}[{k}]", float(value), wrench)
                )
    return found


def _propellers(body: Body) -> tuple[Propeller, ...]:
    law = body.law(Propellers)
    return () if law is None else law.propellers


LAW = BodyFaults("propellers", law_terms)
