"""Quantities at given states, as `eval` computes them, without a run in time."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from mahovik.core.stand.state import State
from mahovik.core.stand.units import show
from mahovik.core.toolchain.block import Block
from mahovik.errors import StateError, UsageError
from mahovik.nearest import suggestion
from mahovik.out.api.stands import Stand
from mahovik.out.campaign.in_time import TimeRunner, with_quaternion
from mahovik.out.campaign.observe import Observer
from mahovik.out.campaign.over import OverTable
from mahovik.out.campaign.quantities import Quantity
from mahovik.out.campaign.start import Start, column
from mahovik.proof.verify.states import read_object, read_request
from mahovik.use.simulate.case import START_KEYS

KEYS = (*START_KEYS, "phi_ddot")
"""Keys of a state; what is not given is zero. The carrier's acceleration follows from (8)."""


@dataclass(frozen=True, eq=False)
class States:
    """Puts all samples into each of the states, one after another."""

    states: tuple[State, ...]

    def run(self, block: Block, observer: Observer) -> None:
        """See `in_time.Course`; the number of the state takes the place of the time."""
        for number, state in enumerate(self.states):
            block.x[:] = column(state)[:, None]
            block.given["phi_ddot"][:] = np.array(state.phi_ddot)[:, None]
            observer.take(float(number))


def states_runner(stand: Stand, over: OverTable, quantities: Sequence[Quantity], folder: Path) -> TimeRunner:
    """Over the states of a file of JSON lines. Raises UsageError."""
    assert over.states is not None
    states = _read(folder / over.states, stand)
    return TimeRunner(stand, len(states), quantities, Start(states[0]), States(states))


def _read(path: Path, stand: Stand) -> tuple[State, ...]:
    from mahovik.core.stand.content import readable

    try:
        text = readable(path, "a file of states").decode("utf-8-sig")
    except ValueError as error:
        raise UsageError(f"states: {error}") from None
    found = []
    for number, line in enumerate(text.splitlines(), 1):
        if not line.strip():
            continue
        try:
            given = read_object(line)
            for key in given:
                if key not in KEYS:
                    raise StateError(f"unknown key {show(key)}{suggestion(key, KEYS)}")
            found.append(with_quaternion(stand, read_request(stand, {**given, "want": ["forward"]}).state))
        except StateError as error:
            raise UsageError(f"states: {path.name}, line {number}: {error}") from None
    if not found:
        raise UsageError(f"states: {path.name}: no state, expected one a line")
    return tuple(found)
