"""The search for wrong terms of a program: its requests, the errors of its equations, and terms that explain them."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import cached_property
from types import MappingProxyType
from typing import Any, cast

import numpy as np

from mahovik.core.stand.model import WRENCH_LETTERS, Quaternion, Stand, State
from mahovik.core.stand.numbers import StandNumber, StandNumbers, exact
from mahovik.core.stand.random import along_freedoms
from mahovik.core.stand.stand_file import document_of, read
from mahovik.errors import CheckError, UsageError
from mahovik.proof import reference
from mahovik.proof.diagnose.answers import (
    ACCEPTED,
    LEAST,
    Answers,
    Precision,
    numbers_at,
    separating_states,
    spread_rows,
)
from mahovik.proof.diagnose.columns import (
    BEYOND,
    ROWS,
    Frame,
    Law,
    body_terms,
    count_products,
    explain,
    frame_in_words,
    frame_of,
    is_wrong,
    law_columns,
    laws_at,
    like_product,
    products,
)
from mahovik.proof.diagnose.fit import MOST, Columns, Fit, Mask, least_squares
from mahovik.proof.reference import Pieces
from mahovik.proof.reference.algebra import Array, vector
from mahovik.proof.reference.motion import mounts, reaction, torque
from mahovik.proof.reference.pieces import LawTerm, momentum
from mahovik.proof.verify.draw import with_drawn_actuators
from mahovik.proof.verify.foreign import Program
from mahovik.proof.verify.scales import Scales
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

SIDES = {"torque": "torque", "mounts": "mounts", "momentum": "momentum", "reaction": "wrench", "inverse": "wrench"}
"""The side that the last quantity of a want is, that of the reaction with the other sign."""

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

PART, CHECKED = 0.03, 16
"""Error over the size of the terms that a right program may have: a part of what is accepted of its answers. Rows of a
log at which what is left of the error is checked."""

IN_PRODUCTS = "gravity", "stream", "profile"
"""Tables and keys whose numbers are in the values of the products."""

PLAIN = "weight", "buoyancy", "run-time"
PLAIN_ON_CARRIER = "linear damping", "quadratic damping", "damping terms", "products in derivatives"
"""Kinds of wrench that are sums of products, of any body and in the axes of the carrier alone."""


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

    side     of RIGHT; frame: names of equations and speeds
    error    (n, c) of what the program has there; noise: what of it a right program may have
    checked  the states (n) of the check: no number may be off by more there
    """

    want: str
    side: str
    frame: Frame
    states: Sequence[State]
    at: Sequence[Pieces]
    error: Array
    noise: Array
    checked: Mask

    @property
    def relative(self) -> Array:
        """The error over its noise (n, c)."""
        return self.error / self.noise

    def at_rows(self, rows: Sequence[int]) -> _Equations:
        """These equations at some of the states."""
        arrays = {key: getattr(self, key)[rows] for key in ("error", "noise", "checked")}
        return replace(self, states=[self.states[i] for i in rows], at=[self.at[i] for i in rows], **arrays)

    def remainder(self, explained: Array) -> float:
        """Part of the error that what explains it (n, c) leaves, 0 to 1; 0 where that is rounding."""
        rest = self.relative - explained / self.noise
        beyond = (np.abs(rest[self.checked]) > 1.0).any()
        return float(np.linalg.norm(rest) / np.linalg.norm(self.relative)) if beyond else 0.0


@dataclass(frozen=True, eq=False)
class _Right:
    """What the right equations have of the products, at the states that are drawn.

    table    the products (n, m); beside: wrenches (n, c) that are no sum of them
    factors  of the products (m, c); NaN where not known
    parts    of these factors, what is proportional to a number of the stand file; NaN where not known
    """

    table: Array
    beside: Array
    factors: Array
    parts: dict[StandNumber, Array]


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
        of_bodies: bool = False,
        most: int = MOST,
    ) -> None:
        """`states`: the only ones with answers, by name, as in a log; None: those that the search asks for.

        `precision`: of the program, None: double; `program`: which states it takes, None: all; `wrong`: quantities that
        are known to differ, as want: quantity; none: any may; `of_bodies`: only terms of whole bodies, by few states;
        `most`: terms that are of use.
        """
        rng = np.random.default_rng(seed)
        self._stand, self._wrong = stand, {tuple(label.split(": ")) for label in wrong}
        self._precision = precision or Precision("double", ACCEPTED["double"], 17, 330)
        self._printed, self._scales = 2.0 * 10.0 ** (1 - self._precision.digits), Scales(stand)
        self._rounding = max(ACCEPTED["double"], PART * self._precision.accepted, self._printed)
        self._of_bodies, self._most = of_bodies, most
        count = ROWS if of_bodies else math.ceil(MORE * count_products(stand)) + SPARE
        self._drawn = [_state(stand, rng) for _ in range(count)]
        if program is not None and program.actuators:
            self._drawn = [with_drawn_actuators(stand, state, rng) for state in self._drawn]
        asked = self._drawn if program is None else [program.state(stand, state) for state in self._drawn]
        if states is None:
            fitted, checks = [(f"term {i}", x) for i, x in enumerate(asked)], separating_states(stand, seed, program)
        else:
            fitted, checks = [*states], spread_rows(states, CHECKED)
        named, self._fitted = [*fitted, *checks], len(fitted)
        self._states = [state for _, state in named]
        differing = {want for want, _ in self._wrong}
        is_told = {"forward", "torque"} <= set(wants)  # of "coupled", which says nothing new then
        self.wants = tuple(
            want
            for want in WANTS
            if want in (differing or wants)
            and want in wants
            and (stand.flywheels or want not in OF_FLYWHEELS)
            and (stand.hold is not None or want not in OF_HELD)
            and (want not in WHERE_WRONG or (want in differing and stand.hold is None))
            and (want != "coupled" or differing or not is_told)
        )
        self._requests = {
            want: [Request(f"{name}, {want}", state, (want,)) for name, state in named] for want in self.wants
        }
        self._right: dict[tuple[str, ...], _Right] = {}

    @property
    def requests(self) -> list[Request]:
        """Requests for a program."""
        return [request for requests in self._requests.values() for request in requests]

    def find(self, answers: Answers) -> TermSearchResult:
        """The wrong terms of a program by its answers to `requests`. Raises CheckError: it answers too few states."""
        terms, fits, besides = list[WrongTerm](), list[Fit](), list[str]()
        unexplained = {want for want, _ in self._wrong}
        whole = [want for want in self.wants if any(self._whole(want, x, answers) for x in self._requests[want])]
        for want in whole or self.wants:
            parts = [self._terms(equations, terms) for equations in self._equations(want, answers)]
            if want in BESIDES and fits and not all(fit.exact for _, of_part in parts for fit in of_part):
                besides.append(want)
                continue
            if want not in BESIDES and not all(fit.exact for _, of_part in parts for fit in of_part):
                return TermSearchResult((), 1.0, self.wants, False)
            for of_part, more in parts:
                unexplained -= {term.want for term in of_part}
                terms += [x for x in of_part if not (want == "coupled" and any(_is_same(x, y) for y in terms))]
                fits += more
        left, exact = max((fit.left for fit in fits), default=0.0), all(fit.exact for fit in fits)
        looked_at = tuple(
            f"{want}: {name}"
            for want in sorted(set(whole) - set(besides) - unexplained)
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
        names = ("u_dot" if hold.freedoms else "reaction", *names[1:])
        beside = hold.freedoms and "reaction" not in self.wants
        answered = beside and any("reaction" in answers(request) for request in self._requests[want])
        return (*names, "reaction") if answered else names

    def _answered(self, want: str, answers: Answers) -> tuple[list[int], dict[str, Array], dict[str, Array]]:
        """Rows of the states with finite answers; by quantity these (n, ...), and their rounding at the checks.

        Raises CheckError: there are none.
        """
        names, rows, noise = self._names(want, answers), dict[int, list[Array]](), dict[int, list[Array]]()
        for i, request in enumerate(self._requests[want]):
            measured = self._scales.want(request.state, want) if i >= self._fitted else None
            numbers = self._whole(want, request, answers)
            if numbers and (measured or i < self._fitted):
                scales = [np.ravel(measured.scales[name]) if measured else np.zeros(1) for name in names]
                rows[i] = numbers
                noise[i] = [self._noise(x, scale) for x, scale in zip(numbers, scales, strict=True)]
        self._check_count(want, sum(i < self._fitted for i in rows), 1)
        values, rounding = (
            {name: np.array(x) for name, x in zip(names, zip(*of.values(), strict=True), strict=True)}
            for of in (rows, noise)
        )
        return list(rows), values, rounding

    def _noise(self, numbers: Array, scale: Array) -> Array:
        """Rounding of answered numbers with a scale, which are larger where they are wrong."""
        scale = np.maximum(scale, np.abs(numbers))
        return self._precision.noise(numbers, scale) + self._printed * scale

    def _check_count(self, want: str, count: int, least: int) -> None:
        """Raise CheckError where so many states with an answer to a want are too few."""
        if count < least:
            raise CheckError(
                f"{want}: {count} of {self._fitted} states have an answer; expected at least "
                f"{count_products(self._stand)}, as many as there are products whose factors are looked for"
            )

    def _whole(self, want: str, request: Request, answers: Answers) -> list[Array]:
        """Numbers of the quantities of a want in the answer to a request; none unless they are all there."""
        N, m = len(self._stand.flywheels), len(self._stand.hold.freedoms) if self._stand.hold else 0
        sizes = {"tau": N, "phi_ddot": N, "mount_wrench": 6 * N, "u_dot": m}
        names = self._names(want, answers)
        numbers = [numbers_at(answers(request), (name,)) for name in names]
        there = [x.ravel() for x in numbers if x is not None and np.isfinite(x).all()]
        return there if [x.size for x in there] == [sizes.get(name, 6) for name in names] else []

    def _equations(self, want: str, answers: Answers) -> Iterator[_Equations]:
        """Equations of a want at the motion that the program answers.

        Beside a wrong acceleration the equation of a right one, or of a right reaction, has no error of its own.
        """
        rows, values, noise = self._answered(want, answers)
        checked = np.array(rows) >= self._fitted
        at, states = [self._pieces[i] for i in rows], [self._states[i] for i in rows]
        motion = {key: values[key] for key in ("V_dot", "phi_ddot") if key in values}
        if "u_dot" in values:
            motion["V_dot"] = values["u_dot"] @ frame_of(self._stand).rows.T
        for key, numbers in motion.items():
            rows_of: Any = [{key: tuple(x)} for x in numbers.tolist()]
            states = [replace(s, **x) for s, x in zip(states, rows_of, strict=True)]
        moved = {name: x for name, x in noise.items() if name in ("V_dot", "u_dot", "phi_ddot")}

        def equations(side: str, kind: str, answered: Array, noise: Mapping[str, Array]) -> _Equations:
            frame = self._frame(side, kind)
            sides = np.array([RIGHT[side](p, s) for p, s in zip(at, states, strict=True)])
            size = np.abs(sides)
            if side == "wrench":
                size = np.array([_magnitudes(p, s) for p, s in zip(at, states, strict=True)])
            rounding = self._rounding * np.sqrt(np.mean((size[~checked] @ np.abs(frame.rows)) ** 2, axis=0))
            off = np.tile(np.maximum(rounding, 1e-3 * rounding.max(initial=LEAST)), (len(at), 1))
            for i in np.flatnonzero(checked):
                slopes = {name: _slope(at[i], side, name, frame) for name in noise}
                off[i] = np.maximum(sum(np.abs(frame.rows.T @ slopes[name]) @ x[i] for name, x in noise.items()), LEAST)
            return _Equations(want, side, frame, states, at, (answered - sides) @ frame.rows, off, checked)

        side, last = SIDES.get(want, ""), values[ANSWERS[want][-1]] if want in SIDES else None
        if last is not None:
            yield equations(side, "all", -last if want == "reaction" else last, noise)
            return
        none = np.zeros((len(rows), 6))
        blocked = -values["reaction"] if "reaction" in values else none
        kinds = {
            "V_dot": ("wrench", "free", none, moved),
            "u_dot": ("wrench", "free", none, moved),
            "phi_ddot": ("torque", "free", np.array([s.tau for s in states]), moved),
            "reaction": ("wrench", "blocked", blocked, noise),
        }
        wrong = {name for of, name in self._wrong if of == want} or {*values}
        for name in values:
            looked_at = name in wrong or not wrong & {*motion, "u_dot"}
            if looked_at and self._frame(*kinds[name][:2]).components:
                yield equations(*kinds[name])

    def _frame(self, side: str, equations: str) -> Frame:
        """Names of equations and speeds of a side; of the wrench on the carrier those that are free, blocked or all."""
        wheels = tuple(wheel.name for wheel in self._stand.flywheels)
        names = {"torque": wheels, "mounts": tuple(f"{k} {letter}" for k in wheels for letter in WRENCH_LETTERS)}
        if side not in names:
            return frame_of(self._stand, equations)
        return replace(frame_of(self._stand), components=names[side], rows=np.eye(len(names[side])))

    @cached_property
    def _file(self) -> StandNumbers:
        return StandNumbers(self._stand, exact(document_of(self._stand)))

    @cached_property
    def _pieces(self) -> list[Pieces]:
        return self._pieces_of(self._states, self._stand)

    @cached_property
    def _drawn_pieces(self) -> list[Pieces]:
        return self._pieces_of(self._drawn, self._stand)

    @cached_property
    def _laws_beside(self) -> list[Law]:
        """Laws that may hold a product beside `_Right`, at the first of the states that are drawn."""
        laws = laws_at(self._stand, self._drawn[:ROWS], self._drawn_pieces[:ROWS])
        plain = f"{self._stand.carrier.name}.damping"
        return [law for law in laws if law.path != plain and not law.path.endswith(".buoyancy")]

    def _pieces_of(self, states: Sequence[State], stand: Stand) -> list[Pieces]:
        return [reference.pieces(stand_at(stand, state), state) for state in states]

    # -- terms ---------------------------------------------------------------------------------------------------------

    def _terms(self, of: _Equations, before: Sequence[WrongTerm]) -> tuple[list[WrongTerm], list[Fit]]:
        """Wrong terms of all components, and the fit of each wrong one; of whole bodies where these are fewer."""
        by_body, wrong = self._body_terms(of, before), is_wrong(of.relative, of.checked)
        fit = by_body[1]
        again = {(x.component, x.term) for x in by_body[0]} <= {(x.component, x.term) for x in before}
        fewest = fit.exact and not fit.left and (again or len(by_body[0]) < wrong.sum())
        if of.side == "mounts" or not wrong.any() or fewest:
            return by_body[0], [fit]
        fitted = int((~of.checked).sum())
        if wrong.sum() > self._most:  # products would be more, one at least of each component
            return by_body[0], [fit]
        if not fit.exact or self._of_bodies:
            self._check_count(of.want, fitted, count_products(self._stand))
        elif fitted < count_products(self._stand):
            return by_body[0], [fit]
        terms, fits = self._product_terms(of)
        left = max(fit.left for fit in fits)
        if fit.exact and (not all(x.exact for x in fits) or (fit.left > 0, len(by_body[0])) < (left > 0, len(terms))):
            return by_body[0], [fit]
        return terms, fits

    def _body_terms(self, of: _Equations, before: Sequence[WrongTerm]) -> tuple[list[WrongTerm], Fit]:
        """Few wrong terms of whole bodies that explain all components, and what they leave.

        `before`: those of other wants, which come before terms of the same effect.
        """
        wrong = is_wrong(of.relative, of.checked).any()
        if not wrong or of.side == "momentum" or not self._stand.flywheels:
            return [], Fit({}, float(wrong), exact=not wrong)
        of = of.at_rows([*np.flatnonzero(~of.checked)[:ROWS], *np.flatnonzero(of.checked)])
        columns = body_terms(of.states, of.at, of.side, of.frame.rows)
        known = {(term.component, term.term) for term in before}
        explained = explain(of.error, columns, of.noise, of.checked, [term for term in columns if term[:2] in known])
        if explained is None:
            return [], Fit({}, 1.0)
        sizes = {term: float(np.sum((c * columns[term][~of.checked]) ** 2)) for term, c in explained.factors.items()}
        return [
            WrongTerm(of.want, body, name, round(expected + c, 9) + 0.0, expected, of_body=True,
                      share=sizes[body, name, expected] / sum(sizes.values()))
            for (body, name, expected), c in explained.factors.items()
        ], Fit({}, explained.left, exact=True)  # fmt: skip

    def _product_terms(self, of: _Equations) -> tuple[list[WrongTerm], list[Fit]]:
        """Wrong products of the components that are wrong, and the fit of each."""
        fitted = ~of.checked
        error, rounding = of.error[fitted], float(np.sqrt(np.mean(of.noise[fitted] ** 2)))
        wrong = np.flatnonzero(np.sqrt(np.mean(error**2, axis=0)) > BEYOND * rounding).tolist()
        explained = np.zeros_like(of.error)
        table = products(of.frame, of.states, of.at, of.side == "momentum")
        laws = laws_at(self._stand, of.states, of.at) if of.side == "wrench" else []
        columns, right = Columns(table.values[fitted], table.accelerate), self._right_factors(of)
        told: list[tuple[int, int, LawTerm, float, tuple[str, ...]]] = []
        fits: list[Fit] = []
        for i in wrong:
            there = _is_there(right.factors[:, i])
            factors = np.where(there | np.isnan(right.factors[:, i]), right.factors[:, i], 0.0).tolist()
            of_table = [LawTerm(0, name, "", *x) for name, *x in zip(table.names, factors, table.values.T, strict=True)]
            fit, among = columns.fit(error[:, i], rounding, there), of_table
            columns_of_laws = law_columns(laws, of.frame.rows[:, i])
            while not (fit.exact and len(fit.coefficients) <= FEW):
                if (finer := next(columns_of_laws, None)) is None:
                    break
                kept = columns.independent(np.column_stack([x.wrench[fitted] for x in finer]))
                wide = np.column_stack([table.values[fitted], *(finer[j].wrench[fitted] for j in kept)])
                more = np.full(len(kept), False)
                widened = Columns(wide, np.append(table.accelerate, more), columns)
                other = widened.fit(error[:, i], rounding, np.append(there, ~more))
                if other.exact and (not fit.exact or len(other.coefficients) < len(fit.coefficients)):
                    fit, among = other, [*of_table, *(finer[j] for j in kept)]
            mass = np.flatnonzero(there & table.accelerate).tolist()
            left = np.abs([right.factors[k, i] + fit.coefficients.get(k, 0.0) for k in mass])
            if not fit.exact or (mass and (left <= SAME * np.abs(right.factors[mass, i])).all()):
                return [], [Fit({}, 1.0)]  # "all of it is missing" is true of every wrong equation, but there is a mass
            if places := list(fit.coefficients):  # to all digits, by all states
                A = np.column_stack([among[k].wrench for k in places]) / of.noise[:, [i]]
                size = np.linalg.norm(A, axis=0)
                factors = np.linalg.lstsq(A / size, of.relative[:, i], rcond=None)[0] / size
                explained[:, i] = np.column_stack([among[k].wrench for k in places]) @ factors
                for k, c in zip(places, factors.tolist(), strict=True):
                    told.append((i, k, among[k], c, tuple(among[j].term for j in fit.twins.get(k, ()))))
            fits.append(fit if fit.coefficients else replace(fit, left=1.0))
        self._find_parts(
            of,
            right,
            [size for _, _, x, c, _ in told if abs(x.value) > 0.0 and not x.coefficient for size in (x.value, c)],
        )
        terms: list[tuple[float, WrongTerm]] = []
        for i, k, x, c, twins in told:
            factor, expected, path = self._named(of, right, i, k, x, c)
            factor = 0.0 if abs(factor) <= SAME * abs(expected or 0.0) else factor
            term = WrongTerm(of.want, of.frame.components[i], x.term, factor, expected, path, twins=twins)
            terms.append((float(np.sum((c * x.wrench[fitted]) ** 2)), term))
        whole = sum(size for size, _ in terms) or 1.0
        fits = [replace(fit, left=of.remainder(explained)) for fit in fits] or [Fit({}, 1.0)]
        return [replace(x, share=size / whole) for size, x in sorted(terms, key=lambda x: -x[0])], fits

    def _right_factors(self, of: _Equations) -> _Right:
        """What the right equations have of the products. Other wrenches may hold a product that nothing else has."""
        key = (of.side, *of.frame.components)
        if key not in self._right:
            at = self._drawn_pieces
            table = products(of.frame, self._drawn, at, of.side == "momentum").values
            right = _sides(of, at, self._drawn)
            beside = np.array([_other_wrenches(p) for p in at]) @ of.frame.rows if of.side == "wrench" else 0.0 * right
            factors = least_squares(table, right - beside)
            unknown = beside.any(axis=0) & ~_is_there(factors)
            self._right[key] = _Right(table, beside, np.where(unknown, math.nan, factors), {})
        return self._right[key]

    def _find_parts(self, of: _Equations, right: _Right, sizes: Sequence[float]) -> None:
        """Add the parts of numbers that factors of these sizes may be proportional to."""
        stands = dict[StandNumber, Stand]()
        for number in self._file:
            if number not in right.parts and self._may_have(number, sizes):
                with suppress(UsageError):
                    changed = self._file.with_values({number: 1.01 * number.value})
                    stands[number] = read(changed, self._stand.name, physics=False)
        if stands:
            sides = [_sides(of, self._pieces_of(self._drawn, x), self._drawn) - right.beside for x in stands.values()]
            factors = np.hsplit(least_squares(right.table, np.hstack(sides)), len(sides))
            right.parts.update({x: (y - right.factors) / 0.01 for x, y in zip(stands, factors, strict=True)})

    def _may_have(self, number: StandNumber, sizes: Sequence[float]) -> bool:
        """Whether a factor of one of some sizes, or an error, is likely to be of a number."""
        g = float(np.linalg.norm(self._stand.gravity))
        values = [abs(multiple * number.value) for multiple in (1.0, 2.0, 0.5, g, 2.0 * g)]
        likely = any(abs(x - abs(size)) <= SAME * abs(size) for x in values for size in sizes)
        return likely and number.body not in IN_PRODUCTS

    def _named(
        self, of: _Equations, right: _Right, i: int, k: int, term: LawTerm, error: float
    ) -> tuple[float, float | None, str]:
        """A factor, the right one if it is known, and the numbers of the stand file that it is of.

        Of a product of component i it is all of its factor, with that of other laws whose columns are this product; or
        the part that a number has, where this number alone explains the error by a likely factor.
        """
        if term.coefficient:
            return term.value + error, term.value, term.coefficient
        laws = self._laws_beside if of.side == "wrench" else []
        like = list(like_product(laws, of.frame.rows[:, i], right.table[:ROWS, k]))
        if math.isnan(term.value) and not like:
            return error, None, ""
        value = np.nan_to_num(term.value)
        parts = [(x, part[k, i]) for x, part in right.parts.items() if value and self._may_have(x, (value, error))]
        whole = [x.path for x, part in parts if abs(part - value) <= SAME * abs(value)][:1]
        likely = {
            (x.body, x.key, x.element or x.path): (x.path, part)
            for x, part in parts
            if any(abs(error - (factor - 1.0) * part) <= SAME * abs(error) for factor in LIKELY)
        }
        names = [*whole, *(x.coefficient for x in like)] or [path for path, _ in likely.values()]
        if like or whole or len(likely) != 1:
            value += sum(x.value for x in like)
        else:
            ((_, value),) = likely.values()
        return value + error, value, " or ".join(names)


def _sides(of: _Equations, at: Sequence[Pieces], states: Sequence[State]) -> Array:
    """The right side (n, c) of equations at some states."""
    return np.array([RIGHT[of.side](p, s) for p, s in zip(at, states, strict=True)]) @ of.frame.rows


def _slope(at: Pieces, side: str, name: str, frame: Frame) -> Array:
    """Derivative of a side by a quantity that a program answers, but for the sign; one by that of the side itself."""
    slopes = {
        "wrench": {"V_dot": at.K, "u_dot": at.K @ at.S, "phi_ddot": at.I},
        "torque": {"V_dot": at.I.T, "u_dot": at.I.T @ at.S, "phi_ddot": at.Theta_ff},
    }
    return slopes.get(side, {}).get(name, np.eye(len(frame.rows)))


def _is_same(one: WrongTerm, other: WrongTerm) -> bool:
    """Whether two wants have one wrong term."""
    same = (one.component, one.term) == (other.component, other.term)
    return same and abs(one.factor - other.factor) <= ALIKE * max(abs(one.factor), abs(other.factor))


def _is_there(factors: Array) -> Any:
    """Mask of the factors (m, ...) that are more than rounding of the largest of their column."""
    size = np.abs(np.nan_to_num(factors))
    return size > THERE * size.max(axis=0, initial=0.0)


def _magnitudes(at: Pieces, state: State) -> Array:
    """Magnitudes of the terms of the wrench on the carrier (6)."""
    return np.abs(at.K) @ np.abs(at.V_r_dot(vector(state.V_dot))) + np.abs(at.F) + np.abs(at.bias)


def _other_wrenches(at: Pieces) -> Array:
    """Wrenches (6, in E1 about O1) that are no sum of these products: all laws but weight, buoyancy and the damping of
    the carrier, whose axes are those of E1."""
    wrenches, carrier = np.zeros(6), at.bodies.bodies[0].name
    for k in at.bodies.placed():
        for kind, wrench in at.terms[k.body.name].items():
            if kind not in PLAIN and not (kind in PLAIN_ON_CARRIER and k.body.name == carrier):
                wrenches += k.L @ wrench
    return wrenches


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
