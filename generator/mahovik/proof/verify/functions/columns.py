"""Judge of `regressor`: its columns against those of the literal reference, and their sum against the equations."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import numpy as np

from mahovik.core.stand.state import State
from mahovik.errors import StateError
from mahovik.proof.reference.array import Array
from mahovik.proof.reference.pieces import Pieces
from mahovik.proof.reference.regressor import answer_regressor
from mahovik.proof.verify.check import Check
from mahovik.proof.verify.functions.case import Case
from mahovik.proof.verify.scales.magnitudes import Magnitudes, origin, phi_magnitude, screw
from mahovik.proof.verify.scales.parts import length


def column_rows(case: Case) -> Iterator[Check]:
    """A row for each group of columns."""
    rows: dict[str, Check] = {}
    for name, state in case.states:
        at = case.at(state)
        expected = answer_regressor(at, case.stand, state)
        natural = column_scales(Magnitudes(case.stand, state, at), at, state)
        for group in expected:
            if group not in rows:
                tolerance = case.bounds.of("regressor", group)
                rows[group] = Check("regressor", group, tolerance, case.bounds.floor)
        try:
            found = case.call("regressor", case.backend.arguments(state))
        except StateError as error:
            for row in rows.values():
                row.refuse(error, name)
            continue
        for group, row in rows.items():
            row.compare(np.array(found[group], dtype=np.float64), expected[group], natural[group], name)
    for row in rows.values():
        yield row


def column_scales(m: Magnitudes, at: Pieces, state: State) -> Mapping[str, Array]:
    """Scales of the columns, by the names of the C: sums of the magnitudes of their terms."""
    v, omega = length(m.S_V[:3]), length(m.S_V[3:])
    a, alpha = length(np.array(state.V_dot)[:3]), length(np.array(state.V_dot)[3:])
    gravity = length(at.gravity)
    found = {"Y_carrier": _body(0.0, (a + omega * v + gravity, alpha, omega))}
    flywheels, drives = [], []
    for s, acceleration in zip(at.flywheels, state.phi_ddot, strict=True):
        spin, arm = abs(s.phi_dot), length(origin(s.L))
        turning = omega + spin
        pull = a + arm * alpha + turning * (v + arm * omega) + gravity
        motion = (pull, alpha + spin * omega + abs(acceleration), turning)
        flywheels.append(_body(arm, motion))
        drives.append(_body(0.0, motion)[3])
    found |= {"Y_flywheel": np.array(flywheels), "Y_drive": np.array(drives)}
    rate = np.abs(np.array(state.V_dot)) + screw(omega * m.stream, 0.0)
    Phi = phi_magnitude(m.S_V)
    upper = [(i, j) for i in range(6) for j in range(i, 6)]
    added = np.zeros((6, len(upper)))
    for column, (i, j) in enumerate(upper):
        unit = np.zeros((6, 6))
        unit[i, j] = unit[j, i] = 1.0
        added[:, column] = unit @ rate + Phi @ unit @ m.S_V
    return found | {"Y_added_mass": added, "Y_linear": m.S_V, "Y_quadratic": m.S_V**2}


def _body(arm: float, motion: tuple[float, float, float]) -> Array:
    """Scales of the ten columns of a body (6x10) at a distance from O1; proper and angular acceleration, rate."""
    pull, alpha, omega = motion
    turn = alpha + omega**2
    columns = [screw(pull, arm * pull)]
    columns += [screw(pull + turn, pull + arm * (pull + turn))] * 3
    columns += [screw(0.0, turn)] * 6
    return np.column_stack(columns)
