"""Errors of a program as errors of equations: of the wrench (8), the drive torques, the momentum (2).

Those of a held carrier are along its freedoms, S^T (K V_r* - ...) = 0, and beside them those of its reaction.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence, Set
from dataclasses import dataclass, replace
from functools import cache, cached_property

import numpy as np

from mahovik.core.stand.model import WRENCH_LETTERS, Stand
from mahovik.core.stand.state import State
from mahovik.proof import reference
from mahovik.proof.diagnose.terms.bodies import ROWS, BodyTerm, body_terms, mount_rows, torque_rows
from mahovik.proof.diagnose.terms.coefficients import THERE, Coefficients, Multiple, is_there
from mahovik.proof.diagnose.terms.directions import (
    Directions,
    along_freedoms,
    of_all_components,
    of_blocked_components,
)
from mahovik.proof.diagnose.terms.fit import Columns
from mahovik.proof.diagnose.terms.law_columns import KINDS, LawColumns, widen
from mahovik.proof.diagnose.terms.monomials import Monomial, Motion, momentum_monomials, monomials
from mahovik.proof.reference import Pieces
from mahovik.proof.reference.array import Array
from mahovik.proof.reference.bodies import PlacedBody
from mahovik.proof.reference.momentum import momentum
from mahovik.proof.reference.motion import bias, mounts, torque
from mahovik.proof.reference.pieces import body_wrenches
from mahovik.proof.verify.actuators import stand_at

ANSWERS: Mapping[str, tuple[str, ...]] = {
    "forward": ("V_dot",),
    "torque": ("tau",),
    "coupled": ("V_dot", "phi_ddot"),
    "momentum": ("Z",),
    "reaction": ("reaction",),
    "inverse": ("phi_ddot", "residual"),
    "mounts": ("mount_wrench",),
}
"""Wants whose error is a sum of terms of the model, and the quantities that it is taken from."""

WHERE_WRONG = ("inverse", "mounts")
"""Wants that are looked at only where they are known to differ."""

OF_HELD = ("reaction",)
"""Wants that a free carrier does not have."""

OF_FLYWHEELS = ("torque", "coupled", "inverse", "mounts")
"""Wants that a stand without flywheels does not have."""


def quantities_of(stand: Stand, want: str) -> tuple[str, ...]:
    """Quantities that the error of a want is taken from; of a held carrier the reaction of `forward` and `coupled` is
    looked at besides, where it is answered."""
    if stand.hold is None or "V_dot" not in ANSWERS[want]:
        return ANSWERS[want]
    motion = ("u_dot",) if stand.hold.freedoms else ("reaction",)
    return (*motion, *(name for name in ANSWERS[want] if name != "V_dot"))


@dataclass(frozen=True, eq=False)
class EquationErrors:
    """Errors of some equations at n states, and the products that may explain them.

    components  letters of SNAME of the wrench on the carrier or of the momentum, or names of flywheels
    error       (n, c) SI: of the right-hand sides
    size        (n, c) SI: sum of the magnitudes of the terms, of which rounding is a part
    multiple    factor of product k in a component, where its coefficient has an error
    occurs      whether the right equations have product k in a component
    of_laws     coefficients of laws, which are looked for where the products do not explain an error; None: no such
    bodies      terms body by body at the leading states, and their columns (n', c); None: not looked for
    """

    components: tuple[str, ...]
    error: Array
    size: Array
    products: Sequence[Monomial]
    multiple: Callable[[int, int, float], Multiple]
    occurs: Callable[[int, int], bool]
    of_laws: LawColumns | None = None
    bodies: Callable[[], tuple[list[BodyTerm], list[Array]]] | None = None

    @cached_property
    def columns(self) -> Columns:
        """The products as columns."""
        return columns_of(self.products)


class Equations:
    """The right equations of a stand, and their coefficients, known from states of one's own."""

    def __init__(self, stand: Stand, own: Sequence[State]) -> None:
        self._stand, self._own = stand, own
        self._along = along_freedoms(stand)

    def errors(
        self,
        want: str,
        states: Sequence[State],
        at: Sequence[Pieces],
        answers: Mapping[str, Array],
        right: Set[str] = frozenset(),
    ) -> list[EquationErrors]:
        """Errors of a program by its answers (n, ...) to states, `at` their pieces.

        `right`: quantities whose answers are right. Beside a wrong acceleration the equation of a right one, or of a
        right reaction, has no error of its own.
        """
        if want == "momentum":
            return [self._momentum(states, at, answers["Z"])]
        if want == "torque":
            return [self._torque(states, at, answers["tau"])]
        if want == "reaction":
            return [self._reaction(states, at, answers["reaction"], self._all_components)]
        if want == "inverse":
            reached = self._states_of_answers(states, answers)
            return [self._reaction(reached, at, -answers["residual"], self._all_components)]
        if want == "mounts":
            return [self._mounts(states, at, answers["mount_wrench"])]
        reached = self._states_of_answers(states, answers)
        wrong = {"V_dot", "u_dot", "phi_ddot"} & answers.keys() - right
        left_out = right if wrong else frozenset()
        found = [self._forward(reached, at)] if self._along.components and not left_out & {"V_dot", "u_dot"} else []
        if want == "coupled" and "phi_ddot" not in left_out:
            found.append(self._torque(reached, at, np.array([s.tau for s in states])))
        if "reaction" in answers and "reaction" not in left_out:
            found.append(self._reaction(reached, at, answers["reaction"], self._blocked_components))
        return found

    def _states_of_answers(self, states: Sequence[State], answers: Mapping[str, Array]) -> list[State]:
        """The states with the accelerations that the program answers (n, ...)."""
        V_dot = answers.get("V_dot")
        if V_dot is None and "residual" in answers:
            V_dot = np.array([s.V_dot for s in states])
        elif V_dot is None:
            u_dot = answers.get("u_dot", np.zeros((len(states), 0)))
            V_dot = u_dot @ self._along.rows.T
        found = [replace(s, V_dot=tuple(a)) for s, a in zip(states, V_dot.tolist(), strict=True)]
        phi_ddot = answers.get("phi_ddot")
        if phi_ddot is None:
            return found
        return [replace(s, phi_ddot=tuple(b)) for s, b in zip(found, phi_ddot.tolist(), strict=True)]

    def _forward(self, states: Sequence[State], at: Sequence[Pieces]) -> EquationErrors:
        """Errors of the V_dot of the states, as wrenches K V_r* - (F - M V_r - J phi' - I phi'') along what is free."""
        none = np.zeros((len(states), 6))
        return self._wrench_errors(states, at, none, _Rows(self._along, lambda: self._wrench))

    def _reaction(self, states: Sequence[State], at: Sequence[Pieces], reaction: Array, known: _Rows) -> EquationErrors:
        """Errors of the reactions (n, 6) of the motion of the states, as wrenches K V_r* - (F + R - M V_r - ...)."""
        return self._wrench_errors(states, at, reaction, known)

    def _wrench_errors(
        self, states: Sequence[State], at: Sequence[Pieces], reaction: Array, known: _Rows
    ) -> EquationErrors:
        along = known.along
        V_r_dot = _relative_rates(states, at)
        inertial = np.array([p.K @ x for p, x in zip(at, V_r_dot, strict=True)])
        size = [np.abs(p.K) @ np.abs(x) + np.abs(p.F) + np.abs(bias(p)) for p, x in zip(at, V_r_dot, strict=True)]
        products = monomials(self._stand, Motion.of(states, at, V_r_dot, self._along))
        error = (inertial - _right_hand_sides(states, at) - reaction) @ along.rows
        sizes, of_laws = np.array(size) @ np.abs(along.rows), LawColumns(self._stand, at, along.rows)

        def on_carrier(terms: Sequence[BodyTerm], _: Sequence[Pieces]) -> list[Array]:
            return [-each.on_O1 @ along.rows for each in terms]

        of_bodies = _body_columns(states, at, on_carrier) if self._stand.flywheels else None
        return EquationErrors(
            along.components,
            error,
            sizes,
            products,
            lambda component, k, wrong: known.coefficients().multiple(component, k, wrong),
            lambda component, k: known.coefficients().occurs(component, k),
            of_laws,
            of_bodies,
        )

    def _mounts(self, states: Sequence[State], at: Sequence[Pieces], found: Array) -> EquationErrors:
        """Errors of the wrenches of mounts (n, 6 N), which are looked for in terms body by body alone."""
        moved = zip(at, states, strict=True)
        right = np.array([mounts(p, np.array(s.V_dot), np.array(s.phi_ddot)).ravel() for p, s in moved])
        columns = _body_columns(states, at, mount_rows)
        names = tuple(f"{wheel.name} {letter}" for wheel in self._stand.flywheels for letter in WRENCH_LETTERS)
        plain = _PlainFactors(None)
        return EquationErrors(names, found - right, np.abs(right), [], plain.multiple, plain.occurs, None, columns)

    def _torque(self, states: Sequence[State], at: Sequence[Pieces], tau: Array) -> EquationErrors:
        """Errors of the drive torques (n, N)."""
        right, products = self._torques(states, at)
        names = tuple(each.name for each in self._stand.flywheels)
        plain = _PlainFactors(self._known_torques)
        columns = _body_columns(states, at, torque_rows)
        return EquationErrors(names, tau - right, np.abs(right), products, plain.multiple, plain.occurs, None, columns)

    def _momentum(self, states: Sequence[State], at: Sequence[Pieces], Z: Array) -> EquationErrors:
        """Errors of the momentum Z (n, 6), (2); of a held carrier about its pivot."""
        right, products = self._momenta(states, at)
        own_right, own_products = self._momenta(self._own, self._own_pieces)
        along = self._all_components.along
        factors = columns_of(own_products).least_squares(own_right @ along.rows, with_later=True)
        plain = _PlainFactors(factors, self._all_components.coefficients(), products)
        size = np.abs(right) @ np.abs(along.rows)
        error = (Z - right) @ along.rows
        return EquationErrors(along.components, error, size, products, plain.multiple, plain.occurs)

    @cached_property
    def _own_pieces(self) -> list[Pieces]:
        return [reference.pieces(stand_at(self._stand, state), state) for state in self._own]

    @cached_property
    def _wrench(self) -> Coefficients:
        """Right coefficients of the products in the right-hand side of K V_r* = ..., along what is free."""
        return self._coefficients(self._along)

    @cached_property
    def _all_components(self) -> _Rows:
        """Equations of all six components, about the pivot."""
        along = of_all_components(self._stand)
        return _Rows(along, cache(lambda: self._wrench if self._stand.hold is None else self._coefficients(along)))

    @cached_property
    def _blocked_components(self) -> _Rows:
        """Equations of the components that the hold bears, about the pivot."""
        along = of_blocked_components(self._stand)
        return _Rows(along, cache(lambda: self._coefficients(along)))

    def _coefficients(self, along: Directions) -> Coefficients:
        others = np.array([_other_wrenches(p, self._stand) for p in self._own_pieces]) @ along.rows
        right = _right_hand_sides(self._own, self._own_pieces) @ along.rows
        motion = Motion.of(self._own, self._own_pieces, np.array([s.V_dot for s in self._own]), self._along)
        products = monomials(self._stand, motion)
        of_laws = LawColumns(self._stand, self._own_pieces, along.rows)
        columns = columns_of(products)
        factors = _factors_beside_laws(columns, right, of_laws)
        if factors is None and others.any():
            factors = _factors_beside_laws(columns, right - others, of_laws)
            if factors is not None:  # of a product that others may hold it is not known whether it should be there
                there = np.abs(factors) > THERE * np.abs(factors).max(axis=0)
                factors[~there & others.any(axis=0)] = np.nan
        return Coefficients(products, factors, motion, self._own_pieces, self._stand, along)

    @cached_property
    def _known_torques(self) -> Array | None:
        """Right coefficients (m, N) of the products in the drive torques; None where these hold more."""
        right, products = self._torques(self._own, self._own_pieces)
        return columns_of(products).least_squares(right, with_later=True)

    def _torques(self, states: Sequence[State], at: Sequence[Pieces]) -> tuple[Array, list[Monomial]]:
        """Drive torques (n, N) of the reference, and the products at the states."""
        V_r_dot = _relative_rates(states, at)
        right = np.array([torque(p, np.array(s.V_dot), np.array(s.phi_ddot)) for p, s in zip(at, states, strict=True)])
        return right, monomials(self._stand, Motion.of(states, at, V_r_dot, self._along))

    def _momenta(self, states: Sequence[State], at: Sequence[Pieces]) -> tuple[Array, list[Monomial]]:
        """Momentum (n, 6) of the reference, and the products at the states."""
        motion = Motion.of(states, at, np.zeros((len(states), 6)), self._along)
        streams = np.array([p.u for p in at]) if any(self._stand.stream or ()) or self._stand.profile else None
        return np.array([momentum(p) for p in at]), momentum_monomials(self._stand, motion, streams)


@dataclass(frozen=True, eq=False)
class _Rows:
    """Equations, and the right coefficients in them, which take a while."""

    along: Directions
    coefficients: Callable[[], Coefficients]


class _PlainFactors:
    """Right factors (m, c) of products, or None: unknown; named by quantities of the stand if these are given.

    `products`: of velocities, whose factors in the momentum are those of their derivatives in K V*.
    """

    def __init__(
        self, right: Array | None, names: Coefficients | None = None, products: Sequence[Monomial] = ()
    ) -> None:
        self._right, self._names, self._products = right, names, products

    def multiple(self, component: int, k: int, error: float) -> Multiple:
        """The factor of product k, whose coefficient has this error."""
        if self._right is None:
            return Multiple(error, None, "")
        expected = float(self._right[k, component]) if self.occurs(component, k) else 0.0
        if self._names is None:
            return Multiple(expected + error, expected, "")
        first, *wave = self._products[k].factors
        factors = (f"{first.removesuffix('.speed')}.acceleration" if "." in first else f"{first}_dot", *wave)
        return self._names.multiple_of(expected, error, component, factors)

    def occurs(self, component: int, k: int) -> bool:
        """Whether the right equations have product k in a component."""
        return self._right is not None and is_there(float(self._right[k, component]), self._right[:, component])


def _body_columns(
    states: Sequence[State],
    at: Sequence[Pieces],
    rows: Callable[[Sequence[BodyTerm], Sequence[Pieces]], list[Array]],
) -> Callable[[], tuple[list[BodyTerm], list[Array]]]:
    """Terms body by body at the leading states, and their columns in some equations; made where they are needed."""

    def columns() -> tuple[list[BodyTerm], list[Array]]:
        terms = body_terms(states[:ROWS], at[:ROWS])
        return terms, rows(terms, at[:ROWS])

    return columns


def columns_of(products: Sequence[Monomial]) -> Columns:
    """Values of products as columns."""
    return Columns(
        np.column_stack([each.values for each in products]), np.array([each.accelerates for each in products])
    )


def _factors_beside_laws(columns: Columns, right: Array, of_laws: LawColumns) -> Array | None:
    """Factors (m, c) of the products in right-hand sides (n, c), where coefficients of laws explain the rest."""
    if not of_laws.there:
        return columns.least_squares(right, with_later=False)
    found = []
    for component in range(right.shape[1]):
        wide, _ = widen(columns, next(of_laws.of(component)))
        factors = wide.least_squares(right[:, [component]], with_later=False)
        if factors is None:
            return None
        found.append(factors[: columns.count, 0])
    return np.column_stack(found)


def _right_hand_sides(states: Sequence[State], at: Sequence[Pieces]) -> Array:
    """F - M V_r - J phi' - I phi'' (n, 6)."""
    return np.array([p.F - bias(p) - p.I @ np.array(s.phi_ddot) for p, s in zip(at, states, strict=True)])


def _relative_rates(states: Sequence[State], at: Sequence[Pieces]) -> Array:
    """V_r* (n, 6) of the V* of the states."""
    return np.array([p.V_r_dot(np.array(s.V_dot)) for p, s in zip(at, states, strict=True)])


def _other_wrenches(at: Pieces, stand: Stand) -> Array:
    """Wrenches (6, in E1 about O1) that are no sum of these products or of coefficients of laws: laws between E0 and
    the carrier, damping of bodies with axes of their own, all laws of flywheels that are not of their weight."""
    found = np.zeros(6)
    bodies: tuple[PlacedBody, ...] = (*at.fixed, *at.flywheels)
    fixed = {k.body.name for k in at.fixed}
    for k in bodies:
        own = body_wrenches(k.body, np.zeros(3), np.zeros(6), np.zeros(6))
        for kind, wrench in at.terms[k.body.name].items():
            if kind in KINDS and k.body.name in fixed:
                continue
            if kind not in own or kind in KINDS or ("damping" in kind and k.body.name != stand.carrier.name):
                found += k.L @ wrench
    return found
