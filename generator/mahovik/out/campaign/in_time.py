"""Quantities over a run in time: blocks of samples are stepped by the C, and gathered at the times of output."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any, Protocol

import numpy as np

from mahovik.core.toolchain.block import PER_BLOCK, Block
from mahovik.core.toolchain.compiled import compile_library
from mahovik.errors import CheckError, UsageError
from mahovik.out.api.model import build
from mahovik.out.api.stands import Stand
from mahovik.out.api.tables import Tables
from mahovik.out.arguments import regime_of, state_of
from mahovik.out.campaign.holds import Holds
from mahovik.out.campaign.observe import Chunk, Observer, Stepped, cut_before
from mahovik.out.campaign.over import DT, EVERY, ORDER, OverTable
from mahovik.out.campaign.pose import Array
from mahovik.out.campaign.quantities import Quantity
from mahovik.out.campaign.records import Records
from mahovik.out.campaign.required import Required
from mahovik.out.campaign.signals import ties
from mahovik.out.campaign.start import AtRest, Start
from mahovik.out.campaign.values import Scene, frames_of
from mahovik.out.notices import warn_of_turn
from mahovik.use.simulate.case import HINT, START_KEYS, Case, wrap_phases
from mahovik.use.simulate.course import parts_of

SIZE = 256
"""Samples that are stepped together: their tables and states stay in the cache of the processor."""

STORED = 1 << 26
"""A block keeps at most this many bytes of values until its end."""

MOST_STORED = 1 << 30
"""More than that, of the smallest block, is refused."""


class Course(Protocol):
    """Steps a block through a run."""

    def run(self, block: Block, observer: Observer) -> None:
        """Step all samples from their states at t = 0, and show the observer every time of output."""


class TimeRunner:
    """Computes quantities over a case; see `compute.Runner`."""

    def __init__(
        self,
        stand: Stand,
        times: int,
        quantities: Sequence[Quantity],
        start: Start | AtRest,
        course: Course,
        required: Required | None = None,
    ) -> None:
        """`times`: how many of output; `required`: what the carrier should do. Raises UsageError: too much to keep."""
        self.stand, self._quantities, self._start, self._course = stand, quantities, start, course
        self._times, self._required = times, required
        self._made = compile_library(stand)
        self._needs = frozenset[str]().union(*(q.needs for q in quantities))
        self._size = self._block_size()

    def _block_size(self) -> int:
        """Samples of a block."""
        T, N = self._times, len(self.stand.flywheels)
        sensors = len(self.stand.instruments) + len(self.stand.points)
        stored = sum(
            q.signal.components for q in self._quantities if q.signal and (q.band or q.statistic == "settling")
        )
        if any(q.function for q in self._quantities):
            stored += 19 + 10 * N + 24 * sensors
        each = 8 * T * stored
        if each * PER_BLOCK > MOST_STORED:
            raise UsageError(
                f"{T:,} times of output, all of which are kept for bands, settling and functions, need "
                f"{each * PER_BLOCK / 2**30:.1f} GB; expected a larger `every`"
            )
        return SIZE if not each else max(PER_BLOCK, min(SIZE, STORED // each // PER_BLOCK * PER_BLOCK))

    def values(self, tables: Tables) -> tuple[dict[str, Array], list[str]]:
        """See `compute.Runner`."""
        n = len(tables)
        found = {q.name: np.full(n, np.nan) for q in self._quantities}
        reasons = [""] * n
        laws = tables.laws() if any(q.signal and q.signal.part in ties(self.stand) for q in self._quantities) else {}
        holds = None if self._required is None else Holds.of(self.stand, tables)
        with np.errstate(all="ignore"):
            whole = Block(self.stand, self._made, n, tables.block)
            lost = self._start.begin(whole, tables)
            for first in range(0, n, self._size):
                block = Block(self.stand, self._made, min(self._size, n - first), tables.block, first)
                block.x[:] = whole.x[:, first : first + block.n]
                self._compute(block, laws, holds, found, reasons)
        for j, reason in lost.items():
            reasons[j] = reason
        return found, reasons

    def _compute(
        self, block: Block, laws: Any, holds: Holds | None, found: Mapping[str, Array], reasons: list[str]
    ) -> None:
        """Quantities and reasons of a block, from its states at t = 0."""
        own = slice(block.first, block.first + block.n)
        readings = None
        if self._made.sensors:
            block.call("points")
            readings = block.found["points"].copy()
        begin = block.x.copy()
        required = self._required
        if required is not None and holds is not None:
            required = replace(required, holds=holds.part(own))
        scene = Scene(self.stand, begin, frames_of(self.stand, begin, readings), _part(laws, own), required)
        gathered = {q.name: q.new(block.n) for q in self._quantities if q.signal is not None}
        records = Records(self.stand) if any(q.function for q in self._quantities) else None

        def consume(chunk: Chunk) -> None:
            for q in self._quantities:
                if q.signal is None:
                    continue
                sums, part = gathered[q.name], cut_before(chunk, q.after)
                if len(part.t):
                    sums.add(part.t, q.signal.values(scene, part, sums.turned))
            if records is not None:
                records.add(chunk)

        observer = Observer(block, self._needs, consume)
        self._course.run(block, observer)
        observer.flush()
        for q in self._quantities:
            if q.signal is not None:
                found[q.name][own] = gathered[q.name].result()
        for j in np.flatnonzero(block.status < 0).tolist():
            reasons[block.first + j] = block.reason(j)
        if records is not None:
            for j in range(block.n):
                if not reasons[block.first + j]:
                    reasons[block.first + j] = self._functions(records, j, block.first + j, found)

    def _functions(self, records: Records, j: int, sample: int, found: Mapping[str, Array]) -> str:
        """The numbers of the user's functions for one sample; the first reason, or ""."""
        reason = ""
        arrays = records.sample(j)
        for q in self._quantities:
            if q.function is not None:
                found[q.name][sample], words = q.function.number(arrays)
                reason = reason or words
        return reason


def _part(value: Any, own: slice) -> Any:
    """Numbers of the samples of a block, from those of all."""
    if isinstance(value, Mapping):
        return {key: _part(each, own) for key, each in value.items()}
    if isinstance(value, list):
        return [_part(each, own) for each in value]
    return value[..., own] if isinstance(value, np.ndarray) else value


def regime_runner(stand: Stand, over: OverTable, quantities: Sequence[Quantity], folder: Path) -> TimeRunner:
    """Over a regime, as `simulate` runs it. Raises UsageError and what the files raise."""
    from mahovik.out.notices import warn_of_steps

    assert over.until is not None
    regime = regime_of(_path_or_table(over.regime, folder), stand, over.until)
    needed = set(regime.wrenches) | ({stand.carrier.name} if regime.mixes_speed_and_torque else set())
    lacking = [body.name for body in stand.bodies if body.name in needed and not body.wrench_input]
    run_stand = stand.replace({f"{name}.wrench_input": True for name in lacking}) if lacking else stand
    start = _start(run_stand, over.start, [each.phase or 0.0 for each in regime.flywheels], folder)
    case = Case(run_stand, regime, start.state, over.until, over.every or EVERY, over.dt or DT, over.order or ORDER)
    warn_of_steps(case)
    return TimeRunner(run_stand, len(case.times), quantities, start, course_of(run_stand, case))


def course_of(stand: Stand, case: Case) -> Course:
    """What steps blocks through a case. Raises UsageError: a law is too steep."""
    start, block = case.start, Block(stand, compile_library(stand), 1)
    quaternion = start.quaternion or (1.0, 0.0, 0.0, 0.0)
    block.x[:, 0] = [*start.position, *quaternion, *start.V, *wrap_phases(case.phi0), *case.phi_dot0]
    return Stepped(case, parts_of(case, block))


def _start(stand: Stand, given: Any, phases: list[float], folder: Path) -> Start | AtRest:
    """The state at t = 0: a file's or a table's, or that of rest. Raises UsageError."""
    if given not in (None, "rest"):
        state = state_of(_path_or_table(given, folder), stand, START_KEYS, HINT)
        return Start(with_quaternion(stand, state))
    try:
        own = build(stand).tables({}, 1)
        made = compile_library(stand)
        found = AtRest(stand, phases, Block(stand, made, 1, own.block))
        warn_of_turn(stand, found.nominal)
        return found
    except CheckError as error:
        raise UsageError(f"{error}; give an initial state by `start`") from None


def with_quaternion(stand: Stand, state: Any) -> Any:
    """The state with a quaternion in place of angles, as the C computes it."""
    from dataclasses import replace

    if state.quaternion is not None or state.angles is None:
        return state
    attitude = build(stand).state(angles=state.angles).attitude
    return replace(state, angles=None, quaternion=tuple(attitude.tolist()))


def _path_or_table(given: Any, folder: Path) -> Any:
    """A file's name, as from the folder of the campaign file; a table as it is."""
    return folder / given if isinstance(given, str) else given
