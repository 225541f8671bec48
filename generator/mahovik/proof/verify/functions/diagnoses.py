"""Judge of what `inverse` says beside its answer: status bits, residual, singular values, rank, the hardest wrench."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from mahovik.contract.status import BITS, status_bits
from mahovik.core.stand.state import State
from mahovik.proof.reference.hold import acceleration, free_equations
from mahovik.proof.reference.inverse import ScaledDemand, demand, inverse_root, motor_shares
from mahovik.proof.reference.pieces import Pieces
from mahovik.proof.verify.check import Check
from mahovik.proof.verify.compare import EXCESS_MARGIN
from mahovik.proof.verify.functions.case import Case
from mahovik.proof.verify.scales.magnitudes import Magnitudes
from mahovik.proof.verify.scales.wants import inverse as inverse_scales

NEAR_MARGIN = 1e-3
"""Relative distance of a singular value from `near_singular` below which rounding may decide the status."""

CLEAR = 0.1
"""Accepted error of the direction of the unreachable wrench above which this direction is not compared."""


class Diagnoses:
    """Rows on status and members of the results of `inverse`, over calls with several options.

    The answer itself is taken from the C: residual and status are those that NumPy finds for it.
    """

    def __init__(self, case: Case) -> None:
        self._case = case
        accepted = case.bounds.default
        self.status = Check("inverse", "status, with options", 0.0)
        self.members = Check("inverse", "what else it says, with options", accepted)
        self.hardest = Check("inverse", "hardest", accepted)

    def rows(self) -> list[Check]:
        """The rows with their verdicts."""
        return [self.status, self.members, self.hardest]

    def note(
        self, state: State, options: Mapping[str, Any], status: int, found: Mapping[str, Any], asked: ScaledDemand,
        name: str, *, free: bool = True
    ) -> None:  # fmt: skip
        """Count one good answer; `free`: no limits are among the options."""
        at = self._case.at(state)
        rank = int(found["rank"])
        magnitudes = Magnitudes(self._case.stand, state, at, self._case.bounds.cuts)
        natural = inverse_scales(magnitudes, rank)
        natural["residual"] = natural["residual"] + magnitudes.free.S_I @ np.abs(np.array(found.get("phi_ddot", [])))
        self._note_members(state, options, found, asked, natural, name, free=free)
        self._note_status(state, options, status, found, asked, natural, name)
        self._note_hardest(at, rank, found, asked, name)

    def _note_members(
        self, state: State, options: Mapping[str, Any], found: Mapping[str, Any], asked: ScaledDemand,
        natural: Mapping[str, Any], name: str, *, free: bool
    ) -> None:  # fmt: skip
        """Residual of this answer, singular values; nothing damped without damping, nothing limited without limits."""
        at, row = self._case.at(state), self.members
        phi_ddot = np.array(found.get("phi_ddot", []), dtype=np.float64)
        free_rows = free_equations(at, self._case.stand)
        left = free_rows.S.T @ demand(at, np.array(state.V_dot)) - free_rows.I @ phi_ddot
        row.compare(found["residual"], left, natural["residual"], name)
        if not self._case.count:
            row.compare(found["rank"], 0, None, name)
            return
        sigma = np.linalg.svd(asked.W, compute_uv=False)
        row.compare(found["sigma"], sigma, natural["sigma"], name)
        if not options["damping"]:
            row.compare(found["damped_by"], 0.0, None, name)
        if free:
            row.compare(list(found["limited"]), [0] * self._case.count, None, name)

    def _note_status(
        self, state: State, options: Mapping[str, Any], status: int, found: Mapping[str, Any], asked: ScaledDemand,
        natural: Mapping[str, Any], name: str
    ) -> None:  # fmt: skip
        """Every bit that rounding does not decide."""
        rank, count, bounds = int(found["rank"]), self._case.count, self._case.bounds
        expected: dict[str, bool | None] = dict.fromkeys(BITS, False)
        expected["RANK_DEFICIENT"] = rank < min(len(asked.r), count)
        expected["LIMITED"] = any(found.get("limited", ()))
        sigma = np.linalg.svd(asked.W, compute_uv=False)[:rank]
        if rank:
            ratios, near = sigma / sigma[0], options["near_singular"]
            apart = bounds.of("inverse", "sigma") * natural["sigma"][0] / sigma[0] + NEAR_MARGIN * near
            below: bool | None = bool(np.any(ratios < near))
            if not np.any(ratios < near - apart) and np.any(np.abs(ratios - near) <= apart):
                below = None
            expected["NEAR_SINGULAR"] = below
            expected["DAMPED"] = below if options["damping"] > 0 else False
        at = self._case.at(state)
        free = free_equations(at, self._case.stand)
        root = inverse_root(free.K)
        phi_ddot = np.array(found.get("phi_ddot", []), dtype=np.float64)
        left = float(np.linalg.norm(root @ (free.S.T @ demand(at, np.array(state.V_dot)) - free.I @ phi_ddot)))
        off = float(np.linalg.norm(np.abs(root) @ (bounds.of("inverse", "residual") * natural["residual"])))
        most = bounds.cuts.reached * float(np.linalg.norm(asked.r))
        expected["UNREACHABLE"] = None if abs(left - most) <= off else left > most
        needed = motor_shares(self._case.stand, at, acceleration(at, self._case.stand, phi_ddot), phi_ddot)
        undecided = np.any(np.abs(needed - 1.0) < EXCESS_MARGIN) and not np.any(needed > 1.0 + EXCESS_MARGIN)
        expected["EXCESSIVE"] = None if undecided else bool(np.any(needed > 1.0))
        has = status_bits(status)
        wrong = [bit for bit, wanted in expected.items() if wanted is not None and wanted != (bit in has)]
        words = ", ".join(f"{bit} expected" if expected[bit] else f"{bit} not expected" for bit in wrong)
        self.status.demand(not wrong, name, words)

    def _note_hardest(self, at: Pieces, rank: int, found: Mapping[str, Any], asked: ScaledDemand, name: str) -> None:
        """A unit vector u in the norm of K^-1: along the demand out of reach, or the least singular direction.

        Of the first the scale is the turning of the reached directions by errors of W, condition times those, over the
        part of the demand that is out of reach; of the second the eigenvalue equation W W^T u = sigma_m^2 u is judged,
        m the number of rows, which holds for any u among equal singular values, and whatever the sign.
        """
        K = free_equations(at, self._case.stand).K
        root, row, most = inverse_root(K), self.hardest, len(asked.r)
        u = root @ np.array(found["hardest"], dtype=np.float64)
        U, sigma, _ = np.linalg.svd(asked.W, full_matrices=True)
        # errors of a wrench, a unit in the last place of each number, as lengths in the norm of K^-1
        rounding = float(np.linalg.norm(np.abs(root) @ np.abs(np.array(found["hardest"])))) + float(
            np.linalg.norm(np.abs(root) @ np.sqrt(np.diag(K)))
        )
        row.compare(float(np.linalg.norm(u)), 1.0, rounding, name)
        if rank == most:
            pulled = asked.W @ (asked.W.T @ u) / sigma[0] ** 2
            row.compare(pulled, (sigma[-1] / sigma[0]) ** 2 * u, np.full(most, rounding), name)
            return
        turned = rounding * (sigma[0] / sigma[rank - 1] if rank else 1.0)
        row.compare(U[:, :rank].T @ u, np.zeros(rank), np.full(rank, turned), name)
        beyond = asked.r - U[:, :rank] @ (U[:, :rank].T @ asked.r)
        size, length = float(np.linalg.norm(beyond)), float(np.linalg.norm(asked.r))
        if size > 0 and turned * length / size * row.limit < CLEAR:
            scale = np.full(most, turned * length / size)
            row.compare(u, beyond / size, scale, name)
