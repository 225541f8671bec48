"""The search for wrong terms of a program: its requests, its error as a wrench or torque, and what explains it."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from types import MappingProxyType
from typing import Any, cast

import numpy as np

from mahovik.core.stand.model import Stand, Vec6
from mahovik.core.stand.state import Quaternion, State
from mahovik.errors import CheckError
from mahovik.proof import reference
from mahovik.proof.diagnose.terms.coefficients import Coefficients, Multiple
from mahovik.proof.diagnose.terms.fit import MOST, Columns
from mahovik.proof.diagnose.terms.monomials import WRENCHES, Monomial, Motion, count, monomials
from mahovik.proof.reference import Pieces
from mahovik.proof.reference.array import Array
from mahovik.proof.reference.bodies import PlacedBody
from mahovik.proof.reference.forward import bias
from mahovik.proof.reference.torque import torque
from mahovik.proof.reference.wrenches import body_wrenches
from mahovik.proof.verify.states import Request

WANTS = ("forward", "torque")
"""Wants whose error is a sum of products of the model."""

MORE, SPARE = 1.25, 40
"""Number of states for each product, and of those besides."""

REPEATED = 5
"""States that are asked for twice: a program that answers otherwise is not deterministic."""

SPREAD = {"V": 1.0, "phi_dot": 3.0, "phi_ddot": 3.0, "V_dot": 1.0}
"""Standard deviations of the states, SI: no kind of term is much larger than another."""

ROUNDING = 1e-11
"""Error over the size of the terms that a right program in double may have."""


@dataclass(frozen=True)
class WrongTerm:
    """A wrong term of a program.

    component  letter of SNAME of the wrench on the carrier, or the flywheel's name
    term       the product; on the right-hand side of K V* = ..., or in the drive torque
    multiple   its factor in the program, the right one, and what both are multiples of
    error      their difference, SI
    share      its part of the squared error of the want
    """

    want: str
    component: str
    term: str
    multiple: Multiple
    error: float
    share: float


@dataclass(frozen=True)
class TermSearchResult:
    """Wrong terms, and the part of the error that they leave, 0 to 1 (root mean square); wants that were looked at."""

    terms: tuple[WrongTerm, ...]
    unexplained: float
    wants: tuple[str, ...]

    @property
    def whole(self) -> bool:
        """Whether they are the error, to rounding, and few: more than MOST are rather another program."""
        return 0 < len(self.terms) <= MOST and self.unexplained < 1e-6


Answers = Callable[[Request], Mapping[str, Any]]


class TermSearch:
    """Finds wrong terms in programs of one stand: states, the reference's pieces and the products are kept."""

    def __init__(self, stand: Stand, seed: int = 1, wants: Sequence[str] = WANTS) -> None:
        rng = np.random.default_rng(seed)
        self._stand = stand
        number = math.ceil(MORE * count(stand)) + SPARE
        self._states = [_state(stand, rng) for _ in range(number)]
        self.wants = tuple(want for want in WANTS if want in wants and (stand.flywheels or want != "torque"))
        self._requests = {
            want: [Request(f"term {i}, {want}", state, (want,)) for i, state in enumerate(self._states)]
            for want in self.wants
        }
        self._again = {
            want: [replace(each, id=f"{each.id}, again") for each in asked[:REPEATED]]
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
        left: list[float] = []
        for want in self.wants:
            terms, rest = self._of_forward(answers) if want == "forward" else self._of_torque(answers)
            found += terms
            left += rest
        return TermSearchResult(tuple(found), max(left, default=0.0), self.wants)

    def _check_repeats(self, answers: Answers) -> None:
        for want, again in self._again.items():
            for first, second in zip(self._requests[want], again, strict=False):
                if _values(answers(first), want) != _values(answers(second), want):
                    raise CheckError(
                        f"it is not deterministic: {want} of state {first.id!r} has another answer when it is asked "
                        "for again; a diagnosis needs a program without memory and chance"
                    )

    @cached_property
    def _pieces(self) -> list[Pieces]:
        return [reference.pieces(self._stand, state) for state in self._states]

    def _motion(self, rows: Array, V_r_dot: Array) -> Motion:
        at = [self._pieces[i] for i in rows]
        states = [self._states[i] for i in rows]
        N = len(self._stand.flywheels)
        return Motion(
            np.array([p.V_r for p in at]),
            V_r_dot,
            np.array([s.phi for s in states]).reshape(-1, N),
            np.array([p.phi_dot for p in at]).reshape(-1, N),
            np.array([s.phi_ddot for s in states]).reshape(-1, N),
            np.array([p.gravity for p in at]),
        )

    def _answered(self, want: str, name: str, size: int, answers: Answers) -> tuple[Array, Array]:
        """Rows of the states that have finite answers, and these. Raises CheckError: too few."""
        rows, found = [], []
        for i, request in enumerate(self._requests[want]):
            try:
                value = np.array(answers(request).get(name), dtype=np.float64)
            except (TypeError, ValueError, OverflowError):
                continue
            if value.shape == (size,) and np.isfinite(value).all():
                rows.append(i)
                found.append(value)
        least = count(self._stand)
        if len(rows) < least:
            raise CheckError(
                f"{want}: {len(rows)} of {len(self._states)} states have an answer; expected at least {least}, as many "
                "as there are products whose factors are looked for"
            )
        return np.array(rows), np.array(found)

    def _of_forward(self, answers: Answers) -> tuple[list[WrongTerm], list[float]]:
        """Errors of V_dot, as wrenches K V_r* - (F - M V_r - J phi' - I phi'')."""
        rows, V_dot = self._answered("forward", "V_dot", 6, answers)
        at = [self._pieces[i] for i in rows]
        V_r_dot = np.array([p.V_r_dot(x) for p, x in zip(at, V_dot, strict=True)])
        right = np.array(
            [p.F - bias(p) - p.I @ np.array(self._states[i].phi_ddot) for i, p in zip(rows, at, strict=True)]
        )
        inertial = np.array([p.K @ x for p, x in zip(at, V_r_dot, strict=True)])
        size = np.array(
            [np.abs(p.K) @ np.abs(x) + np.abs(p.F) + np.abs(bias(p)) for p, x in zip(at, V_r_dot, strict=True)]
        )
        products = monomials(self._stand, self._motion(rows, V_r_dot))
        columns = _columns(products)
        wanted = right - np.array([_other_wrenches(p, self._stand) for p in at])
        known = Coefficients(products, columns.least_squares(wanted), self._motion(rows, V_r_dot), at, self._stand)
        return _terms("forward", WRENCHES, inertial - right, size, products, columns, known.multiple)

    def _of_torque(self, answers: Answers) -> tuple[list[WrongTerm], list[float]]:
        """Errors of the drive torques."""
        rows, tau = self._answered("torque", "tau", len(self._stand.flywheels), answers)
        at, states = [self._pieces[i] for i in rows], [self._states[i] for i in rows]
        V_r_dot = np.array([p.V_r_dot(np.array(s.V_dot)) for p, s in zip(at, states, strict=True)])
        right = np.array([torque(p, np.array(s.V_dot), np.array(s.phi_ddot)) for p, s in zip(at, states, strict=True)])
        products = monomials(self._stand, self._motion(rows, V_r_dot))
        columns = _columns(products)
        expected = columns.least_squares(right, 1)

        def multiple(component: int, k: int, error: float) -> Multiple:
            if expected is None:
                return Multiple(error, None, "")
            return Multiple(float(expected[k, component]) + error, float(expected[k, component]), "")

        names = [each.name for each in self._stand.flywheels]
        return _terms("torque", names, tau - right, np.abs(right), products, columns, multiple)


def _terms(
    want: str,
    components: Sequence[str],
    error: Array,
    size: Array,
    products: Sequence[Monomial],
    columns: Columns,
    multiple: Callable[[int, int, float], Multiple],
) -> tuple[list[WrongTerm], list[float]]:
    """Wrong terms of all components, and of each wrong one the part that is left."""
    found: list[tuple[int, int, float, float]] = []
    left: list[float] = []
    rounding = ROUNDING * float(np.sqrt(np.mean(size**2)))
    for component in range(len(components)):
        wrong = error[:, component]
        if np.sqrt(np.mean(wrong**2)) <= 10 * rounding:
            continue
        fit = columns.fit(wrong, rounding)
        left.append(fit.left if fit.coefficients else 1.0)
        for k, c in fit.coefficients.items():
            found.append((component, k, c, float(np.sum((c * products[k].values) ** 2))))
    whole = sum(each[3] for each in found) or 1.0
    terms = [
        WrongTerm(want, components[component], products[k].term, multiple(component, k, c), c, part / whole)
        for component, k, c, part in found
    ]
    return sorted(terms, key=lambda term: -term.share), left


def _columns(products: Sequence[Monomial]) -> Columns:
    return Columns(
        np.column_stack([each.values for each in products]), np.array([each.accelerates for each in products])
    )


def _other_wrenches(at: Pieces, stand: Stand) -> Array:
    """Wrenches (6, in E1 about O1) that are no sum of these products: laws between E0 and the carrier, damping of
    bodies with axes of their own."""
    found = np.zeros(6)
    bodies: tuple[PlacedBody, ...] = (*at.fixed, *at.flywheels)
    for k in bodies:
        own = body_wrenches(k.body, np.zeros(3), np.zeros(6), np.zeros(6))
        for kind, wrench in at.terms[k.body.name].items():
            if kind not in own or ("damping" in kind and k.body.name != stand.carrier.name):
                found += k.L @ wrench
    return found


def _values(answer: Mapping[str, Any], want: str) -> Any:
    return repr(np.array(answer.get("V_dot" if want == "forward" else "tau"), dtype=object).tolist())  # NaN is equal


def _state(stand: Stand, rng: np.random.Generator) -> State:
    """A state in which no kind of term is much larger than another; without run-time wrenches."""
    N = len(stand.flywheels)

    def normal(name: str, size: int) -> tuple[float, ...]:
        return tuple(float(x) for x in SPREAD[name] * rng.normal(size=size))

    q = rng.normal(size=4)
    q /= np.linalg.norm(q)
    return State(
        position=(0.0, 0.0, 0.0),
        angles=None,
        quaternion=cast(Quaternion, tuple(float(x) for x in q)),
        V=cast(Vec6, normal("V", 6)),
        phi=tuple(float(x) for x in rng.uniform(-math.pi, math.pi, N)),
        phi_dot=normal("phi_dot", N),
        phi_ddot=normal("phi_ddot", N),
        V_dot=cast(Vec6, normal("V_dot", 6)),
        tau=(0.0,) * N,
        wrench=MappingProxyType({}),
    )
