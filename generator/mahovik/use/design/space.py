"""The unknowns of a design: numbers that are free and not tied, the stand that they define, and limits as hinge rows.

All numbers of all flywheels, x (N, WIDTH), are x = A y + b with the free ones y (P); ties add entries to columns of A.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import cast

import numpy as np

from mahovik.core.stand.fields import Mat3
from mahovik.core.stand.model import Flywheel, MountingAngles, Stand
from mahovik.errors import DesignError
from mahovik.use.design.freedom import NAMES, PARTS, WIDTH, Freedom, Limits, Mask, Tie
from mahovik.use.numeric import PARAMETERS, Array, flywheel_transfer, mount_axes, place, turn

_ROUNDING = 1e-9


@dataclass(frozen=True, eq=False)
class Space:
    """Unknowns y of a stand's design.

    A, b         (N WIDTH, P), (N WIDTH)
    least, most  (P) bounds of y
    size         (P) a large change of each
    owner        (P): number of the first of the numbers x that y moves: s WIDTH + k
    """

    stand: Stand
    free: Mask
    A: Array
    b: Array
    least: Array
    most: Array
    size: Array
    owner: tuple[int, ...]

    @staticmethod
    def of(stand: Stand, freedom: Freedom) -> Space:
        """The unknowns of a stand. DesignError: ties contradict bounds, or each other."""
        N = len(stand.flywheels)
        least, most = freedom.least.ravel().copy(), freedom.most.ravel().copy()
        root, sign, shift = list(range(N * WIDTH)), [1.0] * (N * WIDTH), [0.0] * (N * WIDTH)
        for tie in freedom.ties:
            for other, first, s, o in _tied_pairs(tie):
                _join(other, first, s, o, root, sign, shift)
        roots = sorted(set(root))
        b, columns, bounds = np.zeros(N * WIDTH), [], []
        for r in roots:
            members = [i for i in range(N * WIDTH) if root[i] == r]
            low, high = _common_bounds(members, sign, shift, least, most)
            rounding = _ROUNDING * max(1e-6, abs(low)) if math.isfinite(low) else 0.0
            if low > high + rounding:
                raise DesignError([_contradiction(stand, members)])
            column = np.zeros(N * WIDTH)
            for i in members:
                column[i], b[i] = sign[i], shift[i]
            if high - low <= rounding:
                b += column * low
            else:
                columns.append(column)
                bounds.append((low, high, r))
        A = np.stack(columns, axis=1) if columns else np.zeros((N * WIDTH, 0))
        low_high = np.array([each[:2] for each in bounds]).reshape(-1, 2)
        owner = tuple(each[2] for each in bounds)
        size = np.array([_large_change(*pair) for pair in low_high])
        return Space(stand, freedom.free, A, b, low_high[:, 0], low_high[:, 1], size, owner)

    @property
    def P(self) -> int:
        """Number of unknowns."""
        return len(self.owner)

    @property
    def start(self) -> Array:
        """y (P) of the given stand, clipped to the bounds."""
        return self.inside((self.original.ravel() - self.b)[list(self.owner)] if self.P else np.zeros(0))

    @property
    def original(self) -> Array:
        """x (N, WIDTH) of the given stand."""
        return np.array([flywheel_numbers(s) for s in self.stand.flywheels]).reshape(-1, WIDTH)

    def own_rates(self, y: Array, by_parameters: Array, s: int) -> Array:
        """Derivatives (..., WIDTH) by the numbers of flywheel s, from those (..., N, K) by its parameters."""
        return np.asarray(by_parameters[..., s, :] @ parameter_rates(self.stand.flywheels[s], self.numbers(y)[s], True))

    def inside(self, y: Array) -> Array:
        """y (P) clipped to the bounds."""
        return np.asarray(np.clip(y, self.least, self.most))

    def random(self, rng: np.random.Generator) -> Array:
        """Random y (P) inside the bounds; angles without bounds have any direction."""
        y = np.empty(self.P)
        for k, (low, high, owner) in enumerate(zip(self.least, self.most, self.owner, strict=True)):
            if math.isfinite(low) and math.isfinite(high):
                y[k] = rng.uniform(low, high)
            elif NAMES[owner % WIDTH] == "theta":
                y[k] = math.asin(rng.uniform(-1.0, 1.0))
            else:
                y[k] = rng.uniform(-math.pi, math.pi)
        return self.inside(y)

    def numbers(self, y: Array) -> Array:
        """x (N, WIDTH)."""
        return np.asarray((self.A @ y + self.b).reshape(-1, WIDTH))

    def stand_of(self, y: Array) -> Stand:
        """The stand of a design; flywheels without freedom are unchanged."""
        wheels = tuple(
            build_flywheel(wheel, x) if free.any() else wheel
            for wheel, x, free in zip(self.stand.flywheels, self.numbers(y), self.free, strict=True)
        )
        return replace(self.stand, flywheels=wheels)

    def by_unknowns(self, y: Array, by_parameters: Array) -> Array:
        """Derivatives by y (..., P), from those (..., N, K) by `residual.PARAMETERS`."""
        x = self.numbers(y)
        own = [
            by_parameters[..., s, :] @ parameter_rates(wheel, x[s], bool(self.free[s].any()))
            for s, wheel in enumerate(self.stand.flywheels)
        ]
        return np.asarray(np.concatenate(own, axis=-1) @ self.A)


def flywheel_numbers(wheel: Flywheel) -> Array:
    """Numbers (WIDTH) of a flywheel."""
    psi, theta, _ = mounting_angles(wheel)
    _, y, z = wheel.center_of_mass
    at = math.atan2(z, y) if y or z else 0.0
    return np.array([*wheel.position, psi, theta, wheel.mass * math.hypot(y, z), at, wheel.mass, 1.0])


def mounting_angles(wheel: Flywheel) -> tuple[float, float, float]:
    """psi_s, theta_s, phi0 of a mounting, in whichever form the file gives it."""
    own = wheel.mounting
    if isinstance(own, MountingAngles):
        return own.psi, own.theta, own.zero
    C = mount_axes(wheel)
    psi, theta = math.atan2(C[1, 0], C[0, 0]), -math.asin(max(-1.0, min(1.0, C[2, 0])))
    rest = turn(1, theta).T @ turn(2, psi).T @ C
    return psi, theta, math.atan2(rest[2, 1], rest[1, 1])


def build_flywheel(wheel: Flywheel, x: Array) -> Flywheel:
    """The flywheel with the numbers x (WIDTH)."""
    place, psi, theta, unbalance, at, mass, factor = x[:3], *(float(each) for each in x[3:])
    r = unbalance / mass if mass > 0.0 else 0.0
    J = np.array(wheel.inertia) * factor * _share(wheel, mass)
    return replace(
        wheel,
        position=(float(place[0]), float(place[1]), float(place[2])),
        mounting=MountingAngles(psi, theta, mounting_angles(wheel)[2]),
        mass=mass,
        center_of_mass=(wheel.center_of_mass[0], r * math.cos(at), r * math.sin(at)),
        inertia=cast(Mat3, tuple(tuple(float(each) for each in row) for row in J)),
    )


def _share(wheel: Flywheel, mass: float) -> float:
    """Mass over that in the stand file."""
    return mass / wheel.mass if wheel.mass > 0.0 else 1.0


_POSITION, _TURN, _MASS, _CENTER, _INERTIA = (
    PARAMETERS.index(name) for name in ("position 1", "turn 1", "mass", "center 1", "J11")
)


def parameter_rates(wheel: Flywheel, x: Array, free: bool) -> Array:
    """Derivatives (K, WIDTH) of `residual.PARAMETERS` by the numbers of a flywheel; zero if nothing is free."""
    D = np.zeros((len(PARAMETERS), WIDTH))
    if not free:
        return D
    theta, unbalance, at, mass, factor = (float(each) for each in x[4:])
    rolled = turn(0, mounting_angles(wheel)[2]).T
    D[_POSITION : _POSITION + 3, PARTS["position"]] = np.eye(3)
    D[_TURN : _TURN + 3, 3] = rolled @ turn(1, theta).T @ np.array([0.0, 0.0, 1.0])
    D[_TURN : _TURN + 3, 4] = rolled @ np.array([0.0, 1.0, 0.0])
    if mass > 0.0:
        along, across = np.array([math.cos(at), math.sin(at)]), np.array([-math.sin(at), math.cos(at)])
        D[_CENTER + 1 : _CENTER + 3, 5] = along / mass
        D[_CENTER + 1 : _CENTER + 3, 6] = across * unbalance / mass
        D[_CENTER + 1 : _CENTER + 3, 7] = -along * unbalance / mass**2
    D[_MASS, 7] = 1.0
    J = np.array(wheel.inertia)
    entries = np.array([J[0, 0], J[1, 1], J[2, 2], J[0, 1], J[0, 2], J[1, 2]])
    if wheel.mass > 0.0:
        D[_INERTIA : _INERTIA + 6, 7] = entries * factor / wheel.mass
    D[_INERTIA : _INERTIA + 6, 8] = entries * _share(wheel, mass)
    return D


def _tied_pairs(tie: Tie) -> list[tuple[int, int, float, float]]:
    """(i, j, sign, shift): x_i = sign x_j + shift, for all numbers that a tie joins."""
    first, found = tie.flywheels[0] * WIDTH, []
    for s in tie.flywheels[1:]:
        for key in tie.same:
            found += [(s * WIDTH + k, first + k, 1.0, 0.0) for k in range(WIDTH)[PARTS[key]]]
        if tie.mirror is not None:
            axis = "xyz".index(tie.mirror)
            found += [(s * WIDTH + k, first + k, -1.0 if k == axis else 1.0, 0.0) for k in range(3)]
            found.append((s * WIDTH + 3, first + 3, 1.0 if axis == 2 else -1.0, math.pi if axis == 0 else 0.0))
            found.append((s * WIDTH + 4, first + 4, -1.0 if axis == 2 else 1.0, 0.0))
    return found


def _join(i: int, j: int, s: float, o: float, root: list[int], sign: list[float], shift: list[float]) -> None:
    """Impose x_i = s x_j + o by joining the set of i to the root of j."""
    if root[i] == root[j]:
        return
    # x_i = sign_i r_i + shift_i and x_j = sign_j r_j + shift_j give r_i by r_j
    own, a, c = root[i], sign[i] * s * sign[j], sign[i] * (s * shift[j] + o - shift[i])
    for k in range(len(root)):
        if root[k] == own:
            shift[k] += sign[k] * c
            sign[k] *= a
            root[k] = root[j]


def _common_bounds(
    members: list[int], sign: list[float], shift: list[float], least: Array, most: Array
) -> tuple[float, float]:
    """Bounds of a root that keep all its members inside theirs."""
    low, high = -math.inf, math.inf
    for i in members:
        a, c = (least[i] - shift[i]) * sign[i], (most[i] - shift[i]) * sign[i]
        low, high = max(low, min(a, c)), min(high, max(a, c))
    return float(low), float(high)


def _contradiction(stand: Stand, members: list[int]) -> str:
    """Message about tied numbers that have no common value."""
    names = ", ".join(f'"{stand.flywheels[i // WIDTH].name}"' for i in members)
    return (
        f"group of {names}: {NAMES[members[0] % WIDTH]} must be equal, but their bounds or fixed values have no "
        "common value; free it for all of them, inside the same bounds"
    )


def _large_change(low: float, high: float) -> float:
    """A large change: half the range, or one radian without a range."""
    return (high - low) / 2.0 if math.isfinite(low) and math.isfinite(high) else 1.0


MARGIN = 1e-9
"""Margin to a limit, as a part of it, so that rounding does not break it."""


def limit_rows(limits: Limits, space: Space, y: Array) -> tuple[Array, Array]:
    """Hinges (n): relative excess over a limit, 0 inside; derivatives (n, P) by y."""
    values, slopes = [], []
    x = space.numbers(y)
    A = space.A.reshape(len(x), WIDTH, space.P)
    for limit, k in ((limits.total_mass, 7), (limits.total_unbalance, 5)):
        if limit is not None:
            over = x[:, k].sum() / limit - 1.0 + MARGIN
            values.append(max(0.0, over))
            slopes.append(A[:, k].sum(axis=0) / limit * (over > 0.0))
    if limits.distance is not None and len(x) > 1:
        places, mounts = places_of(space.stand, x)
        for i in range(len(x)):
            for j in range(i):
                apart = places[i] - places[j]
                d = float(np.linalg.norm(apart))
                under = 1.0 + MARGIN - d / limits.distance
                values.append(max(0.0, under))
                along = apart / d if d > 0.0 else np.array([1.0, 0.0, 0.0])
                by = along @ (mounts[i] @ A[i, :3] - mounts[j] @ A[j, :3])
                slopes.append(-by / limits.distance * (under > 0.0))
    return np.array(values), np.array(slopes).reshape(len(values), space.P)


def places_of(stand: Stand, x: Array) -> tuple[Array, Array]:
    """Places of the flywheels in E1 (N, 3), and axes of their mounts (N, 3, 3)."""
    still = MountingAngles(0.0, 0.0, 0.0)
    mounts = [
        flywheel_transfer(stand, replace(wheel, position=(0.0, 0.0, 0.0), mounting=still)) for wheel in stand.flywheels
    ]
    axes = np.array([L[:3, :3] for L in mounts]).reshape(-1, 3, 3)
    places = np.array([place(L) + L[:3, :3] @ own[:3] for L, own in zip(mounts, x, strict=True)])
    return places.reshape(-1, 3), axes


def nearest_two(stand: Stand) -> tuple[float, str, str] | None:
    """Least distance between two flywheels (m), and their names; None for fewer than two."""
    wheels = stand.flywheels
    places = [place(flywheel_transfer(stand, s)) for s in wheels]
    pairs = [
        (float(np.linalg.norm(places[i] - places[j])), wheels[j].name, wheels[i].name)
        for i in range(len(wheels))
        for j in range(i)
    ]
    return min(pairs) if pairs else None
