"""Faults in control derivatives, (7)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from mahovik.laws.control.data import Control, ControlDerivative, ControlDerivatives, Factor
from mahovik.laws.control.reference import control_derivatives
from mahovik.proof.diagnose.edits import minus, wrench, zero
from mahovik.proof.diagnose.fault import Edit, Fault
from mahovik.proof.reference.array import Array
from mahovik.proof.reference.bodies import PlacedBody
from mahovik.proof.reference.pieces import Pieces

KIND = "control derivatives"


def _derivatives(change: Callable[[ControlDerivative], ControlDerivative]) -> Edit:
    """The wrench of other derivatives."""

    def edit(right: Array, k: PlacedBody, at: Pieces) -> Array:
        law = k.body.law(ControlDerivatives)
        if law is None:
            return right
        changed = replace(law, terms=tuple(map(change, law.terms)))
        return control_derivatives(k.body, changed, k.twist(at.V_r))

    return wrench(edit, KIND)


def _without_race(term: ControlDerivative) -> ControlDerivative:
    """No wrench where the race is a factor."""
    races = any(isinstance(f, Control) and f.what == "race" for f in term.of)
    return replace(term, value=0.0) if races else term


def _without_bars(term: ControlDerivative) -> ControlDerivative:
    """The signed factor where a magnitude is."""

    def bare(f: Factor) -> Factor:
        return replace(f, absolute=False)

    return replace(term, of=tuple(map(bare, term.of)))


# fmt: off
FAULTS = (
    Fault("control derivatives missing", "(7)", "all", [wrench(zero, KIND)],
          "The control derivatives are missing",
          "`control_derivatives` of the stand file"),
    Fault("control derivatives, sign", "(7)", "all", [wrench(minus, KIND)],
          "The control derivatives have the wrong sign",
          "they are added as published: wrench += value * product"),
    Fault("race missing", "(7)", "all", [_derivatives(_without_race)],
          "Control derivatives by the race of a propeller are missing",
          "`PROPELLER.race`: sign(n) (sqrt(u^2 + race n^2) - |u|)"),
    Fault("bars of control derivatives ignored", "(7)", "all", [_derivatives(_without_bars)],
          "The control derivatives take a factor with its sign where its magnitude stands",
          "`of = [\"u\", \"|u|\"]`: a factor between bars is a magnitude"),
)
# fmt: on
