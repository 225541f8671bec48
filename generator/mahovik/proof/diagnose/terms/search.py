"""The search for wrong terms of a program: its requests, the errors of its equations, and what explains them."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial
from types import MappingProxyType
from typing import Any, cast

import numpy as np

from mahovik.core.stand.model import Stand, Vec6
from mahovik.core.stand.random_state import along_freedoms
from mahovik.core.stand.state import Quaternion, State
from mahovik.errors import CheckError
from mahovik.proof import reference
from mahovik.proof.diagnose.answers import Precision
from mahovik.proof.diagnose.terms.bodies import ROWS, explain
from mahovik.proof.diagnose.terms.coefficients import Multiple
from mahovik.proof.diagnose.terms.directions import freedoms_in_words, point_in_words
from mahovik.proof.diagnose.terms.equations import (
    ANSWERS,
    OF_FLYWHEELS,
    OF_HELD,
    WHERE_WRONG,
    EquationErrors,
    Equations,
    quantities_of,
)
from mahovik.proof.diagnose.terms.fit import MOST, Columns, Fit
from mahovik.proof.diagnose.terms.law_columns import LawColumn, widen
from mahovik.proof.diagnose.terms.monomials import count
from mahovik.proof.diagnose.terms.solvable import has_mass_matrix
from mahovik.proof.reference import Pieces
from mahovik.proof.reference.array import Array
from mahovik.proof.verify.actuators import stand_at, with_drawn_actuators
from mahovik.proof.verify.foreign import Program
from mahovik.proof.verify.states import Request

WANTS = tuple(ANSWERS)
"""Wants in which wrong terms are looked for."""

IMPLIED = {"coupled": ("forward", "torque")}
"""Wants that say nothing new where a program offers these, unless they differ."""

BESIDES = ("momentum",)
"""Wants whose error hinders no name of other errors where it is no few terms itself."""

MORE, SPARE = 1.25, 40
"""Number of states for each product, and of those besides."""

REPEATED = 5
"""States that are asked for twice: a program that answers otherwise is not deterministic."""

FEW = 4
"""Terms of a component up to which an exact fit needs no other explanation; that of a whole equation has dozens."""

SPREAD = {"V": 1.0, "phi_dot": 3.0, "phi_ddot": 3.0, "V_dot": 1.0}
"""Standard deviations of the states, SI: no kind of term is much larger than another."""

ALIKE = 1e-3
"""Relative difference of factors of one term in two wants, which float leaves."""

ORDER = 1e-9
"""Relative difference within which an answer is that of another state."""

PART = 0.03
"""Part of what is accepted of answers that the errors of equations may be, which are before all solving."""

ROUNDING = 1e-11
"""Error over the size of the terms that a right program in double may have."""


@dataclass(frozen=True)
class WrongTerm:
    """A wrong term of a program.

    component  letter of SNAME of the wrench on the carrier, or of the momentum; or the flywheel's name
    term       the product; on the right-hand side of K V* = ..., in the drive torque or in the momentum
    multiple   its factor in the program, the right one, and what both are multiples of
    error      their difference, SI
    share      its mean square over the sum of those of all wrong terms of the want
    twins      other products that explain the error as well in its place, at the states that there are
    likely     whether it alone of its twins is a product of the right equations
    of_body    whether it is a vector term of bodies, which `component` names, in all components
    """

    want: str
    component: str
    term: str
    multiple: Multiple
    error: float
    share: float
    twins: tuple[str, ...] = ()
    likely: bool = False
    of_body: bool = False


@dataclass(frozen=True)
class TermSearchResult:
    """Result of a search for wrong terms.

    terms        what explains most of the error
    unexplained  the part of the error that they leave, 0 to 1 (root mean square)
    wants        those that were looked at
    exact        whether they leave nothing beyond rounding
    besides      wants whose error is no few terms, beside others whose error is
    looked_at    quantities whose errors were looked at, as want: quantity
    about        the point that moments are about, in words
    freedoms     what the names of equations and speeds of a held carrier stand for
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
        return tuple(each for each in self.terms if each.twins and not each.likely) if self.exact else ()


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
        self._own = [_state(stand, rng) for _ in range(math.ceil(MORE * count(stand)) + SPARE)]
        if program is not None and program.actuators:
            self._own = [with_drawn_actuators(stand, state, rng) for state in self._own]
        asked = self._own if program is None else [program.state(stand, state) for state in self._own]
        named = [(f"term {i}", state) for i, state in enumerate(asked)] if states is None else states
        self._states = [state for _, state in named]
        self._equations = Equations(stand, self._own)
        self.wants = tuple(
            want
            for want in WANTS
            if want in wants
            and (stand.flywheels or want not in OF_FLYWHEELS)
            and (stand.hold is not None or want not in OF_HELD)
            and (want not in WHERE_WRONG or (want in wrong and stand.hold is None))
            and not _is_implied(want, wants, wrong)
        )
        self._requests = {
            want: [Request(f"{name}, {want}", state, (want,)) for name, state in named] for want in self.wants
        }
        self._again = {
            want: [replace(each, id=f"{each.id}, again") for each in asked[:REPEATED]] if states is None else []
            for want, asked in self._requests.items()
        }

    @property
    def requests(self) -> list[Request]:
        """Requests for a program; the last are some of the first once more."""
        first = [each for asked in self._requests.values() for each in asked]
        return first + [each for asked in self._again.values() for each in asked]

    def find(self, answers: Answers) -> TermSearchResult:
        """The wrong terms of a program by its answers to `requests`.

        Raises CheckError where it answers one state in two ways, or too few states.
        """
        self._check_repeats(answers)
        found: list[WrongTerm] = []
        fits: list[Fit] = []
        besides: list[str] = []
        unexplained = set(self._wrong)
        for want in self.wants:
            parts = [self._terms(want, errors, found) for errors in self._errors(want, answers)]
            if want in BESIDES and fits and not all(fit.exact for _, of_part in parts for fit in of_part):
                besides.append(want)
                continue
            for terms, of_part in parts:
                unexplained -= {each.want for each in terms}
                found += [x for x in terms if not (want in IMPLIED and any(_is_same(x, other) for other in found))]
                fits += of_part
        in_forces = [(x.component, x.term, x.error) for x in found if x.want in ("forward", "coupled", "momentum")]
        if not has_mass_matrix(self._stand, in_forces):
            return TermSearchResult((), 1.0, self.wants, False, tuple(besides))
        left, exact = max((each.left for each in fits), default=0.0), all(each.exact for each in fits)
        words = point_in_words(self._stand), freedoms_in_words(self._stand)
        looked_at = tuple(
            f"{want}: {name}"
            for want in sorted(set(self.wants) - set(besides) - unexplained)
            for name in sorted({*self._names(want, answers), *ANSWERS[want]})  # V_dot of a hold is S u_dot
        )
        return TermSearchResult(tuple(found), left, self.wants, exact, tuple(besides), *words, looked_at)

    def _check_repeats(self, answers: Answers) -> None:
        for want, again in self._again.items():
            for first, second in zip(self._requests[want], again, strict=False):
                names = quantities_of(self._stand, want)
                if _values(answers(first), names) != _values(answers(second), names):
                    raise CheckError(
                        f"it is not deterministic: {want} of state {first.id!r} has another answer when it is asked "
                        "for again; a diagnosis needs a program without memory and chance"
                    )

    @cached_property
    def _pieces(self) -> list[Pieces]:
        return [reference.pieces(stand_at(self._stand, state), state) for state in self._states]

    def _errors(self, want: str, answers: Answers) -> list[EquationErrors]:
        """Errors of a want at the states with finite answers. Raises CheckError: too few."""
        rows, values = self._collect_answers(want, answers)
        right = self._right_quantities(want, rows, values)
        at = [self._pieces[i] for i in rows]
        found = self._equations.errors(want, [self._states[i] for i in rows], at, values, right)
        least = max(len(each.products) for each in found)
        if len(rows) < least:
            raise CheckError(
                f"{want}: {len(rows)} of {len(self._states)} states have an answer; expected at least {least}, as many "
                "as there are products whose factors are looked for"
            )
        return found

    def _names(self, want: str, answers: Answers) -> tuple[str, ...]:
        """Quantities that the error of a want is taken from."""
        names = quantities_of(self._stand, want)
        of_hold = "u_dot" in names and not set(OF_HELD) & set(self.wants)
        if of_hold and any("reaction" in answers(request) for request in self._requests[want]):
            return (*names, "reaction")  # no want of its own tells it; a program may leave it out here too
        return names

    def _collect_answers(self, want: str, answers: Answers) -> tuple[list[int], dict[str, Array]]:
        """Rows of the states that have finite answers, and these by quantity. Raises CheckError: none."""
        rows: list[int] = []
        N, hold = len(self._stand.flywheels), self._stand.hold
        names = self._names(want, answers)
        lengths = {"u_dot": (len(hold.freedoms) if hold else 0,), "tau": (N,), "phi_ddot": (N,), "mount_wrench": (N, 6)}
        found: dict[str, list[Array]] = {name: [] for name in names}
        sizes = [lengths.get(name, (6,)) for name in names]
        for i, request in enumerate(self._requests[want]):
            given = answers(request)
            try:
                values = [np.array(given.get(name), dtype=np.float64) for name in found]
            except (TypeError, ValueError, OverflowError):
                continue
            if [x.shape for x in values] == sizes and all(np.isfinite(x).all() for x in values):
                rows.append(i)
                for name, x in zip(found, values, strict=True):
                    found[name].append(x.ravel())
        if not rows:
            raise CheckError(
                f"{want}: 0 of {len(self._states)} states have an answer; expected at least {len(self._own)}"
            )
        return rows, {name: np.array(x) for name, x in found.items()}

    def _right_quantities(self, want: str, rows: Sequence[int], values: Mapping[str, Array]) -> frozenset[str]:
        """Quantities that are answered rightly. Raises CheckError: wrong answers are the right ones of other states."""
        right = [
            reference.evaluate(stand_at(self._stand, self._states[i]), self._states[i], (want,), self._pieces[i])
            for i in rows
        ]
        expected = np.array([np.concatenate([np.ravel(each[name]) for name in values]) for each in right])
        given = np.hstack(list(values.values()))
        size = np.abs(expected).max(axis=0) + 1e-300
        off = np.abs((given - expected) / size)
        wrong = np.flatnonzero(off.max(axis=1) > ORDER)
        swapped: dict[int, int] = {}
        for i in wrong.tolist():
            same = np.flatnonzero(np.abs((given[i] - expected) / size).max(axis=1) <= ORDER)
            if same.size:
                swapped[i] = int(same[0])
        if len(set(swapped.values())) > len(wrong) / 2:
            i, j = next(iter(swapped.items()))
            names = [self._requests[want][rows[k]].id for k in (i, j)]
            raise CheckError(f"it answers another state's result: that to {names[0]!r} is right for {names[1]!r}")
        parts = np.split(off, np.cumsum([x.shape[1] for x in values.values()])[:-1], axis=1)
        return frozenset(name for name, x in zip(values, parts, strict=True) if (x <= self._rounding).all())

    def _terms(self, want: str, of: EquationErrors, before: Sequence[WrongTerm]) -> tuple[list[WrongTerm], list[Fit]]:
        """Wrong terms of all components, and the fit of each wrong one; of whole bodies where these are fewer."""
        by_body = self._body_terms(want, of, before)
        wrong_rows = np.sqrt(np.mean(of.error**2, axis=0)) > 10 * self._rounding * np.sqrt(np.mean(of.size**2))
        if by_body and (len(by_body) < np.count_nonzero(wrong_rows) or not of.products):
            return by_body, [Fit({}, 0.0, True)]
        if not of.products:
            return [], [Fit({}, 1.0)] if wrong_rows.any() else []
        terms, fits = self._product_terms(want, of)
        if by_body and (len(by_body) < len(terms) or not all(fit.exact for fit in fits)):
            return by_body, [Fit({}, 0.0, True)]
        return terms, fits

    def _body_terms(self, want: str, of: EquationErrors, before: Sequence[WrongTerm]) -> list[WrongTerm]:
        """One wrong term, or two, of whole bodies that explain all components; none where they do not.

        `before`: those of other wants, which come before terms of the same effect.
        """
        error = of.error[:ROWS]
        rounding = self._rounding * np.sqrt(np.mean(of.size**2, axis=0))
        if of.bodies is None or (np.sqrt(np.mean(error**2, axis=0)) <= 10 * rounding).all():
            return []
        terms, columns = of.bodies()
        known = {(each.component, each.term) for each in before}
        first = [j for j, each in enumerate(terms) if (each.bodies, each.name) in known]
        found = explain(error, columns, np.maximum(rounding, 1e-3 * rounding.max()), first)
        sizes = [float(np.sum((c * columns[j]) ** 2)) for j, c in found]
        return [
            WrongTerm(
                want, terms[j].bodies, terms[j].name,
                Multiple(round(terms[j].expected + c, 9) + 0.0, terms[j].expected, ""),
                c, size / sum(sizes), of_body=True,
            )
            for (j, c), size in zip(found, sizes, strict=True)
        ]  # fmt: skip

    def _product_terms(self, want: str, of: EquationErrors) -> tuple[list[WrongTerm], list[Fit]]:
        """Wrong products of all components, and the fit of each wrong one."""
        products = of.products
        found: list[tuple[int, int, str, Multiple, float, float]] = []
        fits: list[Fit] = []
        doubts: dict[tuple[int, int], tuple[tuple[str, ...], bool]] = {}
        rounding = self._rounding * float(np.sqrt(np.mean(of.size**2)))
        for component in range(len(of.components)):
            wrong = of.error[:, component]
            if np.sqrt(np.mean(wrong**2)) <= 10 * rounding:
                continue
            fit, of_laws = _fit(of, component, wrong, rounding)
            if fit.exact and not any(k >= len(products) for k in fit.coefficients):
                fit, twins = _likeliest(of.columns, fit, wrong, rounding, partial(of.occurs, component))
                for k, (others, likely) in twins.items():
                    doubts[component, k] = tuple(products[i].term for i in others), likely
            fits.append(fit if fit.coefficients else replace(fit, left=1.0))
            for k, c in fit.coefficients.items():
                column = of_laws[k - len(products)] if k >= len(products) else None
                product = products[k] if column is None else column.product
                multiple = of.multiple(component, k, c) if column is None else column.multiple(c)
                size = float(np.sum((c * product.values) ** 2))
                found.append((component, k, product.term, multiple, c, size))
        whole = sum(each[5] for each in found) or 1.0
        terms = [
            WrongTerm(
                want, of.components[component], term, multiple, c, part / whole,
                *doubts.get((component, k), ((), False)),
            )
            for component, k, term, multiple, c, part in found
        ]  # fmt: skip
        return sorted(terms, key=lambda term: -term.share), fits


def _is_same(term: WrongTerm, other: WrongTerm) -> bool:
    """Whether two wants have one wrong term."""
    a, b = term.multiple, other.multiple
    same = (term.component, term.term, a.coefficient, a.expected) == (
        other.component,
        other.term,
        b.coefficient,
        b.expected,
    )
    return same and abs(a.factor - b.factor) <= ALIKE * max(abs(a.factor), 1.0)


def _is_implied(want: str, wants: Sequence[str], wrong: Sequence[str]) -> bool:
    """Whether other wants tell all that a want does: not where it is known to differ."""
    others = IMPLIED.get(want, ())
    return bool(others) and set(others) <= set(wants) and want not in wrong


def _fit(of: EquationErrors, component: int, error: Array, rounding: float) -> tuple[Fit, list[LawColumn]]:
    """The fit of a component by products; where these are not a few, with coefficients of laws behind them."""
    best: tuple[Fit, list[LawColumn]] = of.columns.fit(error, rounding), []
    for of_laws in of.of_laws.of(component) if of.of_laws is not None and not _is_short(best[0]) else ():
        wide, kept = widen(of.columns, of_laws)
        fit = wide.fit(error, rounding)
        if fit.exact and (not best[0].exact or len(fit.coefficients) < len(best[0].coefficients)):
            best = fit, kept
        if _is_short(best[0]):
            break
    return best


def _is_short(fit: Fit) -> bool:
    """Whether a fit is exact with so few columns that no other is looked for."""
    return fit.exact and len(fit.coefficients) <= FEW


def _likeliest(
    columns: Columns, fit: Fit, error: Array, rounding: float, occurs: Callable[[int], bool]
) -> tuple[Fit, dict[int, tuple[list[int], bool]]]:
    """The fit with each column of which only one twin occurs in the right equations replaced by this one.

    Also the twins of each column, and whether it alone of them occurs.
    """
    twins = columns.twins(fit, error, rounding)
    doubtful = {k: (others, False) for k, others in twins.items()}
    if columns.too_few(fit):
        return fit, doubtful
    found: dict[int, tuple[list[int], bool]] = {}
    kept = list(fit.coefficients)
    for k, others in twins.items():
        there = [i for i in (k, *others) if occurs(i)]
        if len(there) == 1:
            kept[kept.index(k)] = there[0]
            found[there[0]] = [i for i in (k, *others) if i != there[0]], True
        else:
            found[k] = others, False
    changed = columns.refit(kept, error, rounding)
    return (changed, found) if changed.exact else (fit, doubtful)


def _values(answer: Mapping[str, Any], names: Sequence[str]) -> Any:
    return repr([np.array(answer.get(name), dtype=object).tolist() for name in names])  # NaN is equal


def _state(stand: Stand, rng: np.random.Generator) -> State:
    """A state in which no kind of term is much larger than another; without run-time wrenches."""
    N = len(stand.flywheels)

    def normal(name: str, size: int) -> tuple[float, ...]:
        return tuple(float(x) for x in SPREAD[name] * rng.normal(size=size))

    q = rng.normal(size=4)
    q /= np.linalg.norm(q)
    state = State(
        position=(0.0, 0.0, 0.0),
        angles=None,
        quaternion=cast(Quaternion, tuple(float(x) for x in q)),
        V=cast(Vec6, normal("V", 6)),
        phi=tuple(float(x) for x in rng.uniform(-math.pi, math.pi, N)),
        phi_dot=normal("phi_dot", N),
        phi_ddot=normal("phi_ddot", N),
        V_dot=cast(Vec6, normal("V_dot", 6)),
        tau=tuple(x * wheel.inertia[0][0] for x, wheel in zip(normal("phi_ddot", N), stand.flywheels, strict=True)),
        wrench=MappingProxyType({}),
    )
    return state if stand.hold is None else along_freedoms(stand, state, rng)
