"""The interpreted program of a derivation with a function replaced: for tools/explain_campaign.py."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import ExitStack
from dataclasses import replace
from types import SimpleNamespace
from typing import Any
from unittest.mock import patch

import sympy as sp
from explain_planting import STANDS, Plant, answers_of

from mahovik.core.derive import carrier, flywheel, screw
from mahovik.core.derive.symbols import vector
from mahovik.core.emit.generate import Generated
from mahovik.core.lower import forward, wrenches
from mahovik.core.lower.layout import Layout
from mahovik.core.lower.program import lower_layout
from mahovik.core.lower.values import Values
from mahovik.core.program.types import DOUBLE
from mahovik.core.stand.model import Stand
from mahovik.core.stand.structure import structure
from mahovik.laws.leg import derive as leg_formulas
from mahovik.proof.verify.c_backend import InterpreterBackend


def without_asymmetry(generic: Any, original: Callable[..., Any] = flywheel.spun_inertia) -> Any:
    """J22 and J33 both their mean."""
    J = vector("J", 6)
    mean = {J[1]: (J[1] + J[2]) / 2, J[2]: (J[1] + J[2]) / 2}
    return {k: replace(part, J=part.J.subs(mean, simultaneous=True)) for k, part in original(generic).items()}


def hub_weight(*given: Any, original: Callable[..., None] = wrenches._weight) -> None:
    """The weight along the constant part of the first moment."""
    lib, body, table, x, turns, _, g, F = given
    original(lib, body, table, x, turns, SimpleNamespace(mu=table.first_moment), g, F)


def no_lower_left(V: sp.Matrix, original: Callable[..., sp.Matrix] = screw.Phi) -> sp.Matrix:
    """Phi(V) without <v>."""
    made = original(V)
    made[3:, :3] = sp.zeros(3)
    return made


def leg_rate_reversed(original: Callable[..., Any] = leg_formulas.leg) -> Any:
    return replace(original(), rate=-original().rate)


def no_place(original: Callable[..., sp.Matrix] = carrier.momentum_in_E0) -> sp.Matrix:
    return original().subs(dict.fromkeys(vector("r"), 0))


DERIVED: dict[str, tuple[Any, str, Any]] = {
    "J22 - J33 missing": (flywheel, "spun_inertia", without_asymmetry),
    "weight at the hub": (wrenches, "_weight", hub_weight),
    "K* missing": (carrier, "mass_matrix_rate", lambda original=carrier.mass_matrix_rate: original() * 0),
    "v x p missing": (carrier, "Phi", no_lower_left),
    "leg damping, sign": (leg_formulas, "leg", leg_rate_reversed),
    "omega x u missing, drives too": (forward, "derived", SimpleNamespace(turning_velocity=lambda: sp.zeros(3, 1))),
    "Z0 about O1": (carrier, "momentum_in_E0", no_place),
}


def interpret(stand: Stand, values_of: Stand | None = None) -> InterpreterBackend:
    """The program of a stand, run by the interpreter; with the numbers of another."""
    layout = Layout(structure(stand), DOUBLE)
    program = lower_layout(layout)
    return InterpreterBackend(Generated(layout, program, Values(values_of or stand, layout, program), {}))


def plant_in_derivations(stand: Stand) -> Iterator[Plant]:
    """The interpreted program of a derivation with one function replaced; and of one with numbers replaced."""
    for name, (module, function, instead) in DERIVED.items():
        with ExitStack() as stack:
            stack.enter_context(patch.object(module, function, instead))
            yield Plant(name, "derivation rewritten", answers_of(interpret(stand)))
    for name in ("phi0 ignored", "stream, sign", "mount ignored", "unstretched length ignored"):
        yield Plant(name, "numbers of the program", answers_of(interpret(stand, STANDS[name](stand))))
