"""The generated C of a held carrier against outside judges that have the joint itself, state by state."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

import numpy as np

from mahovik.core.stand.model import Stand
from mahovik.core.stand.state import State
from mahovik.proof import reference
from mahovik.proof.verify.backends import Backend
from mahovik.proof.verify.bounds import DOUBLE
from mahovik.proof.verify.check import Check, difference
from mahovik.proof.verify.harness import Progress
from mahovik.proof.verify.judges.rigid import Values
from mahovik.proof.verify.scales import scales
from mahovik.proof.verify.states import Request

GIVEN = {"forward": " for given phi_ddot", "coupled": " for given tau", "torque": ", inverse dynamics"}
"""Wants of a held carrier that joints answer, and what is given, in words."""


class HeldJudge(Protocol):
    """A program of others with the model of one held stand."""

    name: str
    version: str

    def evaluate(self, state: State) -> dict[str, Values]:
        """Answers to each want of GIVEN: some of u_dot (m), V_dot, reaction (6, in E1 about O1), phi_ddot, tau (N)."""


def compare_held(
    stand: Stand,
    judges: Sequence[HeldJudge],
    backend: Backend,
    states: Sequence[tuple[str, State]],
    progress: Progress | None = None,
) -> list[Check]:
    """A row for each judge and quantity: `backend` against the judge, relative to the natural scale."""
    rows: dict[tuple[str, str], Check] = {}
    for done, (name, state) in enumerate(states):
        theirs = [(judge.name, judge.evaluate(state)) for judge in judges]
        with np.errstate(all="ignore"):
            at = reference.pieces(stand, state)
            natural = {want: scales(stand, state, at, want) for want in GIVEN}
        for want, given in GIVEN.items():
            own = backend.evaluate(state, (want,))
            for judge, answers in theirs:
                for key in answers[want].keys() & own.keys():
                    if np.size(answers[want][key]) == 0:
                        continue  # no flywheels, or no freedoms: nothing to agree on
                    row = rows.setdefault((judge, f"{want} {key}"), Check(judge, f"{key}{given}", DOUBLE.default))
                    off, reason = difference(own[key], answers[want][key], natural[want][key])
                    row.note(off, name, reason, Request(name, state, (want,)))
        if progress is not None:
            progress(done + 1, len(states))
    return [rows[key] for judge in judges for key in sorted(rows) if key[0] == judge.name]
