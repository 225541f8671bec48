"""States in which the samples of a block begin: one for all, or the static equilibrium of each."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from mahovik.core.stand.hold import twists
from mahovik.core.stand.model import Stand
from mahovik.core.stand.state import State
from mahovik.core.toolchain.block import Block
from mahovik.errors import MahovikError
from mahovik.out.api.tables import Tables
from mahovik.out.campaign.holds import Holds
from mahovik.out.campaign.pose import Array, compose, product, rotation, small_rotation, turn
from mahovik.use.study.rest import accuracy, rest

MOST = 40
"""Most corrections of a pose."""

SHIFTS_FIRST = np.array([1e3] * 3 + [1.0] * 3)
"""Weights of a correction: along free directions a rotation serves before a shift, as in `rest`."""

_STEP = 1e-6
"""m, rad: step of the differences."""
_FREE = 1e-8


class Start:
    """One state for all samples. `states` also says where the phases and speeds come from: the state."""

    def __init__(self, state: State) -> None:
        self.state = state

    def begin(self, block: Block, tables: Tables) -> dict[int, str]:
        """Put the states of a block; return samples without one, with their reason."""
        block.x[:] = column(self.state)[:, None]
        if (holds := Holds.of(block.stand, tables)) is not None:
            block.x[:13] = holds.states(block.x[:13])
        return {}


def column(state: State) -> Array:
    """The numbers of a state that has a quaternion."""
    quaternion = state.quaternion or (1.0, 0.0, 0.0, 0.0)
    return np.array([*state.position, *quaternion, *state.V, *state.phi, *state.phi_dot])


class AtRest:
    """Each sample at its own static equilibrium, which is near that of the stand of the file.

    Corrections by the stiffness of that stand are made until what remains is rounding; a sample that they do not bring
    there is searched by itself.
    """

    def __init__(self, stand: Stand, phases: list[float], own: Block) -> None:
        """`own`: a block of the stand of the file alone, which is at rest in the state `nominal`. Raises CheckError: it
        has no equilibrium.
        """
        self._phases = phases
        self.nominal = rest(stand, phases).state
        self._accuracy = accuracy(stand, self.nominal)
        own.x[:] = column(self.nominal)[:, None]
        self._S = np.eye(6) if stand.hold is None else twists(stand.hold)
        self._inverse = self._inverse_stiffness(own)

    @property
    def state(self) -> State:
        """The equilibrium of the stand of the file."""
        return self.nominal

    def begin(self, block: Block, tables: Tables) -> dict[int, str]:
        """Put the states of a block; return samples without one, with their reason."""
        block.x[:] = column(self.nominal)[:, None]
        block.given["phi_ddot"][:] = 0.0
        block.given["wrench"][:] = 0.0
        holds = Holds.of(block.stand, tables)
        if holds is not None:
            block.x[:13] = holds.states(block.x[:13])
        for _ in range(MOST):
            block.call("forward")
            V_dot = block.given["V_dot"]
            moving = np.any(np.abs(V_dot) > 2.0 * self._accuracy[:, None], axis=0)
            if not moving.any():
                return {}
            moved = block.x.copy()
            near = V_dot if holds is None else holds.nominal_twists(V_dot)
            step = product(self._inverse[:, :, None], near)
            self._displace(moved, step if holds is None else holds.twists(step))
            block.x[:, moving] = moved[:, moving]  # those that rest stay as they are, whatever the others need
        return self._one_by_one(block, tables, np.flatnonzero(moving).astype(np.int64))

    def _inverse_stiffness(self, own: Block) -> Array:
        """-(dV_dot/dpose)^-1 (6, 6) at the state of a block of one, least in the weights of SHIFTS_FIRST.

        Of a held carrier along its freedoms, least in their numbers.
        """
        here, columns = own.x.copy(), [np.zeros((6, 0))]
        for each in self._S.T:
            both = []
            for sign in (1.0, -1.0):
                self._displace(own.x, sign * _STEP * each[:, None])
                own.call("forward")
                both.append(own.given["V_dot"][:, 0].copy())
                own.x[:] = here
            columns.append(((both[0] - both[1]) / (2.0 * _STEP))[:, None])
        slope = np.hstack(columns)
        weights = SHIFTS_FIRST if own.stand.hold is None else np.ones(slope.shape[1])
        return np.asarray(-self._S @ (np.linalg.pinv(slope / weights, rcond=_FREE) / weights[:, None]))

    @staticmethod
    def _displace(x: Array, step: Array) -> None:
        """Displace poses by small twists in E1 (6, n; m, rad)."""
        x[:3] += turn(rotation(x[3:7]), step[:3])
        turned = compose(x[3:7], small_rotation(step[3:]))
        x[3:7] = turned / np.sqrt((turned**2).sum(axis=0))

    def _one_by_one(self, block: Block, tables: Tables, samples: NDArray[np.int64]) -> dict[int, str]:
        reasons = {}
        for j in samples.tolist():
            try:
                found = rest(tables.stand(block.first + j), self._phases).state
            except MahovikError as error:
                reasons[j] = str(error)
                block.x[:, j] = column(self.nominal)
            else:
                block.x[:, j] = column(found)
        return reasons
