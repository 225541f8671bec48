"""Many samples under given speeds of all flywheels: the steps of `simulate`, all between two outputs in one call."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mahovik.out.campaign.block import Block
from mahovik.out.campaign.observe import Observer
from mahovik.out.campaign.pose import Array
from mahovik.use.simulate.case import Case, wrap_phases

KEPT = 1 << 24
"""Numbers of rows of all steps that are kept for the next block, at most: 128 MB."""

AHEAD = 256
"""Times of output whose rows are computed at once."""


@dataclass(frozen=True, eq=False)
class Stretch:
    """Steps from one time of output to the next: their length h (s), rows of phases and speeds (count + 1, N),
    accelerations (count, N), wrenches (count, 6 W); then phi'' (N) and the wrench (6 W) at the end.

    `changes`: phi'' at the end is not that of the last step.
    """

    t: float
    h: float
    phi: Array
    phi_dot: Array
    phi_ddot: Array
    wrench: Array
    end_phi_ddot: Array
    end_wrench: Array
    changes: bool


class GivenSpeeds:
    """Runs blocks through a case whose regime gives all speeds. `inputs`: bodies that take a run-time wrench."""

    def __init__(self, case: Case, inputs: tuple[str, ...]) -> None:
        self._case, self._inputs = case, inputs

    def run(self, block: Block, observer: Observer) -> None:
        """Step all samples from their states at t = 0, and show the observer every time of output."""
        case, N = self._case, len(self._case.stand.flywheels)
        most = self._most_steps
        rows: dict[str, NDArray[Any]] = {
            "phi": np.zeros((most + 2, N)), "phi_dot": np.zeros((most + 2, N)), "phi_ddot": np.zeros((most + 1, N)),
            "wrench": np.zeros((most + 1, 6 * len(self._inputs))), "count": np.zeros(1, dtype=np.int32),
            "refused": np.zeros(block.n, dtype=np.int32), "status": np.zeros(block.n, dtype=np.int32),
        }  # fmt: skip
        course, given = block.course(rows), block.given
        given["order"][0] = case.order
        times = case.times
        block.x[13 : 13 + N], block.x[13 + N :] = wrap_phases(case.phi0)[:, None], case.phi_dot0[:, None]
        given["phi_ddot"][:] = case.motion(times[:1])[2][0][:, None]
        given["wrench"][:] = self._wrench(0.0)[:, None]
        observer.take(float(times[0]))
        for stretch in self._stretches_in_memory if self._few else self.stretches(AHEAD):
            count = len(stretch.phi_ddot)
            rows["phi"][: count + 1], rows["phi_dot"][: count + 1] = stretch.phi, stretch.phi_dot
            rows["phi_ddot"][:count], rows["wrench"][:count] = stretch.phi_ddot, stretch.wrench
            rows["count"][0], given["dt"][0] = count, stretch.h
            if course() < 0:
                self._refuse(block, stretch, rows)
            if given["wrench"].size:
                given["wrench"][:] = stretch.end_wrench[:, None]
            if stretch.changes:
                given["phi_ddot"][:] = stretch.end_phi_ddot[:, None]
            observer.take(stretch.t)

    @staticmethod
    def _refuse(block: Block, stretch: Stretch, rows: Mapping[str, NDArray[Any]]) -> None:
        """Note the samples that a step of the stretch refused."""
        begin = stretch.t - len(stretch.phi_ddot) * stretch.h
        block.refuse(rows["status"], lambda j: f"at t = {begin + stretch.h * rows['refused'][j]:.6g} s ", "a step")

    @cached_property
    def _most_steps(self) -> int:
        """Steps between two times of output, at most."""
        return math.ceil(float(np.diff(self._case.times).max(initial=0.0)) / self._case.dt) + 1

    @property
    def _few(self) -> bool:
        case = self._case
        width = 3 * len(case.stand.flywheels) + 6 * len(self._inputs)
        return (case.until / min(case.dt, case.every) + len(case.times)) * width <= KEPT

    @cached_property
    def _stretches_in_memory(self) -> tuple[Stretch, ...]:
        return tuple(self.stretches(AHEAD))

    def stretches(self, ahead: int) -> Iterator[Stretch]:
        """All stretches, `ahead` of them computed at once."""
        times = self._case.times
        for first in range(0, len(times) - 1, ahead):
            yield from self._stretches(times[first : first + ahead + 1])

    def _stretches(self, times: Array) -> Iterator[Stretch]:
        case = self._case
        grids = []
        for begin, end in zip(times[:-1].tolist(), times[1:].tolist(), strict=True):
            count = max(1, math.ceil((end - begin) / case.dt * (1 - 1e-9)))
            grid = begin + (end - begin) / count * np.arange(count + 1, dtype=np.float64)
            grid[-1] = end
            grids.append(grid)
        phi, speeds, _ = case.motion(np.concatenate(grids))
        phases, accelerations = wrap_phases(phi), case.motion(times[1:])[2]
        row = 0
        for grid, at_end in zip(grids, accelerations, strict=True):
            own = slice(row, row + len(grid))
            row += len(grid)
            h = float(grid[1] - grid[0])
            wrench = [self._wrench(float(t) + h / 2) for t in grid[:-1]] if self._inputs else []
            mean = np.diff(speeds[own], axis=0) / h
            yield Stretch(
                float(grid[-1]), h, phases[own], speeds[own], mean,
                np.array(wrench).reshape(len(grid) - 1, -1), at_end, self._wrench(float(grid[-1])),
                not np.array_equal(at_end, mean[-1]),
            )  # fmt: skip

    def _wrench(self, t: float) -> Array:
        """Run-time wrenches (6 W) of the regime."""
        if not self._inputs:
            return np.zeros(0)
        now = self._case.regime.wrench(t)
        return np.concatenate([now.get(body, (0.0,) * 6) for body in self._inputs])
