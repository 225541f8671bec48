"""The generated C against outside judges: the equations state by state, then a free motion."""

from __future__ import annotations

import importlib
from collections.abc import Sequence
from dataclasses import replace
from types import MappingProxyType
from typing import Any, cast

import numpy as np

from mahovik.core.stand.model import Stand, Vec3, Vec6
from mahovik.core.stand.state import State
from mahovik.errors import UsageError
from mahovik.proof import reference
from mahovik.proof.verify.backends import Backend
from mahovik.proof.verify.bounds import DOUBLE
from mahovik.proof.verify.c_backend import CBackend
from mahovik.proof.verify.compare import Row, difference
from mahovik.proof.verify.draw import draw
from mahovik.proof.verify.harness import Progress, report
from mahovik.proof.verify.judges.motion import MOTION_TOLERANCE, UNTIL, end_of_motion, moderate
from mahovik.proof.verify.judges.rigid import MovingJudge, OutsideJudge, Values, missing, stripped
from mahovik.proof.verify.report import Report
from mahovik.proof.verify.scales import scales
from mahovik.proof.verify.scales.magnitudes import Magnitudes
from mahovik.proof.verify.states import Request

JUDGES = {
    "pinocchio": ("mahovik.proof.verify.judges.pinocchio_judge", "PinocchioJudge"),
    "mujoco": ("mahovik.proof.verify.judges.mujoco_judge", "MujocoJudge"),
}
"""Module and class of every judge, imported only where it is asked."""

PARTIAL = {"basilisk": ("mahovik.proof.verify.judges.basilisk_judge", "BasiliskJudge", "pip install bsk")}
"""Judges that know some stands only: without them, or for another stand, a row says that nothing is compared."""

INSTALL = "pip install pin mujoco"

NEAR = 10.0
"""m; judges add positions in E0 to those of bodies, and lose digits far from its origin."""

QUANTITIES = {
    "K": "mass matrix, carrier",
    "I": "mass matrix, coupling",
    "bias": "bias forces",
    "V_dot_forward": "V_dot for given phi_ddot",
    "V_dot": "V_dot for given tau",
    "phi_ddot": "phi_ddot for given tau",
    "base_wrench": "inverse dynamics, wrench on the carrier",
    "tau": "inverse dynamics, tau",
    "mount_wrench": "joint forces",
    "points": "points",
}
"""What is compared, in words."""

ALL = (*JUDGES, *PARTIAL)

Judge = OutsideJudge | MovingJudge


def motion_of(seconds: float) -> str:
    """The motion as a quantity, in words."""
    return f"free motion of {seconds:g} s"


MOTION = motion_of(UNTIL)


def load_judges(stand: Stand, names: Sequence[str] = tuple(JUDGES)) -> list[Judge]:
    """The judges with the model of the stand. UsageError: not installed, or the stand has what they lack."""
    found = missing(stand)
    if found:
        raise UsageError(
            f"--judges: Pinocchio and MuJoCo know rigid bodies on joints, and not {', '.join(found)}: "
            "add --bare to have the stand judged without"
        )
    if not any(body.mass > 0.0 for body in stand.bodies):
        raise UsageError("--judges: no body of the stand has a mass")
    return [_load(stand, name) for name in names]


def _load(stand: Stand, name: str) -> Judge:
    module, kind, *install = JUDGES.get(name) or PARTIAL[name]
    try:
        return cast(Judge, getattr(importlib.import_module(module), kind)(stand))
    except ImportError as error:
        command = install[0] if install else INSTALL
        raise UsageError(f"--judges: {name} is not installed ({error.name or error}): {command}") from None


def verify_judges(
    stand: Stand,
    *,
    seed: int = 1,
    count: int = 200,
    names: Sequence[str] = ALL,
    bare: bool = False,
    until: float = UNTIL,
    progress: Progress | None = None,
) -> Report:
    """Rows of every judge and quantity: generated C against the judge, relative to the natural scale.

    `bare`: of the stand without what no judge has; the report names it. `until`: s, of the free motion.
    """
    if bare:
        found = verify_judges(stripped(stand), seed=seed, count=count, names=names, until=until, progress=progress)
        return replace(found, left_out=tuple(missing(stand)))
    judges = load_judges(stand, [name for name in names if name in JUDGES])
    absent = []
    for name in names:
        if name in PARTIAL:
            try:
                judges.append(_load(stand, name))
            except UsageError as error:
                reason = str(error).removeprefix("--judges: ")
                absent.append(Row(name, "all quantities", verdict="not compared", reason=reason))
    found = verify_by(stand, judges, seed=seed, count=count, until=until, progress=progress)
    return replace(found, rows=(*found.rows, *absent))


def verify_by(
    stand: Stand,
    judges: Sequence[Judge],
    *,
    seed: int = 1,
    count: int = 200,
    until: float = UNTIL,
    backend: Backend | None = None,
    judged: str = "generated C",
    progress: Progress | None = None,
) -> Report:
    """The same by judges that have the stand already.

    `backend`: what is judged, where that is not fresh C; `judged`: its name. `until` 0: no free motion.
    """
    backend = backend or CBackend(stand)
    rows = {(judge.name, key): Row(judge.name, words) for judge in judges for key, words in QUANTITIES.items()}
    states = draw(stand, seed, count)
    for done, (name, drawn) in enumerate(states):
        state = near(drawn)
        own, natural = ours(backend, state), natural_scales(stand, state)
        request = Request(name, state, ("matrices", "forward", "torque", "mounts", "points"))
        for judge in judges:
            for key, value in judge.evaluate(state).items():
                if _empty(value):
                    continue  # no flywheels, no points: nothing to agree on
                off, reason = difference(own[key], value, natural[key])
                rows[judge.name, key].note(off, request, reason)
        if progress is not None:
            progress(done + 1, len(states))
    moved = [_motion_row(stand, backend, judge, seed, until) for judge in judges if until > 0.0]
    noted = [row for row in (*rows.values(), *moved) if row.states]
    for row in noted:
        row.tolerance = row.tolerance or DOUBLE.default
        row.verdict = "ok" if row.worst <= row.tolerance else "FAILED"
    ordered = [row for judge in judges for row in noted if row.want == judge.name]
    who = ", ".join(f"{judge.name} {judge.version}" for judge in judges)
    return report(stand, f"{judged} against {who}", seed, count, DOUBLE.default, ordered)


def near(state: State) -> State:
    """The state with the carrier near the origin of E0, and no speed that overflows a judge's range."""
    position = np.array(state.position)
    away = float(np.linalg.norm(position))
    if away > NEAR:
        position *= NEAR / away
    return replace(state, position=cast(Vec3, tuple(map(float, position))))


def ours(backend: Backend, state: State) -> Values:
    """The quantities of a judge from what is judged."""
    found: Values = {}
    for want in ("matrices", "torque", "mounts", "points", "coupled"):
        found |= backend.evaluate(state, (want,))
    found["V_dot_forward"] = backend.evaluate(state, ("forward",))["V_dot"]
    K, M, I, J, F = (np.array(found[name], dtype=np.float64) for name in ("K", "M", "I", "J", "F"))
    I, J = I.reshape(6, -1), J.reshape(6, -1)
    found["I"] = I
    found["bias"] = M @ np.array(state.V) + J @ np.array(state.phi_dot) - F
    found["base_wrench"] = found["bias"] + K @ np.array(state.V_dot) + I @ np.array(state.phi_ddot)
    return found


def natural_scales(stand: Stand, state: State) -> dict[str, Any]:
    """Scales of the quantities of a judge: those of docs/verification.md."""
    with np.errstate(all="ignore"):
        at = reference.pieces(stand, state)
        m = Magnitudes(stand, state, at)
        given = m.S_K @ np.abs(np.array(state.V_dot)) + m.S_I @ m.acceleration
        return {
            "K": m.S_K,
            "I": m.S_I,
            "bias": m.S_bias,
            "base_wrench": m.S_bias + given,
            "V_dot_forward": scales(stand, state, at, "forward")["V_dot"],
            **scales(stand, state, at, "coupled"),
            **scales(stand, state, at, "torque"),
            **scales(stand, state, at, "mounts"),
            **scales(stand, state, at, "points"),
        }


def _empty(value: Any) -> bool:
    return not value if isinstance(value, dict) else np.size(value) == 0


def _motion_row(stand: Stand, backend: Backend, judge: Judge, seed: int, until: float) -> Row:
    """Where the stand is in the end, by the C and by the judge, each integrated by itself."""
    state = moderate(stand, seed)
    row = Row(judge.name, motion_of(until), tolerance=MOTION_TOLERANCE)

    def coupled(moved: State) -> tuple[Vec6, tuple[float, ...]]:
        found = backend.evaluate(moved, ("coupled",))
        return found["V_dot"], found["phi_ddot"]

    request = Request("moderate", replace(state, wrench=MappingProxyType({})), ("coupled",))
    own, other = end_of_motion(stand, state, coupled, judge, until)
    for part, value in own.items():
        off, _ = difference(value.values, other[part].values, value.scale)
        if off > row.worst or not row.states:
            row.reason = part
        row.note(off, request, part)
    row.states = 1
    row.reason = "" if row.worst <= MOTION_TOLERANCE else row.reason
    return row
