"""Judges of the functions of tasks: the literal reference, with weights, damping and limits, and with rows freed."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mahovik.contract.functions import task_of as task_name_of
from mahovik.contract.status import BITS, status_bits
from mahovik.core.stand.model import COMPONENTS
from mahovik.core.stand.state import State
from mahovik.errors import StateError
from mahovik.proof.reference.array import Array
from mahovik.proof.reference.inverse import ScaledDemand, inverse_root, largest_damping, motor_shares, weighted_solution
from mahovik.proof.reference.motion import bias, forward
from mahovik.proof.reference.tasks import TaskRows, scaled_task, task_of
from mahovik.proof.verify.check import Check
from mahovik.proof.verify.compare import EXCESS_MARGIN
from mahovik.proof.verify.functions import allocation
from mahovik.proof.verify.functions.abilities import excess_rows
from mahovik.proof.verify.functions.case import Case, Setting
from mahovik.proof.verify.scales.magnitudes import Magnitudes

Rows = NDArray[np.bool_]

NEAR_MARGIN = 1e-3
"""Relative distance of a singular value from `near_singular` below which rounding may decide the status."""


def inverse_rows(case: Case, function: str) -> Iterator[Check]:
    """phi_ddot with weights, with rows freed, with damping; limits with the least residual; what is said beside."""
    accepted, task = case.bounds.default, task_name_of(function)
    plain = Check(function, "phi_ddot, with weights", accepted)
    damped = Check(function, "phi_ddot, with damping", accepted)
    damped_by = Check(function, "damped_by", accepted)
    freed = Check(function, "phi_ddot, with rows freed", accepted)
    limited = Check(function, "residual, with limits", allocation.EXCESS_LIMIT if case.real == "double" else 1e-3)
    beside = _Diagnoses(case, function)
    for number, (name, state) in enumerate(case.states):
        asked, rows = allocation.with_demand(case, number, state, task)
        given = case.backend.arguments(asked)
        demand, everything = np.array(asked.demand), np.ones(len(rows.s), dtype=bool)
        scaled = scaled_task(case.at(asked), rows, demand)
        try:
            options = allocation.options_of(case, number)
            status, found = allocation.answer_of(case, given, options, function)
            expected = _note_plain(plain, case, asked, scaled, options, found, name)
            beside.note(asked, rows, everything, options, status, found, scaled, name)
            use = _some_rows(case, number, len(rows.s))
            part = scaled_task(case.at(asked), TaskRows(rows.S[use], rows.s[use]), demand[use])
            with_free = options | {f"use_{task}": [int(each) for each in use]}
            status, found = allocation.answer_of(case, given, with_free, function)
            _note_plain(freed, case, asked, part, options, found, name)
            beside.note(asked, rows, use, options, status, found, part, name)
            options = allocation.options_of(case, number, near_singular=allocation.NEAR, damping=allocation.DAMPING)
            options |= {key: float(np.float32(options[key])) for key in ("near_singular", "damping")}
            status, found = allocation.answer_of(case, given, options, function)
            rank = int(found["rank"])
            answer = weighted_solution(
                scaled, np.array(options["weight"]), rank, options["near_singular"], options["damping"]
            )
            scale = allocation.damped_scale(case, scaled, options, rank, answer)
            damped.compare(found["phi_ddot"], answer, scale, name)
            share = largest_damping(scaled, rank, options["near_singular"], options["damping"])
            damped_by.compare(found["damped_by"], share, np.linalg.norm(scaled.W), name)
            beside.note(asked, rows, everything, options, status, found, scaled, name)
            for fraction in allocation.LIMIT_SHARES:
                options = allocation.options_of(case, number, allocation.limits_of(case, expected, fraction))
                status, found = allocation.answer_of(case, given, options, function)
                allocation.note_limits(limited, case, status, found, options, scaled, name)
                beside.note(asked, rows, everything, options, status, found, scaled, name, free=False)
        except StateError as error:
            plain.refuse(error, name)
    yield from (plain, freed, damped, damped_by, limited)
    yield from beside.rows()
    yield from excess_rows(case, function)


def fast_rows(case: Case, function: str) -> Iterator[Check]:
    """Rows of `inverse_fast`, and one with rows freed."""
    yield from allocation.fast_rows(case, function, partial(_loss, case))
    freed = Check(function, "phi_ddot, with rows freed", case.bounds.default)
    task = task_name_of(function)
    for number, (name, state) in enumerate(case.states):
        asked, rows = allocation.with_demand(case, number, state, task)
        use = _some_rows(case, number, len(rows.s))
        demand = np.array(asked.demand)[use]
        part = scaled_task(case.at(asked), TaskRows(rows.S[use], rows.s[use]), demand)
        options = allocation.options_of(case, number)
        free = options | {f"use_{task}": [int(each) for each in use]}
        status, found = case.backend.call(function, case.backend.arguments(asked) | {"options": free})
        allocation.note_fast(freed, case, part, options, status, found, name, _loss(case, asked, part))
    yield freed
    yield from excess_rows(case, function)


def _some_rows(case: Case, number: int, count: int) -> Rows:
    """Rows that are demanded: some of them, at least one."""
    rng = case.random(500 + number)
    use = rng.random(count) < 0.6
    use[rng.integers(count)] = True
    return use


def _note_plain(
    row: Check, case: Case, state: State, scaled: ScaledDemand, options: Mapping[str, Any],
    found: Mapping[str, Any], name: str
) -> Array:  # fmt: skip
    """Count an answer with weights; returns the expected one."""
    rank, weight = int(found["rank"]), np.array(options["weight"])
    allocation.check_rank(case, scaled, rank)
    expected = weighted_solution(scaled, weight, rank)
    scale = _loss(case, state, scaled) * allocation.scale_of(scaled, weight, rank, expected)
    row.compare(found["phi_ddot"], expected, scale, name)
    return expected


def _loss(case: Case, state: State, scaled: ScaledDemand) -> float:
    """Relative errors of W = Q^T X and r = Q^T x + L^-1 (s - a) in units of rounding.

    They grow by the condition of K^-1/2 S^T with columns of one length, for nearly dependent rows; and where most of
    X = K^-1/2 I Theta_ff^-1/2 and of x = K^-1/2 b does not belong to the task, by what W and r are smaller than these.
    """
    at = case.at(state)
    root, half = inverse_root(at.K), np.linalg.inv(scaled.root)
    whole = np.linalg.norm(root @ at.I / np.sqrt(np.diag(at.Theta_ff)))
    terms = np.linalg.norm(root @ (at.F - bias(at))) + np.linalg.norm(scaled.root @ np.abs(state.demand)[: len(half)])
    condition = float(np.linalg.cond(half / np.linalg.norm(half, axis=1)[:, None]))
    sizes = (whole / np.linalg.norm(scaled.W), terms / np.linalg.norm(scaled.r), 1.0)
    return condition * float(max(size for size in sizes if np.isfinite(size)))


def task_residual(case: Setting, state: State, V_dot: Array) -> tuple[Array, Array]:
    """Demand of the state's task less what a motion V_dot (6) has of it (m), by the second derivation's points; scale.

    The rows of the literal reference have no part in it: neither their S nor their s.
    """
    task, points = task_of(case.stand, state.task), {}
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
    return np.array(state.demand) - reached, np.full(len(reached), np.linalg.norm(gravity))


class _Diagnoses:
    """Rows on the motion that results, the error, the singular values, the status, and the direction hardest to reach.

    The answer phi'' is taken from the C: the motion is that of the reference for it.
    """

    def __init__(self, case: Case, function: str) -> None:
        accepted = case.bounds.default
        self._case = case
        self.motion = Check(function, "V_dot", accepted)
        self.members = Check(function, "residual, sigma, what else it says", accepted)
        self.status = Check(function, "status, with options", 0.0)
        self.hardest = Check(function, "hardest", accepted)
        self.points = Check(function, "residual, by points of the second", accepted)

    def rows(self) -> list[Check]:
        """The rows with their verdicts."""
        return [self.motion, self.members, self.points, self.status, self.hardest]

    def note(
        self, state: State, rows: TaskRows, use: Rows, options: Mapping[str, Any], status: int,
        found: Mapping[str, Any], scaled: ScaledDemand, name: str, *, free: bool = True
    ) -> None:  # fmt: skip
        """Count one good answer; `use`: rows that are demanded; `free`: no limits are among the options."""
        case, at = self._case, self._case.at(state)
        phi_ddot = np.array(found["phi_ddot"], dtype=np.float64)
        V_dot = forward(at, phi_ddot)
        magnitudes = Magnitudes(case.stand, state, at, case.bounds.cuts)
        scale = magnitudes.K_inverse @ (magnitudes.S_bias + magnitudes.S_I @ np.abs(phi_ddot))
        scale = scale + magnitudes.K_inverse @ magnitudes.S_K @ np.abs(V_dot) + magnitudes.stream_rate
        self.motion.compare(found["V_dot"], V_dot, scale, name)
        reached = np.abs(rows.S) @ scale + np.abs(rows.s) + np.abs(state.demand)
        reached += np.abs(rows.S) @ (np.sum(np.abs(at.V)) ** 2 * np.ones(6))  # omega x v of a point
        left = np.where(use, np.array(state.demand) - rows.acceleration(V_dot), 0.0)
        self.members.compare(found["residual"], left, reached, name)
        by_points, gravity = task_residual(case, state, np.array(found["V_dot"], dtype=np.float64))
        self.points.compare(found["residual"], np.where(use, by_points, 0.0), reached + gravity, name)
        rank, sigma = int(found["rank"]), np.asarray(np.linalg.svd(scaled.W, compute_uv=False), dtype=np.float64)
        padded = np.zeros(len(found["sigma"]))
        padded[: len(sigma)] = sigma
        spread = _loss(case, state, scaled) * max(sigma, default=0.0)
        self.members.compare(found["sigma"], padded, np.full(len(padded), spread), name)
        if not options["damping"]:
            self.members.compare(found["damped_by"], 0.0, None, name)
        if free:
            self.members.compare(list(found["limited"]), [0] * case.count, None, name)
        self._note_status(options, status, found, scaled, motor_shares(case.stand, at, V_dot, phi_ddot), sigma, name)
        if rank and len(scaled.r):
            self._note_hardest(found, use, scaled, rank, name)

    def _note_status(
        self, options: Mapping[str, Any], status: int, found: Mapping[str, Any], scaled: ScaledDemand, needed: Array,
        sigma: Array, name: str
    ) -> None:  # fmt: skip
        """Every bit that rounding does not decide."""
        case, rank = self._case, int(found["rank"])
        expected: dict[str, bool | None] = dict.fromkeys(BITS, False)
        expected["RANK_DEFICIENT"] = rank < min(len(scaled.r), case.count)
        expected["LIMITED"] = any(found["limited"])
        if rank:
            ratios, near = sigma[:rank] / sigma[0], options["near_singular"]
            below: bool | None = bool(np.any(ratios < near))
            if np.any(np.abs(ratios - near) <= NEAR_MARGIN * near + 1e3 * case.unit):
                below = None
            expected["NEAR_SINGULAR"] = below
            expected["DAMPED"] = below if options["damping"] > 0 else False
        y = np.linalg.solve(scaled.to_phi_ddot, np.array(found["phi_ddot"]))
        left, asked = float(np.linalg.norm(scaled.r - scaled.W @ y)), float(np.linalg.norm(scaled.r))
        most = case.bounds.cuts.reached * asked
        off = case.bounds.default * (asked + float(np.linalg.norm(scaled.W)) * float(np.linalg.norm(y)))
        expected["UNREACHABLE"] = None if abs(left - most) <= off else left > most
        beyond = bool(np.any(needed > 1.0))
        expected["EXCESSIVE"] = None if np.any(np.abs(needed - 1.0) < EXCESS_MARGIN) else beyond
        has = status_bits(status)
        wrong = [bit for bit, wanted in expected.items() if wanted is not None and wanted != (bit in has)]
        words = ", ".join(f"{bit} expected" if expected[bit] else f"{bit} not expected" for bit in wrong)
        self.status.demand(not wrong, name, words)

    def _note_hardest(self, found: Mapping[str, Any], use: Rows, scaled: ScaledDemand, rank: int, name: str) -> None:
        """A unit vector in the norm of G^-1: along the demand out of reach, or the least singular direction."""
        rows, root = len(scaled.r), scaled.root
        given = np.array(found["hardest"], dtype=np.float64)
        u = root @ given[use]
        rounding = float(np.linalg.norm(np.abs(root) @ np.abs(given[use]))) + float(
            np.linalg.norm(np.abs(root) @ np.sqrt(np.diag(np.linalg.inv(root.T @ root))))
        )
        self.hardest.compare(float(np.linalg.norm(u)), 1.0, rounding, name)
        U, sigma, _ = np.linalg.svd(scaled.W, full_matrices=True)
        if rank == rows:
            pulled = scaled.W @ (scaled.W.T @ u) / sigma[0] ** 2
            self.hardest.compare(pulled, (sigma[-1] / sigma[0]) ** 2 * u, np.full(rows, rounding), name)
        else:
            turned = rounding * sigma[0] / sigma[rank - 1]
            self.hardest.compare(U[:, :rank].T @ u, np.zeros(rank), np.full(rank, turned), name)
