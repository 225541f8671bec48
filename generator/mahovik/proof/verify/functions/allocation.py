"""Judges of `inverse` with weights, damping and limits, and of `inverse_fast`: literal NumPy, and SciPy."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
from scipy.optimize import lsq_linear

from mahovik.contract.status import STATUS_VALUES
from mahovik.core.lower.thresholds import THRESHOLDS
from mahovik.core.stand.state import State
from mahovik.errors import StateError
from mahovik.proof.reference.allocation import (
    ScaledDemand,
    condition_of_normal_equations,
    largest_damping,
    normal_equations,
    scaled_demand,
    weighted,
)
from mahovik.proof.reference.array import Array
from mahovik.proof.reference.inverse import demand, inverse_root
from mahovik.proof.verify.compare import Row
from mahovik.proof.verify.functions.case import Case, Comparison
from mahovik.proof.verify.scales.magnitudes import Magnitudes
from mahovik.proof.verify.scales.wants import inverse as inverse_scales

NEAR, DAMPING = 0.9, 0.3
"""Options under which some singular value of most stands is damped."""

FAST_DAMPING = 2.0**-4
"""Damping of `inverse_fast`, a part of the norm of W."""

SQUARED_CONDITION = {"double": 1e9, "float": 1e3}
"""Largest condition of the normal equations at which `inverse_fast` is compared."""

BOUNDED = 1e-6
"""Accepted excess of a bounded answer's residual over the least, relative to the demand (SciPy stops there)."""


def _scale(scaled: ScaledDemand, weight: Array, rank: int, answer: Array) -> Array:
    """Scale (N, rad/s2) of an answer: relative errors of W and r move it by about as many units of it.

    Wedin's bound for least squares (Bjorck, Numerical Methods for Least Squares Problems, 1.4.3), with kappa the
    condition of the weighted matrix: kappa (|x| + |r|/sigma_1) + kappa^2 |residual|/sigma_1.
    """
    root = 1 / np.sqrt(weight)
    sigma = np.linalg.svd(scaled.W * root, compute_uv=False)[:rank]
    if not rank:
        return np.zeros(len(answer))
    condition = sigma[0] / sigma[-1]
    y = np.linalg.solve(scaled.to_phi_ddot, answer)
    residual = np.linalg.norm(scaled.r - scaled.W @ y)
    moved = np.linalg.norm(y / root) + (np.linalg.norm(scaled.r) + condition * residual) / sigma[0]
    return np.asarray(np.abs(scaled.to_phi_ddot * root) @ np.full(len(answer), condition * moved))


def _scale_of_normal_equations(scaled: ScaledDemand, weight: Array, condition: float, answer: Array) -> Array:
    """Scale (N, rad/s2) of an answer of `inverse_fast`: condition of its equations times (|x| + |r|/sigma_1)."""
    root = 1 / np.sqrt(weight) if len(weight) >= len(scaled.r) else np.ones(len(weight))
    y = np.linalg.solve(scaled.to_phi_ddot, answer)
    moved = np.linalg.norm(y / root) + np.linalg.norm(scaled.r) / np.linalg.norm(scaled.W * root, 2)
    return np.asarray(np.abs(scaled.to_phi_ddot * root) @ np.full(len(answer), condition * moved))


def _check_rank(case: Case, scaled: ScaledDemand, rank: int) -> None:
    """Raises StateError for a rank that the singular values do not allow, within a factor of ten of the threshold."""
    ratios = np.linalg.svd(scaled.W, compute_uv=False)
    ratios = ratios / ratios[0] if ratios[0] else ratios
    cut = case.bounds.cuts.rank
    most, least = int(np.sum(ratios > cut / 10)), int(np.sum(ratios > cut * 10))
    if not least <= rank <= most:
        raise StateError(f"rank {rank}, expected {least} to {most}")


def _options(case: Case, number: int, limit: Array | None = None, **more: float) -> dict[str, Any]:
    """Weights from 1 to 10, and what else is asked; no limits where none are given."""
    weight = case.held(case.random(100 + number).uniform(1.0, 10.0, case.count))
    none = np.full(case.count, case.backend.layout.precision.largest)
    given: dict[str, Any] = {"weight": list(weight), "limit": list(none if limit is None else limit)}
    return {**given, "near": 1e-6, "damping": 0.0, **more}


def _asked(case: Case) -> Iterator[tuple[int, str, State, ScaledDemand]]:
    """The states, with what is asked of the flywheels there."""
    for number, (name, state) in enumerate(case.states):
        yield number, name, state, scaled_demand(case.at(state), np.array(state.V_dot))


def inverse_rows(case: Case) -> Iterator[Row]:
    """phi_ddot with weights, phi_ddot and damped_by with damping, and limits kept with the least residual."""
    if not case.count:
        yield from _left_over(case)
        return
    accepted = case.bounds.default
    plain = Comparison("inverse", "phi_ddot, with weights", accepted)
    damped = Comparison("inverse", "phi_ddot, with damping", accepted)
    damped_by = Comparison("inverse", "damped_by", accepted)
    limited = Comparison("inverse", "residual, with limits", BOUNDED if case.real == "double" else 1e-3)
    for number, name, state, scaled in _asked(case):
        given = case.backend.arguments(state)
        options = _options(case, number)
        weight = np.array(options["weight"])
        try:
            found = case.call("inverse", given | {"options": options})
            rank = int(found["rank"])
            _check_rank(case, scaled, rank)
            expected = weighted(scaled, weight, rank)
            plain.note(found["phi_ddot"], expected, _scale(scaled, weight, rank, expected), name)
            options = _options(case, number, near=NEAR, damping=DAMPING)
            options |= {key: float(np.float32(options[key])) for key in ("near", "damping")}
            near, damping = options["near"], options["damping"]
            found = case.call("inverse", given | {"options": options})
            answer = weighted(scaled, weight, rank, near, damping)
            damped.note(found["phi_ddot"], answer, _scale(scaled, weight, rank, answer), name)
            share = largest_damping(scaled, rank, near, damping)
            damped_by.note(found["damped_by"], share, np.linalg.norm(scaled.W), name)
            _note_limits(limited, case, given, _options(case, number, _limits(case, expected)), scaled, name)
        except StateError as error:
            plain.note_refusal(error, name)
    for row in (plain, damped, damped_by, limited):
        yield row.finished()


def _left_over(case: Case) -> Iterator[Row]:
    """Demand of a stand without flywheels: all of it as residual, and as a unit vector in the norm of K^-1."""
    residual = Comparison("inverse", "residual, without flywheels", case.bounds.default)
    hardest = Comparison("inverse", "hardest, without flywheels", case.bounds.default)
    for _, name, state, scaled in _asked(case):
        at = case.at(state)
        natural = inverse_scales(Magnitudes(case.stand, state, at, case.bounds.cuts))["residual"]
        try:
            found = case.call("inverse", case.backend.arguments(state))
        except StateError as error:
            residual.note_refusal(error, name)
            continue
        wanted, length = demand(at, np.array(state.V_dot)), float(np.linalg.norm(scaled.r))
        residual.note(found["residual"], wanted, natural, name)
        if length > np.linalg.norm(inverse_root(at.K) @ natural) * 1e-3:
            hardest.note(found["hardest"], wanted / length, natural / length, name)
    for row in (residual, hardest):
        yield row.finished()


def least_residual(scaled: ScaledDemand, limit: Array) -> float:
    """Least |r - W y| for |phi''| <= limit (N, rad/s2), by SciPy's bounded least squares."""
    bound = limit / np.diag(scaled.to_phi_ddot)
    found = lsq_linear(scaled.W, scaled.r, (-bound, bound), method="bvls", tol=1e-14)
    return float(np.sqrt(2 * found.cost))


def _limits(case: Case, phi_ddot: Array) -> Array:
    """Limits (N, rad/s2) that hold some flywheels back: 0.7 of the largest."""
    most = 0.7 * float(np.abs(phi_ddot).max(initial=0.0)) or 1.0
    return np.full(case.count, float(np.float32(most)))


def _note_limits(
    row: Comparison, case: Case, given: dict[str, Any], options: dict[str, Any], scaled: ScaledDemand, name: str
) -> None:
    """Count a bounded answer: by how much its residual exceeds the least, relative to the demand."""
    status, outputs = case.backend.call("inverse", given | {"options": options})
    found, limit = outputs["out"], np.array(options["limit"])
    phi_ddot = np.array(found["phi_ddot"])
    if np.any(np.abs(phi_ddot) > limit):
        row.note_difference(np.inf, "a limit is exceeded", name)
        return
    held = np.array(found["limited"], dtype=bool)
    if bool(status & STATUS_VALUES["LIMITED"]) != bool(held.any()) or np.any(np.abs(phi_ddot[held]) != limit[held]):
        row.note_difference(np.inf, "LIMITED and the mask disagree with the answer", name)
        return
    y = phi_ddot / np.diag(scaled.to_phi_ddot)
    demanded = float(np.linalg.norm(scaled.r))
    excess = abs(float(np.linalg.norm(scaled.r - scaled.W @ y)) - least_residual(scaled, limit))
    excess -= _weak_demand(scaled, y, held, THRESHOLDS[case.real].regular)
    row.note_difference(max(excess, 0.0) / max(demanded, 1e-290), "", name)


def _weak_demand(scaled: ScaledDemand, y: Array, held: Array, regular: float) -> float:
    """Demand that is left for weak directions of the flywheels not `held`: a regularised pass does not meet it all.

    The C puts `regular` times sigma_1^2 on the diagonal of the normal equations, so that a pass leaves the part
    regular/(regular + ratio^2) of what is asked along a singular direction. Below a ratio of 3 sqrt(regular) that is a
    tenth and more.
    """
    free = scaled.W[:, np.logical_not(held)]
    if not free.size:
        return 0.0
    U, sigma, _ = np.linalg.svd(free, full_matrices=False)
    weak = sigma < 3 * np.sqrt(regular) * np.linalg.norm(scaled.W, 2)
    return float(np.linalg.norm(U[:, weak].T @ (scaled.r - scaled.W[:, held] @ y[held])))


def fast_rows(case: Case, function: str) -> Iterator[Row]:
    """phi_ddot by normal equations, without and with damping."""
    plain = Comparison(function, "phi_ddot, with weights", case.bounds.default)
    damped = Comparison(function, "phi_ddot, with damping", case.bounds.default)
    for number, name, state, scaled in _asked(case):
        given = case.backend.arguments(state)
        for row, damping in ((plain, 0.0), (damped, FAST_DAMPING)):
            options = _options(case, number, damping=damping)
            weight = np.array(options["weight"])
            condition = condition_of_normal_equations(scaled, weight, damping)
            if condition > SQUARED_CONDITION[case.real]:  # the function may say NOT_POSITIVE_DEFINITE there
                continue
            try:
                found = case.call(function, given | {"options": options})["phi_ddot"]
            except StateError as error:
                row.note_refusal(error, name)
                continue
            expected = normal_equations(scaled, weight, damping)
            row.note(found, expected, _scale_of_normal_equations(scaled, weight, condition, expected), name)
    for row in (plain, damped):
        yield row.finished()
