"""Poses and speeds of a held carrier: home, starts, what the hold does not allow; steps that are too long or too short.

A step should be shorter than friction needs. In float it should not be so short that it is lost: `step` adds an
increment to a speed, and float rounds the sum by up to half a unit of its last place. Under a constant torque the
rounding is the same in step after step, so that its part of the increment is the part of the motion that is lost; an
increment below half a unit is lost whole. A carry keeps what is lost.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import cast

import numpy as np

from mahovik.core.stand.hold import carried_point, is_closed, twist_of, twists
from mahovik.core.stand.law import CarrierLaw
from mahovik.core.stand.masses import inertia_about_origin
from mahovik.core.stand.model import Hold, Stand, State, Vec3, rest_state
from mahovik.errors import UsageError
from mahovik.proof.reference import pieces
from mahovik.proof.reference.algebra import Array, cross, quaternion_rotation, rotation_vector
from mahovik.proof.verify.draw import ALLOWED, freedoms, home_attitude, quaternion_of, with_quaternion, worst
from mahovik.use.numeric.se3 import left_jacobian


def rates(hold: Hold | None, V: Sequence[float] | Array) -> tuple[float, ...]:
    """u (m) of V = S u (6); of another V the nearest; () of a free carrier, whose states have V alone."""
    S = twists(hold) if hold is not None else np.zeros((6, 0))
    return tuple(np.linalg.lstsq(S, np.array(V), rcond=None)[0].tolist()) if S.shape[1] else ()


def home(stand: Stand) -> State:
    """The state at rest in the home pose: all freedoms are zero. Of a free carrier the origin of E0."""
    state = rest_state(stand)
    if stand.hold is None:
        return replace(state, quaternion=(1.0, 0.0, 0.0, 0.0))
    return replace(state, position=stand.hold.position, quaternion=home_attitude(stand))


def move(state: State, C: Array, step: Array) -> State:
    """The state moved by exp(step), a twist in E1 (6; m, rad): along its screw, so that a closed set is not left."""
    along = left_jacobian(step[None, 3:])[0]
    turned = C @ (np.eye(3) + cross(step[3:]) @ along)  # exp of a rotation vector
    position = np.array(state.position) + C @ (along @ step[:3])
    return replace(state, position=cast(Vec3, tuple(position.tolist())), angles=None, quaternion=quaternion_of(turned))


def displacement(start: State, C: Array, state: State) -> Array:
    """The twist in E1 (6; m, rad) along whose screw `move` leads from a start to a state of attitude C."""
    C0 = quaternion_rotation(*(start.quaternion or (1.0, 0.0, 0.0, 0.0)))
    turned = rotation_vector(C0.T @ C)
    moved = C0.T @ (np.array(state.position) - np.array(start.position))
    return np.concatenate([np.linalg.solve(left_jacobian(turned[None])[0], moved), turned])


def allowed_start(stand: Stand, state: State) -> State:
    """The start of a stand, with u of a held carrier; UsageError where the hold does not allow its V or its pose."""
    hold = stand.hold
    if hold is None:
        return state
    if len(state.u) != len(hold.freedoms):
        state = replace(state, u=rates(hold, state.V))
    off = np.array(state.V) - np.array(twist_of(hold, state.u))
    if np.abs(off).max() > ALLOWED * max(1.0, float(np.abs(state.V).max())):
        raise UsageError(f"start: V moves along {worst(off)}, which [hold] blocks; expected u of {freedoms(hold)}")
    turned = with_quaternion(stand, state).quaternion
    if reason := blocked_pose(stand, np.array(state.position), np.array(turned)):
        raise UsageError(f"start: {reason}")
    return state


def place_at(stand: Stand, attitude: Array) -> Array:
    """O1 in E0 (3, or n x 3; m), where the hold has a carrier of this attitude (4, or n x 4) that did not slide."""
    hold = stand.hold
    assert hold is not None
    arm = _rotate(np.array(home_attitude(stand)), np.array(hold.pivot)) - _rotate(attitude, np.array(hold.pivot))
    return np.asarray(np.array(hold.position) + arm)


def blocked_pose(stand: Stand, position: Array, attitude: Array) -> str:
    """Why a hold does not allow poses, in words; "" where it does. Of a set that is not closed all are allowed.

    position: m, in E0, (3) or (n, 3); attitude: quaternions, w first, (4) or (n, 4)
    """
    hold = stand.hold
    assert hold is not None
    if not shows_freedoms(hold):
        return ""
    back = np.array(home_attitude(stand)) * np.array([1.0, -1.0, -1.0, -1.0])
    pivot, slides = map(np.array, carried_point(hold))
    gone = position - np.array(hold.position) + _rotate(attitude, pivot)
    way = np.atleast_2d(_rotate(back, gone) - pivot)
    # twice the vector part of the quaternion from home
    turned = 2.0 * (back[0] * attitude[..., 1:] + attitude[..., :1] * back[1:] + np.cross(back[1:], attitude[..., 1:]))
    turns = np.array([twists(hold)[3:, k] for k, freedom in enumerate(hold.freedoms) if freedom.kind == "turn"])
    way, turned = np.broadcast_arrays(way - way @ slides.T, turned - (turned @ turns.T @ turns if len(turns) else 0.0))
    off = np.concatenate([way, turned], axis=1)
    far = np.flatnonzero(
        np.abs(off).max(axis=1) > ALLOWED * np.maximum(1.0, np.abs(np.atleast_2d(position)).max(axis=1))
    )
    if not len(far):
        return ""
    first = off[far[0]]
    k = int(np.argmax(np.abs(first)))
    which = f" of state {far[0]}" if len(off) > 1 else ""
    expected = f"what {freedoms(hold)} reach, or no position" if hold.freedoms else "the home pose, as clamped"
    return (
        f"position, attitude{which}: off by {abs(first[k]):.3g} {'m' if k < 3 else 'rad'} along {worst(first)}, "
        f"which [hold] blocks; expected {expected}"
    )


def _rotate(attitude: Array, vector: Array) -> Array:
    """C x of unit quaternions."""
    axis = attitude[..., 1:]
    cross_product = 2.0 * np.cross(axis, vector)
    return np.asarray(vector + attitude[..., :1] * cross_product + np.cross(axis, cross_product))


def shows_freedoms(hold: Hold) -> bool:
    """Whether a pose shows its freedoms: of a closed set, but not of a screw, whose turns a pose does not count."""
    return is_closed(hold) and all(freedom.kind != "twist" for freedom in hold.freedoms)


@dataclass(frozen=True)
class LongStep:
    """A freedom whose friction a step of `dt` (s) does not resolve; it should be shorter than `bound` (s)."""

    freedom: str
    dt: float
    bound: float

    def __str__(self) -> str:
        return (
            f"friction of {self.freedom}: a step of {self.dt:g} s is not shorter than {self.bound:.2g} s, inertia "
            "times smoothing over breakaway: use shorter steps, or a larger smoothing"
        )


def long_steps(stand: Stand, dt: float, has_speed_law: Sequence[bool] = ()) -> list[LongStep]:
    """Freedoms whose friction steps of `dt` (s) do not resolve.

    has_speed_law  flywheels whose speed is given, so that they do not give way; default: none
    """
    laws = [law for law in stand.laws if isinstance(law, CarrierLaw)]
    if stand.hold is None or not any(law.longest_steps([1.0] * len(stand.hold.freedoms)) for law in laws):
        return []
    loose = [k for k in range(len(stand.flywheels)) if not (has_speed_law and has_speed_law[k])]
    inertias = _smallest_inertias(stand, loose)
    bounds = [step for law in laws for step in law.longest_steps(inertias)]
    return [LongStep(name, dt, bound) for name, bound in bounds if dt >= bound]


def _smallest_inertias(stand: Stand, loose: Sequence[int]) -> list[float]:
    """Inertia (kg, kg m2) along each freedom in the home pose, where all that is free besides gives way.

    That is 1 / (M^-1)_ii of M = [[S^T K S, S^T I], [I^T S, Theta_ff]].

    loose  places of the flywheels whose speed is not given
    """
    assert stand.hold is not None
    at, S = pieces(stand, home(stand)), twists(stand.hold)
    across, inertias = S.T @ at.I[:, loose], at.Theta_ff[np.ix_(loose, loose)]
    mobility = np.linalg.pinv(np.block([[S.T @ at.K @ S, across], [across.T, inertias]]), hermitian=True)
    return [1.0 / float(x) for x in np.diag(mobility)[: S.shape[1]]]


PART = 1e-3
"""Part of an increment that may be lost without a warning."""

USUAL_STEP = 1e-4
"""s: a step that is looked at where no other is asked for."""

RUN_UP = 10.0
"""s: time in which a motor without a known torque reaches its speed."""


@dataclass(frozen=True)
class LostIncrement:
    """A flywheel whose speed loses increments in float steps of `dt`.

    dt           s
    speed        rad/s
    increment    of the speed in a step, rad/s, by the torque of its motor or, without one, a run-up in RUN_UP
    rounding     largest of the sum, rad/s
    lost_torque  N m; torques below it change nothing at all
    """

    flywheel: str
    dt: float
    speed: float
    increment: float
    rounding: float
    lost_torque: float

    @property
    def part(self) -> float:
        """The largest part of an increment that is lost."""
        return min(1.0, self.rounding / self.increment)

    def __str__(self) -> str:
        return (
            f"float: a step of {self.dt:g} s adds {self.increment:.1e} rad/s to {self.flywheel} and rounds its speed "
            f"at {self.speed * 30 / math.pi:.5g} rpm by up to {self.rounding:.1e} rad/s: up to {100 * self.part:.3g} % "
            f"is lost, and all of a torque below {self.lost_torque:.2g} N m: give step a carry, or take double"
        )


def lost_increments(stand: Stand, speeds: Sequence[float], dt: float) -> list[LostIncrement]:
    """Flywheels that lose more than PART of an increment in float steps of `dt` (s) at these speeds (rad/s)."""
    result = []
    for flywheel, speed in zip(stand.flywheels, speeds, strict=True):
        J, motor = float(inertia_about_origin(flywheel)[0, 0]), flywheel.motor
        acceleration = motor.peak / J if motor and motor.peak else speed / RUN_UP
        rounding = 0.5 * float(np.spacing(np.float32(speed)))
        if speed > 0.0 and rounding > PART * acceleration * dt:
            lost = LostIncrement(flywheel.name, dt, speed, acceleration * dt, rounding, rounding / dt * J)
            result.append(lost)
    return result


def lost_increments_line(lost: Sequence[LostIncrement]) -> str:
    """One line on all flywheels that lose increments in steps of one length; empty without any."""
    if not lost:
        return ""
    worst = max(lost, key=lambda increment: increment.part)
    more = f" (and {len(lost) - 1} more)" if len(lost) > 1 else ""
    return (
        f"float: steps of {worst.dt:g} s lose up to {100 * worst.part:.3g} % of what they add to the speed of "
        f"{worst.flywheel}{more}: give step a carry, or take double; `mahovik check` judges another dt"
    )
