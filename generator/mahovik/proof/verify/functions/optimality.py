"""Judge of functions that choose accelerations or torques: `inverse`, its fast form, `torque_for`, and those of tasks.

Without limits the answer is a value: least error, then least weighted size, with damping, by the literal reference.
With limits, and of normal equations, the answer is taken from the program, and the conditions of a least error are
judged there: flywheels that are free could take away nothing of it, and those at a limit are pressed against it. The
status and all that is said beside an answer are those of the literal equations.
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
from mahovik.proof.reference.hold import acceleration
from mahovik.proof.reference.inverse import (
    ScaledDemand,
    friction,
    largest_damping,
    normal_matrix,
    scaled_demand,
    shares_of,
    weighted_solution,
)
from mahovik.proof.reference.motion import coupled, torque
from mahovik.proof.reference.pieces import Pieces
from mahovik.proof.reference.tasks import TaskRows, TorqueDemand, scaled_task, task_of, task_rows, torque_demand
from mahovik.proof.verify.check import Check
from mahovik.proof.verify.functions.case import Case, Rows

Flags = NDArray[np.bool_]

DEMAND_DEVIATION = {"v": 5.0, "w": 20.0}
"""m/s2, rad/s2: spread of demanded accelerations and angular accelerations."""

NEAR, DAMPING = 0.8984375, 0.296875
"""Options under which some singular value of most stands is damped; numbers of float."""

FAST_DAMPING = 2.0**-4
"""Damping of `inverse_fast`, a part of the norm of W."""

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
class Demand:
    """What is asked of the flywheels: the state (with a task's demand), its rows in use, the options, and a name.

    edge  the bit of the status that a number of the options decides; "" elsewhere
    """

    name: str
    state: State
    options: Mapping[str, Any]
    use: Flags | None = None
    edge: str = ""

    @property
    def weight(self) -> Array:
        """Weights of the flywheels (N)."""
        return np.array(self.options["weight"], dtype=np.float64)

    @property
    def is_bounded(self) -> bool:
        """Whether a limit is among the options."""
        return bool(np.min(self.options["limit"], initial=np.inf) < 1e30)

    def rows(self, stand: Stand, at: Pieces) -> TaskRows:
        """The rows of the task that are in use."""
        rows = task_rows(at, stand, task_of(stand, self.state.task))
        return rows if self.use is None else TaskRows(rows.S[self.use], rows.s[self.use])

    @property
    def wanted(self) -> Array:
        """What the rows in use demand."""
        demand = vector(self.state.demand)
        return demand if self.use is None else demand[self.use]

    def scaled(self, stand: Stand, at: Pieces) -> ScaledDemand:
        """W y = r."""
        if not self.state.task:
            return scaled_demand(at, stand, vector(self.state.V_dot))
        return scaled_task(at, self.rows(stand, at), self.wanted)


def inverse_checks(case: Case, function: str) -> list[Check]:
    """All that `inverse` says, with weights, damping, limits, rows freed, and where one number decides the status."""
    rows = Rows(case.limits, case.scales, function)
    for name, state, given in _states(case, function):
        for demand in _demands(case, function, name, state, given):
            try:
                status, found = case.call_with_status(function, {**given, "options": demand.options})
            except StateError as error:
                rows.check("answer").refuse(error, name)
                continue
            if demand.edge:
                _judge_edge(case, rows, demand, status)
            else:
                _judge_inverse(case, rows, demand, status, dict(found))
    return list(rows.checks.values())


def _judge_edge(case: Case, rows: Rows, demand: Demand, status: int, phi_ddot: Array | None = None) -> None:
    """Judge the bit of the status that a number of the options decides. `phi_ddot`: answer of `inverse_fast`."""
    bit, at = demand.edge.partition(" ")[0], case.scales.at(demand.state)
    expected = answer_of(case, demand, case.stand, at, phi_ddot, limited=False, fast=phi_ddot is not None)
    if bit == "LIMITED":
        expected[f"has {bit}"] = bool(np.any(np.abs(expected["phi_ddot"]) > np.array(demand.options["limit"])))
    right = expected[f"has {bit}"] == (bit in status_bits(status))
    words = f"{bit} {'expected' if expected[f'has {bit}'] else 'not expected'}"
    rows.check(f"{bit} at its bound", 0.0).demand(right, f"{demand.name}, {demand.edge}", words)


def _judge_inverse(case: Case, rows: Rows, demand: Demand, status: int, found: dict[str, Any]) -> None:
    """Judge one answer of `inverse`."""
    found = {"phi_ddot": [], "sigma": [], "limited": []} | found
    phi_ddot, free = vector(found["phi_ddot"]), not demand.is_bounded
    where = demand.name
    held = np.array(found["limited"], dtype=bool)
    if not free:
        _judge_limits(case, rows, demand, phi_ddot, held, where)

    def equation(stand: Stand, _: State, at: Pieces) -> Values:
        return answer_of(case, demand, stand, at, None if free else phi_ddot, bool(held.any()))

    others = {f"has {bit}": bit in status_bits(status) for bit in STATUS_VALUES if STATUS_VALUES[bit] > 0}
    rows.compare(
        where,
        demand.state,
        equation,
        found | others,
        "" if free else ", with limits",
        True,
        _left_by_damping(case, demand),
    )
    scaled = demand.scaled(case.stand, case.scales.at(demand.state))
    error = scaled.r - scaled.W @ (phi_ddot / np.diag(scaled.to_phi_ddot))
    _judge_unreachable(case, rows, where, status, error, scaled.r)
    _judge_hardest(case, rows, demand, found, where)
    if demand.state.task:
        _judge_by_points(case, rows, where, demand.state, found, demand.use)


def _judge_unreachable(case: Any, rows: Rows, where: str, status: int, error: Array, r: Array) -> None:
    """UNREACHABLE by the scaled error of an answer; within a factor of ten of the threshold rounding decides it."""
    left, most = float(np.linalg.norm(error)), case.scales.cuts.reached * float(np.linalg.norm(r))
    if not most / 10.0 < left < 10.0 * most:
        right = (left > most) == ("UNREACHABLE" in status_bits(status))
        rows.check("UNREACHABLE", 0.0).demand(right, where, f"the error is {left:.1e}, of {most:.1e} accepted")


def _left_by_damping(case: Case, demand: Demand) -> dict[str, Array]:
    """What damping leaves of an answer along weak directions: `regular` of it, stretched by the weights."""
    regular, scaled = THRESHOLDS[case.real].regular, demand.scaled(case.stand, case.scales.at(demand.state))
    sigma = np.linalg.svd(scaled.W, compute_uv=False)
    kept = sigma[sigma > case.scales.cuts.rank * sigma[0]] if sigma.size else sigma
    if not demand.options["damping"] or not kept.size or kept[-1] >= 3.0 * np.sqrt(regular) * kept[0]:
        return {}
    near, damping = float(demand.options["near_singular"]), float(demand.options["damping"])
    answer = weighted_solution(scaled, demand.weight, len(kept), near, damping)
    size = float(np.linalg.norm(answer / np.diag(scaled.to_phi_ddot)))
    ratio = float(demand.weight.max() / demand.weight.min())
    return {"phi_ddot": ratio * size * regular / case.limits.value * np.diag(scaled.to_phi_ddot)}


def answer_of(
    case: Case, demand: Demand, stand: Stand, at: Pieces, phi_ddot: Array | None, limited: bool, fast: bool = False
) -> Values:
    """The literal answer to a demand, with the words of its status; of an answer `phi_ddot` what it brings about."""
    options, cuts = demand.options, case.scales.cuts
    scaled = demand.scaled(stand, at)
    sigma = np.asarray(np.linalg.svd(scaled.W, compute_uv=False), dtype=np.float64)
    rank = int(np.sum(sigma > cuts.rank * sigma[0])) if sigma.size else 0
    near, damping = float(options["near_singular"]), float(options["damping"])
    values: Values = {}
    if phi_ddot is None:
        phi_ddot = weighted_solution(scaled, demand.weight, rank, near, damping)
        values = {"phi_ddot": phi_ddot, "limited": np.zeros(len(phi_ddot), dtype=np.int64)}
    V_dot = acceleration(at, stand, phi_ddot)
    if demand.state.task:
        whole = task_rows(at, stand, task_of(stand, demand.state.task))
        left = np.zeros(len(whole.s))
        use = np.full(len(left), True) if demand.use is None else demand.use
        left[use] = demand.wanted - demand.rows(stand, at).acceleration(V_dot)
        padded = np.zeros(min(len(left), len(phi_ddot)))
        padded[: len(sigma)] = sigma
        values |= {"V_dot": V_dot, "residual": left, "sigma": padded}
    else:
        values |= {"residual": scaled.c - scaled.A @ phi_ddot, "sigma": sigma}
    is_near = bool(rank and np.any(sigma[:rank] < near * sigma[0]))
    tau = np.diag(at.Theta_ff) * phi_ddot if fast else torque(at, V_dot, phi_ddot)
    needed = shares_of(with_motors(stand, options), at, tau, phi_ddot)
    return values | {
        "rank": rank,
        "damped_by": largest_damping(scaled, rank, near, damping) if damping else 0.0,
        "has NEAR_SINGULAR": is_near,
        "has DAMPED": is_near and damping > 0,
        "has LIMITED": limited,
        "has RANK_DEFICIENT": rank < min(len(scaled.r), len(phi_ddot)),
        "has EXCESSIVE": bool(np.any(needed > 1.0)),
    }


def with_motors(stand: Stand, options: Mapping[str, Any]) -> Stand:
    """The stand with what the options say that each flywheel has."""
    wheels = []
    for k, wheel in enumerate(stand.flywheels):
        most, speed = (float(options[key][k]) for key in ("motor_torque", "motor_speed"))
        bearing = [float(options[f"motor_{key}"][k]) for key in ("viscous", "coulomb", "coulomb_speed")]
        own = (most if most < 1e30 else None, speed if speed < 1e30 else None)
        wheels.append(replace(wheel, motor=Motor(*own, None, None, None, *bearing) if any(own) else None))
    least = float(np.min(options["most"], initial=np.inf))
    return replace(stand, flywheels=tuple(wheels), inverse_most=least)


def _judge_limits(case: Case, rows: Rows, demand: Demand, phi_ddot: Array, held: Array, where: str) -> None:
    """Limits are kept, and the conditions of the least error hold."""
    limit = np.array(demand.options["limit"])
    kept = bool(np.all(np.abs(phi_ddot) <= limit) and np.all(np.abs(phi_ddot[held]) == limit[held]))
    rows.check("limits kept", 0.0).demand(kept, where, "a limit is exceeded, or a flywheel is held elsewhere")
    scaled = demand.scaled(case.stand, case.scales.at(demand.state))
    y = phi_ddot / np.diag(scaled.to_phi_ddot)
    side = np.where(held, np.sign(y), 0.0)
    off = excess(scaled.W, scaled.r, y, side, THRESHOLDS[case.real].regular)
    rows.check("least error, with limits", case.limits.optimality).note(off, where)


def excess(W: Array, r: Array, y: Array, side: Array, regular: float) -> float:
    """By how much |r - W y| exceeds the least within bounds, at most, over |r|: by the conditions of a least error.

    Flywheels that are free could still take away what of the error lies in the span of their columns; one that is held
    (`side` 1 or -1: at its upper or lower bound) what lies along its own, if that leads away from the bound. Of weak
    directions a regularised solver leaves a part: with `regular` on the diagonal, below a ratio of 3 sqrt(regular) a
    tenth and more.
    """
    error, largest = r - W @ y, float(np.linalg.norm(W, 2))
    U, sigma, _ = np.linalg.svd(W[:, side == 0.0], full_matrices=False)
    taken = U[:, sigma > 3.0 * np.sqrt(regular) * largest].T @ error
    lengths = np.maximum(np.linalg.norm(W, axis=0), 1e-290)
    released = np.maximum(-side * (W.T @ error), 0.0) / lengths
    whole, part = float(error @ error), float(taken @ taken + released @ released)
    return float(part / (np.sqrt(whole) + np.sqrt(max(whole - part, 0.0)) + 1e-290) / max(np.linalg.norm(r), 1e-290))


def _judge_hardest(case: Case, rows: Rows, demand: Demand, found: Mapping[str, Any], where: str) -> None:
    """A unit vector u: along the demand out of reach, or the least singular direction, W W^T u = sigma_m^2 u."""
    hardest, rank = vector(found["hardest"]), int(found["rank"])
    hardest = hardest if demand.use is None else hardest[demand.use]
    if not np.any(hardest):
        return

    def direction(W: Array, u: Array) -> Array:
        U, sigma, _ = np.linalg.svd(W, full_matrices=True)
        if rank == len(u):
            return np.asarray(W @ (W.T @ u) / sigma[0] ** 2 - (sigma[-1] / sigma[0]) ** 2 * u)
        return np.asarray(U[:, :rank] @ (U[:, :rank].T @ u))

    def conditions(stand: Stand, _: State, at: Pieces) -> Values:
        scaled = demand.scaled(stand, at)
        u = scaled.root @ hardest
        return {"length": np.linalg.norm(u), "direction": direction(scaled.W, u)}

    measured, check = case.scales.measure(demand.state, conditions, least_squares=True), rows.check("hardest")
    check.compare(measured.values["length"], 1.0, measured.scales["length"], where)
    scale = np.max(measured.scales["direction"]) + np.ones(len(hardest))
    check.compare(measured.values["direction"], np.zeros(len(hardest)), scale, where)


def _states(case: Case, function: str) -> Iterator[tuple[str, State, dict[str, Any]]]:
    """The states, with a random demand of a task, and the arguments of the program."""
    task = task_name_of(function)
    for number, (name, drawn_state) in enumerate(case.states):
        state = drawn_state
        if task:
            sizes = [DEMAND_DEVIATION[row.component[0]] for row in task_of(case.stand, task).rows]
            drawn = case.nearest_numbers(case.random(300 + number).normal(size=len(sizes)) * sizes)
            state = replace(state, task=task, demand=tuple(drawn.tolist()))
        yield name, state, case.backend.arguments(state)


def options_of(case: Case, number: int, **more: Any) -> dict[str, Any]:
    """Weights from 1 to 10, motors without limits or friction, and what else is asked."""
    weight = case.nearest_numbers(case.random(100 + number).uniform(1.0, 10.0, case.count)).tolist()
    given: dict[str, Any] = dict(case.backend.arguments(case.states[0][1])["options"])
    no, none = [0.0] * case.count, case.none
    given |= {"weight": weight, "limit": none, "near_singular": 1e-6, "damping": 0.0, "most": none}
    given |= {"motor_torque": none, "motor_speed": none, "motor_viscous": no, "motor_coulomb": no}
    return given | {"motor_coulomb_speed": [1.0] * case.count} | more


def _demands(case: Case, function: str, name: str, state: State, given: Mapping[str, Any]) -> Iterator[Demand]:
    """Options for one state: ordinary ones, and those at which a single number decides a bit of the status."""
    number = [each for each, _ in case.states].index(name)
    at, rng = case.scales.at(state), case.random(500 + number)
    yield Demand(name, state, options_of(case, number))
    if not case.count:
        return
    yield Demand(name, state, options_of(case, number, near_singular=NEAR, damping=DAMPING))
    if state.task:
        use = rng.random(len(state.demand)) < 0.6
        use[rng.integers(len(use))] = True
        freed = {f"use_{state.task}": [int(each) for each in use]}
        yield Demand(name, state, options_of(case, number) | freed, use)
    plain = Demand(name, state, options_of(case, number))
    answer = answer_of(case, plain, case.stand, at, None, limited=False)
    largest = float(np.abs(answer["phi_ddot"]).max()) or 1.0
    for part in LIMIT_SHARES:
        limit = case.nearest_numbers(np.full(case.count, part * largest)).tolist()
        yield Demand(name, state, options_of(case, number, limit=limit))
    sigma, rank = answer["sigma"], answer["rank"]
    for sign in (-1.0, 1.0):
        if rank and sigma[rank - 1] < sigma[0]:
            near = float(case.nearest_numbers(sigma[rank - 1] / sigma[0] * (1.0 + sign * EDGE)))
            yield Demand(name, state, options_of(case, number, near_singular=min(near, 1.0)), edge="NEAR_SINGULAR")
        limit = case.nearest_numbers(np.full(case.count, largest * (1.0 + sign * EDGE))).tolist()
        yield Demand(name, state, options_of(case, number, limit=limit), edge="LIMITED")
    for edge, options in _motors(case, number, at, answer["phi_ddot"], rng):
        yield Demand(name, state, options_of(case, number, **options), edge=edge)


def _motors(
    case: Case, number: int, at: Pieces, phi_ddot: Array, rng: np.random.Generator, fast: bool = False
) -> Iterator[tuple[str, dict[str, Any]]]:
    """Motors of which one has a little less than an answer needs by one bound alone, and a little more.

    By torque; by the speed at which a driving motor has no torque left; by dry and viscous friction; without motors by
    `most`.
    """
    if not np.any(phi_ddot):
        return
    tau = np.diag(at.Theta_ff) * phi_ddot if fast else torque(at, acceleration(at, case.stand, phi_ddot), phi_ddot)
    speed, s = at.phi_dot, number % case.count
    for sign in (-1.0, 1.0):
        part = np.full(case.count, 2.0)
        part[s] = 1.0 - sign * EDGE
        words = f"EXCESSIVE of flywheel {s + 1}"
        ample = np.abs(tau).max() * 4.0 + 1e-9 * np.diag(at.Theta_ff).max()
        enough = np.where(np.arange(case.count) == s, np.abs(tau) * part, ample)
        if tau[s]:
            yield f"{words} by torque", {"motor_torque": case.nearest_numbers(enough).tolist()}
        own = dict.fromkeys(("motor_viscous", "motor_coulomb"), np.zeros(case.count))
        own["motor_coulomb_speed"] = np.ones(case.count)
        own["motor_viscous"][s] = 0.3 * abs(tau[s]) / (abs(speed[s]) + 1.0) * rng.uniform(0.5, 2.0)
        own |= {"motor_coulomb": np.zeros(case.count)}
        own["motor_coulomb"][s] = 0.5 * abs(tau[s]) * rng.uniform(0.5, 2.0)
        own["motor_coulomb_speed"][s] = (abs(speed[s]) + 1.0) * rng.uniform(0.2, 5.0)
        own = {key: case.nearest_numbers(value) for key, value in own.items()}
        bearing = Motor(None, None, None, None, None, *(float(value[s]) for value in own.values()))
        needed = float(tau[s]) - friction(bearing, float(speed[s]))
        enough[s] = abs(needed) * part[s]
        if needed:
            torques = {"motor_torque": case.nearest_numbers(enough).tolist()}
            yield f"{words} by friction", torques | {key: value.tolist() for key, value in own.items()}
        if tau[s] * speed[s] > 0:
            # with twice the torque at rest, half of the no-load speed is where it has just enough
            enough[s], no_load = 2.0 * abs(tau[s]), np.array(case.none)
            no_load[s] = 2.0 * abs(speed[s]) * (1.0 - sign * EDGE)
            options = {"motor_torque": enough, "motor_speed": no_load}
            yield f"{words} by speed", {key: case.nearest_numbers(value).tolist() for key, value in options.items()}
        most = case.nearest_numbers(np.full(case.count, np.abs(phi_ddot).max() * (1.0 - sign * EDGE)))
        yield "EXCESSIVE by `most`", {"most": most.tolist()}


def fast_checks(case: Case, function: str) -> list[Check]:
    """The normal equations of `inverse_fast` hold, without and with damping; refusals; EXCESSIVE at its edges.

    The conditions are judged at any condition number: an answer of bad condition solves the equations all the same.
    """
    rows = Rows(case.limits, case.scales, function)
    for number, (name, state, given) in enumerate(_states(case, function)):
        options = [("", options_of(case, number)), ("", options_of(case, number, damping=FAST_DAMPING))]
        for edge, chosen in options:
            answer = _judge_fast(case, rows, function, Demand(name, state, chosen, edge=edge), given)
        if answer is None:
            continue
        at, plain = case.scales.at(state), options_of(case, number, damping=FAST_DAMPING)
        for edge, motors in _motors(case, number, at, answer, case.random(700 + number), fast=True):
            _judge_fast(case, rows, function, Demand(name, state, plain | motors, edge=edge), given)
        if state.task:
            use = case.random(600 + number).random(len(state.demand)) < 0.6
            use[number % len(use)] = True
            freed = {f"use_{state.task}": [int(each) for each in use]}
            _judge_fast(case, rows, function, Demand(name, state, options_of(case, number) | freed, use), given)
    return list(rows.checks.values())


def _judge_fast(case: Case, rows: Rows, function: str, demand: Demand, given: Mapping[str, Any]) -> Array | None:
    """Judge one answer of `inverse_fast`; None where it refuses."""
    where = f"{demand.name}, {demand.edge}" if demand.edge else demand.name
    status, outputs = case.backend.call(function, {**given, "options": demand.options})
    weight, damping = demand.weight, float(demand.options["damping"])
    scaled = demand.scaled(case.stand, case.scales.at(demand.state))
    allowed = _allowed_refusal(case, normal_matrix(scaled, weight, damping))
    words = f"status {status_words(status)}"
    rows.check("refusal", 0.0).demand((status < 0) in allowed and status in (
        STATUS_VALUES["OK"], STATUS_VALUES["EXCESSIVE"], STATUS_VALUES["NOT_POSITIVE_DEFINITE"]
    ), where, words)  # fmt: skip
    if status < 0:
        return None
    phi_ddot = vector(outputs.get("out", outputs)["phi_ddot"])
    if demand.edge:
        _judge_edge(case, rows, demand, status, phi_ddot)
        return phi_ddot

    def conditions(stand: Stand, _: State, at: Pieces) -> Values:
        found = demand.scaled(stand, at)
        y, gram = phi_ddot / np.diag(found.to_phi_ddot), normal_matrix(found, weight, damping)
        if found.W.shape[1] < len(found.r):
            return {"equations": gram @ y, "right": found.W.T @ found.r}
        back = (found.W / weight).T
        z = np.linalg.lstsq(back, y, rcond=None)[0]
        return {"equations": gram @ z, "right": found.r, "y": y, "back": back @ z}

    with np.errstate(all="ignore"):
        measured = case.scales.measure(demand.state, conditions, least_squares=True)
    for left, right in (("equations", "right"), ("y", "back")):
        if left in measured.values:
            scale = np.maximum(measured.scales[left], measured.scales[right])
            largest = np.full(scale.shape, float(np.max(scale, initial=0.0)))
            rows.check("normal equations").compare(measured.values[left], measured.values[right], largest, where)
    return phi_ddot


def _allowed_refusal(case: Case, gram: Array) -> set[bool]:
    """Whether `inverse_fast` may, or may not, refuse: by the least part that a pivot of Cholesky keeps of its diagonal.

    Within a factor of ten of the threshold both are right.
    """
    kept = 1.0
    for j in range(len(gram)):
        before = gram[:j, j]
        left = gram[j, j] - (before @ np.linalg.lstsq(gram[:j, :j], before, rcond=None)[0] if j else 0.0)
        kept = min(kept, float(left / gram[j, j])) if gram[j, j] > 0 else 0.0
        if not kept:
            break
    least = THRESHOLDS[case.real].gram_pivot
    return {refused for refused, right in ((False, kept > least / 10), (True, kept < 10 * least)) if right}


@dataclass(frozen=True)
class TorqueBounds:
    """Bounds of the torques for a task (N, N m), the equation W y = r and the rows; `locked` flywheels have none."""

    demand: TorqueDemand
    rows: TaskRows
    least: Array
    most: Array
    locked: Flags

    def y(self, tau: Array) -> Array:
        """Scaled answer of torques."""
        return np.where(self.locked, 0.0, self.demand.from_torque(tau))

    @property
    def is_weak(self) -> bool:
        """Whether flywheels hardly reach some direction: what regularisation costs there is not given back in full."""
        sigma = np.linalg.svd(self.demand.W, compute_uv=False)
        kept = sigma[sigma > 1e-9 * sigma[0]] if sigma[0] else sigma
        return bool(np.any(kept < WEAK * np.sqrt(THRESHOLDS["double"].bounded) * sigma[0]))


def torque_checks(case: Case, function: str) -> list[Check]:
    """Torques for a task: without bounds a value, within bounds the least error or the largest share of the demand."""
    rows = Rows(case.limits, case.scales, function)
    for number, (name, state, given) in enumerate(_states(case, function)):
        locked: Flags = np.zeros(case.count, dtype=np.bool_)
        if number % 3 == 2 and case.count > 1:
            locked[case.random(800 + number).integers(case.count)] = True
        given |= {"locked": [int(each) for each in locked]}
        options = _torque_options(case, number, state)
        free = torque_bounds(case.stand, state, case.scales.at(state), options, locked)
        torques = np.abs(np.where(locked, 0.0, _least_torque(free, options)))
        tight = {"motor_torque": [float(np.float32(TIGHT * float(torques.max(initial=0.0)) or 1.0))] * case.count}
        for more in ({}, tight, tight | {"keep_direction": 1}):
            try:
                status, found = case.call_with_status(function, {**given, "options": options | more})
            except StateError as error:
                rows.check("answer").refuse(error, name)
                continue
            judge_torques(case, rows, name, state, options | more, locked, status, found)
    return list(rows.checks.values())


def _torque_options(case: Case, number: int, state: State) -> dict[str, Any]:
    """Weights, wanted speeds, motors without limits but of no-load speed twice the speed that the flywheel has."""
    speed = case.nearest_numbers(2.0 * np.abs(state.phi_dot) + 10.0).tolist()
    target = case.nearest_numbers(case.random(700 + number).uniform(-100.0, 100.0, case.count)).tolist()
    return options_of(case, number) | {
        "motor_speed": speed, "motor_power": case.none, "target_speed": target,
        "target_rate": TARGET_RATE if number % 2 else 0.0, "avoid_speed": 20.0, "keep_direction": 0,
    }  # fmt: skip


def torque_bounds(stand: Stand, state: State, at: Pieces, options: Mapping[str, Any], locked: Flags) -> TorqueBounds:
    """The equation of a task in torques, which avoids wanted speeds near zero, and what the motors have."""
    wanted = []
    for given, speed in zip(options["target_speed"], state.phi_dot, strict=True):
        target, end = given, options["avoid_speed"]
        if abs(given) < end:
            target = -end if (given if given != 0 else speed) < 0 else end
        wanted.append(options["target_rate"] * (target - speed))
    rows = task_rows(at, stand, task_of(stand, state.task))
    demand = torque_demand(at, rows, vector(state.demand), np.array(wanted), cast(Array, locked))
    return TorqueBounds(demand, rows, *motor_bounds(state, options), locked)


def motor_bounds(state: State, options: Mapping[str, Any]) -> tuple[Array, Array]:
    """Least and largest torque (N, N m): driving, less with speed and by the power; braking, all that motors have."""
    speed = np.array(state.phi_dot)
    whole, power = np.minimum(np.array(options["motor_torque"]), 1e9), np.array(options["motor_power"])
    driving = whole * np.maximum(0.0, 1.0 - np.abs(speed) / np.array(options["motor_speed"]))
    with np.errstate(divide="ignore", over="ignore"):
        driving = np.where(driving * np.abs(speed) > power, power / np.abs(speed), driving)
    return np.where(speed < 0, -driving, -whole), np.where(speed > 0, driving, whole)


def _least_torque(asked: TorqueBounds, options: Mapping[str, Any]) -> Array:
    """tau (N, N m) without bounds: least error, then least weighted torque beyond that of the wanted accelerations."""
    scaled, weight = asked.demand, np.array(options["weight"], dtype=np.float64)
    rank = int(np.linalg.matrix_rank(scaled.W, rtol=1e-9))
    return np.where(asked.locked, 0.0, scaled.preferred + weighted_solution(scaled, weight, rank))


def judge_torques(
    case: Any, rows: Rows, name: str, state: State, options: Mapping[str, Any], locked: Flags, status: int,
    found: Mapping[str, Any]
) -> None:  # fmt: skip
    """Judge one answer: torques, what they bring about, the status. `case`: with stand, scales, limits and second."""
    tau, asked = vector(found["tau"]), torque_bounds(case.stand, state, case.scales.at(state), options, locked)
    expected, free = _least_torque(asked, options), np.logical_not(locked)
    inside = np.all((expected > asked.least) & (expected < asked.most) | locked)
    if inside and not asked.is_weak and not options.get("keep_direction"):

        def least(stand: Stand, near: State, at: Pieces) -> Values:
            return {"tau": _least_torque(torque_bounds(stand, near, at, options, locked), options)}

        rows.compare(name, state, least, found, least_squares=True)
    slack = 4.0 * rows.check("tau").limit * np.maximum(np.abs(asked.least), np.abs(asked.most))
    high, low = free & (tau >= asked.most - slack), free & (tau <= asked.least + slack)
    kept = bool(np.all(((tau <= asked.most + slack) & (tau >= asked.least - slack))[free]))
    rows.check("bounds kept", 0.0).demand(kept, name, "a bound is exceeded")
    W, r, y = np.where(locked, 0.0, asked.demand.W), asked.demand.r, asked.y(tau)
    side = np.where(high & ~low, 1.0, 0.0) - np.where(low & ~high, 1.0, 0.0)
    if options.get("keep_direction"):
        _judge_share(case, rows, name, state, asked, found, np.where(high & low, np.nan, side))
    elif not asked.is_weak:
        pinned = high & low
        off = excess(np.where(pinned, 0.0, W), r, y, side, THRESHOLDS[case.limits.real].bounded)
        rows.check("least error, within bounds", case.limits.optimality).note(off, name)

    def equation(stand: Stand, near: State, at: Pieces) -> Values:
        V_dot, phi_ddot = coupled(at, tau, cast(Array, locked))
        own = torque_bounds(stand, near, at, options, locked)
        return {"V_dot": V_dot, "phi_ddot": phi_ddot, "residual": vector(state.demand) - own.rows.acceleration(V_dot)}

    rows.compare(name, state, equation, found)
    bits, has_limits = status_bits(status), bool(np.any(vector(found["limited"])))
    rows.check("LIMITED", 0.0).demand(has_limits == ("LIMITED" in bits), name, "not as `limited` says")
    _judge_unreachable(case, rows, name, status, r - W @ y, r)
    limited = np.array(found["limited"], dtype=bool)
    rows.check("limited", 0.0).demand(bool(np.all((high | low)[limited & free])), name, "limited, but not at a bound")
    _judge_by_points(case, rows, name, state, found)


def _judge_share(
    case: Any, rows: Rows, name: str, state: State, asked: TorqueBounds, found: Mapping[str, Any], side: Array
) -> None:
    """The answer is that of its share, and no larger share is in reach: multipliers of its linear programme exist.

    Of the largest t with W y = start + t towards: z with towards z = 1, and W^T z = 0 along what is free, of the sign
    that presses against its bound elsewhere. `side` (N): 1, -1: at the upper, lower bound; nan: between equal bounds.
    """
    from scipy.optimize import nnls

    scaled, share = asked.demand, float(found["share"])
    towards = scaled.root @ vector(state.demand)
    start, y = scaled.r - towards, asked.y(vector(found["tau"]))
    if share > 0.0:
        off = scaled.W @ y - start - share * towards
        size = float(np.linalg.norm(start) + np.linalg.norm(towards) + np.linalg.norm(scaled.W) * np.linalg.norm(y))
        rows.check("answer of its share", case.limits.optimality).note(float(np.linalg.norm(off)) / size, name)
    if not 0.0 < share < 1.0 or asked.is_weak:
        return
    columns = scaled.W.T / np.maximum(np.linalg.norm(scaled.W, axis=0), 1e-290)[:, None]
    keep = ~asked.locked & ~np.isnan(side)
    held = np.flatnonzero((side != 0.0) & keep)
    slacks = np.zeros((len(columns), len(held)))
    slacks[held, np.arange(len(held))] = -side[held]
    system = np.vstack([
        np.hstack([columns, -columns, slacks])[keep],
        np.concatenate([towards, -towards, np.zeros(len(held))]) / np.linalg.norm(towards),
    ])  # fmt: skip
    _, left = nnls(system, np.concatenate([np.zeros(int(keep.sum())), [1.0]]))
    rows.check("largest share", case.limits.optimality).note(float(left), name)


def _judge_by_points(
    case: Any, rows: Rows, name: str, state: State, found: Mapping[str, Any], use: Flags | None = None
) -> None:
    """The residual by the second derivation's points: the rows of the literal reference have no part in it."""
    V_dot, points = vector(found["V_dot"]), {}
    task = task_of(case.stand, state.task)
    if any(row.of for row in task.rows):
        moving = replace(state, task="", demand=(), V_dot=tuple(V_dot))
        points = case.second.evaluate(moving, ("points",))["points"]
    gravity, reached = np.array(case.stand.gravity), []
    for row in task.rows:
        k = COMPONENTS.index(row.component)
        if not row.of:
            reached.append(V_dot[k])
        elif k < 3:
            point = points[row.of]
            reached.append((point["specific_force"] + point["C"].T @ gravity)[k])
        else:
            reached.append(points[row.of]["angular_acceleration"][k - 3])
    speeds = np.sum(np.abs(state.V)) ** 2 + np.linalg.norm(gravity) + np.max(np.abs(V_dot))
    scale = np.abs(vector(state.demand)) + np.abs(reached) + speeds
    left = vector(state.demand) - np.array(reached)
    left = left if use is None else np.where(use, left, 0.0)
    rows.check("residual, by points of the second").compare(found["residual"], left, scale, name)
