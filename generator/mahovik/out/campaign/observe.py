"""Observation of the samples of a block at the times of output, in chunks of a few times."""

from __future__ import annotations

from collections.abc import Callable, Collection
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from mahovik.core.toolchain.block import Block
from mahovik.out.campaign.pose import Array, rotation
from mahovik.use.simulate.case import Case
from mahovik.use.simulate.course import motion

CACHE = 1 << 13
"""Numbers of one component in a chunk, at most: what is computed of it stays in the cache of the processor."""

NEEDED = {"readings": "points", "tau": "torque", "loads": "mounts", "I": "matrices", "reaction": "reaction"}
"""Functions of the C by what signals need; V_dot comes first, by `forward` or `coupled`."""


@dataclass(eq=False)
class Chunk:
    """K times of n samples, which come last. What nothing needs has no components.

    t (K); state (K, 13 + 2 N, n), or (K, 13, n) of the carrier alone; V_dot (K, 6, n); phi_ddot, tau (K, N, n)
    readings  (K, 24 S, n): of `points`; loads (K, 6 N, n): wrenches of the mounts; I (K, 6 N, n)
    reaction  (K, 6, n): of the hold on the carrier, in E1 about O1
    """

    t: Array
    state: Array
    V_dot: Array
    phi_ddot: Array
    tau: Array
    readings: Array
    loads: Array
    I: Array
    reaction: Array

    @property
    def position(self) -> Array:
        """Position of O1 in E0 (K, 3, n), m."""
        return self.state[:, :3]

    @property
    def attitude(self) -> Array:
        """Quaternion (K, 4, n), w first."""
        return self.state[:, 3:7]

    @property
    def V(self) -> Array:
        """Twist (K, 6, n), m/s and rad/s."""
        return self.state[:, 7:13]

    @property
    def phi_dot(self) -> Array:
        """Speeds (K, N, n), rad/s."""
        N = (self.state.shape[1] - 13) // 2  # where they are needed
        return self.state[:, 13 + N :]

    def rest(self, first: int) -> Chunk:
        """The later part, from the time with this number on."""
        return Chunk(
            self.t[first:], self.state[first:], self.V_dot[first:], self.phi_ddot[first:], self.tau[first:],
            self.readings[first:], self.loads[first:], self.I[first:], self.reaction[first:],
        )  # fmt: skip

    @cached_property
    def C(self) -> Array:
        """x0 = C x1 (K, 3, 3, n)."""
        return rotation(self.attitude)


def cut_before(chunk: Chunk, t: float) -> Chunk:
    """The part of a chunk from a time (s) on."""
    if t <= 0.0 or chunk.t[0] >= t * (1 - 1e-12):
        return chunk
    return chunk.rest(int(np.count_nonzero(chunk.t < t * (1 - 1e-12))))


class Stepped:
    """Steps blocks through a case. `parts`: into how many its steps are cut."""

    def __init__(self, case: Case, parts: int) -> None:
        self._case, self._parts = case, parts

    def run(self, block: Block, observer: Observer) -> None:
        """Step all samples from their states at t = 0, and hand on all moments of output."""
        for at in motion(self._case, block, observer.needs, self._parts):
            observer.consume(
                Chunk(at.t, at.state, at.V_dot, at.phi_ddot, at.tau, at.readings, at.loads, at.I, at.reaction)
            )


class Observer:
    """Calls the C for what is needed at each time of output; hands on chunks."""

    def __init__(self, block: Block, needs: Collection[str], consume: Callable[[Chunk], None]) -> None:
        self._block, self.consume = block, consume
        self._functions = [f for need, f in NEEDED.items() if need in needs and block.has(f)]
        self.needs = frozenset(needs)
        n = block.n
        self.rows = max(1, CACHE // n)
        N = len(block.stand.flywheels)
        self._numbers = block.x.shape[0] if "speeds" in needs else 13

        def memory(need: str, width: int) -> Array:
            return np.zeros((self.rows, width if need in needs or not need else 0, n))

        self._chunk = Chunk(
            np.zeros(self.rows), memory("", self._numbers), memory("V_dot", 6), memory("phi_ddot", N), memory("tau", N),
            memory("readings", 24 * (len(block.stand.instruments) + len(block.stand.points))), memory("loads", 6 * N),
            memory("I", 6 * N), memory("reaction", 6),
        )  # fmt: skip
        self._row = 0

    def take(self, t: float, solve: Callable[[float], None] | None = None) -> None:
        """Keep the state of this time. `solve` computes V_dot and phi_ddot, and tau; otherwise `forward` does."""
        block, own, k = self._block, self._chunk, self._row
        own.t[k] = t
        own.state[k] = block.x[: self._numbers]
        if "V_dot" in self.needs:
            if solve is None:
                block.call("forward", t)
            else:
                solve(t)
            own.V_dot[k] = block.given["V_dot"]
            if "phi_ddot" in self.needs:
                own.phi_ddot[k] = block.given["phi_ddot"]
        for function in self._functions:
            if function != "torque" or solve is None:
                block.call(function, t)
        if "tau" in self.needs:
            own.tau[k] = block.given["tau"]
        if "points" in self._functions:
            own.readings[k] = block.found["points"]
        if "mounts" in self._functions:
            own.loads[k] = block.found["mounts"]
        if "matrices" in self._functions:
            own.I[k] = block.member("matrices", "I").reshape(-1, block.n)
        if "reaction" in self._functions:
            own.reaction[k] = block.found["reaction"]
        self._row += 1
        if self._row == self.rows:
            self.flush()

    def flush(self) -> None:
        """Hand on what has been kept."""
        if self._row:
            own = self._chunk
            rows = slice(0, self._row)
            self.consume(
                Chunk(own.t[rows], own.state[rows], own.V_dot[rows], own.phi_ddot[rows], own.tau[rows],
                      own.readings[rows], own.loads[rows], own.I[rows], own.reaction[rows])
            )  # fmt: skip
        self._row = 0
