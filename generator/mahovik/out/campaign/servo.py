"""Quantities over a programme that servos follow on each sample, as `follow` does on one stand."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from mahovik.core.stand.model import Stand as CoreStand
from mahovik.core.toolchain.block import PER_BLOCK, Block
from mahovik.core.toolchain.compiled import compile_library
from mahovik.errors import MahovikError
from mahovik.out.api.stands import Stand
from mahovik.out.api.tables import Tables
from mahovik.out.campaign.observe import Chunk, cut_before
from mahovik.out.campaign.over import OverTable
from mahovik.out.campaign.pose import Array
from mahovik.out.campaign.quantities import Quantity
from mahovik.out.campaign.signals import sensors
from mahovik.out.campaign.values import Frame, Scene
from mahovik.out.commands.simulate import following_case
from mahovik.use.control.errors import Errors, errors_of
from mahovik.use.control.loop import TABLE, Record, close_loop
from mahovik.use.control.plant import SteppedPlant
from mahovik.use.study.linear.model import places


class ServoRunner:
    """Computes quantities of the closed loop, sample by sample; see `compute.Runner`."""

    def __init__(self, stand: Stand, over: OverTable, quantities: Sequence[Quantity], folder: Path) -> None:
        """Raises UsageError, CheckError and what the files raise."""
        self.stand, self._quantities = stand, quantities
        assert over.programme is not None and over.motion is not None and over.servo is not None
        self._case = following_case(
            stand, folder / over.motion, folder / over.programme, folder / over.servo, 0.0, 1, over.periods, over.begin,
            over.table or TABLE, "c",
        )  # fmt: skip
        self._made = compile_library(stand)

    def values(self, tables: Tables) -> tuple[dict[str, Array], list[str]]:
        """See `compute.Runner`."""
        n = len(tables)
        found, reasons = {q.name: np.full(n, np.nan) for q in self._quantities}, [""] * n
        for j in range(n):
            try:
                reasons[j] = self._sample(tables, j, found)
            except MahovikError as error:
                reasons[j] = str(error)
        return found, reasons

    def _sample(self, tables: Tables, j: int, found: dict[str, Array]) -> str:
        """Run one sample; return why it has no quantities, or ""."""
        first = j // PER_BLOCK * PER_BLOCK
        block = Block(self.stand, self._made, min(PER_BLOCK, len(tables) - first), tables.block, first)
        case = replace(self._case, real=tables.stand(j))
        record = close_loop(case, make=lambda stand, state, _: SteppedPlant(stand, state, block, j - first))
        if record.stopped is not None:
            return record.stopped
        errors = errors_of(record) if any(q.signal and q.signal.name == "error" for q in self._quantities) else None
        for q in self._quantities:
            assert q.signal is not None
            if errors is not None and q.signal.name == "error":
                found[q.name][j] = error_value(errors, q.statistic, q.signal.axis)
            else:
                found[q.name][j] = _value(q, record, case.real)
        return ""


def error_value(errors: Errors, statistic: str, axis: str) -> float:
    """A figure of `follow`: of one coordinate, or the share of all."""
    if axis:
        return float(getattr(errors, statistic)[errors.coordinates.names.index(axis)])
    return float(getattr(errors, {"peak": "share", "rms": "share_rms", "end": "share_end"}[statistic]))


def _value(q: Quantity, record: Record, real: CoreStand) -> float:
    """A statistic of a signal over the whole run."""
    assert q.signal is not None
    state = np.hstack([record.position, record.attitude, record.V, record.phi, record.phi_dot])[:, :, None]
    T, N, none = len(record.t), record.phi.shape[1], np.zeros((len(record.t), 0, 1))
    chunk = Chunk(record.t, state, none, np.zeros((T, N, 1)), record.tau[:, :, None], none, none, none, none)
    frames = {
        p.name: Frame(p.origin[:, None], p.axes[:, :, None]) for p in places(real, (*sensors(real), real.carrier.name))
    }
    sums = q.new(1)
    part = cut_before(chunk, q.after)
    sums.add(part.t, q.signal.values(Scene(Stand.of(real), state[0], frames, {}), part, sums.turned))
    return float(sums.result()[0])
