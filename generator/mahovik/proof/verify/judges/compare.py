"""The generated C against outside judges: the equations state by state, then a free motion of some seconds."""

from __future__ import annotations

import importlib
from collections.abc import Callable, Sequence
from dataclasses import replace
from types import MappingProxyType
from typing import Any, cast

import numpy as np

from mahovik.core.stand.definite import least_eigenvalue
from mahovik.core.stand.model import Stand, Vec3, Vec6
from mahovik.core.stand.physical import LEAST_EIGENVALUE
from mahovik.core.stand.random_state import random_state
from mahovik.core.stand.state import Quaternion, State
from mahovik.errors import UsageError
from mahovik.proof import reference
from mahovik.proof.verify.backends import Backend
from mahovik.proof.verify.bounds import DOUBLE
from mahovik.proof.verify.c_backend import CBackend
from mahovik.proof.verify.check import Check, difference
from mahovik.proof.verify.draw import draw
from mahovik.proof.verify.harness import Progress, report
from mahovik.proof.verify.judges.held import HeldJudge, compare_held
from mahovik.proof.verify.judges.rigid import (
    Array,
    JudgeError,
    MovingJudge,
    OutsideJudge,
    Values,
    attitude,
    bare_stand,
    missing,
    quaternion_rate,
)
from mahovik.proof.verify.report import Report
from mahovik.proof.verify.scales import scales
from mahovik.proof.verify.scales.magnitudes import Magnitudes
from mahovik.proof.verify.states import Request

UNTIL = 2.0
"""Duration of the published motions, s. A judge that is broken on purpose differs sooner."""

INTEGRATION = 1e-13
"""Relative tolerance of a step of either integration."""

MOTION_TOLERANCE = 1e-10
"""A thousand steps of 1e-13 each, on two sides."""

SPEED, ACCELERATION = 20.0, 10.0
"""rad/s, rad/s2 of the flywheels: some turns in the time."""


def motion_start(stand: Stand, seed: int) -> State:
    """A state from which 1e-13 a step is kept up: speeds of some turns in the time, torques to match."""
    rng = np.random.default_rng(seed)
    state = random_state(stand, rng)
    inertia = np.diag(reference.pieces(stand, state).Theta_ff)
    N = len(stand.flywheels)
    speeds = rng.uniform(0.3, 1.0, N) * rng.choice([-1.0, 1.0], N) * SPEED
    torques = rng.uniform(-1.0, 1.0, N) * ACCELERATION * inertia
    return replace(
        state, phi_dot=tuple(map(float, speeds)), tau=tuple(map(float, torques)), wrench=MappingProxyType({})
    )


def end_of_motion(
    stand: Stand,
    state: State,
    coupled: Callable[[State], tuple[Vec6, tuple[float, ...]]],
    judge: OutsideJudge | MovingJudge,
    until: float = UNTIL,
) -> dict[str, tuple[Array, Array, Array]]:
    """Parts of the state after `until` s: by `coupled` (V* and phi'' of a state), by the judge, and their scale."""
    tau = np.array(state.tau)
    turn = attitude(stand, state).as_quat(scalar_first=True)
    begin = np.concatenate([state.position, turn, state.V, state.phi, state.phi_dot])
    N = len(tau)

    def rates(y: Array) -> Array:
        q = y[3:7] / np.linalg.norm(y[3:7])
        V, phi, phi_dot = y[7:13], y[13 : 13 + N], y[13 + N :]
        moved = replace(
            state,
            position=cast(Vec3, tuple(y[:3].tolist())),
            angles=None,
            quaternion=cast(Quaternion, tuple(q.tolist())),
            V=cast(Vec6, tuple(V.tolist())),
            phi=tuple(phi.tolist()),
            phi_dot=tuple(phi_dot.tolist()),
        )
        V_dot, phi_ddot = coupled(moved)
        return np.concatenate([_matrix(q) @ V[:3], quaternion_rate(q, V[3:]), V_dot, phi_dot, phi_ddot])

    y = integrate(rates, begin, until)
    q = y[3:7] / np.linalg.norm(y[3:7])
    own = (y[:3], _matrix(q), y[7:13], y[13 : 13 + N], y[13 + N :])
    if isinstance(judge, MovingJudge):
        other = judge.move(state, until)
    else:
        theirs = integrate(lambda y: judge.rates(y, tau), judge.own_coordinates(state), until)
        other = judge.pose_and_velocity(theirs)
    names = ("position", "C", "V", "phi", "phi_dot")
    return dict(zip(names, zip(own, other, _motion_scales(own, until), strict=True), strict=True))


def integrate(rates: Callable[[Array], Array], begin: Array, until: float = UNTIL) -> Array:
    """y after `until` s."""
    from scipy.integrate import solve_ivp  # slow to import, and not all who compare states integrate

    options: dict[str, Any] = {"method": "DOP853", "rtol": INTEGRATION, "atol": INTEGRATION}
    found = solve_ivp(lambda _, y: rates(y), (0.0, until), begin, **options)
    return np.asarray(found.y[:, -1])


def _motion_scales(own: tuple[Array, ...], until: float) -> tuple[Array, ...]:
    """Scales: ways and turns by how far things move in the time, velocities by the fastest of them."""
    position, C, V, phi, phi_dot = own
    v, omega = float(np.linalg.norm(V[:3])), float(np.linalg.norm(V[3:]))
    spin = float(np.abs(phi_dot).max(initial=0.0)) + omega
    return (
        np.full(3, float(np.linalg.norm(position)) + v * until),
        np.full_like(C, 1.0 + spin * until),
        np.repeat([v, omega + spin], 3),
        np.full_like(phi, 1.0 + spin * until),
        np.full_like(phi_dot, spin),
    )


def _matrix(q: Array) -> Array:
    """C (3x3) of a unit quaternion, w first."""
    w, v = q[0], q[1:]
    cross = np.array([[0.0, -v[2], v[1]], [v[2], 0.0, -v[0]], [-v[1], v[0], 0.0]])
    return np.asarray(np.eye(3) + 2.0 * w * cross + 2.0 * cross @ cross)


JUDGES = {
    "pinocchio": ("mahovik.proof.verify.judges.pinocchio_judge", "PinocchioJudge"),
    "mujoco": ("mahovik.proof.verify.judges.mujoco_judge", "MujocoJudge"),
}
"""Module and class of every judge, imported on demand."""

HELD = {
    "pinocchio": ("mahovik.proof.verify.judges.held_pinocchio", "HeldPinocchio"),
    "mujoco": ("mahovik.proof.verify.judges.held_mujoco", "HeldMujoco"),
}
"""Module and class of every judge of held carriers."""

PARTIAL = {
    "basilisk": ("mahovik.proof.verify.judges.basilisk_judge", "BasiliskJudge", "pip install bsk"),
    "basilisk rotors": ("mahovik.proof.verify.judges.basilisk_rotor", "BasiliskRotorJudge", "pip install bsk"),
}
"""Judges of some stands only, not required. If one is missing or refuses the stand, its row reads `not compared`."""

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
"""Compared quantities, in words."""

ALL = (*JUDGES, *PARTIAL)

Judge = OutsideJudge | MovingJudge


def motion_name(seconds: float) -> str:
    """The motion as a quantity, in words."""
    return f"free motion of {seconds:g} s"


MOTION = motion_name(UNTIL)


def load_judges(stand: Stand, names: Sequence[str] = tuple(JUDGES)) -> list[Judge]:
    """The judges with the model of the stand. UsageError: not installed.

    Raises JudgeError, which is one, where the stand has what the judges lack, or a judge takes no such bodies.
    """
    found = missing(stand)
    if found:
        raise JudgeError(
            f"--judges: Pinocchio and MuJoCo know rigid bodies on joints, and not {', '.join(found)}; "
            f"--bare judges the stand without {'them' if len(found) > 1 else 'it'}"
        )
    if not any(body.mass > 0.0 for body in stand.bodies):
        raise JudgeError("--judges: no body of the stand has a mass")
    return [_load(stand, name) for name in names]


def _load(stand: Stand, name: str) -> Judge:
    if stand.hold is not None and name not in HELD:
        raise JudgeError(f"--judges: {name} judges free carriers only")
    module, kind, *install = (JUDGES if stand.hold is None else HELD).get(name) or PARTIAL[name]
    try:
        judge = getattr(importlib.import_module(module), kind)
        return cast(Judge, judge(stand))
    except (ValueError, RuntimeError) as error:
        raise JudgeError(f"--judges: {name} refuses this stand: {error}") from None
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
    """Checks of every judge and quantity: generated C against the judge, relative to the natural scale.

    A judge that refuses the stand has one row that says why; if all do, nothing was compared and the report does not
    pass. `bare`: of the stand without what no judge has; the report names it. `until`: s, of the free motion.
    A held carrier is judged state by state, with the joint itself, and without a motion.
    """
    if bare:
        if (lacking := missing(stand)) and least_eigenvalue(bare_stand(stand))[0] < LEAST_EIGENVALUE:
            reason = f"the stand without {', '.join(lacking)} has no positive definite mass matrix"
            return _without_judges(stand, [_skipped_row(name, reason) for name in names], seed, count)
        found = verify_judges(bare_stand(stand), seed=seed, count=count, names=names, until=until, progress=progress)
        return replace(found, left_out=tuple(missing(stand)))
    judges, absent = [], []
    for name in names:
        try:
            judges += load_judges(stand, [name]) if name in JUDGES else [_load(stand, name)]
        except UsageError as error:
            if name in JUDGES and not isinstance(error, JudgeError):
                raise
            absent.append(_skipped_row(name, str(error).removeprefix("--judges: ")))
    if not judges:
        return _without_judges(stand, absent, seed, count)
    found = compare_with_judges(stand, judges, seed=seed, count=count, until=until, progress=progress)
    return replace(found, rows=(*found.rows, *absent))


def _skipped_row(judge: str, reason: str) -> Check:
    """The row of a judge that does not take the stand."""
    return Check(judge, "all quantities", words=reason)


def _without_judges(stand: Stand, skipped: Sequence[Check], seed: int, count: int) -> Report:
    """Report on a stand that no judge takes."""
    who = ", ".join(row.judged for row in skipped)
    return report(stand, f"generated C against {who}", seed, count, DOUBLE.default, list(skipped))


def compare_with_judges(
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
    """Checks of judges that have the stand already.

    `backend`: what is judged, where that is not fresh C; `judged`: its name. `until` 0: no free motion, of which a
    held carrier has none.
    """
    backend = backend or CBackend(stand)
    who = ", ".join(f"{judge.name} {judge.version}" for judge in judges)
    if stand.hold is not None:
        drawn = [(name, near_origin(state)) for name, state in draw(stand, seed, count)]
        held = compare_held(stand, cast(list[HeldJudge], judges), backend, drawn, progress)
        return report(stand, f"{judged} against {who}", seed, count, DOUBLE.default, held)
    rows = {
        (judge.name, key): Check(judge.name, words, DOUBLE.default)
        for judge in judges
        for key, words in QUANTITIES.items()
    }
    states = draw(stand, seed, count)
    for done, (name, given) in enumerate(states):
        state = near_origin(given)
        own, natural = judged_values(backend, state), natural_scales(stand, state)
        request = Request(name, state, ("matrices", "forward", "torque", "mounts", "points"))
        for judge in judges:
            for key, value in judge.evaluate(state).items():
                if _empty(value):
                    continue  # no flywheels, no points: nothing to agree on
                off, reason = difference(own[key], value, natural[key])
                rows[judge.name, key].note(off, name, reason, request)
        if progress is not None:
            progress(done + 1, len(states))
    moved = [_motion_row(stand, backend, judge, seed, until) for judge in judges if until > 0.0]
    noted = [row for row in (*rows.values(), *moved) if row.states]
    ordered = [row for judge in judges for row in noted if row.judged == judge.name]
    return report(stand, f"{judged} against {who}", seed, count, DOUBLE.default, ordered)


def near_origin(state: State) -> State:
    """The state with the carrier near the origin of E0, and no speed that overflows a judge's range."""
    position = np.array(state.position)
    away = float(np.linalg.norm(position))
    if away > NEAR:
        position *= NEAR / away
    return replace(state, position=cast(Vec3, tuple(map(float, position))))


def judged_values(backend: Backend, state: State) -> Values:
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


def _motion_row(stand: Stand, backend: Backend, judge: Judge, seed: int, until: float) -> Check:
    """Where the stand is in the end, by the C and by the judge, each integrated by itself."""
    state = motion_start(stand, seed)
    row = Check(judge.name, motion_name(until), MOTION_TOLERANCE)

    def coupled(moved: State) -> tuple[Vec6, tuple[float, ...]]:
        found = backend.evaluate(moved, ("coupled",))
        return found["V_dot"], found["phi_ddot"]

    request = Request("moderate", replace(state, wrench=MappingProxyType({})), ("coupled",))
    for part, (own, other, scale) in end_of_motion(stand, state, coupled, judge, until).items():
        off, _ = difference(own, other, scale)
        row.note(off, "moderate", part, request)
    row.states = 1
    row.words = row.words if row.failed else ""
    return row
