"""Judges of `inverse` with weights, damping and limits, and of `inverse_fast`: literal NumPy, and SciPy."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np
from scipy.optimize import lsq_linear

from mahovik.contract.functions import task_of
from mahovik.contract.status import STATUS_VALUES, status_words
from mahovik.core.lower.thresholds import THRESHOLDS
from mahovik.core.stand.state import State
from mahovik.errors import StateError
from mahovik.proof.reference.array import Array
from mahovik.proof.reference.inverse import (
    ScaledDemand,
    condition_of_normal_equations,
    demand,
    inverse_root,
    largest_damping,
    normal_equations,
    normal_matrix,
    scaled_demand,
    weighted_solution,
)
from mahovik.proof.reference.tasks import TaskRows, scaled_task, task_rows
from mahovik.proof.reference.tasks import task_of as task_named
from mahovik.proof.verify.check import Check
from mahovik.proof.verify.functions.case import Case, Setting
from mahovik.proof.verify.functions.diagnoses import Diagnoses
from mahovik.proof.verify.scales.magnitudes import Magnitudes
from mahovik.proof.verify.scales.wants import inverse as inverse_scales

DEMAND_DEVIATION = {"v": 5.0, "w": 20.0}
"""m/s2, rad/s2: spread of demanded accelerations and angular accelerations."""

NEAR, DAMPING = 0.9, 0.3
"""Options under which some singular value of most stands is damped."""

FAST_DAMPING = 2.0**-4
"""Damping of `inverse_fast`, a part of the norm of W."""

SQUARED_CONDITION = {"double": 1e9, "float": 1e3}
"""Largest condition of the normal equations at which `inverse_fast` is compared."""

LIMIT_SHARES = (0.7, 0.15)
"""Limits that are tried, over the largest acceleration without any: some flywheels are held, and most of them."""

EXCESS_LIMIT = 1e-6
"""Accepted excess of a bounded answer's residual over the least, relative to the demand (SciPy stops there)."""


def scale_of(scaled: ScaledDemand, weight: Array, rank: int, answer: Array) -> Array:
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


def damped_scale(case: Case, scaled: ScaledDemand, options: Mapping[str, Any], rank: int, answer: Array) -> Array:
    """Scale (N, rad/s2) of a damped answer, likewise: by the condition of the damped problem.

    V g(sigma) U^T r with g = sigma/(sigma^2 + lambda^2) moves by |r| times the largest slope of g, which is at most
    (1 + damping/near_singular)/(sigma^2 + lambda^2); weights stretch this by the root of their ratio. Only what weights
    put outside of the kept directions, where there are more flywheels than those, turns with them: the full condition.
    Along weak directions (`_weak_demand`) the C leaves `regular` of the answer, stretched by the ratio of the weights.
    """
    _, sigma, Vt = np.linalg.svd(scaled.W, full_matrices=False)
    sigma, Vt = sigma[:rank], Vt[:rank]
    if not rank:
        return np.zeros(len(answer))
    near, damping, weight = options["near_singular"], options["damping"], np.array(options["weight"])
    shares = damping * sigma[0] * np.maximum(1 - sigma / (near * sigma[0]), 0.0)
    slope = (1 + damping / near) * float(np.max(1 / (sigma**2 + shares**2)))
    y = np.linalg.solve(scaled.to_phi_ddot, answer)
    outside = float(np.linalg.norm(y - Vt.T @ (Vt @ y))) if rank < len(y) else 0.0
    size, ratio = float(np.linalg.norm(y)), float(weight.max() / weight.min())
    moved = np.sqrt(ratio) * (slope * sigma[0] * np.linalg.norm(scaled.r) + size + sigma[0] / sigma[-1] * outside)
    regular = THRESHOLDS[case.real].regular
    if sigma[-1] < 3 * np.sqrt(regular) * sigma[0]:
        moved += ratio * size * regular / case.bounds.default
    return np.asarray(np.abs(scaled.to_phi_ddot) @ np.full(len(answer), moved))


def _scale_of_normal_equations(scaled: ScaledDemand, weight: Array, condition: float, answer: Array) -> Array:
    """Scale (N, rad/s2) of an answer of `inverse_fast`: condition of its equations times (|x| + |r|/sigma_1)."""
    root = 1 / np.sqrt(weight) if len(weight) >= len(scaled.r) else np.ones(len(weight))
    y = np.linalg.solve(scaled.to_phi_ddot, answer)
    moved = np.linalg.norm(y / root) + np.linalg.norm(scaled.r) / np.linalg.norm(scaled.W * root, 2)
    return np.asarray(np.abs(scaled.to_phi_ddot * root) @ np.full(len(answer), condition * moved))


def check_rank(case: Case, scaled: ScaledDemand, rank: int) -> None:
    """Raises StateError for a rank that the singular values do not allow, within a factor of ten of the threshold."""
    ratios = np.linalg.svd(scaled.W, compute_uv=False)
    ratios = ratios / ratios[0] if ratios[0] else ratios
    cut = case.bounds.cuts.rank
    most, least = int(np.sum(ratios > cut / 10)), int(np.sum(ratios > cut * 10))
    if not least <= rank <= most:
        raise StateError(f"rank {rank}, expected {least} to {most}")


def options_of(case: Case, number: int, limit: Array | None = None, **more: float) -> dict[str, Any]:
    """Weights from 1 to 10, and what else is asked; no limits where none are given."""
    weight = case.nearest_numbers(case.random(100 + number).uniform(1.0, 10.0, case.count))
    none = np.full(case.count, case.backend.layout.precision.largest)
    given: dict[str, Any] = dict(case.backend.generated.values.options or {})  # what the motors have
    given |= {"weight": list(weight), "limit": list(none if limit is None else limit)}
    return {**given, "near_singular": 1e-6, "damping": 0.0, **more}


def _demands(case: Case, task: str = "") -> Iterator[tuple[int, str, State, ScaledDemand]]:
    """The states, with what is asked of the flywheels there: V_dot of the state, or a demand of a task."""
    for number, (name, state) in enumerate(case.states):
        if task:
            asked, rows = with_demand(case, number, state, task)
            yield number, name, asked, scaled_task(case.at(state), rows, np.array(asked.demand))
        else:
            yield number, name, state, scaled_demand(case.at(state), case.stand, np.array(state.V_dot))


def with_demand(case: Setting, number: int, state: State, task: str) -> tuple[State, TaskRows]:
    """The state with a random demand of a task, and the rows of this."""
    wanted = task_named(case.stand, task)
    sizes = [DEMAND_DEVIATION[row.component[0]] for row in wanted.rows]
    demand = case.nearest_numbers(case.random(300 + number).normal(size=len(sizes)) * sizes)
    return replace(state, task=task, demand=tuple(demand)), task_rows(case.at(state), case.stand, wanted)


def answer_of(
    case: Case, given: Mapping[str, Any], options: Mapping[str, Any], function: str = "inverse"
) -> tuple[int, dict[str, Any]]:
    """Status and result of `inverse` with these options. Raises StateError if it refuses."""
    status, outputs = case.backend.call(function, {**given, "options": options})
    if status < 0:
        raise StateError(f"{function} refused with status {status_words(status)}")
    return status, outputs["out"]


def inverse_rows(case: Case) -> Iterator[Check]:
    """phi_ddot with weights, phi_ddot and damped_by with damping, and limits kept with the least residual.

    Of every answer, what the function says beside it is judged as well.
    """
    beside = Diagnoses(case)
    if not case.count:
        yield from _left_over(case, beside)
        yield from beside.rows()
        return
    accepted = case.bounds.default
    plain = Check("inverse", "phi_ddot, with weights", accepted)
    damped = Check("inverse", "phi_ddot, with damping", accepted)
    damped_by = Check("inverse", "damped_by", accepted)
    limited = Check("inverse", "residual, with limits", EXCESS_LIMIT if case.real == "double" else 1e-3)
    for number, name, state, scaled in _demands(case):
        given = case.backend.arguments(state)
        options = options_of(case, number)
        weight = np.array(options["weight"])
        try:
            status, found = answer_of(case, given, options)
            rank = int(found["rank"])
            check_rank(case, scaled, rank)
            expected = weighted_solution(scaled, weight, rank)
            loss = _loss_along_freedoms(case, state, scaled)
            plain.compare(found["phi_ddot"], expected, loss * scale_of(scaled, weight, rank, expected), name)
            beside.note(state, options, status, found, scaled, name)
            options = options_of(case, number, near_singular=NEAR, damping=DAMPING)
            options |= {key: float(np.float32(options[key])) for key in ("near_singular", "damping")}
            near, damping = options["near_singular"], options["damping"]
            status, found = answer_of(case, given, options)
            answer = weighted_solution(scaled, weight, rank, near, damping)
            scale = loss * damped_scale(case, scaled, options, rank, answer)
            damped.compare(found["phi_ddot"], answer, scale, name)
            share = largest_damping(scaled, rank, near, damping)
            damped_by.compare(found["damped_by"], share, loss * np.linalg.norm(scaled.W), name)
            beside.note(state, options, status, found, scaled, name)
            for fraction in LIMIT_SHARES:
                options = options_of(case, number, limits_of(case, expected, fraction))
                status, found = answer_of(case, given, options)
                note_limits(limited, case, status, found, options, scaled, name)
                beside.note(state, options, status, found, scaled, name, free=False)
        except StateError as error:
            plain.refuse(error, name)
    yield from (plain, damped, damped_by, limited)
    yield from beside.rows()


def _loss_along_freedoms(case: Case, state: State, scaled: ScaledDemand) -> float:
    """Relative errors of W = (S^T K S)^-1/2 S^T I Theta_ff^-1/2 and of r of a held carrier in units of rounding.

    They grow where most of the terms of (8) is blocked by the hold, by what W and r are smaller than these terms.
    """
    if case.stand.hold is None:
        return 1.0
    m = Magnitudes(case.stand, state, case.at(state), case.bounds.cuts)
    root = np.abs(scaled.root)
    columns = np.linalg.norm(root @ m.free.S_I / np.sqrt(np.diag(m.at.Theta_ff)))
    terms = np.linalg.norm(root @ m.free.S.T @ (m.S_bias + m.S_K @ (np.abs(state.V_dot) + m.stream_rate)))
    pairs = ((columns, np.linalg.norm(scaled.W)), (terms, np.linalg.norm(scaled.r)), (1.0, 1.0))
    return float(max(terms / kept for terms, kept in pairs if kept > 0.0))


def _left_over(case: Case, beside: Diagnoses) -> Iterator[Check]:
    """Demand of a stand without flywheels: all of it as residual, and as a unit vector in the norm of K^-1."""
    residual = Check("inverse", "residual, without flywheels", case.bounds.default)
    hardest = Check("inverse", "hardest, without flywheels", case.bounds.default)
    for _, name, state, scaled in _demands(case):
        at = case.at(state)
        natural = inverse_scales(Magnitudes(case.stand, state, at, case.bounds.cuts))["residual"]
        try:
            given = case.backend.arguments(state)
            status, found = answer_of(case, given, given["options"])
        except StateError as error:
            residual.refuse(error, name)
            continue
        wanted, length = demand(at, np.array(state.V_dot)), float(np.linalg.norm(scaled.r))
        residual.compare(found["residual"], wanted, natural, name)
        if length > np.linalg.norm(inverse_root(at.K) @ natural) * 1e-3:
            hardest.compare(found["hardest"], wanted / length, natural / length, name)
        beside.note(state, given["options"], status, found, scaled, name)
    yield from (residual, hardest)


def least_residual(scaled: ScaledDemand, limit: Array) -> float:
    """Least |r - W y| for |phi''| <= limit (N, rad/s2), by SciPy's bounded least squares."""
    bound = limit / np.diag(scaled.to_phi_ddot)
    found = lsq_linear(scaled.W, scaled.r, (-bound, bound), method="bvls", tol=1e-14)
    return float(np.sqrt(2 * found.cost))


def limits_of(case: Case, phi_ddot: Array, fraction: float) -> Array:
    """Limits (N, rad/s2) that hold some flywheels back: this fraction of the largest."""
    most = fraction * float(np.abs(phi_ddot).max(initial=0.0)) or 1.0
    return np.full(case.count, float(np.float32(most)))


def note_limits(
    row: Check, case: Case, status: int, found: Mapping[str, Any], options: Mapping[str, Any],
    scaled: ScaledDemand, name: str
) -> None:  # fmt: skip
    """Count a bounded answer: by how much its residual exceeds the least, relative to the demand."""
    limit = np.array(options["limit"])
    phi_ddot = np.array(found["phi_ddot"])
    if np.any(np.abs(phi_ddot) > limit):
        row.note(np.inf, name, "a limit is exceeded")
        return
    held = np.array(found["limited"], dtype=bool)
    if bool(status & STATUS_VALUES["LIMITED"]) != bool(held.any()) or np.any(np.abs(phi_ddot[held]) != limit[held]):
        row.note(np.inf, name, "LIMITED and the mask disagree with the answer")
        return
    y = phi_ddot / np.diag(scaled.to_phi_ddot)
    demanded = float(np.linalg.norm(scaled.r))
    excess = abs(float(np.linalg.norm(scaled.r - scaled.W @ y)) - least_residual(scaled, limit))
    excess -= _weak_demand(scaled, y, held, THRESHOLDS[case.real].regular)
    row.note(max(excess, 0.0) / max(demanded, 1e-290), name)


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


def fast_rows(case: Case, function: str, loss: Callable[[State, ScaledDemand], float] | None = None) -> Iterator[Check]:
    """phi_ddot by normal equations, without and with damping, the refusal, and how well the equations are solved.

    The last is judged at any condition: an answer of bad condition solves them all the same. `loss`: relative errors
    of W and r in units of rounding; None: those of the whole carrier, or of the freedoms of a held one.
    """
    loss = loss if loss is not None else partial(_loss_along_freedoms, case)
    plain = Check(function, "phi_ddot, with weights", case.bounds.default)
    damped = Check(function, "phi_ddot, with damping", case.bounds.default)
    solved = Check(function, "residual of its equations", case.bounds.default)
    status_row = Check(function, "status", 0.0)
    for number, name, state, scaled in _demands(case, task_of(function)):
        given = case.backend.arguments(state)
        for row, damping in ((plain, 0.0), (damped, FAST_DAMPING)):
            options = options_of(case, number, damping=damping)
            weight = np.array(options["weight"])
            status, found = case.backend.call(function, given | {"options": options})
            rest = status & ~STATUS_VALUES["EXCESSIVE"] if status > 0 else status  # has a judge of its own
            off, words = wrong_refusal(case, rest, normal_matrix(scaled, weight, damping))
            status_row.note(off, name, words)
            note_fast(row, case, scaled, options, status, found, name, loss(state, scaled))
            if status >= 0 and not damping:
                solved.note(_normal_residual(scaled, weight, np.array(found["phi_ddot"])) / loss(state, scaled), name)
    if not plain.states:
        plain.words = f"condition of its equations above {SQUARED_CONDITION[case.real]:.0e}; see their residual"
    for row in (plain, damped, solved, status_row):
        yield row


def note_fast(
    row: Check, case: Case, scaled: ScaledDemand, options: Mapping[str, Any], status: int,
    found: Mapping[str, Any], name: str, loss: float = 1.0
) -> None:  # fmt: skip
    """Count an answer by normal equations, where their condition leaves digits."""
    weight, damping = np.array(options["weight"]), options["damping"]
    condition = condition_of_normal_equations(scaled, weight, damping)
    if condition > SQUARED_CONDITION[case.real]:
        return
    if status < 0:
        row.refuse(StateError(f"{row.judged} refused with status {status_words(status)}"), name)
        return
    expected = normal_equations(scaled, weight, damping)
    scale = loss * _scale_of_normal_equations(scaled, weight, condition, expected)
    row.compare(found["phi_ddot"], expected, scale, name)


def wrong_refusal(case: Case, status: int, gram: Array) -> tuple[float, str]:
    """Difference of a status of `inverse_fast`, and words: OK, or a refusal where a pivot of the matrix is too small.

    The least part that a pivot of Cholesky keeps of its diagonal decides, within a factor of ten.
    """
    kept = 1.0
    for j in range(len(gram)):
        if not gram[j, j] > 0:
            kept = 0.0
            break
        before = gram[:j, j]
        left = gram[j, j] - (before @ np.linalg.lstsq(gram[:j, :j], before, rcond=None)[0] if j else 0.0)
        kept = min(kept, float(left / gram[j, j]))
    least = THRESHOLDS[case.real].gram_pivot
    allowed = {STATUS_VALUES["OK"]} if kept > least / 10 else set()
    if kept < 10 * least:
        allowed.add(STATUS_VALUES["NOT_POSITIVE_DEFINITE"])
    if status in allowed:
        return 0.0, ""
    return np.inf, f"status {status_words(status)}; the least pivot is {kept:.0e} of its diagonal"


def _normal_residual(scaled: ScaledDemand, weight: Array, phi_ddot: Array) -> float:
    """Residual of the normal equations without damping for an answer, relative to their terms.

    With six flywheels and more y = Omega^-1 W^T z with gram z = r: z is that of least squares, and what it leaves of
    y counts as well.
    """
    W, r, y = scaled.W, scaled.r, np.linalg.solve(scaled.to_phi_ddot, phi_ddot)
    if not np.isfinite(y).all():
        return np.inf
    gram = normal_matrix(scaled, weight, 0.0)
    size, demanded = float(np.linalg.norm(gram, 2)), float(np.linalg.norm(r))
    if W.shape[1] < len(r):
        terms = size * float(np.linalg.norm(y)) + float(np.linalg.norm(W, 2)) * demanded
        return float(np.linalg.norm(gram @ y - W.T @ r)) / max(terms, 1e-290)
    back = (W / weight).T
    z = np.linalg.lstsq(back, y, rcond=None)[0]
    length = float(np.linalg.norm(z))
    outside = float(np.linalg.norm(back @ z - y)) / max(float(np.linalg.norm(back, 2)) * length, 1e-290)
    left = float(np.linalg.norm(gram @ z - r)) / max(size * length + demanded, 1e-290)
    return max(outside, left)
