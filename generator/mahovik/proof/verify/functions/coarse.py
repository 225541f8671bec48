"""Judge of the status COARSE of the steps: just below and just above the bound of the contract."""

from __future__ import annotations

import numpy as np

from mahovik.contract.quantities import BOUNDS
from mahovik.contract.status import STATUS_VALUES, status_words
from mahovik.proof.verify.check import Check
from mahovik.proof.verify.functions.case import Case

MARGIN = 1e-3
"""Relative distance of a step from the bound."""

ANSWERS = 2
"""Answers that are judged on each side of the bound of each order; a long step may be refused."""


def coarse_row(case: Case, function: str) -> Check:
    """COARSE if and only if dt times the fastest of |phi_dot| and |omega| exceeds the bound of the order.

    Every state is taken as it is, and with resting flywheels, where the carrier turns fastest.
    """
    row = Check(function, "status COARSE", 0.0)
    count = {(order, side, still): 0 for order in (2, 4) for side in (-1, 1) for still in (False, True)}
    for name, state in case.states:
        for (order, side, still), answers in count.items():
            if answers >= ANSWERS:
                continue
            given = case.backend.arguments(state)
            speeds = np.zeros(case.count) if still else np.array(state.phi_dot, dtype=np.float64)
            fastest = max(float(np.linalg.norm(state.V[3:])), float(np.abs(speeds).max(initial=0.0)))
            if not fastest > 0.0:
                continue
            dt = float(BOUNDS[f"MAX_TURN_{order}"].value) / fastest * (1 + side * MARGIN)
            x = given["x"] | ({"phi_dot": tuple(speeds)} if case.count else {})
            carry = {"rounding": [0.0] * case.numbers}
            status, _ = case.backend.call(function, given | {"x": x, "dt": dt, "order": order, "carry": carry})
            if status < 0:  # a stage of a long step may be out of range, and dt itself
                continue
            count[order, side, still] += 1
            wrong = status != (STATUS_VALUES["COARSE"] if side > 0 else STATUS_VALUES["OK"])
            words = f"status {status_words(status)} at {1 + side * MARGIN:g} of the bound of order {order}"
            row.demand(not wrong, name, words)
    missing = [f"order {order}" for (order, side, _), answers in count.items() if side > 0 and not answers]
    if row.states and missing:
        row.words = row.words or f"no step above the bound answered: {', '.join(dict.fromkeys(missing))}"
    return row
