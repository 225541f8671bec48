"""Values of signals of many samples, from what was observed."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from mahovik.core.lower.law_arrays import ties
from mahovik.core.stand.model import Stand
from mahovik.core.stand.structure import structure
from mahovik.out.campaign.observe import Chunk
from mahovik.out.campaign.pose import (
    Array,
    compose,
    conjugate,
    cross,
    rotation,
    rotation_vector,
    turn,
    turn_back,
)
from mahovik.out.campaign.required import Required
from mahovik.out.campaign.signals import AXES, EVERY, HOLD, SIGNALS, sensors


@dataclass(frozen=True, eq=False)
class Frame:
    """A point on the carrier of each sample: place r (3, n; m) from O1, axes A (3, 3, n), both in E1."""

    r: Array
    A: Array


@dataclass(frozen=True, eq=False)
class Scene:
    """References from which the signals of n samples are measured.

    start    states (13 + 2 N, n) at the start
    frames   of the points and instruments, by name, and of the carrier
    laws     numbers of the laws, by member of a table
    required  what the carrier should do, of a programme
    """

    stand: Stand
    start: Array
    frames: Mapping[str, Frame]
    laws: Mapping[str, Any]
    required: Required | None = None

    @property
    def attitude(self) -> Array:
        """Quaternions at the start (4, n)."""
        return self.start[3:7]


def frames_of(stand: Stand, start: Array, readings: Array | None) -> dict[str, Frame]:
    """Frames of all points from what `points` gives at the start (24 S, n); of the carrier alone where there are none.

    readings: of each sensor position (3), C (9), twist (6), specific force (3), angular acceleration (3).
    """
    n = start.shape[1]
    C = rotation(start[3:7])
    found = {stand.carrier.name: Frame(np.zeros((3, n)), np.repeat(np.eye(3)[:, :, None], n, axis=2))}
    for k, name in enumerate(sensors(stand) if readings is not None else ()):
        own = readings[24 * k : 24 * k + 24] if readings is not None else np.zeros((24, n))
        axes = own[3:12].reshape(3, 3, n)
        A = np.stack([turn_back(C, axes[:, j]) for j in range(3)], axis=1)
        found[name] = Frame(turn_back(C, own[:3] - start[:3]), A)
    return found


@dataclass(frozen=True)
class Signal:
    """A signal of a stand: its name in SIGNALS, what it belongs to, and the axis; "" for its length."""

    name: str
    part: str
    axis: str

    @property
    def components(self) -> int:
        """Numbers at each time: three where the length of a vector counts."""
        return 3 if SIGNALS[self.name].vector and not self.axis else 1

    def values(self, scene: Scene, at: Chunk, turned: bool) -> Array:
        """Values (K, c, n). Without `turned` the axes of a vector are any: its length is right."""
        found = _SOURCES[self.name](self, scene, at, turned or bool(self.axis))
        if self.axis and SIGNALS[self.name].vector:
            i = AXES.index(self.axis)
            return found[:, i : i + 1]
        return found


def _on_axes(scene: Scene, frame: Frame, C: Array, v: Array) -> Array:
    """A vector in E1 on the axes that the point has at the start."""
    return turn_back(frame.A, turn_back(rotation(scene.attitude), turn(C, v)))


def _acceleration(own: Signal, scene: Scene, at: Chunk, turned: bool) -> Array:
    frame, omega, found = scene.frames[own.part], at.V[:, 3:], at.V_dot[:, :3]
    if own.part == scene.stand.carrier.name:
        found = found + cross(omega, at.V[:, :3])
    else:
        found = found + cross(omega, at.V[:, :3] + cross(omega, frame.r)) + cross(at.V_dot[:, 3:], frame.r)
    return _on_axes(scene, frame, at.C, found) if turned else found


def _velocity(own: Signal, scene: Scene, at: Chunk, turned: bool) -> Array:
    frame = scene.frames[own.part]
    found = at.V[:, :3] + cross(at.V[:, 3:], frame.r)
    return _on_axes(scene, frame, at.C, found) if turned else found


def _displacement(own: Signal, scene: Scene, at: Chunk, turned: bool) -> Array:
    frame = scene.frames[own.part]
    begin = rotation(scene.attitude)
    found = (at.position - scene.start[:3]) + (turn(at.C, frame.r) - turn(begin, frame.r))
    return turn_back(frame.A, turn_back(begin, found)) if turned else found


def _rotation(own: Signal, scene: Scene, at: Chunk, turned: bool) -> Array:
    found = rotation_vector(compose(conjugate(scene.attitude), at.attitude))
    return turn_back(scene.frames[own.part].A, found) if turned else found


def _rate(own: Signal, scene: Scene, at: Chunk, turned: bool) -> Array:
    return turn_back(scene.frames[own.part].A, at.V[:, 3:]) if turned else at.V[:, 3:]


def _specific_force(own: Signal, scene: Scene, at: Chunk, turned: bool) -> Array:
    k = 24 * sensors(scene.stand).index(own.part) + 18
    return at.readings[:, k : k + 3]


def _load(own: Signal, scene: Scene, at: Chunk, turned: bool) -> Array:
    first = 0 if own.name == "force" else 3
    if own.part == HOLD and scene.stand.hold is not None:
        return at.reaction[:, first : first + 3]
    names = [s.name for s in scene.stand.flywheels]
    if own.part in names:
        k = 6 * names.index(own.part) + first
        return at.loads[:, k : k + 3]
    of_stand = structure(scene.stand)
    rows = at.C.reshape(*at.C.shape[:-3], 9, at.C.shape[-1])
    found = ties(of_stand)[own.part].wrench(of_stand, scene.laws, (at.position, at.attitude, at.V, rows))
    return found[:, first : first + 3]


def _of_flywheels(own: Signal, scene: Scene, values: Array) -> Array:
    if own.part == EVERY:
        return np.asarray(np.abs(values).max(axis=1, keepdims=True))
    k = [s.name for s in scene.stand.flywheels].index(own.part)
    return values[:, k : k + 1]


def _torque(own: Signal, scene: Scene, at: Chunk, turned: bool) -> Array:
    return _of_flywheels(own, scene, at.tau)


def _power(own: Signal, scene: Scene, at: Chunk, turned: bool) -> Array:
    return _of_flywheels(own, scene, at.tau * at.phi_dot)


def _speed(own: Signal, scene: Scene, at: Chunk, turned: bool) -> Array:
    return _of_flywheels(own, scene, at.phi_dot)


def _sigma(own: Signal, scene: Scene, at: Chunk, turned: bool) -> Array:
    K, _, n = at.I.shape
    finite = np.where(np.isfinite(at.I), at.I, 0.0)
    matrices = np.moveaxis(finite.reshape(K, 6, -1, n), -1, 1)
    return np.asarray(np.linalg.svd(matrices, compute_uv=False)[..., -1][:, None])


def _error(own: Signal, scene: Scene, at: Chunk, turned: bool) -> Array:
    assert scene.required is not None
    return scene.required.error(at, own.axis)


_SOURCES: Mapping[str, Callable[[Signal, Scene, Chunk, bool], Array]] = {
    "acceleration": _acceleration,
    "velocity": _velocity,
    "displacement": _displacement,
    "rotation": _rotation,
    "rate": _rate,
    "specific_force": _specific_force,
    "force": _load,
    "moment": _load,
    "torque": _torque,
    "power": _power,
    "speed": _speed,
    "sigma": _sigma,
    "error": _error,
}
