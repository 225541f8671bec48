"""Many samples under given speeds of all flywheels: the steps of `simulate`, all between two outputs in one call."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mahovik.core.toolchain.block import Block
from mahovik.out.campaign.observe import Observer
from mahovik.out.campaign.pose import Array
from mahovik.use.simulate.case import Case, wrap_phases

KEPT = 1 << 23
"""Numbers of rows of all steps that are kept for the next block, at most: 64 MB, and as many in the order of the C."""

AHEAD = 256
"""Times of output whose rows are computed at once."""


@dataclass(frozen=True, eq=False)
class Stretch:
    """Steps from one time of output to the next: their length h (s), rows of phases and speeds (count + 1, N),
    accelerations (count, N), wrenches (count, 6 W); then phi'' (N) and the wrench (6 W) at the end.
    """

    t: float
    h: float
    phi: Array
    phi_dot: Array
    phi_ddot: Array
    wrench: Array
    end_phi_ddot: Array
    end_wrench: Array


_NONE = np.zeros((0, 0, 0))


def _rows(group: Sequence[Stretch]) -> dict[str, NDArray[Any]]:
    """Numbers of some stretches as the C reads them: see `Block.course`."""
    ends = {"end_phi_ddot": [each.end_phi_ddot for each in group], "end_wrench": [each.end_wrench for each in group]}
    return {
        **{name: np.concatenate([getattr(each, name) for each in group])
           for name in ("phi", "phi_dot", "phi_ddot", "wrench")},
        **{name: np.array(rows) for name, rows in ends.items()},
        "dt": np.array([each.h for each in group]),
        "count": np.array([len(each.phi_ddot) for each in group], dtype=np.int32),
        "stretches": np.array([len(group)], dtype=np.int32),
    }  # fmt: skip


def _step_times(group: Sequence[Stretch]) -> Array:
    """Beginnings of all steps, s."""
    return np.concatenate([each.t - each.h * np.arange(len(each.phi_ddot), 0, -1) for each in group])


def _note_refused(block: Block, status: NDArray[np.int32], times: Array) -> None:
    """Note the samples that a step refused; `times`: of each sample, s."""
    block.refuse(status, lambda j: f"at t = {times[j]:.6g} s ", "a step")


class GivenSpeeds:
    """Runs blocks through a case whose regime gives all speeds. `inputs`: bodies that take a run-time wrench."""

    def __init__(self, case: Case, inputs: tuple[str, ...]) -> None:
        self._case, self._inputs = case, inputs
        self._groups: dict[tuple[int, int], tuple[Sequence[Stretch], Mapping[str, NDArray[Any]]]] = {}

    def run(self, block: Block, observer: Observer) -> None:
        """Step all samples from their states at t = 0, and show the observer every time of output."""
        case, N = self._case, len(self._case.stand.flywheels)
        given, refused = block.given, np.zeros(block.n, dtype=np.int32)
        status = np.zeros(block.n, dtype=np.int32)
        given["order"][0] = case.order
        block.x[13 : 13 + N], block.x[13 + N :] = wrap_phases(case.phi0)[:, None], case.phi_dot0[:, None]
        given["phi_ddot"][:] = case.motion(case.times[:1])[2][0][:, None]
        given["wrench"][:] = self._wrench(0.0)[:, None]
        observer.take(float(case.times[0]))
        first, ahead = 0, iter(() if self._few else self.stretches(AHEAD))
        while True:
            states, V_dot = observer.room() if observer.simple else (_NONE, _NONE)
            group, rows = self._group(first, len(states) if observer.simple else 1, ahead)
            first += len(group)
            if not group:
                return
            rows = {**rows, "states": states, "V_dot": V_dot, "refused": refused, "status": status}
            rows["kept"] = np.array([states.shape[1] if observer.simple else 0], dtype=np.int32)
            if block.course(rows)() < 0:
                _note_refused(block, status, _step_times(group)[refused])
            if observer.simple:
                observer.add_times(np.array([each.t for each in group]))
                continue
            given["wrench"][:] = group[0].end_wrench[:, None]
            given["phi_ddot"][:] = group[0].end_phi_ddot[:, None]
            observer.take(group[0].t)

    def _group(
        self, first: int, count: int, ahead: Iterator[Stretch]
    ) -> tuple[Sequence[Stretch], Mapping[str, NDArray[Any]]]:
        """Stretches from a number on, and what the C reads of them; kept for the next block where they are few."""
        if not self._few:
            group = list(itertools.islice(ahead, count))
            return group, _rows(group) if group else {}
        if (first, count) not in self._groups:
            group = list(self._stretches_in_memory[first : first + count])
            self._groups[first, count] = group, _rows(group) if group else {}
        return self._groups[first, count]

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
            )  # fmt: skip

    def _wrench(self, t: float) -> Array:
        """Run-time wrenches (6 W) of the regime."""
        if not self._inputs:
            return np.zeros(0)
        now = self._case.regime.wrench(t)
        return np.concatenate([now.get(body, (0.0,) * 6) for body in self._inputs])
