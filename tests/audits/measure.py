"""Comparison of an audited model with the reference: how far it agrees, and the wrong terms that are named."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from audits import gazebo, held, npsauv
from audits.audit import Array, Audit, Term
from mahovik.core.stand.model import WRENCH_LETTERS
from mahovik.proof import reference
from mahovik.proof.diagnose.diagnosis import Diagnoser
from mahovik.proof.diagnose.search import TermSearch, TermSearchResult
from mahovik.proof.reference.algebra import twists
from mahovik.proof.reference.evaluate import held_state
from mahovik.proof.reference.pieces import PlacedBody
from mahovik.proof.verify.check import difference
from mahovik.proof.verify.scales import scales_of
from mahovik.proof.verify.states import Request

AUDITS: dict[str, Audit] = {audit.name: audit for models in (npsauv, gazebo, held) for audit in models.AUDITS}
"""Audits by name, in the order of the page."""

AGREES = 1e-11
"""Difference over the natural scale below which numbers agree."""


@dataclass(frozen=True)
class Outcome:
    """Result of an audit.

    worst      largest difference of all quantities over the natural scale
    agreeing   largest difference of those components of the wrench on the carrier, and of those torques, that agree,
               over the sum of magnitudes; None: none does
    differing  components that do not agree
    named      terms, with factor, expected factor and coefficient, as they are printed
    faults     names of known faults that explain the difference
    false      names that the hand calculation does not have; missing: terms of it without a name
    """

    worst: float
    agreeing: float | None
    differing: tuple[str, ...]
    named: tuple[str, ...]
    faults: tuple[str, ...]
    false: tuple[str, ...]
    missing: tuple[str, ...]


def ask(audit: Audit, request: Request) -> Mapping[str, Any]:
    """The model's answer to a request of one want."""
    (want,) = request.want
    answers = audit.answer(request.state, want)
    return {name: np.asarray(value).tolist() for name, value in answers.items()}


def measure(audit: Audit, faults: bool = True) -> Outcome:
    """Compare a model; `faults`: look for known faults as well, as `judge --explain` does."""
    return _measure_held(audit) if audit.states else _measure_free(audit, faults)


def _measure_held(audit: Audit) -> Outcome:
    worst: dict[str, float] = {}
    for state in audit.states:
        for want in audit.wants:
            for name, off in _held_differences(audit, Request("held", state, (want,))).items():
                worst[name] = max(worst.get(name, 0.0), off)
    differing = tuple(name for name, off in worst.items() if off > AGREES)
    agreeing = max((off for off in worst.values() if off <= AGREES), default=None)
    missing = tuple(map(_term, sorted(audit.wrong or ())))
    return Outcome(max(worst.values()), agreeing, differing, (), (), (), missing)


def _held_differences(audit: Audit, request: Request) -> dict[str, float]:
    """Largest difference of u_dot, and of phi_ddot where the model gives it, over the magnitudes in their equations."""
    assert audit.stand.hold is not None
    state = held_state(audit.stand, request.state)
    at, S, m = reference.pieces(audit.stand, state), twists(audit.stand.hold), len(state.u)
    expected, answers = reference.evaluate(audit.stand, state, request.want, at), ask(audit, request)
    rates = np.array(expected.get("phi_ddot", state.phi_ddot))
    matrix = np.block([[S.T @ at.K @ S, S.T @ at.I], [at.I.T @ S, at.Theta_ff]])
    force = np.abs(S.T) @ _size(at) + np.abs(S.T @ at.I) @ np.abs(rates)
    size = np.concatenate([force, np.abs(state.tau)])
    moving = m + len(rates) if "phi_ddot" in answers else m
    matrix, size = matrix[:moving, :moving], size[:moving]
    solution = np.concatenate([expected["u_dot"], rates])[:moving]
    size = np.abs(np.linalg.inv(matrix)) @ (size + np.abs(matrix) @ np.abs(solution))
    error = np.abs(np.concatenate([answers["u_dot"], answers.get("phi_ddot", [])]) - solution) / size
    parts = {"u_dot": error[:m], "phi_ddot": error[m:]}
    return {name: float(off.max()) for name, off in parts.items() if off.size}


def _differences(audit: Audit, request: Request) -> dict[str, float]:
    """Difference of every quantity that a free model gives, over the natural scale."""
    (want,) = request.want
    at = reference.pieces(audit.stand, request.state)
    expected, answers = reference.evaluate(audit.stand, request.state, request.want, at), ask(audit, request)
    natural = scales_of(audit.stand, request.state, want)
    return {name: difference(answers[name], expected[name], natural[name])[0] for name in answers}


def _measure_free(audit: Audit, faults: bool) -> Outcome:
    search = TermSearch(audit.stand, 1, audit.wants)
    first = search.requests
    worst = max(max(_differences(audit, asked).values()) for asked in first)
    sizes = _components(audit, first)
    differing = tuple(name for name, off in sizes.items() if off > AGREES)
    agreeing = max((off for off in sizes.values() if off <= AGREES), default=None)
    known: tuple[str, ...] = ()
    named: TermSearchResult | None = None
    if differing:
        if faults:
            diagnosis = Diagnoser(audit.stand, wants=audit.wants).diagnose(lambda request: ask(audit, request))
            known = tuple(cause.name for cause in diagnosis.causes) if diagnosis.verdict == "named" else ()
        if not known:
            named = search.find(lambda request: ask(audit, request))
    terms = named.terms if named is not None and named.whole else ()
    told: set[Term] = {(term.component, term.term) for term in terms}
    expected = audit.wrong or frozenset()
    return Outcome(
        worst,
        agreeing,
        differing,
        tuple(_words(term) for term in terms),
        known,
        (*known, *map(_term, sorted(told - expected))),
        tuple(map(_term, sorted(expected - told))),
    )


def _components(audit: Audit, requests: list[Request]) -> dict[str, float]:
    """Largest difference of each component of K V*, over the sum of magnitudes of its terms."""
    differences: dict[str, float] = {}
    for request in requests:
        at = reference.pieces(audit.stand, request.state)
        V_dot = np.array(ask(audit, request)["V_dot"])
        rates = np.array(request.state.phi_ddot)
        error = at.K @ V_dot + at.I @ rates + at.bias - at.F
        size = np.abs(at.K) @ np.abs(at.V_r_dot(V_dot)) + np.abs(at.I) @ np.abs(rates) + _size(at)
        rows = {letter: float(off) for letter, off in zip(WRENCH_LETTERS, np.abs(error) / size, strict=True)}
        for name, off in rows.items():
            differences[name] = max(differences.get(name, 0.0), off)
    return differences


def _size(at: reference.Pieces) -> Array:
    """Magnitudes of forces and of products of velocities (6)."""
    bodies: tuple[PlacedBody, ...] = (*at.fixed, *at.flywheels)
    force = sum((np.abs(k.L) @ np.abs(at.P[k.body.name]) for k in bodies), np.zeros(6))
    return np.asarray(force + np.abs(at.M) @ np.abs(at.V_r) + np.abs(at.J) @ np.abs(at.phi_dot))


def _term(term: Term) -> str:
    return f"{term[0]}: {term[1]}"


def _words(term: Any) -> str:
    """A named term with what it is and should be, such as "Z: u q, -2 for 2: carrier.mass"."""
    expected = "" if term.expected is None else f" for {term.expected:.3g}"
    path = f": {term.coefficient}" if term.coefficient else ""
    return f"{_term((term.component, term.term))}, {term.factor:.3g}{expected}{path}"
