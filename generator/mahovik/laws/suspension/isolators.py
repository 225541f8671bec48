"""`[[isolator]]` of a stand file: air springs and rubber mounts, summed into the matrices of the suspension.

An isolator has a stiffness and a damping along each of its axes, at a point of the carrier. To first order in the
displacement x of the suspension it moves by T x, T = [E, -(r x)], and its force there is -A k A^T (T x). So the
suspension has the stiffness sum of T^T A k A^T T. Sums are in a fixed order, and sines and cosines rounded correctly:
a stand has the same bits on every machine.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Annotated, Any, ClassVar, cast

import numpy as np

from mahovik.core.stand import units
from mahovik.core.stand.columns import by_sample, polar
from mahovik.core.stand.declare import Declared
from mahovik.core.stand.fields import (
    ZERO3,
    Angle3,
    Length3,
    Mat6,
    Name,
    Vec3,
    require_bounds,
    scalar,
    validator,
    vector,
)
from mahovik.core.stand.hold import TWIST_NAMES, twists
from mahovik.core.stand.masses import cross
from mahovik.core.stand.model import Flywheel, Stand
from mahovik.core.stand.model import Sequence as AngleSequence
from mahovik.core.stand.tables import Default, QuantityValidator
from mahovik.core.stand.units import Dimension, QuantityError

Rows = list[list[float]]

SOFT, LEFT = 1e-12, 1e-9
"""At unit diagonal: stiffness along a direction below which it carries nothing; part of the weight that may be left."""

_AXES = {"ship": (2, 1, 0), "aircraft": (1, 2, 0), "euler": (2, 0, 2)}
"""Axes that psi, theta, phi turn about."""


def _along_axes(dimension: Dimension) -> QuantityValidator:
    """A validator of three numbers of at least zero."""

    def read(raw: object) -> tuple[float, ...]:
        if isinstance(raw, dict) and {"ratio", "loss"} & raw.keys():
            key = next(key for key in ("ratio", "loss") if key in raw)
            raise QuantityError(f"expected 3 numbers; {key} is a key beside it: {key} = {raw[key]}")
        values = vector(raw, (3,), dimension)
        for i, value in enumerate(values):
            try:
                require_bounds(value, dimension.si, least=0.0)
            except QuantityError as error:
                raise QuantityError(f"[{i}]: {error}") from None
        return values

    return validator(read, dimension, least=0.0)


@dataclass(frozen=True)
class Isolator(Declared):
    """A spring with damping between E0 and a point of the carrier.

    name       a name of its own, for messages and paths such as `rear.stiffness[2]`
    position   where it bears the carrier, in `E1`
    stiffness  along its three axes
    damping    along its three axes; or one of the next two
    ratio      of critical damping: `2 ratio sqrt(k m)`, with the mass `m` that it bears at rest
    loss       loss factor at resonance: a ratio of `loss / 2`
    angles     psi, theta, phi of its axes `C3 C2 C1` in `E1`
    """

    name: Name
    position: Length3
    stiffness: Annotated[Vec3, _along_axes(units.STIFFNESS)]
    damping: Annotated[Vec3 | None, _along_axes(units.LINEAR_DAMPING), Default(None)] = None
    ratio: Annotated[float | None, scalar(units.PLAIN, least=0.0), Default(None)] = None
    loss: Annotated[float | None, scalar(units.PLAIN, least=0.0), Default(None)] = None
    angles: Annotated[Angle3, Default(ZERO3)] = ZERO3

    instead: ClassVar[Mapping[str, str]] = {
        **dict.fromkeys(("zeta", "damping_ratio"), "`ratio` is that of critical damping"),
        "Q": "`loss` is 1 / Q",
    }

    @property
    def damping_ratio(self) -> float | None:
        """Its damping as a part of critical; None where it is given in N s/m, or not at all."""
        return self.ratio if self.loss is None else 0.5 * self.loss


@dataclass(frozen=True)
class Summed:
    """What a suspension takes of its isolators: matrices about O1 in E1 axes, SI, and its equilibrium in E0."""

    stiffness: Mat6
    damping: Mat6
    position: Vec3
    angles: Vec3


def summed(isolators: Sequence[Isolator], preload: bool, stand: Stand) -> Summed:
    """The suspension that isolators make under a stand; numbers may be columns.

    `preload`: springs balance weight and buoyancy in the pose that the file gives. Raises QuantityError with the place
    and the reason where they cannot.
    """
    for isolator in isolators:
        keys = [key for key in ("damping", "ratio", "loss") if getattr(isolator, key) is not None]
        if len(keys) > 1:
            raise QuantityError(f"isolator {isolator.name}", keys[1], f"given beside {keys[0]}: expected one of them")
    return by_sample(lambda of: _summed(*of), (tuple(isolators), preload, stand))


def _summed(isolators: Sequence[Isolator], preload: bool, stand: Stand) -> Summed:
    """The suspension of one stand, whose numbers are floats. Raises QuantityError."""
    K, home = _matrix(isolators, lambda isolator: isolator.stiffness), _home(stand)
    gravity = [g[0] for g in _times(_transposed(home), _column(stand.gravity))]
    bearing = preload or any(isolator.damping_ratio is not None for isolator in isolators)
    x = _displacement(K, _weight(stand, gravity), stand) if bearing else [0.0] * 6
    damping = {isolator.name: _damping(isolator, x, gravity) for isolator in isolators}
    D = _matrix(isolators, lambda isolator: damping[isolator.name])
    position, angles = (ZERO3, ZERO3) if stand.hold is None else (stand.hold.position, stand.hold.angles)
    if preload:
        turn = math.sqrt(math.fsum(a * a for a in x[3:]))
        if not turn <= 1.0:  # it may be no number
            raise QuantityError("suspension", "preload", f"springs would turn by {turn:.3g} rad, expected at most 1")
        _require_stable(K, x, gravity, stand)
    if preload and any(x):
        shift = _times(home, _column(x[:3]))
        position = cast(Vec3, tuple(p - s[0] for p, s in zip(position, shift, strict=True)))
        angles = _angles(_times(home, _rotation([-a for a in x[3:]])), stand.angles)
    stiffness, damping6 = (cast(Mat6, tuple(map(tuple, A))) for A in (K, D))
    return Summed(stiffness, damping6, position, angles)


def _matrix(isolators: Sequence[Isolator], numbers: Callable[[Isolator], Vec3]) -> Rows:
    """Sum of T^T A diag(k) A^T T (6x6): each isolator's numbers k along its axes."""
    total = [[0.0] * 6 for _ in range(6)]
    for isolator in isolators:
        A, T = _product_of_turns(isolator.angles, (2, 1, 0)), _at(isolator.position)
        columns = _times(_transposed(A), T)
        for i in range(6):
            for j in range(6):
                total[i][j] += math.fsum(columns[n][i] * k * columns[n][j] for n, k in enumerate(numbers(isolator)))
    return total


def _damping(isolator: Isolator, x: Sequence[float], gravity: Sequence[float]) -> Vec3:
    """Damping of an isolator along its axes, N s/m, where the suspension is displaced by x at rest."""
    ratio = isolator.damping_ratio
    if ratio is None:
        return isolator.damping or ZERO3
    A = _product_of_turns(isolator.angles, (2, 1, 0))
    along = _times(_transposed(A), _times(_at(isolator.position), _column(x)))
    lift = _times(A, [[-k * s[0]] for k, s in zip(isolator.stiffness, along, strict=True)])
    square = math.fsum(g * g for g in gravity)
    mass = 0.0 - math.fsum(f[0] * g for f, g in zip(lift, gravity, strict=True)) / square if square else 0.0
    if not mass > 0.0:
        key = "ratio" if isolator.loss is None else "loss"
        bears = "there is no gravity, so that it bears" if not square else f"it bears {mass:.4g} kg at rest, and so"
        words = f"{bears} no mass to be damped critically: expected damping in N s/m"
        raise QuantityError(f"isolator {isolator.name}", key, words)
    return cast(Vec3, tuple(2.0 * ratio * math.sqrt(k * mass) for k in isolator.stiffness))


def _weight(stand: Stand, gravity: Sequence[float]) -> list[float]:
    """Weight and buoyancy (6; N, N m) under a gravity in E1 axes, about O1; flywheels averaged over a turn."""
    total = [0.0] * 6
    for body in stand.bodies:
        origin, axes = _place(stand, body)
        for mass, (along, *across) in ((body.mass, body.center_of_mass), *((-m, c) for m, c in body.displaced)):
            center = (along, 0.0, 0.0) if isinstance(body, Flywheel) else (along, *across)
            r = [o + s[0] for o, s in zip(origin, _times(axes, _column(center)), strict=True)]
            force = [mass * g for g in gravity]
            moment = (
                r[1] * force[2] - r[2] * force[1], r[2] * force[0] - r[0] * force[2], r[0] * force[1] - r[1] * force[0]
            )  # fmt: skip
            total = [a + b for a, b in zip(total, (*force, *moment), strict=True)]
    return total


def _place(stand: Stand, body: Any) -> tuple[list[float], Rows]:
    """Origin of a body in E1, m, and its axes there as columns; of a flywheel the first axis alone is right."""
    if body is stand.carrier:
        return [0.0] * 3, [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
    if not isinstance(body, Flywheel):
        axes = _product_of_turns(body.angles, (2, 1, 0))
    elif hasattr(body.mounting, "axis"):
        axis = body.mounting.axis
        length = math.sqrt(math.fsum(a * a for a in axis))
        axes = [[a / length, 0.0, 0.0] for a in axis]
    else:
        axes = _product_of_turns((body.mounting.psi, body.mounting.theta), (2, 1))
    origin = list(body.position)
    mount = next(
        (
            instrument
            for instrument in stand.instruments
            if isinstance(body, Flywheel) and instrument.name == body.mount
        ),
        None,
    )
    if mount is None:
        return origin, axes
    below, turned = _place(stand, mount)
    return [o + s[0] for o, s in zip(below, _times(turned, _column(origin)), strict=True)], _times(turned, axes)


def _displacement(K: Rows, weight: Sequence[float], stand: Stand) -> list[float]:
    """x = S y (6; m, rad) with S^T K S y = S^T w: the springs carry the weight. Raises QuantityError."""
    S: Rows = np.eye(6).tolist() if stand.hold is None else twists(stand.hold).tolist()
    if not S[0]:  # clamped: all is carried by the hold
        return [0.0] * 6
    A, b = _times(_transposed(S), _times(K, S)), [w[0] for w in _times(_transposed(S), _column(weight))]
    size = [math.sqrt(A[i][i]) or 1.0 for i in range(len(A))]
    largest = max((abs(value) / s for value, s in zip(b, size, strict=True)), default=0.0)
    L = [[A[i][j] / (size[i] * size[j]) for j in range(len(A))] for i in range(len(A))]
    y = [value / s for value, s in zip(b, size, strict=True)]
    for k in range(len(A)):  # elimination; what is soft must not be asked for
        if L[k][k] <= SOFT:
            if abs(y[k]) > LEFT * largest:
                row = max(range(6), key=lambda i: abs(S[i][k]))
                words = f"nothing carries the weight along {TWIST_NAMES[row]}: springs have no stiffness there"
                raise QuantityError("isolator", f"{words}; expected springs that bear weight and buoyancy")
            y[k] = 0.0
            for i in range(k + 1, len(A)):
                L[i][k] = 0.0
            continue
        for i in range(k + 1, len(A)):
            factor = L[i][k] / L[k][k]
            y[i] -= factor * y[k]
            for j in range(k + 1, len(A)):
                L[i][j] -= factor * L[k][j]
    for k in reversed(range(len(A))):
        if L[k][k] > SOFT:
            y[k] = (y[k] - math.fsum(L[k][j] * y[j] for j in range(k + 1, len(A)))) / L[k][k]
    return [row[0] for row in _times(S, [[value / s] for value, s in zip(y, size, strict=True)])]


def _require_stable(K: Rows, x: Sequence[float], gravity: Sequence[float], stand: Stand) -> None:
    """Raise QuantityError where the stand falls from the pose in which springs, displaced by x, balance its weight.

    A small twist of the carrier changes x by B twist, and the wrench of the weight in E1 axes by G twist, as gravity
    turns there: the springs hold where K B - G has no negative eigenvalue along the freedoms.
    """
    S = twists(stand.hold)
    if not S.any() or any(law.carries_weight for law in stand.laws):  # clamped; legs hold too, and are not known here
        return
    shift, turn = np.array(x[:3]), np.array(x[3:])
    B, G, angle = np.eye(6), np.zeros((6, 6)), float(np.linalg.norm(turn))
    B[:3, 3:] = cross(shift)
    half = 0.5 * angle
    square = (1.0 - half / math.tan(half)) / angle**2 if angle > 1e-3 else 1.0 / 12.0
    B[3:, 3:] += 0.5 * cross(turn) + square * cross(turn) @ cross(turn)
    for i, turned in enumerate(np.cross(np.array(gravity), np.eye(3)).tolist()):
        G[:, 3 + i] = _weight(stand, turned)
    springs, weight = (S.T @ A @ S for A in (np.array(K) @ B, G))
    size = np.sqrt(np.diag(S.T @ np.array(K) @ S))
    size[size**2 <= SOFT * max(size) ** 2] = 1.0  # what is soft but for rounding is not scaled
    values, vectors = np.linalg.eig((springs - weight) / np.outer(size, size))  # not symmetric: it has no potential
    least = int(np.argmin(np.where(values.imag == 0.0, values.real, np.inf)))
    if values[least].imag == 0.0 and values[least].real < -LEFT:
        y = vectors[:, least].real / size
        twist = S @ y
        row = int(np.argmax(np.abs(twist)))
        y /= twist[row]
        held, pushed = float(y @ springs @ y), float(y @ weight @ y)
        unit = "N/m" if row < 3 else "N m/rad"
        words = (
            f"along {TWIST_NAMES[row]} springs resist a motion by {held:.4g} {unit}, weight drives it by {pushed:.4g}"
        )
        raise QuantityError("suspension", "preload", f"{words}: expected stiffer ones, or a lower centre of mass")


def _home(stand: Stand) -> Rows:
    """Attitude of the carrier (3x3, axes of E1 as columns in E0) in the pose that the file gives."""
    return _product_of_turns(ZERO3 if stand.hold is None else stand.hold.angles, _AXES[stand.angles])


def _at(position: Vec3) -> Rows:
    """T (3x6): what a point of the carrier moves by."""
    x, y, z = position
    return [[1.0, 0.0, 0.0, 0.0, z, -y], [0.0, 1.0, 0.0, -z, 0.0, x], [0.0, 0.0, 1.0, y, -x, 0.0]]


@lru_cache(maxsize=256)
def _product_of_turns(angles: tuple[float, ...], about: tuple[int, ...]) -> Rows:
    """Product of turns by some angles about axes."""
    C: Rows = [[float(i == j) for j in range(3)] for i in range(3)]
    for angle, axis in zip(angles, about, strict=True):
        c, s = polar(1.0, angle, 1.0)
        j, k = (axis + 1) % 3, (axis + 2) % 3
        turn: Rows = [[float(i == n) for n in range(3)] for i in range(3)]
        turn[j][j] = turn[k][k] = c
        turn[k][j], turn[j][k] = s, -s
        C = _times(C, turn)
    return C


def _rotation(v: Sequence[float]) -> Rows:
    """Rotation (3x3) by a rotation vector, rad."""
    x, y, z = v
    angle = math.sqrt(math.fsum(a * a for a in v))
    first = polar(1.0, angle, 1.0)[1] / angle if angle else 1.0
    half = polar(1.0, 0.5 * angle, 1.0)[1] / angle if angle else 0.5
    W: Rows = [[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]]
    square = _times(W, W)
    return [[float(i == j) + first * W[i][j] + 2.0 * half * half * square[i][j] for j in range(3)] for i in range(3)]


def _angles(C: Rows, sequence: AngleSequence) -> Vec3:
    """psi, theta, phi of an attitude, rad, in the sequence of the stand; theta, phi from what psi leaves."""
    first, _, _ = _AXES[sequence]
    psi = {"ship": (C[1][0], C[0][0]), "aircraft": (-C[2][0], C[0][0]), "euler": (C[0][2], -C[1][2])}[sequence]
    angles = [_atan2(*psi)]
    B = _times(_product_of_turns((-angles[0],), (first,)), C)
    if sequence == "ship":
        rest = (-B[2][0], B[0][0]), (-B[1][2], B[1][1])
    elif sequence == "aircraft":
        rest = (B[1][0], B[0][0]), (B[2][1], B[2][2])
    else:
        rest = (-B[1][2], B[2][2]), (-B[0][1], B[0][0])
    angles += [_atan2(*pair) for pair in rest]
    return cast(Vec3, tuple(angle + 0.0 for angle in angles))


def _atan2(y: float, x: float) -> float:
    """Angle of a point, rad, as near as a double can be: a libm rounds as it likes."""
    if y == 0.0 and x > 0.0:
        return 0.0
    import mpmath  # of few stands

    with mpmath.workdps(40):
        return float(mpmath.atan2(y, x))


def _times(A: Rows, B: Rows) -> Rows:
    """Product of two matrices."""
    return [
        [math.fsum(a * b for a, b in zip(row, column, strict=True)) for column in zip(*B, strict=True)] for row in A
    ]


def _transposed(A: Rows) -> Rows:
    return [list(column) for column in zip(*A, strict=True)]


def _column(v: Sequence[float]) -> Rows:
    return [[value] for value in v]
