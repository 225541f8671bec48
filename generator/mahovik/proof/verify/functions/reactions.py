"""Judges of `mounts`, by the drive torques and the motion under the reactions, and of `reaction` of a hold.

The literal reference and the C share the formula of a mount wrench, so a term that is missing in both would pass.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from types import MappingProxyType
from typing import Any, cast

import numpy as np

from mahovik.core.stand.hold import twists
from mahovik.core.stand.model import Vec6
from mahovik.core.stand.state import State
from mahovik.errors import StateError
from mahovik.proof import reference
from mahovik.proof.reference.array import Array
from mahovik.proof.reference.motion import bias
from mahovik.proof.reference.rotation import C1
from mahovik.proof.reference.screw import block_diagonal
from mahovik.proof.second import Second
from mahovik.proof.verify.check import Check
from mahovik.proof.verify.functions.case import Case
from mahovik.proof.verify.scales import scales
from mahovik.proof.verify.scales.magnitudes import Magnitudes


def mount_rows(case: Case) -> Iterator[Check]:
    """Element 4 of each mount wrench against the second derivation's tau, and all six by the carrier's motion.

    Carrier and instruments alone, with the reactions of the mounts as wrenches on the carrier, must have the V* of the
    whole stand: Lagrange's equations of the stand without flywheels know nothing of what mounts bear.
    """
    tolerance, floor = case.bounds.of("mounts", "mount_wrench"), case.bounds.floor
    torque = Check("mounts", "element 4, tau of the second", tolerance, floor)
    motion = Check("mounts", "V_dot under the reactions", tolerance, floor)
    bare = Second(replace(case.stand, flywheels=(), points=()))
    for name, state in case.states:
        try:
            V_dot = case.call("forward", case.backend.arguments(state))["V_dot"]
            moving = replace(state, V_dot=tuple(V_dot), u_dot=_rates(case, V_dot))
            found = case.call("mounts", case.backend.arguments(moving))["mount_wrench"]
            wrenches = np.array(found, dtype=np.float64).reshape(-1, 6)
        except StateError as error:
            torque.refuse(error, name)
            continue
        at = case.at(moving)
        natural = {want: scales(case.stand, moving, at, want, case.bounds.cuts) for want in ("torque", "mounts")}
        try:
            tau = case.second.evaluate(moving, ("torque",))["tau"]
            torque.compare(wrenches[:, 3], tau, natural["torque"]["tau"], name)
        except StateError as error:
            torque.skip(f"its judge refused: {error}", name)
        if not case.stand.carrier.mass:
            continue
        try:
            _note_motion(motion, case, bare, moving, at, wrenches, np.array(natural["mounts"]["mount_wrench"]), name)
        except StateError as error:  # such as that of a carrier without inertia
            motion.skip(f"its judge refused: {error}", name)
    yield torque
    yield motion


def _rates(case: Case, V_dot: Sequence[float]) -> tuple[float, ...]:
    """u_dot of a held carrier by its V_dot = S u_dot; none of a free one."""
    if case.stand.hold is None:
        return ()
    found = np.linalg.lstsq(twists(case.stand.hold), np.array(V_dot), rcond=None)[0]
    return tuple(found.tolist())


def _note_motion(
    row: Check,
    case: Case,
    bare: Second,
    state: State,
    at: reference.Pieces,
    wrenches: Array,
    natural: Array,
    name: str,
) -> None:
    """Count one state: V* of carrier and instruments under the reactions, by the second derivation."""
    reaction, size = np.zeros(6), np.zeros(6)
    for s, wrench, scale in zip(at.flywheels, wrenches, natural, strict=True):
        still = s.L @ block_diagonal(C1(s.phi)).T  # from the axes of Es at phi = 0
        reaction -= still @ wrench
        size += np.abs(still) @ scale
    given = np.array(state.wrench.get("carrier", (0.0,) * 6)) + reaction
    names = {body.name for body in bare.stand.bodies}
    own = {body: wrench for body, wrench in state.wrench.items() if body in names}
    own["carrier"] = cast(Vec6, tuple(float(x) for x in given))
    none: tuple[Any, ...] = ()
    alone = replace(
        state,
        phi=none,
        phi_dot=none,
        phi_ddot=none,
        tau=none,
        wrench=MappingProxyType(own),
    )
    pieces = reference.pieces(bare.stand, alone)
    if np.linalg.eigvalsh(pieces.K)[0] <= 0.0:
        raise StateError("the mass matrix of the stand without flywheels is not positive definite")
    along = Magnitudes(bare.stand, alone, pieces).free  # all six where the carrier is free
    scale = scales(bare.stand, alone, pieces, "forward", case.bounds.cuts)["V_dot"]
    scale = scale + along.S @ along.K_inverse @ along.S.T @ size
    row.compare(state.V_dot, bare.evaluate(alone, ("forward",))["V_dot"], scale, name)


def hold_rows(case: Case) -> Iterator[Check]:
    """`reaction` for any motion, by the literal (8), and for the motion of the held carrier, by the second derivation.

    R = K V_r* + M V_r + I phi'' + J phi' - F of the V* of the state; of a motion that the second derivation finds, the
    wrench that it finds as well.
    """
    tolerance, floor = case.bounds.default, case.bounds.floor
    given = Check("reaction", "reaction, of any motion", tolerance, floor)
    found = Check("reaction", "reaction, second derivation", tolerance, floor)
    for name, state in case.states:
        at = case.at(state)
        m = Magnitudes(case.stand, state, at, case.bounds.cuts)
        size = m.S_bias + m.S_I @ m.acceleration + m.S_K @ m.stream_rate
        literal = at.K @ at.V_r_dot(np.array(state.V_dot)) + bias(at) + at.I @ np.array(state.phi_ddot) - at.F
        try:
            R = case.call("reaction", case.backend.arguments(state))["reaction"]
            given.compare(R, literal, size + m.S_K @ np.abs(state.V_dot), name)
            own = case.second.evaluate(state, ("forward",))
            moving = replace(state, V_dot=cast(Vec6, tuple(own["V_dot"].tolist())))
            R = case.call("reaction", case.backend.arguments(moving))["reaction"]
            found.compare(R, own["reaction"], size + m.S_K @ np.abs(own["V_dot"]), name)
        except StateError as error:
            given.refuse(error, name)
    yield given
    yield found
