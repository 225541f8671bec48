"""The search for wrong terms of a program: its requests, the errors of its equations, and what explains them."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from types import MappingProxyType
from typing import Any, cast

import numpy as np

from mahovik.core.stand.model import WRENCH_LETTERS, Stand
from mahovik.core.stand.numbers import StandNumbers
from mahovik.core.stand.random_state import along_freedoms
from mahovik.core.stand.read import read
from mahovik.core.stand.state import Quaternion, State
from mahovik.core.stand.toml import parse
from mahovik.core.stand.write import dumps
from mahovik.errors import CheckError, UsageError
from mahovik.proof import reference
from mahovik.proof.diagnose.answers import Precision, numbers_at
from mahovik.proof.diagnose.terms.bodies import ROWS, body_terms, explain
from mahovik.proof.diagnose.terms.fit import MOST, Columns, Fit
from mahovik.proof.diagnose.terms.law_columns import KINDS, LawColumn, law_columns, law_parts
from mahovik.proof.diagnose.terms.products import Frame, count, frame_in_words, frame_of, products
from mahovik.proof.reference import Pieces
from mahovik.proof.reference.array import Array, vector
from mahovik.proof.reference.momentum import momentum
from mahovik.proof.reference.motion import bias, mounts, reaction, torque
from mahovik.proof.verify.draw import with_drawn_actuators
from mahovik.proof.verify.foreign import Program
from mahovik.proof.verify.states import Request, stand_at

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

WANTS = tuple(ANSWERS)
"""Wants in which wrong terms are looked for."""

WHERE_WRONG, OF_HELD, OF_FLYWHEELS = ("inverse", "mounts"), ("reaction",), ("torque", "coupled", "inverse", "mounts")
"""Wants that are looked at only where they are known to differ; of held carriers; of stands with flywheels."""

BESIDES = ("momentum",)
"""Wants whose error hinders no name of other errors where it is no few terms itself."""

RIGHT: Mapping[str, Callable[[Pieces, State], Array]] = {
    "wrench": lambda at, s: -reaction(at, vector(s.V_dot), vector(s.phi_ddot)),
    "torque": lambda at, s: torque(at, vector(s.V_dot), vector(s.phi_ddot)),
    "mounts": lambda at, s: mounts(at, vector(s.V_dot), vector(s.phi_ddot)).ravel(),
    "momentum": lambda at, s: momentum(at),
}
"""Sides of equations that are sums of terms, at a motion: of the wrench on the carrier F - M V_r - ... - K V_r*."""

MORE, SPARE = 1.25, 40
"""Number of states for each product, and of those besides."""

FEW = 4
"""Terms of a component up to which an exact fit needs no other explanation; that of a whole equation has dozens."""

SPREAD = {"V": 1.0, "phi_dot": 3.0, "phi_ddot": 3.0, "V_dot": 1.0}
"""Standard deviations of the states, SI: no kind of term is much larger than another."""

ALIKE, SAME, THERE = 1e-3, 1e-6, 1e-9
"""Relative difference of factors of one term in two wants; of equal numbers; part of the largest that is rounding."""

LIKELY = -1.0, 0.0
"""Factors of a part of a coefficient that name it: the wrong sign, and none."""

ROUNDING, PART = 1e-11, 0.03
"""Error over the size of the terms that a right program may have: in double; part of what is accepted of answers."""

PLAIN = "weight", "buoyancy", "run-time"
PLAIN_ON_CARRIER = "linear damping", "quadratic damping", "damping terms", "products in derivatives"
"""Kinds of wrench that are sums of products, of any body and in the axes of the carrier alone."""

SOLVABLE = 1e-6
"""Least singular value of the mass matrix of a program: one that answers has such a matrix."""


@dataclass(frozen=True)
class WrongTerm:
    """A wrong term of a program.

    component    letter of SNAME of the wrench on the carrier, or of the momentum; the flywheel's name; or bodies
    term         the product; on the right-hand side of K V* = ..., in the drive torque or in the momentum
    factor       in the program, SI; where `expected`, the right one, is None it is only known what it is wrong by
    coefficient  path of the number of the stand file that the right factor is proportional to; "": of none alone
    share        its mean square over the sum of those of all wrong terms of the want
    twins        other products that explain the error as well in its place, at the states that there are
    of_body      whether it is a vector term of bodies, which `component` names, in all components
    """

    want: str
    component: str
    term: str
    factor: float
    expected: float | None
    coefficient: str = ""
    share: float = 1.0
    twins: tuple[str, ...] = ()
    of_body: bool = False

    def is_same(self, other: WrongTerm) -> bool:
        """Whether two wants have one wrong term."""
        same = (self.component, self.term) == (other.component, other.term)
        return same and abs(self.factor - other.factor) <= ALIKE * max(abs(self.factor), abs(other.factor))


@dataclass(frozen=True)
class TermSearchResult:
    """Result of a search for wrong terms.

    terms        what explains most of the error
    unexplained  the part of the error that they leave, 0 to 1 (root mean square)
    wants        those that were looked at
    exact        whether they leave nothing beyond rounding
    besides      wants whose error is no few terms, beside others whose error is
    about        the point that moments are about, in words
    freedoms     what the names of equations and speeds of a held carrier stand for
    looked_at    quantities whose errors were looked at, as want: quantity
    """

    terms: tuple[WrongTerm, ...]
    unexplained: float
    wants: tuple[str, ...]
    exact: bool
    besides: tuple[str, ...] = ()
    about: str = "O1"
    freedoms: str = ""
    looked_at: tuple[str, ...] = ()

    @property
    def whole(self) -> bool:
        """Whether they are the error, to rounding, and few (more than MOST are rather another program), and no others
        explain it as well."""
        return 0 < len(self.terms) <= MOST and self.exact and not self.doubtful

    @property
    def doubtful(self) -> tuple[WrongTerm, ...]:
        """Terms of an explained error in whose place others explain it as well."""
        return tuple(term for term in self.terms if term.twins) if self.exact else ()


@dataclass(frozen=True, eq=False)
class _Equations:
    """Some equations at n states of a program's motion.

    side   of RIGHT; frame: names of equations and speeds; answered (n, ...): what the program has there
    """

    want: str
    side: str
    frame: Frame
    states: Sequence[State]
    at: Sequence[Pieces]
    answered: Array


Answers = Callable[[Request], Mapping[str, Any]]


class TermSearch:
    """Finds wrong terms in programs of one stand: states, the reference's pieces and the products are kept."""

    def __init__(
        self,
        stand: Stand,
        seed: int = 1,
        wants: Sequence[str] = WANTS,
        states: Sequence[tuple[str, State]] | None = None,
        precision: Precision | None = None,
        program: Program | None = None,
        wrong: Sequence[str] = (),
    ) -> None:
        """`states`: the only ones with answers, by name, as in a log; None: those that the search asks for.

        `precision`: of the program, None: double; `program`: which states it takes, None: all; `wrong`: wants that are
        known to differ.
        """
        rng = np.random.default_rng(seed)
        self._stand, self._rounding, self._wrong = stand, ROUNDING, tuple(wrong)
        if precision is not None:
            self._rounding = max(ROUNDING, PART * precision.accepted, 2.0 * 10.0 ** (1 - precision.digits))
        self._drawn = [_state(stand, rng) for _ in range(math.ceil(MORE * count(stand)) + SPARE)]
        if program is not None and program.actuators:
            self._drawn = [with_drawn_actuators(stand, state, rng) for state in self._drawn]
        asked = self._drawn if program is None else [program.state(stand, state) for state in self._drawn]
        named = [(f"term {i}", state) for i, state in enumerate(asked)] if states is None else states
        self._states = [state for _, state in named]
        tell_all = {"forward", "torque"} <= set(wants) and "coupled" not in wrong  # "coupled" says nothing new then
        self.wants = tuple(
            want
            for want in WANTS
            if want in wants
            and (stand.flywheels or want not in OF_FLYWHEELS)
            and (stand.hold is not None or want not in OF_HELD)
            and (want not in WHERE_WRONG or (want in wrong and stand.hold is None))
            and not (want == "coupled" and tell_all)
        )
        self._requests = {
            want: [Request(f"{name}, {want}", state, (want,)) for name, state in named] for want in self.wants
        }
        self._right: dict[tuple[str, str], Array | None] = {}

    @property
    def requests(self) -> list[Request]:
        """Requests for a program."""
        return [request for requests in self._requests.values() for request in requests]

    def find(self, answers: Answers) -> TermSearchResult:
        """The wrong terms of a program by its answers to `requests`. Raises CheckError: it answers too few states."""
        terms: list[WrongTerm] = []
        fits: list[Fit] = []
        besides: list[str] = []
        unexplained = set(self._wrong)
        for want in self.wants:
            parts = [self._terms(equations, terms) for equations in self._equations(want, answers)]
            if want in BESIDES and fits and not all(fit.exact for _, of_part in parts for fit in of_part):
                besides.append(want)
                continue
            for of_part, more in parts:
                unexplained -= {term.want for term in of_part}
                terms += [x for x in of_part if not (want == "coupled" and any(x.is_same(y) for y in terms))]
                fits += more
        if not self._has_mass_matrix(terms):
            return TermSearchResult((), 1.0, self.wants, False, tuple(besides))
        left, exact = max((fit.left for fit in fits), default=0.0), all(fit.exact for fit in fits)
        looked_at = tuple(
            f"{want}: {name}"
            for want in sorted(set(self.wants) - set(besides) - unexplained)
            for name in sorted({*self._names(want, answers), *ANSWERS[want]})  # V_dot of a hold is S u_dot
        )
        words = frame_in_words(self._stand)
        return TermSearchResult(tuple(terms), left, self.wants, exact, tuple(besides), *words, looked_at)

    # -- answers -------------------------------------------------------------------------------------------------------

    def _names(self, want: str, answers: Answers) -> tuple[str, ...]:
        """Quantities that the error of a want is taken from.

        Of a held carrier u_dot for V_dot; and the reaction where it is answered and no want of its own tells it.
        """
        names, hold = ANSWERS[want], self._stand.hold
        if hold is None or "V_dot" not in names:
            return names
        names = (*(("u_dot",) if hold.freedoms else ("reaction",)), *(x for x in names if x != "V_dot"))
        beside = hold.freedoms and "reaction" not in self.wants
        answered = beside and any("reaction" in answers(request) for request in self._requests[want])
        return (*names, "reaction") if answered else names

    @cached_property
    def _pieces(self) -> list[Pieces]:
        return self._pieces_of(self._states)

    def _pieces_of(self, states: Sequence[State], stand: Stand | None = None) -> list[Pieces]:
        return [reference.pieces(stand_at(stand or self._stand, state), state) for state in states]

    def _answered(self, want: str, answers: Answers) -> tuple[list[int], dict[str, Array], set[str]]:
        """Rows of the states with finite answers, these (n, ...) by quantity, and the quantities that are right.

        Raises CheckError: too few.
        """
        names = self._names(want, answers)
        rows: list[int] = []
        values, right = list[list[Array]](), list[list[Array]]()
        for i, request in enumerate(self._requests[want]):
            numbers = [numbers_at(answers(request), (name,)) for name in names]
            there = [x for x in numbers if x is not None and np.isfinite(x).all()]
            if len(there) < len(names):
                continue
            state = self._states[i]
            expected = reference.evaluate(stand_at(self._stand, state), state, (want,), self._pieces[i])
            if [x.shape for x in there] == [np.shape(expected[name]) for name in names]:
                rows.append(i)
                values.append([x.ravel() for x in there])
                right.append([np.ravel(expected[name]) for name in names])
        least = count(self._stand) if want not in ("mounts",) else 1
        if len(rows) < least:
            raise CheckError(
                f"{want}: {len(rows)} of {len(self._states)} states have an answer; expected at least {least}, as many "
                "as there are products whose factors are looked for"
            )
        given, expected_rows = (np.array([np.concatenate(x) for x in group]) for group in (values, right))
        size = np.abs(expected_rows).max(axis=0) + 1e-300
        off = np.abs((given - expected_rows) / size)
        bounds = np.cumsum([x.size for x in values[0]])[:-1]
        off_by_name = dict(zip(names, np.split(off, bounds, axis=1), strict=True))
        by_name = dict(zip(names, np.split(given, bounds, axis=1), strict=True))
        return rows, by_name, {name for name, x in off_by_name.items() if (x <= self._rounding).all()}

    def _equations(self, want: str, answers: Answers) -> list[_Equations]:
        """Equations of a want at the motion that the program answers.

        Beside a wrong acceleration the equation of a right one, or of a right reaction, has no error of its own.
        """
        rows, values, right = self._answered(want, answers)
        states, at = [self._states[i] for i in rows], [self._pieces[i] for i in rows]
        wheels = tuple(wheel.name for wheel in self._stand.flywheels)
        drives = replace(frame_of(self._stand), components=wheels, rows=np.eye(len(wheels)))
        if want == "torque":
            return [_Equations(want, "torque", drives, states, at, values["tau"])]
        if want == "mounts":
            names = tuple(f"{wheel} {letter}" for wheel in wheels for letter in WRENCH_LETTERS)
            frame = replace(drives, components=names, rows=np.eye(len(names)))
            return [_Equations(want, "mounts", frame, states, at, values["mount_wrench"])]
        every = frame_of(self._stand, "all")
        if want == "momentum":
            return [_Equations(want, "momentum", every, states, at, values["Z"])]
        if want == "reaction":
            return [_Equations(want, "wrench", every, states, at, -values["reaction"])]
        V_dot = values["V_dot"] if "V_dot" in values else np.zeros((len(rows), 6))
        if "u_dot" in values:
            V_dot = values["u_dot"] @ frame_of(self._stand).rows.T
        phi_ddot = values.get("phi_ddot", np.array([s.phi_ddot for s in states]))
        moved = [replace(s, phi_ddot=tuple(a)) for s, a in zip(states, phi_ddot.tolist(), strict=True)]
        if want == "inverse":
            return [_Equations(want, "wrench", every, moved, at, values["residual"])]
        moved = [replace(s, V_dot=tuple(a)) for s, a in zip(moved, V_dot.tolist(), strict=True)]
        left_out = right if {"V_dot", "u_dot", "phi_ddot"} & values.keys() - right else set[str]()
        none, tau = np.zeros((len(rows), 6)), np.array([s.tau for s in states])
        equations = [
            ({"V_dot", "u_dot"}, _Equations(want, "wrench", frame_of(self._stand), moved, at, none)),
            ({"phi_ddot"}, _Equations(want, "torque", drives, moved, at, tau)),
            ({"reaction"}, _Equations(want, "wrench", frame_of(self._stand, "blocked"), moved, at,
                                      -values.get("reaction", none))),
        ]  # fmt: skip
        return [x for names, x in equations if names & values.keys() and not names & left_out and x.frame.components]

    # -- terms ---------------------------------------------------------------------------------------------------------

    def _terms(self, of: _Equations, before: Sequence[WrongTerm]) -> tuple[list[WrongTerm], list[Fit]]:
        """Wrong terms of all components, and the fit of each wrong one; of whole bodies where these are fewer."""
        rows = of.frame.rows
        sides = np.array([RIGHT[of.side](p, s) for p, s in zip(of.at, of.states, strict=True)])
        error = (of.answered - sides) @ rows
        size = np.abs(sides) @ np.abs(rows)
        if of.side == "wrench":
            parts = [_magnitudes(p, s) for p, s in zip(of.at, of.states, strict=True)]
            size = np.array(parts) @ np.abs(rows)
        rounding = self._rounding * np.sqrt(np.mean(size**2, axis=0))
        wrong = np.sqrt(np.mean(error**2, axis=0)) > 10 * np.sqrt(np.mean(rounding**2))
        by_body = self._body_terms(of, error[:ROWS], rounding, before)
        if by_body and (len(by_body) < np.count_nonzero(wrong) or of.side == "mounts"):
            return by_body, [Fit({}, 0.0, True)]
        if of.side == "mounts":
            return [], [Fit({}, 1.0)] if wrong.any() else []
        terms, fits = self._product_terms(
            of, error, np.flatnonzero(wrong).tolist(), float(np.sqrt(np.mean(rounding**2)))
        )
        if by_body and (len(by_body) < len(terms) or not all(fit.exact for fit in fits)):
            return by_body, [Fit({}, 0.0, True)]
        return terms, fits

    def _body_terms(
        self, of: _Equations, error: Array, rounding: Array, before: Sequence[WrongTerm]
    ) -> list[WrongTerm]:
        """One wrong term, or two, of whole bodies that explain all components; none where they do not.

        `before`: those of other wants, which come before terms of the same effect.
        """
        within = (np.sqrt(np.mean(error**2, axis=0)) <= 10 * rounding).all()
        if within or of.side == "momentum" or not self._stand.flywheels:
            return []
        columns = body_terms(of.states[:ROWS], of.at[:ROWS], of.side, of.frame.rows)
        known = {(term.component, term.term) for term in before}
        first = [term for term in columns if term[:2] in known]
        factors = explain(error, columns, np.maximum(rounding, 1e-3 * rounding.max()), first)
        sizes = {term: float(np.sum((c * columns[term]) ** 2)) for term, c in factors.items()}
        return [
            WrongTerm(of.want, body, name, round(expected + c, 9) + 0.0, expected, of_body=True,
                      share=sizes[body, name, expected] / sum(sizes.values()))
            for (body, name, expected), c in factors.items()
        ]  # fmt: skip

    def _product_terms(
        self, of: _Equations, error: Array, wrong: Sequence[int], rounding: float
    ) -> tuple[list[WrongTerm], list[Fit]]:
        """Wrong products of the components that are wrong, and the fit of each."""
        if not wrong:
            return [], []
        table = products(of.frame, of.states, of.at, of.side == "momentum")
        parts = law_parts(self._stand, of.at) if of.side == "wrench" else []
        columns, right = Columns(table.values, table.accelerate), self._coefficients(of)
        m = len(table.names)
        terms: list[tuple[float, WrongTerm]] = []
        fits: list[Fit] = []
        for i in wrong:
            there = np.full(m, False) if right is None else _is_there(right[:, i])
            fit, of_laws = columns.fit(error[:, i], rounding, there), list[LawColumn]()
            for finer in law_columns(parts, of.frame.rows[:, i]):
                if fit.exact and len(fit.coefficients) <= FEW:
                    break
                kept = columns.independent(np.column_stack([x.values for x in finer]))
                wide = np.column_stack([table.values, *(finer[j].values for j in kept)])
                more = np.full(len(kept), False)
                widened = Columns(wide, np.append(table.accelerate, more))
                other = widened.fit(error[:, i], rounding, np.append(there, ~more))
                if other.exact and (not fit.exact or len(other.coefficients) < len(fit.coefficients)):
                    fit, of_laws = other, [finer[j] for j in kept]
            fits.append(fit if fit.coefficients else replace(fit, left=1.0))
            names = (*table.names, *(x.name for x in of_laws))
            for k, c in fit.coefficients.items():
                law = of_laws[k - m] if k >= m else None
                values = table.values[:, k] if law is None else law.values
                twins = tuple(names[j] for j in (fit.twins or {}).get(k, ()))
                place = of.want, of.frame.components[i], names[k]
                if law is not None:
                    factor, expected, path = law.right + c, law.right, law.path
                elif right is None or np.isnan(right[k, i]):
                    factor, expected, path = c, None, ""
                else:
                    expected = float(right[k, i]) if there[k] else 0.0
                    factor, path = expected + c, ""
                    if expected:
                        factor, expected, path = self._part(of, k, i, expected, c)
                factor = 0.0 if abs(factor) <= SAME * abs(expected or 0.0) else factor
                term = WrongTerm(*place, factor, expected, path, twins=twins)
                terms.append((float(np.sum((c * values) ** 2)), term))
        whole = sum(size for size, _ in terms) or 1.0
        return [replace(x, share=size / whole) for size, x in sorted(terms, key=lambda x: -x[0])], fits

    def _coefficients(self, of: _Equations) -> Array | None:
        """Right factors (m, c) of the products; None, or NaN: not known, for the equations hold more than these."""
        key = of.side, " ".join(of.frame.components)
        if key not in self._right:
            self._right[key] = self._solve(of, self._stand)
        return self._right[key]

    def _solve(self, of: _Equations, stand: Stand) -> Array | None:
        at = self._drawn_pieces if stand is self._stand else self._pieces_of(self._drawn, stand)
        table = products(of.frame, self._drawn, at, of.side == "momentum")
        rows = of.frame.rows
        right = np.array([RIGHT[of.side](p, s) for p, s in zip(at, self._drawn, strict=True)]) @ rows
        parts = law_parts(stand, at) if of.side == "wrench" else []
        if of.side != "wrench":
            return Columns(table.values, np.full(len(table.names), False)).least_squares(right)
        others = np.array([_other_wrenches(p) for p in at]) @ rows
        factors = np.zeros((len(table.names), rows.shape[1]))
        for i in range(rows.shape[1]):
            laws = next(law_columns(parts, rows[:, i]), [])
            narrow = Columns(table.values, np.full(len(table.names), False))
            kept = narrow.independent(np.column_stack([x.values for x in laws])) if laws else []
            wide = np.column_stack([table.values, *(laws[j].values for j in kept)])
            columns = Columns(wide, np.full(wide.shape[1], False)) if kept else narrow
            whole = columns.least_squares(right[:, [i]])
            if whole is None:
                whole = columns.least_squares((right - others)[:, [i]])
                if whole is None:
                    factors[:, i] = math.nan
                    continue
                # of a product that others may hold it is not known whether it should be there
                whole = np.where(_is_there(whole), whole, math.nan)
            factors[:, i] = whole[: len(table.names), 0]
        return factors

    @cached_property
    def _drawn_pieces(self) -> list[Pieces]:
        return self._pieces_of(self._drawn)

    def _part(self, of: _Equations, k: int, component: int, expected: float, error: float) -> tuple[float, float, str]:
        """A factor, the right one, and the path of the number of the stand file that this is proportional to.

        Of all of the coefficient of product k; else of the part of it that a number has, where this explains the error
        by a likely factor. The part is what changes with the number in the right equations.
        """
        file, g = StandNumbers(self._stand, parse(dumps(self._stand))), float(np.linalg.norm(self._stand.gravity))
        found = expected + error, expected, ""
        for number in file:
            sizes = [abs(multiple * number.value) for multiple in (1.0, 2.0, 0.5, g, 2.0 * g)]
            alike = any(abs(x - abs(y)) <= SAME * abs(y) for x in sizes for y in (expected, error))
            if not alike or number.body == "gravity":  # which the name of the product has
                continue
            try:
                changed = read(file.with_values({number: 1.01 * number.value}), self._stand.name, physics=False)
            except UsageError:
                continue
            factors = self._solve(of, changed)
            part = 0.0 if factors is None else (float(factors[k, component]) - expected) / 0.01
            if abs(part - expected) <= SAME * abs(expected):
                return expected + error, expected, number.path
            if any(abs(error - (likely - 1.0) * part) <= SAME * abs(error) for likely in LIKELY):
                found = part + error, part, number.path
        return found

    def _has_mass_matrix(self, terms: Sequence[WrongTerm]) -> bool:
        """Whether the equations with these terms wrong still have one acceleration, at some phases.

        "All of X is missing" is true of every wrong program: its error is K V_r* less the right-hand side, and both
        are sums of the products. But a program that answers has a mass matrix.
        """
        frame = frame_of(self._stand)
        if not frame.components:
            return True
        at, state = self._drawn_pieces[:1], self._drawn[:1]
        K = np.asarray(frame.rows.T @ at[0].K @ frame.rows)
        table, wrong = products(frame, state, at), K.copy()
        values = dict(zip(table.names, table.values[0], strict=True))
        for term in terms:
            rate = term.term.split(" ")[0]
            if term.component in frame.components and rate.removesuffix("_dot") in frame.letters and rate in values:
                error = (term.factor - (term.expected or 0.0)) * values[term.term] / values[rate]
                row = frame.freedoms[frame.letters.index(rate.removesuffix("_dot"))]
                wrong[frame.components.index(term.component)] -= error * row
        size = np.sqrt(np.diag(K))
        return bool(np.linalg.svd(wrong / np.outer(size, size), compute_uv=False)[-1] > SOLVABLE)


def _is_there(factors: Array) -> Any:
    """Mask of the factors that are more than rounding of the largest."""
    return np.abs(np.nan_to_num(factors)) > THERE * np.abs(np.nan_to_num(factors)).max(initial=0.0)


def _magnitudes(at: Pieces, state: State) -> Array:
    """Magnitudes of the terms of the wrench on the carrier (6)."""
    return np.abs(at.K) @ np.abs(at.V_r_dot(vector(state.V_dot))) + np.abs(at.F) + np.abs(bias(at))


def _other_wrenches(at: Pieces) -> Array:
    """Wrenches (6, in E1 about O1) that are no sum of these products or of coefficients of laws: laws between E0 and
    the carrier, damping of bodies with axes of their own, all laws of flywheels that are not of their weight."""
    carrier, wheels = at.bodies.bodies[0].name, {body.name for body in at.bodies.flywheels.bodies}
    others = np.zeros(6)
    for k in at.bodies.placed():
        name = k.body.name
        for kind, wrench in at.terms[name].items():
            of_law = kind in KINDS and name not in wheels
            if not (of_law or kind in PLAIN or (kind in PLAIN_ON_CARRIER and name == carrier)):
                others += k.L @ wrench
    return others


def _state(stand: Stand, rng: np.random.Generator) -> State:
    """A state in which no kind of term is much larger than another; without run-time wrenches."""
    N = len(stand.flywheels)
    numbers: Any = {
        key: tuple((spread * rng.normal(size=6 if key.startswith("V") else N)).tolist())
        for key, spread in SPREAD.items()
    }
    q = rng.normal(size=4)
    state = State(
        position=(0.0, 0.0, 0.0),
        angles=None,
        quaternion=cast(Quaternion, tuple((q / np.linalg.norm(q)).tolist())),
        phi=tuple(rng.uniform(-math.pi, math.pi, N).tolist()),
        tau=tuple(3.0 * x * w.inertia[0][0] for x, w in zip(rng.normal(size=N).tolist(), stand.flywheels, strict=True)),
        wrench=MappingProxyType({}),
        **numbers,
    )
    return state if stand.hold is None else along_freedoms(stand, state, rng)
