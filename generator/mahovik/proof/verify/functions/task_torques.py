"""Judges of torques for tasks: the literal reference without bounds, within them SciPy."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from scipy.optimize import linprog, lsq_linear

from mahovik.contract.functions import task_of
from mahovik.contract.status import BITS, status_bits
from mahovik.core.lower.thresholds import THRESHOLDS
from mahovik.core.stand.state import State
from mahovik.errors import StateError
from mahovik.proof.reference.array import Array
from mahovik.proof.reference.inverse import weighted_solution
from mahovik.proof.reference.motion import coupled_with_locks
from mahovik.proof.reference.tasks import TaskRows, TorqueDemand, torque_demand
from mahovik.proof.verify.check import Check
from mahovik.proof.verify.functions import allocation
from mahovik.proof.verify.functions.case import Case, Setting
from mahovik.proof.verify.functions.tasks import task_residual
from mahovik.proof.verify.scales.magnitudes import Magnitudes
from mahovik.proof.verify.scales.wants import coupled, flywheel_wrenches

TIGHT = 0.6
"""Part of the largest torque of the answer without bounds that motors have where bounds are tried."""

WEAK = 30.0
"""A direction is weak whose singular value, over the first, is below this many roots of the threshold `bounded`."""

RATE = 0.5
"""1/s, rate of approach to wanted speeds where these are tried."""


@dataclass(frozen=True, eq=False)
class TorqueCase:
    """A demand: the state, the rows, the equation in torques, bounds of the torques (N, N m), locked flywheels."""

    state: State
    rows: TaskRows
    demand: TorqueDemand
    least: Array
    most: Array
    locked: Array

    @property
    def bounds(self) -> tuple[Array, Array]:
        """Bounds of y; a locked flywheel has none but 0."""
        low, high = self.demand.from_torque(self.least), self.demand.from_torque(self.most)
        return np.where(self.locked, 0.0, low), np.where(self.locked, 0.0, high)

    def y(self, tau: Array) -> Array:
        """Scaled answer of torques."""
        return np.where(self.locked, 0.0, self.demand.from_torque(tau))

    def error(self, tau: Array) -> float:
        """Error in the norm of the demand."""
        return float(np.linalg.norm(self.demand.r - self.demand.W @ self.y(tau)))


def torque_rows(case: Case, function: str) -> Iterator[Check]:
    """tau without bounds; the motion; within bounds the least error, or the largest share of the demand."""
    double = case.real == "double"
    plain = Check(function, "tau, without bounds", case.bounds.default)
    bounded = Check(function, "residual, within bounds", allocation.EXCESS_LIMIT if double else 1e-3)
    shared = Check(function, "share, in the direction of the demand", 1e-6 if double else 1e-3)
    results = Results(case, function)
    for number, (name, state) in enumerate(case.states):
        asked, rows = allocation.with_demand(case, number, state, task_of(function))
        given = case.backend.arguments(asked)
        try:
            options = _options(case, number, asked)
            locked = _locks(case, number)
            given |= {"locked": [int(each) for each in locked]}
            free = asked_of(case, asked, rows, options, locked)
            status, found = allocation.answer_of(case, given, options, function)
            expected = note_plain(case, plain, free, options, found, name)
            results.note(free, status, found, name)
            torque = TIGHT * float(np.abs(np.where(locked, 0.0, expected)).max(initial=0.0)) or 1.0
            options |= {"motor_torque": [float(np.float32(torque))] * case.count}
            tight = asked_of(case, asked, rows, options, locked)
            status, found = allocation.answer_of(case, given, options, function)
            note_excess(case, bounded, tight, found, name)
            results.note(tight, status, found, name)
            status, found = allocation.answer_of(case, given, options | {"keep_direction": 1}, function)
            _note_share(case, shared, tight, found, name)
            results.note(tight, status, found, name)
        except StateError as error:
            plain.refuse(error, name)
    yield from (plain, bounded, shared)
    yield from results.rows()


def _options(case: Case, number: int, state: State) -> dict[str, Any]:
    """Weights, wanted speeds, motors without limits but of no-load speed twice the speed that the flywheel has."""
    rng = case.random(700 + number)
    options = allocation.options_of(case, number)
    none = float(case.backend.layout.precision.largest)
    speed = case.nearest_numbers(2.0 * np.abs(state.phi_dot) + 10.0)
    return options | {
        "motor_torque": [none] * case.count,
        "motor_speed": list(speed),
        "motor_power": [none] * case.count,
        "target_speed": list(case.nearest_numbers(rng.uniform(-100.0, 100.0, case.count))),
        "target_rate": RATE if number % 2 else 0.0,
        "avoid_speed": 20.0,
        "keep_direction": 0,
    }


def _locks(case: Case, number: int) -> Array:
    """A lock at every third state, where there are flywheels enough."""
    locked: Array = np.zeros(case.count, dtype=np.bool_)
    if number % 3 == 2 and case.count > 1:
        locked[case.random(800 + number).integers(case.count)] = True
    return locked


def preferred_accelerations(state: State, options: Mapping[str, Any]) -> Array:
    """Wanted accelerations (N, rad/s2): rate times what is missing to the wanted speed, which avoids those near 0."""
    wanted = []
    for given, speed in zip(options["target_speed"], state.phi_dot, strict=True):
        target, end = given, options["avoid_speed"]
        if abs(given) < end:
            side = given if given != 0 else speed
            target = -end if side < 0 else end
        wanted.append(options["target_rate"] * (target - speed))
    return np.array(wanted)


def torque_bounds(state: State, options: Mapping[str, Any]) -> tuple[Array, Array]:
    """Least and largest torque (N, N m): driving, less with speed and by the power; braking, all that the motor has."""
    speed = np.array(state.phi_dot)
    whole = np.minimum(np.array(options["motor_torque"]), 1e9)
    driving = whole * np.maximum(0.0, 1.0 - np.abs(speed) / np.array(options["motor_speed"]))
    power = np.array(options["motor_power"])
    with np.errstate(divide="ignore", over="ignore"):
        driving = np.where(driving * np.abs(speed) > power, power / np.abs(speed), driving)
    return np.where(speed < 0, -driving, -whole), np.where(speed > 0, driving, whole)


def asked_of(case: Setting, state: State, rows: TaskRows, options: Mapping[str, Any], locked: Array) -> TorqueCase:
    """The demand of a state as the judges see it, with these options and locks."""
    scaled = torque_demand(
        case.at(state), rows, np.array(state.demand), preferred_accelerations(state, options), locked
    )
    return TorqueCase(state, rows, scaled, *torque_bounds(state, options), locked)


def note_plain(
    case: Setting, row: Check, asked: TorqueCase, options: Mapping[str, Any], found: Mapping[str, Any], name: str
) -> Array:
    """Count an answer that no bound touches; returns the expected one (N, N m)."""
    scaled, weight, at = asked.demand, np.array(options["weight"]), case.at(asked.state)
    rank = int(np.linalg.matrix_rank(scaled.W, rtol=1e-9))
    given = weighted_solution(scaled, weight, rank)
    expected = np.where(asked.locked, 0.0, scaled.preferred + given)
    low, high = asked.bounds
    y = asked.y(expected)
    if np.all(np.logical_or((y > low) & (y < high), asked.locked)) and not _is_weak(case, scaled.W):
        magnitudes = Magnitudes(case.stand, asked.state, at, case.bounds.cuts)
        scale = allocation.scale_of(scaled, weight, rank, given)
        scale = scale + flywheel_wrenches(magnitudes, *coupled_with_locks(at, expected, asked.locked))[:, 3]
        row.compare(found["tau"], expected, np.where(asked.locked, 1.0, scale), name)
    return expected


def _is_weak(case: Setting, W: Array) -> bool:
    """Whether the flywheels hardly reach some direction: what regularisation costs there is not given back in full."""
    sigma = np.linalg.svd(W, compute_uv=False)
    kept = sigma[sigma > 1e-9 * sigma[0]] if sigma[0] else sigma
    return bool(np.any(kept < WEAK * np.sqrt(THRESHOLDS[case.real].bounded) * sigma[0]))


def note_excess(case: Setting, row: Check, asked: TorqueCase, found: Mapping[str, Any], name: str) -> None:
    """Count an answer within bounds: by how much its error exceeds the least, relative to the demand."""
    tau = np.array(found["tau"])
    slack = 8 * case.unit * (asked.most - asked.least)  # rounding of the bounds
    beyond = (tau < asked.least - slack) | (tau > asked.most + slack)
    if np.any(beyond[np.logical_not(asked.locked)]):
        row.note(np.inf, name, "a bound is exceeded")
        return
    low, high = asked.bounds
    free = low < high
    if _is_weak(case, asked.demand.W):
        return
    least = np.linalg.norm(asked.demand.r)
    if np.any(free):
        W = asked.demand.W[:, free]
        rest = asked.demand.r - asked.demand.W[:, ~free] @ low[~free]
        best = lsq_linear(W, rest, (low[free], high[free]), method="bvls", tol=1e-14, max_iter=200)
        least = np.sqrt(2 * best.cost)
    size = float(np.linalg.norm(asked.demand.r))
    row.note(max(asked.error(tau) - float(least), 0.0) / max(size, 1e-290), name)


def _note_share(case: Setting, row: Check, asked: TorqueCase, found: Mapping[str, Any], name: str) -> None:
    """Count a share: the answer against the share, and this against SciPy's linear programme.

    SciPy meets the equations to 1e-7 of their terms, too little to judge shares where a direction is weak.
    """
    scaled, share = asked.demand, float(found["share"])
    towards = scaled.root @ np.array(asked.state.demand)
    start = scaled.r - towards
    low, high = asked.bounds
    size = float(np.linalg.norm(start) + np.linalg.norm(scaled.W) * np.linalg.norm(np.abs(low) + np.abs(high)))
    best = linprog(
        np.r_[np.zeros(len(low)), -1.0],
        A_eq=np.c_[scaled.W, -towards],
        b_eq=start,
        bounds=[*zip(low, high, strict=True), (0, 1)],
    )
    if best.status != 0:
        if not _is_weak(case, scaled.W):
            row.note(share, name, "not even the demand 0 is in reach")
        return
    if not _is_weak(case, scaled.W):
        slack = 1e-7 * size / max(float(np.linalg.norm(towards)), 1e-290)
        row.note(max(abs(share - float(best.x[-1])) - slack, 0.0), name)
    if share > 0.0:
        off = np.linalg.norm(scaled.W @ asked.y(np.array(found["tau"])) - start - share * towards)
        size += float(np.linalg.norm(towards))
        row.note(float(off) / max(size, 1e-290), name, "the answer is not that of the share")


class Results:
    """Rows on what results of the torques, and on the status. The torques are taken from the C."""

    def __init__(self, case: Setting, function: str) -> None:
        self._case = case
        self.motion = Check(function, "V_dot, phi_ddot, residual", case.bounds.default)
        self.points = Check(function, "residual, by points of the second", case.bounds.default)
        self.status = Check(function, "status, limited", 0.0)

    def rows(self) -> list[Check]:
        """The rows with their verdicts."""
        return [self.motion, self.points, self.status]

    def note(self, asked: TorqueCase, status: int, found: Mapping[str, Any], name: str) -> None:
        """Count one good answer."""
        case, at, tau = self._case, self._case.at(asked.state), np.array(found["tau"], dtype=np.float64)
        V_dot, phi_ddot = coupled_with_locks(at, tau, asked.locked)
        driven = replace(asked.state, tau=tuple(tau))
        magnitudes = Magnitudes(case.stand, driven, at, case.bounds.cuts)
        scales = coupled(magnitudes, asked.locked)
        of_V, of_phi = scales["V_dot"], scales["phi_ddot"]
        self.motion.compare(found["V_dot"], V_dot, of_V, name)
        self.motion.compare(found["phi_ddot"], phi_ddot, of_phi, name)
        reached = np.abs(asked.rows.S) @ of_V + np.abs(asked.rows.s) + np.abs(asked.state.demand)
        reached += np.abs(asked.rows.S) @ (np.sum(np.abs(at.V)) ** 2 * np.ones(6))  # omega x v of a point
        self.motion.compare(
            found["residual"], np.array(asked.state.demand) - asked.rows.acceleration(V_dot), reached, name
        )
        by_points, gravity = task_residual(case, asked.state, np.array(found["V_dot"], dtype=np.float64))
        self.points.compare(found["residual"], by_points, reached + gravity, name)
        held = np.array(found["limited"], dtype=bool)
        at_bound = (tau == case.nearest_numbers(asked.least)) | (tau == case.nearest_numbers(asked.most))
        expected: dict[str, bool | None] = dict.fromkeys(BITS, False)
        expected["LIMITED"] = bool(held.any())
        size, off = float(np.linalg.norm(asked.demand.r)), case.bounds.default
        left, most = asked.error(tau), case.bounds.cuts.reached * size
        margin = off * (size + float(np.linalg.norm(asked.demand.W)) * float(np.linalg.norm(asked.y(tau))))
        expected["UNREACHABLE"] = None if abs(left - most) <= 10 * margin else left > most
        has = status_bits(status)
        wrong = [bit for bit, wanted in expected.items() if wanted is not None and wanted != (bit in has)]
        words = ", ".join(f"{bit} expected" if expected[bit] else f"{bit} not expected" for bit in wrong)
        if case.real == "double" and np.any((held & ~at_bound)[np.logical_not(asked.locked)]):
            words, wrong = "limited, but not at a bound", [*wrong, "LIMITED"]
        self.status.demand(not wrong, name, words)
