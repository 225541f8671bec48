"""Judge of functions that choose accelerations or torques: `inverse`, its fast form, `torque_for`, and those of tasks.

All of them answer one problem: least |r - W y| within bounds, and of what is left the least sum of weight_s y_s^2. At
the answer its conditions are judged: the bounds are kept; flywheels that are free could take away nothing of the error,
and those at a bound are pressed against it; where no bound is touched, the answer is the literal one, or solves the
normal equations. What follows from an answer is that of the literal equations. Each bit of a status is judged on both
sides of its bound, where one number that decides it was drawn for that.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, fields, replace
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

from mahovik.contract.functions import task_of as task_name_of
from mahovik.contract.status import status_bits, status_words
from mahovik.core.lower.limits import THRESHOLDS
from mahovik.core.lower.values import parameters_of
from mahovik.core.stand.fields import Vec6
from mahovik.core.stand.model import COMPONENTS, Stand, State
from mahovik.core.stand.motor import Motor
from mahovik.errors import StateError
from mahovik.proof.reference.algebra import Array, Values, solve, vector
from mahovik.proof.reference.evaluate import pieces
from mahovik.proof.reference.inverse import (
    ScaledDemand,
    TaskRows,
    largest_damping,
    least_pivot,
    normal_matrix,
    scaled_demand,
    scaled_task,
    shares_of,
    task_of,
    task_rows,
    torque_demand,
    weighted_solution,
)
from mahovik.proof.reference.motion import coupled, forward, torque
from mahovik.proof.reference.pieces import Pieces
from mahovik.proof.verify.backends import turns
from mahovik.proof.verify.compare import FAR_SIDES, Case, Rows
from mahovik.proof.verify.scales import Measured, Scales
from mahovik.proof.verify.states import Request

Flags = NDArray[np.bool_]

DEMAND_DEVIATION = {"v": 5.0, "w": 20.0}
"""m/s2, rad/s2: spread of demanded accelerations and angular accelerations."""

DAMPED = {"near_singular": 0.8984375, "damping": 0.296875}
"""Options under which some singular value of most stands is damped; numbers of float."""

FAST_DAMPED = {"damping": 2.0**-4}
"""Likewise of `inverse_fast`, a part of the norm of W."""

LIMIT_SHARES = (0.7, 0.15)
"""Limits that are tried, over the largest acceleration without any: some flywheels are held, and most of them."""

SIDES = {"double": (1 - 1e-6, 1 + 1e-6), "float": (0.98, 1.02)}
"""Parts of its bound at which a number of the options is that decides a bit: more apart than rounding moves it."""

EDGE_STATES = 3
"""States at which stands are sought whose rank is just deficient: each is made anew."""

TIGHT = 0.6
"""Part of the largest torque of the answer without bounds that motors have where bounds of torques are tried."""

WEAK = 30.0
"""A direction is weak whose singular value, over the first, is below this many roots of the threshold `bounded`."""

TARGET_RATE = 0.5
"""1/s, rate of approach to wanted speeds where these are tried."""


@dataclass(frozen=True)
class Question:
    """What is asked of the flywheels.

    name     of the state
    state    with a task's demand
    options  of the function
    use      rows of the task in use; None: all
    locked   flywheels that give no torque (N), of torques only
    edge     the name of a bit or refusal that one number decides, and by what; "" elsewhere
    due      whether the status has it
    stand    another stand than the C's by default: its table is given
    with_turns  whether sines and cosines of the phases are given
    """

    name: str
    state: State
    options: Mapping[str, Any]
    use: Flags | None = None
    locked: Flags | None = None
    edge: str = ""
    due: bool = False
    stand: Stand | None = None
    with_turns: bool = False

    @property
    def weight(self) -> Array:
        """Weights of the flywheels (N)."""
        return np.array(self.options["weight"], dtype=np.float64)

    @property
    def damping(self) -> tuple[float, float]:
        """`near_singular` and `damping`."""
        return float(self.options["near_singular"]), float(self.options["damping"])

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
    def of_torques(cls, question: Question, stand: Stand, at: Pieces) -> Problem:
        """The problem of torques: tau within what the motors have, for rows of a task; speeds near zero are avoided."""
        options, state, locked = question.options, question.state, cast(Flags, question.locked)
        target, end, speed = (np.array(x) for x in (options["target_speed"], options["avoid_speed"], at.phi_dot))
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
        return np.where(self.locked, 0.0, (x - self.offset) / self.scaled.to_phi_ddot)

    def solution(self, weight: Array) -> Array:
        """x (N) without bounds: least error, then least weighted y."""
        rank = int(np.linalg.matrix_rank(self.scaled.W, rtol=1e-9))
        return np.where(self.locked, 0.0, self.offset + weighted_solution(self.scaled, weight, rank))


def judge_conditions(
    case: Any, rows: Rows, question: Question, problem: Problem, x: Array, answer: Mapping[str, Any], status: int,
    slack: float, regular: float, measured: Measured | None,
) -> None:  # fmt: skip
    """The bounds are kept, and the conditions of a least error hold within them; LIMITED and UNREACHABLE say so.

    `slack`: by which part of a bound rounding may exceed it; `regular`: 0 where directions are weak, and no error is
    judged. UNREACHABLE is due by the residual that is given, which is judged by itself; `measured`: with its scale.
    """
    where, scaled, bits = question.name, problem.scaled, status_bits(status)
    limited, size = np.array(answer["limited"], dtype=bool), np.maximum(np.abs(problem.least), np.abs(problem.most))
    high, low = x >= problem.most - slack * size, x <= problem.least + slack * size
    inside = (x <= problem.most + slack * size) & (x >= problem.least - slack * size)
    rows.demand("bounds kept", bool(np.all(inside | problem.locked)), where, "a bound is exceeded")
    rows.demand("limited", bool(np.all((high | low | problem.locked)[limited])), where, "limited, but not at a bound")
    rows.demand("LIMITED", bool(limited.any()) == ("LIMITED" in bits), where, "not as `limited` says")
    side, pinned = np.where(problem.locked, 0.0, high * 1.0 - low * 1.0), high & low & ~problem.locked
    if regular and np.any(np.isfinite(size) & (size < 1e30)):
        off = excess(np.where(pinned, 0.0, problem.W), scaled.r, scaled.r - problem.W @ problem.y(x), side, regular)
        rows.check("least error, within bounds").note(off, where)
    residual = vector(answer["residual"])
    left, most = residual if question.use is None else residual[question.use], np.linalg.norm(scaled.r)
    rows.judge_reach(where, measured, scaled.root, left, float(case.scales.cuts.reached * most), "UNREACHABLE" in bits)


def kept_values(case: Any, scaled: ScaledDemand) -> Array:
    """Singular values of W that count."""
    sigma = np.asarray(np.linalg.svd(scaled.W, compute_uv=False), dtype=np.float64)
    return sigma[sigma > case.scales.cuts.rank * sigma[0]] if sigma.size else sigma


def has_weak(kept: Array, regular: float) -> bool:
    """Whether a regularised solver leaves a tenth and more of some direction, with `regular` on the diagonal."""
    return bool(np.any(kept < 3.0 * np.sqrt(regular) * kept[:1]))


def excess(W: Array, r: Array, error: Array, side: Array, regular: float) -> float:
    """Upper bound of what the error r - W y has above the least within bounds, as a part of |r|.

    Flywheels that are free could still take away what of the error lies in the span of their columns; one that is held
    (`side` 1 or -1: at its upper or lower bound) what lies along its own, if that leads away from the bound. Of weak
    directions a regularised solver leaves a part (`has_weak`).
    """
    U, sigma, _ = np.linalg.svd(W[:, side == 0.0], full_matrices=False)
    taken = U[:, sigma > 3.0 * np.sqrt(regular) * float(np.linalg.norm(W, 2))].T @ error
    released = np.maximum(-side * (W.T @ error), 0.0) / np.maximum(np.linalg.norm(W, axis=0), 1e-290)
    whole, part = float(error @ error), float(taken @ taken + released @ released)
    return float(part / (np.sqrt(whole) + np.sqrt(max(whole - part, 0.0)) + 1e-290) / max(np.linalg.norm(r), 1e-290))


# Accelerations.


def judge_inverse(case: Case, rows: Rows) -> None:
    """All that `inverse` or `inverse_fast` says: weights, damping, limits, rows freed; and bits at their bounds."""
    fast = rows.function.startswith("inverse_fast")

    def ask(question: Question) -> tuple[int, dict[str, Any]]:
        """Status and answer of the C. Raises StateError: it does not take the stand."""
        arguments = case.backend.arguments(question.state) | (turns(question.state) if question.with_turns else {})
        if question.stand is not None:
            parameters = parameters_of(question.stand, case.backend.layout)
            arguments |= {
                "table": case.call("prepare", {"parameters": parameters, "table": case.backend.table()})["table"]
            }
        status, outputs = case.backend.call(rows.function, arguments | {"options": question.options})
        return status, {"phi_ddot": [], "sigma": [], "limited": []} | outputs.get("out", outputs)

    if rows.function == "inverse" and case.real == "double":  # in float the shaking of the scales raises the rank
        _judge_copies(case, rows)
    for number, (name, state) in enumerate(_states(case, rows.function)):
        for question in _questions(case, fast, number, name, state, ask):
            try:
                status, answer = ask(question)
            except StateError:  # flywheels this small are none
                continue
            if question.edge:
                bit, bits = question.edge.partition(" ")[0], status_bits(status) if status > 0 else status_words(status)
                words = f"{bit} {'expected' if question.due else 'not expected'}, status {status_words(status)}"
                rows.demand(f"{bit} at its bound", (bit in bits) == question.due, f"{name}, {question.edge}", words)
            elif fast:
                _judge_fast(case, rows, question, status, vector(answer["phi_ddot"]))
            elif status < 0:
                rows.demand("answer", False, name, f"status {status_words(status)}")
            else:
                _judge_inverse(case, rows, question, status, answer)


COPIED = ("mount", "position", "mounting", "mass", "center_of_mass", "inertia", "inertia_about")
"""Numbers in which a copy of a flywheel is like it."""


def _copies(stand: Stand, rank: int) -> tuple[Stand, list[int]]:
    """The stand with all flywheels but `rank` as copies of these, and of which flywheel each is one."""
    like = [k % rank for k in range(len(stand.flywheels))]
    numbers = ({key: getattr(stand.flywheels[k], key) for key in COPIED} for k in like)
    wheels = (replace(wheel, **copied) for wheel, copied in zip(stand.flywheels, numbers, strict=True))
    return replace(stand, flywheels=tuple(wheels)), like


def _moved_alike(state: State, like: Sequence[int]) -> State:
    """The state with the motion of each flywheel that of another."""
    moved: dict[str, Any] = {key: tuple(getattr(state, key)[k] for k in like) for key in ("phi", "phi_dot")}
    return replace(state, **moved)


def _judge_copies(case: Case, rows: Rows) -> None:
    """Answers where the rank is deficient: all flywheels but too few are copies of these, with their motion."""
    some = case.states[:1]
    rank = min(case.count, case.scales.at(some[0][1]).S.shape[1] if some else 0) - 1
    if rank < 1:
        return
    stand, like = _copies(case.stand, rank)
    parameters = parameters_of(stand, case.backend.layout)
    table = case.call("prepare", {"parameters": parameters, "table": case.backend.table()})["table"]
    judged, check = Rows(case.limits, Scales(stand, case.real), "inverse"), rows.check("of deficient rank", "value")
    for name, state in some:
        request = Request(name, _moved_alike(state, like), ("inverse",))
        answer = case.backend.answer("inverse", request.state, case.backend.arguments(request.state) | {"table": table})
        judged.compare_want(request, answer)
        check.demand("RANK_DEFICIENT" in answer["status"], name, f"status {answer['status']}")
    for one in judged.checks():
        check.note(one.value, f"{one.state}, {one.quantity}", one.words)


def _judge_inverse(case: Case, rows: Rows, question: Question, status: int, answer: Mapping[str, Any]) -> None:
    """Judge one answer of `inverse`: its conditions, and what follows from it."""
    where, x, at = question.name, vector(answer["phi_ddot"]), case.scales.at(question.state)
    limit, regular = np.array(question.options["limit"], dtype=np.float64), THRESHOLDS[case.real].regular
    none = np.zeros(len(limit))
    problem = Problem(question.scaled(case.stand, at), none, -limit, limit, none.astype(bool))
    free = float(np.min(limit, initial=np.inf)) > 1e30
    # of a damped answer, whose scale the weak directions do not raise, the solver regularises them
    is_weak = question.damping[1] > 0.0 and has_weak(kept_values(case, problem.scaled), regular)
    words = "|".join(sorted(set(status_bits(status)) - {"LIMITED", "UNREACHABLE"}))

    def equation(stand: Stand, _: State, near: Pieces) -> Values:
        return answer_of(case, question, stand, near, None if free else x)

    measured = rows.compare(
        where, question.state, equation, {**answer, "status": words}, "" if free else ", with limits",
        least_squares=True, weak=("phi_ddot",) if is_weak else (),
    )  # fmt: skip
    judge_conditions(case, rows, question, problem, x, answer, status, 0.0, regular, measured)
    _judge_hardest(rows, question, answer)
    if question.state.task:
        _judge_by_points(case, rows, question, answer)


def answer_of(case: Case, question: Question, stand: Stand, at: Pieces, phi_ddot: Array | None) -> Values:
    """The literal answer to a question; of an answer `phi_ddot` what it brings about.

    status  bits joined by |, in the order of their names, but for LIMITED and UNREACHABLE
    """
    scaled, (near, damping) = question.scaled(stand, at), question.damping
    sigma = np.asarray(np.linalg.svd(scaled.W, compute_uv=False), dtype=np.float64)
    rank, values = len(kept_values(case, scaled)), cast(Values, {})
    if phi_ddot is None:
        phi_ddot = weighted_solution(scaled, question.weight, rank, near, damping)
        values = {"phi_ddot": phi_ddot, "limited": np.zeros(len(phi_ddot), dtype=np.int64)}
    V_dot = forward(at, phi_ddot)
    if question.state.task:
        left = np.zeros(len(question.state.demand))
        rows = question.rows(stand, at)
        left[slice(None) if question.use is None else question.use] = question.wanted - rows.acceleration(V_dot)
        padded = np.zeros(min(len(left), len(phi_ddot)))
        padded[: len(sigma)] = sigma
        values |= {"V_dot": V_dot, "residual": left, "sigma": padded}
    else:
        values |= {"residual": scaled.c - scaled.A @ phi_ddot, "sigma": sigma}
    shares = shares_of(with_motors(stand, question.options), at, torque(at, V_dot, phi_ddot), phi_ddot)
    is_near = bool(rank and np.any(sigma[:rank] < near * sigma[0]))
    bits = {
        "DAMPED": is_near and damping > 0,
        "EXCESSIVE": bool(np.any(shares > 1.0)),
        "NEAR_SINGULAR": is_near,
        "RANK_DEFICIENT": rank < min(len(scaled.r), len(phi_ddot)),
    }
    damped_by = largest_damping(scaled, rank, near, damping) if damping else 0.0
    return values | {"rank": rank, "damped_by": damped_by, "status": "|".join(bit for bit in bits if bits[bit])}


_CURVE = ("motor_curve_speed", "motor_curve_torque")


def with_motors(stand: Stand, options: Mapping[str, Any]) -> Stand:
    """The stand with what the options say that each flywheel has."""
    wheels = []
    for k, wheel in enumerate(stand.flywheels):
        most, speed = (float(options[key][k]) for key in ("motor_torque", "motor_speed"))
        bearing = [float(options[f"motor_{key}"][k]) for key in ("viscous", "coulomb", "coulomb_speed")]
        limits = (most if most < 1e30 else None, speed if speed < 1e30 else None)
        curve = tuple(zip(*(options[key][k] for key in _CURVE), strict=True)) if _CURVE[0] in options else ()
        curve = curve if any(most < 1e30 for _, most in curve) else ()
        motor = Motor(*limits, None, None, None, bearing[0], bearing[1], bearing[2], curve)
        wheels.append(replace(wheel, motor=motor if motor.is_limited else None))
    return replace(stand, flywheels=tuple(wheels), inverse_most=float(np.min(options["most"], initial=np.inf)))


def _judge_hardest(rows: Rows, question: Question, answer: Mapping[str, Any]) -> None:
    """A unit vector u: along the demand out of reach, or the least singular direction, W W^T u = sigma_m^2 u."""
    hardest, rank = vector(answer["hardest"]), int(answer["rank"])
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


def _judge_fast(case: Case, rows: Rows, question: Question, status: int, phi_ddot: Array) -> None:
    """`inverse_fast` refuses by the least pivot; its normal equations hold at any condition number.

    An answer of bad condition solves the equations all the same.
    """

    def refusal(stand: Stand, _: State, at: Pieces) -> Values:
        kept = least_pivot(normal_matrix(question.scaled(stand, at), question.weight, question.damping[1]))
        return {"refusal": int(kept <= THRESHOLDS[case.real].gram_pivot)}

    rows.compare(question.name, question.state, refusal, {"refusal": int(status < 0)})
    if status < 0:
        rows.demand("its status", status_words(status) == "NOT_POSITIVE_DEFINITE", question.name, status_words(status))
        return

    known = question.scaled(case.stand, case.scales.at(question.state))
    gram, to_y = normal_matrix(known, question.weight, question.damping[1]), (known.W / question.weight).T
    z = np.linalg.lstsq(to_y, phi_ddot / known.to_phi_ddot, rcond=None)[0]
    if len(gram) == len(z):
        # directions in which no flywheel acts: damping alone bounds z there
        unseen = np.linalg.svd(to_y)[2][np.linalg.matrix_rank(to_y) :].T
        z += unseen @ np.linalg.lstsq(gram @ unseen, known.r - gram @ z, rcond=None)[0]

    def sides(stand: Stand, _: State, at: Pieces) -> Values:
        """Both are solved one after the other, each to rounding of its own terms: z is kept, whatever W is."""
        scaled = question.scaled(stand, at)
        y = phi_ddot / scaled.to_phi_ddot
        gram = normal_matrix(scaled, question.weight, question.damping[1])
        if scaled.W.shape[1] < len(scaled.r):
            return {"equations": np.stack([gram @ y, scaled.W.T @ scaled.r])}
        return {"equations": np.stack([gram @ z, scaled.r]), "y": np.stack([y, (scaled.W / question.weight).T @ z])}

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
    options: dict[str, Any] = dict(case.backend.arguments(case.states[0][1])["options"])
    no, none = [0.0] * case.count, case.none
    options |= {"weight": case.random(100 + number).uniform(1.0, 10.0, case.count), "limit": none, "most": none}
    options |= {"near_singular": 1e-6, "damping": 0.0, "motor_torque": none, "motor_speed": none}
    if _CURVE[0] in options:
        options[_CURVE[1]] = np.full(np.shape(options[_CURVE[1]]), case.none[0]).tolist()
    options |= {"motor_viscous": no, "motor_coulomb": no, "motor_coulomb_speed": [1.0] * case.count} | more
    return {key: case.nearest_numbers(x).tolist() if isinstance(x, np.ndarray) else x for key, x in options.items()}


def _questions(
    case: Case, fast: bool, number: int, name: str, state: State, ask: Callable[[Question], tuple[int, dict[str, Any]]]
) -> Iterator[Question]:
    """Weights, damping, limits, and rows of a task freed; then options of which one number decides a bit of an answer.

    `ask`: for that answer.
    """

    def question(**more: Any) -> Question:
        return Question(name, state, options_of(case, number, **more), with_turns=bool(number % 2))

    plain, damped = question(), question(**(FAST_DAMPED if fast else DAMPED))
    yield plain
    yield damped
    if state.task:
        rng = case.random(500 + number)
        use = rng.random(len(state.demand)) < 0.6
        use[rng.integers(len(use))] = True
        yield replace(question(**{f"use_{state.task}": [int(x) for x in use]}), use=use)
    if not case.count:
        return
    base, at = damped if fast else plain, case.scales.at(state)
    scaled, N = base.scaled(case.stand, at), case.count
    sigma = kept_values(case, scaled)
    rank = len(sigma)
    if fast and not rank:  # refused, whatever the options
        return
    is_weak = has_weak(sigma, THRESHOLDS[case.real].regular)  # what these flywheels hardly reach is left with limits
    phi_ddot = vector(ask(base)[1]["phi_ddot"])
    largest, edges = float(np.abs(phi_ddot).max()) or 1.0, _motors(case, fast, number, at, phi_ddot)
    for part in () if fast else LIMIT_SHARES:
        yield question(limit=np.full(N, part * largest))
    for part in SIDES[case.real]:
        if np.any(phi_ddot):
            edges[f"EXCESSIVE by `most` at {part:g}"] = part < 1.0, {"most": np.full(N, part * largest)}
        if not fast and not is_weak:
            edges[f"LIMITED at {part:g}"] = part < 1.0 and bool(np.any(phi_ddot)), {"limit": np.full(N, largest * part)}
        if not fast and rank and sigma[-1] < sigma[0]:
            near = min(float(case.nearest_numbers(sigma[-1] / sigma[0] * part)), 1.0)
            due = bool(sigma[-1] < near * sigma[0])
            edges[f"NEAR_SINGULAR at {part:g}"] = due, {"near_singular": near}
            edges[f"DAMPED at {part:g}"] = due, {"near_singular": near, "damping": DAMPED["damping"]}
    for edge, (due, options) in edges.items():
        yield replace(question(**(FAST_DAMPED if fast else {}), **options), edge=edge, due=due)
    if not fast and not is_weak:
        yield from _at_the_edge_of_reach(case, plain, scaled, rank)
    if number < EDGE_STATES:
        yield from _at_the_edge_of_rank(case, fast, plain)


NO_TORQUE = 1e-7
"""Torque over what turns the flywheel along with the carrier; below, it is what rounding leaves of none."""


def _motors(case: Case, fast: bool, number: int, at: Pieces, phi_ddot: Array) -> dict[str, tuple[bool, dict[str, Any]]]:
    """Motors of which one has a little less than an answer needs, and a little more; whether that is EXCESSIVE.

    By torque; with friction; near the speed at which a driving motor has no torque left; by both; and by the curve of
    a motor that has one, made so much lower or higher.
    """
    N, s, rng, result = case.count, number % case.count, case.random(600 + number), {}
    tau = np.diag(at.Theta_ff) * phi_ddot if fast else torque(at, forward(at, phi_ddot), phi_ddot)
    omega = np.linalg.norm(at.V[3:6])
    turning = np.diag(at.Theta_ff) * (np.abs(phi_ddot) + omega * (omega + np.abs(at.phi_dot)))  # N m
    reach = np.abs(at.phi_dot) + 1.0
    friction = {
        "motor_viscous": 0.3 * np.abs(tau) / reach * rng.uniform(0.5, 2.0, N),
        "motor_coulomb": 0.5 * np.abs(tau) * rng.uniform(0.5, 2.0, N),
        "motor_coulomb_speed": reach / rng.uniform(0.2, 5.0, N),  # most near the speed where it has all of its friction
    }
    speed = {"motor_speed": reach * rng.uniform(1.5, 3.0, N)}
    kinds: dict[str, dict[str, Any]] = {"torque": {}, "friction": friction, "speed": speed, "both": friction | speed}
    for kind, motors in kinds.items():
        options = options_of(case, number, motor_torque=np.ones(N), **motors)
        needed = shares_of(with_motors(case.stand, options), at, tau, phi_ddot)  # N m of the motor
        if not needed[s] > NO_TORQUE * turning[s] or not np.isfinite(needed).all():
            continue
        for part in SIDES[case.real]:
            torques = np.where(needed > 0.0, needed * np.where(np.arange(N) == s, part, 2.0), needed[s])
            edge = f"EXCESSIVE of flywheel {s + 1} by {kind} at {part:g}"
            result[edge] = part < 1.0, motors | {"motor_torque": torques}
            if kind == "friction" and _CURVE[0] in options:
                lower = _curve_through(case, at.phi_dot, torques)
                result[edge.replace(kind, "curve")] = part < 1.0, motors | lower
    if at.phi_dot[s] and abs(tau[s]) > NO_TORQUE * turning[s]:
        for part in SIDES[case.real]:  # driving, a motor has no torque beyond its speed, whatever it has at rest
            speeds = np.where(np.arange(N) == s, part * np.abs(at.phi_dot), case.none)
            due = part < 1.0 and bool(tau[s] * at.phi_dot[s] > 0.0)
            result[f"EXCESSIVE of flywheel {s + 1} by speed alone at {part:g}"] = due, {"motor_speed": speeds}
    return result


def _curve_through(case: Case, speed: Array, torque: Array) -> dict[str, Any]:
    """Curves of the motors, nowhere zero, made so much lower or higher that they give a torque (N) at a speed (N)."""
    options = case.backend.arguments(case.states[0][1])["options"]
    speeds, points = (np.array(options[key]) for key in _CURVE)
    points = np.where(points < 1e30, 0.1 + points, 1.0)
    available = np.array([np.interp(*curve) for curve in zip(speed, speeds, points, strict=True)])
    return {_CURVE[1]: points * (torque / available)[:, None]}


def _at_the_edge_of_reach(case: Case, plain: Question, scaled: ScaledDemand, rank: int) -> Iterator[Question]:
    """Demands of which a part just as large as UNREACHABLE takes is out of reach; if none can be, damping does so."""
    U, sigma, _ = np.linalg.svd(scaled.W, full_matrices=False)
    r, reached = scaled.r, case.scales.cuts.reached
    within = U[:, :rank] @ (U[:, :rank].T @ r)
    beyond, reach = r - within, float(np.linalg.norm(within))
    for part in FAR_SIDES:
        edge, due = f"UNREACHABLE at {part:g}", part > 1.0
        if rank < len(r) and reach and np.any(beyond):
            # r = root c: the demand's share of c changes, K S u_dot or that of the task itself
            target = within + part * reached * reach * beyond / np.linalg.norm(beyond)
            change = solve(scaled.root, r - target)
            yield replace(plain, state=_demanding(case, plain.state, change), edge=edge, due=due)
        elif rank == len(r) and sigma[-1] < sigma[0]:
            # damping leaves (lambda / sigma)^2 of the demand in each direction, lambda = damping (sigma_1 - sigma)
            left = np.linalg.norm(((sigma[0] - sigma) / sigma) ** 2 * (U.T @ r))
            damping = np.sqrt(part * reached * np.linalg.norm(r) / left)
            options = options_of(case, 0, weight=plain.weight, near_singular=1.0, damping=float(damping))
            if damping < 1.0:
                yield replace(plain, options=options, edge=edge, due=due)


def _demanding(case: Case, state: State, change: Array) -> State:
    """The state with another demand, so that c of (12), or of the task, is less by `change`."""
    if state.task:
        return replace(state, demand=tuple(case.nearest_numbers(vector(state.demand) + change).tolist()))
    at, held = case.scales.at(state), case.stand.hold is not None
    rates = vector(state.u_dot if held else state.V_dot) + solve(at.S.T @ at.K @ at.S, change)
    V_dot = tuple(case.nearest_numbers(at.S @ rates).tolist())
    return replace(state, V_dot=cast(Vec6, V_dot), u_dot=tuple(rates.tolist()) if held else ())


def _at_the_edge_of_rank(case: Case, fast: bool, plain: Question) -> Iterator[Question]:
    """Stands whose flywheels are so nearly copies of too few of them that RANK_DEFICIENT, or a refusal, is just due.

    The copies are turned a little away from these: the least singular value falls with the angle.
    """
    rows = len(plain.scaled(case.stand, case.scales.at(plain.state)).r)
    rank, threshold, rng = min(case.count, rows) - 1, THRESHOLDS[case.real], case.random(900)
    if rank < 1:
        return
    bit, least = ("NOT_POSITIVE_DEFINITE", threshold.gram_pivot) if fast else ("RANK_DEFICIENT", threshold.rank)
    copies, like = _copies(case.stand, rank)
    state = _moved_alike(plain.state, like)
    turns = [
        {f.name: rng.normal(size=np.shape(getattr(wheel.mounting, f.name))) for f in fields(wheel.mounting)}
        for wheel in copies.flywheels
    ]

    def nearly_alike(part: float) -> Stand:
        wheels = list(copies.flywheels)
        for k in range(rank, case.count):
            mounting = wheels[k].mounting
            near: Any = {name: np.add(getattr(mounting, name), part * turn).tolist() for name, turn in turns[k].items()}
            wheels[k] = replace(wheels[k], mounting=replace(mounting, **near))
        return replace(copies, flywheels=tuple(wheels))

    def decisive(part: float) -> float:
        """Least singular value over the largest, or least pivot."""
        stand = nearly_alike(part)
        scaled = plain.scaled(stand, pieces(stand, state))
        if fast:
            return least_pivot(normal_matrix(scaled, plain.weight, 0.0))
        sigma = np.linalg.svd(scaled.W, compute_uv=False)
        return float(sigma[-1] / sigma[0]) if sigma[0] > 0 else 0.0

    for side in FAR_SIDES:
        low, high = -25.0, 0.0  # decimal exponents of the part
        if not decisive(10.0**low) < side * least < decisive(1.0):
            return
        while high - low > 0.01:
            middle = (low + high) / 2.0
            low, high = (middle, high) if decisive(10.0**middle) < side * least else (low, middle)
        edge = f"{bit} at {side:g}"
        yield replace(plain, state=state, stand=nearly_alike(10.0**high), edge=edge, due=side < 1.0)


# Torques.


def judge_torque_for(case: Case, rows: Rows) -> None:
    """Torques for a task: without bounds a value, within bounds the least error or the largest share of the demand."""
    for number, (name, state) in enumerate(_states(case, rows.function)):
        locked: Flags = np.zeros(case.count, dtype=np.bool_)
        if number % 3 == 2 and case.count > 1:
            locked[case.random(800 + number).integers(case.count)] = True
        arguments = case.backend.arguments(state) | {"locked": [int(x) for x in locked]}
        options = options_of(
            case, number, motor_speed=2.0 * np.abs(state.phi_dot) + 10.0, motor_power=case.none,
            target_speed=case.random(700 + number).uniform(-100.0, 100.0, case.count),
            target_rate=TARGET_RATE if number % 2 else 0.0, avoid_speed=20.0, keep_direction=0,
        )  # fmt: skip
        free = Problem.of_torques(Question(name, state, options, locked=locked), case.stand, case.scales.at(state))
        largest = np.abs(free.solution(np.array(options["weight"]))).max(initial=0.0)
        tight = {"motor_torque": [float(np.float32(TIGHT * float(largest) or 1.0))] * case.count}
        kinds: list[dict[str, Any]] = [{}, tight, tight | {"keep_direction": 1}]
        if _CURVE[0] in options:
            curve = _curve_through(case, np.array(state.phi_dot), np.array(tight["motor_torque"]))[_CURVE[1]]
            kinds.append({_CURVE[1]: case.nearest_numbers(curve).tolist()})
        for more in kinds:
            try:
                status, answer = case.call_with_status(rows.function, {**arguments, "options": options | more})
            except StateError as error:
                rows.check("answer").refuse(error, name)
                continue
            judge_torques(case, rows, name, state, options | more, locked, status, answer)


def motor_bounds(state: State, options: Mapping[str, Any]) -> tuple[Array, Array]:
    """Least and largest torque (N, N m): driving, less with speed and by the power; braking, all that motors have."""
    speed = np.array(state.phi_dot)
    whole, power = np.minimum(np.array(options["motor_torque"]), 1e9), np.array(options["motor_power"])
    if _CURVE[0] in options:
        curves = zip(speed, *(options[key] for key in _CURVE), strict=True)
        whole = np.minimum(whole, [np.interp(at, speeds, torques) for at, speeds, torques in curves])
    driving = whole * np.maximum(0.0, 1.0 - np.abs(speed) / np.array(options["motor_speed"]))
    with np.errstate(divide="ignore", over="ignore"):
        driving = np.where(driving * np.abs(speed) > power, power / np.abs(speed), driving)
    return np.where(speed < 0, -driving, -whole), np.where(speed > 0, driving, whole)


def judge_torques(
    case: Any, rows: Rows, name: str, state: State, options: Mapping[str, Any], locked: Flags, status: int,
    answer: Mapping[str, Any]
) -> None:  # fmt: skip
    """Judge one answer: torques, what they bring about, the status. `case`: with stand, scales, limits and second."""
    question, tau = Question(name, state, options, locked=locked), vector(answer["tau"])
    problem = Problem.of_torques(question, case.stand, case.scales.at(state))
    expected = problem.solution(question.weight)
    sigma = np.linalg.svd(problem.scaled.W, compute_uv=False)
    kept = sigma[sigma > 1e-9 * sigma[0]] if sigma[0] else sigma
    # what regularisation costs along directions that flywheels hardly reach is not given back in full
    is_weak = bool(np.any(kept < WEAK * np.sqrt(THRESHOLDS["double"].bounded) * sigma[0]))
    of_share = bool(options.get("keep_direction"))
    if np.all((expected > problem.least) & (expected < problem.most) | locked) and not is_weak and not of_share:

        def least(stand: Stand, near: State, at: Pieces) -> Values:
            return {"tau": Problem.of_torques(replace(question, state=near), stand, at).solution(question.weight)}

        rows.compare(name, state, least, answer, least_squares=True)
    regular = 0.0 if is_weak or of_share else THRESHOLDS[case.limits.real].bounded
    if of_share:
        _judge_share(case, rows, question, problem, answer, is_weak)

    def equation(stand: Stand, near: State, at: Pieces) -> Values:
        V_dot, phi_ddot = coupled(at, tau, cast(Array, locked))
        left = vector(state.demand) - question.rows(stand, at).acceleration(V_dot)
        return {"V_dot": V_dot, "phi_ddot": phi_ddot, "residual": left}

    measured = rows.compare(name, state, equation, answer)
    judge_conditions(case, rows, question, problem, tau, answer, status, case.limits.value, regular, measured)
    _judge_by_points(case, rows, question, answer)


def _judge_share(
    case: Any, rows: Rows, question: Question, problem: Problem, result: Mapping[str, Any], is_weak: bool
) -> None:
    """The answer is that of its share, and the share the largest t <= 1 with W y = start + t towards within bounds.

    0 where the motors have not even what W y = start takes.
    """
    from scipy.optimize import linprog

    scaled, share = problem.scaled, float(result["share"])
    towards = scaled.root @ vector(question.state.demand)
    start, y = scaled.r - towards, problem.y(vector(result["tau"]))
    if share > 0.0:
        off = scaled.W @ y - start - share * towards
        size = float(np.linalg.norm(start) + np.linalg.norm(towards) + np.linalg.norm(scaled.W) * np.linalg.norm(y))
        rows.check("answer of its share").note(float(np.linalg.norm(off)) / size, question.name)
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
    rows.check("largest share").note(abs(share - largest), question.name, words)


def _judge_by_points(case: Any, rows: Rows, question: Question, answer: Mapping[str, Any]) -> None:
    """The residual by the second derivation's points: the rows of the literal reference have no part in it."""
    state, V_dot, points = question.state, vector(answer["V_dot"]), {}
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
    rows.check("residual, by points of the second", "value").compare(answer["residual"], left, scale, question.name)
