"""Channels of sensors while all flywheels turn as given, of n variants of a stand at once, by the batch C.

Steps of order 4 of `step_driven`, whose tables and initial states differ from variant to variant.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

from mahovik.core.motion.functions import Motion
from mahovik.core.motion.laws import SpeedLaw
from mahovik.core.motion.regime import FlywheelRegime, Regime
from mahovik.core.stand.state import State
from mahovik.core.toolchain.block import PER_BLOCK, Block
from mahovik.core.toolchain.compiled import compile_library
from mahovik.errors import StateError, UsageError
from mahovik.out.api.model import build
from mahovik.out.api.stands import Stand
from mahovik.out.api.tables import Tables
from mahovik.out.campaign.holds import Holds
from mahovik.out.campaign.observe import Chunk, Observer, Stepped
from mahovik.out.campaign.pose import cross, turn_back
from mahovik.out.campaign.values import Frame, frames_of
from mahovik.out.identify.channels import REACTION, Channel
from mahovik.out.identify.deviations import Deviations
from mahovik.use.simulate.case import Case
from mahovik.use.simulate.held import home

Array = NDArray[np.float64]

TURN = 0.25
"""A step turns no flywheel by more, rad: the error of order 4 is then far below that of any sensor."""

SIZE = 128
"""Variants that are stepped together."""


@dataclass(frozen=True, eq=False)
class Shifted(SpeedLaw):
    """A law as seen from the time `by` (s) on: t = 0 is there."""

    law: SpeedLaw
    by: float

    @property
    def breaks(self) -> tuple[float, ...]:
        """Times at which the acceleration of the law jumps, s."""
        return tuple(each - self.by for each in self.law.breaks)

    def motion(self, t: Array) -> Motion:
        """Motion at the times t (s)."""
        begin = self.law.motion(np.array([self.by]))[0]
        phi, phi_dot, phi_ddot = self.law.motion(t + self.by)
        return phi - begin, phi_dot, phi_ddot


def shift_regime(regime: Regime, by: float) -> Regime:
    """A regime of given speeds, seen from the time `by` (s) on."""
    turned = regime.motion(np.array([by]))[0][0].tolist()
    driven = (
        FlywheelRegime(each.name, Shifted(cast(SpeedLaw, each.law), by), (each.phase or 0.0) + turn)
        for each, turn in zip(regime.flywheels, turned, strict=True)
    )
    return Regime(regime.name, tuple(driven), regime.wrenches)


class Predictor:
    """Predicts channels at `count` evenly spaced times from `begin` (s) on, `every` s apart.

    `regime` gives the speeds of all flywheels; `start` is the nominal state of the carrier at `begin`, from which
    initial states differ (see Deviations); of a held carrier it is the home pose by default. Raises UsageError.
    """

    def __init__(
        self,
        stand: Stand,
        regime: Regime,
        channels: Sequence[Channel],
        begin: float,
        every: float,
        count: int,
        start: State | None = None,
    ) -> None:
        if regime.by_torque:
            raise UsageError(f"{regime.name}: expected the speeds of all flywheels, found a flywheel driven by torque")
        if not stand.flywheels:
            raise UsageError(f"{stand.name} has no flywheel, expected at least one: a still one has a constant phase")
        if count < 2:
            raise UsageError(f"expected at least 2 samples, found {count}")
        N = len(stand.flywheels)
        self.stand, self.channels, self.begin, self.every, self.count = stand, tuple(channels), begin, every, count
        own = regime if begin == 0.0 else shift_regime(regime, begin)
        until = every * (count - 1)
        fastest = float(np.abs(own.motion(np.linspace(0.0, until, 1000))[1]).max()) if N else 0.0
        dt = min(every, TURN / fastest) if fastest else every
        still = State((0.0,) * 3, None, None, (0.0,) * 6, *((0.0,) * N,) * 3, (0.0,) * 6, (0.0,) * N)
        self.deviations = Deviations(stand)
        if start is None and stand.hold is not None:
            still = replace(still, **{name: getattr(home(stand), name) for name in ("position", "quaternion", "u")})
        self._case = Case(stand, own, start or still, until, every, dt)
        self._made = compile_library(stand)
        self._course = Stepped(self._case, 1)
        self._gravity = np.array(stand.gravity)

    @property
    def times(self) -> Array:
        """Times of the predicted samples, s."""
        return self.begin + self.every * np.arange(self.count, dtype=np.float64)

    def __call__(self, tables: Tables, starts: Array | None = None) -> Array:
        """Channels (count, C, n), SI, of the stands of `tables`, with deviations of the initial states (n, D).

        Raises StateError: a variant leaves the computable range.
        """
        n = len(tables)
        found = np.zeros((self.count, len(self.channels), n))
        starts = np.zeros((n, self.deviations.count)) if starts is None else starts
        holds = Holds.of(self.stand, tables)
        for first in range(0, n, SIZE // PER_BLOCK * PER_BLOCK):
            block = Block(self.stand, self._made, min(SIZE, n - first), tables.block, first)
            own = slice(first, first + block.n)
            self._begin(block, starts[own].T, None if holds is None else holds.part(own))
            self._run(block, found[:, :, own])
        return found

    def states(self) -> tuple[Array, Array]:
        """States (count, 13 + 2 N) and V_dot (count, 6) of the stand itself, from its nominal initial state.

        Raises StateError.
        """
        tables = build(self.stand).tables({}, 1)
        block = Block(self.stand, self._made, 1, tables.block)
        self._begin(block, np.zeros((self.deviations.count, 1)))
        states, rates = [], []

        def consume(chunk: Chunk) -> None:
            states.append(chunk.state[:, :, 0].copy())
            rates.append(chunk.V_dot[:, :, 0].copy())

        observer = Observer(block, {"V_dot", "speeds"}, consume)
        self._course.run(block, observer)
        observer.flush()
        self._require_in_range(block)
        return np.concatenate(states), np.concatenate(rates)

    def _begin(self, block: Block, deviation: Array, holds: Holds | None = None) -> None:
        x = self.deviations.states(self._case.start, deviation)
        block.x[:13] = x if holds is None else holds.states(x)

    def _run(self, block: Block, out: Array) -> None:
        readings = None
        if block.has("points"):
            block.call("points")
            readings = block.found["points"]
        frames = frames_of(self.stand, block.x, readings)
        row = 0

        def consume(chunk: Chunk) -> None:
            nonlocal row
            own = out[row : row + len(chunk.t)]
            row += len(own)
            measured: dict[tuple[str, str], Any] = {}
            for c, channel in enumerate(self.channels):
                key = channel.point, channel.kind
                if key not in measured and channel.kind == REACTION:
                    measured[key] = chunk.reaction
                elif key not in measured:
                    measured[key] = self._sensor_values(channel.kind, frames[channel.point], chunk)
                own[:, c] = measured[key][:, channel.axis]

        needs = {"V_dot", *(channel.kind for channel in self.channels if channel.kind == REACTION)}
        observer = Observer(block, needs, consume)
        self._course.run(block, observer)
        observer.flush()
        self._require_in_range(block)

    def _require_in_range(self, block: Block) -> None:
        for j in np.flatnonzero(block.status < 0).tolist():
            raise StateError(f"{self.stand.name}: variant {block.first + j}: {block.reason(j)}")

    def _sensor_values(self, kind: str, frame: Frame, at: Chunk) -> Array:
        """Specific force (m/s2) or angular velocity (rad/s) in the axes of a point (K, 3, n)."""
        omega = at.V[:, 3:]
        if kind == "rate":
            return turn_back(frame.A, omega)
        r = frame.r
        a = at.V_dot[:, :3] + cross(at.V_dot[:, 3:], r) + cross(omega, at.V[:, :3] + cross(omega, r))
        if self._gravity.any():
            a = a - turn_back(at.C, np.broadcast_to(self._gravity[:, None], at.V[:, :3].shape))
        return turn_back(frame.A, a)
