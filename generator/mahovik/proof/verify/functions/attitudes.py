"""Judges of `quaternion` and `state_from_coordinates`: attitudes and (10) of the literal reference."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from mahovik.core.stand.model import Hold, Sequence
from mahovik.core.stand.state import rest_state
from mahovik.errors import StateError
from mahovik.proof.reference.array import Array
from mahovik.proof.reference.coordinates import pose_of
from mahovik.proof.reference.generalized import check_attitude, kinematic_matrix, kinematic_matrix_rate
from mahovik.proof.reference.rotation import attitude, quaternion_rotation
from mahovik.proof.verify.check import Check
from mahovik.proof.verify.functions.case import Case
from mahovik.proof.verify.scales.parts import length

ATTITUDES = 24
"""Attitudes tried, some of them after several turns."""


def _angles(case: Case) -> Iterator[tuple[str, Array]]:
    """Angles psi, theta, phi (3, rad), as the element type has them."""
    rng = case.random(1)
    for number in range(ATTITUDES):
        turns = 20.0 if number % 4 == 3 else 1.0
        angles = rng.uniform(-math.pi, math.pi, 3) * turns
        yield f"attitude {number}", case.nearest_numbers(angles)


def quaternion_rows(case: Case) -> Iterator[Check]:
    """C of the quaternion against the product of the elementary rotations."""
    row = Check("quaternion", "C", case.bounds.of("generalized", "A"))
    for name, angles in _angles(case):
        found = case.call("quaternion", {"angles": list(angles)})["attitude"]
        row.compare(quaternion_rotation(*found), attitude(case.stand.angles, *angles), np.ones((3, 3)), name)
    yield row


def coordinate_rows(case: Case) -> Iterator[Check]:
    """V = A q' and V* = A q'' + D q' of (10), and position and attitude."""
    if case.stand.hold is not None:
        yield freedom_row(case, case.stand.hold)
        return
    rng, sequence = case.random(2), case.stand.angles
    row = Check("state_from_coordinates", "state, V_dot", case.bounds.default)
    count = case.count
    for name, angles in _angles(case):
        if _singular(sequence, angles):
            continue
        position, q_dot, q_ddot = (case.nearest_numbers(rng.normal(size=size)) for size in (3, 6, 6))
        x = {"position": [0.0] * 3, "attitude": [1.0, 0.0, 0.0, 0.0], "V": [0.0] * 6}
        kept = {
            "phi": list(case.nearest_numbers(rng.normal(size=count))),
            "phi_dot": list(case.nearest_numbers(rng.normal(size=count))),
        }
        x |= kept if count else {}
        given = {"position": list(position), "angles": list(angles), "q_dot": list(q_dot), "q_ddot": list(q_ddot)}
        try:
            found = case.call("state_from_coordinates", given | {"x": x})
        except StateError as error:
            row.refuse(error, name)
            continue
        if count:
            row.compare({key: list(found["x"][key]) for key in kept}, kept, dict.fromkeys(kept), f"{name}, kept")
        A, D = kinematic_matrix(sequence, angles), kinematic_matrix_rate(sequence, angles, q_dot[3:])
        S_A = np.kron(np.eye(2), np.ones((3, 3)))  # elements of rotations, and their rates
        S_D = float(np.abs(q_dot[3:]).sum()) * S_A
        row.compare(found["x"]["position"], position, np.abs(position), f"{name}, position")
        C = quaternion_rotation(*found["x"]["attitude"])
        row.compare(C, attitude(sequence, *angles), np.ones((3, 3)), f"{name}, attitude")
        row.compare(found["x"]["V"], A @ q_dot, S_A @ np.abs(q_dot), f"{name}, V")
        scale = S_A @ np.abs(q_ddot) + S_D @ np.abs(q_dot)
        row.compare(found["V_dot"], A @ q_ddot + D @ q_dot, scale, f"{name}, V_dot")
    yield row


def freedom_row(case: Case, hold: Hold) -> Check:
    """Position, attitude, V and V* of coordinates of the freedoms of a hold."""
    rng, row = case.random(2), Check("state_from_coordinates", "state, V_dot", case.bounds.default)
    takes = case.backend.program.function("state_from_coordinates").arguments
    sizes = {a.name: int(a.shape[0]) for a in takes if a.name.startswith(("q", "orientation"))}
    table, arm = case.backend.arguments(rest_state(case.stand))["table"], length(np.array(hold.pivot))
    for number in range(ATTITUDES):
        given = {name: rng.normal(size=size) for name, size in sizes.items()}
        if "orientation" in given:
            given["orientation"] /= np.linalg.norm(given["orientation"])
        given = {name: case.nearest_numbers(each) for name, each in given.items()}
        kept = {key: list(case.nearest_numbers(rng.normal(size=case.count))) for key in ("phi", "phi_dot")}
        x = {"position": [0.0] * 3, "attitude": [1.0, 0, 0, 0], "V": [0.0] * 6} | (kept if case.count else {})
        lists = {name: list(each) for name, each in given.items()}
        found, name = case.call("state_from_coordinates", {**lists, "table": table, "x": x}), f"coordinates {number}"
        if case.count:
            row.compare({key: list(found["x"][key]) for key in kept}, kept, dict.fromkeys(kept), f"{name}, kept")
        q, orientation, rates = given.get("q", np.zeros(0)), given.get("orientation"), given["q_dot"]
        at = pose_of(hold, case.stand.angles, q, orientation, rates, given["q_ddot"])
        place = length(np.array(hold.position)) + 2 * arm + length(q)
        speed, second = length(rates), length(given["q_ddot"]) + length(rates) ** 2
        row.compare(found["x"]["position"], at.position, np.full(3, place), f"{name}, position")
        row.compare(quaternion_rotation(*found["x"]["attitude"]), at.C, np.ones((3, 3)), f"{name}, attitude")
        row.compare(found["x"]["V"], at.V, np.repeat([(1 + arm) * speed, speed], 3), f"{name}, V")
        row.compare(found["V_dot"], at.V_dot, np.repeat([(1 + arm) * second, second], 3), f"{name}, V_dot")
    return row


def _singular(sequence: Sequence, angles: Array) -> bool:
    try:
        check_attitude(sequence, angles)
    except StateError:
        return True
    return False
