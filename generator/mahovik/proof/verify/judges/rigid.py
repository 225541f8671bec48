"""The stand as outside judges take it, from raw data: rigid bodies, each in the frame of the one that bears it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any, Protocol, runtime_checkable

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from mahovik.contract import laws
from mahovik.core.stand.model import Body, Flywheel, MountingAngles, Stand
from mahovik.core.stand.state import State
from mahovik.errors import UsageError

Array = NDArray[np.float64]
Values = dict[str, Any]

SEQUENCES = {"ship": "ZYX", "aircraft": "YZX", "euler": "ZXZ"}
"""Names of SciPy; capitals: about moving axes."""


class JudgeError(UsageError):
    """An outside judge takes no stand of this kind."""


class StateJudge(Protocol):
    """A program of others with the model of one stand. Everything it returns is in the terms of docs/model.md."""

    name: str
    version: str

    def evaluate(self, state: State) -> Values:
        """K, I, bias (6), V_dot_forward, V_dot, phi_ddot of `tau`, base_wrench, tau, mount_wrench, points.

        Quantities that the program lacks are left out.
        """


@runtime_checkable
class MovingJudge(StateJudge, Protocol):
    """One that integrates by itself."""

    def move(self, state: State, seconds: float) -> tuple[Array, Array, Array, Array, Array]:
        """Position (3), C (3x3), V (6), phi (N), phi_dot (N) after a motion under the drive torques of the state."""


class OutsideJudge(StateJudge, Protocol):
    """One that gives rates, which are integrated for it."""

    def rates(self, y: Array, tau: Array) -> Array:
        """y' of a motion under drive torques, in the judge's own coordinates."""

    def own_coordinates(self, state: State) -> Array:
        """y of a state."""

    def pose_and_velocity(self, y: Array) -> tuple[Array, Array, Array, Array, Array]:
        """Position (3), C (3x3), V (6), phi (N), phi_dot (N) of y."""


@dataclass(frozen=True, eq=False)
class RigidBody:
    """A body in the frame of its parent: position (3), axes (3x3), central inertia (3x3) in its own axes.

    A flywheel turns about its first axis; the others are fixed. `parent` is None for the carrier.
    """

    name: str
    parent: str | None
    position: Array
    axes: Array
    mass: float
    center: Array
    inertia: Array
    turns: bool


@dataclass(frozen=True, eq=False)
class Frame:
    """An instrument or point: where it is read, in the frame of its mount."""

    name: str
    mount: str
    position: Array
    axes: Array


def free_answers(
    full: Array, bias: Array, phi_ddot: Array, accelerations: Array, forces: Array, mounts: Sequence[Array]
) -> Values:
    """Answers of a judge but for `points`, of its equations full (V_dot, phi_ddot) + bias = (0, tau).

    `accelerations`: (V_dot, phi_ddot) under the drive torques; `forces`: base wrench and tau of the state's motion.
    """
    K, I = full[:6, :6], full[:6, 6:]
    return {
        "K": K,
        "I": I,
        "bias": bias[:6],
        "V_dot_forward": np.linalg.solve(K, -bias[:6] - I @ phi_ddot),
        "V_dot": accelerations[:6],
        "phi_ddot": accelerations[6:],
        "base_wrench": forces[:6],
        "tau": forces[6:],
        "mount_wrench": np.array(mounts).reshape(-1, 6),
    }


def missing(stand: Stand) -> list[str]:
    """Features of the stand that no judge has."""
    found = []
    for body in stand.bodies:
        found += [f"{body.name}: added_mass"] * (getattr(body, "added_mass", None) is not None)
        found += [
            f"{body.name}: {text.NAME}"
            for text in laws.parts("text", laws.BODY_LAWS)
            if body.name in text.bearers(stand)
        ]
    found += ["stream"] * (stand.stream is not None)
    return found + [law.NAME for law in laws.parts("text") if law.short(stand)]


def bare_stand(stand: Stand) -> Stand:
    """The stand without what `missing` names."""

    def dry(body: Any) -> Any:
        return replace(body, laws=(), **({"added_mass": None} if hasattr(body, "added_mass") else {}))

    return replace(
        stand,
        stream=None,
        profile=None,
        laws=(),
        carrier=dry(stand.carrier),
        instruments=tuple(map(dry, stand.instruments)),
        flywheels=tuple(map(dry, stand.flywheels)),
    )


def tree(stand: Stand) -> tuple[RigidBody, ...]:
    """Carrier, instruments, flywheels: parents come first."""
    found = [_rigid(stand.carrier, None, np.zeros(3), np.eye(3))]
    for p in stand.instruments:
        found.append(_rigid(p, stand.carrier.name, np.array(p.position), _rotation(p.angles)))
    for s in stand.flywheels:
        found.append(_rigid(s, s.mount, np.array(s.position), _mounting_axes(s), turns=True))
    return tuple(found)


def mount_flywheel(body: RigidBody, bodies: Sequence[RigidBody]) -> RigidBody:
    """A flywheel in the frame of the carrier."""
    (mount,) = (each for each in bodies if each.name == body.parent)
    if mount.parent is None:
        return body
    place, axes = mount.position + mount.axes @ body.position, mount.axes @ body.axes
    return replace(body, parent=mount.parent, position=place, axes=axes)


def frames(stand: Stand) -> tuple[Frame, ...]:
    """Instruments, then points."""
    found = [Frame(p.name, p.name, np.zeros(3), np.eye(3)) for p in stand.instruments]
    return (*found, *(Frame(p.name, p.mount, np.array(p.position), _rotation(p.angles)) for p in stand.points))


def attitude(stand: Stand, state: State) -> Rotation:
    """C of the carrier."""
    if state.quaternion is not None:
        return Rotation.from_quat(state.quaternion, scalar_first=True)
    return Rotation.from_euler(SEQUENCES[stand.angles], state.angles or (0.0, 0.0, 0.0))


def about_first(angle: float) -> Array:
    """Rotation (3x3) about the first axis."""
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[1.0, 0.0, 0.0], [0.0, c, -s], [0.0, s, c]])


def quaternion_rate(q: Array, omega: Array) -> Array:
    """q' of a quaternion, w first, for omega in the body's axes."""
    w, v = q[0], q[1:]
    return np.concatenate([[-v @ omega], w * omega + np.cross(v, omega)]) / 2


def _rotation(angles: tuple[float, float, float]) -> Array:
    return np.asarray(Rotation.from_euler("ZYX", angles).as_matrix())


def _mounting_axes(s: Flywheel) -> Array:
    """Axes of a flywheel at phi_s = 0."""
    if isinstance(s.mounting, MountingAngles):
        return _rotation((s.mounting.psi, s.mounting.theta, s.mounting.zero))
    first = np.array(s.mounting.axis) / np.linalg.norm(s.mounting.axis)
    third = np.cross(first, s.mounting.zero)
    third /= np.linalg.norm(third)
    return np.column_stack([first, np.cross(third, first), third])


def _rigid(body: Body, parent: str | None, position: Array, axes: Array, turns: bool = False) -> RigidBody:
    c, J = np.array(body.center_of_mass), np.array(body.inertia)
    if body.inertia_about == "origin":
        J = J - body.mass * (float(c @ c) * np.eye(3) - np.outer(c, c))
    return RigidBody(body.name, parent, position, axes, body.mass, c, J, turns)
