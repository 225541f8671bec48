"""Judge of functions that choose accelerations or torques: `inverse`, its fast form, `torque_for`, and those of tasks.

All of them answer one problem: least |r - W y| within bounds, and of what is left the least sum of weight_s y_s^2. At
the answer its conditions are judged: the bounds are kept; flywheels that are free could take away nothing of the error,
and those at a bound are pressed against it; where no bound is touched, the answer is the literal one, or solves the
normal equations. What follows from an answer, and the status, are those of the literal equations.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

from mahovik.contract.functions import task_of as task_name_of
from mahovik.contract.status import STATUS_VALUES, status_bits, status_words
from mahovik.core.lower.thresholds import THRESHOLDS
from mahovik.core.stand.model import COMPONENTS, Motor, Stand
from mahovik.core.stand.state import State
from mahovik.errors import StateError
from mahovik.proof.reference.array import Array, Values, vector
from mahovik.proof.reference.inverse import (
    ScaledDemand,
    largest_damping,
    normal_matrix,
    scaled_demand,
    shares_of,
    weighted_solution,
)
from mahovik.proof.reference.motion import coupled, forward, torque
from mahovik.proof.reference.pieces import Pieces
from mahovik.proof.reference.tasks import TaskRows, scaled_task, task_of, task_rows, torque_demand
from mahovik.proof.verify.backends import turns
from mahovik.proof.verify.check import Check
from mahovik.proof.verify.functions.case import Case, Rows

Flags = NDArray[np.bool_]

DEMAND_DEVIATION = {"v": 5.0, "w": 20.0}
"""m/s2, rad/s2: spread of demanded accelerations and angular accelerations."""

DAMPED = {"near_singular": 0.8984375, "damping": 0.296875}
"""Options under which some singular value of most stands is damped; numbers of float."""

FAST_DAMPED = {"damping": 2.0**-4}
"""Likewise of `inverse_fast`, a part of the norm of W."""

LIMIT_SHARES = (0.7, 0.15)
"""Limits that are tried, over the largest acceleration without any: some flywheels are held, and most of them."""

EDGE = 0.02
"""Part by which a number that decides a bit of the status is off its bound: far above what rounding moves."""

TIGHT = 0.6
"""Part of the largest torque of the answer without bounds that motors have where bounds of torques are tried."""

WEAK = 30.0
"""A direction is weak whose singular value, over the first, is below this many roots of the threshold `bounded`."""

TARGET_RATE = 0.5
"""1/s, rate of approach to wanted speeds where these are tried."""


@dataclass(frozen=True)
class Question:
    """What is asked of the flywheels: the state (with a task's demand), the options, and a name.

    edge    the bit of the status that a number of the options decides, and by what; "" elsewhere
    use     rows of the task in use; None: all
    locked  flywheels that give no torque (N), of torques only
    """

    name: str
    state: State
    options: Mapping[str, Any]
    edge: str = ""
    use: Flags | None = None
    locked: Flags | None = None

    @property
    def weight(self) -> Array:
        """Weights of the flywheels (N)."""
        return np.array(self.options["weight"], dtype=np.float64)

    @property
    def wanted(self) -> Array:
        """What the rows in use demand."""
        demand = vector(self.state.demand)
        return demand if self.use is None else demand[self.use]

    def rows(self, stand: Stand, at: Pieces) -> TaskRows:
        """The rows of the task that are in use."""
        rows = task_rows(at, stand, task_of(stand, self.state.task))
        return rows if self.use is None else TaskRows(rows.S[self.use], rows.s[self.use])

    def scaled(self, stand: Stand, at: Pieces) -> ScaledDemand:
        """W y = r for accelerations."""
        if not self.state.task:
            return scaled_demand(at, vector(self.state.V_dot))
        return scaled_task(at, self.rows(stand, at), self.wanted)


@dataclass(frozen=True, eq=False)
class Problem:
    """Least |r - W y| for x = offset + to y within least..most (N): phi'' or tau; `locked` flywheels have no part."""

    scaled: ScaledDemand
    offset: Array
    least: Array
    most: Array
    locked: Flags

    @classmethod
    def of_accelerations(cls, question: Question, stand: Stand, at: Pieces) -> Problem:
        """Of phi'' within the limits of the options."""
        limit = np.array(question.options["limit"], dtype=np.float64)
        none = np.zeros(len(limit))
        return cls(question.scaled(stand, at), none, -limit, limit, none.astype(bool))

    @classmethod
    def of_torques(cls, question: Question, stand: Stand, at: Pieces) -> Problem:
        """Of tau within what the motors have, for rows of a task; wanted speeds near zero are avoided."""
        options, state, locked = question.options, question.state, cast(Flags, question.locked)
        target, end, speed = (np.array(each) for each in (options["target_speed"], options["avoid_speed"], at.phi_dot))
        backwards = np.where(target != 0, target, speed) < 0
        target = np.where(np.abs(target) < end, np.where(backwards, -end, end), target)
        wanted = options["target_rate"] * (target - speed)
        demand = torque_demand(at, question.rows(stand, at), question.wanted, wanted, cast(Array, locked))
        return cls(demand, demand.preferred, *motor_bounds(state, options), locked)

    @property
    def W(self) -> Array:
        """The scaled matrix (mxN), zero for what is locked."""
        return np.where(self.locked, 0.0, self.scaled.W)

    def y(self, x: Array) -> Array:
        """Scaled answer (N)."""
        return np.where(self.locked, 0.0, (x - self.offset) / np.diag(self.scaled.to_phi_ddot))

    def solution(self, weight: Array, rank: int, near: float = 0.0, damping: float = 0.0) -> Array:
        """x (N) without bounds: least error, then least weighted y."""
        x = self.offset + weighted_solution(self.scaled, weight, rank, near, damping)
        return np.where(self.locked, 0.0, x)


def judge_conditions(
    case: Any, rows: Rows, where: str, problem: Problem, x: Array, found: Mapping[str, Any], status: int, slack: float,
    regular: float,
) -> None:  # fmt: skip
    """The bounds are kept, and the conditions of a least error hold within them; `limited` and its bit say so.

    `slack`: by which part of a bound rounding may exceed it; `regular`: 0 where directions are weak, and no error is
    judged.
    """
    limited, size = np.array(found["limited"], dtype=bool), np.maximum(np.abs(problem.least), np.abs(problem.most))
    high, low = x >= problem.most - slack * size, x <= problem.least + slack * size
    inside = (x <= problem.most + slack * size) & (x >= problem.least - slack * size)
    rows.check("bounds kept", 0.0).demand(bool(np.all(inside | problem.locked)), where, "a bound is exceeded")
    right = bool(np.all((high | low | problem.locked)[limited]))
    rows.check("limited", 0.0).demand(right, where, "limited, but not at a bound")
    bits = status_bits(status)
    rows.check("LIMITED", 0.0).demand(bool(limited.any()) == ("LIMITED" in bits), where, "not as `limited` says")
    side = np.where(problem.locked, 0.0, high * 1.0 - low * 1.0)
    pinned = high & low & ~problem.locked
    W, r, y = problem.W, problem.scaled.r, problem.y(x)
    if regular and np.any(np.isfinite(size) & (size < 1e30)):
        off = excess(np.where(pinned, 0.0, W), r, r - W @ y, side, regular)
        rows.check("least error, within bounds", case.limits.optimality).note(off, where)
    left, most = float(np.linalg.norm(r - W @ y)), case.scales.cuts.reached * float(np.linalg.norm(r))
    if not most / 10.0 < left < 10.0 * most:  # elsewhere rounding decides it
        words = f"the error is {left:.1e}, of {most:.1e} accepted"
        rows.check("UNREACHABLE", 0.0).demand((left > most) == ("UNREACHABLE" in bits), where, words)


def excess(W: Array, r: Array, error: Array, side: Array, regular: float) -> float:
    """By how much the error r - W y exceeds the least within bounds, at most, over |r|.

    Flywheels that are free could still take away what of the error lies in the span of their columns; one that is held
    (`side` 1 or -1: at its upper or lower bound) what lies along its own, if that leads away from the bound. Of weak
    directions a regularised solver leaves a part: with `regular` on the diagonal, below a ratio of 3 sqrt(regular) a
    tenth and more.
    """
    U, sigma, _ = np.linalg.svd(W[:, side == 0.0], full_matrices=False)
    taken = U[:, sigma > 3.0 * np.sqrt(regular) * float(np.linalg.norm(W, 2))].T @ error
    released = np.maximum(-side * (W.T @ error), 0.0) / np.maximum(np.linalg.norm(W, axis=0), 1e-290)
    whole, part = float(error @ error), float(taken @ taken + released @ released)
    return float(part / (np.sqrt(whole) + np.sqrt(max(whole - part, 0.0)) + 1e-290) / max(np.linalg.norm(r), 1e-290))


# Accelerations.


def inverse_checks(case: Case, function: str) -> list[Check]:
    """All that `inverse` or `inverse_fast` says: weights, damping, limits, rows freed, and edges of status bits."""
    rows, fast = Rows(case.limits, case.scales, function), function.startswith("inverse_fast")
    for number, (name, state) in enumerate(_states(case, function)):
        given = case.backend.arguments(state) | (turns(state) if number % 2 else {})
        answer: Mapping[str, Any] = {}
        for questions in (_plain_questions, _bounded_questions):
            for question in questions(case, fast, number, name, state, answer):
                status, outputs = case.backend.call(function, {**given, "options": question.options})
                found = {"phi_ddot": [], "sigma": [], "limited": []} | outputs.get("out", outputs)
                _judge_refusal(case, rows, question, fast, status)
                if status >= 0:
                    _judge_inverse(case, rows, question, fast, status, found)
                    answer = answer or found
            if not answer or not case.count:
                break
    return list(rows.checks.values())


def _judge_refusal(case: Case, rows: Rows, question: Question, fast: bool, status: int) -> None:
    """Only `inverse_fast` may refuse: by the least part that a pivot of Cholesky keeps of its diagonal.

    Within a factor of ten of the threshold both are right.
    """
    words = f"status {status_words(status)}"
    if not fast:
        if status < 0:
            rows.check("answer").demand(False, question.name, words)
        return
    scaled = question.scaled(case.stand, case.scales.at(question.state))
    gram, kept = normal_matrix(scaled, question.weight, float(question.options["damping"])), 1.0
    for j in range(len(gram)):
        before = gram[:j, j]
        left = gram[j, j] - (before @ np.linalg.lstsq(gram[:j, :j], before, rcond=None)[0] if j else 0.0)
        kept = min(kept, float(left / gram[j, j])) if kept and gram[j, j] > 0 else 0.0
    least, refused = THRESHOLDS[case.real].gram_pivot, status == STATUS_VALUES["NOT_POSITIVE_DEFINITE"]
    right = kept < 10 * least if refused else kept > least / 10 and status in (0, STATUS_VALUES["EXCESSIVE"])
    rows.check("refusal", 0.0).demand(right, question.name, words)


def _judge_inverse(
    case: Case, rows: Rows, question: Question, fast: bool, status: int, found: Mapping[str, Any]
) -> None:
    """Judge one answer of `inverse` or `inverse_fast`."""
    state, where, x = question.state, question.name, vector(found["phi_ddot"])
    at, bits = case.scales.at(state), status_bits(status)
    if not fast:
        problem = Problem.of_accelerations(question, case.stand, at)
        regular = THRESHOLDS[case.real].regular
        judge_conditions(case, rows, where, problem, x, found, status, 0.0, regular)
    if question.edge.startswith("LIMITED"):
        return
    if question.edge:
        bit = question.edge.partition(" ")[0]
        expected = bit in answer_of(case, question, case.stand, at, x, fast)["status"].split("|")
        words = f"{bit} {'expected' if expected else 'not expected'}"
        rows.check(f"{bit} at its bound", 0.0).demand(expected == (bit in bits), f"{where}, {question.edge}", words)
        return
    if fast:
        _judge_normal_equations(rows, question, x)
        return
    free = float(np.min(question.options["limit"], initial=np.inf)) > 1e30
    words = "|".join(sorted(set(bits) - {"LIMITED", "UNREACHABLE"}))

    def equation(stand: Stand, _: State, near: Pieces) -> Values:
        return answer_of(case, question, stand, near, None if free else x)

    suffix, more = ("", _left_by_damping(case, question)) if free else (", with limits", {})
    rows.compare(where, state, equation, {**found, "status": words}, suffix, least_squares=True, more=more)
    _judge_hardest(rows, question, found)
    if state.task:
        _judge_by_points(case, rows, question, found)


def answer_of(
    case: Case, question: Question, stand: Stand, at: Pieces, phi_ddot: Array | None, fast: bool = False
) -> Values:
    """The literal answer to a question; of an answer `phi_ddot` what it brings about.

    status  bits joined by |, in the order of their names, but for LIMITED and UNREACHABLE
    """
    options, cuts = question.options, case.scales.cuts
    scaled, near, damping = question.scaled(stand, at), float(options["near_singular"]), float(options["damping"])
    sigma = np.asarray(np.linalg.svd(scaled.W, compute_uv=False), dtype=np.float64)
    rank = int(np.sum(sigma > cuts.rank * sigma[0])) if sigma.size else 0
    values: Values = {}
    if phi_ddot is None:
        phi_ddot = weighted_solution(scaled, question.weight, rank, near, damping)
        values = {"phi_ddot": phi_ddot, "limited": np.zeros(len(phi_ddot), dtype=np.int64)}
    V_dot = forward(at, phi_ddot)
    if question.state.task:
        left = np.zeros(len(question.state.demand))
        left[slice(None) if question.use is None else question.use] = question.wanted - question.rows(
            stand, at
        ).acceleration(V_dot)
        padded = np.zeros(min(len(left), len(phi_ddot)))
        padded[: len(sigma)] = sigma
        values |= {"V_dot": V_dot, "residual": left, "sigma": padded}
    else:
        values |= {"residual": scaled.c - scaled.A @ phi_ddot, "sigma": sigma}
    tau = np.diag(at.Theta_ff) * phi_ddot if fast else torque(at, V_dot, phi_ddot)
    is_near = bool(rank and np.any(sigma[:rank] < near * sigma[0]))
    bits = {
        "DAMPED": is_near and damping > 0,
        "EXCESSIVE": bool(np.any(shares_of(with_motors(stand, options), at, tau, phi_ddot) > 1.0)),
        "NEAR_SINGULAR": is_near,
        "RANK_DEFICIENT": rank < min(len(scaled.r), len(phi_ddot)),
    }
    damped_by = largest_damping(scaled, rank, near, damping) if damping else 0.0
    return values | {"rank": rank, "damped_by": damped_by, "status": "|".join(bit for bit in bits if bits[bit])}


def with_motors(stand: Stand, options: Mapping[str, Any]) -> Stand:
    """The stand with what the options say that each flywheel has."""
    wheels = []
    for k, wheel in enumerate(stand.flywheels):
        most, speed = (float(options[key][k]) for key in ("motor_torque", "motor_speed"))
        bearing = [float(options[f"motor_{key}"][k]) for key in ("viscous", "coulomb", "coulomb_speed")]
        own = (most if most < 1e30 else None, speed if speed < 1e30 else None)
        wheels.append(replace(wheel, motor=Motor(*own, None, None, None, *bearing) if any(own) else None))
    return replace(stand, flywheels=tuple(wheels), inverse_most=float(np.min(options["most"], initial=np.inf)))


def _left_by_damping(case: Case, question: Question) -> dict[str, Array]:
    """What damping leaves of an answer along weak directions: `regular` of it, stretched by the weights."""
    regular, scaled = THRESHOLDS[case.real].regular, question.scaled(case.stand, case.scales.at(question.state))
    sigma = np.linalg.svd(scaled.W, compute_uv=False)
    kept = sigma[sigma > case.scales.cuts.rank * sigma[0]] if sigma.size else sigma
    near, damping = float(question.options["near_singular"]), float(question.options["damping"])
    if not damping or not kept.size or kept[-1] >= 3.0 * np.sqrt(regular) * kept[0]:
        return {}
    answer, to = weighted_solution(scaled, question.weight, len(kept), near, damping), np.diag(scaled.to_phi_ddot)
    ratio = float(question.weight.max() / question.weight.min())
    return {"phi_ddot": ratio * float(np.linalg.norm(answer / to)) * regular / case.limits.value * to}


def _judge_hardest(rows: Rows, question: Question, found: Mapping[str, Any]) -> None:
    """A unit vector u: along the demand out of reach, or the least singular direction, W W^T u = sigma_m^2 u."""
    hardest, rank = vector(found["hardest"]), int(found["rank"])
    hardest = hardest if question.use is None else hardest[question.use]
    if not np.any(hardest):
        return

    def sides(stand: Stand, _: State, at: Pieces) -> Values:
        scaled = question.scaled(stand, at)
        u = scaled.root @ hardest
        U, sigma, _V = np.linalg.svd(scaled.W, full_matrices=True)
        length = np.array([[np.linalg.norm(u)], [1.0]])
        if rank < len(u):
            return {"length": length, "direction": np.stack([U[:, :rank] @ (U[:, :rank].T @ u), np.zeros(len(u))])}
        pair = [scaled.W @ (scaled.W.T @ u) / sigma[0] ** 2, (sigma[-1] / sigma[0]) ** 2 * u]
        return {"length": length, "direction": np.stack(pair)}

    rows.balance("hardest", question.name, question.state, sides, 1.0)


def _judge_normal_equations(rows: Rows, question: Question, phi_ddot: Array) -> None:
    """They hold at any condition number: an answer of bad condition solves the equations all the same."""

    def sides(stand: Stand, _: State, at: Pieces) -> Values:
        scaled = question.scaled(stand, at)
        y = phi_ddot / np.diag(scaled.to_phi_ddot)
        gram = normal_matrix(scaled, question.weight, float(question.options["damping"]))
        if scaled.W.shape[1] < len(scaled.r):
            return {"equations": np.stack([gram @ y, scaled.W.T @ scaled.r])}
        back = (scaled.W / question.weight).T
        z = np.linalg.lstsq(back, y, rcond=None)[0]
        return {"equations": np.stack([gram @ z, scaled.r]), "y": np.stack([y, back @ z])}

    rows.balance("normal equations", question.name, question.state, sides)


# What is asked.


def _states(case: Case, function: str) -> Iterator[tuple[str, State]]:
    """The states, with a random demand of a task."""
    task = task_name_of(function)
    for number, (name, state) in enumerate(case.states):
        if task:
            sizes = [DEMAND_DEVIATION[row.component[0]] for row in task_of(case.stand, task).rows]
            drawn = case.nearest_numbers(case.random(300 + number).normal(size=len(sizes)) * sizes)
            state = replace(state, task=task, demand=tuple(drawn.tolist()))  # noqa: PLW2901
        yield name, state


def options_of(case: Case, number: int, **more: Any) -> dict[str, Any]:
    """Weights from 1 to 10, motors without limits or friction, and `more`, in numbers of the element type."""
    given: dict[str, Any] = dict(case.backend.arguments(case.states[0][1])["options"])
    no, none = [0.0] * case.count, case.none
    given |= {"weight": case.random(100 + number).uniform(1.0, 10.0, case.count), "limit": none, "most": none}
    given |= {"near_singular": 1e-6, "damping": 0.0, "motor_torque": none, "motor_speed": none}
    given |= {"motor_viscous": no, "motor_coulomb": no, "motor_coulomb_speed": [1.0] * case.count} | more
    return {key: case.nearest_numbers(x).tolist() if isinstance(x, np.ndarray) else x for key, x in given.items()}


def _plain_questions(
    case: Case, fast: bool, number: int, name: str, state: State, _: Mapping[str, Any]
) -> Iterator[Question]:
    """Weights, damping, and rows of a task freed. The first is what edges of the status are sought for."""
    yield Question(name, state, options_of(case, number, **(FAST_DAMPED if fast else {})))
    yield Question(name, state, options_of(case, number, **({} if fast else DAMPED)))
    if state.task:
        rng = case.random(500 + number)
        use = rng.random(len(state.demand)) < 0.6
        use[rng.integers(len(use))] = True
        freed = {f"use_{state.task}": [int(each) for each in use]}
        yield Question(name, state, options_of(case, number, **freed), use=use)


def _bounded_questions(
    case: Case, fast: bool, number: int, name: str, state: State, answer: Mapping[str, Any]
) -> Iterator[Question]:
    """Limits, and options of which a single number decides a bit of the status: of an answer without any."""
    options: dict[str, dict[str, Any]] = {}
    phi_ddot, N = vector(answer["phi_ddot"]), case.count
    largest = float(np.abs(phi_ddot).max()) or 1.0
    for part in () if fast else LIMIT_SHARES:
        yield Question(name, state, options_of(case, number, limit=np.full(N, part * largest)))
    for part in (1.0 - EDGE, 1.0 + EDGE):
        if not fast:
            options[f"LIMITED at {part:g}"] = {"limit": np.full(N, largest * part)}
            sigma, rank = answer["sigma"], answer["rank"]
            if 0 < rank <= len(sigma) and sigma[rank - 1] < sigma[0]:
                near = float(case.nearest_numbers(sigma[rank - 1] / sigma[0] * part))
                options[f"NEAR_SINGULAR at {part:g}"] = {"near_singular": min(near, 1.0)}
        if np.any(phi_ddot):
            options[f"EXCESSIVE by `most` at {part:g}"] = {"most": np.full(N, np.abs(phi_ddot).max() / part)}
    options |= _motors(case, number, case.scales.at(state), phi_ddot, fast)
    for edge, own in options.items():
        yield Question(name, state, options_of(case, number, **(FAST_DAMPED if fast else {}), **own), edge)


def _motors(case: Case, number: int, at: Pieces, phi_ddot: Array, fast: bool) -> dict[str, dict[str, Any]]:
    """Motors of which one has a little less than an answer needs, and a little more.

    By torque; with friction; near the speed at which a driving motor has no torque left; and by both.
    """
    N, s, rng, found = case.count, number % case.count, case.random(600 + number), {}
    tau = np.diag(at.Theta_ff) * phi_ddot if fast else torque(at, forward(at, phi_ddot), phi_ddot)
    reach = np.abs(at.phi_dot) + 1.0
    friction = {
        "motor_viscous": 0.3 * np.abs(tau) / reach * rng.uniform(0.5, 2.0, N),
        "motor_coulomb": 0.5 * np.abs(tau) * rng.uniform(0.5, 2.0, N),
        "motor_coulomb_speed": reach * rng.uniform(0.2, 5.0, N),
    }
    speed = {"motor_speed": reach * rng.uniform(1.5, 3.0, N)}
    kinds: dict[str, dict[str, Any]] = {"torque": {}, "friction": friction, "speed": speed, "both": friction | speed}
    for kind, own in kinds.items():
        options = options_of(case, number, motor_torque=np.ones(N), **own)
        needed = shares_of(with_motors(case.stand, options), at, tau, phi_ddot)  # N m of the motor
        if not 0.0 < needed[s] < np.inf or not np.isfinite(needed).all():
            continue
        for part in (1.0 - EDGE, 1.0 + EDGE):
            torques = np.where(needed > 0.0, needed * np.where(np.arange(N) == s, part, 2.0), needed[s])
            found[f"EXCESSIVE of flywheel {s + 1} by {kind} at {part:g}"] = own | {"motor_torque": torques}
    return found


# Torques.


def torque_checks(case: Case, function: str) -> list[Check]:
    """Torques for a task: without bounds a value, within bounds the least error or the largest share of the demand."""
    rows = Rows(case.limits, case.scales, function)
    for number, (name, state) in enumerate(_states(case, function)):
        locked: Flags = np.zeros(case.count, dtype=np.bool_)
        if number % 3 == 2 and case.count > 1:
            locked[case.random(800 + number).integers(case.count)] = True
        given = case.backend.arguments(state) | {"locked": [int(each) for each in locked]}
        options = options_of(
            case, number, motor_speed=2.0 * np.abs(state.phi_dot) + 10.0, motor_power=case.none,
            target_speed=case.random(700 + number).uniform(-100.0, 100.0, case.count),
            target_rate=TARGET_RATE if number % 2 else 0.0, avoid_speed=20.0, keep_direction=0,
        )  # fmt: skip
        free = Problem.of_torques(Question(name, state, options, locked=locked), case.stand, case.scales.at(state))
        tau = np.abs(free.solution(np.array(options["weight"]), _rank(free)))
        tight = {"motor_torque": [float(np.float32(TIGHT * float(tau.max(initial=0.0)) or 1.0))] * case.count}
        for more in ({}, tight, tight | {"keep_direction": 1}):
            try:
                status, found = case.call_with_status(function, {**given, "options": options | more})
            except StateError as error:
                rows.check("answer").refuse(error, name)
                continue
            judge_torques(case, rows, name, state, options | more, locked, status, found)
    return list(rows.checks.values())


def motor_bounds(state: State, options: Mapping[str, Any]) -> tuple[Array, Array]:
    """Least and largest torque (N, N m): driving, less with speed and by the power; braking, all that motors have."""
    speed = np.array(state.phi_dot)
    whole, power = np.minimum(np.array(options["motor_torque"]), 1e9), np.array(options["motor_power"])
    driving = whole * np.maximum(0.0, 1.0 - np.abs(speed) / np.array(options["motor_speed"]))
    with np.errstate(divide="ignore", over="ignore"):
        driving = np.where(driving * np.abs(speed) > power, power / np.abs(speed), driving)
    return np.where(speed < 0, -driving, -whole), np.where(speed > 0, driving, whole)


def _rank(problem: Problem) -> int:
    return int(np.linalg.matrix_rank(problem.scaled.W, rtol=1e-9))


def judge_torques(
    case: Any, rows: Rows, name: str, state: State, options: Mapping[str, Any], locked: Flags, status: int,
    found: Mapping[str, Any]
) -> None:  # fmt: skip
    """Judge one answer: torques, what they bring about, the status. `case`: with stand, scales, limits and second."""
    question, tau = Question(name, state, options, locked=locked), vector(found["tau"])
    problem = Problem.of_torques(question, case.stand, case.scales.at(state))
    expected = problem.solution(question.weight, _rank(problem))
    sigma = np.linalg.svd(problem.scaled.W, compute_uv=False)
    kept = sigma[sigma > 1e-9 * sigma[0]] if sigma[0] else sigma
    # what regularisation costs along directions that flywheels hardly reach is not given back in full
    is_weak = bool(np.any(kept < WEAK * np.sqrt(THRESHOLDS["double"].bounded) * sigma[0]))
    of_share = bool(options.get("keep_direction"))
    if np.all((expected > problem.least) & (expected < problem.most) | locked) and not is_weak and not of_share:

        def least(stand: Stand, near: State, at: Pieces) -> Values:
            asked = Problem.of_torques(replace(question, state=near), stand, at)
            return {"tau": asked.solution(question.weight, _rank(asked))}

        rows.compare(name, state, least, found, least_squares=True)
    regular = 0.0 if is_weak or of_share else THRESHOLDS[case.limits.real].bounded
    slack = 4.0 * rows.check("tau").limit
    judge_conditions(case, rows, name, problem, tau, found, status, slack, regular)
    if of_share:
        _judge_share(case, rows, question, problem, found, is_weak)

    def equation(stand: Stand, near: State, at: Pieces) -> Values:
        V_dot, phi_ddot = coupled(at, tau, cast(Array, locked))
        left = vector(state.demand) - question.rows(stand, at).acceleration(V_dot)
        return {"V_dot": V_dot, "phi_ddot": phi_ddot, "residual": left}

    rows.compare(name, state, equation, found)
    _judge_by_points(case, rows, question, found)


def _judge_share(
    case: Any, rows: Rows, question: Question, problem: Problem, found: Mapping[str, Any], is_weak: bool
) -> None:
    """The answer is that of its share, and the share the largest t <= 1 with W y = start + t towards within bounds.

    0 where the motors have not even what W y = start takes.
    """
    from scipy.optimize import linprog

    scaled, share, limit = problem.scaled, float(found["share"]), case.limits.optimality
    towards = scaled.root @ vector(question.state.demand)
    start, y = scaled.r - towards, problem.y(vector(found["tau"]))
    if share > 0.0:
        off = scaled.W @ y - start - share * towards
        size = float(np.linalg.norm(start) + np.linalg.norm(towards) + np.linalg.norm(scaled.W) * np.linalg.norm(y))
        rows.check("answer of its share", limit).note(float(np.linalg.norm(off)) / size, question.name)
    if is_weak:
        return
    lengths, size = np.maximum(np.linalg.norm(problem.W, axis=0), 1e-290), float(np.linalg.norm(towards))
    bounds = [problem.y(bound) * lengths / size for bound in (problem.least, problem.most)]
    answer = linprog(
        np.append(np.zeros(len(y)), -1.0), A_eq=np.column_stack([problem.W / lengths, -towards / size]),
        b_eq=start / size, bounds=[*zip(*bounds, strict=True), (0.0, 1.0)],
    )  # fmt: skip
    largest = float(answer.x[-1]) if answer.success else 0.0
    words = f"{share:.9g}, in reach is {largest:.9g}"
    rows.check("largest share", limit).note(abs(share - largest), question.name, words)


def _judge_by_points(case: Any, rows: Rows, question: Question, found: Mapping[str, Any]) -> None:
    """The residual by the second derivation's points: the rows of the literal reference have no part in it."""
    state, V_dot, points = question.state, vector(found["V_dot"]), {}
    task, gravity = task_of(case.stand, state.task), np.array(case.stand.gravity)
    if any(row.of for row in task.rows):
        moving = replace(state, task="", demand=(), V_dot=tuple(V_dot))
        points = case.second.evaluate(moving, ("points",))["points"]

    def motion(of: str) -> Array:
        """Acceleration and angular acceleration of O1 or a point (6), in its axes."""
        if not of:
            return V_dot
        at = points[of]
        return np.concatenate([at["specific_force"] + at["C"].T @ gravity, at["angular_acceleration"]])

    reached = np.array([motion(row.of)[COMPONENTS.index(row.component)] for row in task.rows])
    speeds = np.sum(np.abs(state.V)) ** 2 + np.linalg.norm(gravity) + np.max(np.abs(V_dot))
    left = vector(state.demand) - reached
    left = left if question.use is None else np.where(question.use, left, 0.0)
    scale = np.abs(vector(state.demand)) + np.abs(reached) + speeds
    rows.check("residual, by points of the second").compare(found["residual"], left, scale, question.name)
