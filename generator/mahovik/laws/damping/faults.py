"""Faults in damping, (7)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from mahovik.core.stand.model import TWIST_LETTERS, WRENCH_LETTERS, Body
from mahovik.laws.damping.data import Damping
from mahovik.laws.damping.reference import damping_terms, wrenches
from mahovik.proof.diagnose.edits import Change, minus, wrench, zero
from mahovik.proof.diagnose.fault import Edit, Fault
from mahovik.proof.reference.array import Array
from mahovik.proof.reference.bodies import PlacedBody
from mahovik.proof.reference.pieces import Pieces
from mahovik.proof.reference.wrench_kinds import body_wrench

PRODUCTS = "products in derivatives"
"""Kind of wrench by which published derivatives that contain the products of added mass count once."""

DAMPING = ("linear damping", "quadratic damping", "damping terms")
"""Kinds of wrench that depend on the twist relative to the fluid."""


def damping(change: Change) -> Edit:
    """All damping of a body."""
    return wrench(change, *DAMPING)


def damping_at(twist: Callable[[PlacedBody, Pieces], Array]) -> Edit:
    """All damping of a body, taken at another twist (6) in its frame."""

    def change(right: Array, k: PlacedBody, at: Pieces) -> Array:
        kinds = wrenches(k.body, np.zeros(3), twist(k, at))
        return body_wrench({kind: P for kind, P in kinds.items() if kind in DAMPING})

    return damping(change)


def without_sign(P: Array, k: PlacedBody, at: Pieces) -> Array:
    """Quadratic damping (6) with V_r^2 for V_r |V_r|."""
    given = k.body.law(Damping)
    V_r = k.twist(at.V_r)
    return P if given is None or given.quadratic is None else -np.array(given.quadratic) @ (V_r * V_r)


def without_bars(P: Array, k: PlacedBody, at: Pieces) -> Array:
    """Hydrodynamic derivatives (6) with v for |v|."""
    given = k.body.law(Damping)
    if given is None:
        return P
    terms = []
    for term in given.terms:
        first, second = (replace(factor, absolute=False) for factor in term.of)
        terms.append(replace(term, of=(first, second)))
    return damping_terms(replace(given, terms=tuple(terms)), k.twist(at.V_r))


def relative_to_O1(k: PlacedBody, at: Pieces) -> Array:
    """The twist (6) relative to the fluid, with v of O1."""
    return np.concatenate([k.L[:3, :3].T @ at.V_r[:3], k.twist(at.V_r)[3:]])


# fmt: off
FAULTS = (
    Fault("damping, sign", "(7)", "all", [damping(minus)],
          "Damping has the wrong sign: it drives",
          "wrench -(linear V_r), -(quadratic (V_r |V_r|)), + terms"),
    Fault("linear damping missing", "(7)", "all", [wrench(zero, "linear damping")],
          "Linear damping is missing",
          "`linear` of `damping`"),
    Fault("quadratic damping missing", "(7)", "all", [wrench(zero, "quadratic damping")],
          "Quadratic damping is missing",
          "`quadratic` of `damping`"),
    Fault("quadratic damping without |V|", "(7)", "all", [wrench(without_sign, "quadratic damping")],
          "Quadratic damping takes V^2 instead of V |V|: it does not follow the direction of motion",
          "V_r |V_r|, element by element"),
    Fault("damping terms missing", "(7)", "all", [wrench(zero, "damping terms")],
          "The hydrodynamic derivatives (`terms` of `damping`) are missing",
          "`terms` of `damping`"),
    Fault("damping terms, sign", "(7)", "all", [wrench(minus, "damping terms")],
          "The hydrodynamic derivatives (`terms` of `damping`) have the wrong sign",
          "`terms` are added as published: wrench += value * product"),
    Fault("bars of damping terms ignored", "(7)", "all", [wrench(without_bars, "damping terms")],
          "The hydrodynamic derivatives (`terms` of `damping`) take v where |v| stands: their bars are ignored",
          "`of = [\"u\", \"|u|\"]`: a factor between bars is a magnitude"),
    Fault("products of added mass twice", "(7)", "all", [wrench(zero, PRODUCTS)],
          "The products of added mass count twice: in the derivatives, which contain them, and in Phi Lambda V",
          "`derivatives = \"with added-mass products\"`: Phi Lambda V_r is taken out"),
    Fault("flywheel damping without phi'", "(7)", "flywheels", [damping_at(lambda k, at: k.L.T @ at.V_r)],
          "The damping of the flywheels takes the twist of their mount: without f phi'",
          "V_s = Ls^T V + f phi'"),
    Fault("damping with the velocity of O1", "(7)", "all", [damping_at(relative_to_O1)],
          "Damping of instruments and flywheels takes the twist of O1, not of their own origin",
          "V_k = L^T V with <O> in L"),
    Fault("stream ignored in damping", "(7)", "all", [damping_at(lambda k, at: k.twist(at.V))],
          "Damping ignores the stream: it takes the twist relative to E0",
          "damping takes V_r = V - (C^T u, 0)"),
)


def coefficients(body: Body, _: float) -> dict[str, float]:
    """Hydrodynamic derivatives of a body by their names, `X_u`, `N_|r|r`, SI: factors of products in its wrench."""
    damping = body.law(Damping)
    if damping is None:
        return {}
    found: dict[str, float] = {}
    for matrix, spelling in ((damping.linear, "{}"), (damping.quadratic, "|{0}|{0}")):
        for row, letter in zip(matrix or (), WRENCH_LETTERS, strict=False):
            found |= {f"{letter}_{spelling.format(v)}": -x for x, v in zip(row, TWIST_LETTERS, strict=True)}
    for term in damping.terms:
        found[f"{WRENCH_LETTERS[term.wrench]}_{''.join(factor.letter for factor in term.of)}"] = term.value
    return found
